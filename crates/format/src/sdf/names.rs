//! What a name stands for: links, frames, models and joints of one model, and by `model::name` those of models inside it.

use super::{Body, Sdf, pose};
use crate::element::{Attribute, Element};
use crate::error::Outcome;
use crate::words::{cut, did_you_mean, quoted};
use std::collections::BTreeMap;

/// SDFormat's word for the frame of the model that it stands in.
const MODEL: &str = "__model__";
const WORLD: &str = "world";

/// So many frames, each attached to the next one, are followed.
const LONGEST: usize = 1000;

/// What has a name and a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Thing {
    World,
    Link(usize),
    Frame(usize),
    Model(usize),
    Joint(usize),
}

/// A model, or the world around all of them.
pub(super) struct Scope<'a> {
    pub(super) name: &'a str,
    /// What its names begin with here.
    pub(super) prefix: String,
    pub(super) node: usize,
    /// The model of the world that it is, or is inside of.
    pub(super) top: usize,
    pub(super) is_static: bool,
    pub(super) canonical: Option<Attribute<'a>>,
    pub(super) placement: Option<Attribute<'a>>,
    pub(super) first_link: Option<usize>,
    pub(super) first_model: Option<usize>,
    /// Links, frames and models; joints may have the names of links in old versions.
    pub(super) places: BTreeMap<&'a str, Thing>,
    pub(super) joints: BTreeMap<&'a str, usize>,
}

impl Scope<'_> {
    /// The world.
    pub(super) fn world() -> Self {
        Self {
            name: WORLD,
            prefix: String::new(),
            node: pose::WORLD,
            top: 0,
            is_static: false,
            canonical: None,
            placement: None,
            first_link: None,
            first_model: None,
            places: BTreeMap::new(),
            joints: BTreeMap::new(),
        }
    }
}

impl<'a> Sdf<'a> {
    /// What a name stands for in a model.
    pub(super) fn look_up(&self, scope: usize, name: Attribute<'a>) -> Outcome<Thing> {
        let text = name.value.trim();
        if let Some(found) = self.find(scope, text) {
            return Ok(found);
        }
        let scope = self.scopes.get(scope);
        let known = scope.into_iter().flat_map(|scope| {
            let places = scope.places.keys().copied();
            places.chain(scope.joints.keys().copied())
        });
        Err(name
            .fault(format!("nothing is called {}", quoted(text)))
            .maybe_help(did_you_mean(text, known, ("`", "`"))))
    }

    /// The same, where there need not be anything of that name.
    pub(super) fn find(&self, scope: usize, text: &str) -> Option<Thing> {
        if text == MODEL {
            return Some(self.model(scope));
        }
        if let Some(found) = self.path(scope, text) {
            return Some(found);
        }
        let own = self.scopes.get(scope)?;
        if let Some((first, rest)) = text.split_once("::")
            && first == own.name
        {
            return self.path(scope, rest);
        }
        (text == WORLD).then_some(Thing::World)
    }

    fn path(&self, scope: usize, text: &str) -> Option<Thing> {
        let mut at = scope;
        let mut parts = text.split("::").peekable();
        while let Some(part) = parts.next() {
            let here = self.scopes.get(at)?;
            let place = here.places.get(part).copied();
            if parts.peek().is_none() {
                let joint = || here.joints.get(part).map(|joint| Thing::Joint(*joint));
                let own = || (part == MODEL).then(|| self.model(at));
                return place.or_else(joint).or_else(own);
            }
            match place? {
                Thing::Model(inner) => at = inner,
                _ => return None,
            }
        }
        None
    }

    /// A model by its index, of which the first is the world.
    pub(super) fn model(&self, scope: usize) -> Thing {
        match scope {
            0 => Thing::World,
            _ => Thing::Model(scope),
        }
    }

