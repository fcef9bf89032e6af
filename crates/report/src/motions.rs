//! How links move, as rows of a report and in words.

use super::schema::Motion;
use super::text::words::figure;
use kutzbach_math::group::{DisplacementSubgroup, coordinates};
use kutzbach_mobility::RelativeMotion;
use kutzbach_model::mechanism::Mechanism;

/// One motion on the branch of this name.
pub(super) fn motion_row(mechanism: &Mechanism, branch: &str, motion: &RelativeMotion) -> Motion {
    let link = |index: usize| mechanism.links()[index].name.clone();
    let joint = motion.joint.map(|joint| &mechanism.joints()[joint].name);
    Motion {
        branch: branch.to_owned(),
        link: link(motion.link),
        relative_to: link(motion.relative_to),
        freedom: motion.freedom,
        class: match &motion.class {
            Some(class) => class.short_name().to_owned(),
            None => split(motion),
        },
        text: text(motion),
        within: motion.within.map(|within| within.short_name().to_owned()),
        joint: joint.cloned(),
        rotations: motion.rotations,
        translations: motion.translations,
        pitches: motion.pitches,
        tilts: motion.tilts,
        whole_branch: false,
        asked: false,
    }
}

/// `1R 2T`: degrees of freedom that turn and degrees of freedom that do not.
fn split(motion: &RelativeMotion) -> String {
    let (Some(rotations), Some(translations)) = (motion.rotations, motion.translations) else {
        return "?".to_owned();
    };
    let count = |number: usize, letter: &str| (number > 0).then(|| format!("{number}{letter}"));
    let counts = [count(rotations, "R"), count(translations, "T")];
    counts.into_iter().flatten().collect::<Vec<_>>().join(" ")
}

/// What a motion that is no subgroup does, or what of it is not decided.
fn text(motion: &RelativeMotion) -> String {
    use DisplacementSubgroup as G;
    if let Some(class) = &motion.class {
        return class.to_string();
    }
    let within = match motion.within {
        None | Some(G::General) => String::new(),
        Some(within) => format!(", within {within}"),
    };
    match (motion.freedom, motion.rotations, motion.translations) {
        (None, ..) => format!("not decided{within}"),
        (Some(1), None, _) => format!("whether it rotates is not decided{within}"),
        (Some(1), Some(0), _) => curve(motion),
        (Some(1), Some(_), _) => moving_axis(motion),
        (Some(freedom), Some(0), _) if motion.tilts.is_some() => tilting(freedom, motion.tilts),
        (_, Some(0), _) => format!("translates over a surface{within}"),
        (Some(_), Some(r), Some(0)) => format!("{}{within}", counted(r, "rotation")),
        (Some(_), Some(r), Some(t)) => {
            let (r, t) = (counted(r, "rotation"), counted(t, "translation"));
            format!("{r}, {t}{within}")
        }
        (Some(_), ..) => format!("how it rotates is not decided{within}"),
    }
}

/// Translations that come with a tilt.
fn tilting(freedom: usize, tilts: Option<f64>) -> String {
    let degrees = tilts.unwrap_or(0.0).to_degrees();
    format!(
        "{}, tilting by up to {}° per metre",
        counted(freedom, "translation"),
        figure(degrees)
    )
}

fn counted(number: usize, what: &str) -> String {
    let s = if number == 1 { "" } else { "s" };
    format!("{number} {what}{s}")
}

fn curve(motion: &RelativeMotion) -> String {
    use DisplacementSubgroup as G;
    if !motion.axes_move {
        return "translates, along a line or a curve is not decided".to_owned();
    }
    match motion.within {
        Some(plane @ G::PlanarTranslation { .. }) => {
            let plane = plane.to_string();
            let place = plane.strip_prefix("translation ").unwrap_or("");
            format!("translates along a curve {place}")
        }
        _ => "translates along a curve".to_owned(),
    }
}

fn moving_axis(motion: &RelativeMotion) -> String {
    use DisplacementSubgroup as G;
    if !motion.axes_move {
        let within = match motion.within {
            None | Some(G::General) => String::new(),
            Some(within) => format!(", within {within}"),
        };
        return format!("whether its axis moves is not decided{within}");
    }
    match motion.within {
        Some(G::Planar { normal }) => {
            let normal = coordinates(&normal);
            format!("planar: rotates about a moving axis along {normal}")
        }
        Some(G::Spherical { centre }) => {
            let point = coordinates(&centre);
            format!("rotates about a moving axis through the fixed point {point}")
        }
        Some(within @ G::Cylindrical { .. }) => format!("{within}, both at once"),
        _ => screwing(motion.pitches, SEEN),
    }
}

/// Where pitches of a branch that was not followed were looked at.
pub(super) const SEEN: &str = " at the poses looked at";

/// How a link screws about a moving axis; `over`: where its pitches were looked at.
pub(super) fn screwing(pitches: Option<[f64; 2]>, over: &str) -> String {
    match pitches {
        Some([0.0, 0.0]) => "rotates about a moving axis".to_owned(),
        Some([least, greatest]) => {
            let (least, greatest) = (figure(least), figure(greatest));
            let pitch = match least == greatest {
                true => least,
                false => format!("{least} … {greatest}"),
            };
            format!("screws about a moving axis, pitch {pitch} m/rad{over}")
        }
        None => "moves about a moving axis; whether it screws is not decided".to_owned(),
    }
}
