//! A planar sketch: `<sketch>` instead of `<robot>`.

use super::element::{Attribute, Element, Owner};
use super::error::{Fault, FormatError, MOST_FAULTS, Outcome, located};
use super::reader::Reader;
use super::words::{did_you_mean, quoted};
use super::{bytes_of, guard, xml};
use kutzbach_constructive::named::{Circle, NamedSketch};
use kutzbach_constructive::relation::Relation;
use kutzbach_constructive::sketch::{Constraint, Sketch, SketchError};
use kutzbach_constructive::{graph::GraphError, sketch};
use kutzbach_math::number::Number;
use lengths::Lengths;
use std::collections::HashMap;
use std::path::Path;

mod circles;
mod lengths;
mod several;

/// Whether a text is a sketch rather than a mechanism: its first element is `<sketch>`. What is no XML is none.
#[must_use]
pub fn is_sketch(text: &str) -> bool {
    xml::parse(text).is_ok_and(|document| document.root_element().has_tag_name("sketch"))
}

/// Reads a sketch; `file` names the text in errors, `settings` are as for [`read`](crate::read).
///
/// # Errors
/// Up to twenty faults of the text, each with its place: XML, unknown elements, attributes and names, numbers that are none, and
/// whatever [`SketchError`] knows.
pub fn read_sketch(
    text: &str,
    file: &str,
    settings: &[(String, String)],
) -> Result<NamedSketch, FormatError> {
    read(text, settings).map_err(|faults| located(file, text, faults))
}

/// Reads a sketch from a file.
///
/// # Errors
/// As [`read_sketch`]; also a file that cannot be read.
pub fn read_sketch_file(
    path: impl AsRef<Path>,
    settings: &[(String, String)],
) -> Result<NamedSketch, FormatError> {
    let path = path.as_ref();
    let file = path.display().to_string();
    let bytes = bytes_of(path).map_err(|fault| located(&file, "", vec![fault]))?;
    let text = guard::text_of(&bytes);
    match text {
        Ok(text) => read_sketch(text, &file, settings),
        Err((valid, fault)) => Err(located(&file, valid, vec![fault])),
    }
}

/// What is read when all lengths are known, and directions after that.
const LATE: [&str; 5] = ["tangent", "midpoint", "symmetric", "horizontal", "vertical"];

/// What was read so far, with the elements of the file for later faults.
#[derive(Default)]
struct Parts<'a> {
    names: Vec<String>,
    by_name: HashMap<&'a str, usize>,
    elements: Vec<sketch::Element>,
    drawn_at: Vec<Element<'a>>,
    constraints: Vec<Constraint>,
    stated_at: Vec<Element<'a>>,
    relations: Vec<Relation>,
    circles: Vec<circles::Drawn<'a>>,
    lengths: Lengths<'a>,
    /// The first line that is said to be horizontal or vertical, and in how many quarter turns: others are told against it.
    level: Option<(usize, i32)>,
}

fn read(text: &str, settings: &[(String, String)]) -> Result<NamedSketch, Vec<Fault>> {
    let one = |fault| vec![fault];
    let document = xml::parse(text).map_err(one)?;
    let root = Element::root(&document, text);
    if root.name() != "sketch" {
        let message = format!("needed <sketch>, found <{}>", root.written_name());
        return Err(one(root
            .fault(message)
            .help("a sketch is one <sketch name=\"...\"> element")));
    }
    root.only_attributes(&["name"]).map_err(one)?;
    let children = root.children().map_err(one)?;
    let mut reader = Reader::new(root);
    reader.definitions.read(root, &children, settings, &[])?;
    let mut parts = Parts::default();
    // Constraints may stand before what they name, and circles before their centres.
    let (drawn, stated): (Vec<Element<'_>>, Vec<Element<'_>>) = children
        .into_iter()
        .filter(|c| c.owner(root.namespace()) == Owner::Format)
        .partition(|c| ["point", "line", "circle"].contains(&c.name()));
    let (circles, drawn): (Vec<_>, Vec<_>) = drawn.into_iter().partition(|c| c.name() == "circle");
    let mut faults: Vec<Fault> = Vec::new();
    for child in drawn.into_iter().chain(circles) {
        faults.extend(parts.draw(&mut reader, child).err());
    }
    // How large circles are is looked for when all lengths are known, lines through points when it is known which lie on which.
    let first = stated.iter().filter(|c| !LATE.contains(&c.name()));
    let first: Vec<_> = first.copied().collect();
    for child in first {
        faults.extend(parts.state(&mut reader, child).err());
    }
    faults.extend(parts.share_lengths());
    for late in [&LATE[..3], &LATE[3..]] {
        for child in stated.iter().filter(|c| late.contains(&c.name())) {
            faults.extend(parts.state(&mut reader, *child).err());
        }
    }
    if !faults.is_empty() {
        faults.truncate(MOST_FAULTS);
        return Err(faults);
    }
    parts.finish(root).map_err(one)
}

