use super::packages::HIGHEST;
use crate::{ReadOptions, Reading, expanded_file, read_file_with, read_with};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::Mechanism;
use proptest::prelude::*;
use std::path::PathBuf;

fn robot(body: &str) -> String {
    format!("<robot name=\"r\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n{body}\n</robot>")
}

fn options(settings: &[(&str, &str)]) -> ReadOptions {
    ReadOptions {
        settings: settings
            .iter()
            .map(|(name, value)| ((*name).into(), (*value).into()))
            .collect(),
        without_environment: true,
        ..ReadOptions::default()
    }
}

/// What a body expands to, one element or text a line, without the robot around it.
fn expanded(body: &str) -> String {
    let none = options(&[]);
    let text = robot(body);
    let source = super::expand(&text, "robot.xacro", None, &none)
        .unwrap_or_else(|error| panic!("{error} {:?}", error.help));
    let super::Source::Expanded(expanded) = source else {
        panic!("not expanded");
    };
    let lines: Vec<&str> = expanded.plain.lines().map(str::trim).collect();
    lines[1..lines.len() - 1].join("")
}

fn message(body: &str) -> String {
    let none = options(&[]);
    match read_with(&robot(body), "robot.xacro", &none) {
        Ok(_) => panic!("read"),
        Err(error) => format!("{error} | {}", error.help.as_deref().unwrap_or_default()),
    }
}

fn reading(body: &str, settings: &[(&str, &str)]) -> Reading {
    read_with(&robot(body), "robot.xacro", &options(settings))
        .unwrap_or_else(|error| panic!("{error}"))
}

fn names(mechanism: &Mechanism) -> Vec<&str> {
    mechanism
        .links()
        .iter()
        .map(|link| link.name.as_str())
        .collect()
}

const CHAIN: &str = "<link name='a'/><link name='b'/><joint name='j' type='revolute'><parent link='a'/><child link='b'/>";

fn position(body: &str, settings: &[(&str, &str)]) -> [Number; 3] {
    let reading = reading(body, settings);
    reading.mechanism.joints()[0]
        .predecessor
        .frame
        .position
        .clone()
}

#[test]
fn macros_take_values_defaults_and_blocks() {
    assert_eq!(
        expanded(
            "<xacro:macro name='m' params=\"a b:=2 c:='x y' d:=^|9 *e **f\"><y v='${a} ${b} ${c} ${d}'/>\
             <xacro:insert_block name='e'/><xacro:insert_block name='f'/></xacro:macro>\
             <xacro:property name='d' value='7'/><xacro:m a='1.0'><p q='${d}'/><s><t/><u/></s></xacro:m>"
        ),
        "<y v=\"1.0 2 x y 7\"/><p q=\"7\"/><t/><u/>"
    );
    assert_eq!(
        expanded(
            "<xacro:macro name='n' params='i'><xacro:if value='${i > 0}'><e v='${i}'/><xacro:n i='${i - 1}'/>\
             </xacro:if></xacro:macro><xacro:n i='3'/><xacro:call macro='${\"n\"}' i='1'/>"
        ),
        "<e v=\"3\"/><e v=\"2\"/><e v=\"1\"/><e v=\"1\"/>"
    );
    // Without its prefix it is no call.
    assert_eq!(
        expanded(
            "<xacro:macro name='n' params='i'><e v='${i}'/></xacro:macro><n i='1'/><o><n i='2'/></o><xacro:n i='3'/>"
        ),
        "<n i=\"1\"/><o><n i=\"2\"/></o><e v=\"3\"/>"
    );
}

#[test]
fn an_element_with_the_name_of_a_macro_is_no_call() {
    let body = format!(
        "<xacro:macro name='eyes' params='on:=a'><link name='eye'/><joint name='k' type='revolute'><parent link='${{on}}'/>\
         <child link='eye'/></joint></xacro:macro>{CHAIN}<axis xyz='1 0 0'/></joint>\n<eyes/>"
    );
    let plain = reading(&body, &[]);
    assert_eq!(names(&plain.mechanism), ["a", "b"]);
    assert_eq!(plain.warnings.len(), 1);
    let warning = &plain.warnings[0];
    assert_eq!((warning.line, warning.column), (3, 1), "{warning:?}");
    assert!(
        warning.message.contains("<xacro:eyes> calls it"),
        "{warning:?}"
    );
    let called = body.replace("<eyes/>", "<xacro:eyes/>");
    assert_eq!(names(&reading(&called, &[]).mechanism).len(), 3);
    // A macro may write an element of its own name, any number of times.
    let body = "<xacro:macro name='sensors'><sensors><other/></sensors></xacro:macro><link name='a'/><xacro:sensors/><xacro:sensors/>";
    let plain = reading(body, &[]);
    assert_eq!(names(&plain.mechanism), ["a"]);
    assert!(plain.warnings.is_empty(), "{:?}", plain.warnings);
}

