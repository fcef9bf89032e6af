//! Bad input: every fault is told at its line and column, with what was needed and what was found.

use crate::format_support;

use format_support::{chain, fault, robot};
use kutzbach::format::{WarningKind, read};

/// Input, line, column, a part of the message, a part of the help (empty: any).
type Row = (String, usize, usize, &'static str, &'static str);

fn check(rows: &[Row]) {
    let mut differences = String::new();
    for (text, line, column, message, help) in rows {
        let error = fault(text);
        let told = error.help.clone().unwrap_or_default();
        let right = (error.line, error.column) == (*line, *column)
            && error.message.contains(message)
            && told.contains(help);
        if !right {
            differences += &format!(
                "{text}\nexpected {line}:{column}: {message} [{help}]\nfound    {}:{}: {} [{told}]\n\n",
                error.line, error.column, error.message,
            );
        }
    }
    assert!(differences.is_empty(), "{differences}");
}

#[test]
#[rustfmt::skip]
fn malformed_xml() {
    let row =
        |text: &str, line, column, message, help| (text.to_owned(), line, column, message, help);
    check(&[
        row("", 1, 1, "empty", "robot"),
        row("\u{feff}\n ", 1, 1, "empty", "robot"),
        row("hello", 1, 1, "needed an element", ""),
        row("<!-- only this -->", 1, 19, "no element", ""),
        row("<robot name='r'>\n<link name='a'>\n</robot>", 3, 1, "needed </link>, found </robot>", ""),
        row("<robot name='r'>\n<link name='a'/>\n", 1, 1, "<robot> is never closed", "</robot>"),
        row("<robot name='r'>\n <link name='a", 1, 1, "<robot> is never closed", ""),
        row("<robot name='r'/>\n<robot name='s'/>", 2, 1, "needed an element, a comment or the end", "one <robot>"),
        row("<robot name=r/>", 1, 13, "needed a quote", ""),
        row("<robot name='r' name='s'/>", 1, 17, "`name` stands twice", ""),
        row("<robot name='a&b'/>", 1, 15, "starts no entity", "&amp;"),
        row("<robot name='&what;'/>", 1, 14, "`&what;` is not known", ""),
        row("<robot name='a<b'/>", 1, 15, "`<` inside an attribute", "quote"),
        row("<robot name='r'>\n<xacro:property name='a' value='1'/></robot>", 2, 2, "`xacro` is not declared", "http://www.ros.org/wiki/xacro"),
        row("<robot name='\u{1}'/>", 1, 14, "U+0001", ""),
        row("<1/>", 1, 2, "name of an element", ""),
        row("<!DOCTYPE robot><robot name='r'/>", 1, 1, "document type definition", ""),
        row("<?xml version='1.0'?>\n<!DOCTYPE r [\n<!ENTITY a 'aaaaaaaaaa'>\n<!ENTITY b '&a;&a;&a;&a;&a;&a;'>\n]>\n<robot name='&b;'/>", 2, 1, "document type definition", "DOCTYPE"),
    ]);
}

#[test]
#[rustfmt::skip]
fn not_a_robot() {
    let row =
        |text: &str, line, column, message, help| (text.to_owned(), line, column, message, help);
    check(&[
        row("<sdf version='1.6'/>", 1, 1, "<sdf> holds no <model>", "<model>"),
        row("<Robot name='r'/>", 1, 1, "needed <robot>, found <Robot>", "did you mean <robot>?"),
        row("<html/>", 1, 1, "needed <robot>", ""),
        row("<robot name='r'/>", 1, 1, "there is no link", "<link"),
        row("\u{feff}<robot nam='r'/>", 1, 8, "no attribute `nam`", "`name`"),
        row("\u{feff}\n é <robot name='r'/>", 2, 2, "", ""),
    ]);
}

