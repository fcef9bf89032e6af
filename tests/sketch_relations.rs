//! Sketches with constraints of three elements and more: what is known of each figure is school geometry.

use kutzbach::constructive::analysis::s_tree;
use kutzbach::constructive::construction::{Construction, Shape};
use kutzbach::constructive::named::NamedSketch;
use kutzbach::constructive::together::together;
use kutzbach::constructive::words::SketchWords;
use kutzbach::format::read_sketch;

fn read(body: &str) -> NamedSketch {
    read_sketch(&format!("<sketch name='s'>{body}</sketch>"), "f", &[]).unwrap()
}

fn told(body: &str) -> String {
    SketchWords::of(&read(body)).text()
}

/// The places of all elements in every solution.
fn solutions(named: &NamedSketch) -> Vec<Vec<Shape>> {
    if let Ok(construction) = Construction::new(&named.sketch) {
        let all = construction.solutions();
        return all.map(|s| named.whole(&s.shapes)).collect();
    }
    let found = together(&named.sketch, &s_tree(named.sketch.graph()));
    let all = found.solutions(&named.sketch, 1000).unwrap();
    all.iter().map(|(shapes, _)| named.whole(shapes)).collect()
}

fn point(named: &NamedSketch, all: &[Shape], name: &str) -> [f64; 2] {
    let at = named.names.iter().position(|n| n == name).unwrap();
    match all[at] {
        Shape::Point(p) => p,
        Shape::Line { .. } => panic!("{name} is a line"),
    }
}

fn distance(named: &NamedSketch, all: &[Shape], pair: [&str; 2]) -> f64 {
    let [p, q] = pair.map(|name| point(named, all, name));
    (p[0] - q[0]).hypot(p[1] - q[1])
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-9, "{a} is not {b}");
}

const CROSS: &str = "<line name='x' through='0 0' direction='1 0'/><line name='y' through='0 0' direction='0 1'/>
    <perpendicular between='x y'/>
    <point name='a' xy='-2 -1.1'/><point name='b' xy='2 -1'/><point name='c' xy='2 1'/><point name='d' xy='-2 1'/>
    <symmetric between='a b' about='y'/><symmetric between='d c' about='y'/><symmetric between='a d' about='x'/>";

const SIDES: &str = "<distance between='a b' value='4'/><distance between='b c' value='2'/>";

#[test]
fn two_axes_make_a_rectangle() {
    let named = read(&format!("{CROSS}{SIDES}"));
    let text = SketchWords::of(&named).text();
    assert!(
        text.starts_with("s: 6 elements, 6 constraints, well-constrained\n"),
        "{text}"
    );
    let all = solutions(&named);
    // As drawn and mirrored: turned by half a turn it is the same, whichever way the axes point.
    assert_eq!(all.len(), 2);
    for places in &all {
        near(distance(&named, places, ["c", "d"]), 4.0);
        near(distance(&named, places, ["d", "a"]), 2.0);
        near(distance(&named, places, ["a", "c"]), 20_f64.sqrt());
        near(distance(&named, places, ["b", "d"]), 20_f64.sqrt());
    }
    // The first is the one drawn.
    let drawn = point(&named, &all[0], "a");
    let [c, x] = ["c", "x"].map(|n| named.names.iter().position(|m| m == n).unwrap());
    assert!(
        Construction::value_between(&all[0][c], &all[0][x]) > 0.0,
        "{drawn:?}"
    );
}

#[test]
fn a_rectangle_with_a_side_too_many_agrees_or_contradicts() {
    let with = |more: &str| told(&format!("{CROSS}{SIDES}{more}"));
    let agrees = "is fixed already by the constraints among x y a b c d, and agrees with them";
    let text = with("<distance between='c d' value='4'/>");
    assert!(text.contains("over-constrained"), "{text}");
    assert!(text.contains(&format!("too many: c d {agrees}")), "{text}");
    let text = with("<distance between='c d' value='5'/>");
    let contradicts =
        "and contradicts them: they leave 4.000000 at the nearest, it asks for 5.000000";
    assert!(text.contains(contradicts), "{text}");
    // What is mirrored in both axes is mirrored all round.
    let text = with("<symmetric between='b c' about='x'/>");
    assert!(
        text.contains(&format!("too many: b c symmetric about x {agrees}")),
        "{text}"
    );
    let text = with("<equal of='a b' and='c d'/>");
    assert!(text.contains(agrees), "{text}");
    assert_eq!(text.matches("too many").count(), 1, "{text}");
}