#[test]
fn a_macro_that_nobody_defined_is_an_error_in_the_robot() {
    let none = options(&[]);
    let parts = "<link name='a'/>\n <xacro:left_arm on='a'/>\n";
    let define = "<xacro:macro name='right_arm' params='on'/>";
    let inside = "<xacro:macro name='arms'><xacro:left_arm on='a'/></xacro:macro>";
    for (body, place) in [
        (parts.to_owned(), (3, 2)),
        (format!("{define}{parts}"), (3, 2)),
        (format!("<xacro:if value='1'>{parts}</xacro:if>"), (3, 2)),
        (
            format!("<link name='a'/>\n{inside}\n<xacro:arms/>"),
            (3, 26),
        ),
        // What stands in a joint may bear on its motion.
        (format!("{CHAIN}\n<xacro:limits/></joint>"), (3, 1)),
    ] {
        let error = read_with(&robot(&body), "robot.xacro", &none).unwrap_err();
        assert!(error.message.contains("unknown macro"), "{error}");
        assert_eq!((error.line, error.column), place, "{body}: {error}");
        assert!(error.help.is_some(), "{error}");
    }
    let error = read_with(&robot(parts), "robot.xacro", &none).unwrap_err();
    assert!(error.help.unwrap().contains("<xacro:include>"));
    let error = read_with(
        &robot(&format!("{define}{parts}").replace("left", "rigt")),
        "r",
        &none,
    );
    assert_eq!(
        error.unwrap_err().help.as_deref(),
        Some("did you mean `right_arm`?")
    );
}

#[test]
fn calls_left_over_from_an_expansion_are_skipped_with_a_warning() {
    let none = options(&[]);
    let looks = "<link name='a'>\n<visual><xacro:paint/></visual><collision><xacro:paint/></collision></link>";
    let warnings = |body: &str, file: &str| {
        let reading = read_with(&robot(body), file, &none).unwrap();
        assert_eq!(names(&reading.mechanism), ["a"]);
        reading.warnings
    };
    for body in [
        looks.to_owned(),
        format!("{looks}<xacro:if value='1'><material/></xacro:if>"),
    ] {
        let told = warnings(&body, "robot.xacro");
        assert_eq!(told.len(), 1, "{told:?}");
        assert_eq!((told[0].line, told[0].column), (3, 9));
        assert!(told[0].message.contains("<xacro:paint>"), "{told:?}");
    }
    let leftover = "<link name='a'/>\n<xacro:left_arm/><xacro:right_arm/>";
    assert_eq!(warnings(leftover, "robot.urdf").len(), 2);
    let also = format!("{leftover}<xacro:if value='1'><material/></xacro:if>");
    assert_eq!(warnings(&also, "robot.URDF").len(), 2);
    // A file that includes others says where macros are to come from.
    let defined = format!("{looks}<xacro:macro name='other'/>");
    assert!(message(&defined).contains("unknown macro `paint`"));
}

#[test]
fn properties_are_lazy_scoped_and_redefined_in_order() {
    assert_eq!(
        expanded(
            "<xacro:property name='a' value='${b}x'/><xacro:property name='b' value='1'/><e v='${a}'/>\
             <xacro:property name='b' value='2'/><e v='${a} ${b}'/>\
             <xacro:property name='l' value='${b}' lazy_eval='false'/><xacro:property name='b' value='3'/><e v='${l}'/>\
             <xacro:property name='b' default='4'/><e v='${b}'/>"
        ),
        "<e v=\"1x\"/><e v=\"1x 2\"/><e v=\"2\"/><e v=\"3\"/>"
    );
    assert_eq!(
        expanded(
            "<xacro:macro name='s' params='v'><xacro:property name='g' value='${v}' scope='global'/>\
             <xacro:property name='p' value='${v}p' scope='parent'/><xacro:property name='own' value='1'/></xacro:macro>\
             <xacro:s v='5'/><e v='${g} ${p}'/><xacro:property name='k'><f v='${g}'/></xacro:property>\
             <xacro:insert_block name='k'/>"
        ),
        "<e v=\"5 5p\"/><f v=\"5\"/>"
    );
    assert!(
        message("<xacro:if value='${own}'/><xacro:macro name='m' params=''/>")
            .contains("no property named `own`")
    );
    let circle = "<xacro:property name='a' value='${b}_'/><xacro:property name='b' value='${a}_'/><e v='${a}'/><link name='${a}'/>";
    assert!(message(circle).contains("`a` is defined by itself: a -> b -> a"));
}

