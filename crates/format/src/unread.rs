//! What of a file is not read, and when that is a fault.
//!
//! URDF is read by many tools, each of which adds elements and attributes of its own; ROS's parser skips what it does not
//! know. So does this reader, as long as the motion cannot depend on it: every kind of thing skipped is told once, with a
//! count. Three things are never skipped:
//!
//! - a word that is nearly one that bears on motion (`<axsi>`, `<parrent>`), since it is probably that word mistyped;
//! - a word that bears on motion at a place where it is not read (`<predecessor>` inside `<joint>`);
//! - anything that names two links in a way that looks like a joint between them, since a loop may be lost with it.

use super::element::{Attribute, Element, Owner};
use super::error::{Fault, Outcome};
use super::hints;
use super::reader::Reader;
use super::words::{alternatives, cut, quoted};
use std::collections::HashMap;
use std::ops::Range;
use strsim::osa_distance;

/// Elements that bear on how a joint moves.
pub(super) const OF_JOINTS: [&str; 13] = [
    "parent",
    "child",
    "predecessor",
    "successor",
    "origin",
    "axis",
    "axis2",
    "screw",
    "distance",
    "limit",
    "mimic",
    "joint",
    "loop",
];

/// Elements of URDF itself, and of its common extensions, that are known to say nothing about motion.
const STANDARD: [&str; 10] = [
    "material",
    "gazebo",
    "transmission",
    "ros2_control",
    "sensor",
    "safety_controller",
    "calibration",
    "visual",
    "collision",
    "inertial",
];

/// Pairs of elements or attributes by which tools name the two sides of a constraint, without underscores.
const SIDES: [(&str, &str); 9] = [
    ("site1", "site2"),
    ("parent", "child"),
    ("predecessor", "successor"),
    ("link1", "link2"),
    ("linka", "linkb"),
    ("body1", "body2"),
    ("bodya", "bodyb"),
    ("frame1", "frame2"),
    ("framea", "frameb"),
];

/// Parts of names of elements that constrain when their sides are attributes, as in MJCF's `<connect body1 body2>`.
const CONSTRAINING: [&str; 7] = [
    "joint",
    "loop",
    "constraint",
    "weld",
    "connect",
    "equality",
    "clos",
];

/// Names two links, but as a spring, an actuator or a measurement between them, which leave the motion as it is.
const COMPLIANT: [&str; 5] = [
    "force_element",
    "linear_bushing_rpy",
    "transmission",
    "sensor",
    "plugin",
];

/// A kind of thing that is not read: where the first one is, what it is, and whether it is expected in any URDF file.
pub(super) struct Unread {
    pub(super) start: usize,
    pub(super) what: String,
    pub(super) standard: bool,
    pub(super) count: usize,
}

/// Things of one kind together, in the order of the first of each.
#[derive(Default)]
pub(super) struct Tally<'a> {
    kinds: Vec<Unread>,
    by_text: HashMap<String, usize>,
    /// Elements are many; their kinds are found without making a text of each.
    by_element: HashMap<&'a str, usize>,
}

impl<'a> Tally<'a> {
    pub(super) fn element(&mut self, element: Element<'a>) {
        let name = element.written_name();
        if let Some(index) = self.by_element.get(name) {
            self.again(*index, element.start());
            return;
        }
        self.by_element.insert(name, self.kinds.len());
        self.kinds.push(Unread {
            start: element.start(),
            what: format!("<{}>", cut(name)),
            standard: STANDARD.contains(&name),
            count: 1,
        });
    }

    /// An element that any file of its format may have.
    pub(super) fn standard(&mut self, element: Element<'a>) {
        self.element(element);
        if let Some(index) = self.by_element.get(element.written_name()) {
            self.kinds[*index].standard = true;
        }
    }

    pub(super) fn text(&mut self, start: usize, what: String) {
        if let Some(index) = self.by_text.get(&what) {
            self.again(*index, start);
            return;
        }
        self.by_text.insert(what.clone(), self.kinds.len());
        self.kinds.push(Unread {
            start,
            what,
            standard: false,
            count: 1,
        });
    }