#[test]
fn a_rectangle_without_its_sides_moves() {
    let text = told(CROSS);
    assert!(
        text.contains("under-constrained\nfreedoms left: 2\n"),
        "{text}"
    );
    let text = told(&format!("{CROSS}<distance between='a c' value='3'/>"));
    assert!(
        text.contains("under-constrained\nfreedoms left: 1\n"),
        "{text}"
    );
}

const RHOMBUS: &str = "<point name='a' xy='0 0'/><point name='b' xy='3 -1'/><point name='c' xy='6 0'/><point name='d' xy='3 1'/>
    <equal of='a b' and='b c'/><equal of='b c' and='c d'/><equal of='c d' and='d a'/>";

#[test]
fn equal_sides_make_a_rhombus() {
    // One side says the others: circles and lines construct it, folded or not.
    let text = told(&format!(
        "{RHOMBUS}<distance between='c d' value='5'/><distance between='a c' value='6'/>"
    ));
    assert!(
        text.contains("s: 4 elements, 5 constraints, well-constrained"),
        "{text}"
    );
    assert!(text.contains("steps: 2\nsolutions: 4\n"), "{text}");
    // No side is known: its diagonals are, and half of each makes the side.
    let named = read(&format!(
        "{RHOMBUS}<distance between='a c' value='6'/><distance between='b d' value='2'/>"
    ));
    let all = solutions(&named);
    assert_eq!(all.len(), 2);
    for places in &all {
        for pair in [["a", "b"], ["b", "c"], ["c", "d"], ["d", "a"]] {
            near(distance(&named, places, pair), 10_f64.sqrt());
        }
    }
    let text = SketchWords::of(&named).text();
    assert!(
        text.contains("2 places, and no other, by exact algebra\nsolutions: 2\n"),
        "{text}"
    );
}

#[test]
fn a_middle_follows_or_holds() {
    let triangle = "<point name='a' xy='0 0'/><point name='b' xy='4 0'/><point name='c' xy='1 3'/><point name='m' xy='2 0'/>
        <midpoint point='m' between='a b'/><distance between='a b' value='4'/><distance between='a c' value='3'/>";
    let text = told(&format!("{triangle}<distance between='b c' value='4'/>"));
    assert!(
        text.contains("4 elements, 4 constraints, well-constrained\nsteps: 1\nsolutions: 2\n"),
        "{text}"
    );
    assert!(text.contains("follows: m in the middle of a b\n"), "{text}");
    // The median is given in place of a side: 2 (9 + x²) = 16 + 4 · 9.
    let named = read(&format!("{triangle}<distance between='c m' value='3'/>"));
    let all = solutions(&named);
    assert_eq!(all.len(), 2);
    for places in &all {
        near(distance(&named, places, ["b", "c"]), 17_f64.sqrt());
        near(distance(&named, places, ["a", "m"]), 2.0);
        near(distance(&named, places, ["b", "m"]), 2.0);
    }
    // Half of a length is no news.
    let text = told(&format!(
        "{triangle}<distance between='b c' value='4'/><distance between='a m' value='2'/>"
    ));
    assert!(
        text.contains("too many: ") && text.contains("and agrees with them"),
        "{text}"
    );
}

const TRIANGLE: &str = "<point name='a' xy='0 0'/><point name='b' xy='4 0'/><point name='c' xy='0 3'/><point name='o' xy='0.9 1.1'/>
    <line name='ab' through='0 0' direction='1 0'/><line name='bc' through='4 0' direction='-4 3'/><line name='ca' through='0 3' direction='0 -1'/>
    <incidence between='a ab'/><incidence between='b ab'/><incidence between='b bc'/><incidence between='c bc'/><incidence between='c ca'/>
    <incidence between='a ca'/><distance between='a b' value='4'/><distance between='b c' value='5'/><distance between='c a' value='3'/>
    <circle name='in' center='o' radius='1'/>";

#[test]
fn four_circles_touch_the_sides_of_a_triangle() {
    // Of the triangle 3, 4, 5: the one inside and three outside, each of them mirrored as well.
    let named = read(&format!(
        "{TRIANGLE}<tangent between='in ab'/><tangent between='in bc'/><tangent between='in ca'/>"
    ));
    let mut radii: Vec<f64> = solutions(&named)
        .iter()
        .map(|places| named.radii(places)[0].unwrap())
        .collect();
    // The one drawn comes first.
    near(radii[0], 1.0);
    radii.sort_by(f64::total_cmp);
    assert_eq!(radii.len(), 8);
    for (radius, known) in radii.iter().zip([1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 6.0, 6.0]) {
        near(*radius, known);
    }
}

