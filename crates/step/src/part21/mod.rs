//! ISO 10303-21: the text of a STEP file as entities by number.
//!
//! Everything of a file lies in three flat lists: values, leaves, entities. A list among the values is followed by what it
//! holds and says where it ends; strings and keywords are places in the text. So a file of 50 MB takes some 150 MB besides
//! itself, and no value has a string or a list of its own.

mod lexer;
mod parser;
mod text;

use crate::error::{Problem, StepError};
use lexer::{Span, shortened};

pub(crate) use parser::parse;

/// A value among the parameters of an entity.
#[derive(Clone, Copy, Debug)]
enum Value {
    Number(f64),
    Reference(u64),
    Text(Span),
    Enumeration(Span),
    Binary,
    Unset,
    Derived,
    /// What follows up to the value numbered `end`.
    List {
        end: u32,
    },
    /// A value with its type, as `LENGTH_MEASURE(1.)`: what follows up to the value numbered `end`.
    Typed {
        end: u32,
    },
}

/// A keyword with its parameters. An entity has one leaf, or several where it is of several types at once.
#[derive(Clone, Copy, Debug)]
struct Leaf {
    /// Place of the keyword in [`Exchange::keywords`].
    keyword: u32,
    /// First of its values.
    first: u32,
    /// Behind the last of its values.
    end: u32,
}

/// An entity: where its leaves are.
#[derive(Clone, Copy, Debug)]
struct Entity {
    number: u64,
    line: u32,
    first: u32,
    end: u32,
}

/// A file that has been taken apart.
#[derive(Debug)]
pub(crate) struct Exchange<'t> {
    text: &'t [u8],
    values: Vec<Value>,
    leaves: Vec<Leaf>,
    /// In ascending order of their numbers.
    entities: Vec<Entity>,
    /// Every keyword once, in capitals.
    keywords: Vec<String>,
    schemas: Vec<String>,
}

impl Exchange<'_> {
    /// The schemas that the header names, such as `AUTOMOTIVE_DESIGN`.
    pub fn schemas(&self) -> &[String] {
        &self.schemas
    }

    /// Every keyword once, in capitals, in the order in which they first occur.
    pub fn keywords(&self) -> &[String] {
        &self.keywords
    }

    /// All entities in ascending order of their numbers.
    pub fn instances(&self) -> impl Iterator<Item = Instance<'_>> {
        self.entities.iter().map(move |entity| Instance {
            file: self,
            entity: *entity,
        })
    }

    /// The entities that have a leaf of this keyword (in capitals), in ascending order of their numbers.
    pub fn of_type(&self, keyword: &str) -> Vec<Record<'_>> {
        let Some(wanted) = self.keywords.iter().position(|k| k == keyword) else {
            return Vec::new();
        };
        let leaf_of = |instance: Instance<'_>| {
            let mut leaves = instance.raw_leaves();
            leaves.any(|leaf| leaf.keyword as usize == wanted)
        };
        self.instances()
            .filter(|instance| leaf_of(*instance))
            .filter_map(|instance| instance.leaf(keyword))
            .collect()
    }

    /// The entity of a number.
    pub fn find(&self, number: u64) -> Option<Instance<'_>> {
        let place = self
            .entities
            .binary_search_by_key(&number, |entity| entity.number)
            .ok()?;
        self.entities.get(place).map(|entity| Instance {
            file: self,
            entity: *entity,
        })
    }

    /// The value behind the value at `index`, past everything that it holds.
    fn behind(&self, index: u32) -> u32 {
        match self.values.get(index as usize) {
            Some(Value::List { end } | Value::Typed { end }) => *end,
            _ => index + 1,
        }
    }
}

/// An entity of a file.
#[derive(Clone, Copy)]
pub(crate) struct Instance<'e> {
    file: &'e Exchange<'e>,
    entity: Entity,
}

impl<'e> Instance<'e> {
    /// Its number.
    pub fn number(self) -> u64 {
        self.entity.number
    }

    /// The line on which it begins.
    pub fn line(self) -> usize {
        self.entity.line as usize
    }

