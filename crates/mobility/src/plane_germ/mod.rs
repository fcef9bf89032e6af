//! Germs in two variables of exact numbers: their real branches, by Newton's polygon in as many digits as it takes.
//!
//! Where two coordinates are free to first order, what the equations leave over is a plane curve, or a few. Its coefficients are
//! computed in hundreds of bits ([`Leftover`], [`taylor`]), so that zero and a billionth of a billionth differ clearly, and its
//! half-branches are separated by Newton's polygon ([`puiseux`]), each until a simple root shows that it is one and goes on. What
//! comes out holds on *every* small neighbourhood; no sphere is searched, so that an offset of 1e-9 is seen as what it is.
//!
//! A half-branch on which several independent equations vanish, as far as they are known, is a hint; all others are proved, up to the
//! margin with which coefficients are told from zero. What no computed term separates is one branch several times over where values of the
//! one equation say so ([`multiple`]), and left open elsewhere.
//!
//! Source: Newton–Puiseux, as in Brieskorn and Knörrer, *Plane Algebraic Curves*, §8.3; real branches and their pairing as there in
//! §8.4 with real roots only.
//!
//! Cost: a hundred evaluations of the equations and more in about a thousand bits, a third of a second for twenty joints.

mod fuzzy;
mod multiple;
mod polynomial;
mod puiseux;
mod taylor;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;

use crate::germ_zeros::{GermBranch, HalfBranch};
use crate::leftover::{Doubt, Grid, Leftover, Line, power_of_two};
use crate::lifting::Start;
use crate::more_digits::MoreDigits;
use crate::pose_rank::height_at;
use fuzzy::{derivative, value_at};
use kutzbach_math::matrix::{Extended, Real, SplitMix64};
use multiple::Cluster;
pub(super) use multiple::ORDERS;
use puiseux::{Half, half_branches, power};
use taylor::{Plane, series};

/// Degrees to which series are computed, one after the other while branches are not told apart.
const DEGREES: [usize; 5] = [7, 10, 13, 18, 24];

/// Where several equations are left, that all of them vanish along a half-branch is a matter of how many terms say so: the first degree
/// is for one equation only.
const OF_SEVERAL: usize = 10;

/// The last degrees computed are known least, and not used.
const GUARD: usize = 2;

/// The grid that series are computed on has points 2^−48 apart, finer by the bits of the longest number where these are many.
const FINENESS: usize = 48;

/// Parts with more unknowns are not looked at.
const MOST_UNKNOWNS: usize = 80;

/// Directions of which the one farthest from all tangents is taken for y.
const TURNS: usize = 16;

/// The real branches of a plane germ.
pub(super) struct PlaneCurve {
    /// Each once, with its half-branches and points at several distances, outermost first.
    pub branches: Vec<GermBranch>,
    /// Whether all branches have one tangent.
    pub tangential: bool,
    /// Whether it is one equation, so that every branch is proved to exist.
    pub sole: bool,
    /// The order at which the equations begin.
    pub order: usize,
    /// The degree to which their series were needed.
    pub degree: usize,
    /// The bits they were computed in.
    pub bits: u32,
}

/// The real branches through a pose where two coordinates but for idle ones are free to first order, of a part whose numbers are
/// exact. What stated digits leave open, such as the last one of printed doubles, counts as an error of all coefficients.
///
/// `thorough`: longer series are computed where the shortest do not tell.
///
/// # Errors
/// [`Doubt`], also of parts of other kinds.
pub(super) fn plane_curve(start: &Start<'_>, thorough: bool) -> Result<PlaneCurve, Doubt> {
    let tall = height_at(start.pose, start.part);
    let fineness = FINENESS
        + if tall > crate::pose_rank::TALL {
            tall
        } else {
            0
        };
    if start.rank.unknowns() > MOST_UNKNOWNS {
        return Err(Doubt::Arithmetic);
    }
    let mut doubt = Doubt::Multiple;
    let mut more = MoreDigits::new();
    let rank = start.rank;
    let reached = rank
        .instantaneous
        .and_then(|freedom| rank.unknowns().checked_sub(freedom));
    let several = reached.is_none_or(|reached| rank.equations() > reached + 1);
    let degrees = DEGREES
        .into_iter()
        .filter(|&degree| !several || degree >= OF_SEVERAL)
        .filter(|&degree| thorough || degree <= OF_SEVERAL);
    for degree in degrees {
        match to_degree(start, &mut more, degree, fineness) {
            Err(open @ (Doubt::Multiple | Doubt::Precision)) => doubt = open,
            other => return other,
        }
    }
    Err(doubt)
}

