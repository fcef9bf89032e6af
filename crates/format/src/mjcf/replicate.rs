//! `<replicate count offset euler sep>`: copies of what is inside, written out before anything is read.
//!
//! Copy i is a `<frame>` that is moved and turned i times as far, and every name in it ends with `sep` and i, padded to the digits of the count; where
//! replicates are nested, the inner one's comes first. What in `<equality>`, `<tendon>` and `<actuator>` names something by the name that it
//! has inside is written once for each copy, with the names of that copy. So much is what MuJoCo's compiler makes of such files.

use super::copies::{COPY, Step, zeros};
use super::include::{Piece, Whole};
use super::pose::{Compiler, exactly};
use crate::element::{Attribute, Element};
use crate::error::{FormatError, Outcome};
use crate::words::quoted;
use crate::writer::escaped;
use crate::{guard, xml};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::Frame;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::rc::Rc;

/// Copies in all, at most.
const MOST_COPIES: f64 = 100_000.0;

/// What is added to a name, in bytes at most: replicates nested without end would fill the memory.
const LONGEST_END: usize = 1000;

/// What stands directly in a replicate belongs to the body around it, and cannot be there twice.
const OF_BODIES: [&str; 3] = ["joint", "freejoint", "inertial"];

/// What names stand for; each sort has names of its own.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Sort {
    Body,
    Joint,
    Site,
    Tendon,
}

/// Attributes by which elements outside the bodies name something.
pub(super) const REFERENCES: [(&str, Sort); 11] = [
    ("body1", Sort::Body),
    ("body2", Sort::Body),
    ("joint1", Sort::Joint),
    ("joint2", Sort::Joint),
    ("joint", Sort::Joint),
    ("jointinparent", Sort::Joint),
    ("site1", Sort::Site),
    ("site2", Sort::Site),
    ("tendon1", Sort::Tendon),
    ("tendon2", Sort::Tendon),
    ("tendon", Sort::Tendon),
];

/// One of several copies of a stretch of the text.
struct OneCopy {
    /// What stands before and after it.
    open: String,
    close: &'static str,
    /// What its names end with.
    suffix: String,
}

/// Something to be done at a place of the text.
enum Mark {
    /// A name ends here: that of the copy is longer.
    Name,
    /// Instead of the whole, copies of the inner stretch.
    Repeat {
        whole: Range<usize>,
        inner: Range<usize>,
        copies: Vec<OneCopy>,
    },
}

/// What is to be done, by place.
#[derive(Default)]
struct Plan<'a> {
    marks: Vec<(usize, Mark)>,
    /// The ends of the copies of what has a name inside a replicate.
    copied: BTreeMap<(Sort, &'a str), Rc<Vec<String>>>,
    /// What has a name elsewhere.
    plain: BTreeSet<(Sort, &'a str)>,
    copies: f64,
}

/// An element of the tree, and the ends of the names of its copies.
struct Open<'a> {
    element: Element<'a>,
    ends: Option<Rc<Vec<String>>>,
}

/// A text with its copies written out.
///
/// # Errors
/// Replicates that cannot be read, more copies than are made, and equalities of which one end is inside a replicate.
pub(super) fn replicated(whole: Whole) -> Result<Whole, FormatError> {
    if !whole.text.contains("<replicate") {
        return Ok(whole);
    }
    match written_out(&whole) {
        Ok((text, pieces)) => Ok(whole.rewritten(text, pieces)),
        Err(fault) => Err(whole.located(vec![fault])),
    }
}