    fn raw_leaves(self) -> impl Iterator<Item = &'e Leaf> {
        let range = self.entity.first as usize..self.entity.end as usize;
        self.file.leaves.get(range).unwrap_or_default().iter()
    }

    /// Its leaves in the order in which they are written.
    pub fn leaves(self) -> impl Iterator<Item = Record<'e>> {
        self.raw_leaves().map(move |leaf| Record {
            instance: self,
            leaf: *leaf,
        })
    }

    /// Its leaf of this keyword.
    pub fn leaf(self, keyword: &str) -> Option<Record<'e>> {
        self.leaves().find(|leaf| leaf.keyword() == keyword)
    }

    /// True where it has a leaf of this keyword.
    pub fn is(self, keyword: &str) -> bool {
        self.leaf(keyword).is_some()
    }

    /// Its leaf of this keyword.
    ///
    /// # Errors
    /// Where it has none: `needed` says what it should have been.
    pub fn expect(self, keyword: &str, needed: &'static str) -> Result<Record<'e>, StepError> {
        self.leaf(keyword).ok_or_else(|| self.wrong_kind(needed))
    }

    /// Its keywords, for messages.
    pub fn keywords(self) -> String {
        let words: Vec<&str> = self.leaves().map(Record::keyword).collect();
        words.join(" ")
    }

    /// An error that says that this entity is of the wrong kind.
    pub fn wrong_kind(self, needed: &'static str) -> StepError {
        let found = shortened(&self.keywords());
        self.error(Problem::Kind { needed, found })
    }

    /// An error about the geometry that this entity says.
    pub fn geometry(self, needed: &'static str, found: impl Into<String>) -> StepError {
        self.error(Problem::Geometry {
            needed,
            found: found.into(),
        })
    }

    /// An error at this entity.
    pub fn error(self, problem: Problem) -> StepError {
        StepError::at(self.line(), Some(self.entity.number), problem)
    }
}

/// A leaf of an entity: a keyword with its parameters.
#[derive(Clone, Copy)]
pub(crate) struct Record<'e> {
    instance: Instance<'e>,
    leaf: Leaf,
}

impl<'e> Record<'e> {
    /// The entity that this is a leaf of.
    pub fn instance(self) -> Instance<'e> {
        self.instance
    }

    /// Number of the entity.
    pub fn number(self) -> u64 {
        self.instance.number()
    }

    /// Its keyword in capitals.
    pub fn keyword(self) -> &'e str {
        let file = self.instance.file;
        file.keywords
            .get(self.leaf.keyword as usize)
            .map_or("", String::as_str)
    }

    /// Its parameters in their order.
    pub fn items(self) -> impl Iterator<Item = Item<'e>> {
        items(self.instance.file, self.leaf.first, self.leaf.end)
    }

    /// How many parameters it has.
    pub fn len(self) -> usize {
        self.items().count()
    }

    /// The parameter at this place, from 0; `None` beyond the last.
    pub fn item(self, place: usize) -> Option<Item<'e>> {
        self.items().nth(place)
    }

    /// True where the parameter at this place is missing, `$` or `*`.
    pub fn is_unset(self, place: usize) -> bool {
        self.item(place).is_none_or(Item::is_unset)
    }

    /// The error that the parameter at this place is not what was needed.
    pub fn wrong(self, place: usize, needed: &'static str) -> StepError {
        self.instance.error(Problem::Parameter {
            keyword: shortened(self.keyword()),
            position: place + 1,
            needed,
            found: self.item(place).map_or("nothing".to_owned(), Item::shown),
        })
    }

    /// The number at this place, behind the name of its type or not.
    ///
    /// # Errors
    /// Where something else stands there.
    pub fn number_at(self, place: usize) -> Result<f64, StepError> {
        let item = self.item(place);
        item.and_then(Item::number)
            .ok_or_else(|| self.wrong(place, "a number"))
    }

    /// The text at this place; empty where it is not given.
    pub fn text_at(self, place: usize) -> String {
        self.item(place).and_then(Item::text).unwrap_or_default()
    }

    /// The truth value at this place.
    ///
    /// # Errors
    /// Where neither `.T.` nor `.F.` stands there.
    pub fn truth_at(self, place: usize) -> Result<bool, StepError> {
        match self.item(place).and_then(Item::enumeration) {
            Some(b"T") => Ok(true),
            Some(b"F") => Ok(false),
            _ => Err(self.wrong(place, "`.T.` or `.F.`")),
        }
    }

    /// The entity that the parameter at this place refers to.
    ///
    /// # Errors
    /// Where no reference stands there, or one to nothing.
    pub fn entity_at(self, place: usize) -> Result<Instance<'e>, StepError> {
        let item = self.item(place);
        let number = item
            .and_then(Item::reference)
            .ok_or_else(|| self.wrong(place, "a reference"))?;
        self.resolve(number)
    }

    /// The entities that the list at this place refers to.
    ///
    /// # Errors
    /// Where no list of references stands there, or one of them refers to nothing.
    pub fn entities_at(self, place: usize) -> Result<Vec<Instance<'e>>, StepError> {
        let needed = "a list of references";
        let list = self.item(place).and_then(Item::list);
        let list = list.ok_or_else(|| self.wrong(place, needed))?;
        list.map(|item| {
            let number = item.reference();
            self.resolve(number.ok_or_else(|| self.wrong(place, needed))?)
        })
        .collect()
    }

    /// The numbers in the list at this place.
    ///
    /// # Errors
    /// Where no list of numbers stands there.
    pub fn numbers_at(self, place: usize) -> Result<Vec<f64>, StepError> {
        let needed = "a list of numbers";
        let list = self.item(place).and_then(Item::list);
        let list = list.ok_or_else(|| self.wrong(place, needed))?;
        list.map(|item| item.number().ok_or_else(|| self.wrong(place, needed)))
            .collect()
    }

    /// The entity of a number that this one refers to.
    ///
    /// # Errors
    /// Where there is none.
    pub fn resolve(self, number: u64) -> Result<Instance<'e>, StepError> {
        let found = self.instance.file.find(number);
        found.ok_or_else(|| self.instance.error(Problem::Unresolved { to: number }))
    }
}