fn to_degree(
    start: &Start<'_>,
    more: &mut MoreDigits,
    degree: usize,
    fineness: usize,
) -> Result<PlaneCurve, Doubt> {
    let bits = u32::try_from(fineness * (degree + 4) + 64).map_err(|_| Doubt::Arithmetic)?;
    let leftover = Leftover::at_pose(start, more, bits)?;
    if leftover.freedom() != 2 || leftover.equations() == 0 {
        return Err(Doubt::Arithmetic);
    }
    let one = Extended::new(1.0, bits);
    let (mut rows, mut equations) = (Vec::new(), Vec::new());
    let mut before = Grid::default();
    let planes = series(&one, degree, fineness as i64, |y| {
        leftover.evaluate_next(&mut before, y)
    })?;
    for (row, plane) in planes.into_iter().enumerate() {
        let plane = plane
            .up_to(degree - GUARD)
            .blurred(start.rank.open_by_digits());
        if order_of(&plane)?.is_some() {
            rows.push(row);
            equations.push(plane);
        }
    }
    let Some(curve) = Curve::of(equations)? else {
        return Err(Doubt::Multiple);
    };
    let turn = curve.turn;
    curve.branches(fineness, degree, bits, |cluster| match rows[..] {
        [row] if start.rank.open_by_digits() == 0.0 => is_one(start, cluster, row, turn),
        _ => Ok(false),
    })
}

/// Whether half-branches that no term separates are one in all terms up to order [`ORDERS`](multiple::ORDERS).
fn is_one(
    start: &Start<'_>,
    cluster: &Cluster<'_>,
    row: usize,
    [a, b]: [f64; 2],
) -> Result<bool, Doubt> {
    let bits = cluster.bits();
    let mut more = MoreDigits::new();
    let leftover = Leftover::at_pose(start, &mut more, bits)?;
    let one = Extended::new(1.0, bits);
    let mut line = Line::default();
    cluster.is_one(&one, |[u, v], rest| {
        let share = |x: f64, of: &Extended| one.constant(x) * of.clone();
        let at = [share(a, &u) - share(b, &v), share(b, &u) + share(a, &v)];
        let left = leftover.evaluate_on(&mut line, rest, &at)?;
        left.get(row).cloned().ok_or(Doubt::Arithmetic)
    })
}

/// The lowest degree with a term; `None` where all vanish.
fn order_of(plane: &Plane<Extended>) -> Result<Option<usize>, Doubt> {
    for degree in 0..=plane.degree() {
        for c in plane.form(degree) {
            if !c.is_zero()? {
                return Ok(Some(degree));
            }
        }
    }
    Ok(None)
}

/// Plane equations, and a generic combination of them turned so that no branch is tangent to the y axis.
struct Curve {
    equations: Vec<Plane<Extended>>,
    combined: Plane<Extended>,
    order: usize,
    turn: [f64; 2],
}

impl Curve {
    /// `None` where there is no equation.
    fn of(equations: Vec<Plane<Extended>>) -> Result<Option<Self>, Doubt> {
        let mut random = SplitMix64::named("plane germ");
        let shares: Vec<f64> = match equations.len() {
            1 => vec![1.0],
            many => (0..many).map(|_| random.symmetric()).collect(),
        };
        let Some(combined) = Plane::combined(&equations, &shares) else {
            return Ok(None);
        };
        let Some(order) = order_of(&combined)? else {
            return Ok(None);
        };
        let form: Vec<f64> = combined
            .form(order)
            .iter()
            .map(|c| c.value.to_f64())
            .collect();
        // The value at (−b, a), where turning puts the term in y alone.
        let at = |[a, b]: [f64; 2]| -> f64 {
            let terms = form.iter().enumerate();
            let sum: f64 = terms
                .map(|(j, c)| c * (-b).powi((order - j) as i32) * a.powi(j as i32))
                .sum();
            sum.abs()
        };
        let turns = (0..TURNS).map(|k| {
            let angle = (k as f64 + 0.37) * std::f64::consts::PI / TURNS as f64;
            [angle.cos(), angle.sin()]
        });
        let turn = turns
            .max_by(|s, t| at(*s).total_cmp(&at(*t)))
            .unwrap_or([1.0, 0.0]);
        let combined = combined.turned(turn[0], turn[1]);
        let equations: Vec<Plane<Extended>> = equations
            .iter()
            .map(|plane| plane.turned(turn[0], turn[1]))
            .collect();
        Ok(Some(Self {
            equations,
            combined,
            order,
            turn,
        }))
    }

