//! Singular poses: which branches pass through them.
//!
//! The germ of the configuration space, a few power series in the δ coordinates of the kernel, is cut off at a small order
//! and its real zeros near the origin are found ([`germ_zeros`]). That is a hint. Each branch found is then lifted to the
//! mechanism, closed on *all* equations at a finite distance, ranked there and followed: only what survives this is a
//! branch. What bounds the mobility from above is the search for zeros, which is numeric, and where it can be had the
//! dimension over the complex numbers.
//!
//! One variable (δ = 1) needs none of it: an analytic function of one variable that does not vanish identically has an
//! isolated zero, so a singular pose with δ = 1 is rigid.

use super::chart::{ChartTest, Kernel};
use super::germ::{ComplexDimension, Germ, complex_dimension, prestress_certificate};
use super::germ_zeros::{GermBranch, GermZeroOptions, GermZeros, germ_zeros};
use super::part_mobility::{Evidence, PartBranch, PartFinding};
use super::pose_rank::{PartRank, Pose};
use super::tracing::{POSES, PartPose, Tangents, natural, orthonormal, tangents_at, walk};
use super::vocabulary::{CertificateLevel, PoseKind, SingularKind};
use crate::closure::{JointState, Part, Section};
use crate::matrix::{MatrixError, Real};

/// Degrees to which the series are computed: the first, and the last tried.
const FIRST_DEGREE: usize = 4;
const LAST_DEGREE: usize = 8;

/// More starts than this are not made on a germ of many variables.
const STARTS: usize = 600;

/// Branches whose directions differ by less (cosine) share a tangent.
const SAME_DIRECTION: f64 = 0.999;

/// A lifted point may move by this share of its distance from the pose while all equations are closed.
const POLISHING: f64 = 0.35;

/// What is known of a singular pose.
pub(super) struct SingularFinding {
    pub found: PartFinding,
    pub more_evidence: Vec<Evidence>,
}

