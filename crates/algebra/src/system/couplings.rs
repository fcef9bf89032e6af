//! Couplings as polynomials: equal angles by equal points on the circle, equal ways by linear equations.
//!
//! Σ nᵢ θᵢ = offset with rational nᵢ is multiplied by the common denominator and divided by the greatest common divisor, so
//! that the Nᵢ are coprime integers. Then exp(i Σ Nᵢ θᵢ) = exp(i · offset) holds exactly where some whole turns added to
//! the θᵢ satisfy the coupling. Poses a turn of one joint apart are one point of the variables, so that positions which
//! the gears reach only after turns of the joints, if at all, are among the solutions: further assembly modes.

use super::displacement::Displacement;
use super::element::Element;
use super::field::Field;
use super::fraction::{Fraction, lcm, size};
use super::poly::Poly;
use super::space::{Polynomials, Scalars};
use dashu_base::Gcd;
use dashu_int::UBig;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Coupling, CouplingTerm, FreedomPart, Mechanism};

/// Largest sum of the sizes of the multiples.
const MAX_MULTIPLE: i64 = 24;

/// The equations of a coupling, or why it is left out.
pub(super) fn equations(
    field: &mut Field,
    mechanism: &Mechanism,
    coupling: &Coupling,
    displacements: &[Displacement],
) -> Result<Vec<Poly>, String> {
    let squared = |term: &CouplingTerm| !term.higher.is_empty();
    let part = |joint: usize| mechanism.joints()[joint].kind.freedoms().first().copied();
    let slides = coupling
        .terms
        .iter()
        .filter(|term| part(term.joint.0) == Some(FreedomPart::Translation))
        .count();
    if slides == coupling.terms.len() {
        ways(field, coupling, displacements).map(|equation| vec![equation])
    } else if coupling
        .terms
        .iter()
        .any(|t| squared(t) && part(t.joint.0) != Some(FreedomPart::Translation))
    {
        Err("it has a power of an angle, which is no algebraic relation".to_owned())
    } else if slides == 0 {
        angles(field, coupling, displacements)
    } else {
        Err("it ties an angle to a length, which is no algebraic relation".to_owned())
    }
}

fn not_algebraic(number: &Number) -> String {
    format!("its number {} is not algebraic", number.source())
}

fn ways(
    field: &mut Field,
    coupling: &Coupling,
    displacements: &[Displacement],
) -> Result<Poly, String> {
    let read =
        |field: &mut Field, number: &Number| field.read(number).map_err(|_| not_algebraic(number));
    let offset = read(field, &coupling.offset)?;
    let mut sum = Poly::constant(offset.negated());
    for term in &coupling.terms {
        let Some((way, square)) = &displacements[term.joint.0].slide else {
            return Err("a joint of it has no variable of its own".to_owned());
        };
        let unit = field
            .root(square)
            .map_err(|_| "its numbers lie in a field of too high a degree".to_owned())?;
        let travel = Poly::variable(*way).scaled(&unit, field);
        let mut power = travel.clone();
        for (index, factor) in term.factors().enumerate() {
            if index > 0 {
                power = power.times(&travel, field);
            }
            let factor = read(field, factor)?;
            sum = sum.plus(&power.scaled(&factor, field));
        }
    }
    Ok(sum)
}

/// The multiples Nᵢ and what the offset is multiplied by.
pub(super) fn coprime_multiples(coupling: &Coupling) -> Result<(Vec<i64>, Fraction), String> {
    let factors = coupling
        .terms
        .iter()
        .map(|term| {
            let x = term.factor.rational().cloned();
            x.ok_or_else(|| match term.factor.open_name() {
                Some(name) => format!("its ratio depends on `{name}`, which is left open"),
                None => format!("its ratio {} is not rational", term.factor.source()),
            })
        })
        .collect::<Result<Vec<Fraction>, String>>()?;
    let denominator = factors
        .iter()
        .fold(UBig::ONE, |all, x| lcm(&all, x.denominator()));
    let common = factors.iter().fold(UBig::ZERO, |all, x| {
        let whole = size(&(x * Fraction::from(denominator.clone())));
        if all == UBig::ZERO {
            whole
        } else if whole == UBig::ZERO {
            all
        } else {
            all.gcd(&whole)
        }
    });
    if common == UBig::ZERO {
        return Err("all its ratios are zero".to_owned());
    }
    let scale = Fraction::from_parts(denominator.into(), common);
    let multiples: Option<Vec<i64>> = factors
        .iter()
        .map(|x| i64::try_from((x * &scale).numerator().clone()).ok())
        .collect();
    let multiples = multiples
        .filter(|n| n.iter().fold(0i64, |sum, x| sum.saturating_add(x.abs())) <= MAX_MULTIPLE)
        .ok_or_else(|| {
            format!("its ratios as integers add up to more than {MAX_MULTIPLE}, which gives polynomials of too high a degree")
        })?;
    Ok((multiples, scale))
}

fn angles(
    field: &mut Field,
    coupling: &Coupling,
    displacements: &[Displacement],
) -> Result<Vec<Poly>, String> {
    let (multiples, scale) = coprime_multiples(coupling)?;
    let offset = Number::of_fraction(scale) * &coupling.offset;
    let point = field.point(&offset).map_err(|_| {
        format!(
            "its offset {} has no algebraic cosine",
            coupling.offset.source()
        )
    })?;
    // Negative multiples go to the other side, with the offset: that halves the degree.
    let mut sides = [
        (Poly::constant(Element::integer(1)), Poly::default()),
        (Poly::constant(point.0), Poly::constant(point.1)),
    ];
    for (term, &multiple) in coupling.terms.iter().zip(&multiples) {
        let Some((cosine, sine, axis)) = &displacements[term.joint.0].turn else {
            return Err("a joint of it has no variable of its own".to_owned());
        };
        let length = field
            .root(&axis.square)
            .map_err(|_| "its numbers lie in a field of too high a degree".to_owned())?;
        let ring = Polynomials(field);
        let c = Poly::variable(*cosine);
        let square = ring
            .minus(&ring.integer(1), &ring.times(&c, &c))
            .scaled(&axis.inverse_square, field);
        let step = (c, Poly::variable(*sine).scaled(&length, field));
        let side = &mut sides[usize::from(multiple.is_negative())];
        for _ in 0..multiple.unsigned_abs() {
            let (x, y) = (&side.0, &side.1);
            let real = ring.minus(&ring.times(x, &step.0), &ring.times(y, &step.1));
            let imaginary = ring.plus(&ring.times(x, &step.1), &ring.times(y, &step.0));
            *side = (
                real.with_square(*sine, &square, field),
                imaginary.with_square(*sine, &square, field),
            );
        }
    }
    let [left, right] = sides;
    Ok(vec![left.0.minus(&right.0), left.1.minus(&right.1)])
}
