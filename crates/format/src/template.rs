//! A text that is read many times, with other values of its measures.

use super::content::{self, Content};
use super::error::FormatError;
use super::reader::Added;
use super::skeleton::Skeleton;
use super::{
    ReadOptions, Reading, Warning, guard, read_bytes_of, read_plain, understood,
    with_decimals_understood, xacro,
};
use kutzbach_model::mechanism::{Mechanism, Recognised};
use roxmltree::Document;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// The bytes of a file, parsed once where that can be kept: a text whose measures are `<xacro:property>` and `<xacro:arg>`. What
/// needs more of xacro (macros, conditions, files that it includes) is another text with other values, and read from its bytes each time.
///
/// What is read is, in every field and in every error, what [`read_bytes_of`] reads of the same bytes.
#[derive(Debug)]
pub struct Template<'t> {
    bytes: &'t [u8],
    file: &'t str,
    base: Option<&'t Path>,
    options: &'t ReadOptions,
    parsed: Option<Parsed<'t>>,
    /// Mechanisms that nobody looks at any more, of which the next ones are made: at most as many as threads that look at some.
    spares: Mutex<Vec<Mechanism>>,
}

/// What values of measures do not change.
#[derive(Debug)]
struct Parsed<'t> {
    text: &'t str,
    document: Box<Document<'t>>,
    /// About calls of macros that nobody defines.
    warnings: Vec<Warning>,
    /// The mechanism without the values of its expressions.
    skeleton: Option<Skeleton>,
}

impl<'t> Template<'t> {
    /// Parses a file, as [`read_bytes_of`] does. What is wrong with it is told when it is read.
    #[must_use]
    pub fn new(
        bytes: &'t [u8],
        file: &'t str,
        base: Option<&'t Path>,
        options: &'t ReadOptions,
    ) -> Self {
        Self {
            bytes,
            file,
            base,
            options,
            parsed: parsed(bytes, file, options),
            spares: Mutex::new(Vec::new()),
        }
    }

    /// Whether it is parsed: no value of a measure makes another text of it.
    #[must_use]
    pub fn is_parsed(&self) -> bool {
        self.parsed.is_some()
    }

    /// Reads it with these values of measures after the settings among its options; of two settings with one name the later holds.
    ///
    /// # Errors
    /// As [`read_bytes_of`].
    pub fn read(&self, settings: &[(String, String)]) -> Result<Reading, FormatError> {
        let options = ReadOptions {
            settings: self.with_own(settings),
            ..self.options.clone()
        };
        let Some(parsed) = &self.parsed else {
            return read_bytes_of(self.bytes, self.file, self.base, &options);
        };
        let warnings = parsed.warnings.clone();
        let reading = read_plain(
            parsed.text,
            self.file,
            &options,
            warnings,
            Some(&parsed.document),
            &Added::default(),
        )?;
        Ok(understood(reading, &options))
    }

    /// Looks at the mechanism of [`Template::read`] where these values of measures make no more than other numbers in its joints; `None` where
    /// it has to be read. Those of one template have all else in common: names, links, kinds of joints, couplings.
    ///
    /// ```
    /// # mod kutzbach { pub use kutzbach_format as format; }
    /// use kutzbach::format::{ReadOptions, Template};
    ///
    /// let text = r#"<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
    ///   <xacro:property name="a" value="1"/> <link name="base"/> <link name="arm"/>
    ///   <joint name="hinge" type="revolute"> <parent link="base"/> <child link="arm"/>
    ///     <origin xyz="${1/a} 0 0"/> <axis xyz="0 0 1"/> </joint> </robot>"#;
    /// let options = ReadOptions::default();
    /// let template = Template::new(text.as_bytes(), "arm.urdf", None, &options);
    /// let place = |a: &str| {
    ///     let settings = [("a".to_owned(), a.to_owned())];
    ///     template.with_varied(&settings, |arm| arm.joints()[0].predecessor.frame.position[0].value())
    /// };
    /// assert_eq!(place("4"), Some(0.25));
    /// assert_eq!(place("0"), None);
    /// ```
    pub fn with_varied<T>(
        &self,
        settings: &[(String, String)],
        look: impl FnOnce(&Mechanism) -> T,
    ) -> Option<T> {
        let parsed = self.parsed.as_ref()?;
        let skeleton = parsed.skeleton.as_ref()?;
        let settings = self.with_own(settings);
        let spares = || self.spares.lock().unwrap_or_else(PoisonError::into_inner);
        let spare = spares().pop();
        let mechanism = skeleton.mechanism(&parsed.document, parsed.text, &settings, spare)?;
        let mechanism = with_decimals_understood(mechanism, self.options);
        let seen = look(&mechanism);
        // What was read as constants is not what is written any more.
        if *mechanism.recognised() == Recognised::default() {
            spares().push(mechanism);
        }
        Some(seen)
    }

    fn with_own(&self, settings: &[(String, String)]) -> Vec<(String, String)> {
        let own = self.options.settings.iter();
        own.chain(settings).cloned().collect()
    }
}

