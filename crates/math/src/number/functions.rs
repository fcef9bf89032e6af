//! Square root and circular functions.

use super::angle::Angle;
use super::error::{NumberError, Reason};
use super::evaluate::fraction;
use super::surd::Surd;
use super::tree::Operation;
use super::{Exact, Number};
use dashu_ratio::RBig;

/// Largest expression whose inverse circular function is kept as an angle.
const MAX_POINT_NODES: u32 = 200;

impl Number {
    /// The square root that is not negative.
    ///
    /// # Errors
    /// Of a negative number, and of zero that is [open](Self::is_open); the offset is 0.
    pub fn sqrt(&self) -> Result<Self, NumberError> {
        match self.signum() {
            // Zero at this value only: the root is none elsewhere.
            0 if self.is_open() => return Err(self.refused_open("sqrt at 0")),
            0 => return Ok(Self::zero().with_coarsest(self.0.coarsest)),
            -1 => return Err(self.outside("sqrt", "a number that is not negative")),
            _ => {}
        }
        let root = match self.exact() {
            Some(Exact::Rational(x)) => Surd::root(x).map(Self::from_surd),
            Some(Exact::Surd(x)) => x.sqrt().map(Self::from_surd),
            _ => None,
        };
        Ok(root
            .unwrap_or_else(|| Self::from_tree(Operation::Sqrt, vec![self.clone()]))
            .with_coarsest(self.0.coarsest))
    }

    /// Cosine and sine of this number as an angle in radians. Algebraic where the angle is an integer (half, quarter)
    /// combination of inverse circular functions of algebraic numbers and a rational multiple of pi.
    #[must_use]
    pub fn cos_sin(&self) -> (Number, Number) {
        let (cos, sin) = self
            .as_angle()
            .and_then(|angle| angle.cos_sin())
            .unwrap_or_else(|| {
                (
                    Self::from_tree(Operation::Cos, vec![self.clone()]),
                    Self::from_tree(Operation::Sin, vec![self.clone()]),
                )
            });
        (
            cos.with_coarsest(self.0.coarsest),
            sin.with_coarsest(self.0.coarsest),
        )
    }

    /// Tangent of this number as an angle in radians.
    ///
    /// # Errors
    /// Where the cosine is zero; the offset is 0.
    pub fn tan(&self) -> Result<Self, NumberError> {
        let (cos, sin) = self.cos_sin();
        if cos.is_zero() {
            return Err(self.outside("tan", "an angle whose cosine is not zero"));
        }
        if cos.is_algebraic() && sin.is_algebraic() {
            return sin.checked_div(&cos);
        }
        Ok(Self::from_tree(Operation::Tan, vec![self.clone()]))
    }

    /// Angle in [0, π] with this cosine, in radians.
    ///
    /// # Errors
    /// Beyond [−1, 1], and of a number that is [open](Self::is_open); the offset is 0.
    pub fn acos(&self) -> Result<Self, NumberError> {
        self.closed("acos")?;
        let sin = self.other_leg("acos")?;
        self.angle_of(self.clone(), sin, Operation::Acos)
    }

    /// Angle in [−π/2, π/2] with this sine, in radians.
    ///
    /// # Errors
    /// Beyond [−1, 1], and of a number that is [open](Self::is_open); the offset is 0.
    pub fn asin(&self) -> Result<Self, NumberError> {
        self.closed("asin")?;
        let cos = self.other_leg("asin")?;
        self.angle_of(cos, self.clone(), Operation::Asin)
    }

    /// Angle in (−π/2, π/2) with this tangent, in radians.
    #[must_use]
    pub fn atan(&self) -> Self {
        let angle = if self.is_zero() && !self.is_open() {
            Ok(Self::zero())
        } else if self.is_algebraic() {
            Self::atan2(self, &Self::one())
        } else {
            Ok(Self::from_tree(Operation::Atan, vec![self.clone()]))
        };
        // With one for x there is no error to be had.
        angle
            .unwrap_or_else(|_| Self::zero())
            .with_coarsest(self.0.coarsest)
    }

