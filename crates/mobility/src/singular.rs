//! Singular poses: which branches pass through them.
//!
//! The germ of the configuration space, a few power series in the δ coordinates of the kernel, is cut off at a small order
//! and its real zeros near the origin are found ([`germ_zeros`]). That is a hint. Each branch found is then lifted to the
//! mechanism, closed on *all* equations at a finite distance, ranked there and followed: only what survives this is a
//! branch. What bounds the mobility from above is the search for zeros, which is numeric, and where it can be had the
//! dimension over the complex numbers.
//!
//! What is idle at every pose is taken out first ([`idle_directions`]). One variable left needs no search: an analytic
//! function of one variable that does not vanish identically has an isolated zero, so that only what is idle moves.

mod by_arrangement;
mod by_form;
mod by_polygon;
mod by_splitting;
mod resolution;

use self::by_arrangement::by_arrangement;
use self::by_form::by_form;
use self::by_polygon::by_polygon;
use self::by_splitting::by_splitting;
use self::resolution::Resolution;
use super::chart::{ChartTest, Kernel};
use super::germ::{
    ComplexDimension, Germ, complex_dimension, inertia, is_irreducible_hypersurface,
    isolated_by_leading_terms, prestress_certificate, signature,
};
use super::germ_zeros::{GermBranch, GermZeroOptions, GermZeros, germ_zeros};
use super::idle_directions::idle_directions;
use super::lifting::{Lifted, Start, idle_branch, lift_all};
use super::part_mobility::{Evidence, PartFinding};
use super::pose_rank::{PartRank, Pose, TALL, height_at, is_computed};
use super::vocabulary::{CertificateLevel, PoseKind, SingularKind};
use kutzbach_closure::Part;
use kutzbach_math::matrix::MatrixError;
use nalgebra::DMatrix;

/// Degrees to which the series are computed: the first, and the last tried. A germ in the plane is cheap enough for more.
const FIRST_DEGREE: usize = 4;
const LAST_DEGREE: usize = 8;
const LAST_DEGREE_IN_THE_PLANE: usize = 12;

/// Work that all searches on the germ of one part may take together: some seconds.
const SEARCHED: u64 = 1_500_000_000;

/// After so many searches that found less than there may be, longer series are not tried.
const UNPROVED: usize = 2;

/// How often a search in the plane is made again on smaller spheres, where what shows inside differs.
const SMALLER: usize = 3;

/// More starts than this are not made on a germ of many variables, and fewer where each is dear: all of them together may
/// evaluate about as many terms of series, which takes a second or so.
const STARTS: usize = 600;
const TERMS: usize = 1_000_000;

/// How many starts a search on a germ may make.
pub(super) fn most_starts(germ: &Germ) -> usize {
    let variables = germ.freedom();
    let terms: usize = germ
        .equations()
        .iter()
        .map(|equation| equation.coefficients().len())
        .sum();
    (TERMS / (variables * terms).max(1)).min(STARTS)
}

