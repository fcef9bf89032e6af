use super::*;
use roxmltree::{Document, Node};

const HOSTILE: &str = "<img src=x onerror=1>\u{1b}\u{202e}\"'&";

fn hinges() -> Plot {
    let mut plot = Plot::new(
        "Two hinges",
        Axis::new("arclength", Scale::Linear, [0.0, 4.0]),
        Axis::new("angle (rad)", Scale::Linear, [-2.0, 2.0]),
    );
    plot.follows_arclength = true;
    plot.series = vec![
        Series::line("crank", "rad", 0, [(0.0, -2.0), (2.0, 0.0), (4.0, 2.0)]),
        Series::line(
            "rocker",
            "rad",
            13,
            [
                (0.0, 0.5),
                (1.0, f64::NAN),
                (2.0, 0.25),
                (3.0, 5.0),
                (4.0, 0.0),
            ],
        ),
    ];
    plot.marks.push(Mark {
        at: 3.0,
        label: "dead centre of rocker".to_owned(),
        kind: MarkKind::Event,
    });
    plot.marks.push(Mark {
        at: 9.0,
        label: "elsewhere".to_owned(),
        kind: MarkKind::Singular,
    });
    plot.levels.push(Level {
        at: 1.0,
        label: "limit".to_owned(),
    });
    plot
}

fn singular_values() -> Plot {
    let mut plot = Plot::new(
        "Singular values",
        Axis::new("index", Scale::Linear, [0.0, 5.0]),
        Axis::new("ratio", Scale::Log, [1e-16, 1.0]),
    );
    plot.size = [320.0, 200.0];
    plot.series.push(Series {
        name: "home".to_owned(),
        unit: String::new(),
        colour: 2,
        form: Form::Bars,
        values: [(1.0, 1.0), (2.0, 1e-8), (3.0, 0.0), (4.0, f64::NAN)]
            .map(Value::from)
            .to_vec(),
    });
    plot
}

fn all_numbers_are_finite(svg: &str) {
    for bad in ["NaN", "inf", "Infinity"] {
        assert!(!svg.contains(bad), "{bad} in {svg}");
    }
}

fn with_class<'a>(document: &'a Document<'_>, class: &str) -> Vec<Node<'a, 'a>> {
    document
        .descendants()
        .filter(|n| {
            let classes = n.attribute("class").unwrap_or_default();
            classes.split(' ').any(|c| c == class)
        })
        .collect()
}

/// From pixels back to values, as the page's script does it.
fn inverted(axis: &str, pixel: f64) -> f64 {
    let parts: Vec<&str> = axis.split(' ').collect();
    let [low, high, from, to] = [0, 1, 3, 4].map(|i| parts[i].parse::<f64>().unwrap());
    let share = (pixel - from) / (to - from);
    match parts[2] {
        "linear" => low + share * (high - low),
        "log" => low * (high / low).powf(share),
        other => panic!("{other}"),
    }
}

#[test]
fn a_plot_is_what_its_reader_expects() {
    insta::assert_snapshot!(hinges().fragment());
}

#[test]
fn bars_are_what_their_reader_expects() {
    insta::assert_snapshot!(singular_values().fragment());
}

#[test]
fn pixels_lead_back_to_values() {
    let plot = hinges();
    let svg = plot.fragment();
    let document = Document::parse(&svg).unwrap();
    let root = document.root_element();
    let lines = with_class(&document, "series");
    let crank = lines
        .iter()
        .find(|n| n.attribute("data-name") == Some("crank"))
        .unwrap();
    assert_eq!(crank.attribute("data-unit"), Some("rad"));
    let points = crank.attribute("points").unwrap();
    for (point, value) in points.split(' ').zip(&plot.series[0].values) {
        let (x, y) = point.split_once(',').unwrap();
        let x = inverted(root.attribute("data-x").unwrap(), x.parse().unwrap());
        let y = inverted(root.attribute("data-y").unwrap(), y.parse().unwrap());
        // A tenth of a pixel of some hundred.
        assert!((x - value.x).abs() < 2e-3 && (y - value.y).abs() < 2e-3);
    }
    let svg = singular_values().fragment();
    let document = Document::parse(&svg).unwrap();
    let bar = with_class(&document, "bar")[1];
    let top = bar.attribute("y").unwrap().parse().unwrap();
    let ratio = inverted(document.root_element().attribute("data-y").unwrap(), top);
    assert!((ratio.log10() + 8.0).abs() < 0.02);
}

