//! What generic poses of a branch tell of the reference mechanisms: locked joints, idle links, classes of motion.

#[path = "support/generic_poses.rs"]
mod generic_poses;
use crate::support;

use generic_poses::Posed;
use kutzbach::families::scissor_lift;
use kutzbach::group::{DisplacementSubgroup, Gauge, Pose, ScrewSystem};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{JointRole, RelativeMotion, branch_facts, relative_motions};
use kutzbach::number::Number;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use support::rewrite::Draft;
use support::{
    analysis, assert_none, folder, in_parallel, is_locked, own_mechanisms, zoo, zoo_mechanism,
};

fn expected() -> Value {
    let text = std::fs::read_to_string(folder("tests/zoo/expected.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn names(value: &Value) -> BTreeSet<String> {
    let names = value.as_array().unwrap().iter();
    names
        .map(|name| name.as_str().unwrap().to_owned())
        .collect()
}

fn locked(mechanism: &Mechanism, roles: &[JointRole]) -> BTreeSet<String> {
    let joints = mechanism.joints().iter().zip(roles);
    joints
        .flat_map(|(joint, role)| {
            let whole = (role.locked == Some(true)).then(|| joint.name.clone());
            whole.into_iter().chain(role.locked_parts.iter().cloned())
        })
        .collect()
}

fn disagreements(name: &str, mechanism: &Mechanism, expected: &Value) -> Vec<String> {
    let mut wrong = Vec::new();
    if expected["pose"] != "regular" {
        return wrong;
    }
    let Posed {
        geometry,
        structure,
        poses,
    } = Posed::of(mechanism);
    let facts = branch_facts(mechanism, &geometry, &structure, &poses);
    let found = locked(mechanism, &facts.roles);
    for (joint, role) in mechanism.joints().iter().zip(&facts.roles) {
        if joint.freedom() > 0 && role.locked.is_none() {
            wrong.push(format!(
                "{name}: whether {} is locked stays open",
                joint.name
            ));
        }
    }
    if expected["locked"] == "all" {
        let all = mechanism
            .joints()
            .iter()
            .filter(|joint| joint.freedom() > 0);
        let all: BTreeSet<String> = all.map(|joint| joint.name.clone()).collect();
        if found != all {
            wrong.push(format!("{name}: locked {found:?}, expected all"));
        }
    } else if expected["locked"].is_array() && expected["finite"] != 0 {
        let expected = names(&expected["locked"]);
        let whole = |names: &BTreeSet<String>| -> BTreeSet<String> {
            names.iter().filter(|n| !n.contains('.')).cloned().collect()
        };
        let parts = expected.iter().filter(|n| n.contains('.'));
        if whole(&found) != whole(&expected)
            || !parts.clone().all(|part| is_locked(part, &found, mechanism))
        {
            wrong.push(format!("{name}: locked {found:?}, expected {expected:?}"));
        }
    }
    if expected["idle"].is_array() {
        let found: BTreeSet<String> = facts
            .idle
            .iter()
            .map(|idle| mechanism.links()[idle.link].name.clone())
            .collect();
        let expected = names(&expected["idle"]);
        if found != expected {
            wrong.push(format!("{name}: idle {found:?}, expected {expected:?}"));
        }
        if facts.idle.iter().any(|idle| idle.freedom != 1) {
            wrong.push(format!("{name}: idle freedoms {:?}", facts.idle));
        }
    }
    let links = mechanism.links().len() - 1;
    if facts.motions.len() != links {
        wrong.push(format!(
            "{name}: motions of {} of {links} links",
            facts.motions.len()
        ));
    }
    // No link can do more than the mechanism.
    let finite = expected["finite"].as_u64().unwrap() as usize;
    for motion in &facts.motions {
        let dimension = motion.class.map(|class| class.dimension());
        if motion.freedom > Some(finite) || dimension.is_some_and(|d| Some(d) != motion.freedom) {
            wrong.push(format!("{name}: {motion:?}"));
        }
    }
    wrong
}

#[test]
fn locked_joints_and_idle_links_are_the_known_ones() {
    let expected = expected();
    let wrong = in_parallel(&zoo(), |(name, mechanism)| {
        disagreements(name, mechanism, &expected[name])
    });
    assert_none(&wrong.concat());
}

/// `freedom class rotations`, and the class in words where it has an axis, a direction or a point.
fn in_words(motion: &RelativeMotion) -> String {
    let class = motion.class.map_or("none".to_owned(), |class| {
        format!("{} {class}", class.short_name())
    });
    let [freedom, rotations] = [motion.freedom, motion.rotations].map(Option::unwrap);
    format!("{freedom} {rotations} {class}")
}

#[test]
fn links_move_in_the_known_subgroups() {
    let translation = "3 0 T3 translation in every direction";
    let turning_translation = "4 1 X translation in every direction and rotation about (0, 0, 1)";
    let wheel =
        |x: &str| format!("1 1 R rotation about the axis along (0, 0, 1) through ({x}, 0, 0)");
    let (at_0, at_1, at_3) = (wheel("0"), wheel("1"), wheel("3"));
    let known: &[(&str, &str, &str, &str)] = &[
        // Clavel's robot, with parallelograms of hinges and of rods between balls.
        ("delta_3RRPaR", "plat", "", translation),
        ("delta_3R_SS2", "plat", "", translation),
        (
            "delta_3R_SS2",
            "arm0",
            "",
            "1 1 R rotation about the axis along (0, 1, 0) through (2, 0, 0)",
        ),
        ("delta_3R_SS2", "rod0p", "", "4 3 none"),
        ("upu3_tsai", "plat", "", translation),
        ("tripteron_3PRRR", "plat", "", translation),
        (
            "tripteron_3PRRR",
            "u0",
            "",
            "2 1 C rotation about and translation along the axis along (1, 0, 0) through (0, 3, 0)",
        ),
        ("quattro_par4", "N3", "", turning_translation),
        ("h4_double_R", "N3", "", turning_translation),
        // Oldham's coupling: the disc slides on both shafts and makes a motion of its own in space.
        ("oldham_rppr", "B1", "", &at_0),
        ("oldham_rppr", "B2", "", "1 1 none"),
        ("oldham_rppr", "B3", "", &at_1),
        (
            "oldham_parallel_grooves",
            "B2",
            "",
            "1 0 T translation along (0.866025, 0.5, 0)",
        ),
        ("oldham_parallel_grooves", "B1", "", "0 0 E no motion"),
        (
            "ruiz_cartesian_table",
            "B1",
            "",
            "2 0 T2 translation in the plane normal to (0, 1, 0)",
        ),
        ("sarrus_6r", "B3", "", "1 0 T translation along (0, 0, 1)"),
        ("sarrus_6r", "B2", "", "1 1 none"),
        // Hinges about one point.
        ("spherical_4r", "B2", "", "1 1 none"),
        (
            "spherical_4r",
            "B1",
            "",
            "1 1 R rotation about the axis along (1, 0, 0) through (0, 0, 0)",
        ),
        (
            "agile_eye",
            "plat",
            "",
            "3 3 S rotation about the point (0, 0, 0)",
        ),
        // Planar loops; every hinge is seen as one from the link beside it.
        ("planar_4r_general", "B2", "", "1 1 none"),
        ("planar_4r_general", "B1", "", &at_0),
        ("planar_parallelogram_generic", "B2", "", "1 0 none"),
        ("planar_parallelogram_generic", "B3", "", &at_3),
        ("planar_parallelogram_generic", "B3", "B1", "1 0 none"),
        (
            "planar_3RRR",
            "plat",
            "",
            "3 1 G planar motion normal to (0, 0, 1)",
        ),
        (
            "delassus_hhhp",
            "B1",
            "",
            "1 1 H screw motion with pitch 0.2 m/rad about the axis along (0, 0, 1) through (0, 0, 0)",
        ),
        (
            "thomas_torras_4body",
            "pin",
            "",
            "2 1 C rotation about and translation along the axis along (0, 0, 1) through (2, 1, 0)",
        ),
        ("stewart_6SPS", "plat", "", "6 3 D unrestricted motion"),
        (
            "scissor_lift_3",
            "T",
            "",
            "1 0 T translation along (0, 1, 0)",
        ),
        ("exechon", "plat", "", "3 2 none"),
    ];
    let wrong = in_parallel(known, |(name, link, relative_to, expected)| {
        let mechanism = zoo_mechanism(name);
        let posed = Posed::of(&mechanism);
        let index = |name: &str| match name {
            "" => mechanism.ground().0,
            name => mechanism.link_named(name).unwrap().0,
        };
        let found = relative_motions(
            &mechanism,
            &posed.geometry,
            &posed.structure,
            &posed.poses,
            &[(index(link), index(relative_to))],
        );
        let found: Vec<String> = found.iter().map(in_words).collect();
        (found != [*expected]).then(|| format!("{name} {link}: {found:?}, expected {expected}"))
    });
    assert_none(&wrong.into_iter().flatten().collect::<Vec<_>>());
}

/// Across a hinge, a slider or a screw that moves, either link sees the other move in the joint's own subgroup.
#[test]
fn joints_of_one_freedom_are_seen_from_both_sides() {
    use kutzbach::mechanism::JointKind as K;
    let wrong = in_parallel(&zoo(), |(name, mechanism)| {
        if expected()[name]["pose"] != "regular" {
            return Vec::new();
        }
        let Posed {
            geometry,
            structure,
            poses,
        } = Posed::of(mechanism);
        let roles = branch_facts(mechanism, &geometry, &structure, &poses).roles;
        let mut wrong = Vec::new();
        for (joint, role) in mechanism.joints().iter().zip(&roles) {
            let letter = match joint.kind {
                _ if role.locked == Some(true) => "E",
                K::Revolute => "R",
                K::Prismatic => "T",
                K::Screw => "H",
                _ => continue,
            };
            let (a, b) = (joint.predecessor.link.0, joint.successor.link.0);
            let seen =
                relative_motions(mechanism, &geometry, &structure, &poses, &[(a, b), (b, a)]);
            let found: Vec<&str> = seen
                .iter()
                .map(|motion| motion.class.map_or("none", |class| class.short_name()))
                .collect();
            if found != [letter; 2] {
                wrong.push(format!(
                    "{name}: across {} {found:?}, not {letter}",
                    joint.name
                ));
            }
        }
        wrong
    });
    assert_none(&wrong.concat());
}

#[test]
fn every_rod_between_two_balls_is_idle() {
    for (name, prefix, count) in [("delta_3R_SS2", "rod", 6), ("h4_double_R", "rod", 8)] {
        let mechanism = zoo_mechanism(name);
        let posed = Posed::of(&mechanism);
        let facts = branch_facts(&mechanism, &posed.geometry, &posed.structure, &posed.poses);
        let idle: Vec<&str> = facts
            .idle
            .iter()
            .map(|idle| mechanism.links()[idle.link].name.as_str())
            .collect();
        assert_eq!(idle.len(), count, "{name}: {idle:?}");
        assert!(idle.iter().all(|link| link.starts_with(prefix)));
        assert!(facts.idle.iter().all(|idle| idle.freedom == 1));
    }
}

#[test]
fn telescopic_legs_between_two_balls_spin_as_a_whole() {
    let mechanism = zoo_mechanism("stewart_6SPS");
    let posed = Posed::of(&mechanism);
    let facts = branch_facts(&mechanism, &posed.geometry, &posed.structure, &posed.poses);
    assert_eq!(facts.idle.len(), 6);
    for idle in &facts.idle {
        assert!(
            idle.rod && idle.freedom == 1 && idle.with.len() == 1,
            "{idle:?}"
        );
    }
    assert!(facts.nearly_idle.is_empty());
}

#[test]
fn long_chains_are_no_harder() {
    let mechanism = scissor_lift(300).unwrap();
    let posed = Posed::of(&mechanism);
    let facts = branch_facts(&mechanism, &posed.geometry, &posed.structure, &posed.poses);
    assert!(facts.idle.is_empty());
    assert!(facts.roles.iter().all(|role| role.locked == Some(false)));
    assert_eq!(facts.motions.len(), mechanism.links().len() - 1);
    assert!(facts.motions.iter().all(|motion| motion.freedom == Some(1)));
    let straight = facts
        .motions
        .iter()
        .filter(|m| m.rotations == Some(0))
        .count();
    assert_eq!(straight, 3, "both sliders and the platform");
}

/// What is said of a branch, in the names of the mechanism it is compared with: links are told by their joints.
#[derive(Debug, Default, PartialEq)]
struct Told {
    locked: BTreeSet<String>,
    idle: BTreeSet<(BTreeSet<String>, usize)>,
    motions: BTreeMap<BTreeSet<String>, String>,
}

/// The classes themselves, in the order of [`Told::motions`].
type Classes = BTreeMap<BTreeSet<String>, DisplacementSubgroup>;

fn told(mechanism: &Mechanism, old: &dyn Fn(&str) -> String) -> (Told, Classes) {
    let Posed {
        geometry,
        structure,
        poses,
    } = Posed::of(mechanism);
    let facts = branch_facts(mechanism, &geometry, &structure, &poses);
    let joints_of = |link: usize| -> BTreeSet<String> {
        let joints = mechanism.joints().iter();
        joints
            .filter(|joint| joint.predecessor.link.0 == link || joint.successor.link.0 == link)
            .map(|joint| old(&joint.name))
            .collect()
    };
    let mut told = Told::default();
    let mut classes = Classes::new();
    for (joint, role) in mechanism.joints().iter().zip(&facts.roles) {
        if role.locked == Some(true) {
            told.locked.insert(old(&joint.name));
        }
        for part in &role.locked_parts {
            let suffix = &part[joint.name.len()..];
            told.locked.insert(format!("{}{suffix}", old(&joint.name)));
        }
    }
    told.idle = facts
        .idle
        .iter()
        .map(|idle| {
            // Which of several links gives its name to all depends on names.
            let links = idle.with.iter().chain([&idle.link]);
            (
                links.flat_map(|&link| joints_of(link)).collect(),
                idle.freedom,
            )
        })
        .collect();
    for motion in &facts.motions {
        let class = motion.class.map_or("none", |class| class.short_name());
        let words = format!("{:?} {:?} {class}", motion.freedom, motion.rotations);
        told.motions.insert(joints_of(motion.link), words);
        if let Some(class) = motion.class {
            classes.insert(joints_of(motion.link), class);
        }
    }
    (told, classes)
}

/// Whether the classes are those of the original moved by a displacement, axes and points included.
fn same_place(found: &Classes, original: &Classes, moved: &Pose, within: f64) -> bool {
    found
        .iter()
        .zip(original)
        .all(|((_, found), (_, original))| {
            let original = original.conjugated_by(moved);
            let gauge = Gauge::new(moved.translation, 1.0, within).unwrap();
            let space = ScrewSystem::span(&original.algebra(), &gauge).unwrap();
            found.algebra().iter().all(|twist| space.contains(twist))
        })
}

#[test]
fn facts_do_not_depend_on_the_description() {
    let known = expected();
    let same = |name: &str| name.to_owned();
    let (far, by) = ([1500, -2600, 777], [1500, -2600, 777].map(Number::integer));
    let stays = Pose::identity();
    let moves = Pose::translation(far.map(|x| x as f64).into());
    let wrong = in_parallel(&zoo(), |(name, mechanism)| {
        let mut wrong = Vec::new();
        if known[name]["pose"] != "regular" {
            return wrong;
        }
        let draft = Draft::of(mechanism);
        let (original, classes) = told(mechanism, &same);
        let mut compare = |how: &str, (found, there): (Told, Classes), by: Option<&Pose>| {
            // Three thousand metres cost four digits, and a branch that passes close to another as many again.
            let within = if how == "far away" { 1e-5 } else { 1e-8 };
            if found != original {
                wrong.push(format!("{name}, {how}: {found:?} instead of {original:?}"));
            } else if !by.is_none_or(|by| same_place(&there, &classes, by, within)) {
                wrong.push(format!("{name}, {how}: {there:?} instead of {classes:?}"));
            }
        };
        for seed in 1..=2 {
            let (shuffled, new_names) = draft.clone().shuffled(seed);
            let old_names: BTreeMap<&str, &str> = new_names
                .iter()
                .map(|(old, new)| (new.as_str(), old.as_str()))
                .collect();
            let old = |name: &str| old_names[name].to_owned();
            compare("shuffled", told(&shuffled.build(), &old), Some(&stays));
        }
        for (how, draft, by) in [
            ("far away", draft.clone().ground_moved(&by), Some(&moves)),
            ("with far frames", draft.clone().frames_moved(&by), None),
            ("turned", draft.clone().ground_turned(), None),
            ("in micrometres", draft.clone().scaled(6), None),
            ("in megametres", draft.clone().scaled(-6), None),
        ] {
            compare(how, told(&draft.build(), &same), by);
        }
        wrong
    });
    assert_none(&wrong.concat());
}

/// Two branches with one tangent part by the square of the way only: following the one must not end on the other.
#[test]
fn branches_that_touch_are_followed_apart() {
    let (_, spindle) = own_mechanisms()
        .into_iter()
        .find(|(name, _)| name == "spindle_on_plane")
        .unwrap();
    let branches = analysis(&spindle).branches.unwrap();
    let mut at_rest: Vec<BTreeSet<String>> = branches
        .iter()
        .map(|branch| locked(&spindle, &branch.roles))
        .collect();
    at_rest.sort();
    let spinning = ["plane", "second_hinge"].map(str::to_owned);
    assert_eq!(at_rest, [BTreeSet::new(), BTreeSet::from(spinning)]);
}

#[test]
fn a_surface_of_shaky_poses_is_one() {
    // A planar five-bar, and a strap of two bars, pulled straight, beside its crank: from the crank's pivot to its pin.
    let hinge = |name: &str, on: [&str; 2], at: &str| {
        format!(
            r#"<joint name="{name}" type="continuous"><parent link="{}"/><child link="{}"/><origin xyz="{at}"/><axis xyz="0 0 1"/></joint>"#,
            on[0], on[1]
        )
    };
    let close = |name: &str, on: [&str; 2], at: [&str; 2]| {
        format!(
            r#"<loop name="{name}" type="revolute"><predecessor link="{}"><origin xyz="{}"/></predecessor>
            <successor link="{}"><origin xyz="{}"/></successor><axis xyz="0 0 1"/></loop>"#,
            on[0], at[0], on[1], at[1]
        )
    };
    let links = ["base", "crank", "arm", "forearm", "rocker", "low", "high"];
    let links: String = links
        .map(|name| format!(r#"<link name="{name}"/>"#))
        .concat();
    let joints = [
        hinge("pivot", ["base", "crank"], "0 0 0"),
        hinge("pin", ["crank", "arm"], "1 2 0"),
        hinge("elbow", ["arm", "forearm"], "2 2 0"),
        hinge("foot", ["base", "rocker"], "6 0 0"),
        close("end", ["rocker", "forearm"], ["0 3 0", "3 -1 0"]),
        hinge("strap_foot", ["base", "low"], "0 0 0"),
        hinge("strap_pin", ["arm", "high"], "0 0 0"),
        close("middle", ["low", "high"], ["0.5 1 0", "-0.5 -1 0"]),
    ]
    .concat();
    let text = format!(r#"<robot name="strapped">{links}{joints}</robot>"#);
    let reading = kutzbach::format::read(&text, "strapped.urdf", &[]).unwrap();
    let found = support::analysis(&reading.mechanism);
    let kind = kutzbach::mobility::SingularKind::PermanentlyShaky;
    assert_eq!(found.mobility.kind, Some(kind));
    let branches: Vec<_> = found.branches.iter().flatten().collect();
    let facts: Vec<_> = branches
        .iter()
        .map(|branch| (branch.dimension, branch.instantaneous))
        .collect();
    assert_eq!(facts, [(2, Some(3))]);
}

#[test]
fn rods_of_a_table_spin_at_poses_that_are_shaky_all_along() {
    // Equal and parallel rods with a ball at each end carry a table: it translates over a sphere, and every rod spins.
    for feet in [
        &["0 0 0", "3 0 0", "3 2 0", "0 1 1"][..],
        &["0 0 0", "3 0 0", "3 2 0", "0 1 1", "1 3 -1", "4 1 2"],
        &["0 0 0", "2 0 0", "0 2 0", "3 3 0"],
    ] {
        let mut text =
            String::from(r#"<robot name="table"><link name="floor"/><link name="table"/>"#);
        for (index, foot) in feet.iter().enumerate() {
            text += &format!(
                r#"<link name="rod_{index}"/><joint name="foot_{index}" type="spherical"><parent link="floor"/>
                <child link="rod_{index}"/><origin xyz="{foot}"/></joint>"#
            );
            text += &match index {
                0 => r#"<joint name="top_0" type="spherical"><parent link="rod_0"/><child link="table"/>
                    <origin xyz="2 -1 3"/></joint>"#
                    .to_owned(),
                _ => format!(
                    r#"<loop name="top_{index}" type="spherical"><predecessor link="rod_{index}"><origin xyz="2 -1 3"/>
                    </predecessor><successor link="table"><origin xyz="{foot}"/></successor></loop>"#
                ),
            };
        }
        text += "</robot>";
        let reading = kutzbach::format::read(&text, "table.urdf", &[]).unwrap();
        let found = support::analysis(&reading.mechanism);
        let branches: Vec<_> = found.branches.iter().flatten().collect();
        let [branch] = &branches[..] else {
            panic!("{feet:?}: {} branches", branches.len());
        };
        assert_eq!(branch.dimension, 2 + feet.len(), "{feet:?}");
        assert_eq!(branch.instantaneous, Some(3 + feet.len()), "{feet:?}");
        let idle: Vec<(&str, usize)> = branch
            .idle
            .iter()
            .map(|idle| {
                (
                    reading.mechanism.links()[idle.link].name.as_str(),
                    idle.freedom,
                )
            })
            .collect();
        let rods: Vec<String> = (0..feet.len()).map(|rod| format!("rod_{rod}")).collect();
        let spinning: Vec<(&str, usize)> = rods.iter().map(|rod| (rod.as_str(), 1)).collect();
        assert_eq!(idle, spinning, "{feet:?}");
    }
}
