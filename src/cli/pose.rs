//! At which pose: a configuration of the file, values given on the command line, or the middle of the limits.

use super::failure::Failure;
use clap::Args;
use kutzbach::algebra::Limits;
use kutzbach::assembly::modes::{Complete, Question, assembly_modes};
use kutzbach::format::Reading;
use kutzbach::mechanism::{Configuration, FreedomPart, Joint, JointId, Mechanism};
use kutzbach::mobility::{AnalysisOptions, Depth, analyse};
use kutzbach::motion::{NotReached, approach};
use kutzbach::number::Number;
use kutzbach::report::text::visible;
use kutzbach::report::text::words::{counted, degrees};
use std::collections::{BTreeMap, BTreeSet};

/// The configuration of the file as it is drawn.
const HOME: &str = "home";

/// What `--pose` says instead of joints and values.
const LIMITS: &str = "limits";

/// The pose to analyse.
#[derive(Clone, Debug, Args)]
pub struct Pose {
    /// Take a configuration of the file instead of the home pose
    #[arg(long, value_name = "CONFIGURATION")]
    at: Option<String>,
    /// Put joints elsewhere: `crank=30deg,slide=5mm` holds these (rad and m without a unit; several values as
    /// `"ball=0.1 0 0"`) in the configuration drawn, `limits` lets all others begin in the middle of their limits; may be
    /// repeated
    #[arg(long, value_name = "JOINT=VALUE|limits", value_delimiter = ',')]
    pose: Vec<String>,
}

impl Pose {
    /// Whether anything but the home pose is asked for.
    pub fn is_home(&self) -> bool {
        self.at.is_none() && self.pose.is_empty()
    }

    /// Whether assembly may move what is asked for.
    pub fn begins_at_limits(&self) -> bool {
        self.pose.iter().any(|item| item.trim() == LIMITS)
    }

    /// The joints asked for, with their values.
    ///
    /// # Errors
    /// Joints that the file does not have, and values that these cannot take.
    pub fn given(&self, mechanism: &Mechanism) -> Result<Vec<(JointId, Vec<Number>)>, Failure> {
        let given = self.pose.iter().map(|item| item.trim());
        let given = given.filter(|item| *item != LIMITS);
        given.map(|item| place(mechanism, item)).collect()
    }

    /// What is asked for of single joints, as it was written.
    pub fn items(&self) -> Vec<String> {
        self.pose
            .iter()
            .map(|item| item.trim().to_owned())
            .collect()
    }

    /// The configuration of the file that is asked for; `None` for the home pose.
    pub fn named(&self) -> Option<String> {
        self.at.clone().filter(|name| name != HOME)
    }

    /// The mechanism with the joints asked for held at their values, for all that is said of every pose.
    ///
    /// # Errors
    /// Joints that the file does not have or that cannot be held, and values that these cannot take.
    pub fn hold(&self, mechanism: &Mechanism) -> Result<Mechanism, Failure> {
        let given = self.given(mechanism)?.into_iter();
        let held = given.filter_map(|(joint, mut values)| Some((joint, values.pop()?)));
        let held: Vec<(JointId, Number)> = held.collect();
        mechanism
            .with_joints_held(&held)
            .map_err(|error| Failure::Plain {
                message: format!("`--pose`: {error}"),
                help: Some("only revolute and prismatic joints can be held at a value".to_owned()),
            })
    }

    /// As [`Self::configured`]; what is to be told goes to the standard error.
    ///
    /// # Errors
    /// As that.
    pub fn configure(&self, reading: &mut Reading) -> Result<Option<String>, Failure> {
        let (name, told) = self.configured(reading)?;
        if let Some(told) = told {
            eprintln!("note: {}", visible(&told));
        }
        Ok(name)
    }

    /// The name of the configuration asked for, which the mechanism then has, `None` for the home pose; and what is to be told where
    /// it is not the configuration drawn.
    ///
    /// # Errors
    /// Joints that the file does not have, and values that these cannot take.
    pub fn configured(&self, reading: &mut Reading) -> Result<Asked, Failure> {
        let at = self.named();
        if self.pose.is_empty() {
            return Ok((at, None));
        }
        let mechanism = &reading.mechanism;
        let mut positions: BTreeMap<JointId, Vec<Number>> = BTreeMap::new();
        let mut free = BTreeSet::new();
        if self.begins_at_limits() {
            for (joint, value) in mechanism.middle_of_limits() {
                positions.insert(
                    joint,
                    vec![Number::from_f64(value).unwrap_or_else(Number::zero)],
                );
                free.insert(joint);
            }
        }
        let (base, begun) = match &self.at {
            Some(name) => {
                let named = mechanism.configuration(name);
                let named = named.ok_or_else(|| Failure::Plain {
                    message: format!("there is no configuration `{name}`"),
                    help: None,
                })?;
                (named.positions.clone(), named.free.clone())
            }
            None => (Vec::new(), BTreeSet::new()),
        };
        let given = self.given(mechanism)?;
        let wanted = Configuration {
            name: String::new(),
            positions: given.clone(),
            free: BTreeSet::new(),
        };
        for (joint, values) in base {
            match begun.contains(&joint) {
                true => free.insert(joint),
                false => free.remove(&joint),
            };
            positions.insert(joint, values);
        }
        for (joint, values) in given {
            free.remove(&joint);
            positions.insert(joint, values);
        }
        let mut name: Vec<&str> = at.iter().map(String::as_str).collect();
        name.extend(self.pose.iter().map(|item| item.trim()));
        let configuration = Configuration {
            name: name.join(", "),
            positions: positions.into_iter().collect(),
            free,
        };
        let name = configuration.name.clone();
        let wanted = Configuration {
            name: name.clone(),
            ..wanted
        };
        let along = match self.begins_at_limits() || wanted.positions.is_empty() {
            true => Ok(None),
            false => approach(mechanism, at.as_deref(), &wanted),
        };
        let (configuration, why) = match along {
            Ok(reached) => (reached.unwrap_or(configuration), None),
            Err(why) => (configuration, Some(why)),
        };
        reading.mechanism = mechanism.with_configuration(configuration);
        let told = why.and_then(|why| elsewhere(&reading.mechanism, &wanted, &why));
        Ok((Some(name), told))
    }
}