/// Looks for the branches through a pose that the chart test calls singular.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn singular_finding(
    pose: &Pose<'_>,
    part: &Part,
    rank: &PartRank,
    kernel: &Kernel,
    chart: &ChartTest,
    lower: usize,
) -> Result<SingularFinding, MatrixError> {
    let freedom = kernel.basis.nullity;
    let mut evidence = Vec::new();
    let mut found = PartFinding {
        lower,
        upper: freedom - 1,
        pose: Some(PoseKind::Singular),
        kind: None,
        class: None,
        level: CertificateLevel::Numeric,
        certificate: String::new(),
        complex_dimension: None,
        branches: None,
        at_rest: freedom,
        open: None,
        evidence: Vec::new(),
        nominal: None,
    };
    if freedom == 1 {
        "along the only direction that the equations allow to first order they fail at higher order, and an equation in one \
         variable that does not vanish identically has an isolated solution"
            .clone_into(&mut found.certificate);
        isolated(&mut found);
        found.complex_dimension = Some(0);
        return Ok(SingularFinding {
            found,
            more_evidence: evidence,
        });
    }
    let mut why = "its power series are too many to follow".to_owned();
    // Numbers taken literally close the loops exactly. The coefficients of the series are not for that reason beyond doubt:
    // rounding shifts them by its share of the curvature, of which hardly a tenth remains.
    let doubtful = PartRank {
        stated: if chart.literal {
            0.1 * rank.stated
        } else {
            rank.stated
        },
        ..rank.clone()
    };
    let literal;
    let rank = if chart.literal {
        literal = PartRank {
            stated: 0.0,
            ..rank.clone()
        };
        &literal
    } else {
        rank
    };
    // Dimensions of the branches that the last search found.
    let mut before: Option<Vec<usize>> = None;
    let mut next = FIRST_DEGREE;
    while next <= LAST_DEGREE {
        let degree = next;
        next += 2;
        let Some(germ) = Germ::of_part(pose.mechanism, &doubtful, degree)? else {
            break;
        };
        let Some(order) = germ.order() else {
            why = format!("what the equations leave over is of higher order than {degree}");
            continue;
        };
        // Twice the order shows the next terms too, by which branches of a common tangent cone differ.
        next = next.max(2 * order);
        if let Some(stress) = prestress_certificate(&germ) {
            evidence.push(Evidence {
                engine: "second order",
                scope: "a neighbourhood, real",
                bounds: (0, Some(0)),
                text: format!(
                    "a self-stress makes the second-order form definite: smallest eigenvalue {:.2e}, noise {:.2e}",
                    stress.smallest_eigenvalue, stress.noise
                ),
            });
            "a self-stress blocks every motion at second order (its quadratic form on the velocities is definite)"
                .clone_into(&mut found.certificate);
            isolated(&mut found);
            found.complex_dimension =
                complex_dimension(germ.equations(), freedom, germ.noise_by_degree())
                    .map(|c| c.dimension);
            break;
        }
        let complex = complex_dimension(germ.equations(), freedom, germ.noise_by_degree());
        let zeros = germ_zeros(
            freedom,
            germ.equations(),
            germ.noise(order),
            &GermZeroOptions {
                most_starts: STARTS,
                ..GermZeroOptions::default()
            },
        );
        evidence.push(Evidence {
            engine: "germ",
            scope: "a neighbourhood",
            bounds: (
                0,
                zeros.thin.is_none().then(|| {
                    zeros
                        .branches
                        .iter()
                        .map(|b| b.dimension)
                        .max()
                        .unwrap_or(0)
                }),
            ),
            text: germ_text(&germ, order, degree, &zeros, complex.as_ref()),
        });
        found.complex_dimension = complex.as_ref().map(|c| c.dimension);
        if let Some(thin) = &zeros.thin {
            why = refused(&mut evidence, thin.clone());
            continue;
        }
        if zeros.branches.is_empty() {
            "near this pose the closure equations have no other real solution: what the power series leave over stays away from \
             zero on small spheres"
                .clone_into(&mut found.certificate);
            isolated(&mut found);
            break;
        }
        match lift_all(pose, part, rank, kernel, &germ, &zeros.branches)? {
            Ok(lifted) => {
                let dimensions: Vec<usize> = lifted.iter().map(|b| b.branch.dimension).collect();
                let top = dimensions.iter().copied().max().unwrap_or(0);
                if complex.as_ref().is_some_and(|c| c.dimension < top) {
                    let reason =
                        "the dimension over the complex numbers contradicts the branches found";
                    why = refused(&mut evidence, reason.to_owned());
                    continue;
                }
                found.lower = top;
                // Where the complex dimension is larger real branches may have been overlooked, or there are none: y² + z² = 0.
                // Two searches in series of different lengths that find the same are taken for the answer.
                let explained = complex.as_ref().is_some_and(|c| c.dimension == top);
                let again = before.as_ref() == Some(&dimensions);
                before = Some(dimensions);
                if !explained && !again {
                    let reason = match &complex {
                        Some(complex) => format!(
                            "real branches of dimension {top} were found where the complex ones have {}",
                            complex.dimension
                        ),
                        None => format!(
                            "real branches of dimension {top} were found, and no dimension over the complex numbers confirms them"
                        ),
                    };
                    why = refused(&mut evidence, reason);
                    continue;
                }
                found.upper = top;
                found.kind = kind_of(&lifted, &zeros.branches);
                found.certificate = format!(
                    "the real zeros of the equations' power series give {} the loops close at finite distances from this pose",
                    if lifted.len() == 1 {
                        "one branch, and on it".to_owned()
                    } else {
                        format!("{} branches, and on each of them", lifted.len())
                    }
                );
                found.branches = Some(lifted.into_iter().map(|l| l.branch).collect());
                break;
            }
            Err(reason) => why = refused(&mut evidence, reason),
        }
    }
    if found.branches.is_none() {
        found.certificate =
            "the pose is singular, so that the finite freedom is below the instantaneous one"
                .to_owned();
        found.open = Some(format!(
            "which branches pass through this singular pose is not settled: {why}; a pose beside it would be easier"
        ));
        if let Some(complex) = found.complex_dimension {
            found.upper = found.upper.min(complex).max(found.lower);
        }
    }
    Ok(SingularFinding {
        found,
        more_evidence: evidence,
    })
}

/// What a search on the germ came to.
fn germ_text(
    germ: &Germ,
    order: usize,
    degree: usize,
    zeros: &GermZeros,
    complex: Option<&ComplexDimension>,
) -> String {
    let equations = match germ.equations().len() {
        1 => "1 equation".to_owned(),
        many => format!("{many} equations"),
    };
    let branches = zeros
        .branches
        .iter()
        .map(|b| format!("a branch of dimension {}", b.dimension))
        .collect::<Vec<_>>();
    let found = if branches.is_empty() {
        "none but the pose itself".to_owned()
    } else {
        branches.join(", ")
    };
    let spheres = zeros
        .radii
        .iter()
        .fold(None::<(f64, f64)>, |range, r| match range {
            None => Some((*r, *r)),
            Some((low, high)) => Some((low.min(*r), high.max(*r))),
        })
        .map_or(String::new(), |(low, high)| {
            format!(
                " on {} spheres of radius {high:.1e} to {low:.1e}",
                zeros.radii.len()
            )
        });
    let complex = complex.map_or(String::new(), |c| {
        format!(
            "; complex dimension {}, Hilbert function {:?}",
            c.dimension, c.hilbert
        )
    });
    format!(
        "{equations} of order {order} in {} variables to degree {degree}, margin {:.1e}; real zeros{spheres}: {found}; {} starts, \
         seed {}{complex}",
        germ.freedom(),
        germ.margin(),
        zeros.starts,
        zeros.seed,
    )
}

/// Marks the last search as one that nothing rests on; gives the reason back.
fn refused(evidence: &mut [Evidence], reason: String) -> String {
    if let Some(last) = evidence.last_mut() {
        last.bounds = (0, None);
        last.text.push_str("; not taken: ");
        last.text.push_str(&reason);
    }
    reason
}