fn written_out(whole: &Whole) -> Outcome<(String, Vec<Piece>)> {
    let document = xml::parse(&whole.text)?;
    let root = Element::root(&document, &whole.text);
    let sections = |name: &'static str| root.elements().filter(move |e| e.name() == name);
    let mut compiler = Compiler::default();
    for section in sections("compiler") {
        compiler.take_angles(section)?;
    }
    let mut plan = Plan::default();
    for section in sections("worldbody") {
        plan.bodies(section, &compiler)?;
    }
    // Equalities and actuators may name tendons.
    for name in ["tendon", "equality", "actuator"] {
        for section in sections(name) {
            for part in section.elements() {
                plan.part(part)?;
            }
        }
    }
    plan.marks.sort_by_key(|(at, _)| *at);
    let mut writing = Writing {
        whole,
        text: String::new(),
        pieces: Vec::new(),
    };
    writing.all(&plan.marks)?;
    Ok((writing.text, writing.pieces))
}

/// The range of an element with everything in it.
pub(super) fn stretch(element: Element<'_>) -> Range<usize> {
    element.start()..element.start() + element.written().len()
}

impl<'a> Plan<'a> {
    fn bodies(&mut self, world: Element<'a>, compiler: &Compiler) -> Outcome<()> {
        let mut open = vec![Open {
            element: world,
            ends: None,
        }];
        while let Some(Open { element, ends }) = open.pop() {
            let ends = match element.name() {
                "replicate" => Some(self.replicate(element, ends.as_deref(), compiler)?),
                name => {
                    let sort = match name {
                        "body" => Some(Sort::Body),
                        "joint" | "freejoint" => Some(Sort::Joint),
                        "site" => Some(Sort::Site),
                        _ => None,
                    };
                    self.named(element, sort, ends.as_ref());
                    ends
                }
            };
            open.extend(element.elements().map(|element| Open {
                element,
                ends: ends.clone(),
            }));
        }
        Ok(())
    }

    /// Notes the name of an element of a sort that others name, and that it becomes longer in copies.
    fn named(&mut self, element: Element<'a>, sort: Option<Sort>, ends: Option<&Rc<Vec<String>>>) {
        let Some(name) = element.attribute("name") else {
            return;
        };
        let key = sort.map(|sort| (sort, name.value));
        let Some(ends) = ends else {
            self.plain.extend(key);
            return;
        };
        self.marks.push((name.range().end, Mark::Name));
        if let Some(key) = key {
            // Two replicates that differ by `sep` may use one name.
            self.copied
                .entry(key)
                .and_modify(|known| Rc::make_mut(known).extend(ends.iter().cloned()))
                .or_insert_with(|| Rc::clone(ends));
        }
    }

    /// Counts copies that are to be made; what is wrong where they are too many.
    fn count(&mut self, more: f64) -> Result<(), String> {
        if self.copies + more > MOST_COPIES {
            return Err(format!("more than {MOST_COPIES} copies are made in all"));
        }
        self.copies += more;
        Ok(())
    }

    /// Plans the copies of a replicate; what the names of their parts end with, within the copies of the replicates around it.
    fn replicate(
        &mut self,
        element: Element<'a>,
        around: Option<&Vec<String>>,
        compiler: &Compiler,
    ) -> Outcome<Rc<Vec<String>>> {
        if let Some(part) = element.elements().find(|e| OF_BODIES.contains(&e.name())) {
            return Err(part
                .fault(format!(
                    "<{}> cannot stand directly in <replicate>",
                    part.name()
                ))
                .help("it belongs into a <body>"));
        }
        let says = element.required("count")?;
        let [count]: [Number; 1] = exactly(says)?;
        let count = count.value();
        if !(count >= 0.0 && count.fract() == 0.0) {
            return Err(says.fault("needed how many copies are made"));
        }
        let times = around.map_or(1, Vec::len);
        self.count(count * times.max(1) as f64)
            .map_err(|message| says.fault(message))?;
        // At most MOST_COPIES, and whole.
        let count = count as usize;
        let own = element.attribute("sep").map_or("", |sep| sep.value);
        let digits = count.to_string().len();
        let outer = around
            .and_then(|around| around.first())
            .map_or(0, String::len);
        if outer + own.len() + digits > LONGEST_END {
            let message = format!("names of copies become longer by more than {LONGEST_END} bytes");
            return Err(element.fault(message));
        }
        let suffixes: Vec<String> = (0..count)
            .map(|index| format!("{own}{index:0digits$}"))
            .collect();
        let frames = frames(element, count, compiler)?;
        let copies = suffixes.iter().zip(frames).map(|(suffix, open)| OneCopy {
            open,
            close: "</frame>",
            suffix: suffix.clone(),
        });
        let first = element.elements().next().map_or(0, |part| part.start());
        let last = element
            .elements()
            .last()
            .map_or(0, |part| stretch(part).end);
        let repeat = Mark::Repeat {
            whole: stretch(element),
            inner: first..last,
            copies: copies.collect(),
        };
        self.marks.push((element.start(), repeat));
        let none = vec![String::new()];
        let around = around.unwrap_or(&none);
        let ends = around
            .iter()
            .flat_map(|outer| suffixes.iter().map(move |inner| format!("{inner}{outer}")));
        Ok(Rc::new(ends.collect()))
    }