#[test]
fn conditions_elements_and_escapes() {
    assert_eq!(
        expanded(
            "<xacro:arg name='z' default='false'/><xacro:if value='$(arg z)'><a/></xacro:if>\
             <xacro:unless value='${1 == 2}'><b/></xacro:unless>\
             <xacro:element xacro:name='${\"c\"}d'><xacro:attribute name='x${1}' value='${2.0}'/></xacro:element>\
             <e v='$${x} $(optenv NO_SUCH_VARIABLE_HERE d e) $(eval 1 + 1)'>t${1}</e>"
        ),
        "<b/><cd x1=\"2.0\"/><e v=\"${x} d e 2\">t1</e>"
    );
    assert!(message("<xacro:if value='maybe'><a/></xacro:if>").contains("needed true or false"));
    assert!(message("<xacro:element xacro:name='a b=\"'/>").contains("is not a name"));
}

#[test]
fn expressions_print_as_in_python() {
    for (expression, value) in [
        ("1/2 + 1", "1.5"),
        ("7 // 2", "3"),
        ("-7 % 3", "2"),
        ("2 ** -1", "0.5"),
        ("1 &lt; 2 &lt; 2", "False"),
        ("[1, 2.0, 'a', None][1:]", "[2.0, 'a', None]"),
        ("'a_b'.split('_')[-1].upper()", "B"),
        ("'%02d-%.1f' % (3, 0.25)", "03-0.2"),
        ("max([x * x for x in range(4) if x % 2 == 0])", "4"),
        ("dict(a=1)['a'] if 'a' in ['a'] else 2", "1"),
        ("not (True and 0)", "True"),
        (
            "'%.3s %#x %G' % (3.0708, 30, 0.0000076)",
            "3.0 0x1e 7.6E-06",
        ),
        ("[+True, -True, +0.5, -0.0 // 2]", "[1, -1, 0.5, -0.0]"),
        ("round(2.5) + len('abc')", "5"),
        ("math.pi", "3.141592653589793"),
        ("'x' 'y' + str(1.0)", "xy1.0"),
        ("python.set('a b a'.split()) - python.set(['b'])", "{'a'}"),
        ("python.set([1, 2]) == python.set([2, 1, 1])", "True"),
        ("list(python.set('ab').union(['c']))[-1]", "c"),
        (
            "python.set(['a']).issubset('ab') and not python.set()",
            "True",
        ),
    ] {
        let body = format!("<e filename=\"${{{expression}}}\"/><xacro:if value='0'/>");
        assert_eq!(
            expanded(&body),
            format!("<e filename=\"{value}\"/>"),
            "{expression}"
        );
    }
}

#[test]
fn numbers_of_geometry_are_exact() {
    let head = "<xacro:property name='L' value='0.10'/><xacro:property name='at' value='0 ${pi/2} ${sqrt(2)/2}'/>\
                <xacro:macro name='m' params='sign at'>";
    let tail = "</joint></xacro:macro>";
    let call = "<xacro:m sign='-1' at='${at}'/>";
    let [x, y, z] = position(
        &format!(
            "{head}{CHAIN}<origin xyz='${{sign * L}} ${{2 * radians(30)}} ${{1/3}}' rpy='${{at}}'/>{tail}{call}"
        ),
        &[],
    );
    assert_eq!(x.source(), "-0.10");
    assert_eq!(y, Number::pi().checked_div(&Number::integer(3)).unwrap());
    assert_eq!(z, Number::ratio(1, 3).unwrap());
    let text = format!("{head}{CHAIN}<origin xyz='${{at}}'/>{tail}{call}");
    let [x, y, z] = position(&text, &[]);
    assert_eq!(x.source(), "0");
    assert_eq!(y, Number::pi().checked_div(&Number::integer(2)).unwrap());
    assert_eq!(&z * &z, Number::ratio(1, 2).unwrap());
}

#[test]
fn settings_and_symbols_reach_what_is_expanded() {
    let body = format!(
        "<xacro:arg name='side' default='left'/><xacro:arg name='w' default='1'/><xacro:property name='h' value='1'/>\
         {CHAIN}<origin xyz='$(arg w) ${{h}} 0'/></joint><link name='$(arg side)_c'/>\
         <joint name='k' type='fixed'><parent link='b'/><child link='$(arg side)_c'/></joint>"
    );
    let set = [("side", "right"), ("w", "pi/4"), ("h", "1/3")];
    assert_eq!(
        names(&reading(&body, &set).mechanism),
        ["a", "b", "right_c"]
    );
    let [x, y, _] = position(&body, &set);
    assert_eq!(x, Number::pi().checked_div(&Number::integer(4)).unwrap());
    assert_eq!(y, Number::ratio(1, 3).unwrap());
    let error = read_with(&robot(&body), "r", &options(&[("sid", "x")])).unwrap_err();
    assert!(error.message.contains("cannot set `sid`"), "{error}");
    assert_eq!(error.help.as_deref(), Some("did you mean `side`?"));
    let open = ReadOptions {
        symbolic: vec!["h".into()],
        ..options(&[])
    };
    let mechanism = read_with(&robot(&body), "r", &open).unwrap().mechanism;
    let number = &mechanism.joints()[0].predecessor.frame.position[1];
    assert!(matches!(
        number.view(),
        kutzbach_math::number::View::Parameter("h", _)
    ));
}

