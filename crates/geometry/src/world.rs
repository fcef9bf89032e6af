//! A store of entities that keeps names unique and lets no reference dangle.

use crate::entity::Entity;
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fmt;

/// Where an entity is kept. It never stands for another one: the place of a deleted entity is used again under a new
/// generation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Id {
    place: usize,
    generation: u64,
}

/// Why something cannot be stored, named or deleted.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum WorldError {
    /// A name that another entity has.
    NameTaken(String),
    /// A name without a letter.
    NoName,
    /// An id of an entity that was deleted.
    Deleted(Id),
    /// An entity that others are made from.
    InUse {
        /// Its name.
        name: String,
        /// The names of those made from it.
        by: Vec<String>,
    },
}

impl fmt::Display for WorldError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NameTaken(name) => {
                write!(
                    f,
                    "needed a name that no entity has, found `{name}`: rename one of both"
                )
            }
            Self::NoName => f.write_str("needed a name, found an empty one"),
            Self::Deleted(id) => write!(
                f,
                "needed an entity, found the place {} of one that was deleted",
                id.place
            ),
            Self::InUse { name, by } => write!(
                f,
                "needed an entity that no other is made from, found `{name}`, of which {} made: delete these first, or all at once",
                match by.as_slice() {
                    [one] => format!("`{one}` is"),
                    more => format!("`{}` are", more.join("`, `")),
                }
            ),
        }
    }
}

impl Error for WorldError {}

#[derive(Clone, Debug)]
struct Stored<S> {
    name: String,
    entity: Entity<S>,
    made_from: Vec<Id>,
}

#[derive(Clone, Debug)]
struct Slot<S> {
    generation: u64,
    stored: Option<Stored<S>>,
}

/// Entities by name and by [`Id`]. An entity may say which others it was made from; those stay while it does.
#[derive(Clone, Debug)]
pub struct World<S> {
    slots: Vec<Slot<S>>,
    free: Vec<usize>,
    names: BTreeMap<String, Id>,
}

impl<S> Default for World<S> {
    fn default() -> Self {
        Self {
            slots: Vec::new(),
            free: Vec::new(),
            names: BTreeMap::new(),
        }
    }
}