/// Branches whose directions differ by less than the first (rad) may share a tangent, from the second on they do not, as far
/// as [`Resolution`] allows to tell. Directions are known to some 1e-5.
const SAME_DIRECTION: [f64; 2] = [1e-4, 3e-3];

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
        complex_upper: None,
        contradiction: None,
    };
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
    let rounded = doubtful.stated > rank.accuracy;
    // What is idle at all poses is a factor of the configuration space.
    let by_kind = height_at(pose, part) > TALL;
    let idle = idle_directions(pose.mechanism, part, kernel, by_kind);
    let taken_out = match idle.len() {
        0 => String::new(),
        1 => ", 1 idle freedom taken out".to_owned(),
        many => format!(", {many} idle freedoms taken out"),
    };
    let start = Start {
        pose,
        part,
        rank,
        kernel,
        idle: &idle,
    };
    if freedom == 1 + idle.len() {
        "along the only direction that the equations allow to first order they fail at higher order, and an equation in one \
         variable that does not vanish identically has an isolated solution"
            .clone_into(&mut found.certificate);
        isolated(&mut found, &start)?;
        found.complex_dimension = Some(idle.len());
        return Ok(SingularFinding {
            found,
            more_evidence: evidence,
        });
    }
    let mut why = "its power series are too many to follow".to_owned();
    // What the last search found.
    let mut before: Option<Vec<Shape>> = None;
    let mut outermost = f64::INFINITY;
    let mut allowance = SEARCHED;
    let mut unproved = 0;
    let mut next = FIRST_DEGREE;
    let mut last = match freedom - idle.len() {
        2 => LAST_DEGREE_IN_THE_PLANE,
        _ => LAST_DEGREE,
    };
    while next <= last {
        let degree = next;
        next += 2;
        let Some(germ) = Germ::of_part_across(pose.mechanism, &doubtful, degree, &idle)? else {
            break;
        };
        let Some(order) = germ.order() else {
            why = format!("what the equations leave over is of higher order than {degree}");
            continue;
        };
        // Twice the order shows the next terms too, by which branches of a common tangent cone differ; a step more confirms what
        // is multiple, another serves where one search comes to nothing.
        last = last.max((2 * order + 4).min(LAST_DEGREE_IN_THE_PLANE));
        if degree < 2 * order {
            next = 2 * order;
            why = format!(
                "what the equations leave over begins at order {order}, and to tell it apart takes degree {next}"
            );
            continue;
        }
        if let Some(stress) = prestress_certificate(&germ) {
            evidence.push(Evidence {
                engine: "second order",
                scope: "a neighbourhood, real",
                bounds: (0, Some(idle.len())),
                text: format!(
                    "a self-stress makes the second-order form definite: smallest eigenvalue {:.2e}, noise {:.2e}{taken_out}",
                    stress.smallest_eigenvalue, stress.noise
                ),
            });
            "a self-stress blocks every motion at second order (its quadratic form on the velocities is definite)"
                .clone_into(&mut found.certificate);
            isolated(&mut found, &start)?;
            found.complex_dimension =
                complex_dimension(germ.equations(), germ.freedom(), germ.noise_by_degree())
                    .map(|c| c.dimension + idle.len());
            break;
        }
        let complex = complex_dimension(germ.equations(), germ.freedom(), germ.noise_by_degree());
        if isolated_by_leading_terms(germ.equations(), germ.noise_by_degree()) {
            evidence.push(Evidence {
                engine: "germ",
                scope: "a neighbourhood, real",
                bounds: (0, Some(idle.len())),
                text: format!(
                    "the lowest terms of the equations, of order {order}, have no common zero in series to degree {degree}{taken_out}"
                ),
            });
            "near this pose the closure equations have no other real solution: the lowest terms of what they leave over have none"
                .clone_into(&mut found.certificate);
            isolated(&mut found, &start)?;
            found.complex_dimension = complex.map(|c| c.dimension + idle.len());
            break;
        }
        let zeros = zeros_within(&germ, order, !rounded, &mut outermost, &mut allowance);
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
            text: format!(
                "{}{taken_out}",
                germ_text(&germ, order, degree, &zeros, complex.as_ref())
            ),
        });
        let cut = cut_in_pieces(&zeros, complex.as_ref())
            .or_else(|| merged(&germ, &zeros))
            .or_else(|| two_in_one(&germ, &zeros));
        let complex = complex.map(|c| c.dimension + idle.len());
        found.complex_dimension = complex;
        if let Some(thin) = &zeros.thin {
            why = refused(&mut evidence, thin.clone());
            if allowance == 0 {
                break;
            }
            continue;
        }
        if !agrees_with(&germ, &zeros) {
            let reason = "a quadratic form of full rank has other zeros than those found";
            why = refused(&mut evidence, reason.to_owned());
            continue;
        }
        if let Some(reason) = cut {
            why = refused(&mut evidence, reason.to_owned());
            continue;
        }
        if zeros.branches.is_empty() {
            // A search may miss what is thin or multiple: only a proof leaves nothing.
            if complex != Some(idle.len()) {
                why = refused(&mut evidence, NOT_PROVED.to_owned());
                unproved += 1;
                if unproved == UNPROVED {
                    break;
                }
                continue;
            }
            "near this pose the closure equations have no other solution, even over the complex numbers"
                .clone_into(&mut found.certificate);
            isolated(&mut found, &start)?;
            break;
        }
        match lift_all(&start, &germ, &zeros.branches)? {
            Ok(lifted) => {
                let pairs = lifted.iter().zip(&zeros.branches);
                if pairs.into_iter().any(|(l, b)| !l.shaky && !b.reduced) {
                    let reason = "a branch is a multiple zero of the power series and a simple one farther away, so that it may be several";
                    why = refused(&mut evidence, reason.to_owned());
                    continue;
                }
                let dimensions = lifted.iter().map(|l| l.branch.dimension);
                let top = dimensions.max().unwrap_or(0);
                if complex.is_some_and(|c| c < top) {
                    let reason =
                        "the dimension over the complex numbers contradicts the branches found";
                    why = refused(&mut evidence, reason.to_owned());
                    continue;
                }
                found.lower = top;
                // Where the complex dimension is larger real branches may have been overlooked, or there are none: y² + z² = 0.
                if let Some(complex) = complex.filter(|complex| *complex > top) {
                    let reason = format!(
                        "real branches of dimension {top} were found where the complex ones have {complex}"
                    );
                    why = refused(&mut evidence, reason);
                    unproved += 1;
                    if unproved == UNPROVED {
                        break;
                    }
                    continue;
                }
                let shapes: Vec<Shape> = lifted.iter().map(Shape::of).collect();
                let again = before.as_ref() == Some(&shapes);
                let multiple = lifted.iter().any(|l| l.shaky);
                before = Some(shapes);
                if !again && let Some(reason) = not_yet(complex.is_some(), multiple, rounded) {
                    why = refused(&mut evidence, reason.to_owned());
                    continue;
                }
                found.upper = top;
                let height = height_at(pose, part);
                let resolution = Resolution::of(&germ, height, is_computed(pose.mechanism, part));
                found.kind = kind_of(&lifted, &zeros.branches, &resolution);
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
    let mut decided = found.branches.is_some();
    // What double precision takes for multiple may be several that hardly differ, or a cusp.
    let multiple = |found: &PartFinding| {
        found.branches.iter().flatten().any(|branch| {
            let generic = branch.poses.first().and_then(|pose| pose.instantaneous);
            generic.is_some_and(|freedom| freedom > branch.dimension)
        })
    };
    let unsure = !decided || multiple(&found);
    if unsure && !rounded && rank.instantaneous == Some(2 + idle.len()) {
        match by_polygon(&mut found, &mut evidence, &start, &doubtful)? {
            None => decided = true,
            Some(_) if decided => {}
            Some(reason) => why = reason,
        }
    }
    if decided && multiple(&found) && !rounded {
        by_splitting(&mut found, &mut evidence, &start, &doubtful)?;
    }
    if !decided
        && !rounded
        && rank
            .instantaneous
            .is_some_and(|freedom| freedom > 2 + idle.len())
    {
        decided = by_form(&mut found, &mut evidence, &start, &doubtful)?
            || by_arrangement(&mut found, &mut evidence, &start, &doubtful)?
            || by_splitting(&mut found, &mut evidence, &start, &doubtful)?;
    }
    if !decided {
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

/// What two searches in series of different lengths have to agree on.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Shape {
    dimension: usize,
    shaky: bool,
}

impl Shape {
    fn of(lifted: &Lifted) -> Self {
        Self {
            dimension: lifted.branch.dimension,
            shaky: lifted.shaky,
        }
    }
}

/// Why one search does not suffice, if it does not.
fn not_yet(bounded: bool, multiple: bool, rounded: bool) -> Option<&'static str> {
    if !bounded {
        return Some("no dimension over the complex numbers confirms the branches found");
    }
    // Terms of higher degree may split what is multiple up to one degree.
    if multiple {
        return Some("a branch is multiple, and no longer series has confirmed it yet");
    }
    // Rounded numbers may open, or hide, what touches.
    rounded.then_some("the numbers are rounded, and no second search has found the same yet")
}

const NOT_PROVED: &str =
    "no other real solution was found near the pose, and nothing proves that there is none";

/// The zeros of a germ on spheres no larger than `outermost`, and on smaller ones where what shows inside differs from what shows
/// outside: what shows inside is the germ. No later search in exact numbers is made on larger spheres than an earlier one.
fn zeros_within(
    germ: &Germ,
    order: usize,
    exact: bool,
    outermost: &mut f64,
    allowance: &mut u64,
) -> GermZeros {
    let search = |outermost: f64, allowance: &mut u64| {
        let mut zeros = germ_zeros(
            germ.freedom(),
            germ.equations(),
            germ.noise(order),
            &GermZeroOptions {
                most_starts: most_starts(germ),
                outermost,
                work: *allowance,
                ..GermZeroOptions::default()
            },
        );
        *allowance = allowance.saturating_sub(zeros.work);
        join_pieces(germ, &mut zeros);
        zeros
    };
    let mut zeros = search(*outermost, allowance);
    let mut again = if germ.freedom() == 2 { SMALLER } else { 0 };
    let mut shrunk = false;
    while zeros.varies || (zeros.thin.is_none() && !agrees_with(germ, &zeros)) {
        shrunk = true;
        *outermost = zeros.radii.last().copied().unwrap_or(*outermost);
        if again == 0 || *allowance == 0 {
            return zeros;
        }
        again -= 1;
        zeros = search(*outermost, allowance);
    }
    // What rounded numbers leave open outweighs the equations on small spheres: the longer the series, the larger those that tell.
    if exact || shrunk {
        *outermost = zeros.radii.first().copied().unwrap_or(*outermost);
    }
    zeros
}

/// Whether what was found are the zeros of a quadratic form of full rank, where the germ is one up to a change of coordinates
/// (Morse's lemma); true of any other germ. Indefinite in two variables it is a pair of lines, in more a cone that is irreducible,
/// since only forms of rank two at most are products.
fn agrees_with(germ: &Germ, zeros: &GermZeros) -> bool {
    let Some((plus, minus)) = quadric(germ) else {
        return true;
    };
    let count = match (plus, minus) {
        (0, _) | (_, 0) => 0,
        (1, 1) => 2,
        _ => 1,
    };
    zeros.branches.len() == count
        && zeros
            .branches
            .iter()
            .all(|branch| branch.dimension + 1 == germ.freedom())
}

/// Sheets whose directions all lie in one linear space but for this share of their length may touch.
const TOUCHING: f64 = 0.05;

/// Why some of the branches found may be pieces of one, if they may.
fn cut_in_pieces(zeros: &GermZeros, complex: Option<&ComplexDimension>) -> Option<&'static str> {
    // Every branch of full dimension has a share of the multiplicity, at least one.
    if let Some(complex) = complex {
        let full = zeros
            .branches
            .iter()
            .filter(|b| b.dimension == complex.dimension);
        if full.count() > complex.multiplicity {
            return Some(
                "more branches were found than the multiplicity of the pose allows, so that some are parts of one",
            );
        }
    }
    // Sheets that meet in the pose only and have one tangent space there may be one, as z² = x⁴ + y⁴ is.
    let pairs = zeros
        .branches
        .iter()
        .enumerate()
        .flat_map(|(i, a)| zeros.branches[i + 1..].iter().map(move |b| (a, b)));
    let touch = |(a, b): (&GermBranch, &GermBranch)| {
        a.dimension > 1 && a.dimension == b.dimension && directions(a, b) <= a.dimension
    };
    pairs.into_iter().any(touch).then_some(
        "sheets were found that touch in the pose, and whether they are parts of one is not told",
    )
}

