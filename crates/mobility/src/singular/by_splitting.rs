//! Singular poses at which one equation is left over whose quadratic terms have rank two or more, by the splitting lemma in many digits.

use super::super::claim::{Answer, Bounds, Claim};
use super::super::germ::{Germ, inertia};
use super::super::germ_zeros::GermBranch;
use super::super::judge::PartFinding;
use super::super::leftover::{ABSOLUTE, Doubt, Leftover, ORDERS, power_of_two};
use super::super::lifting::{Start, lift_all};
use super::super::more_digits::MoreDigits;
use super::super::pose_rank::{PartRank, TALL, height_at};
use super::super::splitting_lemma::{
    Equation, Look, Rest, Squares, bits_of_squares, rest, squares,
};
use super::super::vocabulary::{EngineName, Scope, SingularKind};
use super::isolated;
use super::known_branches::{POINTS, RADII, cone, curve_along, scaled, sheet};
use kutzbach_math::matrix::{Extended, MatrixError, Real, Ring, SplitMix64};

/// Parts with more unknowns, or more coordinates free to first order, are not looked at.
const MOST_UNKNOWNS: usize = 80;
const MOST_VARIABLES: usize = 8;

/// A narrower form takes more digits than are worth while.
const NARROWEST: i64 = 200;

/// Whether equations are independent is looked at 2^−this from the pose, so that terms of [`ORDERS`] show.
const AWAY: i64 = 20;

/// From 2^(this − bits) on a value is not zero.
const CLEAR: i64 = 80;

/// Points near the pose at which rows are compared.
const PLACES: usize = 3;

/// What the equation says of the real branches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Germs {
    Isolated,
    /// A line along which the equation vanishes twice.
    Line,
    /// One branch of one dimension less.
    One,
    /// Two sheets that cross.
    Two,
}

/// Fills a finding where the numbers are exact and one equation is left over that tells; says whether it did.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn by_splitting(
    found: &mut PartFinding,
    start: &Start<'_>,
    rank: &PartRank,
) -> Result<bool, MatrixError> {
    match told(start) {
        Ok(Some(told)) => take(found, start, rank, told),
        _ => Ok(false),
    }
}

/// Fills a finding where many digits show squares that doubles do not: a search in doubles would take a narrow cone for what it is
/// narrow about.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn beyond_doubles(
    found: &mut PartFinding,
    start: &Start<'_>,
    rank: &PartRank,
) -> Result<bool, MatrixError> {
    let Some(germ) = Germ::of_part_across(start.pose.mechanism, rank, 2, start.idle)? else {
        return Ok(false);
    };
    let seen = match germ.equations() {
        [] => 0,
        [equation] => {
            let (plus, minus) = inertia(equation, germ.noise(2));
            plus + minus
        }
        _ => return Ok(false),
    };
    if seen == germ.freedom() {
        return Ok(false);
    }
    match told(start) {
        Ok(Some(told)) if told.1.across.len() > seen => take(found, start, rank, told),
        _ => Ok(false),
    }
}

/// Takes for an answer what the equation says.
fn take(
    found: &mut PartFinding,
    start: &Start<'_>,
    rank: &PartRank,
    (germs, squares, text): (Germs, Squares, String),
) -> Result<bool, MatrixError> {
    let idle = start.idle.len();
    let variables = squares.across.len() + squares.null.len();
    let (branches, dimension, certificate) = match germs {
        Germs::Isolated => (
            Vec::new(),
            0,
            "near this pose the closure equations have no other real solution: what they leave over is a sum of squares (splitting lemma)"
                .to_owned(),
        ),
        Germs::Line => (
            squares
                .null
                .iter()
                .map(|v| curve_along(v, false))
                .collect(),
            1,
            format!(
                "what the equations leave over is, to order {ORDERS}, a sum of squares that vanish along one line (splitting lemma)"
            ),
        ),
        Germs::One => (
            vec![sheet(
                variables - 1,
                cone(&squares.sizes, &squares.across, &squares.null),
            )],
            variables - 1,
            "what the equations leave over is one equation that is no product (splitting lemma), so that near this pose the solutions \
             are one branch"
                .to_owned(),
        ),
        Germs::Two => (
            sheets(&squares, variables - 1),
            variables - 1,
            format!(
                "what the equations leave over is, to order {ORDERS}, a product of two (splitting lemma), so that near this pose the \
                 solutions are two sheets that cross"
            ),
        ),
    };
    if germs == Germs::Isolated {
        found.take(isolated(
            start,
            EngineName::SplittingLemma,
            text,
            certificate,
        )?);
        return Ok(true);
    }
    let mut answer = Answer::numeric(certificate);
    answer.kind = match germs {
        Germs::Two => Some(SingularKind::Bifurcation),
        Germs::Line => Some(SingularKind::PermanentlyShaky),
        _ => None,
    };
    // The branches exist in any case. Where they lead is told if double precision distinguishes them.
    if let Some(germ) = Germ::of_part_across(start.pose.mechanism, rank, DEGREE, start.idle)?
        && let Ok(lifted) = lift_all(start, &germ, &branches)?
        && lifted.iter().all(|l| l.shaky == (germs == Germs::Line))
    {
        answer.branches = Some(lifted.into_iter().map(|l| l.branch).collect());
    }
    let finite = Bounds::exactly(dimension + idle);
    let claim = Claim::of(
        EngineName::SplittingLemma,
        Scope::RealNeighbourhood,
        finite,
        text,
    );
    found.take(claim.decides(answer));
    Ok(true)
}

/// Degree of the series by which points of branches are brought to the mechanism.
const DEGREE: usize = 4;

