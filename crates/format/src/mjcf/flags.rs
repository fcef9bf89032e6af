//! `<option><flag>`: what a file switches off as a whole. MuJoCo heeds, for each flag, the last element that names it.

use super::Mjcf;
use crate::WarningKind;
use crate::element::Element;
use crate::words::quoted;

/// Flags by which constraints and motors do nothing.
#[derive(Clone, Copy, Default)]
pub(super) struct SwitchedOff {
    equality: bool,
    limit: bool,
    actuation: bool,
    /// All constraints, equalities and limits among them.
    constraint: bool,
}

impl SwitchedOff {
    fn read(&mut self, flag: Element<'_>) {
        for (name, own) in [
            ("equality", &mut self.equality),
            ("limit", &mut self.limit),
            ("actuation", &mut self.actuation),
            ("constraint", &mut self.constraint),
        ] {
            if let Some(says) = flag.attribute(name) {
                *own = says.value == "disable";
            }
        }
    }

    /// Whether no equality holds.
    pub(super) fn equalities(&self) -> bool {
        self.equality || self.constraint
    }

    /// Whether no joint has limits.
    pub(super) fn limits(&self) -> bool {
        self.limit || self.constraint
    }

    /// Whether no motor acts.
    pub(super) fn motors(&self) -> bool {
        self.actuation
    }
}

impl<'a> Mjcf<'a> {
    /// Reads the flags of the whole file, and tells what they switch off.
    pub(super) fn flags(&mut self, root: Element<'a>) {
        let sections = |name: &'static str| root.elements().filter(move |e| e.name() == name);
        let inside = |name: &'static str| sections(name).flat_map(|section| section.elements());
        let mut last = None;
        for flag in inside("option").filter(|part| part.name() == "flag") {
            self.switched_off.read(flag);
            last = Some(flag.start());
        }
        let Some(at) = last else {
            return;
        };
        let off = self.switched_off;
        let equalities = inside("equality").count();
        if off.equalities() && equalities > 0 {
            let flag = match off.equality {
                true => "equality",
                false => "constraint",
            };
            let message = format!(
                "the flag {} switches all equalities of the file off ({equalities}): none is read",
                quoted(flag)
            );
            let kind = WarningKind::ReadersDiffer {
                what: "flag".to_owned(),
            };
            self.warnings.push((at, kind, message));
        }
        if off.limits() {
            let what = "limits of joints, which a <flag> switches off".to_owned();
            self.unread.text(at, what);
        }
        if off.motors() && inside("actuator").next().is_some() {
            let what = "actuators, which a <flag> switches off".to_owned();
            self.unread.text(at, what);
        }
    }
}
