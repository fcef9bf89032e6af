//! Loops in the words of other tools: what they mean, and that they are written back as loops.
//!
//! ```text
//!   b ------- c          a stands; b, c and d are joined by revolute joints
//!   |         |          about z; the loop is closed between b and c or
//!   a ------- d          between c and d
//! ```

mod gazebo;
mod loop_joints;
mod other_tools;
mod told;

use crate::format_support;

use format_support::difference;
use kutzbach::format::{ReadOptions, Reading, read, read_with, write};
use kutzbach::mechanism::{Joint, JointKind};
use kutzbach::number::Number;

fn reading(text: &str) -> Reading {
    let reading =
        read(text, "file", &[]).unwrap_or_else(|error| panic!("{error} {:?}\n{text}", error.help));
    let written = write(&reading.mechanism);
    let again = read(&written, "written", &[]).unwrap_or_else(|error| panic!("{error}\n{written}"));
    assert_eq!(
        difference(&reading.mechanism, &again.mechanism),
        None,
        "{written}"
    );
    reading
}

/// Three bars in a row on a, with something more; the second bar is turned by `rpy`.
fn bars(rpy: &str, more: &str) -> String {
    let joint = |name: &str, parent: &str, child: &str, origin: &str| {
        format!(
            "<joint name='{name}' type='continuous'><parent link='{parent}'/><child link='{child}'/>\
             <origin {origin}/><axis xyz='0 0 1'/></joint>"
        )
    };
    format!(
        "<robot name='r' xmlns:drake='urn:drake' xmlns:joint='urn:joint'><link name='a'/><link name='b'/><link name='c'/><link name='d'/>\n{}{}{}\n{more}</robot>",
        joint("ab", "a", "b", "xyz='0 1 0'"),
        joint("bc", "b", "c", &format!("xyz='2 0 0' rpy='{rpy}'")),
        joint("ad", "a", "d", "xyz='2 0 0'"),
    )
}

fn values(numbers: &[Number]) -> Vec<f64> {
    numbers.iter().map(Number::value).collect()
}

fn position(joint: &Joint) -> [Vec<f64>; 2] {
    [&joint.predecessor, &joint.successor].map(|side| values(&side.frame.position))
}

fn last(reading: &Reading) -> &Joint {
    reading.mechanism.joints().last().unwrap()
}

/// The fault of three bars with something more.
fn fault(more: &str) -> String {
    match read(&bars("0 0 0", more), "file", &[]) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("read: {more}"),
    }
}

/// What is told before everything else.
fn told_first(text: &str) -> Vec<String> {
    let warnings = reading(text).warnings.into_iter();
    warnings
        .filter(|warning| warning.kind.is_told_first())
        .map(|warning| warning.message)
        .collect()
}