/// Three circles of radius one that touch each other, and a fourth that touches all.
fn three_and(side: &str, radius: f64) -> NamedSketch {
    let touching =
        ["p", "q", "s"].map(|c| format!("<tangent between='fourth {c}' side='{side}'/>"));
    read(&format!(
        "<point name='cp' xy='0 0'/><point name='cq' xy='2 0'/><point name='cs' xy='1 1.7'/><point name='o' xy='1 0.6'/>
        <circle name='p' center='cp' radius='1'/><circle name='q' center='cq' radius='1'/><circle name='s' center='cs' radius='1'/>
        <radius of='q' value='1'/><equal of='p' and='q'/><equal of='q' and='s'/>
        <tangent between='p q'/><tangent between='q s'/><tangent between='s p'/>
        <circle name='fourth' center='o' radius='{radius}'/>{}",
        touching.concat()
    ))
}

#[test]
fn a_circle_touches_three_from_outside_or_from_around() {
    // Soddy's circles: 2/√3 ∓ 1.
    for (side, radius) in [
        ("outside", 2.0 / 3_f64.sqrt() - 1.0),
        ("inside", 2.0 / 3_f64.sqrt() + 1.0),
    ] {
        let named = three_and(side, radius);
        let all = solutions(&named);
        assert_eq!(all.len(), 2, "{side}");
        for places in &all {
            near(named.radii(places)[3].unwrap(), radius);
        }
    }
}

#[test]
fn circles_that_touch_one_line_in_one_point_cannot_stand_apart() {
    let text = told(
        "<point name='p' xy='0 0'/><point name='q' xy='4 0'/><point name='r' xy='2 3'/><line name='base' through='0 -2' direction='1 0'/>
        <circle name='one' center='p' radius='2'/><circle name='two' center='q' radius='2'/><circle name='top' center='r' radius='5'/>
        <radius of='top' value='5'/><equal of='one' and='two'/><distance between='p q' value='4'/>
        <tangent between='one base'/><tangent between='two base'/><tangent between='top base'/>
        <tangent between='top one' side='inside'/><tangent between='top two' side='inside'/>",
    );
    assert!(
        text.contains("solutions: 0\nwell-constrained says that"),
        "{text}"
    );
}

#[test]
fn tangents_of_known_circles_are_steps() {
    let text = told(
        "<point name='p' xy='0 0'/><point name='q' xy='5 0'/><point name='r' xy='2.5 2'/><line name='base' through='0 -2' direction='1 0'/>
        <circle name='one' center='p' radius='2'/><circle name='two' center='q' radius='2'/><circle name='top' center='r' radius='1'/>
        <radius of='one' value='2'/><equal of='one' and='two'/><radius of='top' value='1.5'/><distance between='p q' value='5'/>
        <tangent between='one base'/><tangent between='two base'/><tangent between='top one'/><tangent between='top two'/>",
    );
    assert!(
        text.contains("s: 4 elements, 3 circles, 5 constraints, well-constrained"),
        "{text}"
    );
    assert!(
        text.contains("step 2: r by p q: two places, drawn on the left"),
        "{text}"
    );
}

#[test]
fn the_sides_of_a_slot_are_symmetric() {
    let named = read(
        "<line name='m' through='0 0' direction='1 0'/><line name='k' through='0 1' direction='1 0'/><line name='l' through='0 -1' direction='-1 0'/>
        <point name='o' xy='0 0'/><point name='u' xy='4 0'/><circle name='left' center='o' radius='1'/>
        <incidence between='o m'/><incidence between='u m'/><distance between='o u' value='4'/><radius of='left' value='1'/>
        <symmetric between='k l' about='m'/><parallel between='k m'/><tangent between='left k'/>",
    );
    let all = solutions(&named);
    assert!(!all.is_empty());
    let at = |name: &str| named.names.iter().position(|n| n == name).unwrap();
    for places in &all {
        // The second side points the other way, as drawn, and has the centre on its right as well.
        let [k, l, o, u] = ["k", "l", "o", "u"].map(|n| &places[at(n)]);
        near(Construction::value_between(o, k), -1.0);
        near(Construction::value_between(o, l), -1.0);
        near(Construction::value_between(u, l), -1.0);
        near(
            Construction::value_between(k, l).abs(),
            std::f64::consts::PI,
        );
    }
}

