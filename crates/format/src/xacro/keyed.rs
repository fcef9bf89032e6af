//! Sets and dictionaries: items in the order in which they came, found by their keys at once.

use super::Outcome;
use super::budget::Budget;
use super::comparison::equals;
use super::value::{Kind, Value};
use std::collections::HashMap;
use std::ops::Deref;
use std::rc::Rc;

/// What has a key: an item of a set is its own, an item of a dictionary begins with it.
pub(super) trait Item {
    fn key(&self) -> &Value;
    /// Takes over from a later item with an equal key.
    fn update(&mut self, later: Self);
}

impl Item for Value {
    fn key(&self) -> &Value {
        self
    }

    fn update(&mut self, _: Self) {}
}

impl Item for (Value, Value) {
    fn key(&self) -> &Value {
        &self.0
    }

    fn update(&mut self, later: Self) {
        self.1 = later.1;
    }
}

/// What a key is found by: equal for two values exactly if these are equal.
#[derive(PartialEq, Eq, Hash)]
enum Hashed {
    None,
    Whole(i128),
    Double(u64),
    Text(Rc<str>),
}

impl Hashed {
    /// None for tuples and whatever else is rare as a key: these are compared one by one.
    fn of(key: &Value) -> Option<Self> {
        if let Some(number) = key.number() {
            return Some(match number.kind {
                Kind::Int(value) => Self::Whole(value),
                // Doubles up to 2^120 are exact integers of 128 bits.
                Kind::Float(value) if value.fract() == 0.0 && value.abs() < 1e36 => {
                    Self::Whole(value as i128)
                }
                Kind::Float(value) => Self::Double(value.to_bits()),
            });
        }
        match key {
            Value::None => Some(Self::None),
            Value::Text(text) => Some(Self::Text(text.shared())),
            _ => None,
        }
    }
}

/// Items of which no two have equal keys.
pub(super) struct Keyed<T> {
    items: Vec<T>,
    places: HashMap<Hashed, usize>,
    /// Places of the items whose keys are compared one by one.
    others: Vec<usize>,
}

impl<T> Default for Keyed<T> {
    fn default() -> Self {
        Self {
            items: Vec::new(),
            places: HashMap::new(),
            others: Vec::new(),
        }
    }
}

impl<T> Deref for Keyed<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.items
    }
}

impl<T: Item> Keyed<T> {
    /// Of two items with equal keys the later holds, in the place of the earlier.
    pub(super) fn collect(
        items: impl IntoIterator<Item = T>,
        budget: &mut Budget,
    ) -> Outcome<Rc<Self>> {
        let mut all = Self::default();
        for item in items {
            all.add(item, budget)?;
        }
        Ok(Rc::new(all))
    }

    fn add(&mut self, item: T, budget: &mut Budget) -> Outcome<()> {
        let known = self.place(item.key(), budget)?;
        if let Some(own) = known.and_then(|place| self.items.get_mut(place)) {
            own.update(item);
            return Ok(());
        }
        match Hashed::of(item.key()) {
            Some(hashed) => drop(self.places.insert(hashed, self.items.len())),
            None => self.others.push(self.items.len()),
        }
        self.items.push(item);
        Ok(())
    }

    /// The item with a key.
    pub(super) fn find(&self, key: &Value, budget: &mut Budget) -> Outcome<Option<&T>> {
        let place = self.place(key, budget)?;
        Ok(place.and_then(|place| self.items.get(place)))
    }

    fn place(&self, key: &Value, budget: &mut Budget) -> Outcome<Option<usize>> {
        key.known("a key")?;
        budget.spend(1)?;
        budget.spend_on(key)?;
        if let Some(hashed) = Hashed::of(key) {
            return Ok(self.places.get(&hashed).copied());
        }
        for place in &self.others {
            if let Some(own) = self.items.get(*place)
                && equals(own.key(), key, budget)?
            {
                return Ok(Some(*place));
            }
        }
        Ok(None)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::value::Num;
    use super::*;

    fn float(value: f64) -> Value {
        Value::Number(Num::float(value))
    }

    #[test]
    fn keys_are_equal_where_python_has_them_equal() {
        let mut budget = Budget::default();
        let pair = Value::Tuple([Value::int(1), Value::text("a")].into());
        let keys = [
            Value::int(1),
            Value::Bool(true),
            float(1.0),
            float(0.5),
            Value::text("1"),
            Value::None,
            pair.clone(),
            pair.clone(),
            float(-0.0),
            Value::int(0),
        ];
        let items = keys.into_iter().enumerate();
        let dictionary =
            Keyed::collect(items.map(|(at, key)| (key, Value::int(at))), &mut budget).unwrap();
        let values: Vec<f64> = dictionary
            .iter()
            .map(|(_, value)| value.number().unwrap().double())
            .collect();
        assert_eq!(values, [2.0, 3.0, 4.0, 5.0, 7.0, 9.0]);
        assert!(dictionary.find(&pair, &mut budget).unwrap().is_some());
        assert!(dictionary.find(&float(2.0), &mut budget).unwrap().is_none());
    }
}