/// A value in a file.
#[derive(Clone, Copy)]
pub(crate) struct Item<'e> {
    file: &'e Exchange<'e>,
    index: u32,
    value: Value,
}

/// The values from one place to another, without those that they hold.
fn items<'e>(file: &'e Exchange<'e>, first: u32, end: u32) -> impl Iterator<Item = Item<'e>> {
    let mut at = first;
    std::iter::from_fn(move || {
        let value = *file.values.get(at as usize)?;
        if at >= end {
            return None;
        }
        let item = Item {
            file,
            index: at,
            value,
        };
        at = file.behind(at);
        Some(item)
    })
}

impl<'e> Item<'e> {
    /// True for `$` and `*`.
    pub fn is_unset(self) -> bool {
        matches!(self.value, Value::Unset | Value::Derived)
    }

    /// The number, behind the name of its type or not.
    pub fn number(self) -> Option<f64> {
        match self.bare().value {
            Value::Number(number) => Some(number),
            _ => None,
        }
    }

    /// The number of the entity that is referred to.
    pub fn reference(self) -> Option<u64> {
        match self.value {
            Value::Reference(number) => Some(number),
            _ => None,
        }
    }

    /// The string, decoded.
    pub fn text(self) -> Option<String> {
        match self.bare().value {
            Value::Text(span) => Some(text::decoded(span.of(self.file.text))),
            _ => None,
        }
    }

    /// What stands between the dots of an enumeration.
    pub fn enumeration(self) -> Option<&'e [u8]> {
        match self.bare().value {
            Value::Enumeration(span) => Some(span.of(self.file.text)),
            _ => None,
        }
    }

    /// What a list holds.
    pub fn list(self) -> Option<impl Iterator<Item = Item<'e>>> {
        match self.value {
            Value::List { end } => Some(items(self.file, self.index + 1, end)),
            _ => None,
        }
    }

    /// The value without the name of its type.
    fn bare(self) -> Self {
        match self.value {
            Value::Typed { end } => items(self.file, self.index + 1, end).next().unwrap_or(self),
            _ => self,
        }
    }

    /// The value for a message.
    fn shown(self) -> String {
        let text = self.file.text;
        match self.value {
            Value::Number(number) => format!("the number {number}"),
            Value::Reference(number) => format!("a reference to #{number}"),
            Value::Text(span) => {
                format!("the string '{}'", shortened(&text::decoded(span.of(text))))
            }
            Value::Enumeration(span) => {
                let word = String::from_utf8_lossy(span.of(text));
                format!("`.{}.`", shortened(&word))
            }
            Value::Binary => "a binary value".to_owned(),
            Value::Unset => "`$`, a value that is not given".to_owned(),
            Value::Derived => "`*`".to_owned(),
            Value::List { .. } => "a list".to_owned(),
            Value::Typed { .. } => "a value with the name of its type".to_owned(),
        }
    }
}
