//! The arguments of a file: settings for them, and all that lack a value told at once.

use super::element::{Element, Node};
use super::text::Text;
use super::value::Num;
use super::{Run, Sort, Trouble};
use crate::words::quoted;
use kutzbach_math::number::Number;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// A setting as text: `pi/4` is the number, everything else as it is.
pub(super) fn setting(value: &str) -> Text {
    let text = Text::plain(value);
    let is_expression = value.contains(['+', '-', '*', '/', '(']) && Num::read(&text).is_none();
    if !is_expression {
        return text;
    }
    match Number::expression(value, &mut |_| Ok(None)) {
        Ok(number) => {
            let shown = super::python_text::float_text(number.value());
            Text::of_number(&shown, Some(&number))
        }
        Err(_) => text,
    }
}

/// What the files read so far say about arguments.
#[derive(Default)]
struct Arguments {
    /// With their defaults.
    declared: BTreeMap<String, Option<String>>,
    used: BTreeSet<String>,
}

impl Arguments {
    fn of(run: &Run<'_>) -> Self {
        let mut all = Self::default();
        let mut waiting: Vec<Rc<Element>> = run.files.roots().cloned().collect();
        while let Some(element) = waiting.pop() {
            if element.is_xacro && element.local_name() == "arg" {
                let value = |name: &str| {
                    element
                        .attribute(name)
                        .map(|own| own.value.as_str().to_owned())
                };
                if let Some(name) = value("name") {
                    let default = value("default");
                    all.declared
                        .entry(name)
                        .and_modify(|own| *own = own.take().or(default.clone()))
                        .or_insert(default);
                }
            }
            for attribute in &element.attributes {
                all.uses(attribute.value.as_str());
            }
            for child in &element.children {
                match child {
                    Node::Element(inner) => waiting.push(inner.clone()),
                    Node::Text(text, _) => all.uses(text.as_str()),
                }
            }
        }
        all
    }

    fn uses(&mut self, text: &str) {
        for rest in text.split("$(arg ").skip(1) {
            let name = rest.split(')').next().unwrap_or_default().trim();
            if !name.is_empty() && !name.contains(['$', ' ']) {
                self.used.insert(name.to_owned());
            }
        }
    }
}

/// The arguments that the files declare, with their defaults.
pub(super) fn known(run: &Run<'_>) -> Vec<(String, Option<String>)> {
    Arguments::of(run).declared.into_iter().collect()
}

/// A trouble about one argument, told for all that lack a value.
pub(super) fn with_all_missing(run: &Run<'_>, trouble: Trouble) -> Trouble {
    if trouble.kind != Sort::Argument {
        return trouble;
    }
    let all = Arguments::of(run);
    let has_value = |name: &str| {
        run.arguments.contains_key(name) || all.declared.get(name).is_some_and(Option::is_some)
    };
    let names = all.used.iter().chain(all.declared.keys());
    let missing: BTreeSet<&String> = names.filter(|name| !has_value(name)).collect();
    if missing.is_empty() {
        // Used before the element that gives its default.
        return trouble;
    }
    let quoted_names: Vec<String> = missing.iter().map(|name| quoted(name)).collect();
    let settings: Vec<String> = missing
        .iter()
        .map(|name| format!("--set {name}=…"))
        .collect();
    let others: Vec<String> = all
        .declared
        .iter()
        .filter_map(|(name, default)| Some(format!("{name}={}", default.as_ref()?)))
        .take(20)
        .collect();
    let (what, have) = match quoted_names.len() {
        1 => ("the argument", "has"),
        _ => ("the arguments", "have"),
    };
    let mut help = match settings.len() {
        1 => format!("give it with {}", settings.join(" ")),
        _ => format!("give them with {}", settings.join(" ")),
    };
    if !others.is_empty() {
        help = format!("{help}; arguments with defaults: {}", others.join(", "));
    }
    Trouble {
        message: format!("{what} {} {have} no value", quoted_names.join(", ")),
        help: Some(help),
        ..trouble
    }
}