/// Why some of the branches of a plane curve may be several, or some be overlooked, if they may: the multiplicity of the curve is the
/// sum of its branches', and what is not real comes in conjugate pairs.
fn merged(germ: &Germ, zeros: &GermZeros) -> Option<&'static str> {
    if germ.freedom() != 2
        || germ.equations().len() != 1
        || !zeros.branches.iter().all(|branch| branch.reduced)
    {
        return None;
    }
    let found: Option<usize> = zeros
        .branches
        .iter()
        .map(|branch| branch.ramification)
        .sum();
    (found? % 2 != germ.order()? % 2).then_some(
        "the multiplicity of the pose is another than that of the branches found, so that some are overlooked or taken for one",
    )
}

/// Why the one sheet found may be two at a small angle, if it may: where the quadratic form is a product of two, the germ is u v + g of the
/// other variables (the splitting lemma), two sheets where g vanishes and one elsewhere.
fn two_in_one(germ: &Germ, zeros: &GermZeros) -> Option<&'static str> {
    let ([equation], [only]) = (germ.equations(), &zeros.branches[..]) else {
        return None;
    };
    let whole = germ.freedom() >= 3 && only.dimension + 1 == germ.freedom();
    let product = || inertia(equation, germ.noise(2)) == (1, 1);
    (whole && only.reduced && product() && !irreducible(germ))
        .then_some("one sheet was found, and two that cross at a small angle would look the same")
}