    /// Plans the copies of an element outside the bodies that names something inside a replicate.
    fn part(&mut self, part: Element<'a>) -> Outcome<()> {
        let is_tendon = matches!(part.name(), "fixed" | "spatial");
        let sort = is_tendon.then_some(Sort::Tendon);
        let inner = part.elements().filter(|inner| inner.name() == "joint");
        let all = std::iter::once(part).chain(inner);
        let references: Vec<(Sort, Attribute<'a>)> = all
            .flat_map(|element| {
                let of = REFERENCES.into_iter();
                of.filter_map(move |(name, sort)| Some((sort, element.attribute(name)?)))
            })
            // There is one world.
            .filter(|(sort, name)| !(*sort == Sort::Body && name.value == super::WORLD))
            .collect();
        let ends_of = |(sort, name): &(Sort, Attribute<'a>)| {
            let key = (*sort, name.value);
            let copied = self.copied.get(&key);
            copied.filter(|_| !self.plain.contains(&key)).cloned()
        };
        let Some(ends) = references.iter().find_map(ends_of) else {
            self.named(part, sort, None);
            return Ok(());
        };
        let is_other =
            |reference: &&(Sort, Attribute<'a>)| ends_of(reference).is_none_or(|own| own != ends);
        if let Some(other) = references.iter().find(is_other) {
            let (_, name) = other;
            let (own, part) = (quoted(name.value), part.name());
            let message = match ends_of(other) {
                Some(_) => format!("{own} is in other copies than what <{part}> names beside it"),
                None => format!(
                    "{own} is in no <replicate>, and what <{part}> names beside it is in one"
                ),
            };
            return Err(name
                .fault(message)
                .help("write one of each pair, by the names of the copies: name, sep and index"));
        }
        self.count(ends.len() as f64)
            .map_err(|message| part.fault(message))?;
        let marks = references.iter().map(|(_, name)| name.range().end);
        let marks: Vec<usize> = marks.collect();
        self.marks
            .extend(marks.into_iter().map(|at| (at, Mark::Name)));
        let copies = ends.iter().map(|suffix| OneCopy {
            open: String::new(),
            close: "",
            suffix: suffix.clone(),
        });
        let repeat = Mark::Repeat {
            whole: stretch(part),
            inner: stretch(part),
            copies: copies.collect(),
        };
        self.marks.push((part.start(), repeat));
        self.named(part, sort, Some(&ends));
        Ok(())
    }
}

/// The frames of copies, as elements that are open, which the reader [works out](super::copies). MuJoCo turns copy i by i times each angle of `euler`,
/// which of several angles is not the turn done i times, and moves it from the one before by the offset as that one is turned. Where copies are moved
/// along the axis that they are turned about, or not turned, that is a multiple too; elsewhere it is summed up here.
fn frames(element: Element<'_>, count: usize, compiler: &Compiler) -> Outcome<Vec<String>> {
    let step = Step::of(element)?;
    let is_along = step.is_along(compiler);
    let said = |name: &str| {
        let says = element.attribute(name);
        says.map_or_else(String::new, |says| {
            format!(" {name}=\"{}\"", escaped(says.value))
        })
    };
    let said = said("offset") + &said("euler") + &said("childclass");
    let mut at = [0.0; 3];
    let mut found = Vec::with_capacity(count);
    for index in 0..count {
        let mut open = format!("<frame {COPY}=\"{index}\"{said}");
        if !is_along {
            let [x, y, z] = at.map(|part| format!("{part:.15}"));
            open += &format!(" pos=\"{x} {y} {z}\"");
            let turned = Frame {
                position: step.offset.clone(),
                roll_pitch_yaw: step.turn(index, compiler).unwrap_or_else(zeros),
            };
            let offset = step.offset.each_ref().map(Number::value);
            let moved = turned.to_doubles().rotate(&offset);
            at = [0, 1, 2].map(|i| at[i] + moved[i]);
        }
        found.push(open + ">");
    }
    Ok(found)
}

/// The text that is made, and where its parts are from.
struct Writing<'w> {
    whole: &'w Whole,
    text: String,
    pieces: Vec<Piece>,
}

/// What is still to be written, the next one last.
enum Task {
    /// A stretch of the text with its marks from one on, in a copy.
    Stretch {
        range: Range<usize>,
        from: usize,
        suffix: Rc<str>,
    },
    /// Something new that belongs to a place of the text.
    New(String, usize),
}

impl Writing<'_> {
    fn all(&mut self, marks: &[(usize, Mark)]) -> Outcome<()> {
        let mut open = vec![Task::Stretch {
            range: 0..self.whole.text.len(),
            from: 0,
            suffix: Rc::from(""),
        }];
        while let Some(task) = open.pop() {
            match task {
                Task::New(text, at) => self.insert(&text, at),
                Task::Stretch {
                    range,
                    from,
                    suffix,
                } => self.stretch(marks, (range, from), &suffix, &mut open),
            }
            if let Some(fault) = guard::size_fault(self.text.len() as u64) {
                return Err(fault);
            }
        }
        Ok(())
    }

