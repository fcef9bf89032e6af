//! From points on spheres to branches of the germ.

use super::correct::{Landing, Within, land};
use super::local::local;
use super::pairing::{Pair, continuation, pair};
use super::search::Search;
use super::sheets::slice_through;
use super::small::{distance, plus, unit};
use super::system::{Level, System};
use super::track::{fitted_slope, inwards, vanishing_order};
use super::{GermBranch, GermZeroOptions, GermZeros, HalfBranch, Isolation};
use kutzbach_math::group::Series;

/// Points kept of a branch of dimension two or more.
const SAMPLES: usize = 6;

/// The real zeros of a polynomial germ near the origin.
///
/// `equations` are the components of κ in `variables` variables, all of one shape; an empty slice stands for no
/// condition. Constant terms are ignored: the origin is a zero by assumption. `noise` is the absolute accuracy of every
/// coefficient; smaller ones are taken as zero. Leading forms may have any degree from 1.
///
/// An answer to coefficients that are not finite, or to series of the wrong number of variables, has no branch, no
/// isolation and says why in [`GermZeros::thin`].
pub fn germ_zeros(
    variables: usize,
    equations: &[Series],
    noise: f64,
    options: &GermZeroOptions,
) -> GermZeros {
    let mut answer = GermZeros {
        branches: Vec::new(),
        isolation: None,
        starts: 0,
        seed: options.seed,
        radii: Vec::new(),
        thin: None,
        work: 0,
        varies: false,
    };
    let finite = |series: &Series| series.coefficients().iter().all(|c| c.is_finite());
    let shape = |series: &Series| {
        series.monomials().variables() == variables
            && series.monomials().degree() == equations[0].monomials().degree()
    };
    if !(noise >= 0.0 && noise.is_finite() && equations.iter().all(finite)) {
        answer.thin = Some("a coefficient or its noise is not a finite number".into());
        return answer;
    }
    if !equations.iter().all(shape) {
        answer.thin = Some(format!(
            "not all equations are series in {variables} variables"
        ));
        return answer;
    }
    if variables == 0 {
        return answer;
    }
    match System::new(equations, noise, options.largest_radius) {
        None => answer
            .branches
            .push(whole_space(variables, options, &mut answer.radii)),
        Some(system) if variables == 1 => {
            // The only zero near the origin is the origin.
            let (order, _) = system.lowest();
            answer.isolation = Some(Isolation {
                factor: system.radius.powi(-(order as i32)),
                order: order as f64,
            });
        }
        Some(system) => {
            system.allow(options.work);
            let mut search = Search::new(&system, options);
            search.run(options);
            if system.left() > 0 {
                merge_inseparable(&mut search);
                join_by_slices(&mut search, options);
            }
            collect(&mut search, &mut answer);
            answer.work = system.spent();
        }
    }
    answer
}

/// No equation: everything near the origin is a zero.
fn whole_space(variables: usize, options: &GermZeroOptions, radii: &mut Vec<f64>) -> GermBranch {
    let outer = 0.2 * options.largest_radius;
    *radii = vec![outer];
    let axis = |i: usize, sign: f64| -> Vec<f64> {
        (0..variables)
            .map(|j| if i == j { sign } else { 0.0 })
            .collect()
    };
    let directions: Vec<Vec<f64>> = (0..variables)
        .flat_map(|i| [axis(i, 1.0), axis(i, -1.0)])
        .collect();
    let at = |z: &Vec<f64>| z.iter().map(|x| outer * x).collect::<Vec<f64>>();
    let half_branches = if variables == 1 {
        let half = |z: &Vec<f64>| HalfBranch {
            point: at(z),
            tangent: z.clone(),
            path: vec![at(z)],
        };
        directions.iter().map(half).collect()
    } else {
        Vec::new()
    };
    GermBranch {
        dimension: variables,
        half_branches,
        points: directions.iter().map(at).collect(),
        tangents: directions,
        ramification: (variables == 1).then_some(1),
        reduced: true,
        vanishing_order: None,
        hits: 0,
    }
}

/// Two half-branches so close that the equations vanish half-way between them as well as they are known are one, counted
/// twice.
fn merge_inseparable(search: &mut Search<'_>) {
    let mut i = 0;
    while i < search.halves.len() {
        let mut j = i + 1;
        while j < search.halves.len() {
            let middles: Vec<Vec<f64>> = search.halves[i]
                .track
                .z
                .iter()
                .zip(&search.halves[j].track.z)
                .map(|(a, b)| unit(plus(a, 1.0, b)))
                .collect();
            let ends = [i, j].map(|k| &search.halves[k].track.z[0]);
            let near = distance(ends[0], ends[1]) < 0.1;
            if near && vanishes(search, &middles) {
                let twin = search.halves.remove(j);
                search.halves[i].hits += twin.hits;
                search.halves[i].reduced = false;
            } else {
                j += 1;
            }
        }
        i += 1;
    }
}