#[test]
#[rustfmt::skip]
fn unknown_words() {
    check(&[
        (robot("<lnik name='d'/>"), 3, 1, "<lnik> is not known inside <robot>", "did you mean <link>?"),
        (robot(" <link nmae='d'/>"), 3, 8, "<link> has no attribute `nmae`", "did you mean `name`?"),
        (chain("revolut", ""), 3, 23, "no joint type `revolut`", "did you mean `revolute`?"),
        (chain("bannana", ""), 3, 23, "no joint type `bannana`", "the types are fixed, revolute"),
        (chain("revolute", "<axes xyz='1 0 0'/>"), 5, 1, "<axes> is not known inside <joint>", "<axis>"),
        (chain("revolute", "<axis xyz='1 0 0'/><axis xyz='0 1 0'/>"), 5, 20, "second <axis>", "remove"),
        (chain("revolute", "<axis/>"), 5, 1, "needs the attribute `xyz`", ""),
        (chain("revolute", "<limit lowr='0'/>"), 5, 8, "no attribute `lowr`", "`lower`"),
        (robot("<xacro:macro/>"), 3, 1, "needs the attribute `name`", ""),
        (robot("<link name='${n}'/>"), 3, 15, "no property named `n`", ""),
        (robot("<xacro:macro name='arm'/><link name='d'><xacro:leg name='x'/></link>"), 3, 41, "unknown macro `leg`", ""),
        (robot("<expect finit='1'/>"), 3, 9, "no attribute `finit`", "`finite`"),
        (chain("fixed", "<!-- x -->").replace("</robot>", "<expect pose='reglar'/></robot>"), 8, 15, "needed regular or singular", "`regular`"),
        (chain("fixed", "").replace("</robot>", "<expect finite='1.5'/></robot>"), 8, 17, "needed a whole number, found `1.5`", ""),
        (chain("fixed", "").replace("</robot>", "<expect locked='x'/></robot>"), 8, 1, "`x`, which is neither", ""),
        (chain("fixed", "").replace("</robot>", "<scene><gravty xyz='0 0 1'/></scene></robot>"), 8, 8, "<gravty> is not known inside <scene>", "<gravity>"),
    ]);
}

#[test]
#[rustfmt::skip]
fn slips_in_what_bears_on_motion() {
    let side = |inside: &str| chain("revolute", "").replace("<child link=\"b\"/>", inside);
    check(&[
        (robot("<jiont name='d'/>"), 3, 1, "<jiont> is not known inside <robot>", "<joint>"),
        (robot("<Joint name='d'/>"), 3, 1, "<Joint> is not known inside <robot>", "<joint>"),
        (robot("<lop name='d'/>"), 3, 1, "<lop> is not known inside <robot>", "<loop>"),
        (robot("<axis xyz='1 0 0'/>"), 3, 1, "<axis> is not known inside <robot>", ""),
        (robot("<configuraton name='d'/>"), 3, 1, "<configuraton> is not known", "<configuration>"),
        (robot("<link name='d'><joint name='x' type='fixed'/></link>"), 3, 16, "<joint> is not known inside <link>", ""),
        (chain("revolute", "<axsi xyz='1 0 0'/>"), 5, 1, "<axsi> is not known inside <joint>", "did you mean <axis>?"),
        (chain("revolute", "<orgin xyz='1 0 0'/>"), 5, 1, "<orgin> is not known", "<origin>"),
        (chain("revolute", "<mimc joint='k'/>"), 5, 1, "<mimc> is not known", "<mimic>"),
        (chain("revolute", "<limits lower='0'/>"), 5, 1, "<limits> is not known", "<limit>"),
        (chain("revolute", "<origin xzy='1 0 0'/>"), 5, 9, "<origin> has no attribute `xzy`", "`xyz`"),
        (chain("revolute", "<mimic joint='k' multiplyer='2'/>"), 5, 18, "no attribute `multiplyer`", "`multiplier`"),
        (chain("revolute", "<axis xyz='1 0 0'/><origin xyz='0 0 1'/><origin xyz='0 0 2'/>"), 5, 41, "second <origin>", "remove"),
        (robot("<constrant name='d'/>"), 3, 1, "<constrant> is not known", "<constraint>"),
        (side("<chidl link='b'/>"), 4, 19, "<chidl> is not known", "<child>"),
    ]);
}