#[test]
fn all_arguments_without_value_are_told_at_once() {
    let told = message(
        "<xacro:arg name='a'/><xacro:arg name='b' default='2'/><link name='$(arg c)'/><xacro:arg name='d'/>",
    );
    assert!(
        told.contains("the arguments `a`, `c`, `d` have no value"),
        "{told}"
    );
    assert!(
        told.contains("--set a=… --set c=… --set d=…") && told.contains("b=2"),
        "{told}"
    );
}

#[test]
fn faults_in_macros_have_their_place_and_their_call() {
    let body = "<xacro:macro name='leg' params='n t'>\n <link name='${n}'/>\n <joint name='${n}j' type='${t}'>\
                <parent link='a'/><child link='${n}'/></joint>\n</xacro:macro>\n<link name='a'/>\n<xacro:leg n='b' t='revolut'/>\
                <xacro:leg n='c' t='revolut'/>";
    let error = read_with(&robot(body), "robot.xacro", &options(&[])).unwrap_err();
    assert_eq!((error.line, error.column), (4, 28), "{error}");
    assert!(
        error
            .message
            .contains("in macro `leg`, called at robot.xacro:7:1"),
        "{error}"
    );
    assert!(error.message.contains("in 1 other call"), "{error}");
    assert!(error.others.is_empty());
    let told = message("<xacro:macro name='leg' params='n'/><xacro:leg m='1'/>");
    assert!(
        told.contains("has no parameter `m`") && told.starts_with("robot.xacro:2:"),
        "{told}"
    );
    assert!(
        message("<xacro:macro name='leg' params='n *o'/><xacro:leg/>").contains("needs `n`, `*o`")
    );
    assert!(
        message("<xacro:macro name='arm' params='n'/><xacro:leg/>").contains("unknown macro `leg`")
    );
    let only = message("<xacro:macro name='leg' params='n'/><xacro:macro name='arm' params='n'/>");
    assert!(
        only.contains("the macros `arm`, `leg` and calls none"),
        "{only}"
    );
}

#[test]
fn files_of_named_numbers_are_read_as_before() {
    let body = format!(
        "<xacro:property name='a' value='2*b'/><xacro:property name='b' value='3/5'/>{CHAIN}<origin xyz='${{a}} 0 0'/></joint>"
    );
    assert_eq!(reading(&body, &[]).format, "kutzbach-urdf");
    assert_eq!(
        reading(
            &format!("{body}<xacro:if value='0'/>").replace("2*b", "${2*0.6}"),
            &[]
        )
        .format,
        "xacro"
    );
    for value in [
        "left",
        "'1'",
        "${[1]}",
        "0 0 1",
        "${a}_x",
        "",
        "true",
        "$(find x)/y",
        "${1 if 1 else 2}",
        "${int(3.7)}",
        "${7//2}",
        "${0x1F}",
        "${1 + 0b11}",
        "${2 if 1 else 3}",
        "${(1 != 2)*3}",
        "${len('ab')}",
        "${[4, 5][0]}",
        "${7 % 2}",
        "${math.sqrt(2)}",
    ] {
        let text = robot(&format!("<xacro:property name='a' value=\"{value}\"/>"));
        let document = crate::xml::parse(&text).unwrap();
        assert!(super::detect::needs_expansion(&document), "{value}");
    }
    for value in [
        "1",
        "3/5",
        "${a}",
        "-${b}",
        "2*${a+1}",
        "$(arg a)",
        "pi",
        "sqrt(2)",
        "a",
        "${atan2(1, 2)}",
        "acos(4/5)",
        "${sqrt (2)*pi}",
    ] {
        let text = robot(&format!(
            "<xacro:property name='a' value=\"{value}\"/><xacro:property name='b' value='2'/>"
        ));
        let document = crate::xml::parse(&text).unwrap();
        assert!(!super::detect::needs_expansion(&document), "{value}");
    }
}

/// The values are Python's, of the same expressions.
#[test]
fn integers_in_other_bases_are_pythons_with_a_macro_and_without() {
    let with_macro = "<xacro:macro name='m' params=''/>";
    for (expression, value) in [
        ("0x1F", 31),
        ("0XfF + 0o17", 270),
        ("0b1_01", 5),
        ("-0b11//2", -2),
        ("int('0x10', 16) + int('z', 36) + int('-0b11', 0)", 48),
        ("(3 if 0x10 == 16 else 4) + int(3.7)", 6),
        ("[7, 8][1]", 8),
    ] {
        for before in ["", with_macro] {
            let body = format!("{before}{CHAIN}<origin xyz=\"${{{expression}}} 0 0\"/></joint>");
            let [x, ..] = position(&body, &[]);
            assert_eq!(x.value(), f64::from(value), "{expression}");
            assert!(x.stated().is_none(), "{expression}");
        }
    }
    for wrong in ["0b12", "0x", "0o8", "int('12', 2)", "int('', 16)"] {
        let body = format!("{CHAIN}<origin xyz=\"${{{wrong}}} 0 0\"/></joint>");
        message(&body);
    }
}