    /// The same of what any file of its format may have.
    pub(super) fn standard_text(&mut self, start: usize, what: String) {
        self.text(start, what.clone());
        if let Some(index) = self.by_text.get(&what) {
            self.kinds[*index].standard = true;
        }
    }

    fn again(&mut self, index: usize, start: usize) {
        let kind = &mut self.kinds[index];
        kind.count += 1;
        kind.start = kind.start.min(start);
    }

    /// A fault for each kind that not any URDF may have.
    pub(super) fn faults(&self, text: &str) -> Vec<Fault> {
        let unusual = self.kinds.iter().filter(|kind| !kind.standard);
        unusual
            .map(|kind| {
                let rest = text.get(kind.start..).unwrap_or_default();
                let ends = |c: char| c.is_whitespace() || matches!(c, '/' | '>' | '=');
                let length = rest.find(ends).unwrap_or(rest.len());
                let message = match kind.count {
                    1 => format!("{} is not read", kind.what),
                    count => format!(
                        "{} is not read, here and {} times more",
                        kind.what,
                        count - 1
                    ),
                };
                Fault::new(kind.start..kind.start + length, message)
                    .help("without `--strict` it is skipped and told")
            })
            .collect()
    }

    /// The same in another text: where a place of this one is there, and what is said of it.
    pub(super) fn moved(mut self, place: impl Fn(usize) -> (usize, String)) -> Self {
        for kind in &mut self.kinds {
            let (start, beside) = place(kind.start);
            kind.start = start;
            kind.what.push_str(&beside);
        }
        self
    }

    /// The kinds in file order.
    pub(super) fn kinds(mut self) -> Vec<Unread> {
        self.kinds.sort_by_key(|kind| kind.start);
        self.kinds
    }
}

/// The word of these that another one is probably a slip of: one letter wrong, missing, added, or two exchanged (two such
/// slips in words of eight letters and more), or a capital for a small letter.
pub(super) fn slip_of<'w>(word: &str, known: impl IntoIterator<Item = &'w str>) -> Option<&'w str> {
    /// No word of the format is longer by more than a slip.
    const LONGEST: usize = 24;
    if word.len() > LONGEST {
        return None;
    }
    let small = word.to_lowercase();
    let known: Vec<&str> = known.into_iter().collect();
    if known.contains(&word) {
        return None;
    }
    known.into_iter().find(|candidate| {
        let slips = if candidate.len() < 8 { 1 } else { 2 };
        osa_distance(&small, candidate) <= slips
    })
}

/// What is told of an attribute that is not known.
///
/// # Errors
/// One that is probably a slip of a word that bears on motion.
pub(super) fn unknown_attribute(
    element: Element<'_>,
    name: &str,
    range: Range<usize>,
    bearing: &[&str],
) -> Outcome<String> {
    let of = cut(element.written_name());
    match slip_of(name, bearing.iter().copied()) {
        Some(meant) => Err(
            Fault::new(range, format!("<{of}> has no attribute {}", quoted(name)))
                .help(format!("did you mean `{meant}`?")),
        ),
        None => Ok(format!("attribute {} of <{of}>", quoted(name))),
    }
}

/// The parts of an element of URDF.
pub(super) struct Parts<'k> {
    /// Read, once each unless they stand in `often`.
    pub(super) known: &'k [&'k str],
    /// Read, any number of times.
    pub(super) often: &'k [&'k str],
    /// Words that nothing else may be a slip of, or the same as where it is not among the known ones.
    pub(super) bearing: &'k [&'k str],
}