#[test]
fn mirror_images_on_their_axis_are_one_place() {
    let on_axis = |far: &str| {
        told(&format!(
            "<point name='p' xy='3 -2'/><point name='q' xy='2 2'/><point name='s' xy='5 1'/><line name='l' through='0 0' direction='1 0'/>
            <incidence between='p l'/><symmetric between='p q' about='l'/><distance between='s p' value='7'/><distance between='s q' value='{far}'/>"
        ))
    };
    // One point cannot be at two distances; at one it goes round.
    let text = on_axis("3");
    assert!(text.contains("solutions: 0\n"), "{text}");
    let text = on_axis("7");
    assert!(text.contains("infinitely many places: it moves"), "{text}");
}

#[test]
fn lines_whose_sense_nothing_measures_are_not_counted_twice() {
    let text = told(
        "<point name='a' xy='0 0'/><point name='b' xy='5 0'/><line name='l' through='0 0' direction='1 0'/>
        <distance between='a b' value='5'/><incidence between='a l'/><incidence between='b l'/>",
    );
    assert!(text.contains("solutions: 1\n"), "{text}");
    assert!(
        text.contains("one place, whichever way the line points"),
        "{text}"
    );
    // Two sides of an equilateral triangle and what bisects them: two figures and their mirror images.
    let wedge = "<line name='m' through='0 0' direction='1 0'/><line name='k' through='0 0' direction='2 1'/><line name='l' through='0 0' direction='-2 1'/>
        <point name='o' xy='0 0'/><point name='p' xy='2 1'/><point name='q' xy='2 -1'/>
        <symmetric between='k l' about='m'/><incidence between='o k'/><incidence between='o m'/><incidence between='p k'/><incidence between='q l'/>
        <distance between='o p' value='2'/><distance between='o q' value='2'/><distance between='p q' value='2'/>";
    let text = told(wedge);
    assert!(text.contains("solutions: 4\n"), "{text}");
    // A point beside a line says which way it points, and both sides are open then.
    let text = told(
        "<point name='a' xy='0 0'/><point name='b' xy='5 0'/><point name='c' xy='2 1'/><line name='l' through='0 0' direction='1 0'/>
        <distance between='a b' value='5'/><incidence between='a l'/><incidence between='b l'/>
        <distance between='c l' value='1'/><distance between='a c' value='3'/>",
    );
    assert!(text.contains("solutions: 4\n"), "{text}");
}

#[test]
fn mistakes_are_told_at_their_places() {
    let wrong = |more: &str| {
        let text = format!(
            "<sketch name='s'>{CROSS}<circle name='o' center='a' radius='1'/>{more}</sketch>"
        );
        read_sketch(&text, "f", &[]).unwrap_err().message
    };
    for (more, message) in [
        (
            "<symmetric between='a x' about='y'/>",
            "two points are symmetric, or two lines",
        ),
        (
            "<symmetric between='a b' about='c'/>",
            "elements are symmetric about a line",
        ),
        (
            "<symmetric between='x y' about='y'/>",
            "two elements are symmetric about a third one",
        ),
        (
            "<midpoint point='a' between='a b'/>",
            "the middle is not one of the two ends",
        ),
        (
            "<midpoint point='a' between='c x'/>",
            "`x` is a line, needed a point",
        ),
        (
            "<symmetric between='b a' about='y'/>",
            "this was said of the same elements before",
        ),
        (
            "<midpoint point='a' between='c d'/><midpoint point='a' between='d c'/>",
            "this was said of the same elements before",
        ),
        ("<equal of='a b' and='b a'/>", "a length is equal to itself"),
        (
            "<equal of='a b' and='c'/>",
            "needed two points, or a circle",
        ),
        (
            "<equal of='a b' and='c d'/><equal of='c d' and='a b'/>",
            "that these are equal follows from what was said before",
        ),
        (
            "<distance between='a b' value='1'/><distance between='c d' value='2'/><equal of='a b' and='c d'/>",
            "these have different values",
        ),
        ("<tangent between='a b'/>", "none of these is a circle"),
        (
            "<tangent between='o b'/>",
            "a circle touches a line, or another circle",
        ),
        (
            "<tangent between='o x' side='outside'/>",
            "needed `left` or `right`",
        ),
        (
            "<incidence between='o a'/>",
            "the center of a circle is not on it",
        ),
        (
            "<incidence between='o x'/>",
            "`x` is a line, needed a point",
        ),
        (
            "<distance between='o b' value='1'/>",
            "`o` is a circle, needed a point or line",
        ),
        (
            "<radius of='o' value='0'/>",
            "the radius of a circle is above zero",
        ),
        ("<radius of='oo' value='1'/>", "no circle is named `oo`"),
        (
            "<circle name='o' center='b' radius='1'/>",
            "two elements are named `o`",
        ),
    ] {
        assert_eq!(wrong(more), message, "{more}");
    }
}
