//! Default classes: what an element that leaves an attribute out takes it from.

use crate::element::{Attribute, Element};
use crate::error::Outcome;
use crate::guard::MOST_LEVELS;
use crate::words::{did_you_mean, quoted};
use std::collections::BTreeMap;

/// The name of the class that all others come from, where the file gives it none.
pub(super) const MAIN: &str = "main";

/// The root element that holds the classes of a file that something is attached from; and the attribute of the frame of what is attached, and of the keys that
/// came with it, that marks the attachment.
pub(super) const ATTACHED: &str = "attached";

/// A class: the one that it comes from, and its elements.
#[derive(Default)]
struct Class<'a> {
    from: Option<&'a str>,
    elements: Vec<Element<'a>>,
}

/// All classes of a file, by name.
#[derive(Default)]
pub(super) struct Classes<'a> {
    all: BTreeMap<&'a str, Class<'a>>,
    /// Names that sections of the root element give the class of the whole file: there is one, however many sections say something of it.
    of_file: Vec<&'a str>,
}

impl<'a> Classes<'a> {
    /// Takes `<default>` of the root element, or the classes of a file that something is attached from, which come from no other one; classes
    /// inside come from it.
    ///
    /// # Errors
    /// A class inside another one without a name, two classes of one name, and more classes inside one another than are looked through for
    /// every attribute.
    pub(super) fn read(&mut self, default: Element<'a>) -> Outcome<()> {
        let mut open = vec![(default, None, 1)];
        while let Some((element, from, level)) = open.pop() {
            if level > MOST_LEVELS {
                return Err(element.fault(format!(
                    "default classes are nested more than {MOST_LEVELS} levels deep"
                )));
            }
            let name = match (element.attribute("class"), from) {
                (Some(name), None) if element.name() == ATTACHED => name.value,
                (name, None) => {
                    self.of_file.extend(name.map(|name| name.value));
                    MAIN
                }
                (Some(name), Some(_)) => name.value,
                (None, Some(_)) => {
                    return Err(element
                        .fault("a default class inside another one needs a name")
                        .help("<default class=\"...\">"));
                }
            };
            if self.all.contains_key(name) && from.is_some() {
                return Err(
                    element.fault(format!("two default classes are called {}", quoted(name)))
                );
            }
            let class = self.all.entry(name).or_default();
            class.from = from;
            for part in element.elements() {
                match part.name() {
                    "default" => open.push((part, Some(name), level + 1)),
                    _ => class.elements.push(part),
                }
            }
        }
        Ok(())
    }

    /// The class of an element: its own, the one that a body gives to what is inside it, or that of the file.
    ///
    /// # Errors
    /// A class that the file does not define.
    pub(super) fn of(&self, element: Element<'a>, inherited: Option<&'a str>) -> Outcome<&'a str> {
        let own = element.attribute("class");
        let name = own.map_or(inherited, |own| Some(own.value));
        let name = name.filter(|name| !self.of_file.contains(name));
        if let Some(own) = own.filter(|own| !self.of_file.contains(&own.value))
            && own.value != MAIN
            && !self.all.contains_key(own.value)
        {
            let known = self.all.keys().copied();
            return Err(own
                .fault(format!("there is no default class {}", quoted(own.value)))
                .maybe_help(did_you_mean(own.value, known, ("`", "`"))));
        }
        Ok(name.unwrap_or(MAIN))
    }

    /// An attribute of an element of a class, from where it is found first: the element, its class, those that the class comes from.
    pub(super) fn attribute(
        &self,
        element: Element<'a>,
        class: &str,
        name: &str,
    ) -> Option<Attribute<'a>> {
        element
            .attribute(name)
            .or_else(|| self.says(class, element.name(), name))
    }

    /// All that an element and its classes say of an attribute, what counts most first.
    pub(super) fn each(&self, element: Element<'a>, class: &str, name: &str) -> Vec<Attribute<'a>> {
        let mut found: Vec<Attribute<'a>> = element.attribute(name).into_iter().collect();
        let mut class = self.all.get(class);
        while let Some(here) = class {
            let own = here.elements.iter();
            let own = own.filter(|own| own.name() == element.name());
            found.extend(own.rev().filter_map(|own| own.attribute(name)));
            class = here.from.and_then(|from| self.all.get(from));
        }
        found
    }

    /// What a class says of the attribute of an element of some name.
    pub(super) fn says(&self, class: &str, element: &str, name: &str) -> Option<Attribute<'a>> {
        let mut class = self.all.get(class);
        while let Some(here) = class {
            let own = here.elements.iter().filter(|own| own.name() == element);
            let found = own.rev().find_map(|own| own.attribute(name));
            if found.is_some() {
                return found;
            }
            class = here.from.and_then(|from| self.all.get(from));
        }
        None
    }
}
