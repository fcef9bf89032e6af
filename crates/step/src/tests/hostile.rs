//! Files that are broken, on purpose or not: one message with its place, no panic, no end of the stack.

#![allow(clippy::unwrap_used)]

use super::builder::{Order, Text};
use crate::{Problem, StepError, read};

const UP: ([f64; 3], [f64; 3], [f64; 3]) = ([0.0; 3], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);

fn file(data: &str) -> String {
    format!(
        "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('X'));\nENDSEC;\nDATA;\n{data}\nENDSEC;\nEND-ISO-10303-21;\n"
    )
}

fn error(text: &str) -> StepError {
    read(text.as_bytes()).unwrap_err()
}

fn sample() -> Text {
    let mut text = Text::new();
    let plate = text.block([0.0; 3], [40.0, 20.0, 5.0], &[(10.0, 10.0, 3.0)], true);
    let plate = text.product("plate", &plate);
    let whole = text.product("whole", &[]);
    text.place("plate:1", whole, plate, UP, Order::default());
    text
}

#[test]
fn what_is_no_exchange_structure_is_named_with_its_place() {
    for (data, line, entity, words) in [
        (
            "#1=PRODUCT('a,\n#2=X();",
            6,
            Some(1),
            "needed `'` at the end of the string",
        ),
        (
            "#1=X(1;",
            6,
            Some(1),
            "needed `,` or `)` behind a value, found `;`",
        ),
        ("#1=X();\n#2 X();", 7, Some(2), "needed `=`"),
        (
            "#1=X(1.2.3);",
            6,
            Some(1),
            "needed a finite number, found `1.2.3`",
        ),
        ("#1=X(1e999);", 6, Some(1), "needed a finite number"),
        (
            "#1=X();\n\n#1=Y();",
            8,
            Some(1),
            "this number was given before, on line 6",
        ),
        (
            "#1=X(.T);",
            6,
            Some(1),
            "needed `.` at the end of an enumeration",
        ),
        (
            "#99999999999999999999999=X();",
            6,
            None,
            "needed the number of an entity",
        ),
        (
            "/* no end",
            6,
            None,
            "needed `*/` at the end of the comment",
        ),
        ("#1=(A()B(;", 6, Some(1), "needed a value, found `;`"),
    ] {
        let found = error(&file(data));
        assert_eq!(
            (found.line, found.entity),
            (line, entity),
            "{data}: {found}"
        );
        assert!(found.to_string().contains(words), "{data}: {found}");
    }
    for text in [
        "",
        "solid cube",
        "ISO-10303-21;",
        "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n",
    ] {
        assert!(
            matches!(error(text).problem, Problem::Syntax { .. }),
            "{text}"
        );
    }
    let empty = error(&file(""));
    assert!(
        empty.to_string().contains("solids or shells with faces"),
        "{empty}"
    );
}

#[test]
fn nesting_has_an_end() {
    for depth in [65, 1_000_000] {
        let lists = format!("#1=X({}", "(".repeat(depth));
        let typed = format!("#1=X({}", "A(".repeat(depth));
        for data in [lists, typed] {
            let found = error(&file(&data));
            assert!(matches!(found.problem, Problem::TooMuch { .. }), "{found}");
            assert_eq!(found.entity, Some(1));
        }
    }
    let fine = format!("#1=X({}{});", "(".repeat(60), ")".repeat(60));
    assert!(matches!(
        error(&file(&fine)).problem,
        Problem::Geometry { .. }
    ));
}

#[test]
fn references_to_nothing_are_named() {
    let text = sample();
    let whole = text.finished();
    // Every reference from an entity that is read leads to an error that names both ends.
    let line = whole
        .lines()
        .find(|line| line.contains("=CYLINDRICAL_SURFACE("))
        .unwrap();
    let broken = whole.replace(line, &line.replace("('',#", "('',#9999"));
    let found = error(&broken);
    assert!(
        matches!(found.problem, Problem::Unresolved { .. }),
        "{found}"
    );
    assert!(found.to_string().contains("refers to #9999"), "{found}");
    let number: u64 = line[1..].split('=').next().unwrap().parse().unwrap();
    assert_eq!(found.entity, Some(number));
}

