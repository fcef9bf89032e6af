//! Joints whose two sides belong to one body: they leave nothing to solve, and have to close as they are.

use super::{Exact3, Slack, cross, dot, minus, square};
use kutzbach_math::number::Number;
use kutzbach_math::space::Rigid;
use kutzbach_model::mechanism::{ExactPose, Joint, JointKind};

/// How far the two sides of a joint are from each other, in the directions that the joint does not leave free.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gap {
    /// Of the points (m).
    pub metres: f64,
    /// Of the directions (rad).
    pub radians: f64,
}

impl Gap {
    /// Whether it is more than numbers known so far leave open.
    pub(super) fn is_beyond(&self, slack: &Slack) -> bool {
        self.metres > slack.metres || self.radians > slack.share
    }
}

impl std::fmt::Display for Gap {
    /// `3.000 mm and 12.000° apart`; tiny gaps keep their digits.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (millimetres, degrees) = (self.metres * 1e3, self.radians.to_degrees());
        let shown = |x: f64| match x < 1e-3 {
            true => format!("{x:.3e}"),
            false => format!("{x:.3}"),
        };
        match (millimetres > 0.0, degrees > 0.0) {
            (true, true) => write!(f, "{} mm and {}°", shown(millimetres), shown(degrees))?,
            (false, true) => write!(f, "{}°", shown(degrees))?,
            _ => write!(f, "{} mm", shown(millimetres))?,
        }
        f.write_str(" apart")
    }
}

/// Two axes along each other make one hinge of a universal joint, whose cross turns freely.
pub(super) fn leaves_a_freedom(joint: &Joint) -> bool {
    joint.kind == JointKind::Universal && is_zero(&cross(&joint.axis.0, &joint.axis2.0))
}

/// The gap of a joint whose sides are at `body_from_side`; `None` where it closes, decided exactly. `length_square` is that of a
/// bar (m²).
pub(super) fn gap(joint: &Joint, sides: [&ExactPose; 2], length_square: &Number) -> Option<Gap> {
    let [one, other] = sides;
    let way = minus(&other.translation, &one.translation);
    let first = one.rotate(&joint.axis.0);
    let second = other.rotate(&joint.axis2.0);
    let turned = || turned(one, other);
    let axis = || apart(&first, &other.rotate(&joint.axis.0));
    let (metres, radians) = match joint.kind {
        JointKind::Fixed => (length(&way), turned()),
        JointKind::Revolute => (length(&way), axis()),
        JointKind::Prismatic => (off_line(&way, &first), turned()),
        JointKind::Screw => (
            larger(off_line(&way, &first), off_thread(joint, sides, &way)),
            axis(),
        ),
        JointKind::Cylindrical => (off_line(&way, &first), axis()),
        JointKind::Universal => (length(&way), angle_off(joint, &first, &second)),
        JointKind::PlanarTranslation => (off_plane(&way, &first), turned()),
        JointKind::Planar => (off_plane(&way, &first), axis()),
        JointKind::Spherical => (length(&way), None),
        JointKind::Translational => (None, turned()),
        JointKind::TranslatingScrew => (off_thread(joint, sides, &way), axis()),
        JointKind::Schoenflies => (None, axis()),
        JointKind::PointOnLine => (off_line(&way, &second), None),
        JointKind::LineOnPlane => (off_plane(&way, &second), angle_off(joint, &first, &second)),
        JointKind::PointOnPlane => (off_plane(&way, &second), None),
        JointKind::Distance => (off_length(&way, length_square), None),
    };
    (metres.is_some() || radians.is_some()).then(|| Gap {
        metres: metres.unwrap_or(0.0),
        radians: radians.unwrap_or(0.0),
    })
}

fn is_zero(v: &Exact3) -> bool {
    v.iter().all(Number::is_zero)
}

/// The length of a vector in doubles, without its square.
fn long(v: &Exact3) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|i| v[i].value());
    x.hypot(y).hypot(z)
}

