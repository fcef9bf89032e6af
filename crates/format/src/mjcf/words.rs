//! Words of the file that are not read: attributes that say how stiff, heavy to move or coloured something is, told once for each kind of element.
//!
//! MuJoCo refuses a file with an attribute that it does not know. Here one that is nearly a word that is read is an error, since it is probably that word;
//! another one is told.
//!
//! Source: the schema of MuJoCo 4.0.0.

use super::Mjcf;
use super::classes::ATTACHED;
use super::copies::COPY;
use super::keys::{BESIDE_POSES, OF_ALL, TAKEN};
use crate::element::Element;
use crate::error::Outcome;
use crate::unread::unknown_attribute;
use crate::words::quoted;
use std::collections::{BTreeMap, BTreeSet};

/// The attributes of an element: those that are read or told where they are, and those that say nothing of where it can go.
struct Words {
    read: &'static [&'static str],
    beside: &'static [&'static str],
}

const COMPILER: Words = Words {
    read: &[
        "angle",
        "eulerseq",
        "autolimits",
        "inertiafromgeom",
        "coordinate",
        "inertiagrouprange",
        "boundmass",
        "boundinertia",
        "balanceinertia",
        "settotalmass",
    ],
    beside: &[
        "strippath",
        "fitaabb",
        "meshdir",
        "texturedir",
        "assetdir",
        "discardvisual",
        "usethread",
        "fusestatic",
        "saveinertial",
        "alignfree",
        "conflict",
        "convexhull",
        "exactmeshinertia",
    ],
};

const BODY: Words = Words {
    read: &[
        "name",
        "class",
        "childclass",
        "pos",
        "quat",
        "axisangle",
        "xyaxes",
        "zaxis",
        "euler",
        "mocap",
    ],
    beside: &["gravcomp", "sleep", "simple", "user"],
};

const FRAME: Words = Words {
    read: &[
        "name",
        "childclass",
        "class",
        "pos",
        "quat",
        "axisangle",
        "xyaxes",
        "zaxis",
        "euler",
        "offset",
        COPY,
        ATTACHED,
    ],
    beside: &[],
};

const JOINT: Words = Words {
    read: &[
        "name",
        "class",
        "type",
        "pos",
        "axis",
        "limited",
        "range",
        "ref",
        "damping",
        "frictionloss",
        "stiffness",
        "springref",
        "springdamper",
    ],
    beside: &[
        "group",
        "actuatorfrclimited",
        "solreflimit",
        "solimplimit",
        "solreffriction",
        "solimpfriction",
        "actuatorfrcrange",
        "actuatorgravcomp",
        "margin",
        "armature",
        "user",
    ],
};

const FREE_JOINT: Words = Words {
    read: &["name", "class"],
    beside: &["group", "align"],
};

const GEOM: Words = Words {
    read: &[
        "name",
        "class",
        "type",
        "contype",
        "conaffinity",
        "group",
        "size",
        "mass",
        "density",
        "shellinertia",
        "fromto",
        "pos",
        "quat",
        "axisangle",
        "xyaxes",
        "zaxis",
        "euler",
        "mesh",
    ],
    beside: &[
        "condim",
        "priority",
        "material",
        "friction",
        "solmix",
        "solref",
        "solimp",
        "margin",
        "gap",
        "surfacevel",
        "adhesion",
        "hfield",
        "fitscale",
        "rgba",
        "fluidshape",
        "fluidcoef",
        "user",
    ],
};

const SITE: Words = Words {
    read: &[
        "name",
        "class",
        "pos",
        "quat",
        "axisangle",
        "xyaxes",
        "zaxis",
        "euler",
        "fromto",
    ],
    beside: &["type", "group", "material", "size", "rgba", "user"],
};

const INERTIAL: Words = Words {
    read: &[
        "pos",
        "quat",
        "mass",
        "diaginertia",
        "axisangle",
        "xyaxes",
        "zaxis",
        "euler",
        "fullinertia",
    ],
    beside: &[],
};

const EQUALITY: Words = Words {
    read: &[
        "name",
        "class",
        "active",
        "body1",
        "body2",
        "anchor",
        "site1",
        "site2",
        "relpose",
        "torquescale",
        "joint1",
        "joint2",
        "tendon1",
        "tendon2",
        "polycoef",
        "flex",
    ],
    beside: &["solref", "solimp"],
};

