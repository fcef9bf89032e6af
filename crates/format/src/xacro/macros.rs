//! `<xacro:macro>` and its calls.

use super::element::{Attribute, Element, Node};
use super::expand::{Level, Making, Names};
use super::leftover;
use super::scope::{Entry, Table};
use super::text::Text;
use super::value::Value;
use super::{Call, Outcome, Place, Run, Trouble};
use crate::words::{did_you_mean, quoted};
use std::rc::Rc;

/// A macro as it was defined.
pub(super) struct Macro {
    pub(super) element: Rc<Element>,
    parameters: Vec<Parameter>,
}

/// A parameter of a macro.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Parameter {
    /// With `*` or `**` before it where it is a block.
    name: String,
    /// `^`: the value of the same name where the macro is called.
    forwarded: bool,
    default: Option<String>,
}

/// Splits `a b:=1 c:=^ d:=^|2 *block **blocks`. A default goes to the next white space, except in `${...}`, `$(...)` and
/// quotes.
fn parameters(text: &str) -> Vec<Parameter> {
    let mut all = Vec::new();
    let mut rest = text.trim_start();
    while !rest.is_empty() {
        let name_end = rest
            .find(|c: char| c.is_whitespace() || c == ':' || c == '=')
            .unwrap_or(rest.len());
        let after = rest[name_end..].trim_start();
        let assigned = after.strip_prefix(":=").or_else(|| after.strip_prefix('='));
        let Some(assigned) = assigned.filter(|_| name_end > 0) else {
            let end = rest.find(char::is_whitespace).unwrap_or(rest.len());
            all.push(Parameter {
                name: rest[..end].to_owned(),
                forwarded: false,
                default: None,
            });
            rest = rest[end..].trim_start();
            continue;
        };
        let mut value = assigned.trim_start();
        let forwarded = value.starts_with('^');
        if forwarded {
            value = &value[1..];
            value = value.strip_prefix('|').unwrap_or(value);
        }
        let end = default_end(value);
        all.push(Parameter {
            name: rest[..name_end].to_owned(),
            forwarded,
            default: (end > 0).then(|| value[..end].to_owned()),
        });
        rest = value[end..].trim_start();
    }
    all
}

/// Where a default ends.
fn default_end(value: &str) -> usize {
    for (open, close) in [("${", '}'), ("$(", ')')] {
        if value.starts_with(open)
            && let Some(end) = value.find(close)
        {
            let end = end + 1;
            if value[end..].is_empty() || value[end..].starts_with(char::is_whitespace) {
                return end;
            }
        }
    }
    let mut quote = None;
    for (at, c) in value.char_indices() {
        match quote {
            Some(open) if c == open => quote = None,
            Some(_) => {}
            None if c.is_whitespace() => return at,
            None if c == '\'' || c == '"' => quote = Some(c),
            None => {}
        }
    }
    value.len()
}