fn vanishes(search: &mut Search<'_>, directions: &[Vec<f64>]) -> bool {
    let residuals: Vec<(f64, f64)> = search
        .radii
        .iter()
        .zip(directions)
        .map(|(radius, z)| {
            let level = Level::new(search.system, *radius);
            level.evaluate(z, &mut search.work);
            let values = &search.work.values;
            (level.above_noise(values), level.absolute(values))
        })
        .collect();
    vanishing_order(&search.radii, &residuals, search.system.degree()).is_some()
}

/// Joins pieces that meet only at the origin.
fn join_by_slices(search: &mut Search<'_>, options: &GermZeroOptions) {
    let variables = search.system.variables();
    for slot in 0..search.sheets.len() {
        let dimension = search.sheets[slot].dimension;
        for piece in search.sheets[slot].pieces() {
            for attempt in 0..3 {
                if search.sheets[slot].pieces().len() < 2
                    || variables + 1 - dimension < 2
                    || search.system.left() == 0
                {
                    break;
                }
                // Near a crossing a slice has a second curve close by.
                let mut members: Vec<_> = search.sheets[slot].of_piece(piece).collect();
                members.sort_by(|a, b| b.regularity.total_cmp(&a.regularity));
                let Some(z) = members.get(attempt).map(|m| m.z.clone()) else {
                    break;
                };
                let basis = slice_through(&z, dimension, &mut search.random);
                join_along(search, slot, piece, &basis, options);
            }
        }
    }
}

/// Joins the pieces that the two half-branches through the first basis vector of a slice lie on.
fn join_along(
    search: &mut Search<'_>,
    slot: usize,
    piece: usize,
    basis: &[Vec<f64>],
    options: &GermZeroOptions,
) {
    let outer = search.radii[0];
    // The slice's own outermost radius shall be the one at which the pieces are known.
    let Some(system) = search.system.restricted(basis, search.system.radius) else {
        return;
    };
    system.allow(search.system.left());
    let mut inner = Search::new(&system, options);
    let ratio = outer / inner.radii[0];
    inner.radii.iter_mut().for_each(|r| *r *= ratio);
    inner.run(options);
    search.system.spend(system.spent());
    let through = inner
        .halves
        .iter()
        .position(|half| half.track.z[0][0] > 1.0 - 1e-6);
    let (pairs, _) = paired(&inner);
    let Some(pair) = pairs
        .iter()
        .find(|p| Some(p.halves[0]) == through || Some(p.halves[1]) == through)
    else {
        return;
    };
    let other = pair.halves[usize::from(Some(pair.halves[0]) == through)];
    let mut start = vec![0.0; search.system.variables()];
    for (direction, x) in basis.iter().zip(&inner.halves[other].track.z[0]) {
        start = plus(&start, *x, direction);
    }
    let level = Level::new(search.system, outer);
    let landed = land(&level, &start, &Within::Sphere, 40, &mut search.work);
    let kind = local(&level, &landed, &mut search.random, &mut search.work);
    let sheets = &mut search.sheets[slot];
    if landed.above_truncation > 1.0 || kind.dimension != sheets.dimension {
        return;
    }
    let mut pieces = sheets.reached(
        &level,
        &landed.z,
        &kind.tangent,
        kind.reduced,
        &mut search.work,
    );
    pieces.insert(0, piece);
    sheets.join(&pieces);
}

fn paired(search: &Search<'_>) -> (Vec<Pair>, Vec<usize>) {
    let tracks: Vec<&[Vec<f64>]> = search.halves.iter().map(|h| &h.track.z[..]).collect();
    // y = (t^m, …, t^n) with n > m is no zero of equations of degree below m.
    let accuracies: Vec<f64> = search
        .halves
        .iter()
        .map(|half| if half.reduced { 1e-10 } else { half.same })
        .collect();
    pair(
        &tracks,
        &accuracies,
        &search.radii,
        search.system.degree().clamp(1, 5),
    )
}

