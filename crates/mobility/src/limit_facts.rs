//! What the limits of the joints say of a pose and of the couplings.
//!
//! Limits do not enter the mobility: they are inequalities, and a motion that they stop is a motion. But a pose drawn outside
//! them is one that the machine cannot take, and limits that leave a coupled joint a single value hold what counts as free.
//! Both are what the owner of a file wants to hear before anything else.
//!
//! Cost: linear in joints and couplings.

use kutzbach_closure::{JointState, coupled_joints, nearest_turn};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{FreedomPart, Joint, JointId, Mechanism, Precision};

/// Something that the limits of a mechanism say.
#[derive(Clone, Debug, PartialEq)]
pub enum LimitFact {
    /// The pose is outside the limits of a joint (rad or m).
    Outside {
        /// Index of the joint.
        joint: usize,
        /// Its value at the pose; of the turns of a hinge that no coupling counts, the one nearest to the limits.
        value: f64,
        /// The limit that it is beyond.
        limit: f64,
    },
    /// Both limits of a joint are the same.
    NoRange {
        /// Index of the joint.
        joint: usize,
    },
    /// No values within the limits satisfy a coupling.
    Empty {
        /// Index of the coupling.
        coupling: usize,
    },
    /// The limits leave the joints of a coupling one value each, though their own ranges are wider.
    Pinned {
        /// Index of the coupling.
        coupling: usize,
        /// Indices of the joints.
        joints: Vec<usize>,
    },
}

/// Sums and products of a few doubles are off by less than this share of them.
const ROUNDING: f64 = 1e-12;

/// What the limits say at a pose, by joint and then by coupling. A limit is as uncertain as its digits; what is within that is
/// within the limit.
pub(super) fn limit_facts(mechanism: &Mechanism, states: &[JointState<f64>]) -> Vec<LimitFact> {
    let mut found = Vec::new();
    let ranges: Vec<Option<Range>> = mechanism
        .joints()
        .iter()
        .enumerate()
        .map(|(index, joint)| Range::of(mechanism.precision_of(JointId(index)), joint))
        .collect();
    let coupled = coupled_joints(mechanism);
    for (index, (range, state)) in ranges.iter().zip(states).enumerate() {
        let (Some(range), &[value]) = (range, state.values.as_slice()) else {
            continue;
        };
        let value = match coupled[index] {
            true => value,
            false => nearest_turn(&mechanism.joints()[index], value),
        };
        let open = range.open + ROUNDING * value.abs();
        let beyond = [
            (range.lower - value, range.lower),
            (value - range.upper, range.upper),
        ];
        if let Some((_, limit)) = beyond.into_iter().find(|(by, _)| *by > open) {
            found.push(LimitFact::Outside {
                joint: index,
                value,
                limit,
            });
        }
        if range.width() <= range.open {
            found.push(LimitFact::NoRange { joint: index });
        }
    }
    for coupling in 0..mechanism.couplings().len() {
        found.extend(of_coupling(mechanism, &ranges, coupling));
    }
    found
}

/// What a joint of one freedom may be (rad or m); infinite where the file does not say.
#[derive(Clone, Copy)]
struct Range {
    lower: f64,
    upper: f64,
    /// How far both may be off.
    open: f64,
}

impl Range {
    /// `None` for joints without limits.
    fn of(precision: &Precision, joint: &Joint) -> Option<Self> {
        let (lower, upper) = joint.bounds()?;
        let limit = joint.limit.as_ref()?;
        // As a length or an angle of its frame.
        let place = if joint.kind.freedoms() == [FreedomPart::Translation] {
            0
        } else {
            3
        };
        let numbers = || limit.lower.iter().chain(&limit.upper);
        let stated = numbers()
            .map(|x| precision.uncertainty(place, x).max(own_digits(x)))
            .fold(0.0, f64::max);
        let size = numbers().map(|x| x.value().abs()).fold(0.0, f64::max);
        Some(Self {
            lower,
            upper,
            open: stated + ROUNDING * size,
        })
    }

    fn width(&self) -> f64 {
        self.upper - self.lower
    }
}

/// Half a unit of a number's last decimal (rad or m), where it has more of them than somebody would choose.
fn own_digits(number: &Number) -> f64 {
    let decimals = number.stated().map(|stated| stated.decimals);
    let rounded = decimals.filter(|decimals| *decimals > Precision::EXACT_DECIMALS);
    rounded.map_or(0.0, |decimals| 0.5 * 10f64.powi(-decimals.min(300)))
}

