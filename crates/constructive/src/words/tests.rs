use super::text::short;
use super::*;
use crate::sketch::{Constraint, Element, Sketch};
use kutzbach_math::number::Number;

fn said(elements: Vec<Element>, constraints: &[(usize, usize, &str)]) -> String {
    let constraint = |&(u, v, value): &(usize, usize, &str)| Constraint {
        ends: [u, v],
        value: Number::decimal(value)
            .unwrap_or_else(|_| Number::expression(value, &mut |_: &str| Ok(None)).unwrap()),
    };
    let names = (0..elements.len()).map(|k| format!("e{k}")).collect();
    let constraints = constraints.iter().map(constraint).collect();
    let sketch = Sketch::new(elements, constraints).unwrap();
    let named = NamedSketch::new("x".to_owned(), names, sketch);
    SketchWords::of(&named).text()
}

fn points(places: &[[f64; 2]]) -> Vec<Element> {
    places.iter().map(|&p| Element::Point(p)).collect()
}

#[test]
fn a_constraint_too_many_agrees_or_contradicts() {
    let square = points(&[[0.0; 2], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    let with = |last| {
        let sides = [
            (0, 1, "1"),
            (1, 2, "1"),
            (2, 3, "1"),
            (3, 0, "1"),
            (0, 2, "sqrt(2)"),
            (1, 3, last),
        ];
        said(square.clone(), &sides)
    };
    assert!(
        with("sqrt(2)").contains("among e0 e1 e2 e3, and agrees with them"),
        "{}",
        with("sqrt(2)")
    );
    let text = with("1.4142");
    let told = "and agrees with them within the digits: they leave 1.414214, it asks for 1.414200";
    assert!(text.contains(told), "{text}");
    let text = with("2");
    assert!(
        text.contains(
            "and contradicts them: they leave 1.414214 at the nearest, it asks for 2.000000"
        ),
        "{text}"
    );
}

#[test]
fn sides_along_lines_are_ahead_and_behind() {
    let line = Element::Line {
        through: [0.0; 2],
        direction: [1.0, 0.0],
    };
    let at = |x: f64| vec![line, Element::Point([0.0; 2]), Element::Point([x, 2.0])];
    let constraints = [(0, 1, "0"), (0, 2, "2"), (1, 2, "4")];
    assert!(said(at(3.0), &constraints).contains("two places, drawn ahead along the line"));
    assert!(said(at(-3.0), &constraints).contains("two places, drawn behind along the line"));
    let tangent = |direction| {
        let line = Element::Line {
            through: [0.0, 1.0],
            direction,
        };
        let elements = vec![Element::Point([0.0; 2]), Element::Point([4.0, 0.0]), line];
        said(elements, &[(0, 1, "4"), (0, 2, "-1"), (1, 2, "1/2")])
    };
    let [one, other] = [[3.0, 1.0], [-3.0, -1.0]].map(tangent);
    let pointing = |text: &str| {
        let (_, rest) = text.split_once("drawn pointing ").unwrap();
        rest.trim().to_owned()
    };
    assert_ne!(pointing(&one), pointing(&other));
}

#[test]
fn nothing_is_said_of_steps_that_are_not_reached() {
    let places = points(&[[0.0; 2], [1.0, 0.0], [0.5, 1.0], [1.5, 1.0]]);
    let bars = [
        (0, 1, "1"),
        (0, 2, "1"),
        (1, 2, "5"),
        (1, 3, "1"),
        (2, 3, "1"),
    ];
    let text = said(places, &bars);
    assert!(
        text.contains("circles do not meet, they are 3 apart"),
        "{text}"
    );
    assert!(
        text.contains("solutions: 0\nwell-constrained says that"),
        "{text}"
    );
    assert!(
        text.contains("not reached on the sides drawn: 1 step after it"),
        "{text}"
    );
    assert!(!text.contains("step 2:"), "{text}");
    assert_eq!(
        [short(0.000_123), short(12.5), short(123_456.7), short(2e-9)],
        ["0.000123", "12.5", "123457", "2.000e-9"]
    );
    // Whole numbers are as they are: other digits are no question.
    assert!(!text.contains("other digits"), "{text}");
}