    /// The branches, where `is_one` says of what no term separates that it is one branch several times over.
    fn branches(
        &self,
        fineness: usize,
        degree: usize,
        bits: u32,
        mut is_one: impl FnMut(&Cluster<'_>) -> Result<bool, Doubt>,
    ) -> Result<PlaneCurve, Doubt> {
        let mut halves = Vec::new();
        for positive in [true, false] {
            let side = half_branches(&self.combined, self.order, positive)?;
            halves.extend(side);
        }
        let mut vanishing = Vec::with_capacity(halves.len());
        for half in &halves {
            if self.vanish_along(half, fineness)? {
                vanishing.push(half.clone());
            }
        }
        let pairs = self.paired(&vanishing)?;
        // What is multiple on one side of the origin is on the other, where it goes on.
        for half in pairs.iter().map(|[first, _]| &vanishing[*first]) {
            let cluster = Cluster::new(half, &halves, self.order);
            if cluster.is_doubtful() && !is_one(&cluster)? {
                return Err(Doubt::Multiple);
            }
        }
        let one = self.combined.one();
        let mut tangential = true;
        if let Some(first) = vanishing.first() {
            for half in &vanishing {
                let apart = half.slope(&one).minus(&first.slope(&one));
                tangential &= apart.is_zero()?;
            }
        }
        let branches = pairs
            .iter()
            .map(|pair| self.branch(&vanishing, *pair))
            .collect();
        Ok(PlaneCurve {
            branches,
            tangential,
            sole: self.equations.len() == 1,
            order: self.order,
            degree: degree - GUARD,
            bits,
        })
    }

    /// Whether all equations vanish along a half-branch of their combination, as far as they are known.
    fn vanish_along(&self, half: &Half<Extended>, fineness: usize) -> Result<bool, Doubt> {
        if self.equations.len() == 1 {
            return Ok(true);
        }
        let one = self.combined.one();
        let degree = self.combined.degree();
        // So near that what is cut off lies above the error of the coefficients.
        let exponent = (5 * fineness / 2 / degree).max(2) as i64;
        let exponent = exponent / half.ramification() as i64 + 1;
        let t = power_of_two(&one, -exponent);
        let Some([x, y]) = self.refined(half, &t) else {
            return Err(Doubt::Precision);
        };
        let rest = power(&x.abs(), degree + 1 - GUARD);
        let clear = power(&x.abs(), degree.saturating_sub(2 * GUARD));
        let mut all = true;
        for plane in &self.equations {
            let left = value_at(&plane.at_x(&x), &y).value.abs();
            if left >= clear {
                all = false;
            } else if left > rest {
                return Err(Doubt::Multiple);
            }
        }
        Ok(all)
    }

    /// A point of a half-branch at a parameter, brought onto the combined equation by Newton's method; `None` where that leads away.
    fn refined(&self, half: &Half<Extended>, t: &Extended) -> Option<[Extended; 2]> {
        let [x, start] = half.point(t);
        // What is multiple is a simple zero of a derivative.
        let mut row = self.combined.at_x(&x);
        for _ in 1..half.multiplicity {
            row = derivative(&row);
        }
        let slope = derivative(&row);
        let mut y = start.clone();
        for _ in 0..60 {
            let step = value_at(&row, &y).value / value_at(&slope, &y).value;
            if !step.is_finite() {
                return None;
            }
            y = y - step.clone();
            if step.abs() <= power_of_two(&x, -(i64::from(x.bits()) / 2)) {
                return Some([x, y]);
            }
        }
        None
    }

    /// Half-branches that continue one another.
    fn paired(&self, halves: &[Half<Extended>]) -> Result<Vec<[usize; 2]>, Doubt> {
        let mut pairs = Vec::new();
        let mut taken = vec![false; halves.len()];
        for index in 0..halves.len() {
            if taken[index] {
                continue;
            }
            let wanted = halves[index].opposite();
            let mut partner = None;
            for (other, half) in halves.iter().enumerate().skip(index + 1) {
                if !taken[other] && half.is(&wanted)? {
                    partner = Some(other);
                }
            }
            // A real branch leads through the origin: what has no other half was not found whole.
            let other = partner.ok_or(Doubt::Precision)?;
            (taken[index], taken[other]) = (true, true);
            pairs.push([index, other]);
        }
        Ok(pairs)
    }

    /// A branch with points where its halves still lie beside the other half-branches as they do near the origin.
    fn branch(&self, all: &[Half<Extended>], pair: [usize; 2]) -> GermBranch {
        let paths = pair.map(|index| self.path(all, index));
        let one = self.combined.one();
        let tangent = |half: &Half<Extended>| {
            let slope = half.slope(&one).value.to_f64();
            let side = if half.positive { 1.0 } else { -1.0 };
            let length = slope.hypot(1.0);
            self.back([side / length, side * slope / length])
        };
        let tangents = pair.map(|index| tangent(&all[index]));
        let half_branches = paths
            .iter()
            .zip(&tangents)
            .map(|(path, tangent)| HalfBranch {
                point: path.first().cloned().unwrap_or_default(),
                tangent: tangent.clone(),
                path: path.clone(),
            })
            .collect();
        let longest = paths.iter().map(Vec::len).max().unwrap_or(0);
        let points = (0..longest)
            .flat_map(|i| paths.iter().filter_map(move |path| path.get(i).cloned()))
            .collect();
        GermBranch {
            dimension: 1,
            half_branches,
            points,
            tangents: tangents.to_vec(),
            ramification: Some(all[pair[0]].ramification()),
            reduced: all[pair[0]].multiplicity == 1,
            vanishing_order: None,
            hits: 0,
        }
    }

    /// Points of a half-branch, outermost first, while it keeps its place among the others on its side.
    fn path(&self, all: &[Half<Extended>], index: usize) -> Vec<Vec<f64>> {
        let half = &all[index];
        let one = self.combined.one();
        let mut path = Vec::new();
        for step in 0..OUTWARD {
            // |x| from one half inwards.
            let x = 0.5 * 0.75f64.powi(step);
            let Some([x, y]) = self.at(half, &one, x) else {
                continue;
            };
            let in_place = all
                .iter()
                .enumerate()
                .filter(|(i, other)| *i != index && other.positive == half.positive)
                .all(|(_, other)| self.ordered(half, other, &one, x.abs(), &y));
            if in_place {
                path.push(self.back([x.to_f64(), y.to_f64()]));
            }
        }
        path
    }

    /// The point of a half-branch at a distance |x|.
    fn at(&self, half: &Half<Extended>, one: &Extended, x: f64) -> Option<[Extended; 2]> {
        let t = x.powf(1.0 / half.ramification() as f64);
        self.refined(half, &one.constant(t))
    }

    /// Whether a point of a half-branch lies on the same side of another as near the origin.
    fn ordered(
        &self,
        half: &Half<Extended>,
        other: &Half<Extended>,
        one: &Extended,
        x: Extended,
        y: &Extended,
    ) -> bool {
        let near = |half: &Half<Extended>| self.at(half, one, NEAR);
        let (Some([_, own]), Some([_, its])) = (near(half), near(other)) else {
            return false;
        };
        let Some([_, there]) = self.at(other, one, x.to_f64()) else {
            return true;
        };
        (own > its) == (*y > there) && *y != there
    }

    /// From turned coordinates to those of the kernel.
    fn back(&self, [u, v]: [f64; 2]) -> Vec<f64> {
        let [a, b] = self.turn;
        vec![a * u - b * v, b * u + a * v]
    }
}

/// Distances at which points of a branch are looked for.
const OUTWARD: i32 = 40;

/// So near the origin half-branches are in the order that they begin with.
const NEAR: f64 = 1e-9;