impl<'a> Reader<'a> {
    /// The parts of an element of URDF that are read; what else stands there is skipped unless it bears on motion.
    pub(super) fn parts_of(
        &mut self,
        element: Element<'a>,
        kinds: &Parts<'_>,
    ) -> Outcome<Vec<Element<'a>>> {
        let mut parts = Vec::new();
        let mut firsts: Vec<Option<Element<'a>>> = vec![None; kinds.known.len()];
        self.skip_text(element);
        for child in element.elements() {
            let foreign = self.owner(child)? != Owner::Format;
            let name = if foreign {
                child.written_name()
            } else {
                child.name()
            };
            if foreign && !kinds.known.contains(&name) {
                let foreign = kinds.known.iter().copied().filter(|k| k.contains(':'));
                if let Some(meant) = slip_of(name, foreign) {
                    let message = format!("<{}> is not known here", cut(name));
                    return Err(child
                        .fault(message)
                        .help(format!("did you mean <{meant}>?")));
                }
                self.skip_unless_joining(child)?;
                continue;
            }
            if kinds.often.contains(&name) {
                parts.push(child);
                continue;
            }
            let Some(index) = kinds.known.iter().position(|known| *known == name) else {
                self.skip_unknown(child, element, kinds)?;
                continue;
            };
            let Some(first) = firsts[index] else {
                firsts[index] = Some(child);
                parts.push(child);
                continue;
            };
            let same = first.says_the_same(&child);
            if kinds.bearing.contains(&name) && !same {
                return Err(child
                    .fault(format!(
                        "<{}> has a second <{name}>",
                        element.written_name()
                    ))
                    .help("remove one of the two"));
            } else {
                self.skip_because(child, format!("a second <{name}>"));
            }
        }
        Ok(parts)
    }

    /// Skips whatever stands inside an element of URDF that holds attributes only.
    pub(super) fn leaf_of(
        &mut self,
        element: Element<'a>,
        attributes: &[&str],
        bearing: bool,
    ) -> Outcome<()> {
        self.attributes_of(element, attributes, bearing)?;
        let nothing = Parts {
            known: &[],
            often: &[],
            bearing: &[],
        };
        self.parts_of(element, &nothing).map(|_| ())
    }

    /// Skips the attributes of an element of URDF that are not known; where it bears on motion, none may be a slip of a
    /// known one.
    pub(super) fn attributes_of(
        &mut self,
        element: Element<'a>,
        known: &[&str],
        bearing: bool,
    ) -> Outcome<()> {
        // Rates and forces say nothing about where a joint can go.
        let moving = known.iter().copied().filter(|word| {
            !["velocity", "effort", "damping", "friction", "version"].contains(word)
        });
        for (name, range) in element.other_attributes(known) {
            if let Some(meant) = slip_of(name, moving.clone()).filter(|_| bearing) {
                let message = format!(
                    "<{}> has no attribute {}; it has {}",
                    element.written_name(),
                    quoted(name),
                    alternatives(known)
                );
                return Err(Fault::new(range, message).help(format!("did you mean `{meant}`?")));
            }
            let start = range.start;
            let what = unknown_attribute(element, name, range, &[])?;
            self.unread.text(start, what);
        }
        Ok(())
    }

    /// Skips an unknown child of an element of URDF, or tells why it must not be.
    pub(super) fn skip_unknown(
        &mut self,
        child: Element<'a>,
        parent: Element<'a>,
        kinds: &Parts<'_>,
    ) -> Outcome<()> {
        let name = child.name();
        let known = || kinds.known.iter().chain(kinds.often).copied();
        if STANDARD.contains(&name) {
            return self.skip_unless_joining(child);
        }
        let misplaced = kinds.bearing.contains(&name);
        let slip = slip_of(name, kinds.bearing.iter().copied());
        if misplaced || slip.is_some() {
            let words: Vec<&str> = known().collect();
            let message = format!(
                "<{}> is not known inside <{}>; it has {}",
                cut(child.written_name()),
                cut(parent.written_name()),
                alternatives(&words)
            );
            let help = slip.filter(|slip| words.contains(slip));
            return Err(child
                .fault(message)
                .maybe_help(help.map(|meant| format!("did you mean <{meant}>?")))
                .maybe_help(hints::side_of_joint(name, parent.name())));
        }
        self.skip_unless_joining(child)
    }

    /// Skips an element, unless it or something inside it looks like a joint that is not read.
    pub(super) fn skip_unless_joining(&mut self, element: Element<'a>) -> Outcome<()> {
        self.check_for_joints(element)?;
        self.unread.element(element);
        Ok(())
    }

    /// Nothing inside an element that is skipped may join two links.
    pub(super) fn check_for_joints(&mut self, element: Element<'a>) -> Outcome<()> {
        self.set_aside.push(element);
        let mut open = vec![element];
        while let Some(next) = open.pop() {
            if COMPLIANT.contains(&next.name()) || self.taken.contains(&next.start()) {
                continue;
            }
            if let Some(body) = held_in_the_world(next) {
                return Err(body
                    .fault(format!(
                        "<{}> holds this in the world, and how is not known",
                        cut(next.written_name())
                    ))
                    .help("write it as a <loop> to the root link, or remove it"));
            }
            if let Some((first, second)) = sides_of(next) {
                return Err(next
                    .fault(format!(
                        "<{}> joins two links (`{first}` and `{second}`), and how it constrains them is not known",
                        cut(next.written_name())
                    ))
                    .help("write it as a <loop>, or remove it: a loop that is not read changes the answer"));
            }
            open.extend(next.elements());
        }
        Ok(())
    }

    /// Notes text between elements, which URDF gives no meaning.
    pub(super) fn skip_text(&mut self, element: Element<'a>) {
        if let Some(start) = element.stray_text() {
            let what = format!("text inside <{}>", cut(element.written_name()));
            self.unread.text(start, what);
        }
    }

    /// Whose an element is; one of xacro's, which must be expanded, is a fault.
    pub(super) fn owner(&self, element: Element<'a>) -> Outcome<Owner> {
        match element.owner(self.root_namespace) {
            Owner::Xacro => Err(element
                .fault(format!("<{}> is not evaluated here", element.written_name()))
                .help("definitions stand directly inside <robot>; expand other xacro elements with xacro first")),
            owner => Ok(owner),
        }
    }
}

