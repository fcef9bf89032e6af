//! MJCF: bodies that `<attach>` brings from other files, against what MuJoCo 4.0.0 makes of them.

use crate::support::empty_folder;
use kutzbach::format::{FormatError, Reading, read_file};
use kutzbach::mechanism::{Joint, Mechanism};
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
            r#"<attach model="arm" prefix="l_"/>"#,
            "<attach> without a `body`",
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