fn larger(one: Option<f64>, other: Option<f64>) -> Option<f64> {
    one.into_iter().chain(other).reduce(f64::max)
}

fn length(way: &Exact3) -> Option<f64> {
    (!is_zero(way)).then(|| long(way))
}

fn off_line(way: &Exact3, along: &Exact3) -> Option<f64> {
    let off = cross(along, way);
    (!is_zero(&off)).then(|| long(&off) / long(along))
}

fn off_plane(way: &Exact3, normal: &Exact3) -> Option<f64> {
    let off = dot(way, normal);
    (!off.is_zero()).then(|| (off.value() / long(normal)).abs())
}

fn off_length(way: &Exact3, wanted: &Number) -> Option<f64> {
    let off = &square(way) - wanted;
    (!off.is_zero()).then(|| (long(way) - wanted.value().sqrt()).abs())
}

/// The angle between two directions that should be one (rad).
fn apart(a: &Exact3, b: &Exact3) -> Option<f64> {
    let (sine, cosine) = (cross(a, b), dot(a, b));
    let same = is_zero(&sine) && cosine.signum() > 0;
    (!same).then(|| long(&sine).atan2(cosine.value()))
}

/// The rotation from one side to the other (rad), where they should be parallel.
fn turned(one: &ExactPose, other: &ExactPose) -> Option<f64> {
    if one.rotation == other.rotation {
        return None;
    }
    let between = one.inverse().then(other).rotation;
    let rigid = Rigid {
        rotation: between.map(|row| row.map(|x| x.value())),
        translation: [0.0; 3],
    };
    let [x, y, z] = rigid.rotation_vector();
    Some(x.hypot(y).hypot(z))
}

/// By how much the angle between the two axes differs from that at home (rad).
fn angle_off(joint: &Joint, first: &Exact3, second: &Exact3) -> Option<f64> {
    let (axis, axis2) = (&joint.axis.0, &joint.axis2.0);
    let [now, home] = [dot(first, second), dot(axis, axis2)];
    let angle = |cosine: &Number| {
        (cosine.value() / (long(axis) * long(axis2)))
            .clamp(-1.0, 1.0)
            .acos()
    };
    (now != home).then(|| (angle(&now) - angle(&home)).abs())
}

/// By how much the way along a screw's axis differs from that of its turn, up to whole turns (m).
fn off_thread(joint: &Joint, [one, other]: [&ExactPose; 2], way: &Exact3) -> Option<f64> {
    let lead = joint.lead.as_ref()?;
    let turns = turns_off(joint, lead, [one, other], way);
    match turns {
        Some(turns) if turns.is_zero() => None,
        Some(turns) => Some((turns.value() * lead.value()).abs()),
        None => Some(long(way)),
    }
}

