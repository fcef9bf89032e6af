use super::*;
use kutzbach_closure::{Arithmetic, Geometry};
use kutzbach_mobility::families::{bennett_chain, scissor_lift};
use kutzbach_scene::Roles;
use roxmltree::{Document, Node};

/// Crank and rocker in the plane: (0 0), (0 2), (4 5), (4 0).
const FOUR_BAR: &str = r#"<robot name="four bars"><link name="ground"/><link name="crank"/><link name="coupler"/><link name="rocker"/>
<joint name="a" type="revolute"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/></joint>
<joint name="b" type="revolute"><parent link="crank"/><child link="coupler"/><origin xyz="0 2 0"/><axis xyz="0 0 1"/></joint>
<joint name="d" type="revolute"><parent link="ground"/><child link="rocker"/><origin xyz="4 0 0"/><axis xyz="0 0 1"/></joint>
<loop name="c" type="revolute"><predecessor link="coupler"><origin xyz="4 3 0"/></predecessor>
<successor link="rocker"><origin xyz="0 5 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#;

struct Drawn {
    mechanism: Mechanism,
    geometry: Geometry<f64>,
    drawing: Drawing,
}

impl Drawn {
    fn new(mechanism: Mechanism) -> Self {
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let drawing = Drawing::new(&mechanism, &geometry, &Roles::default());
        Self {
            mechanism,
            geometry,
            drawing,
        }
    }

    fn read(text: &str) -> Self {
        Self::new(kutzbach_format::read(text, "test", &[]).unwrap().mechanism)
    }

    fn view(&self) -> View {
        View::of(
            &self.drawing,
            &self.geometry.displacements,
            &self.geometry.home,
        )
    }

    fn sketch(&self) -> Sketch<'_> {
        Sketch::new(
            &self.mechanism,
            &self.drawing,
            &self.geometry.home,
            self.view(),
        )
    }
}

fn groups<'a>(document: &'a Document<'_>, attribute: &str, index: &str) -> Vec<Node<'a, 'a>> {
    document
        .descendants()
        .filter(|n| n.attribute(attribute) == Some(index))
        .collect()
}

/// The ends of the first path of an element.
fn ends(group: Node<'_, '_>) -> [[f64; 2]; 2] {
    let path = group
        .descendants()
        .find(|n| n.has_tag_name("path"))
        .unwrap();
    let d = path.attribute("d").unwrap();
    let numbers: Vec<f64> = d
        .split(|c: char| c.is_alphabetic() || c == ' ')
        .filter(|part| !part.is_empty())
        .map(|part| part.parse().unwrap())
        .collect();
    [[numbers[0], numbers[1]], [numbers[2], numbers[3]]]
}

fn everything_is_inside(svg: &str, size: [f64; 2]) {
    let document = Document::parse(svg).unwrap();
    for path in document.descendants().filter(|n| n.has_tag_name("path")) {
        let d = path.attribute("d").unwrap();
        // Arcs give radii and flags among their numbers; everything else are coordinates.
        if d.contains('A') || d.contains('h') {
            continue;
        }
        for point in d.split(['M', 'L', 'Z']).filter(|part| !part.is_empty()) {
            let (x, y) = point.split_once(' ').unwrap();
            for (value, limit) in [(x, size[0]), (y, size[1])] {
                let value: f64 = value.parse().unwrap();
                assert!((0.0..=limit).contains(&value), "{value} outside of {limit}");
            }
        }
    }
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}

