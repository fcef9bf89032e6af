//! Units of a representation: how long its unit of length is, and how large its unit of angle.

use crate::error::{Problem, StepError};
use crate::part21::{Instance, Record};
use std::f64::consts::PI;

/// The most units that one is a multiple of, one after the other.
const LONGEST: usize = 16;

/// Units of a context.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Units {
    /// Metres in the unit of length.
    pub length: f64,
    /// Radians in the unit of angle.
    pub angle: f64,
    /// How accurate points are (m); zero where nothing is stated.
    pub accuracy: f64,
}

impl Units {
    /// A length in metres. Where a metre is a whole number of units it is divided by, so that 0.3 mm become the double nearest
    /// to 0.0003.
    pub fn metres(&self, length: f64) -> f64 {
        let per_metre = 1.0 / self.length;
        if per_metre == per_metre.round() {
            length / per_metre
        } else {
            length * self.length
        }
    }

    /// The units of a representation, from its context.
    ///
    /// # Errors
    /// Where it has no context, or the context no unit of length, or one that is not understood.
    pub fn of_representation(representation: Record<'_>) -> Result<Self, StepError> {
        let context = representation.entity_at(2)?;
        let Some(units) = context.leaf("GLOBAL_UNIT_ASSIGNED_CONTEXT") else {
            return Err(context.geometry(
                "a context with its unit of length (GLOBAL_UNIT_ASSIGNED_CONTEXT)",
                format!("{}: export the file with units", context.keywords()),
            ));
        };
        let mut length = None;
        // Radians are the unit of angle where none is given: only cones need it.
        let mut angle = 1.0;
        for unit in units.entities_at(list_place(units))? {
            if unit.is("LENGTH_UNIT") {
                length = Some(factor(unit, "METRE")?);
            } else if unit.is("PLANE_ANGLE_UNIT") {
                angle = snapped(factor(unit, "RADIAN")?);
            }
        }
        let Some(length) = length else {
            return Err(units.instance().geometry(
                "a unit of length among the units of a context",
                "none: export the file with units",
            ));
        };
        let mut found = Self {
            length,
            angle,
            accuracy: 0.0,
        };
        if let Some(stated) = context.leaf("GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT") {
            found.accuracy = accuracy(stated)?;
        }
        Ok(found)
    }
}

/// The place of the list among the parameters: the last, behind names where the entity is of one type only.
fn list_place(record: Record<'_>) -> usize {
    record.len().saturating_sub(1)
}

/// The uncertainty of lengths that a context states (m).
fn accuracy(stated: Record<'_>) -> Result<f64, StepError> {
    let mut largest = 0.0_f64;
    for measure in stated.entities_at(list_place(stated))? {
        let Some(record) = measure.leaves().find(|leaf| leaf.len() >= 2) else {
            continue;
        };
        let unit = record.entity_at(1)?;
        if unit.is("LENGTH_UNIT") {
            largest = largest.max(record.number_at(0)? * factor(unit, "METRE")?);
        }
    }
    Ok(largest)
}

/// How many `base` units (METRE, RADIAN) a unit is.
fn factor(unit: Instance<'_>, base: &'static str) -> Result<f64, StepError> {
    let mut unit = unit;
    let mut factor = 1.0;
    for _ in 0..LONGEST {
        if let Some(si) = unit.leaf("SI_UNIT") {
            return Ok(times_power(factor, si_exponent(si, base)?));
        }
        let Some(conversion) = unit.leaf("CONVERSION_BASED_UNIT") else {
            return Err(unit.wrong_kind("SI_UNIT or CONVERSION_BASED_UNIT"));
        };
        let measure = conversion.entity_at(conversion.len().saturating_sub(1))?;
        let record = measure.leaves().find(|leaf| leaf.len() >= 2);
        let record = record
            .ok_or_else(|| measure.wrong_kind("a measure with its unit (MEASURE_WITH_UNIT)"))?;
        let value = record.number_at(0)?;
        if !(value > 0.0) {
            return Err(record.wrong(0, "a positive number"));
        }
        factor *= value;
        unit = record.entity_at(1)?;
    }
    Err(unit.error(Problem::Cycle {
        what: "units of measure",
    }))
}

/// The power of ten of an SI unit.
fn si_exponent(si: Record<'_>, base: &'static str) -> Result<i32, StepError> {
    // Two parameters, or three where the dimensions stand before them.
    let name = si.len().saturating_sub(1);
    let prefix = name.saturating_sub(1);
    let word = si.item(name).and_then(|item| item.enumeration());
    if word != Some(base.as_bytes()) {
        let needed = match base {
            "METRE" => "`.METRE.`",
            _ => "`.RADIAN.`",
        };
        return Err(si.wrong(name, needed));
    }
    let Some(written) = si.item(prefix).and_then(|item| item.enumeration()) else {
        return Ok(0);
    };
    PREFIXES
        .iter()
        .find(|(known, _)| known.as_bytes() == written)
        .map(|(_, exponent)| *exponent)
        .ok_or_else(|| si.wrong(prefix, "a prefix of SI units, or `$`"))
}

const PREFIXES: [(&str, i32); 16] = [
    ("EXA", 18),
    ("PETA", 15),
    ("TERA", 12),
    ("GIGA", 9),
    ("MEGA", 6),
    ("KILO", 3),
    ("HECTO", 2),
    ("DECA", 1),
    ("DECI", -1),
    ("CENTI", -2),
    ("MILLI", -3),
    ("MICRO", -6),
    ("NANO", -9),
    ("PICO", -12),
    ("FEMTO", -15),
    ("ATTO", -18),
];

/// `factor` times a power of ten, rounded once: 25.4 thousandths are the double nearest to 0.0254.
fn times_power(factor: f64, exponent: i32) -> f64 {
    let power = 10.0_f64.powi(exponent.abs());
    if exponent < 0 {
        factor / power
    } else {
        factor * power
    }
}

/// A degree is written with as many digits as its writer likes: within a millionth it is π/180.
fn snapped(angle: f64) -> f64 {
    let degree = PI / 180.0;
    if (angle / degree - 1.0).abs() < 1e-6 {
        degree
    } else {
        angle
    }
}

#[cfg(test)]
mod tests {
    use super::{Units, snapped, times_power};

    #[test]
    fn lengths_are_rounded_once() {
        let millimetres = Units {
            length: times_power(1.0, -3),
            angle: 1.0,
            accuracy: 0.0,
        };
        assert_eq!(millimetres.metres(0.3), 0.0003);
        assert_eq!(millimetres.metres(55.0), 0.055);
        assert_eq!(times_power(25.4, -3), 0.0254);
        assert_eq!(snapped(0.01745329), std::f64::consts::PI / 180.0);
        assert_eq!(snapped(1.0), 1.0);
    }
}
