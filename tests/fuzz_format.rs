//! Mutated mechanism files: the reader gives a mechanism or an error with a place, and never panics; what it reads, it
//! writes so that it reads back the same.
//!
//! The cases are the same in every run. `KUTZBACH_FUZZ_CASES` sets how many there are (20,000 without it) and
//! `KUTZBACH_FUZZ_SEED` where they start; a failure prints the text that caused it.

use crate::format_support;

use format_support::{check_place, difference};
use kutzbach::format::{read_bytes, write};
use std::panic::catch_unwind;
use std::time::Instant;

/// Between them, these use every element of the format.
const SEEDS: [&str; 8] = [
    r#"<?xml version="1.0"?>
<robot name="four_bar" version="1.0">
  <link name="base"><inertial><origin xyz="0 0 0.1" rpy="0 0 1"/><mass value="1.5"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1e-3"/></inertial></link>
  <link name="crank"><collision name="rod"><origin xyz=".5 0 0"/><geometry><box size="1 0.1 0.1"/></geometry></collision></link>
  <link name="coupler"><visual><geometry><mesh filename="a.stl" scale="1 1 1"/></geometry><material name="red"/></visual></link>
  <link name="rocker"/>
  <joint name="j1" type="revolute" independent="true"><parent link="base"/><child link="crank"/><axis xyz="0 0 1"/>
    <limit lower="-3.14" upper="3.14" effort="10" velocity="2"/><dynamics damping="0.1" friction="0.2"/></joint>
  <joint name="j2" type="continuous"><parent link="crank"/><child link="coupler"/><origin xyz="0 1 0"/><axis xyz="0 0 1"/></joint>
  <joint name="j4" type="continuous"><parent link="base"/><child link="rocker"/><origin xyz="2.0 0 0"/><axis xyz="0 0 1"/><mimic joint="j1" multiplier="-1" offset="0.5"/></joint>
  <loop name="j3" type="revolute"><predecessor link="coupler"><origin xyz="2 0 0" rpy="0 0 0"/></predecessor><successor link="rocker"><origin xyz="0 1 0"/></successor><axis xyz="0 0 1"/></loop>
</robot>
"#,
    r#"<robot name="numbers" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="a" value="3/5"/>
  <xacro:property name="b" value="${sqrt(1 - a**2)}"/>
  <xacro:arg name="twist" default="pi/6"/>
  <link name="l0"/><link name="l1"/><link name="l2"/>
  <joint name="h" type="screw"><parent link="l0"/><child link="l1"/><origin xyz="${a} 0 ${sqrt(3)/2}" rpy="$(arg twist) 0 ${radians(30)}"/><axis xyz="${a} ${b} 0"/><screw lead="${2*$(arg twist)}"/></joint>
  <joint name="d" type="distance"><parent link="l1"/><child link="l2"/><distance value="${a + b}"/></joint>
  <loop name="u" type="universal"><predecessor link="l2"/><successor link="l0"><origin xyz="${-a} ${atan2(1, 2)} -0.25"/></successor><axis xyz="0 1 0"/><axis2 xyz="${cos(pi/5)} 0 1"/></loop>
</robot>
"#,
    r#"<robot name="all"><!-- every kind -->
  <ground link="b"/>
  <link name="a"/><link name="b"/><link name="c"/><link name="d"/><link name="e"/><link name="f"/><link name="g"/>
  <joint name="p" type="planar"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
  <joint name="s" type="spherical"><parent link="b"/><child link="c"/></joint>
  <joint name="x" type="schoenflies"><parent link="c"/><child link="d"/><axis xyz="0 1 1"/></joint>
  <joint name="free" type="floating"><parent link="d"/><child link="e"/><origin xyz="1 2 3"/></joint>
  <joint name="c1" type="cylindrical"><parent link="e"/><child link="f"/></joint>
  <joint name="fix" type="fixed"><parent link="f"/><child link="g"/><axis xyz="0 0 0"/></joint>
  <joint name="again" type="translational"><parent link="a"/><child link="g"/></joint>
  <loop name="l1" type="line_on_plane"><predecessor link="a"/><successor link="g"/><axis xyz="1 2 3"/><axis2 xyz="0 0 1"/></loop>
  <loop name="l2" type="point_on_line"><predecessor link="a"/><successor link="f"/></loop>
  <loop name="l3" type="point_on_plane"><predecessor link="b"/><successor link="f"/><axis2 xyz="1 1 1"/></loop>
  <loop name="l4" type="translating_screw"><predecessor link="b"/><successor link="e"/><screw lead="0.01"/></loop>
  <loop name="l5" type="planar_translation"><predecessor link="c"/><successor link="e"/></loop>
</robot>
"#,
    r#"<robot name="beside">
  <link name="a"/><link name="b"/><link name="c"/>
  <joint name="j" type="revolute"><parent link="a"/><child link="b"/></joint>
  <joint name="k" type="continuous"><parent link="a"/><child link="c"/><joint_properties damping="1"/></joint>
  <coupling name="belt"><predecessor link="b"/><successor link="c"/><ratio value="-2"/></coupling>
  <configuration name="open"><position joint="j" value="0.3"/><position joint="k" start="-1e-2"/></configuration>
  <scene><gravity xyz="0 0 -9.81"/><contact/><limits/><friction/><damping/><drive joint="j" velocity="1.0" torque="10"/></scene>
  <expect finite="1" instantaneous="1" redundant="3" kutzbach="-2" pose="singular" kind="cusp" locked="j k.rot" idle="b" branches="2" branch_dimensions="1 2"/>
</robot>
"#,
    // What other tools add, and how they write loops.
    r#"<robot name="dialects" xmlns:joint="urn:joint">
  <link name="a" type="x"><contact/><origin xyz="0 0 1"/>text<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>
  <link name="b"/><link name="c"/><link name="d"/>
  <joint name="j" type="revolute" independent="True"><parent link="a"/><child link="b"/><origin xyz="0 1 0" rpy="1.5707963 0 0.25"/><axis xyz="0 0 1" rpy="0 0 0"/><limit lower="1" upper="-1" command_effort="3"/><hardware/></joint>
  <joint name="k" type="continuous"><parent link="b"/><child link="c"/><origin xyz="2 0 0" rpy="0 ${pi/2} 0"/><drake:mimic joint="j" multiplier="2"/></joint>
  <joint name="m" type="fixed"><parent link="a"/><child link="d"/><mimic joint="j"/><axis xyz="0 0 0"/></joint>
  <gazebo><joint name="l" type="revolute"><parent>c</parent><child>r::d</child><pose degrees="true">0 -0.5 0 0 0 30</pose><axis><xyz expressed_in="__model__">0 0 1</xyz><limit><lower>-1</lower><upper>1e16</upper></limit></axis></joint></gazebo>
  <gazebo><joint name="s" type="screw"><parent>world</parent><child>c</child><axis><xyz>0 1 0</xyz><use_parent_model_frame>1</use_parent_model_frame></axis><thread_pitch>-100</thread_pitch></joint></gazebo>
  <gazebo><link name="e"><pose relative_to="b">2 0.5 0 0 0 0</pose></link><joint name="u" type="revolute2"><parent>d</parent><child>e</child><axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 1 0</xyz></axis2></joint></gazebo>
  <gazebo><joint:slider name="j"><body1>a</body1><body2>c</body2><anchor>c</anchor><axis>0 1 0</axis><anchorOffset>0 -1 0</anchorOffset></joint:slider></gazebo>
  <ros2_control name="r"><joint name="j"><command_interface name="position"/></joint></ros2_control>
  <transmission name="t"><type>x</type><joint name="k"/><joint name="x"/></transmission>
</robot>
"#,
    r#"<robot xmlns:drake="urn:drake"><!-- a -- b -->
  <link name="a"/><link name="b"/><link name="c"/><link name="closing_p_1"/><link name="closing_p_2"/>
  <drake:joint name="j" type="screw"><parent link="a"/><child link="b"/><drake:screw_thread_pitch value="0.02"/></drake:joint>
  <drake:joint name="k" type="universal"><parent link="b"/><child link="c"/></drake:joint>
  <joint name="f" type="fixed"><parent link="b"/><child link="closing_p_1"/></joint>
  <joint name="g" type="fixed"><parent link="c"/><child link="closing_p_2"/></joint>
  <drake:ball_constraint><drake:ball_constraint_body_A name="a"/><drake:ball_constraint_body_B name="c"/><drake:ball_constraint_p_AP value="0 1 0"/><drake:ball_constraint_p_BQ value="0 0 0.5"/></drake:ball_constraint>
  <drake:distance_constraint><drake:distance_constraint_body_A name="a"/><drake:distance_constraint_body_B name="c"/><drake:distance_constraint_p_AP value="0 1 0"/><drake:distance_constraint_p_BQ value="0 0 0.5"/><drake:distance_constraint_distance value="0.5"/></drake:distance_constraint>
  <loop_joint name="l" type="spherical"><link1 link="a" xyz="0 1 0" rpy="0 0 0"/><link2 link="c" xyz="0 0 0"/></loop_joint>
  <constraint name="m" type="universal"><parent link="a"/><parent_origin xyz="0 1 0"/><parent_axis xyz="0 0 1"/><child link="c"/><child_origin xyz="0 0 3"/><child_axis xyz="1 0 0"/></constraint>
  <link name="d"/><joint name="n" type="continuous"><parent link="a"/><child link="d"/></joint>
  <link name="e"/><joint name="o" type="continuous"><parent link="a"/><child link="e"/></joint>
  <coupling name="h" type="rolling"><predecessor link="d"/><successor link="e"/><ratio value="6.0"/></coupling>
  <undeclared:thing undeclared:x="1"/>
  <mujoco><actuator><motor joint="j"/></actuator></mujoco>
</robot>
"#,
    "<robot name=\"é&lt;&#65;\">\r\n  <link name='a'/>\r\n  <gazebo><x y=\"1\"/>text</gazebo>\r\n  <![CDATA[ ]]><transmission/>\r\n</robot>",
    r#"<robot name="expanded" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="side" default="left"/>
  <xacro:property name="sizes" value="${[0.5, 2, sqrt(2)/2]}"/>
  <xacro:property name="a" value="0.25" lazy_eval="false"/>
  <xacro:macro name="leg" params="name parent reflect:=1 at:=^|'0 0 1' *axis">
    <link name="${name}"/>
    <joint name="${name}_j" type="revolute"><parent link="${parent}"/><child link="${name}"/>
      <origin xyz="${reflect * a} 0 ${sizes[2]}" rpy="0 ${pi/2} ${radians(30)}"/><xacro:insert_block name="axis"/></joint>
    <xacro:if value="${len(name) &lt; 3 and reflect == 1}"><xacro:leg name="${name}_" parent="${name}"><axis xyz="${at}"/></xacro:leg></xacro:if>
  </xacro:macro>
  <link name="base"/>
  <xacro:leg name="$(arg side)" parent="base"><axis xyz="1 0 0"/></xacro:leg>
  <xacro:unless value="${'%s' % [1, 2][0:1] == '[1]'}"><bad/></xacro:unless>
  <xacro:leg name="l" parent="base" reflect="-1"><axis xyz="0 ${1 if a > 0.1 else 2} 0"/></xacro:leg>
</robot>
"#,
];