#[test]
fn endless_files_end() {
    for body in [
        "<xacro:macro name='m' params=''><xacro:m/></xacro:macro><xacro:m/>",
        "<xacro:macro name='m' params=''><a><xacro:m/></a></xacro:macro><xacro:m/>",
        "<xacro:macro name='m' params=''><xacro:m/><xacro:m/></xacro:macro><xacro:m/>",
        "<xacro:macro name='m' params='i'><xacro:if value='${i &lt; 40}'><xacro:m i='${i+1}'/><xacro:m i='${i+1}'/></xacro:if>\
         </xacro:macro><xacro:m i='0'/>",
        "<xacro:property name='a' value=\"${'x'*1000000}\"/><xacro:property name='b' value='${a+a}'/><link name='${b}'/>",
        "<link name='${range(10**12)}'/>",
        "<link name='${9**9**9}'/>",
        "<link name=\"${[0]*10**9}\"/>",
    ] {
        let told = message(body);
        assert!(
            ["more than", "too long", "too large"]
                .iter()
                .any(|words| told.contains(words)),
            "{told}"
        );
    }
}

/// A property that holds two of the one before it, many times: a tree of 2^60 items in 60 lists.
fn doubled(name: &str) -> String {
    let first = format!("<xacro:property name='{name}0' value='${{[1]}}'/>\n");
    let further = (0..60).map(|at| {
        let next = at + 1;
        format!("<xacro:property name='{name}{next}' value='${{[{name}{at}, {name}{at}]}}'/>\n")
    });
    std::iter::once(first).chain(further).collect()
}

/// The message about a body whose last line is at fault, with the line and column that it names.
fn told_on_the_last_line(body: &str) -> String {
    let body = format!("<xacro:if value='0'/>\n{body}");
    let told = message(&body);
    let line = robot(&body).lines().count() - 1;
    assert!(
        told.starts_with(&format!("robot.xacro:{line}:")),
        "line {line}: {told}"
    );
    told
}

#[test]
fn values_that_share_their_parts_are_not_walked_as_trees() {
    for (expression, value) in [
        ("a60 == a60", "True"),
        ("[a60] == [a60]", "True"),
        ("a60 in [a60]", "True"),
        ("len(max(a60, a60))", "2"),
        ("a60 &lt; a60", "False"),
        ("[a60].index(a60)", "0"),
    ] {
        let body = format!("{}<e v='${{{expression}}}'/>", doubled("a"));
        assert_eq!(
            expanded(&body),
            format!("<e v=\"{value}\"/>"),
            "{expression}"
        );
    }
    // Built twice, these are equal only after 2^60 comparisons.
    for expression in [
        "a60 == b60",
        "a60 != b60",
        "a60 is b60",
        "a60 in [b60]",
        "a60 &lt; b60",
        "max(a60, b60)",
        "sorted([a60, b60])",
        "[a60].count(b60)",
        "dict([['k', a60]]) == dict([['k', b60]])",
        "tuple([a60]) in dict([[tuple([b60]), 1]])",
    ] {
        let both = format!("{}{}", doubled("a"), doubled("b"));
        let told = told_on_the_last_line(&format!("{both}<e v=\"${{{expression}}}\"/>"));
        assert!(told.contains("1000000 steps"), "{expression}: {told}");
    }
    for expression in ["a60", "str(a60)", "'%s' % [a60]"] {
        let body = format!("{}<e v=\"${{{expression}}}\"/>", doubled("a"));
        let told = told_on_the_last_line(&body);
        assert!(told.contains("too long"), "{expression}: {told}");
    }
}

#[test]
fn sets_and_dictionaries_find_their_items_at_once() {
    for (expression, value) in [
        ("len(set(range(100000)))", "100000"),
        ("dict([(i, i) for i in range(50000)])[49999]", "49999"),
        ("len(set([str(i) for i in range(30000)]))", "30000"),
    ] {
        assert_eq!(
            expanded(&format!("<e v='${{{expression}}}'/><xacro:if value='0'/>")),
            format!("<e v=\"{value}\"/>"),
            "{expression}"
        );
    }
}

