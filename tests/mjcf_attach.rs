//! MJCF: bodies that `<attach>` brings from other files, against what MuJoCo 4.0.0 makes of them.

use crate::support::empty_folder;
use kutzbach::format::{FormatError, Reading, read_file};
use kutzbach::mechanism::{Configuration, Joint, Mechanism};
use kutzbach::mobility::{AnalysisOptions, analyse};
use std::path::Path;

const ARM: &str = r#"<mujoco model="arm"><compiler angle="radian"/>
    <default><joint damping="2"/><default class="q"><joint axis="0 1 0"/></default></default>
    <worldbody><body name="up" childclass="q" pos="0.5 0 0"><joint name="s" range="-1 1"/>
    <body name="low" pos="1 0 0"><joint name="e"/></body></body>
    <body name="other"><joint name="o"/></body></worldbody>
    <equality><joint joint1="s" joint2="e"/><joint joint1="s" joint2="o"/></equality>
    <actuator><motor joint="s"/><motor joint="o"/></actuator></mujoco>"#;

fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).unwrap();
}

/// A base on a hinge in degrees, with something in it.
fn base(folder: &Path, inside: &str, more: &str) -> Result<Reading, FormatError> {
    let text = format!(
        r#"<mujoco><asset><model name="arm" file="arm.xml"/></asset><default><joint axis="1 0 0"/></default>
        <worldbody><body name="base" pos="0 0 1"><joint name="b" range="-90 90"/>{inside}</body></worldbody>{more}</mujoco>"#
    );
    write(folder, "main.xml", &text);
    read_file(folder.join("main.xml"), &[])
}

fn finite(mechanism: &Mechanism) -> Option<usize> {
    let analysis = analyse(mechanism, &AnalysisOptions::default()).unwrap();
    analysis.mobility.finite()
}

fn joint<'m>(mechanism: &'m Mechanism, name: &str) -> &'m Joint {
    mechanism.joint(mechanism.joint_named(name).unwrap())
}

