//! Questions and scripts about a small world, in both forms.

use super::{Session, Told};
use crate::text::{Legible, read_world};
use crate::{Answer, Measured};
use kutzbach_math::number::Number;

const WORLD: &str = "\
number h ${sqrt(3)/2}
point O 0 0 0
point A 3 0 0
point B 0 4 0
direction up 0 0 1
line x O through A
line y O through B
line high 0 0 1 along 1 0 0
plane ground O normal up
plane roof 0 0 2 normal up
cylinder pin 1 1 0 along up radius ${h}
solid box
  vertex a 0 0 0
  vertex b 1 0 0
  vertex c 1 1 0
  vertex d 0 1 0
  vertex e 0 0 1
  vertex f 1 0 1
  vertex g 1 1 1
  vertex h 0 1 1
  face bottom a d c b
  face top e f g h
  face front a b f e
  face right b c g f
  face back c d h g
  face left d a e h
end
";

fn session<S: Legible>(more: &str) -> Session<S> {
    Session::from(read_world::<S>(&format!("{WORLD}{more}")).unwrap())
}

fn exact() -> Session<Number> {
    session("")
}

fn names(session: &Session<Number>, question: &str) -> Vec<String> {
    let answers = session.ask(question).unwrap();
    let row = |row: &super::Row| {
        let texts: Vec<&str> = row.found.iter().map(|shown| shown.text.as_str()).collect();
        texts.join(" ")
    };
    answers.rows.iter().map(row).collect()
}

#[test]
fn values_and_truths_are_told() {
    let session = exact();
    for (question, said) in [
        ("distance(A, B)", "= 5"),
        ("distance(ground, roof)", "= 2"),
        ("parallel(x, high)", "yes"),
        ("parallel(x, y)", "no"),
        ("perpendicular(x, y), distance(x, high) = 1", "yes"),
        ("distance(A, B) < 5", "no"),
        ("distance(A, B) >= 5", "yes"),
        ("classify(A, roof)", "= below"),
        ("classify(A, roof) = below", "yes"),
        ("classify(point(0.5, 0.5, 0.5), box) != outside", "yes"),
        ("not(parallel(x, y))", "yes"),
        ("intersection(x, y)", "= point(0, 0, 0)"),
        ("intersection(x, high)", "= nothing"),
        ("A", "= point(3, 0, 0)"),
    ] {
        assert_eq!(session.ask(question).unwrap().lines(), [said], "{question}");
    }
    let root = session.ask("distance(point(0,0,0), point(1,1,0))").unwrap();
    let number = root.rows[0].values[0].number.unwrap();
    assert!((number - 2f64.sqrt()).abs() < 1e-15);
}

#[test]
fn free_names_find_all_that_holds() {
    let session = exact();
    assert_eq!(
        names(&session, "is(?f, face), parallel(?f, box.top)"),
        ["box.bottom", "box.top"]
    );
    assert_eq!(
        names(
            &session,
            "is(?f, face), parallel(?f, box.top), ?f != box.top"
        ),
        ["box.bottom"]
    );
    let without = names(
        &session,
        "is(?f, face), not(parallel(?f, box.top), distance(?f, box.top) > 0)",
    );
    assert_eq!(without.len(), 5);
    assert_eq!(
        names(
            &session,
            "is(?f, face), not(is(?g, face), ?g != ?f, parallel(?g, ?f))"
        ),
        Vec::<String>::new()
    );
    assert_eq!(names(&session, "?d = distance(A, B)"), ["5"]);
    assert_eq!(
        names(&session, "part(?v, box), is(?v, point), ?v != box.a").len(),
        7
    );
    assert_eq!(names(&session, "convex(box.top, ?f)").len(), 4);
    let answers = session.ask("parallel(?f, box.top)").unwrap();
    assert!(answers.without_value > 0 && answers.first_without_value.is_some());
}

#[test]
fn digits_are_told() {
    let more = "point P 1.0 0.00 0\npoint Q 2 0 0\nline p P along 0 0 1\n";
    let session = session::<Measured>(more);
    let answers = session
        .ask("is(?p, point), contained(?p, x), distance(?p, Q) < 1.5")
        .unwrap();
    let rows: Vec<(&str, Answer)> = answers
        .rows
        .iter()
        .map(|row| (row.found[0].text.as_str(), row.holds))
        .collect();
    assert!(rows.contains(&("P", Answer::WithinDigits)), "{rows:?}");
    assert!(rows.contains(&("Q", Answer::Yes)), "{rows:?}");
    let lines = answers.lines().join("\n");
    assert!(lines.contains("?p = P  (within the digits)"), "{lines}");
    let not = session.ask("not(contained(P, x))").unwrap();
    assert_eq!(not.rows[0].holds, Answer::WithinDigits);
}