#[test]
fn lines_break_where_nothing_is_known_and_say_where_they_leave() {
    let svg = hinges().fragment();
    all_numbers_are_finite(&svg);
    let document = Document::parse(&svg).unwrap();
    // The first value of the rocker stands alone; the colour begins again after the last.
    assert_eq!(with_class(&document, "point").len(), 1);
    let rocker: Vec<_> = with_class(&document, "s1")
        .into_iter()
        .filter(|n| n.has_tag_name("polyline"))
        .collect();
    assert_eq!(rocker.len(), 1);
    assert_eq!(rocker[0].attribute("points").unwrap().split(' ').count(), 3);
    assert_eq!(with_class(&document, "clamped").len(), 1);
    // Marks outside are left out.
    assert_eq!(with_class(&document, "mark").len(), 1);
    assert_eq!(with_class(&document, "level").len(), 1);
    assert_eq!(with_class(&document, "cursor").len(), 1);
}

#[test]
fn zero_on_a_logarithmic_axis_is_marked() {
    let svg = singular_values().fragment();
    all_numbers_are_finite(&svg);
    let document = Document::parse(&svg).unwrap();
    assert_eq!(with_class(&document, "bar").len(), 3);
    assert_eq!(with_class(&document, "clamped").len(), 1);
    assert!(with_class(&document, "cursor").is_empty());
}

#[test]
fn names_from_files_are_text() {
    let mut plot = hinges();
    plot.title = HOSTILE.to_owned();
    plot.x.label = HOSTILE.to_owned();
    plot.y.label = HOSTILE.to_owned();
    plot.marks[0].label = HOSTILE.to_owned();
    plot.levels[0].label = HOSTILE.to_owned();
    for series in &mut plot.series {
        series.name = format!("{HOSTILE} and a name that is far too long for a legend");
        series.unit = HOSTILE.to_owned();
        series.form = Form::Points;
        for value in &mut series.values {
            value.label = Some(HOSTILE.to_owned());
        }
    }
    for svg in [plot.fragment(), plot.document()] {
        let document = Document::parse(&svg).unwrap();
        assert!(!document.descendants().any(|n| n.has_tag_name("img")));
        assert!(!svg.contains('\u{202e}') && !svg.contains('\u{1b}'));
        all_numbers_are_finite(&svg);
    }
    // Fragments carry no style: the page's policy would not have it.
    assert!(!plot.fragment().contains("style"));
    assert!(plot.document().contains("prefers-color-scheme:dark"));
}

#[test]
fn nothing_makes_a_plot_fail() {
    let axes = [
        Axis::new("", Scale::Linear, [f64::NAN, f64::INFINITY]),
        Axis::new("x", Scale::Log, [-1.0, 0.0]),
        Axis::new("x", Scale::Linear, [1e300, 1e300]),
        Axis::new("x", Scale::Log, [1e-300, 1e290]),
        Axis::new("x", Scale::Linear, [1e15, 1e15 + 2.0]),
    ];
    for x in &axes {
        for y in &axes {
            for form in [Form::Line, Form::Points, Form::Rings, Form::Bars] {
                let mut plot = Plot::new("", x.clone(), y.clone());
                plot.size = [f64::NAN, -3.0];
                let values = [0.0, -1.0, 1e-320, 1e308, f64::NAN, f64::NEG_INFINITY];
                let pairs = values.iter().flat_map(|a| values.map(|b| (*a, b)));
                plot.series.push(Series {
                    form,
                    ..Series::line("a", "m", 5, pairs)
                });
                let svg = plot.document();
                all_numbers_are_finite(&svg);
                assert!(Document::parse(&svg).is_ok());
            }
        }
    }
}