#[test]
fn an_entity_of_another_kind_is_named() {
    let whole = sample().finished();
    let broken = whole.replacen("=CARTESIAN_POINT(", "=CARTESIAN_POINTS(", 1);
    let found = error(&broken);
    assert!(
        found.to_string().contains("found CARTESIAN_POINTS"),
        "{found}"
    );
    let broken = whole.replacen("AXIS2_PLACEMENT_3D('',#", "AXIS2_PLACEMENT_3D('','#", 1);
    assert!(matches!(error(&broken).problem, Problem::Syntax { .. }));
    let broken = whole.replace(".T.);", ".U.);");
    let found = error(&broken);
    assert!(
        found.to_string().contains("needs `.T.` or `.F.`"),
        "{found}"
    );
}

#[test]
fn assemblies_do_not_contain_themselves() {
    let mut text = sample();
    let pin = text.pin(1.0, (0.0, 1.0));
    let first = text.product("first", &pin);
    let second = text.product("second", &[]);
    text.place("a", first, second, UP, Order::default());
    text.place("b", second, first, UP, Order::default());
    let found = error(&text.finished());
    assert!(matches!(found.problem, Problem::Cycle { .. }), "{found}");
    assert!(found.entity.is_some());
}

#[test]
fn mapped_items_do_not_contain_themselves() {
    let mut text = Text::new();
    let frame = text.placement(UP.0, UP.1, UP.2);
    let context = text.context();
    let next = text.next_number();
    let (map, item, shown) = (next, next + 1, next + 2);
    text.add(&format!("REPRESENTATION_MAP(#{frame},#{shown})"));
    text.add(&format!("MAPPED_ITEM('',#{map},#{frame})"));
    text.add(&format!(
        "SHAPE_REPRESENTATION('',(#{frame},#{item}),#{context})"
    ));
    text.shown_by("part", shown, frame);
    let found = error(&text.finished());
    assert!(matches!(found.problem, Problem::Cycle { .. }), "{found}");
}

#[test]
fn doublings_end() {
    // Forty levels of two occurrences each are more parts than there are.
    let mut text = Text::new();
    let pin = text.pin(1.0, (0.0, 1.0));
    let mut below = text.product("pin", &pin);
    for level in 0..40 {
        let above = text.product(&format!("level {level}"), &[]);
        text.place("a", above, below, UP, Order::default());
        text.place("b", above, below, UP, Order::default());
        below = above;
    }
    let found = error(&text.finished());
    assert!(matches!(found.problem, Problem::TooMuch { .. }), "{found}");
}

#[test]
fn occurrences_without_a_place_are_refused() {
    let mut text = Text::new();
    let pin = text.pin(1.0, (0.0, 1.0));
    let pin = text.product("pin", &pin);
    let whole = text.product("whole", &[]);
    let usage = text.usage("lost", whole, pin);
    let found = error(&text.finished());
    assert_eq!(found.entity, Some(usage));
    assert!(
        found
            .to_string()
            .contains("needed the place of an occurrence"),
        "{found}"
    );
}

#[test]
fn a_file_cut_anywhere_is_an_error() {
    let whole = sample().finished();
    let end = whole.find("END-ISO-10303-21").unwrap();
    for cut in (0..end).step_by(7) {
        error(&whole[..cut]);
    }
}

#[test]
fn other_bytes_cause_no_panic() {
    let whole = sample().finished().into_bytes();
    let mut state = 7_u64;
    let mut random = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) as usize
    };
    let pieces = b"#(),;'$*=.0123456789-TFE";
    for _ in 0..2000 {
        let mut bytes = whole.clone();
        for _ in 0..1 + random() % 4 {
            let (at, with) = (random() % bytes.len(), random() % pieces.len());
            bytes[at] = pieces[with];
        }
        // Whatever comes out: it comes out.
        let _ = read(&bytes);
    }
}
