//! What is inside of worlds and models.

use super::Sdf;
use super::joints::Listed;
use super::names::{Scope, Thing};
use crate::element::{Attribute, Element};
use crate::error::{Fault, Outcome};
use crate::unread::truth;
use crate::words::{cut, quoted};
use std::collections::BTreeMap;

/// A link.
pub(super) struct Link<'a> {
    pub(super) element: Element<'a>,
    /// What it is called here.
    pub(super) name: String,
    pub(super) node: usize,
    pub(super) scope: usize,
}

/// Something else of a model, or of the world.
#[derive(Clone, Copy)]
pub(super) struct Extra<'a> {
    pub(super) element: Element<'a>,
    pub(super) scope: usize,
    /// Of frames, where they are in the graph of poses.
    pub(super) node: usize,
}

/// Where something is that does not say what it is given in.
#[derive(Clone, Copy)]
pub(super) enum Fallback {
    Model,
    /// A frame: in what it is attached to.
    Attached(usize),
    /// A joint: in its child.
    Child(usize),
}

/// A pose that is still to be read.
pub(super) struct Pending<'a> {
    pub(super) element: Element<'a>,
    pub(super) node: usize,
    /// The model in which names are looked up.
    pub(super) scope: usize,
    pub(super) fallback: Fallback,
}

/// From this version on a joint must not have the name of a link, frame or model beside it, which poses could mean as well.
const NAMES_UNIQUE: (u32, u32) = (1, 7);

/// A name that two things of a model, or of the world, have.
fn twice(scope: usize, name: Attribute<'_>) -> Fault {
    let whose = if scope == 0 { "the world" } else { "one model" };
    let named = quoted(name.value.trim());
    name.fault(format!("two things of {whose} are called {named}"))
        .help("links, frames, joints and models each have a name of their own")
}

/// Parts of `<sdf>`, of a world and of a model that bear on motion.
const TOP: [&str; 3] = ["model", "world", "include"];
const OF_WORLD: [&str; 4] = ["model", "include", "frame", "joint"];
const OF_MODEL: [&str; 7] = [
    "model", "include", "frame", "joint", "link", "pose", "static",
];

/// Parts that say nothing about motion.
const STANDARD: [&str; 22] = [
    "light",
    "actor",
    "physics",
    "scene",
    "gui",
    "gravity",
    "magnetic_field",
    "wind",
    "atmosphere",
    "audio",
    "spherical_coordinates",
    "self_collide",
    "allow_auto_disable",
    "enable_wind",
    "gripper",
    "sensor",
    "projector",
    "audio_sink",
    "audio_source",
    "battery",
    "velocity_decay",
    "kinematic",
];

impl<'a> Sdf<'a> {
    /// Finds all models, links, frames and joints.
    pub(super) fn collect(&mut self, root: Element<'a>) -> Outcome<()> {
        let (mut models, mut world) = (Vec::new(), None);
        for part in root.elements() {
            match part.name() {
                "model" => models.push(part),
                "world" if world.is_some() => {
                    return Err(part
                        .fault("a second <world> is not read")
                        .help("keep one world in a file"));
                }
                "world" => world = Some(part),
                "include" => self.include(part)?,
                name if STANDARD.contains(&name) => self.unread.standard(part),
                _ => self.unknown(part, "sdf", &TOP)?,
            }
        }
        for part in world.into_iter().flat_map(|world| world.elements()) {
            match part.name() {
                "model" => models.push(part),
                "include" => self.include(part)?,
                "frame" => self.add_frame(part, 0)?,
                "joint" => self.add_joint(part, 0)?,
                "plugin" => self.add_extra(part, 0),
                name if STANDARD.contains(&name) => self.unread.standard(part),
                _ => self.unknown(part, "world", &OF_WORLD)?,
            }
        }
        if models.is_empty() {
            return Err(root
                .fault("<sdf> holds no <model>")
                .help("a mechanism is a <model> with <link> and <joint> inside"));
        }
        let alone = models.len() == 1;
        let mut open = Vec::new();
        for model in models {
            open.push(self.add_model(model, 0, alone)?);
        }
        open.reverse();
        // Nesting is bounded by memory alone: no recursion.
        while let Some((model, scope)) = open.pop() {
            let mut inner = self.inside(model, scope)?;
            inner.reverse();
            open.extend(inner);
        }
        Ok(())
    }

