//! Branches of a germ, lifted to the mechanism: only what closes on all equations at a finite distance is a branch.
//!
//! The germ is cut off at some degree and says nothing beyond a neighbourhood. So a point of each of its branches is closed on
//! all equations, where it may move by a share of its distance from other branches only; the kernel there is compared with
//! the branch's dimension; and the branch is followed to generic poses.
//!
//! Where the equations have a multiple zero along the branch, as they do on a permanently shaky one, the kernel is larger
//! than the branch, and tangents are secants between computed poses: see [`secant_poses`].

use super::chart::Kernel;
use super::claim::PartBranch;
use super::germ::Germ;
use super::germ_zeros::GermBranch;
use super::idle_directions::idle_directions;
use super::more_digits::MoreDigits;
use super::pose_rank::{LADDER, PartRank, Pose, TALL, height_at};
use super::tracing::{
    APPROACHES, FAR, POSES, PartPose, Tangents, natural, orthonormal, tangents_at, walk,
};
use kutzbach_closure::{JointState, Part, Section, jacobian};
use kutzbach_math::matrix::{MatrixError, NullVectors, Real, decide};

/// A lifted point may move by this share of its distance from the pose, and from other branches, while all equations are
/// closed.
const POLISHING: f64 = 0.35;

/// Branches that are no farther apart than this share of their distance from the pose make one another's equations nearly
/// dependent.
const NEAR: f64 = 1e-3;

/// A branch that the mechanism really has.
pub(super) struct Lifted {
    pub branch: PartBranch,
    /// Whether its instantaneous freedom at a generic pose is more than its dimension.
    pub shaky: bool,
}

/// The pose where branches start.
pub(super) struct Start<'a> {
    pub pose: &'a Pose<'a>,
    pub part: &'a Part,
    pub rank: &'a PartRank,
    pub kernel: &'a Kernel,
    /// Directions that are idle at all poses, orthonormal in the metric: every branch has these too.
    pub idle: &'a [Vec<f64>],
}

/// Lifts all branches of a germ, or says which one cannot be.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn lift_all(
    start: &Start<'_>,
    germ: &Germ,
    branches: &[GermBranch],
) -> Result<Result<Vec<Lifted>, String>, MatrixError> {
    let mut lifted = Vec::new();
    for (index, branch) in branches.iter().enumerate() {
        let mut best = None;
        for point in &branch.points {
            let others = branches.iter().enumerate().filter(|(i, _)| *i != index);
            let apart = others
                .flat_map(|(_, other)| &other.points)
                .map(|other| distance(point, other))
                .fold(f64::INFINITY, f64::min);
            if let Some(found) = lift(start, germ, branch, point, apart)? {
                best = Some(found);
                break;
            }
        }
        let Some(found) = best else {
            return Ok(Err(format!(
                "a branch of dimension {} of the power series does not close on all equations at a finite distance",
                branch.dimension
            )));
        };
        lifted.push(found);
    }
    Ok(Ok(lifted))
}

