//! Links that are fixed before joints, as most robots have them for frames, change nothing that is known of a mechanism.

use crate::support;

use std::fmt::Write as _;
use std::fs;
use support::{empty_folder, folder, mechanism_files, sample};

/// The text of a mechanism with so many links in a row fixed between the parent of every joint and the joint.
fn with_frames(text: &str, count: usize) -> String {
    const PARENT: &str = "<parent link=\"";
    let mut pieces = text.split(PARENT);
    let mut framed = pieces.next().unwrap().to_owned();
    let mut frames = String::new();
    for (joint, piece) in pieces.enumerate() {
        let (parent, rest) = piece.split_once('"').unwrap();
        let mut before = parent.to_owned();
        for number in 0..count {
            // Named so that they come first wherever names decide.
            let frame = format!("a_frame_{joint}_{number}");
            let _ = write!(
                frames,
                r#"<link name="{frame}"/><joint name="{frame}" type="fixed">{PARENT}{before}"/><child link="{frame}"/></joint>"#
            );
            before = frame;
        }
        let _ = write!(framed, "{PARENT}{before}\"{rest}");
    }
    framed.replace("</robot>", &format!("{frames}</robot>"))
}

/// Checks all mechanisms with frames against what their files state.
fn check(count: usize) {
    let framed = empty_folder(&format!("frames_{count}"));
    for (_, path) in sample(mechanism_files(&folder("mechanisms")), 3) {
        let text = with_frames(&fs::read_to_string(&path).unwrap(), count);
        fs::write(framed.join(path.file_name().unwrap()), text).unwrap();
    }
    let output = crate::support::program()
        .arg("check")
        .arg(&framed)
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{told}");
}

#[test]
fn a_frame_before_every_joint_changes_nothing() {
    check(1);
}

mod corpus {
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn three_frames_before_every_joint_change_nothing() {
        super::check(3);
    }
}