#[test]
#[rustfmt::skip]
fn no_loop_is_lost() {
    let in_gazebo = |joint: &str| chain("revolute", "").replace("</robot>", &format!("<gazebo>{joint}</gazebo></robot>"));
    let tall = "<parent>a</parent><child>c</child>";
    check(&[
        (robot("<weld><link1 link='a'/><link2 link='b'/></weld>"), 3, 1, "<weld> joins two links", "<loop>"),
        (robot("<closure body1='a' body2='b'/>"), 3, 1, "<closure> joins two links", ""),
        (robot("<mujoco><equality><weld body1='a' body2='b'/></equality></mujoco>"), 3, 19, "<weld> joins two links", ""),
        (robot("<x:tie xmlns:x='u'><body_a/><body_b/></x:tie>"), 3, 1, "<x:tie> joins two links", ""),
        (robot("<link name='d'><joint name='x'><parent link='a'/><child link='b'/></joint></link>"), 3, 16, "<joint>", ""),
        (in_gazebo(&format!("<joint name='l' type='gearbox'>{tall}</joint>")), 8, 31, "`gearbox` inside <gazebo> is not read", ""),
        (in_gazebo(&format!("<joint name='l' type='revolute'>{tall}</joint>")), 8, 9, "needs <axis>", ""),
        (in_gazebo("<joint name='l' type='fixed'><parent>a</parent><child>x</child></joint>"), 8, 63, "no link named `x`", ""),
        (in_gazebo(&format!("<joint name='l' type='ball'>{tall}<pose relative_to='x'/></joint>")), 8, 90, "no link named `x`", ""),
        (in_gazebo(&format!("<joint name='l' type='ball'>{tall}<pose>1 2 3</pose></joint>")), 8, 77, "expected 6 numbers", ""),
        (in_gazebo(&format!("<joint name='l' type='ball'>{tall}<pose>1 2 3<!-- x --> 0 0 0</pose></joint>")), 8, 71, "needs a value and nothing else", ""),
        (in_gazebo(&format!("<joint name='l' type='ball'>{tall}<pose>9e99 0 0 0 0 0</pose></joint>")).replace("<child link=\"b\"/>", "<child link=\"b\"/><origin xyz='9e99 0 0'/>"), 8, 9, "beyond the largest number", ""),
        (in_gazebo(&format!("<joint name='l' type='revolute2'>{tall}<axis><xyz>0 0 1</xyz></axis><axis2><xyz>0 0 -2</xyz></axis2></joint>")), 8, 105, "its two axes are parallel", ""),
        (in_gazebo("<joint:hinge2 name='l'/>").replace("<robot ", "<robot xmlns:joint='u' "), 8, 9, "<joint:hinge2> is not read", ""),
        (robot("<d:x xmlns:d='u'/><drake:coupler_constraint xmlns:drake='u'/>"), 3, 19, "constrains, and it is not read", ""),
        (robot("<loop_joint name='l' type='spherical'><link1 link='a'/></loop_joint>"), 3, 1, "needs two sides", ""),
        (robot("<loop_joint name='l' type='spheric'/>"), 3, 28, "of the type `spheric` is not read", ""),
        (robot("<constraint name='l' type='fixed'><parent link='a'/></constraint>"), 3, 1, "needs <parent", ""),
    ]);
}