/// Lifts one point of a branch; `apart` is how far points of other branches are.
fn lift(
    start: &Start<'_>,
    germ: &Germ,
    branch: &GermBranch,
    point: &[f64],
    apart: f64,
) -> Result<Option<Lifted>, MatrixError> {
    let Start {
        pose,
        part,
        rank,
        kernel,
        idle,
    } = *start;
    let metric = &kernel.metric;
    let section = Section {
        mechanism: pose.mechanism,
        geometry: pose.geometry,
        part,
        metric,
    };
    let z: Vec<f64> = germ
        .increments(point)
        .iter()
        .zip(&metric.weights)
        .map(|(q, weight)| q * weight)
        .collect();
    let away = 0.0.norm(&z);
    let mut states = pose.states.to_vec();
    section.advance_by(&mut states, &z);
    let closing = section.close(&mut states, &[], 80)?;
    if closing.residual > 4.0 * closing.rounding + rank.open_by_digits()
        || closing.way > POLISHING * away.min(apart)
    {
        return Ok(None);
    }
    // Along a branch on which an equation enters squared, a residual of ρ leaves a pose off by √ρ: a singular value of this
    // size is zero there, and nowhere else so close to it.
    let blur = closing.residual.max(closing.rounding).sqrt();
    let dimension = branch.dimension + idle.len();
    let sharp = tangents_at(&section, &states, rank.open_by_digits(), dimension)?;
    let blurred = tangents_at(
        &section,
        &states,
        rank.open_by_digits() + 10.0 * blur,
        dimension,
    )?;
    let tells = |seen: &Option<Tangents>| seen.as_ref().and_then(|t| t.instantaneous);
    let [sharp, blurred] = [sharp, blurred].map(|seen| seen.map(|(tangents, _)| tangents));
    let freedom_if_blurred = tells(&blurred);
    // Where the two differ the singular values are small for one of two reasons, and the series tell which: the branch is
    // not simple, or the pose that singular values grow from is near.
    let shaky_there =
        !branch.reduced && freedom_if_blurred.is_some_and(|freedom| freedom > dimension);
    let Some(there) = (if shaky_there || tells(&sharp).is_none() {
        blurred
    } else {
        sharp
    }) else {
        return Ok(None);
    };
    let Some(instantaneous) = there.instantaneous else {
        return Ok(None);
    };
    if instantaneous < dimension {
        return Ok(None);
    }
    // All but a double zero: a surface may be one, since of surfaces the series, which is cut off, tells a double one from a simple one
    // less well than a pose farther away does. Or, with no other branch found so near that it would account for that, it may be two,
    // closer than series in double precision can tell, for which exact numbers of many digits may have been written.
    let nearly_multiple =
        instantaneous == dimension && freedom_if_blurred.is_some_and(|freedom| freedom > dimension);
    if nearly_multiple && apart > NEAR * away && height_at(pose, part) > TALL {
        return Ok(None);
    }
    let direction: Vec<f64> = z.iter().map(|x| x / away).collect();
    let multiple = match freedom_if_blurred.filter(|_| nearly_multiple && branch.dimension > 1) {
        Some(more) => multiple_poses(start, &section, states.clone(), blur, (dimension, more))?,
        None => None,
    };
    let poses = if let Some(poses) = multiple.filter(|poses| !poses.is_empty()) {
        poses
    } else if instantaneous == dimension {
        walk(
            &section,
            &mut states.clone(),
            there.basis,
            Some(direction),
            rank.open_by_digits(),
            POSES,
            away,
        )?
    } else {
        let Some(poses) =
            multiple_poses(start, &section, states, blur, (dimension, instantaneous))?
        else {
            return Ok(None);
        };
        poses
    };
    if poses.is_empty() {
        return Ok(None);
    }
    let shaky = poses
        .iter()
        .all(|p| p.instantaneous.is_some_and(|i| i > dimension));
    Ok(Some(Lifted {
        branch: PartBranch {
            dimension,
            half_branches: (dimension == 1).then_some(branch.half_branches.len()),
            poses,
        },
        shaky,
    }))
}

/// Poses of a branch along which the equations have a double zero, farther than the point that was found: branches that touch to a high
/// order are one double zero near the pose, and two farther away. `None` where it does not stay one, or nothing tells.
fn multiple_poses(
    start: &Start<'_>,
    section: &Section<'_, f64>,
    states: Vec<JointState<f64>>,
    blur: f64,
    (dimension, instantaneous): (usize, usize),
) -> Result<Option<Vec<PartPose>>, MatrixError> {
    let rank = start.rank;
    // Near the pose branches that touch to a high order are one double zero; farther away they are two.
    let Some(Extended {
        states: there,
        blur,
        far,
    }) = extended(
        section,
        start.pose.states,
        states,
        blur,
        rank.open_by_digits(),
    )?
    else {
        return Ok(None);
    };
    let stated = rank.open_by_digits() + 10.0 * blur;
    let Some((tangents, _)) = tangents_at(section, &there, stated, instantaneous)? else {
        return Ok(None);
    };
    if !multiple_farther(
        section,
        start.pose.states,
        &there,
        rank.open_by_digits(),
        instantaneous,
    )? {
        return Ok(None);
    }
    if tangents.instantaneous != Some(instantaneous)
        || !stays_multiple(start, section, &there, instantaneous, far)?
    {
        return Ok(None);
    }
    secant_poses(
        section,
        &there,
        &tangents.basis,
        dimension,
        instantaneous,
        rank.open_by_digits(),
    )
    .map(Some)
}

