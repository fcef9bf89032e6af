//! A robot in two files: its URDF, and beside it YAML that says which frames meet. Written so by Gepetto's library of parallel robots
//! (example-parallel-robots, arXiv 2504.04767).
//!
//! | YAML | here |
//! |---|---|
//! | `closed_loop: [[one, other], …]` | loops between two frames: a link's, or by the name of a joint that of the link which it moves |
//! | `type: [6d, 3d, …]` | what each loop is: fixed, spherical |
//! | `joint_name: [a, …]`, `joint_type: [SPHERICAL, …]` | joints of the URDF that are of another kind: spherical, fixed, universal (`UJOINT_XY` turns about x and then about y) |
//! | `name_mot: [a, …]` | motors; a single word stands for all joints whose names it is part of |
//!
//! The URDF is read as always; loops need not be closed as drawn. What cannot be found is a fault in the YAML.

mod yaml;

use super::error::{Fault, FormatError, Outcome, lines_and_columns, located};
use super::names::unused;
use super::reader::Added;
use super::words::{alternatives, did_you_mean, quoted};
use super::{
    ReadOptions, Reading, Skipped, Warning, WarningKind, bytes_of, bytes_with, read_robot,
};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{
    Direction, Frame, Joint, JointBuilder, JointId, JointKind, Mechanism,
};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use yaml::{Node, Said, Word};

/// The entry that only such files have.
const LOOPS: &str = "closed_loop:";

/// The name that the URDF usually has.
const USUAL: &str = "robot.urdf";

/// In older files: joints with this word in their names are balls, as a program made of them.
const BALLS_BY_NAME: &str = "rotule_name";

/// Whether a text is such YAML.
pub(super) fn is_description(text: &str) -> bool {
    let text = text.trim_start_matches('\u{feff}');
    text.lines().any(|line| line.starts_with(LOOPS))
}

/// What the YAML says.
struct Described {
    loops: Vec<Closing>,
    kinds: Vec<(Word, Kind)>,
    motors: Motors,
    /// Entries that are not read.
    others: Vec<Word>,
}

/// Two frames that meet.
struct Closing {
    frames: [Word; 2],
    kind: JointKind,
}

/// The kind that a joint of the URDF is of in truth.
struct Kind {
    kind: JointKind,
    axes: Option<[Direction; 2]>,
}

enum Motors {
    Named(Vec<Word>),
    With(Word),
}

/// Reads such YAML, and the URDF beside it.
///
/// # Errors
/// What is wrong with either, and where; a text without a file, which has nothing beside it; no URDF there, or several.
pub(super) fn read(
    text: &str,
    file: &str,
    base: Option<&Path>,
    options: &ReadOptions,
) -> Result<Reading, FormatError> {
    let here = |faults: Vec<Fault>| located(file, text, faults);
    let described = Described::of(text).map_err(|fault| here(vec![fault]))?;
    let path = urdf_beside(base).map_err(|fault| here(vec![fault]))?;
    let name = path.display().to_string();
    let bytes = bytes_of(&path).map_err(|fault| located(&name, "", vec![fault]))?;
    let read = |added: &Added| {
        bytes_with(&bytes, &name, |text, file| {
            read_robot(text, file, Some(path.as_path()), options, added)
        })
    };
    // The names that the YAML may use are known when the URDF is read.
    let alone = read(&Added::default())?;
    let added = described.added(&alone.mechanism).map_err(here)?;
    let mut reading = read(&added)?;
    reading.mechanism = described.with_kinds(reading.mechanism).map_err(here)?;
    reading.format = "gepetto";
    let mut warnings = described.warnings(&added, &path);
    warnings.append(&mut reading.warnings);
    reading.warnings = warnings;
    let mut skipped = described.skipped(text);
    skipped.append(&mut reading.skipped);
    reading.skipped = skipped;
    Ok(reading)
}