#[test]
#[rustfmt::skip]
fn parts_that_a_joint_type_has_not() {
    check(&[
        (chain("revolute", "<axis2 xyz='1 0 0'/>"), 5, 1, "a revolute joint has no <axis2>", ""),
        (chain("revolute", "<screw lead='1'/>"), 5, 1, "a revolute joint has no <screw>", "type"),
        (chain("spherical", "<distance value='1'/>"), 5, 1, "a spherical joint has no <distance>", ""),
        (chain("point_on_line", "<axis xyz='1 0 0'/>"), 5, 1, "a point_on_line joint has no <axis>", "<axis2"),
        (chain("translational", "<axis xyz='1 0 0'/>"), 5, 1, "a translational joint has no <axis>", ""),
        (chain("screw", "<axis xyz='1 0 0'/>"), 3, 1, "needs its lead", "<screw lead"),
        (chain("distance", ""), 3, 1, "distance", ""),
        (chain("distance", "<distance value='0'/>"), 3, 1, "greater than zero", "spherical"),
        (robot("<loop name='l' type='floating'/>"), 3, 22, "closes no loop", ""),
        (chain("revolute", "<predecessor link='a'/>"), 5, 1, "<predecessor> is not known inside <joint>", ""),
        (chain("revolute", "").replace("name=\"j\"", "name=\"j\" independent=\"maybe\""), 3, 30, "needed true or false", ""),
    ]);
}

#[test]
#[rustfmt::skip]
fn numbers() {
    let axis = |xyz: &str| chain("revolute", &format!("<axis xyz='{xyz}'/>"));
    check(&[
        (axis("0 0"), 5, 12, "expected 3 numbers, found 2", "spaces"),
        (axis("0 0 1 0"), 5, 12, "expected 3 numbers, found 4", ""),
        (axis(""), 5, 12, "expected 3 numbers, found 0", ""),
        (axis("0,0,1"), 5, 12, "expected 3 numbers, found 1", "spaces"),
        (axis("0, 0, 1"), 5, 13, "a decimal number", "spaces"),
        (axis("0 nan 1"), 5, 14, "a decimal number", "digits"),
        (axis("0 0 inf"), 5, 16, "a decimal number", ""),
        (axis("-inf 0 0"), 5, 13, "a decimal number", ""),
        (axis("0x10 0 0"), 5, 13, "a decimal number", ""),
        (axis("1e999999999999 0 0"), 5, 14, "exponent", ""),
        (axis("1e101 0 0"), 5, 12, "too large", ""),
        (axis("1_0 0 0"), 5, 13, "a decimal number", ""),
        (axis("0 0 0"), 5, 12, "zero vector", ""),
        (axis("0 ${1-1} 0e5"), 5, 12, "zero vector", ""),
        (axis("1/2 0 0"), 5, 13, "a decimal number", "${1/2}"),
        (axis("1 ${2 0"), 5, 14, "`${` is not closed", ""),
        (axis("1 $(arg 0"), 5, 14, "`$(` is not closed", ""),
        (axis("1 $x 0"), 5, 14, "`$`", ""),
        (axis("1 $(find x) 0"), 5, 14, "needed $(arg name)", ""),
        (axis("1 ${} 0"), 5, 16, "needed", ""),
        (axis("1 ${1/(2-2)} 0"), 5, 18, "divisor that is not zero", ""),
        (axis("1 ${sqrt(0-1)} 0"), 5, 16, "sqrt", ""),
        (axis("1 ${1 + } 0"), 5, 19, "needed a number", ""),
        (axis("1 ${width} 0"), 5, 16, "no property named `width`", "define it"),
        (axis("1 $(arg width) 0"), 5, 14, "no argument named `width`", "define it"),
        (axis("1 ${frob(2)} 0"), 5, 16, "", ""),
        (axis("&#48; 0 &#x7a; 1"), 5, 12, "expected 3 numbers, found 4", ""),
        (axis("&#48; &#48; &#x7a;"), 5, 24, "a decimal number", ""),
        (axis("1\r\n\t2\r\n\tz"), 7, 2, "a decimal number", ""),
        (chain("revolute", "<origin xyz='1 2 3' rpy='1 2'/>"), 5, 26, "expected 3 numbers, found 2", ""),
    ]);
}