/// A pose farther along a branch, and how uncertain it is if an equation enters squared.
struct Extended {
    states: Vec<JointState<f64>>,
    blur: f64,
    /// Whether branches that touch would have parted there.
    far: bool,
}

/// A pose of a branch through the pose `home`, carried on along the chord from there until it is far from it or the branch
/// bends, and how uncertain it is if an equation enters squared. `None` where the loops do not close on the way.
fn extended(
    section: &Section<'_, f64>,
    home: &[JointState<f64>],
    mut states: Vec<JointState<f64>>,
    mut blur: f64,
    stated: f64,
) -> Result<Option<Extended>, MatrixError> {
    for _ in 0..APPROACHES {
        let way = section.way_between(home, &states);
        let away = 0.0.norm(&way);
        if away >= FAR {
            return Ok(Some(Extended {
                states,
                blur,
                far: true,
            }));
        }
        let longer: Vec<f64> = way.iter().map(|x| 1.5 * x).collect();
        let mut there = home.to_vec();
        section.advance_by(&mut there, &longer);
        let closing = section.close(&mut there, &[], 80)?;
        if closing.residual > 4.0 * closing.rounding + stated {
            return Ok(None);
        }
        if closing.way > POLISHING * away {
            // The branch bends away from the chord, which tells nothing against it.
            return Ok(Some(Extended {
                states,
                blur,
                far: false,
            }));
        }
        states = there;
        blur = closing.residual.max(closing.rounding).sqrt();
    }
    Ok(None)
}

/// How far a branch that seems multiple is followed at most (metric).
const FARTHEST: f64 = 4.0;

/// Whether the kernel keeps its dimension as far as the branch can be carried on along the chord. Branches that touch to a high order
/// have hardly parted where gears make small steps of large ones.
fn multiple_farther(
    section: &Section<'_, f64>,
    home: &[JointState<f64>],
    from: &[JointState<f64>],
    stated: f64,
    freedom: usize,
) -> Result<bool, MatrixError> {
    let mut way = section.way_between(home, from);
    while 0.0.norm(&way) < FARTHEST {
        let away = 0.0.norm(&way);
        let longer: Vec<f64> = way.iter().map(|x| 1.5 * x).collect();
        let mut there = home.to_vec();
        section.advance_by(&mut there, &longer);
        let closing = section.close(&mut there, &[], 80)?;
        if closing.residual > 4.0 * closing.rounding + stated || closing.way > POLISHING * away {
            return Ok(true);
        }
        let blur = closing.residual.max(closing.rounding).sqrt();
        let seen = tangents_at(section, &there, stated + 10.0 * blur, freedom)?;
        if seen.is_some_and(|(tangents, _)| tangents.instantaneous.is_some_and(|i| i < freedom)) {
            return Ok(false);
        }
        let next = section.way_between(home, &there);
        if !(0.0.norm(&next) > away) {
            return Ok(true);
        }
        way = next;
    }
    Ok(true)
}