    /// Angle in (−π, π] of the point (x, y), in radians.
    ///
    /// # Errors
    /// For the origin, and for coordinates that are [open](Self::is_open); the offset is 0.
    pub fn atan2(y: &Self, x: &Self) -> Result<Self, NumberError> {
        y.closed("atan2")?;
        x.closed("atan2")?;
        let coarsest = [y, x].iter().filter_map(|n| n.0.coarsest).min();
        let angle = match (y.signum(), x.signum()) {
            (0, 0) => {
                return Err(Reason::Domain {
                    function: "atan2",
                    needed: "a point that is not the origin",
                    found: format!("({}, {})", y.shown(), x.shown()),
                }
                .at(0));
            }
            (0, 1) => Self::zero(),
            (0, _) => Self::pi(),
            (sign, 0) => Self::from_angle(Angle::of_pi(fraction(i64::from(sign), 2))),
            _ => match unit_point(y, x) {
                Some((cos, sin)) => Self::from_angle(Angle::of_point(cos, sin)),
                None => Self::from_tree(Operation::Atan2, vec![y.clone(), x.clone()]),
            },
        };
        Ok(angle.with_coarsest(coarsest))
    }

    /// Degrees to radians: times π/180, exact.
    #[must_use]
    pub fn radians(&self) -> Self {
        let degree = Angle::of_pi(fraction(1, 180));
        self * &Self::from_angle(degree)
    }

    /// This to a power that is an integer or half an integer.
    ///
    /// # Errors
    /// Any other exponent, one beyond 1000 in size, zero to a negative power, an odd half power of a negative number.
    pub fn half_power(&self, exponent: &Self) -> Result<Self, NumberError> {
        let refused = || Reason::Exponent(exponent.shown()).at(0);
        let doubled = exponent.rational().ok_or_else(refused)? * RBig::from(2);
        let doubled = i32::try_from(doubled.numerator().clone())
            .ok()
            .filter(|n| doubled.is_int() && n.abs() <= 2000)
            .ok_or_else(refused)?;
        if doubled % 2 == 0 {
            self.power(doubled / 2)
        } else {
            let root = self.sqrt()?;
            self.power(doubled.div_euclid(2)).map(|whole| whole * root)
        }
        .map(|power| {
            let coarsest = [self, exponent].iter().filter_map(|n| n.0.coarsest).min();
            power.with_coarsest(coarsest)
        })
    }

    /// √(1 − x²), where x is a sine or cosine.
    fn other_leg(&self, function: &'static str) -> Result<Self, NumberError> {
        let square = &Self::one() - &(self * self);
        if square.signum() < 0 {
            return Err(self.outside(function, "a number in [-1, 1]"));
        }
        square.sqrt()
    }

    /// The angle of a point on the unit circle, one coordinate of which is `self`.
    fn angle_of(&self, cos: Self, sin: Self, operation: Operation) -> Result<Self, NumberError> {
        // On an axis the angle is known even where the coordinates are not in normal form.
        let angle = if sin.is_zero() || cos.is_zero() {
            Self::atan2(&sin, &cos)?
        } else if is_short(&cos) && is_short(&sin) {
            Self::from_angle(Angle::of_point(cos, sin))
        } else {
            Self::from_tree(operation, vec![self.clone()])
        };
        Ok(angle.with_coarsest(self.0.coarsest))
    }

    /// Refuses what is open for a function that has no polynomial form.
    ///
    /// # Errors
    /// [`Reason::Open`]; the offset is 0.
    pub(super) fn closed(&self, function: &'static str) -> Result<(), NumberError> {
        match self.is_open() {
            true => Err(self.refused_open(function)),
            false => Ok(()),
        }
    }

    fn refused_open(&self, function: &'static str) -> NumberError {
        Reason::Open {
            function,
            found: self.open_name().unwrap_or("a measure").to_owned(),
        }
        .at(0)
    }

    fn outside(&self, function: &'static str, needed: &'static str) -> NumberError {
        Reason::Domain {
            function,
            needed,
            found: self.shown(),
        }
        .at(0)
    }
}

fn is_short(x: &Number) -> bool {
    x.is_algebraic() && x.nodes() <= MAX_POINT_NODES
}

/// (x, y) divided by its distance from the origin, where that is short.
fn unit_point(y: &Number, x: &Number) -> Option<(Number, Number)> {
    if !is_short(x) || !is_short(y) {
        return None;
    }
    let distance = (&(x * x) + &(y * y)).sqrt().ok()?;
    let cos = x.checked_div(&distance).ok()?;
    let sin = y.checked_div(&distance).ok()?;
    (is_short(&cos) && is_short(&sin)).then_some((cos, sin))
}