#[test]
fn what_costs_time_costs_steps() {
    let text = "<xacro:property name='t' value=\"${'a' * 1000000}\"/>\n";
    let list = "<xacro:property name='l' value='${[0] * 20000}'/>\n";
    let roots = "<xacro:property name='r' value='${(1+sqrt(2))*(1+sqrt(3))*(1+sqrt(5))*(1+sqrt(7))*(1+sqrt(11))}'/>\n";
    let loops = |inner: &str| format!("<e v=\"${{len([{inner} for i in range(90000)])}}\"/>");
    let parameters: Vec<String> = (0..2000).map(|at| format!("p{at}:=1")).collect();
    let arguments: String = (0..2000)
        .map(|at| format!("<xacro:arg name='a{at}' default='1'/>\n"))
        .collect();
    for body in [
        format!("{text}{}", loops("t[0]")),
        format!("{text}{}", loops("t.replace('a', 'b')")),
        format!("{text}{}", loops("[c for c in t]")),
        format!("{list}{}", loops("l + l")),
        format!("{list}{}", loops("max(l)")),
        format!("{list}{}", loops("'%.0s' % l")),
        format!("{list}{}", loops("str(l)")),
        format!("{list}{}", loops("7 in l")),
        format!("{roots}{}", loops("r * r")),
        format!("{roots}{}", loops("1 / r")),
        format!("{roots}{}", loops("r ** 9")),
        format!(
            "<e v=\"${{{}}}\"/>",
            "sorted([i * 7919 % 90001 for i in range(90000)])"
        ),
        format!(
            "<xacro:macro name='m' params='{}'/>\n{}",
            parameters.join(" "),
            "<xacro:m/>".repeat(1000)
        ),
        format!("{arguments}{}", "<a b='$(eval 1)'/>".repeat(1000)),
    ] {
        let told = told_on_the_last_line(&body);
        assert!(told.contains("1000000 steps"), "{told}");
    }
    // A pattern costs what it looks at, whether it fits or not: thirty names a time.
    let files: Vec<String> = (0..30).map(|at| format!("parts/a{at}/x.xacro")).collect();
    let mut files: Vec<(&str, &str)> = files.iter().map(|name| (&name[..], "<robot/>")).collect();
    let pattern = "<xacro:include filename='parts/*/no*' optional='true'/>".repeat(40_000);
    let main = robot(&format!("<xacro:if value='0'/>\n{pattern}"));
    files.push(("main.xacro", &main));
    let folder = Folder::new("patterns", &files);
    let error = read_file_with(folder.0.join("main.xacro"), &options(&[])).unwrap_err();
    assert!(error.message.contains("1000000 steps"), "{error}");
    assert_eq!(error.line, 3, "{error}");
    let name = "n".repeat(2000);
    let told = told_on_the_last_line(&loops(&format!("[1 for {name} in [1]]")));
    assert!(told.contains("a name of more than 1000 bytes"), "{told}");
    let deep = format!(
        "<xacro:property name='a' value='${{[]}}' lazy_eval='false'/>\n{}<e v='${{a == [[a]]}}'/>",
        "<xacro:property name='a' value='${[a]}' lazy_eval='false'/>\n".repeat(2000)
    );
    assert!(told_on_the_last_line(&deep).contains("more than 600 levels deep"));
}

#[test]
fn yaml_that_repeats_itself_is_bounded() {
    let levels: String = (1..22)
        .map(|at| {
            format!(
                "l{at}: &l{at} [{}]\n",
                vec![format!("*l{}", at - 1); 9].join(", ")
            )
        })
        .collect();
    let keys: Vec<String> = (0..4000).map(|at| format!("k{at}: 1")).collect();
    let merged = format!(
        "a: &a {{{}}}\nb: {{<<: [{}]}}\n",
        keys.join(", "),
        vec!["*a"; 4000].join(", ")
    );
    let compared = "${xacro.load_yaml('levels.yaml') == xacro.load_yaml('levels.yaml')}";
    let folder = Folder::new(
        "yaml",
        &[
            ("levels.yaml", &format!("l0: &l0 [x]\n{levels}")),
            ("merged.yaml", &merged),
            (
                "compared.xacro",
                &robot(&format!("<xacro:if value='0'/>\n<e v=\"{compared}\"/>")),
            ),
            (
                "merged.xacro",
                &robot("<xacro:if value='0'/>\n<e v=\"${xacro.load_yaml('merged.yaml')}\"/>"),
            ),
        ],
    );
    for name in ["compared.xacro", "merged.xacro"] {
        let error = read_file_with(folder.0.join(name), &options(&[])).unwrap_err();
        assert!(error.message.contains("1000000 steps"), "{error}");
        assert_eq!(error.line, 3, "{error}");
    }
}