#[test]
fn rods_stand_where_the_projection_says() {
    let drawn = Drawn::read(FOUR_BAR);
    let mut sketch = drawn.sketch();
    // From straight above, pixels are coordinates.
    sketch.view = View {
        toward: [0.0, 0.0, 1.0],
        up: [0.0, 1.0, 0.0],
    };
    let svg = sketch.fragment();
    everything_is_inside(&svg, sketch.size);
    let document = Document::parse(&svg).unwrap();
    let length = |[a, b]: [[f64; 2]; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let rods: Vec<_> = (0..4)
        .map(|link| {
            let found = groups(&document, "data-link", &link.to_string());
            assert_eq!(found.len(), 1);
            ends(found[0])
        })
        .collect();
    // Bars of 4, 2, 5 and 5 in one scale, upright ones upright.
    let unit = length(rods[0]) / 4.0;
    for (rod, bar) in rods.iter().zip([4.0, 2.0, 5.0, 5.0]) {
        assert!((length(*rod) / unit - bar).abs() < 0.01, "{bar}");
    }
    assert!((rods[1][0][0] - rods[1][1][0]).abs() < 0.2);
    assert!((rods[0][0][1] - rods[0][1][1]).abs() < 0.2);
    // The rocker stands to the right of the crank.
    assert!(rods[3][0][0] > rods[1][0][0]);
    for joint in 0..4 {
        assert!(!groups(&document, "data-joint", &joint.to_string()).is_empty());
    }
}

#[test]
fn a_sketch_is_what_its_reader_expects() {
    insta::assert_snapshot!(Drawn::read(FOUR_BAR).sketch().fragment());
}

#[test]
fn pins_cover_the_rods_that_they_join() {
    let drawn = Drawn::read(FOUR_BAR);
    let svg = drawn.sketch().fragment();
    let last_link = svg.rfind("data-link=\"1\"").unwrap();
    for joint in ["data-joint=\"0\"", "data-joint=\"1\""] {
        assert!(svg.find(joint).unwrap() > last_link);
    }
}

/// Two bars that cross, one a unit nearer to the eye than the other.
#[test]
fn what_is_nearer_covers_what_is_farther() {
    for (first, second) in [("0", "1"), ("1", "0")] {
        let text = format!(
            r#"<robot name="cross"><link name="g"/><link name="a"/><link name="b"/>
            <joint name="p" type="revolute"><parent link="g"/><child link="a"/><origin xyz="-2 0 {first}"/><axis xyz="0 0 1"/></joint>
            <joint name="q" type="revolute"><parent link="g"/><child link="b"/><origin xyz="0 -2 {second}"/><axis xyz="0 0 1"/></joint>
            <loop name="r" type="spherical"><predecessor link="a"><origin xyz="4 0 0"/></predecessor>
            <successor link="g"><origin xyz="2 0 {first}"/></successor></loop>
            <loop name="s" type="spherical"><predecessor link="b"><origin xyz="0 4 0"/></predecessor>
            <successor link="g"><origin xyz="0 2 {second}"/></successor></loop></robot>"#
        );
        let drawn = Drawn::read(&text);
        let mut sketch = drawn.sketch();
        sketch.view = View {
            toward: [0.0, 0.0, 1.0],
            up: [0.0, 1.0, 0.0],
        };
        let svg = sketch.fragment();
        let (a, b) = (
            svg.find("data-link=\"1\"").unwrap(),
            svg.find("data-link=\"2\"").unwrap(),
        );
        assert_eq!(a < b, first == "0", "{svg}");
    }
}

/// All feet lie in a plane, but the tops of the rods do not.
#[test]
fn a_platform_on_rods_is_seen_from_its_side() {
    let drawn = Drawn::read(include_str!("../../../../../mechanisms/wren_platform.urdf"));
    let view = drawn.view();
    assert!(view.up[2] > 0.7, "{view:?}");
    let svg = drawn.sketch().fragment();
    everything_is_inside(&svg, [480.0, 360.0]);
    // A rod for each joint, and a body for the platform and for the ground.
    for joint in 0..drawn.mechanism.joints().len() {
        let rod = format!("<g data-joint=\"{joint}\"><title>");
        assert!(svg.contains(&rod));
    }
    assert_eq!(svg.matches("class=\"web\"").count(), 2);
}

#[test]
fn other_poses_are_faint_and_ways_dotted() {
    let drawn = Drawn::read(FOUR_BAR);
    let mut turned = drawn.geometry.home.clone();
    turned[1] = turned[1].compose(&Rigid::rotation(&[0.0, 0.0, 1.0], &0.0, &1.0));
    let mut sketch = drawn.sketch();
    sketch.ghosts.push(&turned);
    sketch.paths.push(PointPath {
        link: 2,
        points: vec![[0.0; 3], [1.0, 0.0, 0.0], [f64::NAN; 3], [1.0, 9.0, 0.0]],
    });
    sketch.gaps.push([[0.0; 3], [0.0, 0.0, 1.0]]);
    let svg = sketch.document();
    everything_is_inside(&svg, sketch.size);
    let document = Document::parse(&svg).unwrap();
    let ghost = document
        .descendants()
        .find(|n| n.attribute("class") == Some("ghost"))
        .unwrap();
    // The crank alone has moved.
    assert_eq!(ghost.children().filter(Node::is_element).count(), 1);
    assert_eq!(svg.matches("class=\"path\"").count(), 1);
    assert_eq!(svg.matches("class=\"gap\"").count(), 1);
}

#[test]
fn names_from_files_are_text() {
    let nasty = "&lt;img src=x onerror=1&gt;&#x202e;";
    let drawn = Drawn::read(
        &FOUR_BAR
            .replace("rocker", nasty)
            .replace("four bars", nasty),
    );
    let svg = drawn.sketch().fragment();
    let document = Document::parse(&svg).unwrap();
    assert!(!document.descendants().any(|n| n.has_tag_name("img")));
    assert!(svg.contains("onerror") && !svg.contains('\u{202e}'));
    assert!(!svg.contains("style"));
}

#[test]
fn large_mechanisms_stay_short() {
    for mechanism in [
        scissor_lift(20).unwrap(),
        scissor_lift(75).unwrap(),
        scissor_lift(900).unwrap(),
        bennett_chain(100).unwrap(),
    ] {
        let drawn = Drawn::new(mechanism);
        let joints = drawn.mechanism.joints().len();
        let svg = drawn.sketch().fragment();
        assert!(
            svg.len() <= LONGEST,
            "{} bytes for {joints} joints",
            svg.len()
        );
        assert!(Document::parse(&svg).is_ok());
    }
}

#[test]
fn poses_that_are_not_finite_are_left_out() {
    let drawn = Drawn::read(FOUR_BAR);
    let mut broken = drawn.geometry.home.clone();
    broken[2].translation[0] = f64::NAN;
    let mut sketch = drawn.sketch();
    sketch.links = &broken;
    everything_is_inside(&sketch.fragment(), sketch.size);
    sketch.links = &[];
    sketch.ghosts.push(&broken);
    sketch.size = [f64::NAN, 0.0];
    assert!(Document::parse(&sketch.fragment()).is_ok());
}