impl Described {
    fn of(text: &str) -> Outcome<Self> {
        let (mut loops, mut types) = (Vec::new(), None);
        let (mut joints, mut kinds) = (Vec::new(), Vec::new());
        let (mut motors, mut others) = (Motors::Named(Vec::new()), Vec::new());
        for (key, value) in yaml::entries(text)? {
            match key.text.as_str() {
                "closed_loop" => loops = pairs(value)?,
                "type" => types = Some((key, words(value)?)),
                "joint_name" => joints = words(value)?,
                "joint_type" => kinds = words(value)?,
                "name_mot" => {
                    motors = match value.said {
                        Said::Word(text) => Motors::With(Word { text, at: value.at }),
                        _ => Motors::Named(words(value)?),
                    }
                }
                _ => others.push(key),
            }
        }
        let closings = match types {
            None => vec![JointKind::Fixed; loops.len()],
            Some((_, types)) if types.len() == loops.len() => {
                types.iter().map(closing_kind).collect::<Outcome<_>>()?
            }
            Some((key, types)) => {
                let message = format!(
                    "there are {} loops and {} types of loops",
                    loops.len(),
                    types.len()
                );
                return Err(key
                    .fault(message)
                    .help("`type` lists `6d` or `3d` for each pair of `closed_loop`"));
            }
        };
        let first = joints.iter().chain(&kinds).next();
        if let Some(word) = first.filter(|_| joints.len() != kinds.len()) {
            let message = format!(
                "there are {} names of joints and {} types of joints",
                joints.len(),
                kinds.len()
            );
            return Err(word
                .fault(message)
                .help("`joint_type` lists a type for each of `joint_name`"));
        }
        let kinds = kinds.iter().map(Kind::of).collect::<Outcome<Vec<_>>>()?;
        let loops = loops.into_iter().zip(closings);
        Ok(Self {
            loops: loops
                .map(|(frames, kind)| Closing { frames, kind })
                .collect(),
            kinds: joints.into_iter().zip(kinds).collect(),
            motors,
            others,
        })
    }

    /// What is added to the robot of the URDF.
    fn added(&self, robot: &Mechanism) -> Result<Added, Vec<Fault>> {
        let mut faults = Vec::new();
        let mut added = Added::default();
        let mut made = BTreeSet::new();
        for Closing { frames, kind } in &self.loops {
            let [one, other] = frames;
            let sides = match [frame_of(robot, one), frame_of(robot, other)] {
                [Ok(one), Ok(other)] => [one, other],
                sides => {
                    faults.extend(sides.into_iter().filter_map(Result::err));
                    continue;
                }
            };
            let [(link, frame), (other_link, other_frame)] = sides;
            if link == other_link {
                let message = "both frames of the loop are in one link";
                faults.push(other.fault(message));
                continue;
            }
            let name = unused(&format!("{}_{}", one.text, other.text), |name| {
                made.contains(name) || robot.joint_named(name).is_some()
            });
            let joint = JointBuilder::closing(&name, *kind, &link, &other_link)
                .origin(frame)
                .successor_origin(other_frame);
            made.insert(name);
            added.joints.push(joint);
        }
        let moves = |joint: &&Joint| joint.freedom() > 0;
        let joints = robot.joints().iter().filter(moves);
        let driven = joints.filter(|joint| match &self.motors {
            Motors::Named(names) => names.iter().any(|name| name.text == joint.name),
            Motors::With(part) => joint.name.contains(&part.text),
        });
        added.motors = driven.map(|joint| joint.name.clone()).collect();
        match faults.is_empty() {
            true => Ok(added),
            false => Err(faults),
        }
    }

    /// The robot with joints of the kinds that the YAML says.
    fn with_kinds(&self, mut robot: Mechanism) -> Result<Mechanism, Vec<Fault>> {
        let mut faults = Vec::new();
        for (name, kind) in &self.kinds {
            match changeable(&robot, name, kind) {
                Ok(Some(joint)) => {
                    let [axis, axis2] = match &kind.axes {
                        Some([axis, axis2]) => [Some(axis.clone()), Some(axis2.clone())],
                        None => [None, None],
                    };
                    robot = robot.with_joint_kind(joint, kind.kind, axis, axis2);
                }
                Ok(None) => {}
                Err(fault) => faults.push(fault),
            }
        }
        match faults.is_empty() {
            true => Ok(robot),
            false => Err(faults),
        }
    }