/// The dimension of the space that the directions of two branches span, but for a small share.
fn directions(a: &GermBranch, b: &GermBranch) -> usize {
    let tangents: Vec<&Vec<f64>> = a.tangents.iter().chain(&b.tangents).collect();
    let size = tangents.first().map_or(0, |t| t.len());
    if size == 0 {
        return 0;
    }
    let matrix = DMatrix::from_fn(tangents.len(), size, |i, j| tangents[i][j]);
    let values = matrix.singular_values();
    values
        .iter()
        .filter(|value| **value > TOUCHING * values.amax())
        .count()
}

/// The pieces of an irreducible hypersurface as one branch: they are joined through small parts of it that walking may miss, or touch in
/// the pose only.
fn join_pieces(germ: &Germ, zeros: &mut GermZeros) {
    let whole = zeros
        .branches
        .iter()
        .all(|branch| branch.dimension + 1 == germ.freedom());
    if !whole || germ.freedom() < 3 || zeros.branches.len() < 2 || !irreducible(germ) {
        return;
    }
    let mut pieces = std::mem::take(&mut zeros.branches).into_iter();
    let Some(mut one) = pieces.next() else { return };
    for piece in pieces {
        one.points.extend(piece.points);
        one.tangents.extend(piece.tangents);
        one.half_branches.extend(piece.half_branches);
        one.hits += piece.hits;
    }
    zeros.branches.push(one);
}