#[test]
#[rustfmt::skip]
fn definitions() {
    let two = |a: &str, b: &str| {
        robot(&format!(
            "<xacro:property name='a' value='{a}'/>\n<xacro:property name='b' value='{b}'/>"
        ))
    };
    check(&[
        (two("b", "${a}"), 4, 35, "`a` is defined by itself: a -> b -> a", ""),
        (two("1 + a", "1"), 3, 37, "`a` is defined by itself: a -> a", ""),
        (two("1", "1/(a - 1)"), 4, 35, "divisor that is not zero", ""),
        (two("1", "2*aa"), 4, 35, "no property named `aa`", "`a`"),
        (two("1 2*3", "1"), 3, 35, "needed an operator", ""),
        (two("2**(10**100)", "1"), 3, 36, "exponent", ""),
        (robot("<xacro:property name='pi' value='3'/>"), 3, 23, "`pi` is built in", ""),
        (robot("<xacro:property name='2a' value='3'/>"), 3, 23, "`2a` cannot be used", ""),
        (robot("<xacro:property name='__a' value='3'/>"), 3, 23, "`__a` cannot be used", "two underscores"),
        (robot("<xacro:property name='a' valu='3'/>"), 3, 26, "no attribute `valu`", "`value`"),
        (robot("<xacro:property name='a'/>"), 3, 1, "needs the attribute `value`", ""),
        (robot("<xacro:property name='a' value='3/2'/>\n<xacro:property name='a' value='3'/>"), 4, 23, "`a` is defined twice", ""),
        (robot("<xacro:arg name='a'/>"), 3, 1, "no default and was not set", "--set a="),
    ]);
}

#[test]
#[rustfmt::skip]
fn connections() {
    let joint = |name: &str, parent: &str, child: &str| {
        format!(
            "<joint name='{name}' type='continuous'><parent link='{parent}'/><child link='{child}'/></joint>"
        )
    };
    let joints = |parts: &[(&str, &str, &str)]| {
        let lines: Vec<String> = parts.iter().map(|(n, p, c)| joint(n, p, c)).collect();
        robot(&lines.join("\n"))
    };
    let mimics = joints(&[("j", "a", "b"), ("k", "b", "c")])
        .replace("<child link='b'/>", "<child link='b'/><mimic joint='k'/>")
        .replace("<child link='c'/>", "<child link='c'/><mimic joint='j'/>");
    let with = |lines: &str| {
        robot(&format!(
            "{}\n{}\n{lines}",
            joint("j", "a", "b"),
            joint("k", "b", "c")
        ))
    };
    check(&[
        (robot("<link name='b'/>"), 3, 13, "the name `b` is taken by another link", ""),
        (robot("<link name=''/>"), 3, 13, "needed a name", ""),
        (joints(&[("j", "a", "b"), ("j", "b", "c")]), 4, 14, "the name `j` is taken by another joint", "one set of names"),
        (joints(&[("j", "a", "bb"), ("k", "b", "c")]), 3, 66, "no link named `bb`", "did you mean `b`?"),
        (joints(&[("j", "a", "b"), ("k", "elbow", "c")]), 4, 49, "no link named `elbow`", ""),
        (joints(&[("j", "a", "b"), ("k", "c", "c")]), 4, 1, "both sides are link `c`", ""),
        (joints(&[("j", "a", "b")]), 2, 33, "nothing connects it to `a`", "floating"),
        (joints(&[("j", "a", "b"), ("k", "b", "a")]), 2, 1, "circle", "<loop>"),
        (joints(&[("j", "a", "b"), ("k", "b", "c"), ("l", "c", "a")]), 2, 1, "circle", "<loop>"),
        (mimics, 3, 1, "mimic runs in a circle", ""),
        (with("<ground link='d'/>"), 5, 15, "no link named `d`", ""),
        (with("<ground link='a'/><ground link='b'/>"), 5, 19, "at most one <ground>", ""),
        (with("<loop name='l' type='revolute'><predecessor link='a'/></loop>"), 5, 1, "needs <successor", ""),
        (with("<loop name='l' type='revolute'><predecessor link='a'/><successor link='a'/></loop>"), 5, 1, "both sides are link `a`", ""),
        (with("<loop name='k' type='revolute'><predecessor link='a'/><successor link='c'/></loop>"), 5, 13, "`k` is taken", ""),
        (with("<coupling name='k'><predecessor link='a'/><successor link='c'/><ratio value='1'/></coupling>"), 5, 17, "`k` is taken", ""),
        (with("<coupling name='g'><predecessor link='a'/><successor link='a'/><ratio value='1'/></coupling>"), 5, 1, "no joint moves", ""),
        (with("<coupling name='g'><predecessor link='a'/><successor link='b'/></coupling>"), 5, 1, "needs <ratio>", ""),
        (with("<configuration name='p'><position joint='g' value='1'/></configuration>"), 5, 42, "no joint named `g`", ""),
        (with("<configuration name='p'><position joint='j' value='1 2'/></configuration>"), 5, 1, "1 in all, found 2", ""),
        (with("<configuration name='p'/><configuration name='p'/>"), 5, 47, "`p` is taken by another configuration", ""),
        (with("<scene><drive joint='j'/></scene>"), 5, 8, "needs the attribute `velocity`", ""),
        (with("<scene><drive joint='jj' velocity='1'/></scene>"), 5, 22, "no joint named `jj`", "`j`"),
        (joints(&[("j", "a", "b"), ("k", "b", "c")]).replace("<child link='b'/>", ""), 3, 1, "needs <child", ""),
        (joints(&[("j", "a", "b"), ("k", "b", "c")]).replace("<child link='b'/>", "<child link='b'/><mimic joint='j'/>"), 3, 1, "mimics itself", ""),
    ]);
}