/// Whether the kernel at a pose has the dimension found also in many digits. What double precision takes for a double zero may
/// be two that are close: because exact numbers of many digits put them there, or, at a pose that is not `far`, because
/// branches touch.
fn stays_multiple(
    start: &Start<'_>,
    section: &Section<'_, f64>,
    states: &[JointState<f64>],
    freedom: usize,
    far: bool,
) -> Result<bool, MatrixError> {
    let tall = height_at(start.pose, start.part);
    let rounded = start.rank.open_by_digits() > start.rank.accuracy;
    if rounded {
        return Ok(far);
    }
    // Short numbers leave little that is too small for double precision: there only a rank that is seen to be larger counts.
    let short = far && tall <= TALL;
    let Some(bits) = LADDER.into_iter().find(|bits| *bits as usize >= 3 * tall) else {
        return Ok(false);
    };
    let mut more = MoreDigits::new();
    let pose = start.pose;
    let (geometry, home) = more.polished(pose, start.part, !pose.as_drawn, bits)?;
    let finer = Section {
        mechanism: pose.mechanism,
        geometry,
        part: start.part,
        metric: section.metric,
    };
    let mut there = home.to_vec();
    finer.advance_by(&mut there, &section.way_between(pose.states, states));
    let closing = finer.close(&mut there, &[], 200)?;
    if closing.residual > CLOSED_IN_MORE_DIGITS {
        return Ok(short);
    }
    let here = jacobian(pose.mechanism, geometry, &there, start.part)?;
    let mut matrix = here.matrix;
    matrix.scale_columns();
    // Digits beyond those stated are not known, and a double zero only to the root of what they leave open.
    let accuracy =
        10.0 * (closing.residual + start.rank.open_by_digits()).sqrt() + closing.rounding;
    let found = decide(&matrix, accuracy)?.nullity();
    if short {
        return Ok(found.is_none_or(|found| found >= freedom));
    }
    // What could be hidden in the last bits of the numbers has to be above it, and a thousandth of that too: a singular value
    // is an offset times something.
    let seen = tall <= TALL || accuracy <= 0.5f64.powi(tall as i32 + 10);
    Ok(seen && found == Some(freedom))
}

/// A double zero is found to so much only, because directions are computed in double precision.
const CLOSED_IN_MORE_DIGITS: f64 = 1e-16;

/// How far the idle freedoms are turned to a generic pose (metric).
const IDLE_STEP: f64 = 0.5;

/// The branch along which only what is idle moves. Its instantaneous freedom is that of the pose.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn idle_branch(start: &Start<'_>) -> Result<PartBranch, MatrixError> {
    let metric = &start.kernel.metric;
    let section = Section {
        mechanism: start.pose.mechanism,
        geometry: start.pose.geometry,
        part: start.part,
        metric,
    };
    let dimension = start.idle.len();
    let mut states = start.pose.states.to_vec();
    let share = IDLE_STEP / (dimension.max(1) as f64).sqrt();
    for direction in start.idle {
        let z: Vec<f64> = direction.iter().map(|x| x * share).collect();
        section.advance_by(&mut states, &z);
    }
    let closing = section.close(&mut states, &[], 80)?;
    // What is not idle is a zero of higher order, so that closing leaves the pose off by more than its residual.
    let blur = closing.residual.max(closing.rounding).sqrt();
    let freedom = start.kernel.basis.nullity;
    let there = tangents_at(
        &section,
        &states,
        start.rank.open_by_digits() + 10.0 * blur,
        freedom,
    )?;
    let poses = match there {
        Some((tangents, _)) => match idle_there(start, &tangents) {
            Some(idle) => vec![pose_on(&section, &states, &idle, freedom)],
            None => secant_poses(
                &section,
                &states,
                &tangents.basis,
                dimension,
                freedom,
                start.rank.open_by_digits(),
            )?,
        },
        None => Vec::new(),
    };
    Ok(PartBranch {
        dimension,
        half_branches: (dimension == 1).then_some(2),
        poses,
    })
}

/// The idle directions at another pose with these tangents, if they are as many as at the pose itself.
fn idle_there(start: &Start<'_>, tangents: &Tangents) -> Option<Vec<Vec<f64>>> {
    let kernel = Kernel {
        basis: NullVectors {
            length: start.kernel.basis.length,
            nullity: tangents.basis.len(),
            vectors: tangents.basis.clone(),
            complete: true,
            residual: start.kernel.basis.residual,
        },
        metric: start.kernel.metric.clone(),
    };
    let by_kind = height_at(start.pose, start.part) > TALL;
    let idle = idle_directions(start.pose.mechanism, start.part, &kernel, by_kind);
    (idle.len() == start.idle.len()).then_some(idle)
}