fn collect(search: &mut Search<'_>, answer: &mut GermZeros) {
    answer.starts = search.starts;
    answer.radii.clone_from(&search.radii);
    let mut sheets = collect_sheets(search);
    let (pairs, left) = paired(search);
    let mut curves: Vec<GermBranch> = pairs.iter().map(|p| curve(search, p)).collect();
    if pairs.iter().any(|p| p.ambiguous) {
        search
            .doubts
            .push("which half-branches belong together is ambiguous".into());
    }
    for index in left {
        let half = half_branch(search, index, None);
        let continued = continues_sheet(search, index);
        let nearest = continued.and_then(|z| {
            let to = |points: &[Vec<f64>]| gap(points, &z);
            sheets
                .iter_mut()
                .min_by(|a, b| to(&a.1).total_cmp(&to(&b.1)))
        });
        if let Some((branch, _)) = nearest {
            branch.half_branches.push(half);
            continue;
        }
        // Its partner may end between the spheres.
        search.varies = true;
        search
            .doubts
            .push("a half-branch has no continuation through the origin".into());
        let found = &search.halves[index];
        curves.push(GermBranch {
            dimension: 1,
            points: vec![half.point.clone()],
            tangents: vec![half.tangent.clone()],
            half_branches: vec![half],
            ramification: None,
            reduced: found.reduced,
            vanishing_order: found.track.order,
            hits: found.hits,
        });
    }
    answer.branches = sheets.into_iter().map(|(branch, _)| branch).collect();
    answer
        .branches
        .sort_by_key(|b| std::cmp::Reverse(b.dimension));
    answer.branches.append(&mut curves);
    if answer.branches.is_empty() {
        answer.isolation = Some(isolation(search));
    }
    answer.varies = search.varies;
    if search.system.left() == 0 {
        search
            .doubts
            .push("the search took more work than it may".into());
    }
    search.doubts.dedup();
    if !search.doubts.is_empty() {
        answer.thin = Some(search.doubts.join("; "));
    }
}

fn gap(points: &[Vec<f64>], z: &[f64]) -> f64 {
    points
        .iter()
        .map(|p| distance(p, z))
        .fold(f64::INFINITY, f64::min)
}

fn scaled(z: &[f64], radius: f64) -> Vec<f64> {
    z.iter().map(|x| radius * x).collect()
}

/// A half-branch; without a fit the direction at the innermost radius stands for its tangent.
fn half_branch(search: &Search<'_>, index: usize, tangent: Option<Vec<f64>>) -> HalfBranch {
    let z = &search.halves[index].track.z;
    let path: Vec<Vec<f64>> = z
        .iter()
        .zip(&search.radii)
        .map(|(z, radius)| scaled(z, *radius))
        .collect();
    HalfBranch {
        point: path[0].clone(),
        tangent: tangent.unwrap_or_else(|| z[z.len() - 1].clone()),
        path,
    }
}

fn curve(search: &Search<'_>, pair: &Pair) -> GermBranch {
    let sign = if pair.ramification % 2 == 1 {
        -1.0
    } else {
        1.0
    };
    let tangents = vec![pair.tangent.clone(), scaled(&pair.tangent, sign)];
    let half_branches: Vec<HalfBranch> = pair
        .halves
        .iter()
        .zip(&tangents)
        .map(|(index, tangent)| half_branch(search, *index, Some(tangent.clone())))
        .collect();
    let halves = pair.halves.map(|i| &search.halves[i]);
    let order = halves[0]
        .track
        .order
        .into_iter()
        .chain(halves[1].track.order);
    GermBranch {
        dimension: 1,
        points: half_branches.iter().map(|h| h.point.clone()).collect(),
        half_branches,
        tangents,
        ramification: Some(pair.ramification),
        reduced: halves[0].reduced && halves[1].reduced,
        vanishing_order: order.reduce(f64::min),
        hits: halves[0].hits + halves[1].hits,
    }
}

/// Whether the analytic continuation of a half-branch lies in the zero set without being a half-branch of dimension 1:
/// the point at the innermost radius.
fn continues_sheet(search: &mut Search<'_>, index: usize) -> Option<Vec<f64>> {
    let radius = search.radii[search.radii.len() - 1];
    let z = continuation(&search.halves[index].track.z, &search.radii);
    let level = Level::new(search.system, radius);
    let landed = land(&level, &z, &Within::Sphere, 60, &mut search.work);
    // A half-branch there would be the partner that pairing refused.
    let innermost = search.radii.len() - 1;
    let taken =
        |half: &super::search::Half| distance(&half.track.z[innermost], &landed.z) < half.same;
    let free = !search.halves.iter().any(taken);
    (free && landed.above_truncation <= 1.0 && distance(&landed.z, &z) < 1e-2).then_some(landed.z)
}