impl<'a> Parts<'a> {
    /// A point, a line or a circle.
    fn draw(&mut self, reader: &mut Reader<'a>, element: Element<'a>) -> Outcome<()> {
        if element.name() == "circle" {
            return self.draw_circle(reader, element);
        }
        let mut pair = |name: &str| -> Outcome<[f64; 2]> {
            let numbers: [Number; 2] = reader.numbers(element.required(name)?)?;
            Ok(numbers.map(|n| n.value()))
        };
        let drawn = if element.name() == "point" {
            element.only_attributes(&["name", "xy"])?;
            sketch::Element::Point(pair("xy")?)
        } else {
            element.only_attributes(&["name", "through", "direction"])?;
            let (through, direction) = (pair("through")?, pair("direction")?);
            sketch::Element::Line { through, direction }
        };
        let name = self.new_name(element)?;
        self.by_name.insert(name.value, self.names.len());
        self.names.push(name.value.to_owned());
        self.elements.push(drawn);
        self.drawn_at.push(element);
        Ok(())
    }

    /// The name of an element that is drawn.
    fn new_name(&self, element: Element<'a>) -> Outcome<Attribute<'a>> {
        let name = element.required("name")?;
        match self.by_name.contains_key(name.value) || self.circle(name.value).is_some() {
            true => {
                let message = format!("two elements are named {}", quoted(name.value));
                Err(name.fault(message))
            }
            false => Ok(name),
        }
    }

    /// A distance, an angle, an incidence, or a direction that some angle says.
    fn state(&mut self, reader: &mut Reader<'a>, element: Element<'a>) -> Outcome<()> {
        const KNOWN: [&str; 15] = [
            "point",
            "line",
            "circle",
            "radius",
            "tangent",
            "equal",
            "midpoint",
            "symmetric",
            "distance",
            "angle",
            "incidence",
            "parallel",
            "perpendicular",
            "horizontal",
            "vertical",
        ];
        match element.name() {
            "parallel" => return self.turned(element, 0),
            "perpendicular" => return self.turned(element, 1),
            "horizontal" => return self.levelled(element, 0),
            "vertical" => return self.levelled(element, 1),
            "radius" => return self.radius(reader, element),
            "equal" => return self.equal(element),
            "tangent" => return self.tangent(element),
            "midpoint" => return self.midpoint(element),
            "symmetric" => return self.symmetric(element),
            "incidence" if self.names_a_circle(element) => return self.on_circle(element),
            _ => {}
        }
        let ends = match element.name() {
            "distance" | "angle" => {
                element.only_attributes(&["between", "value"])?;
                self.ends(element)?
            }
            "incidence" => {
                element.only_attributes(&["between"])?;
                self.ends(element)?
            }
            name => {
                let message = format!("a <sketch> has no <{}>", element.written_name());
                return Err(element.fault(message).maybe_help(did_you_mean(
                    name,
                    KNOWN,
                    ("<", ">"),
                )));
            }
        };
        let lines = ends
            .iter()
            .filter(|&&e| matches!(self.elements[e], sketch::Element::Line { .. }))
            .count();
        let needed = match (element.name(), lines) {
            ("angle", 2) | ("distance", 0 | 1) | ("incidence", 1) => None,
            ("angle", _) => Some("an angle is between two lines"),
            ("distance", _) => Some("a distance is between two points, or a point and a line"),
            _ => Some("an incidence is between a point and a line"),
        };
        if let Some(needed) = needed {
            return Err(element.required("between")?.fault(needed));
        }
        let value = match element.name() {
            "incidence" => Number::zero(),
            _ => reader.number(element.required("value")?)?,
        };
        self.push(element, ends, value);
        Ok(())
    }

    /// Two lines that are parallel, or across each other; which way each points, the drawing says.
    fn turned(&mut self, element: Element<'a>, quarters: i32) -> Outcome<()> {
        element.only_attributes(&["between"])?;
        let ends = self.ends(element)?;
        if ends.iter().any(|&e| self.direction(e).is_none()) {
            let needed = format!("{} is said of two lines", element.name());
            return Err(element.required("between")?.fault(needed));
        }
        self.angle(element, ends, quarters)
    }

    /// A line, or two points whose line, is horizontal or vertical. The first of them says how the whole is turned, which is no constraint.
    fn levelled(&mut self, element: Element<'a>, quarters: i32) -> Outcome<()> {
        element.only_attributes(&["of"])?;
        let of = element.required("of")?;
        let names: Vec<&str> = of.value.split_ascii_whitespace().collect();
        let found = names.iter().map(|name| self.find(&of, name));
        let found = found.collect::<Outcome<Vec<usize>>>()?;
        let line = match found[..] {
            [line] if self.direction(line).is_some() => line,
            [p, q] => match (self.elements[p], self.elements[q]) {
                (sketch::Element::Point(from), sketch::Element::Point(to)) => {
                    self.line_through(element, [p, q], from, to)
                }
                _ => return Err(of.fault("needed a line, or two points")),
            },
            _ => return Err(of.fault("needed a line, or two points")),
        };
        match self.level {
            None => self.level = Some((line, quarters)),
            Some((first, _)) if first == line => {
                return Err(of.fault("this was said of the same line before"));
            }
            Some((first, own)) => return self.angle(element, [first, line], quarters - own),
        }
        Ok(())
    }

    /// The line through two points: one that both are said to lie on, otherwise one that the file does not draw.
    fn line_through(
        &mut self,
        element: Element<'a>,
        ends: [usize; 2],
        from: [f64; 2],
        to: [f64; 2],
    ) -> usize {
        let on = |point: usize| {
            let incident = self.constraints.iter().filter(|c| c.value.is_zero());
            let others = incident.filter_map(move |c| match c.ends {
                [u, v] if u == point => Some(v),
                [u, v] if v == point => Some(u),
                _ => None,
            });
            others.collect::<Vec<usize>>()
        };
        let lines = on(ends[1]);
        if let Some(line) = on(ends[0]).into_iter().find(|line| lines.contains(line)) {
            return line;
        }
        let line = self.elements.len();
        let direction = [to[0] - from[0], to[1] - from[1]];
        self.elements.push(sketch::Element::Line {
            through: from,
            direction,
        });
        let [p, q] = ends.map(|e| &self.names[e]);
        self.names.push(format!("{p}–{q}"));
        self.drawn_at.push(element);
        for point in ends {
            self.push(element, [point, line], Number::zero());
        }
        line
    }

    /// An angle of so many quarter turns, and half a turn more where that is nearer to how the lines are drawn.
    fn angle(&mut self, element: Element<'a>, ends: [usize; 2], quarters: i32) -> Outcome<()> {
        let quarter = std::f64::consts::FRAC_PI_2;
        let [from, to] = ends.map(|e| self.direction(e).unwrap_or([1.0, 0.0]));
        let drawn = to[1].atan2(to[0]) - from[1].atan2(from[0]);
        let off = drawn - f64::from(quarters) * quarter;
        let quarters = quarters + if off.cos() < 0.0 { 2 } else { 0 };
        // The same angle within a turn, −π excluded.
        let quarters = (quarters + 1).rem_euclid(4) - 1;
        let turn = Number::pi() * Number::integer(i64::from(quarters));
        let value = turn.checked_div(&Number::integer(2));
        let value = value.map_err(|error| element.fault(error.to_string()))?;
        self.push(element, ends, value);
        Ok(())
    }

    fn push(&mut self, element: Element<'a>, ends: [usize; 2], value: Number) {
        self.constraints.push(Constraint { ends, value });
        self.stated_at.push(element);
    }

    fn direction(&self, element: usize) -> Option<[f64; 2]> {
        match self.elements[element] {
            sketch::Element::Line { direction, .. } => Some(direction),
            sketch::Element::Point(_) => None,
        }
    }

    /// The element of a name.
    fn find(&self, at: &Attribute<'a>, name: &str) -> Outcome<usize> {
        if let Some(circle) = self.circle(name) {
            let centre = &self.names[self.circles[circle].centre];
            let message = format!("{} is a circle, needed a point or line", quoted(name));
            let help = format!("its center is {}", quoted(centre));
            return Err(at.fault(message).help(help));
        }
        self.by_name.get(name).copied().ok_or_else(|| {
            let known = self.names.iter().map(String::as_str);
            at.fault(format!("no point or line is named {}", quoted(name)))
                .maybe_help(did_you_mean(name, known, ("`", "`")))
        })
    }

    /// The two elements that a constraint names.
    fn ends(&self, element: Element<'a>) -> Outcome<[usize; 2]> {
        let between = element.required("between")?;
        let names: Vec<&str> = between.value.split_ascii_whitespace().collect();
        let [one, other] = names[..] else {
            let message = format!("needed two names, found {}", names.len());
            return Err(between.fault(message).help("between=\"a b\""));
        };
        Ok([self.find(&between, one)?, self.find(&between, other)?])
    }

    fn finish(self, root: Element<'_>) -> Outcome<NamedSketch> {
        let Self {
            names,
            elements,
            drawn_at,
            constraints,
            stated_at,
            relations,
            circles,
            lengths,
            ..
        } = self;
        let wrong = |why: SketchError| placed(&why, root, &drawn_at, &stated_at);
        let sketch = Sketch::new(elements, constraints).map_err(wrong)?;
        let sketch = sketch
            .with_relations(relations, lengths.unknown())
            .map_err(wrong)?
            .of_figures();
        let name = root.attribute("name").map_or("unnamed", |name| name.value);
        let mut named = NamedSketch::new(name.to_owned(), names, sketch);
        let circle = |(i, drawn): (usize, &circles::Drawn<'_>)| Circle {
            name: drawn.name.to_owned(),
            centre: drawn.centre,
            radius: lengths.radius(i),
        };
        named.circles = circles.iter().enumerate().map(circle).collect();
        named.without_what_follows().map_err(wrong)
    }
}

/// What is wrong with a sketch, in the words of the file and at its place.
fn placed(
    why: &SketchError,
    root: Element<'_>,
    drawn: &[Element<'_>],
    stated: &[Element<'_>],
) -> Fault {
    let stated = |i: usize, message: &str| {
        let named = ["between", "of", "point"]
            .iter()
            .find_map(|name| stated[i].attribute(name));
        let between = named.map_or("", |names| names.value);
        stated[i].fault(format!("{message} (`{between}`)"))
    };
    match *why {
        SketchError::Place(i) if drawn[i].name() == "line" => {
            drawn[i].fault("the direction of a line cannot be zero")
        }
        SketchError::Place(i) => drawn[i].fault("two points drawn at one place have no line"),
        SketchError::ZeroLength(i) => stated(i, "two points at distance zero are one point")
            .help("draw one point, or leave the constraint out"),
        SketchError::Negative(i) => stated(i, "the distance of two points is above zero"),
        SketchError::Doubled { second, .. } => {
            stated(second, "this was said of the same two elements before")
        }
        SketchError::Contradictory { second, .. } => stated(
            second,
            "another value was stated for the same two elements before",
        ),
        SketchError::Graph(GraphError::Loop { edge, .. }) => {
            stated(edge, "a constraint is between two different elements")
        }
        SketchError::Graph(GraphError::TooSmall(count)) => root.fault(format!(
            "a sketch has two points or lines at least, this one has {count}"
        )),
        ref other => root.fault(other.to_string()),
    }
}
