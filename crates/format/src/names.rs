//! Names: each is given once, and what is referred to exists.

use super::element::{Attribute, Element};
use super::error::{Fault, MOST_FAULTS, Outcome};
use super::words::{did_you_mean, quoted};
use std::collections::HashMap;
use std::ops::Range;

/// What a name belongs to. Joints (loops among them) and couplings share one set of names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Named {
    Link,
    Joint,
    Coupling,
    Configuration,
}

/// All names that a file gives and refers to. The maps are only asked for single names, so their order does not matter.
#[derive(Default)]
pub(super) struct Directory<'a> {
    /// Every named thing with its place, in file order.
    given: Vec<(Named, &'a str, Range<usize>)>,
    links: HashMap<&'a str, usize>,
    joints: HashMap<&'a str, usize>,
    configurations: HashMap<&'a str, usize>,
    /// Attributes that name a link or a joint.
    references: Vec<(Named, Attribute<'a>)>,
}

impl<'a> Directory<'a> {
    /// The name of a new thing; a name that is taken is an error.
    pub(super) fn add(&mut self, sort: Named, element: Element<'a>) -> Outcome<&'a str> {
        let name = element.required("name")?;
        check_name(name)?;
        let names = match sort {
            Named::Link => &mut self.links,
            Named::Joint | Named::Coupling => &mut self.joints,
            Named::Configuration => &mut self.configurations,
        };
        if let Some(first) = names.get(name.value) {
            let other = match self.given[*first].0 {
                Named::Link => "link",
                Named::Joint => "joint or loop",
                Named::Coupling => "coupling",
                Named::Configuration => "configuration",
            };
            let help = match sort {
                Named::Joint | Named::Coupling => {
                    "joints, loops and couplings share one set of names"
                }
                Named::Link => "every link has a name of its own",
                Named::Configuration => "every configuration has a name of its own",
            };
            return Err(name
                .fault(format!(
                    "the name {} is taken by another {other}",
                    quoted(name.value)
                ))
                .help(help));
        }
        names.insert(name.value, self.given.len());
        self.given.push((sort, name.value, element.range()));
        Ok(name.value)
    }

    /// The value of an attribute that names a link or a joint; whether that exists is asked when everything is read.
    pub(super) fn refer(
        &mut self,
        sort: Named,
        element: Element<'a>,
        attribute: &str,
    ) -> Outcome<&'a str> {
        self.refer_by(sort, element.required(attribute)?)
    }

    /// As [`Self::refer`], where the name stands wherever it does.
    pub(super) fn refer_by(&mut self, sort: Named, attribute: Attribute<'a>) -> Outcome<&'a str> {
        check_name(attribute)?;
        self.references.push((sort, attribute));
        Ok(attribute.value)
    }

    /// Gives a link that is referred to and does not exist its name; returns where it is referred to first.
    pub(super) fn assume_link(&mut self, name: &str) -> Option<usize> {
        if self.exists(Named::Link, name) {
            return None;
        }
        let named = self.references.iter().map(|(_, attribute)| attribute);
        let first = named
            .filter(|attribute| attribute.value == name)
            .min_by_key(|attribute| attribute.range().start)?;
        let (value, range) = (first.value, first.range());
        let start = range.start;
        self.links.insert(value, self.given.len());
        self.given.push((Named::Link, value, range));
        Some(start)
    }

    /// Whether there is a thing of that name so far.
    pub(super) fn has(&self, sort: Named, name: &str) -> bool {
        self.exists(sort, name)
    }

    /// Whether a joint, loop or coupling has that name.
    pub(super) fn has_joint_or_coupling(&self, name: &str) -> bool {
        self.joints.contains_key(name)
    }

    /// The names of links so far, in file order.
    pub(super) fn link_names(&self) -> impl Iterator<Item = (&'a str, Range<usize>)> {
        let links = self.given.iter().filter(|(sort, ..)| *sort == Named::Link);
        links.map(|(_, name, range)| (*name, range.clone()))
    }

    /// The names of joints so far, in file order.
    pub(super) fn joint_names(&self) -> impl Iterator<Item = (&'a str, Range<usize>)> {
        let joints = self.given.iter().filter(|(sort, ..)| *sort == Named::Joint);
        joints.map(|(_, name, range)| (*name, range.clone()))
    }

    /// Where the thing of that name is.
    pub(super) fn place(&self, sort: Named, name: &str) -> Option<Range<usize>> {
        self.given
            .iter()
            .find(|(other, given, _)| *other == sort && *given == name)
            .map(|(.., range)| range.clone())
    }

    /// A fault for each reference to something that does not exist.
    pub(super) fn unresolved(&self) -> Vec<Fault> {
        self.references
            .iter()
            .filter(|(sort, attribute)| !self.exists(*sort, attribute.value))
            .take(MOST_FAULTS)
            .map(|(sort, attribute)| {
                let what = if *sort == Named::Link {
                    "link"
                } else {
                    "joint"
                };
                let known = self.given.iter().filter(|(other, ..)| other == sort);
                let name = attribute.value;
                attribute
                    .fault(format!("there is no {what} named {}", quoted(name)))
                    .maybe_help(did_you_mean(
                        name,
                        known.map(|(_, name, _)| *name),
                        ("`", "`"),
                    ))
            })
            .collect()
    }

    fn exists(&self, sort: Named, name: &str) -> bool {
        let index = match sort {
            Named::Link => self.links.get(name),
            Named::Joint | Named::Coupling => self.joints.get(name),
            Named::Configuration => self.configurations.get(name),
        };
        index.is_some_and(|index| self.given[*index].0 == sort)
    }
}

/// The name wanted; where something has it, with a number after it that nothing has: the first one from 2 on, unless numbers are taken
/// with gaps between. Thousands of things may want one name, so the number is looked for by halving and not one by one.
pub(super) fn unused(wanted: &str, is_taken: impl Fn(&str) -> bool) -> String {
    if !is_taken(wanted) {
        return wanted.to_owned();
    }
    let numbered = |number: usize| format!("{wanted}_{number}");
    let (mut taken, mut free) = (1, 2);
    while is_taken(&numbered(free)) {
        (taken, free) = (free, 2 * free);
    }
    while free - taken > 1 {
        let middle = taken + (free - taken) / 2;
        match is_taken(&numbered(middle)) {
            true => taken = middle,
            false => free = middle,
        }
    }
    numbered(free)
}

fn check_name(name: Attribute<'_>) -> Outcome<()> {
    if name.value.is_empty() {
        return Err(name.fault("needed a name, found nothing"));
    }
    if name.value.contains("${") || name.value.contains("$(") {
        return Err(name
            .fault(format!(
                "expressions stand for numbers, not for names such as {}",
                quoted(name.value)
            ))
            .help("expand the file with xacro first"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::unused;
    use std::cell::Cell;

    #[test]
    fn the_first_number_that_is_free_is_found_in_few_questions() {
        let asked = Cell::new(0);
        let is_taken = |name: &str| {
            asked.set(asked.get() + 1);
            let number = name.strip_prefix("a_").map(str::parse::<usize>);
            name == "a" || matches!(number, Some(Ok(number)) if number <= 5000)
        };
        assert_eq!(unused("a", is_taken), "a_5001");
        assert!(asked.get() < 40, "{}", asked.get());
        assert_eq!(unused("b", is_taken), "b");
        for last in 1..20 {
            let is_taken = |name: &str| {
                let number = name.strip_prefix("a_").map(str::parse::<usize>);
                name == "a" || matches!(number, Some(Ok(number)) if number <= last)
            };
            assert_eq!(unused("a", is_taken), format!("a_{}", last + 1));
        }
    }
}
