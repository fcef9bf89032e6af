//! In which units a person wants values.

use clap::ValueEnum;
use kutzbach::assembly::words;
use kutzbach::mechanism::FreedomPart;
use kutzbach::motion::value_text;
use kutzbach::report::text::Units;

/// Units of values in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ValueUnits {
    /// Degrees and millimetres
    DegMm,
    /// Radians and metres
    RadM,
}

impl From<ValueUnits> for Units {
    fn from(units: ValueUnits) -> Self {
        match units {
            ValueUnits::DegMm => Self::Drawing,
            ValueUnits::RadM => Self::Si,
        }
    }
}

impl From<ValueUnits> for words::Units {
    fn from(units: ValueUnits) -> Self {
        match units {
            ValueUnits::DegMm => Self::Drawing,
            ValueUnits::RadM => Self::Si,
        }
    }
}

impl ValueUnits {
    /// The unit of a freedom, and how many of it are a radian or a metre.
    #[must_use]
    pub fn of(self, part: FreedomPart) -> (&'static str, f64) {
        match (self, part) {
            (Self::RadM, FreedomPart::Translation) => ("m", 1.0),
            (Self::RadM, _) => ("rad", 1.0),
            (Self::DegMm, FreedomPart::Translation) => ("mm", 1000.0),
            (Self::DegMm, _) => ("°", 180.0 / std::f64::consts::PI),
        }
    }

    /// A value of a freedom (rad, m) in its unit: six digits behind the point of radians and metres, three of the others.
    #[must_use]
    pub fn value(self, part: FreedomPart, value: f64) -> String {
        match self {
            Self::RadM => value_text(value),
            // Adding zero turns −0 into 0.
            Self::DegMm => {
                let (_, factor) = self.of(part);
                format!("{:.3}", (factor * value * 1e3).round() / 1e3 + 0.0)
            }
        }
    }
}