    /// Takes what is in a model; the models inside it.
    fn inside(&mut self, model: Element<'a>, scope: usize) -> Outcome<Vec<(Element<'a>, usize)>> {
        let mut inner = Vec::new();
        for part in model.elements() {
            match part.name() {
                // Drake's joints and constraints.
                "joint" => self.add_joint(part, scope)?,
                _ if part.written_name().starts_with("drake:") => self.add_extra(part, scope),
                "model" => inner.push(self.add_model(part, scope, false)?),
                "link" => self.add_link(part, scope)?,
                "frame" => self.add_frame(part, scope)?,
                "plugin" => self.add_extra(part, scope),
                "include" => self.include(part)?,
                "pose" | "static" => {}
                name if STANDARD.contains(&name) => self.unread.standard(part),
                _ => self.unknown(part, "model", &OF_MODEL)?,
            }
        }
        Ok(inner)
    }

    fn add_model(
        &mut self,
        model: Element<'a>,
        outer: usize,
        alone: bool,
    ) -> Outcome<(Element<'a>, usize)> {
        let scope = self.scopes.len();
        let name = self.give(outer, model, Thing::Model(scope))?;
        let is_static = match super::only(model, "static")?.and_then(|part| part.value()) {
            Some(value) => truth(value)?,
            None => false,
        };
        let (prefix, parent, top, inherited) = match self.scopes.get(outer) {
            Some(outer) => (&outer.prefix[..], outer.node, outer.top, outer.is_static),
            None => ("", 0, 0, false),
        };
        let prefix = match alone {
            true => String::new(),
            false => format!("{prefix}{name}::"),
        };
        let given = |word: &str| {
            let attribute = model.attribute(word);
            attribute.filter(|name: &Attribute<'a>| !name.value.trim().is_empty())
        };
        let placement = given("placement_frame");
        let posed = self.graph.add(parent, model.range());
        let node = match placement {
            Some(_) => self.graph.add(posed, model.range()),
            None => posed,
        };
        self.pending.push(Pending {
            element: model,
            node: posed,
            scope: outer,
            fallback: Fallback::Model,
        });
        self.scopes.push(Scope {
            name,
            prefix,
            node,
            top: if outer == 0 { scope } else { top },
            is_static: is_static || inherited,
            canonical: given("canonical_link"),
            placement,
            first_link: None,
            first_model: None,
            places: BTreeMap::new(),
            joints: BTreeMap::new(),
        });
        if let Some(outer) = self.scopes.get_mut(outer) {
            outer.first_model.get_or_insert(scope);
        }
        Ok((model, scope))
    }

    /// Gives something of a model its name.
    fn give(&mut self, scope: usize, element: Element<'a>, thing: Thing) -> Outcome<&'a str> {
        let name = element.required("name")?;
        if name.value.trim().is_empty() {
            return Err(name.fault("needed a name, found nothing"));
        }
        let unique = self.version >= NAMES_UNIQUE;
        let own = self.scopes.get_mut(scope);
        let is_taken = own.is_some_and(|own| {
            let before = own.places.insert(name.value.trim(), thing);
            before.is_some() || (unique && own.joints.contains_key(name.value.trim()))
        });
        match is_taken {
            true => Err(twice(scope, name)),
            false => Ok(name.value.trim()),
        }
    }

    fn full_name(&self, scope: usize, name: &str) -> String {
        let prefix = self.scopes.get(scope).map_or("", |scope| &scope.prefix);
        format!("{prefix}{name}")
    }

    fn add_link(&mut self, link: Element<'a>, scope: usize) -> Outcome<()> {
        let index = self.links.len();
        let own = self.give(scope, link, Thing::Link(index))?;
        let name = self.full_name(scope, own);
        self.link_names.insert(name.clone(), link.range());
        let parent = self.node_of(self.model(scope));
        let node = self.graph.add(parent, link.range());
        super::only(link, "inertial")?;
        self.pending.push(Pending {
            element: link,
            node,
            scope,
            fallback: Fallback::Model,
        });
        self.links.push(Link {
            element: link,
            name,
            node,
            scope,
        });
        if let Some(scope) = self.scopes.get_mut(scope) {
            scope.first_link.get_or_insert(index);
        }
        for part in link.elements() {
            match part.name() {
                "pose" | "inertial" | "visual" | "collision" => {}
                name if STANDARD.contains(&name) => self.unread.standard(part),
                _ => self.unknown(part, "link", &["pose"])?,
            }
        }
        Ok(())
    }

    fn add_frame(&mut self, frame: Element<'a>, scope: usize) -> Outcome<()> {
        let index = self.frames.len();
        self.give(scope, frame, Thing::Frame(index))?;
        let parent = self.node_of(self.model(scope));
        let node = self.graph.add(parent, frame.range());
        self.pending.push(Pending {
            element: frame,
            node,
            scope,
            fallback: Fallback::Attached(index),
        });
        self.frames.push(Extra {
            element: frame,
            scope,
            node,
        });
        Ok(())
    }

    fn add_joint(&mut self, joint: Element<'a>, scope: usize) -> Outcome<()> {
        let index = self.joints.len();
        let own = joint.required("name")?;
        let name = self.full_name(scope, own.value.trim());
        if own.value.trim().is_empty() {
            return Err(own.fault("needed a name, found nothing"));
        }
        let unique = self.version >= NAMES_UNIQUE;
        let is_taken = self.scopes.get_mut(scope).is_some_and(|scope| {
            let before = scope.joints.insert(own.value.trim(), index);
            before.is_some() || (unique && scope.places.contains_key(own.value.trim()))
        });
        if is_taken {
            return Err(twice(scope, own));
        }
        self.names.insert(name.clone(), joint.range());
        let parent = self.node_of(self.model(scope));
        let node = self.graph.add(parent, joint.range());
        self.pending.push(Pending {
            element: joint,
            node,
            scope,
            fallback: Fallback::Child(index),
        });
        self.joints.push(Listed {
            element: joint,
            scope,
            node,
            name,
            kind: None,
        });
        Ok(())
    }

    fn add_extra(&mut self, element: Element<'a>, scope: usize) {
        self.extras.push(Extra {
            element,
            scope,
            node: 0,
        });
    }

    /// `<include>` brings a model from another file, unless it is one of those without joints that stand in nearly every world.
    fn include(&mut self, include: Element<'a>) -> Outcome<()> {
        let uri = include.elements().find(|part| part.name() == "uri");
        let uri = uri.and_then(|uri| uri.value()).map(|uri| uri.value.trim());
        let last = uri.and_then(|uri| uri.trim_end_matches('/').rsplit('/').next());
        let last = last.unwrap_or_default().to_lowercase().replace(' ', "_");
        if ["sun", "ground_plane"].contains(&last.as_str()) {
            let what = format!("<include> of {}", cut(uri.unwrap_or_default()));
            self.unread.text(include.start(), what);
            return Ok(());
        }
        let named = uri.map_or_else(|| "another file".to_owned(), quoted);
        Err(include
            .fault(format!(
                "<include> of {named} is not read, and the model that it brings would be lost"
            ))
            .help("`gz sdf --print FILE` writes a file with everything that it includes"))
    }
}
