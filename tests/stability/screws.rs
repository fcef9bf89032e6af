//! Screws that become hinges as their lead vanishes, and slides as it grows.

use super::drawn::{Place, built, integers, power_of_ten, rectangle};
use super::ladder::{Known, Ladder, Law, Rung, regular};
use super::lengths::BOTH_SIDES;
use kutzbach::mechanism::{JointKind, Mechanism};
use kutzbach::number::Number;

/// A rectangular parallelogram with screws instead of some of its hinges, all with the same lead.
fn screwed(name: &str, which: &[usize], lead: &Number) -> Mechanism {
    let mut joints = rectangle(&Number::integer(2));
    for &index in which {
        joints[index].kind = JointKind::Screw;
        joints[index].lead = Some(lead.clone());
    }
    built(name, &joints)
}

/// One screw among three parallel hinges. The hinges are independent and move in their plane only, which a screw of any
/// lead but zero leaves: rigid. As the lead grows the screw becomes a slide across the plane, as independent as before.
fn one_screw(lead: &Number) -> Mechanism {
    screwed("one_screw", &[3], lead)
}

/// Four screws of equal lead: the turns of a parallelogram's joints are φ, −φ, φ, −φ, so that the ways along the axes add up
/// to nothing. It moves with one freedom at any lead (Delassus 1922). Three of the axes are independent in the group of
/// translations and screws along their direction, which has four dimensions; the fourth depends on them.
fn four_screws(lead: &Number) -> Mechanism {
    screwed("four_screws", &[0, 1, 2, 3], lead)
}

/// One screw, three hinges and a slide along their direction: turns and ways lie in the group of planar motions and the
/// translations across, of dimension 4, which the joints span since the three hinges and the slide do. So 5 − 4 = 1 freedom
/// at every pose with hinges that are not in a plane, whatever the lead.
fn with_slide(lead: &Number) -> Mechanism {
    let [a, b, d, _] = rectangle(&Number::integer(2));
    let slide = Place::new(
        "slide",
        JointKind::Prismatic,
        ["coupler", "carriage"],
        integers(1, 1, 0),
        integers(0, 0, 1),
    );
    let closing = Place::new(
        "C",
        JointKind::Screw,
        ["carriage", "rocker"],
        integers(2, 1, 0),
        integers(0, 0, 1),
    )
    .lead(lead.clone());
    built("screw_with_slide", &[a, b, d, slide, closing])
}

/// A screw and a slide along its axis between the same two links: the slide does not turn, so the screw may not, and then
/// neither moves. Rigid at every lead, regular.
fn against_slide(lead: &Number) -> Mechanism {
    let up = || integers(0, 0, 1);
    let links = ["ground", "nut"];
    let screw = Place::new("screw", JointKind::Screw, links, integers(0, 0, 0), up());
    let slide = Place::new(
        "slide",
        JointKind::Prismatic,
        links,
        integers(1, 0, 0),
        up(),
    );
    built("screw_against_slide", &[screw.lead(lead.clone()), slide])
}

pub fn ladders() -> Vec<Ladder> {
    let ladder = |name, law: fn(f64) -> f64, build: fn(&Number) -> Mechanism, known: Known| {
        let rung = |e| Rung::at(e, build(&power_of_ten(e)), known);
        Ladder {
            name,
            parameter: "lead (m)",
            law: Some(Law::new(10.0, law)),
            rungs: BOTH_SIDES.into_iter().map(rung).collect(),
        }
    };
    // The factor allowed is for the lead of about 6 m, where a screw passes from the one to the other.
    vec![
        ladder("one_screw", |d| d.min(0.0), one_screw, regular(0)),
        ladder("four_screws", |d| -d.max(0.0), four_screws, regular(1)),
        ladder("screw_with_slide", |_| 0.0, with_slide, regular(1)),
        // The only length of this loop is the screw's own way.
        ladder("screw_against_slide", |_| 0.0, against_slide, regular(0)),
    ]
}
