//! The drawn pose as a solution, exactly.

use super::PolynomialSystem;
use super::displacement::{relative, values_at};
use super::element::Element;
use super::error::SystemError;
use super::field::Field;
use super::fraction::{from_rational, to_f64};
use super::variables::Meaning;
use crate::{Polynomial, Rational};
use kutzbach_math::number::Number;
use num_traits::Signed;

/// The drawn pose and the equations.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum HomePose {
    /// It is a solution: the values of all variables, exact. Every equation was checked to vanish there.
    Exact(Vec<Number>),
    /// It is known exactly and it is no solution: the mechanism has to be assembled first.
    Open {
        /// Index of the first equation that does not vanish.
        equation: usize,
        /// What is left of it, in units of its largest coefficient.
        left: f64,
    },
    /// Its numbers are not algebraic.
    NotAlgebraic(SystemError),
    /// Nobody looked.
    Unknown,
}

impl HomePose {
    /// The values of all variables where the pose is an exact solution.
    #[must_use]
    pub fn exact(&self) -> Option<&[Number]> {
        match self {
            Self::Exact(values) => Some(values),
            _ => None,
        }
    }
}

impl PolynomialSystem {
    /// Whether a polynomial in the system's variables vanishes at the drawn pose, exactly; `None` where that pose is not
    /// known exactly, or holds parameters.
    #[must_use]
    pub fn vanishes_at_home(&self, polynomial: &Polynomial) -> Option<bool> {
        let point = self.construction.point.as_ref()?;
        let value = value_at(polynomial, point, &self.construction.field);
        Some(value.is_zero())
    }
}

/// The value of a polynomial over the rationals at a point of a field.
pub(super) fn value_at(polynomial: &Polynomial, point: &[Element], field: &Field) -> Element {
    let mut sum = Element::zero();
    for (exponents, coefficient) in polynomial.terms() {
        let mut term = Element::rational(from_rational(coefficient));
        for (x, &exponent) in point.iter().zip(exponents) {
            for _ in 0..exponent {
                if term.is_zero() {
                    break;
                }
                term = field.multiply(&term, x);
            }
        }
        sum = sum.plus(&term);
    }
    sum
}

fn largest_coefficient(polynomial: &Polynomial) -> Rational {
    polynomial
        .terms()
        .map(|(_, c)| c.abs())
        .max()
        .unwrap_or_else(|| Rational::from_integer(1.into()))
}

/// The drawn pose of a system; remembers the point in the field.
pub(super) fn drawn_point(system: &mut PolynomialSystem, error: Option<SystemError>) -> HomePose {
    let values = system.construction.field.at_values();
    let construction = &system.construction;
    let field = &construction.field;
    let Some(drawn) = &construction.drawn else {
        return error.map_or(HomePose::Unknown, HomePose::NotAlgebraic);
    };
    let mut point = vec![Element::zero(); system.variables.len()];
    for (joint, variables) in system.joint_variables.iter().enumerate() {
        // Linear variables count from here.
        if variables.is_empty() || construction.linear[joint].is_some() {
            continue;
        }
        let [a, b] = construction.ends[joint];
        let model = &construction.models[joint];
        let at = relative(field, model, &drawn[a], &drawn[b]);
        let Some(values) = values_at(field, field, model, &at) else {
            return HomePose::Unknown;
        };
        for (&variable, value) in variables.iter().zip(values) {
            point[variable] = value;
        }
    }
    let ground = drawn[construction.ground].inverse(field);
    let first_generator = system.variables.len() - construction.generators.len();
    for (index, variable) in system.variables.iter().enumerate() {
        match &variable.meaning {
            Meaning::BodyRotation { link, row, column } => {
                let pose = ground.then(field, &drawn[link.0]);
                point[index] = pose.rotation[*row][*column].clone();
            }
            Meaning::BodyTranslation { link, row } => {
                let pose = ground.then(field, &drawn[link.0]);
                point[index] = pose.translation[*row].clone();
            }
            _ => {}
        }
        if index >= first_generator {
            let generator = construction.generators[index - first_generator];
            point[index] = Element::generator(generator);
        }
    }
    if field.has_parameters() {
        // The drawn pose is that of the parameters' values, not of any.
        let Some(values) = values else {
            return HomePose::Unknown;
        };
        for x in &mut point {
            *x = field.substitute(x, &values);
        }
    }
    for (index, equation) in system.equations.iter().enumerate() {
        let value = value_at(&equation.polynomial, &point, field);
        if !value.is_zero() {
            let left = match value.as_rational() {
                Some(x) => to_f64(&(x / from_rational(&largest_coefficient(&equation.polynomial)))),
                None => {
                    let scale = Number::of_fraction(from_rational(&largest_coefficient(
                        &equation.polynomial,
                    )));
                    field
                        .number(&value)
                        .checked_div(&scale)
                        .map_or(f64::NAN, |x| x.value())
                }
            };
            return HomePose::Open {
                equation: index,
                left,
            };
        }
    }
    let values = point.iter().map(|x| field.number(x)).collect();
    system.construction.point = Some(point);
    HomePose::Exact(values)
}