/// Intervals of Σ factor · variable: each term has to be what the others leave. Couplings with powers are not asked.
fn of_coupling(
    mechanism: &Mechanism,
    ranges: &[Option<Range>],
    coupling: usize,
) -> Option<LimitFact> {
    let equation = &mechanism.couplings()[coupling];
    if !equation.is_linear() {
        return None;
    }
    let terms: Option<Vec<(usize, f64, Range)>> = equation
        .terms
        .iter()
        .map(|term| Some((term.joint.0, term.factor.value(), ranges[term.joint.0]?)))
        .collect();
    let terms = terms.filter(|terms| terms.iter().any(|(_, factor, _)| *factor != 0.0))?;
    let (mut least, mut most, mut open) = (0.0, 0.0, ROUNDING * equation.offset.value().abs());
    for (_, factor, range) in &terms {
        let ends = [factor * range.lower, factor * range.upper];
        least += ends[0].min(ends[1]);
        most += ends[0].max(ends[1]);
        let size = ends.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        open += factor.abs() * range.open + ROUNDING * if size.is_finite() { size } else { 0.0 };
    }
    let offset = equation.offset.value();
    if offset < least - open || offset > most + open {
        return Some(LimitFact::Empty { coupling });
    }
    let wide = terms
        .iter()
        .any(|(_, factor, range)| *factor != 0.0 && range.width() > range.open);
    let pinned = offset <= least + open || offset >= most - open;
    (pinned && wide).then(|| LimitFact::Pinned {
        coupling,
        joints: terms.iter().map(|(joint, ..)| *joint).collect(),
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_closure::{Arithmetic, Geometry};
    use kutzbach_format::read;

    /// Two hinges on a ground, the second following the first if `mimic` says so.
    fn facts(first: &str, second: &str, mimic: &str, at: &str) -> Vec<LimitFact> {
        let text = format!(
            r#"<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
            <joint name="one" type="revolute"><parent link="a"/><child link="b"/>{first}</joint>
            <joint name="two" type="revolute"><parent link="a"/><child link="c"/>{second}{mimic}</joint>
            <configuration name="there"><position joint="one" value="{at}"/></configuration></robot>"#
        );
        let mechanism = read(&text, "r.urdf", &[]).unwrap().mechanism;
        let geometry = Geometry::new(
            &mechanism,
            mechanism.configuration("there"),
            &Arithmetic::double(),
        );
        limit_facts(&mechanism, &geometry.states)
    }

    fn limit(lower: &str, upper: &str) -> String {
        format!(r#"<limit lower="{lower}" upper="{upper}"/>"#)
    }

    #[test]
    fn a_pose_within_its_limits_says_nothing() {
        assert_eq!(facts(&limit("-1", "1"), "", "", "0.5"), []);
        assert_eq!(facts(&limit("-1", "1"), "", "", "1"), []);
        assert_eq!(facts(r#"<limit effort="3"/>"#, "", "", "9"), []);
        // The limit has four decimals, the value more: it may have been rounded.
        assert_eq!(facts(&limit("-1.5708", "1.5708"), "", "", "${pi/2}"), []);
    }

    #[test]
    fn poses_outside_their_limits_are_found() {
        for (at, beyond) in [("1.25", 1.0), ("-2", -1.0)] {
            let found = facts(&limit("-1", "1"), "", "", at);
            let [
                LimitFact::Outside {
                    joint: 0,
                    value,
                    limit,
                },
            ] = found.as_slice()
            else {
                panic!("{found:?}")
            };
            assert_eq!((*value, *limit), (at.parse().unwrap(), beyond));
        }
        let found = facts(r#"<limit lower="0.5"/>"#, "", "", "0");
        assert!(matches!(found.as_slice(), [LimitFact::Outside { .. }]));
    }

    #[test]
    fn whole_turns_do_not_count() {
        // 300° is −60°, and 220° is 40° above 180°, not 220° − 360° and 50° below −90°.
        let limits = limit("${-pi/2}", "${pi}");
        assert_eq!(facts(&limits, "", "", "${300*pi/180}"), []);
        let found = facts(&limits, "", "", "${-140*pi/180}");
        let [LimitFact::Outside { value, limit, .. }] = found.as_slice() else {
            panic!("{found:?}")
        };
        assert!(((value - limit).to_degrees() - 40.0).abs() < 1e-9);
    }

    #[test]
    fn limits_of_no_width_are_found() {
        assert_eq!(
            facts(&limit("0", "0"), "", "", "0"),
            [LimitFact::NoRange { joint: 0 }]
        );
    }

    #[test]
    fn couplings_are_held_against_the_limits_of_both_joints() {
        let mimic = |multiplier: &str, offset: &str| {
            format!(r#"<mimic joint="one" multiplier="{multiplier}" offset="{offset}"/>"#)
        };
        let (first, second) = (limit("0", "1"), limit("0", "1"));
        assert_eq!(facts(&first, &second, &mimic("1", "0"), "0"), []);
        // −q of [0, 1] meets [0, 1] in one point; −q − 0.5 in none.
        assert_eq!(
            facts(&first, &second, &mimic("-1", "0"), "0"),
            [LimitFact::Pinned {
                coupling: 0,
                joints: vec![1, 0]
            }]
        );
        assert_eq!(
            facts(&first, &second, &mimic("-1", "-0.5"), "0"),
            [LimitFact::Empty { coupling: 0 }]
        );
        // Without limits on one side there is nothing to say.
        assert_eq!(facts(&first, "", &mimic("-1", "-0.5"), "0"), []);
    }
}
