//! What a file says beside its mechanism and what is worth keeping where the mechanism is written back: comments, the words of joint
//! types, motors as they stood.

use super::element::Element;
use super::writer::LOOPS_ARE_LOST;
use std::collections::BTreeMap;

/// What a file says beside its mechanism, for whoever writes the mechanism back ([`write_with`](super::write_with)).
///
/// Comments are kept that stand before the robot, and right before its links and joints; inside of elements they are lost.
#[derive(Clone, Debug, Default)]
pub struct Kept {
    /// Comments before the robot element.
    pub(super) head: Vec<String>,
    /// Comments before a link or a joint, by which of the two it is and its name.
    before: BTreeMap<(Owner, String), Vec<String>>,
    /// `revolute` or `continuous`, by the joint's name.
    types: BTreeMap<String, &'static str>,
    /// Elements that name motors.
    pub(super) motors: Vec<KeptMotors>,
}

/// What a comment stands before.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Owner {
    Link,
    Joint,
}

/// An element that names motors, as it stood.
#[derive(Clone, Debug)]
pub(super) struct KeptMotors {
    pub(super) text: String,
    /// The joints that it drives.
    pub(super) joints: Vec<String>,
}

impl KeptMotors {
    /// The text with the joints that it drives; `None` where it is not complete in itself: with names that the file defines elsewhere, or
    /// prefixes that it declares there.
    pub(super) fn of(text: String, joints: Vec<String>) -> Option<Self> {
        let complete = !joints.is_empty() && !text.contains('$');
        let complete = complete && roxmltree::Document::parse(&text).is_ok();
        complete.then_some(Self { text, joints })
    }
}

impl Kept {
    pub(super) fn of(root: Element<'_>, motors: Vec<KeptMotors>) -> Self {
        let mut kept = Self {
            head: texts(root),
            motors,
            ..Self::default()
        };
        for element in root.elements() {
            let owner = match element.name() {
                "link" => Owner::Link,
                "joint" | "loop" | "loop_joint" | "constraint" => Owner::Joint,
                _ => continue,
            };
            let Some(name) = element.attribute("name") else {
                continue;
            };
            let name = name.value.to_owned();
            let words = ["revolute", "continuous"];
            let word = element.attribute("type");
            let word = word.and_then(|word| words.into_iter().find(|known| *known == word.value));
            if let Some(word) = word.filter(|_| owner == Owner::Joint) {
                kept.types.insert(name.clone(), word);
            }
            let comments = texts(element);
            if !comments.is_empty() {
                kept.before.insert((owner, name), comments);
            }
        }
        kept
    }

    /// The comments before a link or joint.
    pub(super) fn before(&self, owner: Owner, name: &str) -> &[String] {
        let found = self.before.get(&(owner, name.to_owned()));
        found.map_or(&[], Vec::as_slice)
    }

    /// `revolute` or `continuous`, as the file has it.
    pub(super) fn type_of(&self, joint: &str) -> Option<&'static str> {
        self.types.get(joint).copied()
    }
}

fn texts(element: Element<'_>) -> Vec<String> {
    let comments = element.comments_before();
    // What the writer says itself it will say again.
    let comments = comments.iter().filter(|text| **text != LOOPS_ARE_LOST);
    comments.map(|text| (*text).to_owned()).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use crate::{Numbers, Reading, WriteOptions, read, write, write_with};

    const ARM: &str = r#"<?xml version="1.0"?>
<!-- Licence: none. -->
<robot name="arm">
  <link name="base"/>
  <!-- The crank,
       of steel. -->
  <link name="crank"/>
  <link name="rod"/>
  <!-- driven -->
  <joint name="main" type="revolute">
    <parent link="base"/><child link="crank"/><origin xyz="0 0 ${1/5}"/><axis xyz="0 ${-3/5} ${4/5}"/>
    <limit effort="10" velocity="2"/>
  </joint>
  <joint name="free" type="continuous"><parent link="crank"/><child link="rod"/><origin xyz="1 0 ${sqrt(2)}"/><axis xyz="0 0 ${-1}"/></joint>
  <loop name="back" type="revolute"><predecessor link="rod"/><successor link="base"><origin xyz="1 0 0"/></successor></loop>
  <transmission name="t1">
    <type>transmission_interface/SimpleTransmission</type>
    <joint name="main"><hardwareInterface>effort</hardwareInterface></joint>
    <actuator name="m1"><mechanicalReduction>50</mechanicalReduction></actuator>
  </transmission>
  <mujoco><compiler angle="radian"/><actuator><motor name="m2" joint="free" gear="3"/></actuator></mujoco>
</robot>"#;

    fn again(reading: &Reading, numbers: Numbers) -> String {
        let kept = Some(&reading.kept);
        write_with(&reading.mechanism, &WriteOptions { kept, numbers })
    }

    #[test]
    fn types_motors_and_comments_are_written_as_they_stood() {
        let reading = read(ARM, "arm", &[]).unwrap();
        let text = again(&reading, Numbers::Short);
        for part in [
            "\n<!-- Licence: none. -->\n",
            "  <!-- The crank,\n       of steel. -->\n  <link name=\"crank\"/>",
            "  <!-- driven -->\n  <joint name=\"main\" type=\"revolute\">",
            "<joint name=\"free\" type=\"continuous\">",
            "<loop name=\"back\" type=\"revolute\">",
            "<actuator name=\"m1\"><mechanicalReduction>50</mechanicalReduction></actuator>",
            "<mujoco><actuator><motor name=\"m2\" joint=\"free\" gear=\"3\"/></actuator></mujoco>",
            "Other programs do not read <loop>",
        ] {
            assert!(text.contains(part), "{part}\n{text}");
        }
        assert!(!text.contains("_transmission"), "{text}");
        // Read again it says the same, motors included, and once only.
        let second = read(&text, "again", &[]).unwrap();
        assert_eq!(again(&second, Numbers::Short), text);
        assert_eq!(second.mechanism.actuated(), reading.mechanism.actuated());
        // Without what was kept, the motors are named all the same.
        assert_eq!(
            write(&reading.mechanism).matches("<transmission").count(),
            2
        );
    }

    #[test]
    fn motors_whose_names_are_defined_elsewhere_are_named_anew() {
        let text = ARM.replace(
            "<joint name=\"main\"><hard",
            "<joint name=\"main\"><x:y/><hard",
        );
        let reading = read(&text, "arm", &[]).unwrap();
        let text = again(&reading, Numbers::Short);
        assert!(
            text.contains("<transmission name=\"main_transmission\">"),
            "{text}"
        );
    }

    #[test]
    fn short_decimals_are_written_as_such_where_that_makes_no_number_rounded() {
        let reading = read(ARM, "arm", &[]).unwrap();
        let short = again(&reading, Numbers::Short);
        for part in [
            "xyz=\"0 0 0.2\"",
            "xyz=\"0 -0.6 0.8\"",
            "xyz=\"0 0 -1\"",
            "${sqrt(2)}",
        ] {
            assert!(short.contains(part), "{part}\n{short}");
        }
        let decimal = again(&reading, Numbers::Decimals);
        assert!(
            decimal.contains("1.4142135623730951") && !decimal.contains('$'),
            "{decimal}"
        );
        // Beside numbers in seven decimals 0.2 would stand for 0.2000000.
        let rounded = ARM.replace("xyz=\"1 0 0\"", "xyz=\"1.2345678 0.8765432 0.1234567\"");
        let reading = read(&rounded, "arm", &[]).unwrap();
        let text = again(&reading, Numbers::Short);
        assert!(text.contains("${1/5}") && text.contains("${-1}"), "{text}");
    }
}