/// A folder that is removed when dropped. Deeper than packages are looked for above a file, so that nothing but what a test
/// puts there is looked at.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str, files: &[(&str, &str)]) -> Self {
        let folder = Self::root(name).join("in/".repeat(HIGHEST));
        for (file, text) in files {
            let path = folder.join(file);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        }
        Self(folder)
    }

    fn root(name: &str) -> PathBuf {
        std::env::temp_dir().join(format!("kutzbach-xacro-{}-{name}", std::process::id()))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = self.0.ancestors().nth(HIGHEST).map(std::fs::remove_dir_all);
    }
}

#[test]
fn includes_are_found_beside_the_file_and_in_packages() {
    let part = robot(
        "<xacro:property name='v' value='${1+1}'/><xacro:macro name='m' params=''><e v='${v}'/></xacro:macro>",
    );
    let main = robot(
        "<xacro:include filename='parts/one.xacro' ns='n'/><xacro:n.m/><f v='${n.v}'/>\
         <xacro:include filename='$(find arm_description)/urdf/two.xacro'/>\
         <xacro:include filename='package://arm_description/urdf/tw*.xacro'/>\
         <xacro:include filename='nothing.xacro' optional='true'/>\
         <g v=\"${xacro.load_yaml('sizes.yaml').leg[0]}\"/><mesh filename='$(find no_such_package)/m.stl'/>",
    );
    let folder = Folder::new(
        "includes",
        &[
            ("robot/urdf/main.xacro", &main),
            ("robot/urdf/parts/one.xacro", &part),
            ("robot/urdf/sizes.yaml", "leg: [!degrees 90, 2]"),
            (
                "other/arm/package.xml",
                "<package><name>arm_description</name></package>",
            ),
            ("other/arm/urdf/two.xacro", &robot("<two/>")),
        ],
    );
    let path = folder.0.join("robot/urdf/main.xacro");
    let text = expanded_file(&path, &options(&[])).unwrap_or_else(|error| panic!("{error}"));
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    assert_eq!(
        lines[1..lines.len() - 1].join(""),
        "<e v=\"2\"/><f v=\"2\"/><two/><two/><g v=\"1.5707963267948966\"/><mesh filename=\"package://no_such_package/m.stl\"/>"
    );
    // Without a file there is no place to look in.
    let error = read_with(&main, "text", &options(&[])).unwrap_err();
    assert!(error.message.contains("read without a file"), "{error}");
}

#[test]
fn the_folder_of_a_package_is_given_from_where_the_program_was_started() {
    let part = robot("<xacro:include filename='$(find pk)/sub/two.xacro'/>");
    // Deeper than the folder of the test, so that as many steps up do not lead to the same place from there.
    let deep = "d/".repeat(40);
    let folder = Folder::new(
        "relative",
        &[
            (
                &format!("{deep}main.xacro"),
                &robot("<xacro:include filename='$(find pk)/sub/one.xacro'/>"),
            ),
            (&format!("{deep}pk/sub/one.xacro"), &part),
            (
                &format!("{deep}pk/sub/two.xacro"),
                &robot("<link name='a'/>"),
            ),
        ],
    );
    let here = std::env::current_dir().unwrap();
    let up = "../".repeat(here.components().count() - 1);
    let there = folder.0.join(format!("{deep}pk"));
    let options = ReadOptions {
        packages: vec![(
            "pk".into(),
            PathBuf::from(up).join(there.strip_prefix("/").unwrap_or(&there)),
        )],
        ..options(&[])
    };
    let path = folder.0.join(format!("{deep}main.xacro"));
    let reading = read_file_with(path, &options).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(names(&reading.mechanism), ["a"]);
}

#[test]
fn what_is_wrong_in_an_included_file_is_told_there() {
    let bad = robot("<link name='x'>\n <inertial><mass value='-1'/></inertial></link><joint/>");
    let folder = Folder::new(
        "faults",
        &[
            (
                "main.xacro",
                &robot("<link name='a'/>\n<xacro:include filename='bad.xacro'/>"),
            ),
            ("bad.xacro", &bad),
            (
                "round.xacro",
                &robot("<xacro:include filename='round.xacro'/>"),
            ),
            (
                "lost.xacro",
                &robot("<xacro:include filename='$(find lost_package)/a.xacro'/>"),
            ),
            (
                "broken.xacro",
                &robot("<xacro:include filename='unclosed.xml'/>"),
            ),
            ("unclosed.xml", "<robot>\n<link>"),
        ],
    );
    let read = |name: &str| read_file_with(folder.0.join(name), &options(&[])).unwrap_err();
    let error = read("main.xacro");
    assert!(error.file.ends_with("bad.xacro"), "{error}");
    assert!(error.line >= 2, "{error}");
    let error = read("round.xacro");
    assert!(error.message.contains("include each other"), "{error}");
    let error = read("lost.xacro");
    assert!(
        error
            .message
            .contains("the package `lost_package` is not found"),
        "{error}"
    );
    assert!(error.help.unwrap().contains("--package lost_package=PATH"));
    let error = read("broken.xacro");
    assert!(
        error.file.ends_with("unclosed.xml") && error.line == 2,
        "{error}"
    );
}