    /// A joint of a model, or of one inside it.
    pub(super) fn joint_named(&self, scope: usize, name: Attribute<'a>) -> Outcome<usize> {
        let text = name.value.trim();
        let (model, last) = match text.rsplit_once("::") {
            Some((model, last)) => (self.find(scope, model), last),
            None => (Some(self.model(scope)), text),
        };
        let scope = match model {
            Some(Thing::Model(inner)) => inner,
            _ => 0,
        };
        let joints = self.scopes.get(scope).map(|scope| &scope.joints);
        if let Some(joint) = joints.and_then(|joints| joints.get(last)) {
            return Ok(*joint);
        }
        let known = joints.into_iter().flat_map(|joints| joints.keys().copied());
        Err(name
            .fault(format!("there is no joint {}", quoted(text)))
            .maybe_help(did_you_mean(last, known, ("`", "`"))))
    }

    /// The node of a thing in the graph of poses.
    pub(super) fn node_of(&self, thing: Thing) -> usize {
        let node = match thing {
            Thing::World => None,
            Thing::Link(link) => self.links.get(link).map(|link| link.node),
            Thing::Frame(frame) => self.frames.get(frame).map(|frame| frame.node),
            Thing::Model(scope) => self.scopes.get(scope).map(|scope| scope.node),
            Thing::Joint(joint) => self.joints.get(joint).map(|joint| joint.node),
        };
        node.unwrap_or(pose::WORLD)
    }

    /// What a frame is attached to: its model, where it does not say.
    pub(super) fn attached_to(&self, frame: usize) -> Outcome<Thing> {
        let Some(frame) = self.frames.get(frame) else {
            return Ok(Thing::World);
        };
        let attached = frame.element.attribute("attached_to");
        match attached.filter(|name| !name.value.trim().is_empty()) {
            Some(name) => self.look_up(frame.scope, name),
            None => Ok(self.model(frame.scope)),
        }
    }

    /// The link that a thing is rigid with; `name` is where it is named.
    pub(super) fn body_of(&self, thing: Thing, name: Attribute<'a>) -> Outcome<Body> {
        let mut thing = thing;
        for _ in 0..LONGEST {
            thing = match thing {
                Thing::World => return Ok(None),
                Thing::Link(link) => return Ok(Some(link)),
                Thing::Frame(frame) => self.attached_to(frame)?,
                Thing::Joint(joint) => self.side(joint, "child")?.0,
                Thing::Model(scope) => self.canonical(scope).ok_or_else(|| {
                    name.fault(format!(
                        "the model {} has no link",
                        quoted(name.value.trim())
                    ))
                })??,
            };
        }
        Err(name.fault(format!(
            "{} is attached to no link: its frames run in a circle, or are more than {LONGEST}",
            quoted(name.value.trim())
        )))
    }

    /// The link that stands for a model: the one that it names, or its first one, be it in a model inside.
    pub(super) fn canonical(&self, scope: usize) -> Option<Outcome<Thing>> {
        let model = self.scopes.get(scope)?;
        if let Some(name) = model.canonical {
            return Some(self.look_up(scope, name));
        }
        let first = model.first_link.map(Thing::Link);
        Some(Ok(first.or(model.first_model.map(Thing::Model))?))
    }

    /// The thing that `<parent>` or `<child>` of a joint names, and where.
    pub(super) fn side(
        &self,
        joint: usize,
        which: &str,
    ) -> Outcome<(Thing, Option<Attribute<'a>>)> {
        let Some(joint) = self.joints.get(joint) else {
            return Ok((Thing::World, None));
        };
        let Some(part) = super::only(joint.element, which)? else {
            let message = format!("joint {} needs <{which}>", quoted(&joint.name));
            return Err(joint.element.fault(message));
        };
        let name = name_in(part)?;
        Ok((self.look_up(joint.scope, name)?, Some(name)))
    }
}

/// The name that an element holds: as text, or in an attribute or element `link` as before version 1.3.
fn name_in(part: Element<'_>) -> Outcome<Attribute<'_>> {
    let inner = || part.elements().find(|inner| inner.name() == "link");
    let found = part
        .value()
        .or_else(|| part.attribute("link"))
        .or_else(|| inner().and_then(|inner| inner.value()));
    found
        .filter(|name| !name.value.trim().is_empty())
        .ok_or_else(|| {
            let written = cut(part.written_name());
            let message = format!("<{written}> needs the name of a link");
            part.fault(message)
                .help(format!("<{written}>link</{written}>"))
        })
}
