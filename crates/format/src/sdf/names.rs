//! What a name stands for: links, frames, models and joints of one model, and by `model::name` those of models inside it.

use super::{Body, Sdf, pose};
use crate::element::{Attribute, Element};
use crate::error::{Fault, Outcome};
use crate::words::{cut, did_you_mean, listed, quoted};
use std::collections::{BTreeMap, BTreeSet};

/// SDFormat's word for the frame of the model that it stands in.
const MODEL: &str = "__model__";
const WORLD: &str = "world";

/// What has a name and a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
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
    /// What has this very name.
    fn named(&self, name: &str) -> Option<Thing> {
        let joint = || self.joints.get(name).map(|joint| Thing::Joint(*joint));
        self.places.get(name).copied().or_else(joint)
    }

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
        // Outside of all models there is none that it could stand for.
        if text == MODEL {
            return (scope > 0).then(|| self.model(scope));
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

    /// Programs before libsdformat 10 write models inside models as one, with names such as `arm::hand`: a whole name counts first.
    fn path(&self, scope: usize, text: &str) -> Option<Thing> {
        let whole = self.scopes.get(scope)?;
        if let Some(found) = whole.named(text) {
            return Some(found);
        }
        let mut at = scope;
        let mut parts = text.split("::").peekable();
        while let Some(part) = parts.next() {
            let here = self.scopes.get(at)?;
            if parts.peek().is_none() {
                let own = || (part == MODEL).then(|| self.model(at));
                return here.named(part).or_else(own);
            }
            match *here.places.get(part)? {
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
        let here = self.scopes.get(scope);
        let (model, last) = match text.rsplit_once("::") {
            Some((model, last)) if here.is_none_or(|here| !here.joints.contains_key(text)) => {
                (self.find(scope, model), last)
            }
            _ => (Some(self.model(scope)), text),
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

    /// The link that a thing is rigid with; `name` is where it is named. What is found on the way is kept, so that a chain of frames, each
    /// attached to the one before, is walked once, however many ask.
    pub(super) fn body_of(&self, thing: Thing, name: Attribute<'a>) -> Outcome<Body> {
        let (mut at, mut way, mut met) = (thing, Vec::new(), BTreeSet::new());
        let body = loop {
            let known = self.bodies.borrow().get(&at).copied();
            if let Some(body) = known {
                break body;
            }
            if !met.insert(at) {
                return Err(self.circle(&way, at, name));
            }
            way.push(at);
            at = match at {
                Thing::World => break None,
                Thing::Link(link) => break Some(link),
                Thing::Frame(frame) => self.attached_to(frame)?,
                Thing::Joint(joint) => self.side(joint, "child")?.0,
                Thing::Model(scope) => self.canonical(scope).ok_or_else(|| {
                    name.fault(format!(
                        "the model {} has no link",
                        quoted(name.value.trim())
                    ))
                })??,
            };
        };
        let found = way.into_iter().map(|thing| (thing, body));
        self.bodies.borrow_mut().extend(found);
        Ok(body)
    }

    /// The fault of a thing that is attached to no link, since the way from it comes back to where it was.
    fn circle(&self, way: &[Thing], back_at: Thing, name: Attribute<'a>) -> Fault {
        let circle = way.iter().skip_while(|thing| **thing != back_at);
        let names: Vec<&str> = circle.map(|thing| self.called(*thing)).collect();
        let what = match names.len() {
            1 => format!("{} is attached to itself", listed(&names)),
            _ => format!("{} are attached to one another in a circle", listed(&names)),
        };
        let asked = quoted(name.value.trim());
        name.fault(format!("{asked} is attached to no link: {what}"))
    }

    /// The things by the nodes of the graph of poses that are their frames.
    pub(super) fn things(&self) -> BTreeMap<usize, Thing> {
        let links = self.links.iter().map(|link| link.node).enumerate();
        let frames = self.frames.iter().map(|frame| frame.node).enumerate();
        let joints = self.joints.iter().map(|joint| joint.node).enumerate();
        let models = self.scopes.iter().map(|scope| scope.node).enumerate();
        let links = links.map(|(index, node)| (node, Thing::Link(index)));
        let frames = frames.map(|(index, node)| (node, Thing::Frame(index)));
        let joints = joints.map(|(index, node)| (node, Thing::Joint(index)));
        let models = models.map(|(index, node)| (node, Thing::Model(index)));
        links.chain(frames).chain(joints).chain(models).collect()
    }

    /// The name of a thing in the file.
    pub(super) fn called(&self, thing: Thing) -> &str {
        let name = match thing {
            Thing::World => None,
            Thing::Link(link) => self.links.get(link).map(|link| link.element),
            Thing::Frame(frame) => self.frames.get(frame).map(|frame| frame.element),
            Thing::Joint(joint) => self.joints.get(joint).map(|joint| joint.element),
            Thing::Model(scope) => return self.scopes.get(scope).map_or(WORLD, |own| own.name),
        };
        let name = name.and_then(|element| element.attribute("name"));
        name.map_or(WORLD, |name| name.value.trim())
    }

    /// Whatever a frame or a model names to be rigid with has to be there, also where nobody asks for it.
    pub(super) fn check_attachments(&self) -> Outcome<()> {
        for (index, frame) in self.frames.iter().enumerate() {
            let stated = frame.element.attribute("attached_to");
            if let Some(name) = stated.filter(|name| !name.value.trim().is_empty()) {
                self.body_of(Thing::Frame(index), name)?;
            }
        }
        for (scope, model) in self.scopes.iter().enumerate() {
            if let Some(name) = model.canonical {
                self.body_of(Thing::Model(scope), name)?;
            }
        }
        Ok(())
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
        index: usize,
        which: &str,
    ) -> Outcome<(Thing, Option<Attribute<'a>>)> {
        let Some(joint) = self.joints.get(index) else {
            return Ok((Thing::World, None));
        };
        let Some(part) = super::only(joint.element, which)? else {
            let message = format!("joint {} needs <{which}>", quoted(&joint.name));
            return Err(joint.element.fault(message));
        };
        let name = name_in(part)?;
        let thing = self.look_up(joint.scope, name)?;
        if thing == Thing::Joint(index) {
            let message = format!("joint {} names itself as its {which}", quoted(&joint.name));
            return Err(name.fault(message));
        }
        Ok((thing, Some(name)))
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