fn isolated(found: &mut PartFinding) {
    found.lower = 0;
    found.upper = 0;
    found.kind = Some(SingularKind::Shaky);
    found.branches = Some(Vec::new());
}

/// A branch that the mechanism really has.
struct Lifted {
    branch: PartBranch,
    /// Whether its instantaneous freedom at a generic pose is more than its dimension.
    shaky: bool,
}

fn lift_all(
    pose: &Pose<'_>,
    part: &Part,
    rank: &PartRank,
    kernel: &Kernel,
    germ: &Germ,
    branches: &[GermBranch],
) -> Result<Result<Vec<Lifted>, String>, MatrixError> {
    let mut lifted = Vec::new();
    for branch in branches {
        let mut best = None;
        for point in &branch.points {
            if let Some(found) = lift(pose, part, rank, kernel, germ, branch, point)? {
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

fn lift(
    pose: &Pose<'_>,
    part: &Part,
    rank: &PartRank,
    kernel: &Kernel,
    germ: &Germ,
    branch: &GermBranch,
    point: &[f64],
) -> Result<Option<Lifted>, MatrixError> {
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
    if closing.residual > 4.0 * closing.rounding + rank.stated || closing.way > POLISHING * away {
        return Ok(None);
    }
    // Along a branch on which an equation enters squared, a residual of ρ leaves a pose off by √ρ: a singular value of this
    // size is zero there, and nowhere else so close to it.
    let blur = closing.residual.max(closing.rounding).sqrt();
    let dimension = branch.dimension;
    let sharp = tangents_at(&section, &states, rank.stated, dimension)?;
    let blurred = tangents_at(&section, &states, rank.stated + 10.0 * blur, dimension)?;
    let tells = |seen: &Option<Tangents>| seen.as_ref().and_then(|t| t.instantaneous);
    let [sharp, blurred] = [sharp, blurred].map(|seen| seen.map(|(tangents, _)| tangents));
    // Where the two differ the singular values are small for one of two reasons, and the series tell which: the branch is
    // not simple, or the pose that singular values grow from is near.
    let shaky_there = !branch.reduced && tells(&blurred).is_some_and(|freedom| freedom > dimension);
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
    let direction: Vec<f64> = z.iter().map(|x| x / away).collect();
    let poses = if instantaneous == branch.dimension {
        walk(
            &section,
            &states,
            there.basis,
            Some(direction),
            rank.stated,
            POSES,
        )?
    } else {
        secant_poses(
            &section,
            &states,
            &there.basis,
            branch.dimension,
            instantaneous,
            rank.stated,
        )?
    };
    if poses.is_empty() {
        return Ok(None);
    }
    let shaky = poses
        .iter()
        .all(|p| p.instantaneous.is_some_and(|i| i > branch.dimension));
    Ok(Some(Lifted {
        branch: PartBranch {
            dimension: branch.dimension,
            half_branches: (branch.dimension == 1).then_some(branch.half_branches.len()),
            poses,
        },
        shaky,
    }))
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
            if new && reach.abs() > 0.05 && basis.len() < dimension {
                basis = spanned;
            }
        }
    }
    if basis.len() != dimension {
        return Ok(Vec::new());
    }
    let (columns, rows) = (section.metric.weights.len(), 6 * section.part.cycles.len());
    Ok(vec![PartPose {
        states: section
            .part
            .joints
            .iter()
            .map(|&j| start[j].clone())
            .collect(),
        tangents: basis.iter().map(|v| natural(section.metric, v)).collect(),
        instantaneous: Some(instantaneous),
        surplus: columns as i64 - (rows + section.part.couplings.len()) as i64,
    }])
}

/// D7, from the branches through the pose.
fn kind_of(lifted: &[Lifted], zeros: &[GermBranch]) -> Option<SingularKind> {
    let first = lifted.first()?;
    if lifted
        .iter()
        .any(|l| l.branch.dimension != first.branch.dimension)
    {
        return Some(SingularKind::Kinematotropic);
    }
    if lifted.len() == 1 {
        if first.shaky {
            return Some(SingularKind::PermanentlyShaky);
        }
        let halves = &zeros.first()?.half_branches;
        return match halves.as_slice() {
            [a, b] if along(&a.tangent, &b.tangent) > SAME_DIRECTION => Some(SingularKind::Cusp),
            _ => None,
        };
    }
    let line = |branch: &GermBranch| branch.half_branches.first().map(|h| h.tangent.clone());
    let lines: Option<Vec<Vec<f64>>> = zeros.iter().map(line).collect();
    let tangential = lines.is_some_and(|lines| {
        lines
            .iter()
            .all(|l| along(l, &lines[0]).abs() > SAME_DIRECTION)
    });
    Some(if tangential {
        SingularKind::Tangential
    } else {
        SingularKind::Bifurcation
    })
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

fn along(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