/// An equality between what is brought and what is not holds nothing, and is told, whatever it says of being active.
#[test]
fn what_is_half_brought_is_told() {
    for (index, active) in ["", r#"active="true""#, r#"active="false""#]
        .iter()
        .enumerate()
    {
        let folder = empty_folder(&format!("mjcf_attach_half_{index}"));
        let text = format!(
            r#"<mujoco><worldbody><body name="up"><joint axis="0 1 0"/><geom size="0.1"/></body>
<body name="other" pos="0 0 1"><joint axis="0 1 0"/><geom size="0.1"/></body></worldbody>
<equality><connect body1="up" body2="other" anchor="1 0 0" {active}/></equality></mujoco>"#
        );
        write(&folder, "arm.xml", &text);
        let attach = r#"<attach model="arm" body="up" prefix="a_"/>"#;
        let reading = base(&folder, attach, "").unwrap();
        let mut told = reading.skipped.iter();
        let told = told.any(|skip| skip.what.contains("<connect> that is not active"));
        assert!(told, "{active}: {:?}", reading.skipped);
        assert!(reading.mechanism.couplings().is_empty());
    }
}

#[test]
fn a_model_without_a_name_is_called_as_its_file_calls_it() {
    let folder = empty_folder("mjcf_attach_name");
    write(&folder, "arm.xml", ARM);
    write(&folder, "nameless.xml", &ARM.replace(r#" model="arm""#, ""));
    let main = |attach: &str| {
        let text = format!(
            r#"<mujoco><asset><model file="arm.xml"/><model file="nameless.xml"/></asset><worldbody>{attach}</worldbody></mujoco>"#
        );
        write(&folder, "main.xml", &text);
        read_file(folder.join("main.xml"), &[])
    };
    for model in ["arm", "MuJoCo Model"] {
        let attach = format!(r#"<attach model="{model}" body="up" prefix="l_"/>"#);
        let reading = main(&attach).unwrap();
        assert!(reading.mechanism.link_named("l_low").is_some(), "{model}");
    }
    let error = main(r#"<attach model="amr" body="up" prefix="l_"/>"#).unwrap_err();
    assert!(error.message.contains("no model `amr`"), "{error}");
}

#[test]
fn a_body_of_another_file_is_brought_with_what_couples_it() {
    let folder = empty_folder("mjcf_attach");
    write(&folder, "arm.xml", ARM);
    let two = r#"<attach model="arm" body="up" prefix="l_"/><frame pos="1 0 0"><attach model="arm" body="up" prefix="r_"/></frame>"#;
    let reading = base(&folder, two, "").unwrap();
    let mechanism = &reading.mechanism;
    let names: Vec<&str> = mechanism
        .links()
        .iter()
        .map(|link| &link.name[..])
        .collect();
    assert_eq!(names, ["world", "base", "l_up", "l_low", "r_up", "r_low"]);
    // Five hinges; in each arm the second one follows the first.
    assert_eq!(finite(mechanism), Some(3));
    assert_eq!(mechanism.actuated().len(), 2);
    // Each file has angles and classes of its own.
    let hinge = |name: &str| {
        let joint = joint(mechanism, name);
        let axis = joint.axis.0.each_ref().map(|x| x.value());
        (axis, joint.bounds().map(|(_, upper)| upper))
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    let (axis, upper) = hinge("b");
    assert_eq!(axis, [1.0, 0.0, 0.0]);
    assert!((upper.unwrap() - quarter).abs() < 1e-15);
    assert_eq!(hinge("l_s"), ([0.0, 1.0, 0.0], Some(1.0)));
    assert_eq!(hinge("r_e"), ([0.0, 1.0, 0.0], None));
    let damping = joint(mechanism, "l_e").dynamics.as_ref().unwrap();
    assert_eq!(damping.damping.as_ref().unwrap().value(), 2.0);
    assert!(joint(mechanism, "b").dynamics.is_none());
    let position = &joint(mechanism, "r_s").predecessor.frame.position;
    assert_eq!(position[0].value(), 1.5);
    // What is coupled to something that is not brought is told.
    let told = reading
        .skipped
        .iter()
        .find(|skip| skip.what.contains("<joint> that is not active"));
    assert_eq!(told.map(|skip| skip.count), Some(2));
    // What the main file says of them, by their names there.
    let more = r#"<equality><joint joint1="b" joint2="l_s"/></equality>"#;
    let reading = base(&folder, two, more).unwrap();
    assert_eq!(finite(&reading.mechanism), Some(2));
    // A body inside, with the class that those around it give it.
    let low = base(
        &folder,
        r#"<attach model="arm" body="low" prefix="x"/>"#,
        "",
    )
    .unwrap();
    let axis = &joint(&low.mechanism, "xe").axis.0;
    assert_eq!(axis.each_ref().map(|x| x.value()), [0.0, 1.0, 0.0]);
    assert_eq!(finite(&low.mechanism), Some(2));
    std::fs::remove_dir_all(&folder).unwrap();
}

/// The arm, with a body of a model in its hand.
fn attaching(model: &str, body: &str) -> String {
    let asset = format!(r#"<asset><model name="{model}" file="{model}.xml"/></asset><default>"#);
    let attach = format!(r#"<attach model="{model}" body="{body}" prefix="h_"/></body></body>"#);
    let text = ARM.replacen("<default>", &asset, 1);
    text.replacen("</body></body>", &attach, 1)
}

#[test]
fn models_attach_models() {
    let folder = empty_folder("mjcf_attach_nested");
    write(
        &folder,
        "hand.xml",
        r#"<mujoco><worldbody><body name="palm"><joint name="turn" axis="0 0 1" range="-90 90"/></body></worldbody></mujoco>"#,
    );
    let arm = attaching("hand", "palm");
    write(&folder, "arm.xml", &arm);
    let reading = base(
        &folder,
        r#"<attach model="arm" body="up" prefix="l_"/>"#,
        "",
    )
    .unwrap();
    let turn = joint(&reading.mechanism, "l_h_turn");
    let (_, upper) = turn.bounds().unwrap();
    assert!((upper - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    assert_eq!(finite(&reading.mechanism), Some(3));
    // A model that attaches itself has no end.
    let own = attaching("arm", "up");
    write(&folder, "arm.xml", &own);
    let error = base(
        &folder,
        r#"<attach model="arm" body="up" prefix="l_"/>"#,
        "",
    )
    .unwrap_err();
    assert!(error.message.contains("attached one to another"), "{error}");
    std::fs::remove_dir_all(&folder).unwrap();
}

/// A file with something in its world beside the bodies, in degrees and in a frame.
const RIG: &str = r#"<mujoco model="rig"><compiler angle="degree"/><default><joint damping="2"/></default>
    <worldbody><geom type="box" size="0.1 0.2 0.3" euler="0 0 90"/><site name="hook" pos="0 0 2"/>
    <frame name="shifted" pos="0 0 0.5"><body name="up" pos="0.5 0 0"><joint name="s" range="-90 90"/>
    <body name="low" pos="1 0 0"><joint type="ball"/></body></body></frame>
    <body name="other" pos="0 2 0"><joint name="o" type="slide"/></body></worldbody>
    <contact><exclude body1="up" body2="low"/></contact>
    <keyframe><key name="home" qpos="0.1 1 0 0 0 0.3" qvel="0"/><key qpos="0.5 1 0 0 0 0.7"/></keyframe></mujoco>"#;

/// The rig attached to the base, which has angles in radians.
fn rigged(folder: &Path, inside: &str, more: &str) -> Reading {
    write(folder, "rig.xml", RIG);
    let text = format!(
        r#"<mujoco><compiler angle="radian"/><asset><model name="rig" file="rig.xml"/></asset><worldbody>
        <body name="base" pos="0 0 1"><joint name="b" ref="0.5"/>{inside}</body><body name="z"><joint name="zz"/></body></worldbody>{more}</mujoco>"#
    );
    write(folder, "main.xml", &text);
    read_file(folder.join("main.xml"), &[]).unwrap()
}

/// The configurations by name, and the first value of each joint in them.
fn poses(reading: &Reading) -> Vec<(String, Vec<(String, f64)>)> {
    let mechanism = &reading.mechanism;
    let pose = |one: &Configuration| -> (String, Vec<(String, f64)>) {
        let positions = one.positions.iter();
        let named = positions.map(|(joint, values)| {
            let name = mechanism.joint(*joint).name.clone();
            (name, values[0].value())
        });
        (one.name.clone(), named.collect())
    };
    mechanism.configurations().iter().map(pose).collect()
}

fn at(values: &[(&str, f64)]) -> Vec<(String, f64)> {
    let owned = values
        .iter()
        .map(|(name, value)| ((*name).to_owned(), *value));
    owned.collect()
}

#[test]
fn a_whole_world_and_a_frame_of_another_file_are_brought() {
    let folder = empty_folder("mjcf_attach_world");
    let moved = r#"<frame pos="1 0 0"><attach model="rig" prefix="l_"/></frame>"#;
    let reading = rigged(&folder, moved, "");
    let mechanism = &reading.mechanism;
    let names: Vec<&str> = mechanism
        .links()
        .iter()
        .map(|link| &link.name[..])
        .collect();
    assert_eq!(names, ["world", "base", "l_up", "l_low", "l_other", "z"]);
    assert_eq!(finite(mechanism), Some(1 + 1 + 3 + 1 + 1));
    let place = |name: &str| {
        let joint = joint(mechanism, name);
        joint
            .predecessor
            .frame
            .position
            .each_ref()
            .map(|x| x.value())
    };
    // As MuJoCo 4.0.0 places them in the base.
    assert_eq!(place("l_s"), [1.5, 0.0, 0.5]);
    assert_eq!(place("l_o"), [1.0, 2.0, 0.0]);
    let (_, upper) = joint(mechanism, "l_s").bounds().unwrap();
    assert!((upper - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    // What stands in the world of the file is in the base, by the angles of the file.
    let base = mechanism.link(mechanism.link_named("base").unwrap());
    let [box_of_rig] = &base.collisions[..] else {
        panic!("{:?}", base.collisions);
    };
    let yaw = box_of_rig.origin.roll_pitch_yaw[2].value();
    assert!((yaw - std::f64::consts::FRAC_PI_2).abs() < 1e-15, "{yaw}");
    // What stays behind is told.
    let told = |what: &str| reading.skipped.iter().any(|skip| skip.what.contains(what));
    assert!(told("<contact>"), "{:?}", reading.skipped);

    let part = r#"<attach model="rig" frame="shifted" prefix="l_"/>"#;
    let reading = rigged(&folder, part, "");
    let mechanism = &reading.mechanism;
    let names: Vec<&str> = mechanism
        .links()
        .iter()
        .map(|link| &link.name[..])
        .collect();
    assert_eq!(names, ["world", "base", "l_up", "l_low", "z"]);
    let joint = joint(mechanism, "l_s");
    assert_eq!(joint.predecessor.frame.position[2].value(), 0.5);
    std::fs::remove_dir_all(&folder).unwrap();
}

/// As MuJoCo 4.0.0 has them in `key_qpos`, less the values as drawn.
#[test]
fn keys_of_another_file_come_with_what_is_attached() {
    let folder = empty_folder("mjcf_attach_keys");
    let whole = r#"<attach model="rig" prefix="l_"/>"#;
    let own = r#"<keyframe><key name="m" qpos="1 1 1 0 0 0 4 5"/></keyframe>"#;
    let reading = rigged(&folder, whole, own);
    let expected = [
        (
            "m",
            at(&[("b", 0.5), ("l_s", 1.0), ("l_o", 4.0), ("zz", 5.0)]),
        ),
        (
            "l_home",
            at(&[("b", 0.0), ("l_s", 0.1), ("l_o", 0.3), ("zz", 0.0)]),
        ),
        (
            "l_",
            at(&[("b", 0.0), ("l_s", 0.5), ("l_o", 0.7), ("zz", 0.0)]),
        ),
    ];
    let expected = expected.map(|(name, values)| (name.to_owned(), values));
    assert_eq!(poses(&reading), expected);
    // Of two attachments each has its own.
    let two = r#"<attach model="rig" body="up" prefix="l_"/><attach model="rig" body="other" prefix="r_"/>"#;
    let found = poses(&rigged(&folder, two, ""));
    let names: Vec<&str> = found.iter().map(|(name, _)| &name[..]).collect();
    assert_eq!(names, ["l_home", "l_", "r_home", "r_"]);
    let zero = |l_s: f64, r_o: f64| at(&[("b", 0.0), ("l_s", l_s), ("r_o", r_o), ("zz", 0.0)]);
    assert_eq!(found[1].1, zero(0.5, 0.0));
    assert_eq!(found[2].1, zero(0.0, 0.3));
    // Of several copies the first one is posed.
    let copies = r#"<replicate count="2" sep="-" offset="1 0 0"><attach model="rig" prefix="l_"/></replicate>"#;
    let found = poses(&rigged(&folder, copies, ""));
    let values = [
        ("b", 0.0),
        ("l_s-0", 0.1),
        ("l_o-0", 0.3),
        ("l_s-1", 0.0),
        ("l_o-1", 0.0),
        ("zz", 0.0),
    ];
    assert_eq!(found[0], ("l_home".to_owned(), at(&values)));
    // A key that does not fit its own file is told.
    let short = RIG.replace("0.1 1 0 0 0 0.3", "0.1");
    let reading = rigged(&folder, whole, "");
    assert_eq!(reading.mechanism.configurations().len(), 2);
    write(&folder, "rig.xml", &short);
    let reading = read_file(folder.join("main.xml"), &[]).unwrap();
    assert_eq!(reading.mechanism.configurations().len(), 1);
    let told = |what: &str| reading.skipped.iter().any(|skip| skip.what.contains(what));
    assert!(told(
        "<key> with 1 number in `qpos`, where the joints have 6"
    ));
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn keys_of_models_that_attach_models() {
    let folder = empty_folder("mjcf_attach_nested_keys");
    write(
        &folder,
        "hand.xml",
        r#"<mujoco><worldbody><body name="palm"><joint name="turn"/></body></worldbody>
        <keyframe><key name="k" qpos="0.7"/></keyframe></mujoco>"#,
    );
    let key = r#"</actuator><keyframe><key name="home" qpos="0.1 0.2 0.25 0.3"/></keyframe>"#;
    let arm = attaching("hand", "palm").replace("</actuator>", key);
    write(&folder, "arm.xml", &arm);
    let found = |body: &str| {
        let inside = format!(r#"<attach model="arm" {body}prefix="l_"/>"#);
        let reading = base(&folder, &inside, "").unwrap();
        // With equalities a key says where assembly begins.
        poses(&reading)
    };
    let all = [
        ("b", 0.0),
        ("l_s", 0.1),
        ("l_e", 0.2),
        ("l_h_turn", 0.25),
        ("l_o", 0.3),
    ];
    let of_hand = [
        ("b", 0.0),
        ("l_s", 0.0),
        ("l_e", 0.0),
        ("l_h_turn", 0.7),
        ("l_o", 0.0),
    ];
    let expected = [
        ("l_home".to_owned(), at(&all)),
        ("l_h_k".to_owned(), at(&of_hand)),
    ];
    assert_eq!(found(""), expected);
    let part = [("b", 0.0), ("l_e", 0.2), ("l_h_turn", 0.25)];
    assert_eq!(found(r#"body="low" "#)[0], ("l_home".to_owned(), at(&part)));
    // The hand is not there, nor is its key.
    let other = [("b", 0.0), ("l_o", 0.3)];
    let found = found(r#"body="other" "#);
    assert_eq!(found, [("l_home".to_owned(), at(&other))]);
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn what_cannot_be_attached_is_told_with_its_place() {
    let folder = empty_folder("mjcf_attach_faults");
    write(&folder, "arm.xml", ARM);
    for (inside, told) in [
        (
            r#"<attach model="leg" body="up" prefix="l_"/>"#,
            "there is no model `leg`",
        ),
        (
            r#"<attach model="arm" body="down" prefix="l_"/>"#,
            "there is no body `down`",
        ),
        (
            r#"<attach model="arm" frame="wrist" prefix="l_"/>"#,
            "there is no frame `wrist`",
        ),
        (
            r#"<attach model="arm" body="up" frame="wrist" prefix="l_"/>"#,
            "takes a `body` or a `frame`",
        ),
        (
            r#"<attach body="up" prefix="l_"/>"#,
            "<attach> without a `model`",
        ),
        (
            r#"<attach model="arm" body="up"/>"#,
            "needs the attribute `prefix`",
        ),
    ] {
        let error = base(&folder, inside, "").unwrap_err();
        assert!(error.message.contains(told), "{error}");
        assert!(
            error.file.ends_with("main.xml") && error.line == 2,
            "{error}"
        );
    }
    // A fault in what is attached is in its file.
    write(
        &folder,
        "arm.xml",
        &ARM.replace(r#"pos="1 0 0""#, r#"pos="1 0""#),
    );
    let inside = r#"<attach model="arm" body="up" prefix="l_"/>"#;
    let error = base(&folder, inside, "").unwrap_err();
    assert!(
        error.file.ends_with("arm.xml") && error.line == 4,
        "{error}"
    );
    std::fs::remove_dir_all(&folder).unwrap();
}