/// Words of xacro files, to be put together at random.
const PIECES: [&str; 40] = [
    "${", "}", "$(", ")", "$$", "'", "\\\"", "1", "0.5", "pi", "a", "b", "[", "]", "(", ":", ",",
    ".", "+", "-", "*", "**", "/", "//", "%", " ", "if", "else", "for", "in", "not", "split",
    "range", "len", "dict", "arg a", "find b", "eval a", "&lt;", "==",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_expression_has_a_value_or_an_error(parts in prop::collection::vec(0..PIECES.len(), 0..14)) {
        let text: String = parts.iter().map(|at| PIECES[*at]).collect();
        let text = text.replace("\\\"", "&quot;");
        let body = format!(
            "<xacro:property name='a' value='2'/><xacro:property name='b' value=\"${{[1, 'x', 0.5]}}\"/>\
             <xacro:property name='c' value=\"{text}\"/><xacro:macro name='m' params=\"p:={text} q\"/>\
             <link name=\"${{c}}\"/><xacro:m q=\"${{{text}}}\"/>"
        );
        let _ = read_with(&robot(&body), "any", &options(&[]));
    }

    #[test]
    fn any_text_of_xacro_is_read_or_refused(text in "[ a-z<>/='{}$():.x]{0,80}") {
        let _ = read_with(&robot(&text), "any", &options(&[]));
        let _ = read_with(&robot(&format!("<xacro:if value='{text}'>{text}</xacro:if>")), "any", &options(&[]));
    }
}

/// A bar of this length, `L` left open.
fn with_open_length(length: &str) -> Result<kutzbach_math::number::Number, String> {
    let text = format!(
        r#"<robot name="bar" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:property name="L" value="5"/>
  <link name="g"/><link name="bar"/>
  <joint name="p" type="revolute"><parent link="g"/><child link="bar"/><origin xyz="{length} 0 0"/><axis xyz="0 0 1"/></joint>
</robot>"#
    );
    let options = ReadOptions {
        symbolic: vec!["L".into()],
        ..ReadOptions::default()
    };
    let reading = crate::read_with(&text, "bar.urdf", &options).map_err(|e| e.to_string())?;
    let frames = &reading.mechanism.joints()[0].predecessor.frame;
    Ok(frames.position[0].clone())
}

#[test]
fn what_needs_the_value_of_an_open_measure_is_refused_at_its_place() {
    for asked in [
        "${abs(L)}",
        "${fabs(L)}",
        "${floor(L)}",
        "${ceil(L)}",
        "${int(L)}",
        "${round(L)}",
        "${round(L, 2)}",
        "${trunc(L)}",
        "${L // 1}",
        "${L % 7}",
        "${7 % L}",
        "${divmod(L, 2)[0]}",
        "${fmod(L, 2)}",
        "${gcd(L, 2)}",
        "${min(L, 9)}",
        "${max(1, L)}",
        "${sorted([2, L])[0]}",
        "${atan2(L, 3)}",
        "${atan(L)}",
        "${acos(L/7)}",
        "${asin(L/7)}",
        "${exp(L)}",
        "${log(L)}",
        "${copysign(1, L)}",
        "${5 ** (L - 4)}",
        "${sqrt(L - 5)}",
        "${L if L &gt; 2 else 3}",
        "${1 if L else 3}",
        "${[1, 5][L &gt; 3]}",
        "${[1, 2, 3, 4, 5, 6][L]}",
        "${2*(L == 5) + 3}",
        "${1 if L in [5] else 2}",
        "${1 if not L else 2}",
        "${L and 2}",
        "${len(range(L))}",
        "${len([1]*L)}",
        "${float('%s' % L)}",
        "${float('{}'.format(L))}",
        "${{5: 1}[L]}",
        "${len(str(L)[0:1])}",
        "1${L}",
        "${int(str(L))}",
        "${1 if str(L) == '5' else 2}",
        "${isinstance(L, int)}",
        "${bool(L)}",
    ] {
        let told = with_open_length(asked).map(|x| x.source());
        let told = told.expect_err(asked);
        assert!(told.starts_with("bar.urdf:4:"), "{asked}: {told}");
    }
    for asked in [
        "${L}",
        "${-L}",
        "${L*L/5}",
        "${L**2}",
        "${sqrt(L)}",
        "${hypot(L, 1)}",
        "${float(L)}",
        "${pow(L, 2)}",
        "${sin(L)}",
        "${sum([L, 1])}",
        "${[1, L][1]}",
        "${float(str(L))}",
        "${L if 2 &gt; 1 else 3}",
        "${L if L is not None else 3}",
    ] {
        assert!(with_open_length(asked).expect(asked).is_open(), "{asked}");
    }
}