/// Words that a mutation puts in the place of others.
#[rustfmt::skip]
const WORDS: [&str; 80] = [
    "0",
    "-0",
    "1",
    "-1",
    "0.866",
    "1e-7",
    "1e100",
    "1e101",
    "1e-400",
    "nan",
    "inf",
    "0x1",
    "1e",
    ".",
    "-",
    "+.5",
    "${",
    "}",
    "${1/0}",
    "${1/3}",
    "${sqrt(2)}",
    "${sqrt(-1)}",
    "${pi}",
    "${a}",
    "${2**0.5}",
    "${acos(3/5)}",
    "$(arg twist)",
    "$(arg a)",
    "$",
    "${cos(1)*exp(1)}",
    "${9**999}",
    "${((((",
    "gazebo",
    "parent",
    "child",
    "pose",
    "world",
    "__model__",
    "drake:mimic",
    "loop_joint",
    "link1",
    "ball",
    "rolling",
    "True",
    "c",
    "x:y",
    "revolute",
    "screw",
    "distance",
    "universal",
    "fixed",
    "floating",
    "spherical",
    "a",
    "b",
    "j",
    "base",
    "link",
    "joint",
    "loop",
    "origin",
    "axis",
    "axis2",
    "name",
    "xyz",
    "&amp;",
    "&#10;",
    "é",
    "\u{feff}",
    "<!--",
    "-->",
    "<!DOCTYPE x>",
    "${[1]*99999999}",
    "${'a'*999999}",
    "${range(9**9)}",
    "${name}",
    "xacro:leg",
    "xacro:include",
    "${[x for x in 'abc' for y in x]}",
    "${dict(a=1).a}",
];