impl Run<'_> {
    /// `<xacro:macro name params>`.
    pub(super) fn define_macro(&mut self, element: &Rc<Element>, names: &Names) -> Outcome<()> {
        let name = self.required(element, "name")?;
        let written = name.value.as_str();
        let name_text = written.strip_prefix("xacro:").unwrap_or(written);
        if name_text == "call" || name_text.contains('.') || name_text.is_empty() {
            return Err(Trouble::new(format!(
                "{} cannot be the name of a macro",
                quoted(name_text)
            ))
            .at(name.place, self.call));
        }
        let parameters = element
            .attribute("params")
            .map_or_else(Vec::new, |params| parameters(params.value.as_str()));
        self.macros.insert(name_text.to_owned());
        let defined = Macro {
            element: element.clone(),
            parameters,
        };
        names
            .macros
            .set_value(name_text, Value::Macro(Rc::new(defined)));
        Ok(())
    }

    /// The macro of a name, and the names that it sees: those of its namespace, or of the caller.
    fn find_macro(&mut self, full: &str, names: &Names) -> Option<(Rc<Macro>, Names)> {
        if let Some(Entry::Ready(Value::Macro(found))) = names.macros.find(full) {
            return Some((found, names.clone()));
        }
        let mut inner = names.clone();
        let (spaces, name) = full.rsplit_once('.')?;
        for space in spaces.split('.') {
            let Some(Entry::Ready(Value::Namespace(macros))) = inner.macros.find(space) else {
                return None;
            };
            let Some(Entry::Ready(Value::Namespace(symbols))) = inner.symbols.find(space) else {
                return None;
            };
            inner = Names { macros, symbols };
        }
        match inner.macros.find(name) {
            Some(Entry::Ready(Value::Macro(found))) => Some((found, inner)),
            _ => None,
        }
    }

    /// Whether an element without prefix looks like the call of a macro, and not like what a macro of its name writes.
    pub(super) fn is_like_call(&self, element: &Element, names: &Names) -> bool {
        let Some(Entry::Ready(Value::Macro(found))) = names.macros.find(&element.name) else {
            return false;
        };
        let mut call = self.call;
        while let Some(outer) = call.and_then(|call| self.calls.get(call as usize)) {
            if outer.name == *element.name {
                return false;
            }
            call = outer.parent;
        }
        let known = |name: &str| found.parameters.iter().any(|own| own.name == name);
        element.attributes.iter().all(|own| known(&own.name))
    }

    /// `<xacro:call macro="name">`: a macro whose name is computed.
    pub(super) fn call_by_name(
        &mut self,
        element: &Rc<Element>,
        names: &Names,
        making: &mut Making,
    ) -> Outcome<()> {
        let name = self.required(element, "macro")?.clone();
        let value = self.substitute(&name.value, name.place, &names.symbols)?;
        let value = self.paid_text(&value)?;
        let mut rest = Element {
            attributes: element.attributes.clone(),
            children: element.children.clone(),
            name: element.name.clone(),
            ..*element.as_ref()
        };
        rest.attributes.retain(|own| &*own.name != "macro");
        self.call_macro(&Rc::new(rest), value.as_str(), names, making)
    }

    /// `<xacro:name ...>`: the body of the macro, with its parameters.
    pub(super) fn call_macro(
        &mut self,
        element: &Rc<Element>,
        name: &str,
        names: &Names,
        making: &mut Making,
    ) -> Outcome<()> {
        self.spend(10 + (1 + name.len() / 64) * (1 + names.macros.level()))?;
        let Some((called, seen)) = self.find_macro(name, names) else {
            return self.unknown_macro(element, name, names, making);
        };
        let inner = Names {
            macros: Table::inside(&seen.macros),
            symbols: Table::inside(&seen.symbols),
        };
        let letters: usize = called.parameters.iter().map(|own| own.name.len()).sum();
        self.spend(called.parameters.len() + letters / 64)?;
        let mut open: Vec<&Parameter> = called.parameters.iter().collect();
        for attribute in &element.attributes {
            self.pass_attribute(attribute, &mut open, names, &inner, name, &called)?;
        }
        self.pass_blocks(element, &mut open, names, &inner, making)?;
        let definition = called.element.place;
        let mut missing = Vec::new();
        for parameter in open {
            if !self.pass_default(parameter, names, &inner, definition)? {
                missing.push(quoted(&parameter.name));
            }
        }
        if !missing.is_empty() {
            return Err(Trouble::new(format!(
                "the macro {} needs {}",
                quoted(name),
                missing.join(", ")
            ))
            .help("give each as an attribute, and each *block as an element inside"));
        }
        let outer = self.call;
        self.calls.push(Call {
            name: name.to_owned(),
            place: element.place,
            parent: outer,
        });
        self.call = u32::try_from(self.calls.len() - 1).ok();
        let result = self.expand_apart(&called.element.children, &inner, making);
        self.call = outer;
        result
    }

    /// Skips the call of a macro that nothing can have defined, where that may be left over; else it is an error.
    fn unknown_macro(
        &mut self,
        element: &Element,
        name: &str,
        names: &Names,
        making: &Making,
    ) -> Outcome<()> {
        let main = self.files.get(0);
        let is_plain = main.is_some_and(|file| leftover::is_plain(&file.name));
        if self.is_alone && (is_plain || making.level == Level::Link) {
            self.warn(element.place, self.call, leftover::told(&element.name));
            return Ok(());
        }
        Err(leftover::unknown(name, &names.macros.known()))
    }

    fn pass_attribute<'m>(
        &mut self,
        attribute: &Attribute,
        open: &mut Vec<&'m Parameter>,
        names: &Names,
        inner: &Names,
        name: &str,
        called: &'m Macro,
    ) -> Outcome<()> {
        let Some(at) = open.iter().position(|own| own.name == *attribute.name) else {
            let known = called.parameters.iter().map(|own| own.name.as_str());
            let shown = known.clone().map(quoted).collect::<Vec<_>>().join(", ");
            let near = did_you_mean(&attribute.name, known, ("`", "`"));
            return Err(Trouble::new(format!(
                "the macro {} has no parameter {}",
                quoted(name),
                quoted(&attribute.name)
            ))
            .help(match shown.as_str() {
                "" => "it has none".to_owned(),
                shown => format!("it has {shown}"),
            })
            .maybe_help(near)
            .at(attribute.place, self.call));
        };
        open.remove(at);
        let value = self.substitute(&attribute.value, attribute.place, &names.symbols)?;
        let value = match value {
            Value::Text(text) => Value::literal(&text),
            other => other,
        };
        inner.symbols.set_value(&attribute.name, value);
        Ok(())
    }

    /// The elements inside a call, evaluated where it stands, are the values of its blocks in turn.
    fn pass_blocks(
        &mut self,
        element: &Rc<Element>,
        open: &mut Vec<&Parameter>,
        names: &Names,
        inner: &Names,
        making: &Making,
    ) -> Outcome<()> {
        let mut evaluated = Making::inside(making);
        self.expand_all(&element.children, names, &mut evaluated)?;
        let mut blocks = evaluated.nodes.into_iter().filter_map(|node| match node {
            Node::Element(element) => Some(element),
            Node::Text(..) => None,
        });
        let mut kept = Vec::new();
        for parameter in open.drain(..) {
            if !parameter.name.starts_with('*') {
                kept.push(parameter);
                continue;
            }
            match blocks.next() {
                Some(block) => inner
                    .symbols
                    .set_value(&parameter.name, Value::Block(block)),
                None => kept.push(parameter),
            }
        }
        *open = kept;
        match blocks.next() {
            Some(block) => Err(Trouble::new(format!(
                "the macro takes no block here, found <{}>",
                block.name
            ))
            .help("a macro takes one element for each *block among its parameters")
            .at(block.place, self.call)),
            None => Ok(()),
        }
    }

    /// Gives a parameter its default; false where it has none.
    fn pass_default(
        &mut self,
        parameter: &Parameter,
        names: &Names,
        inner: &Names,
        definition: Place,
    ) -> Outcome<bool> {
        if parameter.forwarded
            && let Some(value) = self.lookup(&parameter.name, &names.symbols)?
        {
            let value = match value {
                Value::Text(text) => Value::literal(&text),
                other => other,
            };
            inner.symbols.set_value(&parameter.name, value);
            return Ok(true);
        }
        let Some(default) = &parameter.default else {
            return Ok(false);
        };
        let text = Text::plain(default);
        // The default stands somewhere among the parameters: told where the macro is defined.
        let value = match self.substitute(&text, definition, &names.symbols)? {
            Value::Text(text) => Value::literal(&text),
            other => other,
        };
        inner.symbols.set_value(&parameter.name, value);
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_have_defaults_with_blanks_and_quotes() {
        let shown: Vec<String> = parameters(
            "a b:=1 c:=^ d:=^|2  e:='x y' f:=${1 + 2} *g **h\n i = 3 j:=\"${a b}\"z k:=$(arg x)",
        )
        .into_iter()
        .map(|p| {
            format!(
                "{}{}{}",
                p.name,
                if p.forwarded { "^" } else { "" },
                match p.default {
                    Some(default) => format!("={default}"),
                    None => String::new(),
                }
            )
        })
        .collect();
        assert_eq!(
            shown,
            [
                "a",
                "b=1",
                "c^",
                "d^=2",
                "e='x y'",
                "f=${1 + 2}",
                "*g",
                "**h",
                "i=3",
                "j=\"${a b}\"z",
                "k=$(arg x)"
            ]
        );
        for text in ["", " ", "=", ":=", "a:=", "^", "a:=^|", "a:='", "=b", ": :"] {
            let _ = parameters(text);
        }
    }
}