    /// What is to be known of a reading from two files.
    fn warnings(&self, added: &Added, path: &Path) -> Vec<Warning> {
        let file = path.file_name().unwrap_or(path.as_os_str());
        let file = file.to_string_lossy();
        let mut told = vec![(
            WarningKind::Guessed,
            format!(
                "links and joints are those of {} beside this file; lines and columns of what is said of them are that file's",
                quoted(&file)
            ),
        )];
        if let Motors::Named(names) = &self.motors {
            let lost = |name: &&Word| !added.motors.contains(&name.text);
            let lost = names.iter().filter(lost).map(|name| {
                let name = quoted(&name.text);
                let message = format!("`name_mot` names {name}, which is no joint that moves");
                (WarningKind::Guessed, message)
            });
            told.extend(lost);
        }
        if self.others.iter().any(|key| key.text == BALLS_BY_NAME) {
            let message = format!(
                "`{BALLS_BY_NAME}` is not read: joints whose names it is part of may be meant as balls; list them under `joint_name`, with `SPHERICAL` under `joint_type`"
            );
            told.push((WarningKind::MayJoin, message));
        }
        let warnings = told.into_iter().map(|(kind, message)| Warning {
            line: 1,
            column: 1,
            kind,
            message,
            count: 1,
        });
        warnings.collect()
    }

    /// Entries of the YAML that say nothing of how the robot moves.
    fn skipped(&self, text: &str) -> Vec<Skipped> {
        let others = self.others.iter();
        let others: Vec<&Word> = others.filter(|key| key.text != BALLS_BY_NAME).collect();
        let starts: Vec<usize> = others.iter().map(|key| key.at.start).collect();
        let places = lines_and_columns(text, &starts);
        let skipped = others.iter().zip(places);
        skipped
            .map(|(key, (line, column))| Skipped {
                line,
                column,
                what: format!("the entry {} of the YAML", quoted(&key.text)),
                count: 1,
                standard: true,
            })
            .collect()
    }
}

impl Kind {
    fn of(word: &Word) -> Outcome<Self> {
        const KNOWN: [&str; 5] = ["SPHERICAL", "FIXED", "UJOINT_XY", "UJOINT_YZ", "UJOINT_ZX"];
        let universal = |first: usize, second: usize| Self {
            kind: JointKind::Universal,
            axes: Some([unit(first), unit(second)]),
        };
        let plain = |kind: JointKind| Self { kind, axes: None };
        Ok(match word.text.as_str() {
            "SPHERICAL" => plain(JointKind::Spherical),
            "FIXED" => plain(JointKind::Fixed),
            "UJOINT_XY" => universal(0, 1),
            "UJOINT_YZ" => universal(1, 2),
            "UJOINT_ZX" => universal(2, 0),
            _ => return Err(not_among(word, &KNOWN)),
        })
    }
}

/// The direction of an axis of the frame.
fn unit(axis: usize) -> Direction {
    Direction([0, 1, 2].map(|i| match i == axis {
        true => Number::one(),
        false => Number::zero(),
    }))
}

/// The kind of a loop.
fn closing_kind(word: &Word) -> Outcome<JointKind> {
    match word.text.to_lowercase().as_str() {
        "6d" => Ok(JointKind::Fixed),
        "3d" => Ok(JointKind::Spherical),
        _ => Err(not_among(word, &["6d", "3d"])),
    }
}

fn not_among(word: &Word, known: &[&str]) -> Fault {
    let meant = did_you_mean(&word.text, known.iter().copied(), ("`", "`"));
    let known = alternatives(known);
    word.fault(format!("needed {known}, found {}", quoted(&word.text)))
        .maybe_help(meant)
}

/// The link of a frame, and the frame in it. A joint's name stands for the frame of the link that the joint moves.
fn frame_of(robot: &Mechanism, name: &Word) -> Outcome<(String, Frame)> {
    let of_link = robot.link_named(&name.text);
    let of_joint = robot.joint_named(&name.text).map(|id| robot.joint(id));
    let link_name = |link| robot.link(link).name.clone();
    match (of_link, of_joint) {
        (Some(link), Some(joint)) if joint.successor.link != link => Err(name
            .fault(format!(
                "{} is a link and a joint that moves another link",
                quoted(&name.text)
            ))
            .help("give one of the two another name in the URDF")),
        (Some(link), _) => Ok((link_name(link), Frame::identity())),
        (None, Some(joint)) => Ok((
            link_name(joint.successor.link),
            joint.successor.frame.clone(),
        )),
        (None, None) => {
            let links = robot.links().iter().map(|link| link.name.as_str());
            let joints = robot.joints().iter().map(|joint| joint.name.as_str());
            let meant = did_you_mean(&name.text, links.chain(joints), ("`", "`"));
            Err(name
                .fault(format!(
                    "the URDF has no link or joint named {}",
                    quoted(&name.text)
                ))
                .maybe_help(meant))
        }
    }
}