impl<S> World<S> {
    /// A world without entities.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// How many entities there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.names.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.names.is_empty()
    }

    /// Stores an entity under a name.
    ///
    /// # Errors
    /// Where the name is empty or taken.
    pub fn store(&mut self, name: &str, entity: impl Into<Entity<S>>) -> Result<Id, WorldError> {
        self.store_made_from(name, entity, &[])
    }

    /// Stores an entity that was made from others, which cannot be deleted before it.
    ///
    /// # Errors
    /// Where the name is empty or taken, or one of the others was deleted; nothing is stored then.
    pub fn store_made_from(
        &mut self,
        name: &str,
        entity: impl Into<Entity<S>>,
        others: &[Id],
    ) -> Result<Id, WorldError> {
        self.check_name(name)?;
        for other in others {
            self.stored(*other)?;
        }
        let stored = Stored {
            name: name.to_owned(),
            entity: entity.into(),
            made_from: others.to_vec(),
        };
        let id = self.place(stored);
        self.names.insert(name.to_owned(), id);
        Ok(id)
    }

    fn place(&mut self, stored: Stored<S>) -> Id {
        while let Some(place) = self.free.pop() {
            if let Some(slot) = self.slots.get_mut(place) {
                slot.stored = Some(stored);
                return Id {
                    place,
                    generation: slot.generation,
                };
            }
        }
        self.slots.push(Slot {
            generation: 0,
            stored: Some(stored),
        });
        Id {
            place: self.slots.len() - 1,
            generation: 0,
        }
    }

    fn check_name(&self, name: &str) -> Result<(), WorldError> {
        match name {
            _ if name.trim().is_empty() => Err(WorldError::NoName),
            _ if self.names.contains_key(name) => Err(WorldError::NameTaken(name.to_owned())),
            _ => Ok(()),
        }
    }

    fn stored(&self, id: Id) -> Result<&Stored<S>, WorldError> {
        self.slots
            .get(id.place)
            .filter(|slot| slot.generation == id.generation)
            .and_then(|slot| slot.stored.as_ref())
            .ok_or(WorldError::Deleted(id))
    }

    /// The entity; `None` where it was deleted.
    #[must_use]
    pub fn get(&self, id: Id) -> Option<&Entity<S>> {
        self.stored(id).ok().map(|stored| &stored.entity)
    }

    /// The name of an entity; `None` where it was deleted.
    #[must_use]
    pub fn name(&self, id: Id) -> Option<&str> {
        self.stored(id).ok().map(|stored| stored.name.as_str())
    }

    /// The entity of a name.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<Id> {
        self.names.get(name).copied()
    }

    /// All entities in the order of their names.
    pub fn iter(&self) -> impl Iterator<Item = (&str, Id, &Entity<S>)> {
        self.names
            .iter()
            .filter_map(|(name, id)| Some((name.as_str(), *id, self.get(*id)?)))
    }

    /// Gives an entity another name.
    ///
    /// # Errors
    /// Where it was deleted, or the name is empty or another's.
    pub fn rename(&mut self, id: Id, name: &str) -> Result<(), WorldError> {
        let old = self.stored(id)?.name.clone();
        if old == name {
            return Ok(());
        }
        self.check_name(name)?;
        self.names.remove(&old);
        self.names.insert(name.to_owned(), id);
        if let Some(stored) = self.slots.get_mut(id.place).and_then(|s| s.stored.as_mut()) {
            name.clone_into(&mut stored.name);
        }
        Ok(())
    }

    /// Those that were made from an entity, directly, in the order of their names.
    #[must_use]
    pub fn made_from(&self, id: Id) -> Vec<Id> {
        let uses = |other: &&Id| {
            self.stored(**other)
                .is_ok_and(|stored| stored.made_from.contains(&id))
        };
        self.names.values().filter(uses).copied().collect()
    }

    /// Whether an entity was made from another one, directly.
    #[must_use]
    pub fn is_made_from(&self, id: Id, other: Id) -> bool {
        self.stored(id)
            .is_ok_and(|stored| stored.made_from.contains(&other))
    }

    /// Deletes an entity that no other is made from, and gives it back.
    ///
    /// # Errors
    /// Where it was deleted already, or is in use.
    pub fn delete(&mut self, id: Id) -> Result<Entity<S>, WorldError> {
        let name = self.stored(id)?.name.clone();
        let by: Vec<String> = self
            .made_from(id)
            .into_iter()
            .filter_map(|other| self.name(other).map(str::to_owned))
            .collect();
        if !by.is_empty() {
            return Err(WorldError::InUse { name, by });
        }
        self.take(id).ok_or(WorldError::Deleted(id))
    }

    /// Deletes an entity and everything made from it, and says how many they were.
    ///
    /// # Errors
    /// Where it was deleted already.
    pub fn delete_with_all_made_from_it(&mut self, id: Id) -> Result<usize, WorldError> {
        self.stored(id)?;
        let mut doomed = BTreeSet::from([id]);
        let mut open = vec![id];
        while let Some(next) = open.pop() {
            for other in self.made_from(next) {
                if doomed.insert(other) {
                    open.push(other);
                }
            }
        }
        Ok(doomed
            .into_iter()
            .filter_map(|other| self.take(other))
            .count())
    }

    fn take(&mut self, id: Id) -> Option<Entity<S>> {
        let slot = self
            .slots
            .get_mut(id.place)
            .filter(|slot| slot.generation == id.generation)?;
        let stored = slot.stored.take()?;
        slot.generation += 1;
        self.free.push(id.place);
        self.names.remove(&stored.name);
        Some(stored.entity)
    }
}