/// A pose of a branch with its tangents, orthonormal in the metric.
fn pose_on(
    section: &Section<'_, f64>,
    states: &[JointState<f64>],
    tangents: &[Vec<f64>],
    instantaneous: usize,
) -> PartPose {
    let part = section.part;
    let equations = 6 * part.cycles.len() + part.couplings.len();
    PartPose {
        states: part.joints.iter().map(|&j| states[j].clone()).collect(),
        tangents: tangents
            .iter()
            .map(|v| natural(section.metric, v))
            .collect(),
        instantaneous: Some(instantaneous),
        surplus: section.metric.weights.len() as i64 - equations as i64,
    }
}

/// How far a secant reaches (metric). Its error falls with the fourth power, and grows with the pose's, of 1e-8, over it.
const SECANT: f64 = 0.02;

/// Poses on a branch whose tangents are fewer than its instantaneous motions: tangents are taken from neighbours on the
/// branch, found by stepping along every instantaneous motion and closing the loops.
fn secant_poses(
    section: &Section<'_, f64>,
    start: &[JointState<f64>],
    kernel: &[Vec<f64>],
    dimension: usize,
    instantaneous: usize,
    stated: f64,
) -> Result<Vec<PartPose>, MatrixError> {
    let neighbour = |direction: &[f64], size: f64| -> Result<Option<Vec<f64>>, MatrixError> {
        let mut states = start.to_vec();
        let z: Vec<f64> = direction.iter().map(|x| x * size).collect();
        section.advance_by(&mut states, &z);
        let closing = section.close(&mut states, &[], 80)?;
        let closed = closing.residual <= 4.0 * closing.rounding + stated;
        Ok(closed.then(|| section.way_between(start, &states)))
    };
    // The first tangents come from directions that mostly lead off the branch, where closing is slow and coarse, or fails;
    // the second from the first.
    let mut basis = kernel.to_vec();
    for _ in 0..2 {
        let mut slopes = Vec::new();
        for direction in &basis {
            // Central differences over one and two steps together are exact to the fourth order.
            let mut slope = Some(vec![0.0; direction.len()]);
            for (steps, weight) in [(1.0, 2.0 / 3.0), (2.0, -1.0 / 12.0)] {
                for side in [1.0, -1.0] {
                    let way = neighbour(direction, side * steps * SECANT)?;
                    slope = slope.zip(way).map(|(sum, way)| {
                        let weight = side * weight / SECANT;
                        sum.iter().zip(way).map(|(s, x)| s + weight * x).collect()
                    });
                }
            }
            slopes.extend(slope.map(|slope| projected(&slope, kernel)));
        }
        // The longest ones span the tangent space.
        slopes.sort_by(|a, b| 0.0.norm(b).total_cmp(&0.0.norm(a)));
        basis = Vec::new();
        for slope in slopes {
            let mut trial = basis.clone();
            trial.push(slope.clone());
            let spanned = orthonormal(trial);
            let new = spanned.len() > basis.len();
            let reach = spanned.last().map_or(0.0, |v| along(v, &slope));
            if new && reach.abs() > 0.05 {
                basis = spanned;
            }
        }
    }
    // More of them say that the branch is a part of a larger one.
    if basis.len() != dimension {
        return Ok(Vec::new());
    }
    Ok(vec![pose_on(section, start, &basis, instantaneous)])
}

/// The part of a vector in the span of an orthonormal basis.
fn projected(vector: &[f64], basis: &[Vec<f64>]) -> Vec<f64> {
    let mut inside = vec![0.0; vector.len()];
    for direction in basis {
        let share = along(vector, direction);
        inside
            .iter_mut()
            .zip(direction)
            .for_each(|(sum, x)| *sum += share * x);
    }
    inside
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    let difference: Vec<f64> = a.iter().zip(b).map(|(x, y)| x - y).collect();
    0.0.norm(&difference)
}

fn along(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