/// What the one equation left over says, its squares, and what was computed; `None` where it does not tell.
fn told(start: &Start<'_>) -> Result<Option<(Germs, Squares, String)>, Doubt> {
    if start.rank.unknowns() > MOST_UNKNOWNS {
        return Ok(None);
    }
    let tall = height_at(start.pose, start.part);
    let extra = if tall > TALL { tall as i64 } else { 0 };
    let mut more = MoreDigits::new();
    let bits = bits_of_squares(extra);
    let leftover = Leftover::at_pose(start, &mut more, bits)?;
    let variables = leftover.freedom();
    if !(3..=MOST_VARIABLES).contains(&variables) || leftover.equations() == 0 {
        return Ok(None);
    }
    let one = Extended::new(1.0, bits);
    let mut sole = Sole::of(leftover, &one)?;
    let row = sole.row;
    let squares = squares(&mut sole, variables, &one, start.rank.open_by_digits())?;
    if squares.across.len() < 2 || squares.narrow > NARROWEST {
        return Ok(None);
    }
    let (plus, minus) = squares.signature;
    let said = format!(
        "one equation in {variables} variables; quadratic terms of signature ({plus}, {minus}) in {bits} bits"
    );
    let definite = plus == 0 || minus == 0;
    if squares.null.is_empty() || (!definite && plus + minus >= 3) {
        let germs = if definite {
            Germs::Isolated
        } else {
            Germs::One
        };
        return Ok(Some((germs, squares, said)));
    }
    // What stated digits leave open is more than any term of higher order.
    if start.rank.open_by_digits() > 0.0 || (definite && squares.null.len() > 1) {
        return Ok(None);
    }
    let rest = rest_of(start, &squares, row, extra)?;
    let beyond = match rest {
        Rest::Zero => format!("what is left vanishes to order {ORDERS}"),
        Rest::Some(None) => "what is left does not vanish".to_owned(),
        Rest::Some(Some((order, _))) => format!("what is left is of order {order}"),
    };
    let germs = match rest {
        Rest::Zero if definite => Germs::Line,
        Rest::Zero => Germs::Two,
        Rest::Some(Some((_, signs))) if definite && signs == [plus > 0; 2] => Germs::Isolated,
        Rest::Some(_) => Germs::One,
    };
    Ok(Some((germs, squares, format!("{said}; {beyond}"))))
}

/// Forms narrower than 2^−this are looked at near the pose to a low order first, which takes fewer digits.
const NARROW: i64 = 12;
const FEW: i64 = 8;

/// What the squares of a row leave.
fn rest_of(start: &Start<'_>, squares: &Squares, row: usize, extra: i64) -> Result<Rest, Doubt> {
    let at = |look: Look| -> Result<Rest, Doubt> {
        let mut more = MoreDigits::new();
        let leftover = Leftover::at_pose(start, &mut more, look.bits)?;
        let near = Vec::new();
        rest(
            &mut Sole {
                leftover,
                row,
                near,
            },
            squares,
            look,
        )
    };
    if squares.narrow > NARROW {
        let first = at(squares.near(FEW, extra))?;
        if first != Rest::Zero || at(squares.farther(ORDERS, extra)) == Ok(Rest::Zero) {
            return Ok(first);
        }
    }
    at(squares.near(ORDERS, extra))
}

/// One row of what is left over, of which all others are multiples.
struct Sole<'a> {
    leftover: Leftover<'a>,
    row: usize,
    near: Vec<Extended>,
}

impl<'a> Sole<'a> {
    /// # Errors
    /// [`Doubt`] where several rows are independent, or none differs from zero.
    fn of(leftover: Leftover<'a>, one: &Extended) -> Result<Self, Doubt> {
        let away = power_of_two(one, -AWAY);
        let bits = i64::from(one.bits());
        let [zero, clear] = [ABSOLUTE, CLEAR].map(|power| power_of_two(one, power - bits));
        let mut random = SplitMix64::named("one equation left over");
        let mut values: Vec<Vec<Extended>> = Vec::new();
        for _ in 0..PLACES {
            let at: Vec<Extended> = (0..leftover.freedom())
                .map(|_| one.constant(random.symmetric()) * away.clone())
                .collect();
            values.push(leftover.evaluate_near(&mut Vec::new(), &at)?);
        }
        let row = (0..leftover.equations()).fold(0, |best, row| {
            if values[0][row].abs() > values[0][best].abs() {
                row
            } else {
                best
            }
        });
        if values.iter().any(|values| values[row].abs() < clear) {
            return Err(Doubt::Precision);
        }
        for other in 0..leftover.equations() {
            let share = values[0][other].clone() / values[0][row].clone();
            for values in &values {
                let left = values[other].clone() - share.clone() * values[row].clone();
                if left.abs() > zero {
                    return Err(Doubt::Arithmetic);
                }
            }
        }
        Ok(Self {
            leftover,
            row,
            near: Vec::new(),
        })
    }
}

impl Equation for Sole<'_> {
    fn value(&mut self, at: &[Extended]) -> Result<Extended, Doubt> {
        let left = self.leftover.evaluate_near(&mut self.near, at)?;
        left.get(self.row).cloned().ok_or(Doubt::Arithmetic)
    }
}

/// The two sheets of a product, along each of the lines and the null space.
fn sheets(squares: &Squares, dimension: usize) -> Vec<GermBranch> {
    let lines = squares.lines.iter().flatten();
    lines
        .map(|line| {
            let mut random = SplitMix64::named("sheet of a product");
            let mut direction = || {
                let mut sum = line.clone();
                for vector in &squares.null {
                    random.symmetric().add_scaled(vector, &mut sum);
                }
                sum
            };
            let points = RADII
                .iter()
                .flat_map(|radius| std::iter::repeat_n(*radius, POINTS))
                .map(|radius| scaled(&direction(), radius))
                .collect();
            sheet(dimension, points)
        })
        .collect()
}