/// The joint that is of another kind in truth; `None` where it is fixed already and meant to be.
fn changeable(robot: &Mechanism, name: &Word, kind: &Kind) -> Outcome<Option<JointId>> {
    let Some(id) = robot.joint_named(&name.text) else {
        let joints = robot.joints().iter().map(|joint| joint.name.as_str());
        let meant = did_you_mean(&name.text, joints, ("`", "`"));
        return Err(name
            .fault(format!(
                "the URDF has no joint named {}",
                quoted(&name.text)
            ))
            .maybe_help(meant));
    };
    let joint = robot.joint(id);
    if joint.freedom() == 0 && kind.kind != JointKind::Fixed {
        let message = format!(
            "joint {} is fixed in the URDF, and only joints that move can be of another kind",
            quoted(&name.text)
        );
        return Err(name.fault(message).help("make it revolute there"));
    }
    let couplings = robot.couplings().iter();
    let mut terms = couplings.flat_map(|coupling| &coupling.terms);
    if terms.any(|term| term.joint == id) {
        let message = format!(
            "joint {} is coupled in the URDF, which needs its one freedom",
            quoted(&name.text)
        );
        return Err(name.fault(message).help("remove the <mimic>"));
    }
    Ok((joint.freedom() > 0).then_some(id))
}

/// The URDF beside a file: of its name, the usual one, or the only one.
fn urdf_beside(base: Option<&Path>) -> Outcome<PathBuf> {
    let start = |message: String| Fault::new(0..0, message);
    let Some(base) = base else {
        let message = "this describes the loops of a robot whose URDF stands in a file beside it";
        return Err(start(message.to_owned()).help("name the file: kutzbach report robot.yaml"));
    };
    let own = base.with_extension("urdf");
    let usual = base.with_file_name(USUAL);
    let stands = |path: &PathBuf| path.as_path() != base && path.is_file();
    if let Some(found) = [own, usual].into_iter().find(stands) {
        return Ok(found);
    }
    let folder = match base.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let entries = std::fs::read_dir(folder)
        .map_err(|error| start(format!("the folder of this file cannot be read: {error}")))?;
    let is_urdf = |path: &PathBuf| path.extension().is_some_and(|own| own == "urdf");
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let found: BTreeSet<PathBuf> = paths.filter(is_urdf).collect();
    let mut found = found.into_iter();
    match (found.next(), found.next()) {
        (Some(only), None) => Ok(only),
        (None, _) => Err(start(
            "this describes the loops of a robot, and no URDF stands beside it".to_owned(),
        )
        .help(format!("put the robot's URDF there, as {}", quoted(USUAL)))),
        (Some(_), Some(_)) => Err(start(
            "this describes the loops of a robot, and several URDF files stand beside it"
                .to_owned(),
        )
        .help(format!("call the one that is meant {}", quoted(USUAL)))),
    }
}

/// The pairs of names of a list.
fn pairs(node: Node) -> Outcome<Vec<[Word; 2]>> {
    let pair = |node: Node| -> Outcome<[Word; 2]> {
        let at = node.fault("needed the names of two frames, [one, other]");
        <[Word; 2]>::try_from(words(node)?).map_err(|_| at)
    };
    let at = node.fault("needed a list of pairs, [[one, other], ...]");
    match node.said {
        Said::List(items) => items.into_iter().map(pair).collect(),
        Said::Nothing => Ok(Vec::new()),
        _ => Err(at),
    }
}

/// The words of a list.
fn words(node: Node) -> Outcome<Vec<Word>> {
    let word = |node: Node| -> Outcome<Word> {
        let at = node.fault("needed a word");
        match node.said {
            Said::Word(text) => Ok(Word { text, at: node.at }),
            _ => Err(at),
        }
    };
    let at = node.fault("needed a list of words, [one, other, ...]");
    match node.said {
        Said::List(items) => items.into_iter().map(word).collect(),
        Said::Nothing => Ok(Vec::new()),
        _ => Err(at),
    }
}