const TENDON: Words = Words {
    read: &["name", "class", "limited", "range"],
    beside: &[
        "group",
        "actuatorfrclimited",
        "actuatorfrcrange",
        "solreflimit",
        "solimplimit",
        "solreffriction",
        "solimpfriction",
        "frictionloss",
        "springlength",
        "width",
        "material",
        "margin",
        "stiffness",
        "damping",
        "armature",
        "rgba",
        "user",
    ],
};

const KEY: Words = Words {
    read: &["name", "qpos", ATTACHED, OF_ALL, TAKEN],
    beside: &["time"],
};

/// The words of an element in a section, and what the section is called there; `None` of what is told as a whole, or read elsewhere.
fn words_of(section: &str, name: &str) -> Option<(&'static Words, &'static str)> {
    Some(match (section, name) {
        (_, "compiler") => (&COMPILER, "<compiler>"),
        ("worldbody", "body") => (&BODY, "<body>"),
        ("worldbody", "frame") => (&FRAME, "<frame>"),
        ("worldbody" | "default", "joint") => (&JOINT, "<joint>"),
        ("worldbody", "freejoint") => (&FREE_JOINT, "<freejoint>"),
        ("worldbody" | "default", "geom") => (&GEOM, "<geom>"),
        ("worldbody" | "default", "site") => (&SITE, "<site>"),
        ("worldbody", "inertial") => (&INERTIAL, "<inertial>"),
        ("equality", "connect" | "weld" | "joint" | "tendon") | ("default", "equality") => {
            (&EQUALITY, "equalities")
        }
        ("tendon", "fixed" | "spatial") | ("default", "tendon") => (&TENDON, "tendons"),
        ("keyframe", "key") => (&KEY, "<key>"),
        _ => return None,
    })
}

/// The section that an element at the root begins.
fn section_of(name: &str) -> Option<&'static str> {
    let known = ["worldbody", "default", "equality", "tendon", "keyframe"];
    match name {
        ATTACHED => Some("default"),
        name => known.into_iter().find(|known| *known == name),
    }
}

/// Words that are not read, by the kind of their elements: where the first one is, and which there are.
type Told = BTreeMap<&'static str, (usize, BTreeSet<&'static str>)>;

impl<'a> Mjcf<'a> {
    /// Tells the attributes of the file that are not read.
    ///
    /// # Errors
    /// Attributes that MuJoCo does not know, and that are nearly words which are read.
    pub(super) fn tell_unread_words(&mut self, root: Element<'a>) -> Outcome<()> {
        let mut told = Told::new();
        let mut open: Vec<(Element<'a>, &'static str)> = Vec::new();
        for part in root.elements() {
            match section_of(part.name()) {
                Some(section) => open.push((part, section)),
                None => self.words_of(part, "", &mut told)?,
            }
        }
        while let Some((element, section)) = open.pop() {
            for part in element.elements() {
                self.words_of(part, section, &mut told)?;
                if matches!(part.name(), "body" | "frame" | "default") {
                    open.push((part, section));
                }
            }
        }
        for (of, (start, names)) in told {
            let names: Vec<String> = names.into_iter().map(quoted).collect();
            let what = format!("{} of {of}", names.join(", "));
            self.unread.standard_text(start, what);
        }
        Ok(())
    }

    fn words_of(&mut self, element: Element<'a>, section: &str, told: &mut Told) -> Outcome<()> {
        let Some((words, of)) = words_of(section, element.name()) else {
            return Ok(());
        };
        for (name, range) in element.other_attributes(words.read) {
            if let Some(known) = words.beside.iter().find(|known| **known == name) {
                let (start, names) = told.entry(of).or_insert((range.start, BTreeSet::new()));
                *start = range.start.min(*start);
                names.insert(*known);
                continue;
            }
            if of == "<key>" && BESIDE_POSES.contains(&name) {
                continue;
            }
            let start = range.start;
            let what = unknown_attribute(element, name, range, words.read)?;
            self.unread.text(start, what);
        }
        Ok(())
    }
}
