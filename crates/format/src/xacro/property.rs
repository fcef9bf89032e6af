//! `<xacro:property>`.

use super::element::Element;
use super::expand::Names;
use super::scope::Entry;
use super::value::Value;
use super::{Outcome, Run, Trouble, arguments};
use crate::number_text::is_identifier;
use crate::words::quoted;
use std::rc::Rc;

impl Run<'_> {
    /// A name for a value, a text or, without either, for the elements inside.
    pub(super) fn define_property(&mut self, element: &Rc<Element>, names: &Names) -> Outcome<()> {
        let name = self.required(element, "name")?.clone();
        let text = self.attribute_text(&name, names)?;
        let key = text.as_str();
        if !is_identifier(key) || key.starts_with("__") {
            return Err(Trouble::new(format!(
                "{} cannot be used in an expression",
                quoted(key)
            ))
            .help(
                "names are letters, digits and underscores, start with a letter, and not with two underscores",
            )
            .at(name.place, self.call));
        }
        let symbols = &names.symbols;
        self.spend(symbols.level())?;
        if let Some(remove) = element.attribute("remove")
            && self.attribute_truth(remove, names)?
        {
            symbols.remove(key);
            return Ok(());
        }
        let scope = element.attribute("scope").map(|scope| scope.value.as_str());
        let is_top = symbols.parent().is_none() || scope == Some("global");
        let given = element.attribute("value");
        let default = element.attribute("default");
        if given.is_some() && default.is_some() {
            return Err(Trouble::new(format!(
                "the property {} has both a value and a default",
                quoted(key)
            )));
        }
        if default.is_some() && symbols.owner(key).is_some() {
            return Ok(());
        }
        let target = match scope {
            Some("global") => symbols.top(),
            Some("parent") => {
                let mut parent = symbols.parent().unwrap_or(symbols);
                // Out of a macro, into the caller's names, not those of the macro's namespace.
                while !symbols.is_namespace && parent.is_namespace {
                    match parent.parent() {
                        Some(outer) => parent = outer,
                        None => break,
                    }
                }
                parent.clone()
            }
            _ => symbols.clone(),
        };
        let Some(value) = given.or(default) else {
            target.set_value(&format!("**{key}"), Value::Block(element.clone()));
            return Ok(());
        };
        if is_top && let Some(setting) = self.setting(key) {
            let value = Value::literal(&arguments::setting(&setting));
            let value = self.kept_symbolic(key, value)?;
            target.set_value(key, value);
            return Ok(());
        }
        let is_lazy = match element.attribute("lazy_eval") {
            Some(lazy) => self.attribute_truth(lazy, names)?,
            None => true,
        };
        let entry = if is_lazy && !matches!(scope, Some("global" | "parent")) {
            match Value::literal(&value.value) {
                Value::Text(text) if text.as_str().contains('$') => Entry::Lazy(text, value.place),
                // Read again at its first use, so that quotes around a number do not make it a text.
                Value::Text(text) => Entry::Ready(Value::literal(&text)),
                literal => Entry::Ready(literal),
            }
        } else {
            Entry::Ready(match self.substitute(&value.value, value.place, symbols)? {
                Value::Text(text) => Value::literal(&text),
                other => other,
            })
        };
        let entry = match entry {
            Entry::Ready(value) => Entry::Ready(self.kept_symbolic(key, value)?),
            lazy => lazy,
        };
        if is_top {
            self.met_names.insert(key.to_owned());
        }
        target.set(key, entry);
        Ok(())
    }

    /// The setting for a property.
    fn setting(&mut self, name: &str) -> Option<String> {
        let (_, value) = self
            .options
            .settings
            .iter()
            .rev()
            .find(|(own, _)| own == name)?;
        self.met_names.insert(name.to_owned());
        Some(value.clone())
    }
}