    /// Writes a stretch up to what is repeated in it, and leaves the copies and the rest open.
    fn stretch(
        &mut self,
        marks: &[(usize, Mark)],
        (range, from): (Range<usize>, usize),
        suffix: &Rc<str>,
        open: &mut Vec<Task>,
    ) {
        let mut at = range.start;
        for (index, (start, mark)) in marks.iter().enumerate().skip(from) {
            if *start >= range.end {
                break;
            }
            self.copy(at..*start);
            at = *start;
            let (whole, inner, copies) = match mark {
                Mark::Name => {
                    let ending = escaped(suffix).replace('\'', "&apos;");
                    self.insert(&ending, at);
                    continue;
                }
                Mark::Repeat {
                    whole,
                    inner,
                    copies,
                } => (whole, inner, copies),
            };
            open.push(Task::Stretch {
                range: whole.end..range.end,
                from: marks.partition_point(|(start, _)| *start < whole.end),
                suffix: Rc::clone(suffix),
            });
            for copy in copies.iter().rev() {
                open.push(Task::New(copy.close.to_owned(), at));
                open.push(Task::Stretch {
                    range: inner.clone(),
                    from: index + 1,
                    suffix: Rc::from(format!("{}{suffix}", copy.suffix)),
                });
                open.push(Task::New(copy.open.clone(), at));
            }
            return;
        }
        self.copy(at..range.end);
    }

    fn copy(&mut self, range: Range<usize>) {
        let whole = self.whole;
        let mut at = range.start;
        while at < range.end {
            let next = whole.next_piece(at).unwrap_or(range.end);
            let end = next.min(range.end);
            let text = whole.text.get(at..end).unwrap_or_default();
            self.insert(text, at);
            at = end;
        }
    }

    /// Writes something that belongs to a place of the text.
    fn insert(&mut self, text: &str, at: usize) {
        if !text.is_empty() {
            self.pieces.extend(self.whole.piece_of(at, self.text.len()));
            self.text.push_str(text);
        }
    }
}