/// The body that one of MuJoCo's equalities holds in the world, the other body being left out.
fn held_in_the_world(element: Element<'_>) -> Option<Attribute<'_>> {
    let holds = matches!(element.name(), "connect" | "weld");
    let body = element.attribute("body1").filter(|_| holds)?;
    element.attribute("body2").is_none().then_some(body)
}

/// The two words by which an element names the two links that it joins; `None` where it joins none.
fn sides_of(element: Element<'_>) -> Option<(&'static str, &'static str)> {
    let plain = |name: &str| name.replace('_', "").to_lowercase();
    let parts: Vec<String> = element.elements().map(|part| plain(part.name())).collect();
    let name = element.name().to_lowercase();
    let constrains = CONSTRAINING.iter().any(|part| name.contains(part));
    let attributes: Vec<String> = if constrains {
        element
            .other_attributes(&[])
            .map(|(name, _)| plain(name))
            .collect()
    } else {
        Vec::new()
    };
    SIDES.into_iter().find(|(first, second)| {
        let has = |words: &[String]| {
            words.iter().any(|word| word == first) && words.iter().any(|word| word == second)
        };
        has(&parts) || has(&attributes)
    })
}

/// `true` or `false` in any capitals, also `1` and `0` as XML Schema allows.
pub(super) fn truth(attribute: Attribute<'_>) -> Outcome<bool> {
    match attribute.value.trim().to_ascii_lowercase().as_str() {
        "true" | "1" => Ok(true),
        "false" | "0" => Ok(false),
        _ => Err(attribute.fault(format!(
            "needed true or false, found {}",
            quoted(attribute.value)
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_is_near_and_another_word_is_not() {
        for (word, meant) in [
            ("axsi", "axis"),
            ("parrent", "parent"),
            ("orgin", "origin"),
            ("mimc", "mimic"),
            ("jiont", "joint"),
            ("lop", "loop"),
            ("Axis", "axis"),
            ("predecesor", "predecessor"),
        ] {
            assert_eq!(slip_of(word, OF_JOINTS), Some(meant), "{word}");
        }
        for word in [
            "frame", "contact", "spring", "velocity", "gear", "pose", "axis",
        ] {
            assert_eq!(slip_of(word, OF_JOINTS), None, "{word}");
        }
    }
}
