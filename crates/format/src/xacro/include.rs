//! `<xacro:include>`.

use super::element::Element;
use super::expand::{Making, Names};
use super::files::MOST_NESTED;
use super::glob;
use super::scope::Table;
use super::value::Value;
use super::{Outcome, Run, Sort, Trouble};
use std::path::PathBuf;
use std::rc::Rc;

impl Run<'_> {
    /// What is inside the robot of another file, or of all that fit a pattern.
    pub(super) fn include(
        &mut self,
        element: &Rc<Element>,
        names: &Names,
        making: &mut Making,
    ) -> Outcome<()> {
        self.spend(10)?;
        let file = self.required(element, "filename")?;
        let written = self.attribute_text(file, names)?;
        let optional = match element.attribute("optional") {
            Some(optional) => self.attribute_truth(optional, names)?,
            None => false,
        };
        let inner = match element.attribute("ns") {
            Some(space) => {
                let space = self.attribute_text(space, names)?;
                self.namespace(space.as_str(), names)
            }
            None => names.clone(),
        };
        let here = (file.place, self.call);
        let paths = match self.included(written.as_str()) {
            Err(trouble) if optional && trouble.kind == Sort::File => return Ok(()),
            paths => paths.map_err(|trouble| trouble.at(here.0, here.1))?,
        };
        for path in paths {
            let opened = match self.open(&path) {
                Err(trouble) if optional && trouble.kind == Sort::File => continue,
                opened => opened.map_err(|trouble| trouble.at(here.0, here.1))?,
            };
            if self.file_stack.len() >= MOST_NESTED {
                return Err(Trouble::new(format!(
                    "files include each other more than {MOST_NESTED} levels deep"
                ))
                .help("does a file include itself?")
                .at(here.0, here.1));
            }
            self.file_stack.push(opened);
            let root = self.files.root(opened);
            let result = self.expand_apart(&root.children, &inner, making);
            self.file_stack.pop();
            result?;
        }
        Ok(())
    }

    /// A namespace for what an include defines.
    fn namespace(&mut self, space: &str, names: &Names) -> Names {
        let inner = Names {
            macros: Table::namespace(None),
            symbols: Table::namespace(Some(&names.symbols)),
        };
        names
            .macros
            .set_value(space, Value::Namespace(inner.macros.clone()));
        names
            .symbols
            .set_value(space, Value::Namespace(inner.symbols.clone()));
        self.namespaces
            .extend([inner.macros.clone(), inner.symbols.clone()]);
        inner
    }

    /// The files that a name means: itself, or in order all that fit it.
    fn included(&mut self, written: &str) -> Outcome<Vec<PathBuf>> {
        let path = self.resolved(written)?;
        if written.contains(['*', '[', '?']) {
            return glob::matching(&path, &mut self.budget);
        }
        Ok(vec![path])
    }
}