/// Numbers that a mutation puts in the place of others.
#[rustfmt::skip]
const NUMBERS: [&str; 16] = [
    "0", "-0", "1.", "-.5", "0.8660254", "1e-7", "1e100", "-1e-400", "0.00", "${1/3}", "${sqrt(2)}", "${pi/7}", "${2**0.5}",
    "${acos(3/5)}", "${cos(1) + sqrt(sqrt(2))}", "${sin(radians(12)) * -3}",
];

/// Reproducible random numbers (splitmix64; Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit.max(1) as u64) as usize
    }
}

/// The range of a random piece between two delimiters, which are not part of it.
fn piece(
    bytes: &[u8],
    random: &mut Random,
    delimits: impl Fn(u8) -> bool,
) -> std::ops::Range<usize> {
    let at = random.below(bytes.len());
    let start = bytes[..at]
        .iter()
        .rposition(|b| delimits(*b))
        .map_or(0, |i| i + 1);
    let end = bytes[at..]
        .iter()
        .position(|b| delimits(*b))
        .map_or(bytes.len(), |i| at + i);
    start..end.max(start)
}

fn is_mark(byte: u8) -> bool {
    matches!(
        byte,
        b' ' | b'"' | b'<' | b'>' | b'/' | b'=' | b'\n' | b'\'' | b'{' | b'}'
    )
}