#[test]
fn faults_are_told_together_in_file_order() {
    let text = robot("<lnk name='x'/>\n<joint name='j' type='revolt'/>\n<link name='a'/>");
    let error = fault(&text);
    let places: Vec<(usize, usize)> = std::iter::once(&error)
        .chain(&error.others)
        .map(|fault| (fault.line, fault.column))
        .collect();
    assert_eq!(places, [(3, 1), (4, 23), (5, 13)]);
    assert_eq!(error.to_string().lines().count(), 1);
    assert!(error.to_string().starts_with("bad.urdf:3:1: "));
    let many = robot(&"<lnk/>\n".repeat(1000));
    assert_eq!(fault(&many).others.len(), 19);
}

#[test]
fn settings() {
    let text = robot(
        "<xacro:arg name='twist' default='pi/6'/>\n<xacro:property name='w' value='2*$(arg twist)'/>\n\
         <joint name='j' type='screw'><parent link='a'/><child link='b'/><screw lead='${w}'/></joint>\n\
         <joint name='k' type='floating'><parent link='a'/><child link='c'/></joint>",
    );
    let set = |name: &str, value: &str| read(&text, "f", &[(name.to_owned(), value.to_owned())]);
    let lead = |name: &str, value: &str| {
        set(name, value).unwrap().mechanism.joints()[0]
            .lead
            .clone()
            .unwrap()
    };
    assert!((lead("w", "0.25").value() - 0.25).abs() < 1e-15);
    assert_eq!(lead("w", "0.25").stated().unwrap().decimals, 2);
    assert!((lead("twist", "pi/4").value() - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    assert!((lead("twist", "${pi/4}").value() - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    let error = set("twst", "1").unwrap_err();
    assert!(error.message.contains("cannot set `twst`"), "{error}");
    assert_eq!(error.help.as_deref(), Some("did you mean `twist`?"));
    let error = set("twist", "pi/(1-1)").unwrap_err();
    assert!(
        error.message.contains("twist=pi/(1-1)") && error.line == 3,
        "{error}"
    );
}

/// What a writer of another language would write is answered in the words of this one.
#[test]
fn words_of_other_languages_are_translated() {
    let joint = |kind: &str, inside: &str| {
        let joint = format!("<joint name='j' type='{kind}'>{inside}</joint>");
        format!("<robot name='r'><link name='a'/><link name='b'/>{joint}</robot>")
    };
    let links = "<parent link='a'/><child link='b'/>";
    let placed = |origin: &str| format!("{links}<origin {origin}/>");
    for (text, help) in [
        (joint("hinge", links), "`revolute`"),
        (joint("ball", links), "`spherical`"),
        (joint("slider", links), "`prismatic`"),
        (joint("helical", links), "`screw`"),
        (joint("revolute", &placed("xyz='2mm 0 0'")), "${2/1000}"),
        (
            joint("revolute", &placed("rpy='90deg 0 0'")),
            "${90*pi/180}",
        ),
        (
            joint("revolute", "<predecessor link='a'/><child link='b'/>"),
            "<parent>",
        ),
    ] {
        let told = fault(&text).help.unwrap_or_default();
        assert!(told.contains(help), "{text}: {told}");
    }
    let warnings = |text: &str| {
        let reading = read(text, "file", &[]).unwrap();
        let all = reading.warnings.iter().map(|w| w.message.clone());
        all.collect::<Vec<_>>().join("; ")
    };
    let degrees = joint("revolute", &placed("rpy='90 0 -45'"));
    assert!(
        warnings(&degrees).contains("looks like degrees"),
        "{}",
        warnings(&degrees)
    );
    let radians = joint("revolute", &placed("rpy='3 0 6.5'"));
    assert!(!warnings(&radians).contains("degrees"));
}

#[test]
fn limits_that_may_not_be_meant_are_told() {
    // Of joint `j`, beside a loop of fixed joints or none.
    let told = |kind: &str, range: [&str; 2], closes: bool| {
        let [lower, upper] = range;
        let close = match closes {
            true => {
                "<loop name='l' type='fixed'><predecessor link='a'/><successor link='b'/></loop>"
            }
            false => "",
        };
        let text = format!(
            "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='{kind}'><parent link='a'/><child link='b'/>
             <origin xyz='0.3 0 0'/><axis xyz='0 0 1'/><limit lower='{lower}' upper='{upper}'/></joint>{close}</robot>"
        );
        let reading = read(&text, "file", &[]).unwrap();
        let guessed = reading
            .warnings
            .iter()
            .filter(|w| w.kind == WarningKind::Guessed);
        guessed.map(|w| w.message.clone()).collect::<Vec<_>>()
    };
    for range in [
        ["-3.14", "3.14"],
        ["-3.1416", "3.1416"],
        ["0", "6.28"],
        ["-3.12", "3.12"],
    ] {
        assert_eq!(told("revolute", range, true).len(), 1, "{range:?}");
        assert!(told("revolute", range, false).is_empty(), "{range:?}");
    }
    for range in [["-180", "180"], ["0", "90"], ["-179", "179"]] {
        assert!(
            told("revolute", range, false)[0].contains("degrees"),
            "{range:?}"
        );
    }
    for range in [
        ["-3", "3"],
        ["0", "3.14"],
        ["-1.57", "1.57"],
        ["-12.5", "12.5"],
    ] {
        assert!(told("revolute", range, true).is_empty(), "{range:?}");
    }
    assert!(told("prismatic", ["0", "120"], false)[0].contains("millimetres"));
    for range in [["0", "0.12"], ["0", "5"], ["-3.14", "3.14"]] {
        assert!(told("prismatic", range, true).is_empty(), "{range:?}");
    }
}