#[test]
fn a_transcript_is_a_script_with_the_same_transcript() {
    let script = "# two lines and what crosses both\n\
        z = line(O, up)\n\
        far = line(point(1, 0, 0), direction(0, 1, 0))\n\
        \n\
        feet = join_perpend(z, far)   # two points\n\
        distance(feet.1, feet.2)\n\
        d = distance(A, B)\n\
        d\n\
        parallel(?l, x), is(?l, line)\n\
        rename far distant\n\
        delete distant with parts\n\
        list\n";
    let first = exact().run(script).unwrap();
    let text = first.text();
    assert!(text.contains("#| = 1\n"), "{text}");
    assert!(text.contains("#| d: 5\n"), "{text}");
    assert!(text.contains("#| deleted 3\n"), "{text}");
    let second = exact().run(&text).unwrap();
    assert_eq!(second.text(), text);
    assert!(matches!(
        first.lines[1].reply.as_ref().unwrap().told,
        Told::Made { .. }
    ));
}

#[test]
fn errors_have_columns() {
    let session = exact();
    for (question, column, said) in [
        ("paralel(x, y)", 1, "needed a function, found `paralel`"),
        (
            "parallel(x)",
            1,
            "needed 2 argument(s) for `parallel`, found 1",
        ),
        ("parallel(x, q)", 13, "found `q`"),
        (
            "parallel(x, y",
            14,
            "needed `,` and another term, or `)`, found the end",
        ),
        ("parallel(A, y)", 1, "found a point and a line"),
        ("distance(A, B) <", 17, "needed a name"),
        ("?", 1, "`?` without a name"),
        ("distance(A, ${1/0})", 17, "needed a divisor"),
        ("distance(A, B) @", 16, "found `@`"),
        ("is(x, lines)", 7, "needed one of vector"),
        (
            "classify(A, roof) = belw",
            21,
            "needed `=` or `!=` and one of",
        ),
    ] {
        let error = session.ask(question).unwrap_err();
        assert_eq!(error.column, column, "{question}: {error}");
        assert!(error.message.contains(said), "{question}: {error}");
    }
    let error = exact()
        .run("a = point(0, 0, 0)\nb = line(a, a)\n")
        .unwrap_err();
    assert_eq!((error.line, error.column), (2, 5), "{error}");
    let error = exact().run("x = point(0, 0, 0)\n").unwrap_err();
    assert!(error.message.contains("`x`"), "{error}");
}

#[test]
fn nesting_and_numbers_of_combinations_are_bounded() {
    let session = exact();
    let deep = format!("{}A{}", "ends(".repeat(10_000), ")".repeat(10_000));
    assert!(
        session
            .ask(&deep)
            .unwrap_err()
            .message
            .contains("at most 32")
    );
    let wide = "?a != ?b, ?c != ?d, ?e != ?f";
    let error = session.ask(wide).unwrap_err();
    assert!(error.message.contains("found more"), "{error}");
}

#[test]
fn worlds_are_refused_with_their_places() {
    for (text, line, column, said) in [
        ("point A 0 0\n", 1, 12, "needed a number"),
        ("point A 0 0 0\npoint A 1 0 0\n", 2, 7, "`A`"),
        ("ponit A 0 0 0\n", 1, 1, "a line that begins with"),
        ("line l 0 0 0 through 0 0 0\n", 1, 8, "two different points"),
        ("direction d 0 0 0\n", 1, 13, "not the zero vector"),
        (
            "solid s\nvertex a 0 0 0\nface f a b c\nend\n",
            3,
            10,
            "found `b`",
        ),
        ("surface s\nvertex a 0 0 0\n", 3, 1, "found the end"),
        ("segment s A to A\n", 1, 11, "named before"),
    ] {
        let error = read_world::<Number>(text).unwrap_err();
        assert_eq!(
            (error.line, error.column),
            (line, column),
            "{text}: {error}"
        );
        assert!(error.message.contains(said), "{text}: {error}");
    }
}