/// Whether a germ is one equation that is no product.
fn irreducible(germ: &Germ) -> bool {
    match germ.equations() {
        [equation] => {
            quadric(germ).is_some() || is_irreducible_hypersurface(equation, germ.noise_by_degree())
        }
        _ => false,
    }
}

/// The signature of the quadratic form of a germ of one equation, where it has full rank.
fn quadric(germ: &Germ) -> Option<(usize, usize)> {
    match germ.equations() {
        [equation] => signature(equation, germ.noise(2)),
        _ => None,
    }
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

/// Nothing moves but what is idle.
fn isolated(found: &mut PartFinding, start: &Start<'_>) -> Result<(), MatrixError> {
    let dimension = start.idle.len();
    found.lower = dimension;
    found.upper = dimension;
    if dimension == 0 {
        found.kind = Some(SingularKind::Shaky);
        found.branches = Some(Vec::new());
    } else {
        found.kind = Some(SingularKind::PermanentlyShaky);
        found.certificate.push_str("; only what is idle moves");
        found.branches = Some(vec![idle_branch(start)?]);
    }
    Ok(())
}

/// D7, from the branches through the pose.
fn kind_of(
    lifted: &[Lifted],
    zeros: &[GermBranch],
    resolution: &Resolution,
) -> Option<SingularKind> {
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
            [a, b] if angle(&a.tangent, &b.tangent) < 0.1 => Some(SingularKind::Cusp),
            _ => None,
        };
    }
    let line = |branch: &GermBranch| branch.half_branches.first().map(|h| h.tangent.clone());
    let lines: Option<Vec<Vec<f64>>> = zeros.iter().map(line).collect();
    let Some(lines) = lines else {
        return Some(SingularKind::Bifurcation);
    };
    // Which way a branch is run through does not matter.
    let widest = lines
        .iter()
        .map(|line| {
            let angle = angle(line, &lines[0]);
            angle.min(std::f64::consts::PI - angle)
        })
        .fold(0.0, f64::max);
    let unresolved = resolution.unresolved(lines.len());
    if widest < SAME_DIRECTION[0] && resolution.least > unresolved.max(SAME_DIRECTION[0]) {
        Some(SingularKind::Tangential)
    } else if widest > unresolved.max(SAME_DIRECTION[1]) {
        Some(SingularKind::Bifurcation)
    } else {
        None
    }
}

/// The angle between two unit vectors (rad), small ones without loss of digits.
fn angle(a: &[f64], b: &[f64]) -> f64 {
    let half: f64 = a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum();
    2.0 * (0.5 * half.sqrt()).min(1.0).asin()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