/// What can be kept of bytes; `None` where they are no text of this format, or not to be parsed, or have to be expanded.
fn parsed<'t>(bytes: &'t [u8], file: &str, options: &ReadOptions) -> Option<Parsed<'t>> {
    // Other bytes are refused, unpacked or told as faults with their places; that is not done twice.
    let is_other = guard::size_fault(bytes.len() as u64).is_some()
        || content::is_zip(bytes)
        || content::of_bytes(bytes).is_some();
    let text = guard::text_of(bytes).ok().filter(|_| !is_other)?;
    if !matches!(content::of(text), Content::Robot) {
        return None;
    }
    let (document, warnings) = xacro::parsed(text, file)?;
    Some(Parsed {
        text,
        skeleton: Skeleton::of(&document, text, options),
        document,
        warnings,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    const TEXT: &str = r#"<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:property name="lead" value="2"/>
  <link name="base"/> <link name="nut"><visual><xacro:paint/></visual></link>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="nut"/><origin xyz="${1/lead} 0 1.5707963267948966" rpy="0 0 1.5708"/><axis xyz="0 0 1"/>
  </joint>
</robot>"#;

    fn settings(value: &str) -> Vec<(String, String)> {
        vec![("lead".to_owned(), value.to_owned())]
    }

    /// Everything that a reading or an error says, as text.
    fn said(read: &Result<Reading, FormatError>) -> String {
        format!("{read:?}")
    }

    #[test]
    fn a_template_reads_what_the_bytes_are_read_as() {
        let macros = TEXT.replace("<xacro:paint/>", "").replace(
            "  <link name=\"base\"/>",
            "<xacro:if value=\"${lead > 3}\"><link name=\"more\"/></xacro:if><link name=\"base\"/>",
        );
        let plain = TEXT.replace("xacro", "other");
        let broken = TEXT.replace("</joint>", "");
        for (text, is_parsed) in [
            (TEXT, true),
            (macros.as_str(), false),
            (plain.as_str(), false),
            (broken.as_str(), false),
            ("PK\u{3}\u{4}", false),
            ("", false),
        ] {
            for options in [
                ReadOptions::default(),
                ReadOptions {
                    literal: true,
                    settings: settings("5"),
                    ..ReadOptions::default()
                },
                ReadOptions {
                    precision: Some(1e-6),
                    strict: true,
                    ..ReadOptions::default()
                },
            ] {
                let bytes = text.as_bytes();
                let template = Template::new(bytes, "r.urdf", None, &options);
                assert_eq!(template.is_parsed(), is_parsed, "{text}");
                for value in ["1", "4", "pi/4", "0", "1/", "lead"] {
                    let all = [options.settings.clone(), settings(value)].concat();
                    let with = ReadOptions {
                        settings: all,
                        ..options.clone()
                    };
                    let own = read_bytes_of(bytes, "r.urdf", None, &with);
                    let read = template.read(&settings(value));
                    assert_eq!(said(&read), said(&own), "{value}: {text}");
                    let look = |mechanism: &Mechanism| format!("{mechanism:?}");
                    if let Some(varied) = template.with_varied(&settings(value), look) {
                        let read = read.unwrap().mechanism;
                        assert_eq!(varied, look(&read), "{value}: {text}");
                    }
                }
                let varied = template.with_varied(&settings("4"), |_| ());
                // Read strictly, the call of a macro that nobody defines is an error whatever the values are.
                let readable = is_parsed && !options.strict;
                assert_eq!(varied.is_some(), readable, "{text}");
                let unknown = vec![("led".to_owned(), "1".to_owned())];
                assert!(template.read(&unknown).is_err());
            }
        }
    }

    #[test]
    fn what_other_values_could_decide_has_to_be_read() {
        let options = ReadOptions::default();
        let is_varied = |text: &str, value: &str| {
            let template = Template::new(text.as_bytes(), "r.urdf", None, &options);
            assert!(template.is_parsed(), "{text}");
            template.with_varied(&settings(value), |_| ()).is_some()
        };
        let tilted = TEXT.replace("xyz=\"0 0 1\"/>", "xyz=\"0 0 ${lead-3}\"/>");
        assert!(is_varied(TEXT, "4") && is_varied(&tilted, "4"));
        // The zero vector is refused, and what is too large, in the reader's words.
        assert!(!is_varied(&tilted, "3") && !is_varied(TEXT, "1/10**150"));
        let screw = "type=\"screw\"><screw lead=\"${lead}\"/>";
        let universal = "type=\"universal\"><axis2 xyz=\"1 0 ${lead}\"/>";
        let limited = "type=\"revolute\"><limit lower=\"0\" upper=\"${lead}\"/>";
        let heavy = "<visual/><inertial><mass value=\"${lead}\"/></inertial>";
        let coupled = "<coupling name=\"c\" ratio=\"2\"/><joint ";
        for (from, to) in [
            ("type=\"revolute\">", screw),
            ("type=\"revolute\">", universal),
            ("type=\"revolute\">", limited),
            ("<visual><xacro:paint/></visual>", heavy),
            ("<joint ", coupled),
            ("<joint ", "<gazebo/><joint "),
        ] {
            let other = TEXT.replace(from, to);
            assert_ne!(other, TEXT);
            assert!(!is_varied(&other, "4"), "{other}");
        }
    }
}