/// The branches of dimension two and more, each with all its points as unit directions.
fn collect_sheets(search: &mut Search<'_>) -> Vec<(GermBranch, Vec<Vec<f64>>)> {
    let outer = search.radii[0];
    let mut branches = Vec::new();
    for slot in 0..search.sheets.len() {
        for piece in search.sheets[slot].pieces() {
            let sheets = &search.sheets[slot];
            let dimension = sheets.dimension;
            let own: Vec<_> = sheets.of_piece(piece).cloned().collect();
            let others: Vec<Vec<f64>> = search
                .sheets
                .iter()
                .flat_map(|s| {
                    s.members
                        .iter()
                        .filter(move |m| {
                            s.dimension != dimension
                                || !s.of_piece(piece).any(|o| std::ptr::eq(o, *m))
                        })
                        .map(|m| m.z.clone())
                })
                .chain(search.halves.iter().map(|h| h.track.z[0].clone()))
                .collect();
            let reduced = own.iter().any(|m| m.reduced);
            let samples = spread(&own, &others);
            let rank = reduced.then_some(search.system.variables() - dimension);
            let mut tangents = Vec::new();
            let mut order: Option<f64> = None;
            for z in &samples {
                let level = Level::new(search.system, outer);
                level.evaluate(z, &mut search.work);
                let landing = Landing {
                    z: z.clone(),
                    above_noise: level.above_noise(&search.work.values),
                    above_truncation: 0.0,
                    size: 0.0,
                };
                let radii = search.radii.clone();
                if let Some(track) =
                    inwards(search.system, &radii, &landing, rank, &mut search.work)
                {
                    tangents.extend(track.z.last().cloned());
                    order = match (order, track.order) {
                        (Some(a), Some(b)) => Some(a.min(b)),
                        (a, b) => a.or(b),
                    };
                }
            }
            let branch = GermBranch {
                dimension,
                half_branches: Vec::new(),
                points: samples.iter().map(|z| scaled(z, outer)).collect(),
                tangents,
                ramification: None,
                reduced,
                vanishing_order: order,
                hits: own.len(),
            };
            branches.push((branch, own.into_iter().map(|m| m.z).collect()));
        }
    }
    branches
}

/// Some points that are far from the other branches and from each other.
fn spread(own: &[super::sheets::Member], others: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let regular = |m: &&super::sheets::Member| m.reduced || own.iter().all(|o| !o.reduced);
    let clearance = |m: &super::sheets::Member| match m.regularity {
        0.0 => gap(others, &m.z),
        regularity => gap(others, &m.z).min(regularity),
    };
    let mut candidates: Vec<&super::sheets::Member> = own.iter().filter(regular).collect();
    // The half that is farthest from everything else, then by turns the one farthest from those taken.
    candidates.sort_by(|a, b| clearance(b).total_cmp(&clearance(a)));
    candidates.truncate(candidates.len().div_ceil(2).max(SAMPLES));
    let candidates: Vec<&Vec<f64>> = candidates.into_iter().map(|m| &m.z).collect();
    let mut taken: Vec<Vec<f64>> = Vec::new();
    while taken.len() < SAMPLES && taken.len() < candidates.len() {
        let next = candidates
            .iter()
            .max_by(|a, b| gap(&taken, a).total_cmp(&gap(&taken, b)));
        match next {
            Some(z) if gap(&taken, z) > 0.0 => taken.push((*z).clone()),
            _ => break,
        }
    }
    taken
}

/// Fits the smallest values on three spheres to one power of the radius.
fn isolation(search: &mut Search<'_>) -> Isolation {
    let last = search.radii.len() - 1;
    let mut hints = Vec::new();
    let mut points = Vec::new();
    for index in [last, last / 2, 0] {
        let radius = search.radii[index];
        let (size, z) = search.smallest(radius, 60, &hints);
        hints.push(z);
        points.push((radius.ln(), size.max(f64::MIN_POSITIVE).ln()));
    }
    points.reverse();
    let order = fitted_slope(&points);
    let slopes: Vec<f64> = points.windows(2).map(fitted_slope).collect();
    if (slopes[0] - slopes[1]).abs() > 0.5 {
        search.varies = true;
        search.doubts.push(format!(
            "the equations grow with order {:.1} at larger and {:.1} at smaller radii",
            slopes[0], slopes[1]
        ));
    }
    if order > search.system.degree() as f64 + 0.5 {
        search
            .doubts
            .push("the equations grow more slowly than the truncation can tell".into());
    }
    let factor = points
        .iter()
        .map(|(r, size)| (size - order * r).exp())
        .fold(f64::INFINITY, f64::min);
    Isolation { factor, order }
}