/// Turns that the way along the axis makes, less those of the rotation, up to whole ones; `None` where the axis has no length or
/// the lead is zero.
fn turns_off(
    joint: &Joint,
    lead: &Number,
    [one, other]: [&ExactPose; 2],
    way: &Exact3,
) -> Option<Number> {
    let axis = &joint.axis.0;
    let long = square(axis).sqrt().ok()?;
    let by_way = dot(way, &one.rotate(axis))
        .checked_div(&(&long * lead))
        .ok()?;
    let r = one.inverse().then(other).rotation;
    // Twice the sine times the unit axis, and twice the cosine.
    let skew = [(2, 1), (0, 2), (1, 0)].map(|(i, j)| &r[i][j] - &r[j][i]);
    let sine = dot(&skew, axis).checked_div(&long).ok()?;
    let cosine = &(&(&r[0][0] + &r[1][1]) + &r[2][2]) - &Number::one();
    let angle = Number::atan2(&sine, &cosine).ok()?;
    let whole = &Number::integer(2) * &Number::pi();
    let off = &by_way - &angle.checked_div(&whole).ok()?;
    let nearest = Number::integer(off.value().round() as i64);
    Some(&off - &nearest)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::{Mismatch, Placed, Unsuited};

    /// Two links fixed to each other, and a joint between them that has its second side at a frame.
    fn told(kind: &str, inside: &str, frame: &str) -> Option<String> {
        let text = format!(
            "<robot name=\"x\"><link name=\"a\"/><link name=\"b\"/>\
             <joint name=\"f\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/><origin xyz=\"1 0 0\"/></joint>\
             <loop name=\"j\" type=\"{kind}\"><predecessor link=\"a\"><origin xyz=\"3 2 0\"/></predecessor>\
             <successor link=\"b\"><origin {frame}/></successor>{inside}</loop></robot>"
        );
        let mechanism = kutzbach_format::read(&text, "x.urdf", &[])
            .unwrap()
            .mechanism;
        match Placed::of(&mechanism) {
            Err(Unsuited::Contradiction(mismatch)) => {
                assert!(matches!(*mismatch, Mismatch::Within { .. }));
                Some(mismatch.to_string())
            }
            Err(Unsuited::OneBody(_)) => None,
            other => panic!("{kind} {frame}: {other:?}"),
        }
    }

    /// Kind, its axes, frames of the second side that close, and frames that do not with what is told. The first side is seen from
    /// the second link at 2 2 0.
    #[test]
    fn every_kind_closes_where_it_should_and_nowhere_else() {
        let z = "<axis xyz=\"0 0 1\"/>";
        let x = "<axis xyz=\"1 0 0\"/>";
        let zx = "<axis xyz=\"0 0 1\"/><axis2 xyz=\"1 0 0\"/>";
        let screw = "<axis xyz=\"0 0 1\"/><screw lead=\"1\"/>";
        let turned = "rpy=\"0 0 ${pi/3}\"";
        let tilted = "rpy=\"${pi/2} 0 0\"";
        let length = "<distance value=\"5\"/>";
        let (home, away, up) = ("xyz=\"2 2 0\"", "xyz=\"5 6 0\"", "xyz=\"2 2 1\"");
        let on_x = "xyz=\"7 2 0\"";
        let both = |a: &str, b: &str| format!("{a} {b}");
        for (kind, inside, closing, open) in [
            (
                "fixed",
                "",
                vec![home.to_owned()],
                vec![
                    (away.to_owned(), "5000.000 mm apart"),
                    (both(home, turned), "60.000° apart"),
                ],
            ),
            (
                "revolute",
                z,
                vec![home.to_owned(), both(home, turned)],
                vec![
                    (away.to_owned(), "5000.000 mm apart"),
                    (up.to_owned(), "1000.000 mm apart"),
                    (both(home, tilted), "90.000° apart"),
                    (both(home, "rpy=\"${pi} 0 0\""), "180.000° apart"),
                ],
            ),
            (
                "prismatic",
                x,
                vec![home.to_owned(), on_x.to_owned()],
                vec![
                    (away.to_owned(), "4000.000 mm apart"),
                    (both(home, turned), "60.000° apart"),
                    (both(home, tilted), "90.000° apart"),
                ],
            ),
            (
                "cylindrical",
                z,
                vec![home.to_owned(), both(up, turned)],
                vec![
                    (away.to_owned(), "5000.000 mm apart"),
                    (both(home, tilted), "90.000° apart"),
                ],
            ),
            (
                "screw",
                screw,
                vec![
                    home.to_owned(),
                    up.to_owned(),
                    both("xyz=\"2 2 ${-5/6}\"", turned),
                    both("xyz=\"2 2 ${1/6}\"", turned),
                ],
                vec![
                    (both(home, turned), "166.667 mm apart"),
                    ("xyz=\"2 2 ${1/4}\"".to_owned(), "250.000 mm apart"),
                ],
            ),
            (
                "universal",
                zx,
                vec![home.to_owned(), both(home, turned), both(home, tilted)],
                vec![
                    (away.to_owned(), "5000.000 mm apart"),
                    (both(home, "rpy=\"0 ${pi/6} 0\""), "30.000° apart"),
                ],
            ),
            (
                "planar",
                z,
                vec![home.to_owned(), both(away, turned)],
                vec![
                    (up.to_owned(), "1000.000 mm apart"),
                    (both(home, tilted), "90.000° apart"),
                ],
            ),
            (
                "planar_translation",
                z,
                vec![home.to_owned(), away.to_owned()],
                vec![
                    (up.to_owned(), "1000.000 mm apart"),
                    (both(home, turned), "60.000° apart"),
                ],
            ),
            (
                "spherical",
                "",
                vec![home.to_owned(), both(home, tilted)],
                vec![(away.to_owned(), "5000.000 mm apart")],
            ),
            (
                "translational",
                "",
                vec![home.to_owned(), away.to_owned()],
                vec![(both(home, turned), "60.000° apart")],
            ),
            (
                "schoenflies",
                z,
                vec![both(away, turned)],
                vec![(both(home, tilted), "90.000° apart")],
            ),
            (
                "translating_screw",
                screw,
                vec![both("xyz=\"5 6 ${1/6}\"", turned)],
                vec![(both(up, turned), "166.667 mm apart")],
            ),
            (
                "point_on_line",
                "<axis2 xyz=\"1 0 0\"/>",
                vec![on_x.to_owned(), both(home, turned)],
                vec![(away.to_owned(), "4000.000 mm apart")],
            ),
            (
                "point_on_plane",
                "<axis2 xyz=\"0 0 1\"/>",
                vec![both(away, turned)],
                vec![(up.to_owned(), "1000.000 mm apart")],
            ),
            (
                "line_on_plane",
                "<axis xyz=\"1 0 0\"/><axis2 xyz=\"0 0 1\"/>",
                vec![both(away, turned), both(home, "rpy=\"${pi/3} 0 0\"")],
                vec![
                    (up.to_owned(), "1000.000 mm apart"),
                    (both(home, "rpy=\"0 ${pi/6} 0\""), "30.000° apart"),
                ],
            ),
            (
                "distance",
                length,
                vec![away.to_owned()],
                vec![
                    (home.to_owned(), "5000.000 mm apart"),
                    (on_x.replace('7', "9"), "2000.000 mm apart"),
                ],
            ),
        ] {
            for frame in closing {
                assert_eq!(told(kind, inside, &frame), None, "{kind} {frame}");
            }
            for (frame, words) in open {
                let text =
                    told(kind, inside, &frame).unwrap_or_else(|| panic!("{kind} {frame} closes"));
                assert!(
                    text.contains(words) && text.contains("joint `j`") && text.contains("link `a`"),
                    "{kind} {frame}: {text}"
                );
            }
        }
    }

    /// Two balls of the second link in one point, which are in two of the first.
    #[test]
    fn one_point_is_not_in_two_places_of_a_body() {
        let ball = |name: &str, at: &str| {
            format!(
                "<loop name=\"{name}\" type=\"spherical\"><predecessor link=\"a\"><origin xyz=\"{at}\"/></predecessor>\
                 <successor link=\"b\"><origin xyz=\"1 0 0\"/></successor></loop>"
            )
        };
        let told = |second: &str| {
            let text = format!(
                "<robot name=\"x\"><link name=\"a\"/><link name=\"b\"/>\
                 <joint name=\"f\" type=\"floating\"><parent link=\"a\"/><child link=\"b\"/></joint>{}{}</robot>",
                ball("p", "0 0 0"),
                ball("q", second)
            );
            let reading = kutzbach_format::read(&text, "x.urdf", &[]).unwrap();
            Placed::of(&reading.mechanism).unwrap_err()
        };
        let text = told("3 0 0").to_string();
        assert_eq!(
            text,
            "points `p` and `q` of `a` are 3000.000 mm apart, and joints make them one point: nothing closes"
        );
        assert!(matches!(told("0 0 0"), Unsuited::Loose { .. }));
    }
}