/// A configuration by its name, and what is to be told of it.
type Asked = (Option<String>, Option<String>);

/// Mechanisms of more freedoms are not assembled in all ways for a remark.
const COUNTED: usize = 8;

/// Work that this may take.
const WORK: u64 = 1_000_000;

/// What is to be told of a pose that the branch drawn does not lead to, where the mechanism closes there.
fn elsewhere(mechanism: &Mechanism, wanted: &Configuration, why: &NotReached) -> Option<String> {
    let options = AnalysisOptions {
        configuration: Some(wanted.name.clone()),
        depth: Depth::Rank,
        ..AnalysisOptions::default()
    };
    let analysis = analyse(mechanism, &options).ok()?;
    if !analysis.assembly.closed {
        return None;
    }
    let named = |joint: JointId| mechanism.joint(joint).name.as_str();
    let single = |(joint, values): &(JointId, Vec<Number>)| match values.as_slice() {
        [value] => Some((*joint, value.clone())),
        _ => None,
    };
    let held = wanted.positions.iter().map(single).collect();
    let question = Question {
        held,
        limits: Limits {
            work: Some(WORK),
            ..Limits::default()
        },
    };
    let small = question.held.is_some() && mechanism.freedom() <= COUNTED;
    let modes = small.then(|| assembly_modes(mechanism, &question).ok());
    let count = match modes.flatten() {
        Some(modes) if modes.complete == Complete::Proven && modes.moves == Some(0) => {
            format!("; {} in all", modes.configurations.len())
        }
        _ => String::new(),
    };
    Some(format!(
        "this is another configuration than the one drawn, which does not lead to {}: for `{}`, {}{count} (`kutzbach assemble --hold`)",
        wanted.name,
        named(why.joint),
        why.why
    ))
}

/// Reads `joint=value`.
fn place(mechanism: &Mechanism, item: &str) -> Result<(JointId, Vec<Number>), Failure> {
    let wrong = |message: String, help: &str| Failure::Plain {
        message,
        help: Some(help.to_owned()),
    };
    let Some((name, text)) = item.split_once('=') else {
        return Err(wrong(
            format!("`--pose {item}` states no value"),
            "write it as joint=value, for example `crank=0.3` or `crank=30deg`; or `limits`",
        ));
    };
    let Some(joint) = mechanism.joint_named(name.trim()) else {
        return Err(wrong(
            format!("`--pose`: there is no joint named `{}`", name.trim()),
            "`kutzbach report FILE --verbose` lists the joints",
        ));
    };
    let described = mechanism.joint(joint);
    let parts = described.kind.freedoms();
    let words: Vec<&str> = text.split_whitespace().collect();
    if words.len() != parts.len() {
        let message = format!(
            "`--pose`: joint `{}` has {}, given: {}",
            described.name,
            degrees(parts.len()),
            counted(words.len(), "value"),
        );
        return Err(wrong(message, "one value for each, `\"ball=0.1 0 0\"`"));
    }
    let values = words
        .iter()
        .zip(parts)
        .map(|(word, part)| measured(word, *part).map_err(|why| refused(described, word, &why)))
        .collect::<Result<_, _>>()?;
    Ok((joint, values))
}

fn refused(joint: &Joint, word: &str, why: &str) -> Failure {
    Failure::Plain {
        message: format!(
            "`--pose`: `{word}` is no value for joint `{}`: {why}",
            joint.name
        ),
        help: Some(
            "a number or an expression such as `pi/4`; with `deg` or `rad`, `mm` or `m` after it"
                .to_owned(),
        ),
    }
}

/// A value with or without a unit, in rad or m.
pub(super) fn measured(word: &str, part: FreedomPart) -> Result<Number, String> {
    let slides = part == FreedomPart::Translation;
    let units = [
        ("deg", "*pi/180", false),
        ("°", "*pi/180", false),
        ("rad", "", false),
        ("mm", "/1000", true),
        ("m", "", true),
    ];
    let unit = units.iter().find(|(unit, ..)| word.ends_with(unit));
    let (value, factor) = match unit {
        Some((_, _, length)) if *length != slides => {
            let moves = if slides { "slides" } else { "turns" };
            return Err(format!("this degree of freedom {moves}"));
        }
        Some((unit, factor, _)) => (word.trim_end_matches(unit), *factor),
        None => (word, ""),
    };
    if let (Ok(number), "") = (Number::decimal(value), factor) {
        return Ok(number);
    }
    Number::expression(&format!("({value}){factor}"), &mut |_| Ok(None))
        .map_err(|error| error.to_string())
}