/// One to four changes to bytes, words, attributes or elements. Half of the cases only exchange values and lines, which
/// many files survive.
fn mutate(bytes: &mut Vec<u8>, random: &mut Random) {
    let gentle = random.below(2) == 0;
    for _ in 0..=random.below(4) {
        if bytes.is_empty() {
            return;
        }
        let at = random.below(bytes.len());
        match if gentle {
            12 + random.below(2)
        } else {
            random.below(12)
        } {
            0 => bytes[at] = random.next() as u8,
            1 => bytes[at] ^= 1 << random.below(8),
            2 => bytes.insert(at, b"<>/\"' =&;${}()-.0123e\n"[random.below(22)]),
            3 => {
                bytes.remove(at);
            }
            4 => bytes.truncate(at.max(1)),
            // A word for a word.
            5..=7 => {
                let range = piece(bytes, random, is_mark);
                let word = WORDS[random.below(WORDS.len())];
                bytes.splice(range, word.bytes());
            }
            // An attribute's value for another's.
            8 => {
                let value = piece(bytes, random, |b| b == b'"');
                let other = bytes[piece(bytes, random, |b| b == b'"')].to_vec();
                bytes.splice(value, other);
            }
            // A tag or the space between two tags: removed, doubled, or put elsewhere.
            9 => {
                bytes.drain(piece(bytes, random, |b| b == b'>'));
            }
            10 => {
                let range = piece(bytes, random, |b| b == b'\n');
                let line = bytes[range.clone()].to_vec();
                bytes.splice(range.start..range.start, line);
            }
            // A number for a number.
            12 => {
                let range = piece(bytes, random, is_mark);
                if bytes[range.clone()].iter().any(u8::is_ascii_digit) {
                    bytes.splice(range, NUMBERS[random.below(NUMBERS.len())].bytes());
                }
            }
            _ => {
                let line: Vec<u8> = bytes.drain(piece(bytes, random, |b| b == b'\n')).collect();
                let to = piece(bytes, random, |b| b == b'\n').start.min(bytes.len());
                bytes.splice(to..to, line);
            }
        }
    }
}

