//! Names and what they stand for: tables that see what is in the tables around them.

use super::Place;
use super::text::Text;
use super::value::Value;
use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

/// Names defined in one place: a file, a macro call, a namespace.
#[derive(Default)]
pub(super) struct Table {
    names: RefCell<HashMap<Rc<str>, Entry>>,
    parent: Option<Rc<Table>>,
    /// Tables around this one.
    depth: usize,
    pub(super) is_namespace: bool,
}

/// What is known of a name.
#[derive(Clone)]
pub(super) enum Entry {
    Ready(Value),
    /// Text that is evaluated when it is first asked for.
    Lazy(Text, Place),
    /// Under evaluation.
    Busy,
}

impl Table {
    pub(super) fn inside(parent: &Rc<Table>) -> Rc<Self> {
        Rc::new(Self {
            parent: Some(parent.clone()),
            depth: parent.depth + 1,
            ..Self::default()
        })
    }

    pub(super) fn namespace(parent: Option<&Rc<Table>>) -> Rc<Self> {
        Rc::new(Self {
            parent: parent.cloned(),
            depth: parent.map_or(0, |parent| parent.depth + 1),
            is_namespace: true,
            ..Self::default()
        })
    }

    pub(super) fn parent(&self) -> Option<&Rc<Table>> {
        self.parent.as_ref()
    }

    /// What looking for a name costs in steps: a table is asked in a sixteenth of the time that an operation takes.
    pub(super) fn level(&self) -> usize {
        self.depth / 16
    }

    pub(super) fn set(&self, name: &str, entry: Entry) {
        self.names.borrow_mut().insert(name.into(), entry);
    }

    pub(super) fn set_value(&self, name: &str, value: Value) {
        self.set(name, Entry::Ready(value));
    }

    /// What this table itself says of a name.
    pub(super) fn own(&self, name: &str) -> Option<Entry> {
        self.names.borrow().get(name).cloned()
    }

    /// The nearest table that knows the name.
    pub(super) fn owner(self: &Rc<Self>, name: &str) -> Option<Rc<Self>> {
        let mut table = Some(self);
        while let Some(own) = table {
            if own.names.borrow().contains_key(name) {
                return Some(own.clone());
            }
            table = own.parent.as_ref();
        }
        None
    }

    /// What is known of a name here or around.
    pub(super) fn find(self: &Rc<Self>, name: &str) -> Option<Entry> {
        self.owner(name)?.own(name)
    }

    /// The outermost table.
    pub(super) fn top(self: &Rc<Self>) -> Rc<Self> {
        let mut table = self;
        while let Some(parent) = &table.parent {
            table = parent;
        }
        table.clone()
    }

    /// Forgets a name here and in every table around.
    pub(super) fn remove(self: &Rc<Self>, name: &str) {
        let mut table = Some(self);
        while let Some(own) = table {
            own.names.borrow_mut().remove(name);
            table = own.parent.as_ref();
        }
    }

    /// All names that are known here, sorted; for suggestions.
    pub(super) fn known(self: &Rc<Self>) -> Vec<String> {
        let mut all = Vec::new();
        let mut table = Some(self);
        while let Some(own) = table {
            let names = own.names.borrow();
            all.extend(
                names
                    .keys()
                    .filter(|name| !name.starts_with('*'))
                    .map(ToString::to_string),
            );
            table = own.parent.as_ref();
        }
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Forgets everything: namespaces know their surroundings and these know them, a circle that would never be freed.
    pub(super) fn clear(&self) {
        self.names.borrow_mut().clear();
    }
}