/// Reads; checks the place of an error; writes and reads again. Returns whether it was read.
fn judge(bytes: &[u8]) -> bool {
    match read_bytes(bytes, "fuzz", &[]) {
        Ok(reading) => {
            let text = write(&reading.mechanism);
            let again = read_bytes(text.as_bytes(), "written", &[])
                .unwrap_or_else(|error| panic!("what was written is not read: {error}\n{text}"));
            if let Some(difference) = difference(&reading.mechanism, &again.mechanism) {
                panic!("what was written reads differently: {difference}\n{text}");
            }
            true
        }
        Err(error) => {
            assert!(!error.message.is_empty() && !error.message.contains('\n'));
            match std::str::from_utf8(bytes) {
                Ok(text) => check_place(text, &error),
                Err(fault) => assert!(error.span.start <= fault.valid_up_to()),
            }
            false
        }
    }
}

fn setting(name: &str, default: u64) -> u64 {
    match std::env::var(name) {
        Ok(text) => text
            .parse()
            .unwrap_or_else(|_| panic!("{name} is not a number: {text}")),
        Err(_) => default,
    }
}

#[test]
fn seeds_are_read() {
    for seed in SEEDS {
        assert!(judge(seed.as_bytes()), "{seed}");
    }
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn mutated_files_are_read_or_refused_with_a_place() {
        let cases = setting(
            "KUTZBACH_FUZZ_CASES",
            if crate::support::whole() {
                20_000
            } else {
                7_000
            },
        );
        let seed = setting("KUTZBACH_FUZZ_SEED", 1);
        let started = Instant::now();
        let mut read = 0u64;
        let mut slowest = (std::time::Duration::ZERO, Vec::new());
        for case in 0..cases {
            let mut random = Random(seed.wrapping_add(case).wrapping_mul(0x2545_f491_4f6c_dd1d));
            let mut bytes = SEEDS[random.below(SEEDS.len())].as_bytes().to_vec();
            mutate(&mut bytes, &mut random);
            let before = Instant::now();
            match catch_unwind(|| judge(&bytes)) {
                Ok(was_read) => read += u64::from(was_read),
                Err(_) => panic!(
                    "seed {seed}, case {case}:\n{}",
                    String::from_utf8_lossy(&bytes)
                ),
            }
            if before.elapsed() > slowest.0 {
                slowest = (before.elapsed(), bytes);
            }
        }
        let seconds = started.elapsed().as_secs_f64();
        println!(
            "{cases} cases, {read} read, {:.0} per second; slowest {:?}",
            cases as f64 / seconds,
            slowest.0
        );
        if slowest.0.as_millis() > 20 {
            println!("{}", String::from_utf8_lossy(&slowest.1));
        }
        assert!(
            cases < 1000 || (read > 0 && read < cases),
            "{read} of {cases} were read"
        );
    }
}
