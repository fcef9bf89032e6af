//! Bodies, the frames between them, and their joints.

use super::keys::Coordinate;
use super::mass::Load;
use super::pose::{Source, exactly, least_turn};
use super::{Known, Mjcf, Place, SOFT, WORLD};
use crate::WarningKind;
use crate::element::Element;
use crate::error::Outcome;
use crate::frames::{difference, one_after_another};
use crate::words::quoted;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Frame, JointBuilder, JointKind};
use std::rc::Rc;

pub(super) fn tree(name: &str, kind: JointKind, parent: &str, child: &str) -> JointBuilder {
    JointBuilder::tree(name, kind, parent, child)
}

/// Elements of a body that say nothing about how it moves.
const STANDARD: [&str; 4] = ["light", "camera", "plugin", "user"];

/// An element of the tree that is still to be read.
struct Open<'a> {
    element: Element<'a>,
    /// Shared with what stands beside it: frames may be nested by thousands.
    place: Rc<Place>,
    /// The class that the body around it gives.
    class: Option<&'a str>,
    source: Source<'a>,
}

/// Something in a body, its class, and the frames inside the body that it stands in, as one.
pub(super) struct Found<'a> {
    pub(super) element: Element<'a>,
    pub(super) class: Option<&'a str>,
    pub(super) frame: Frame,
    pub(super) source: Source<'a>,
}

impl<'a> Mjcf<'a> {
    /// All bodies of the world.
    pub(super) fn bodies(&mut self, world: Element<'a>) -> Outcome<()> {
        let place = Rc::new(Place {
            link: WORLD.to_owned(),
            chain: Vec::new(),
        });
        // Nesting is bounded by memory alone: no recursion.
        let mut open = Vec::new();
        let outer = self.source.clone();
        self.inside(world, &place, None, &mut open)?;
        while let Some(Open {
            element,
            place,
            class,
            source,
        }) = open.pop()
        {
            self.source = source;
            if element.name() == "frame" {
                self.source = self.source.inside(element)?;
                for own in element.elements().filter(|part| part.name() == "compiler") {
                    self.tell_unread_settings(own);
                }
            }
            let of = self.classes.of(element, class)?;
            let own = element.attribute("childclass").map(|own| own.value);
            let class = own.or(class);
            let mut place = place;
            let frame = self.frame(element, of)?;
            Rc::make_mut(&mut place).chain.push(frame);
            if element.name() == "frame" {
                self.inside(element, &place, class, &mut open)?;
                continue;
            }
            let link = self.make_body(element, &place, class)?;
            let inner = Rc::new(Place {
                link,
                chain: Vec::new(),
            });
            self.inside(element, &inner, class, &mut open)?;
        }
        self.source = outer;
        Ok(())
    }

    /// Keeps what is inside a body, a frame or the world, the first on top.
    fn inside(
        &mut self,
        element: Element<'a>,
        place: &Rc<Place>,
        class: Option<&'a str>,
        open: &mut Vec<Open<'a>>,
    ) -> Outcome<()> {
        let mut found = Vec::new();
        for part in element.elements() {
            match part.name() {
                "body" | "frame" => found.push(Open {
                    element: part,
                    place: Rc::clone(place),
                    class,
                    source: self.source.clone(),
                }),
                "site" => self.site(part, place, class)?,
                "joint" | "freejoint" => {
                    if place.link == WORLD {
                        let message = format!("<{}> belongs into a <body>", part.name());
                        return Err(part.fault(message));
                    }
                }
                // Taken before.
                "compiler" if element.name() == "frame" => {}
                name if SOFT.contains(&name) => {
                    let message = format!(
                        "<{name}> is not read: the bodies that it makes, and how they move, are not in the answer"
                    );
                    let warning = (part.start(), WarningKind::MayJoin, message);
                    self.warnings.push(warning);
                }
                // Read with the body itself.
                "geom" | "inertial" => {}
                name if STANDARD.contains(&name) => self.unread.standard(part),
                _ => self.unread.element(part),
            }
        }
        open.extend(found.into_iter().rev());
        Ok(())
    }

    fn site(&mut self, site: Element<'a>, place: &Place, class: Option<&'a str>) -> Outcome<()> {
        let Some(name) = site.attribute("name") else {
            return Ok(());
        };
        let of = self.classes.of(site, class)?;
        let mut place = place.clone();
        let mut frame = self.frame(site, of)?;
        if let Some(ends) = self.classes.attribute(site, of, "fromto") {
            frame = between(exactly(ends)?)
                .ok_or_else(|| ends.fault("the two points of `fromto` are one"))?;
        }
        place.chain.push(frame);
        self.sites.insert(name.value, place);
        Ok(())
    }

    /// Makes a body and its joints; the name of its link.
    fn make_body(
        &mut self,
        body: Element<'a>,
        place: &Place,
        class: Option<&'a str>,
    ) -> Outcome<String> {
        let name = match body.attribute("name") {
            Some(name) if self.links.contains_key(name.value) => {
                return Err(name.fault(format!("two bodies are called {}", quoted(name.value))));
            }
            Some(name) => name.value.to_owned(),
            None => self.name_for(&self.links, "body"),
        };
        self.links.insert(name.clone(), body.range());
        self.homes.insert(name.clone(), place.clone());
        let joints = self.parts_of(body, class, &["joint", "freejoint"])?;
        let says = body.attribute("mocap");
        let is_mocap = says.is_some_and(|word| word.value == "true");
        // What is fixed to a body that a user moves is moved with it.
        if is_mocap || joints.is_empty() && self.mocap.contains(&place.link) {
            self.mocap.insert(name.clone());
        }
        let load = self.load_of(body, class)?;
        let source = self.source.clone();
        let free = joints
            .iter()
            .find(|joint| self.word(joint.element, joint.class) == Ok("free"));
        if let Some(free) = free {
            self.source = free.source.clone();
            let floating = self.float(free.element, joints.len(), (name, place), load);
            self.source = source;
            return floating;
        }
        if joints.is_empty() {
            let (parent, frame) = self.at(place, &name);
            let joint = self.name_of(None, &format!("{name}_fixed"), body)?;
            self.add_link(&name, load);
            self.builder
                .joint(tree(&joint, JointKind::Fixed, &parent, &name).origin(frame));
            return Ok(name);
        }
        let mut place = place.clone();
        let last = joints.len() - 1;
        let mut load = Some(load);
        for (index, joint) in joints.into_iter().enumerate() {
            let to = match index == last {
                true => name.clone(),
                false => self.name_for(&self.links, &format!("{name}_{}", index + 1)),
            };
            self.links.insert(to.clone(), body.range());
            match load.take_if(|_| index == last) {
                Some(load) => self.add_link(&to, load),
                None => {
                    self.builder.link(&to);
                }
            }
            self.source = joint.source.clone();
            self.make_joint(&joint, &place, (&name, &to))?;
            place = Place {
                link: to,
                chain: Vec::new(),
            };
        }
        self.source = source;
        Ok(name)
    }

    /// Adds a link with what it weighs and looks like.
    pub(super) fn add_link(&mut self, name: &str, load: Load) {
        self.builder
            .detailed_link(name, load.inertial, load.collisions, load.visuals);
    }

    fn float(
        &mut self,
        free: Element<'a>,
        joints: usize,
        (name, place): (String, &Place),
        load: Load,
    ) -> Outcome<String> {
        if joints > 1 {
            return Err(free.fault("a body that floats has no other joint"));
        }
        if place.link != WORLD {
            return Err(free.fault("only bodies of the world itself can float"));
        }
        let (parent, frame) = self.at(place, &name);
        let joint = self.name_of(
            free.attribute("name").map(|own| own.value),
            &format!("{name}_free"),
            free,
        )?;
        self.add_link(&name, load);
        self.coordinates.push(Coordinate {
            joint: joint.clone(),
            width: 7,
            zero: Number::zero(),
            frame: Frame::identity(),
            is_held: false,
            within: Rc::clone(&self.source.within),
        });
        self.builder.floating(&joint, &parent, &name, frame);
        Ok(name)
    }

    /// The type of a joint, as the file says it.
    fn word(&self, joint: Element<'a>, class: Option<&'a str>) -> Result<&'a str, ()> {
        if joint.name() == "freejoint" {
            return Ok("free");
        }
        let class = self.classes.of(joint, class).map_err(|_| ())?;
        let word = self.classes.attribute(joint, class, "type");
        Ok(word.map_or("hinge", |word| word.value))
    }

    fn name_of(&mut self, own: Option<&str>, made: &str, element: Element<'a>) -> Outcome<String> {
        let name = match own {
            Some(own) if self.names.contains_key(own) => {
                return Err(element.fault(format!("two joints are called {}", quoted(own))));
            }
            Some(own) => own.to_owned(),
            None => self.name_for(&self.names, made),
        };
        self.names.insert(name.clone(), element.range());
        Ok(name)
    }

    /// What a body has of some names, in frames inside it too, in the order of the file.
    pub(super) fn parts_of(
        &mut self,
        body: Element<'a>,
        class: Option<&'a str>,
        names: &[&str],
    ) -> Outcome<Vec<Found<'a>>> {
        let mut found = Vec::new();
        let source = self.source.clone();
        let mut open = vec![Found {
            element: body,
            class,
            frame: Frame::identity(),
            source: self.source.clone(),
        }];
        while let Some(here) = open.pop() {
            if names.contains(&here.element.name()) {
                found.push(here);
                continue;
            }
            let mut inside = Vec::new();
            for part in here.element.elements() {
                self.source = here.source.clone();
                let (class, frame) = match part.name() {
                    name if names.contains(&name) => (here.class, here.frame.clone()),
                    "frame" => {
                        let of = self.classes.of(part, here.class)?;
                        let own = part.attribute("childclass").map(|own| own.value);
                        self.source = here.source.inside(part)?;
                        let frame = one_after_another(&here.frame, &self.frame(part, of)?);
                        (own.or(here.class), frame)
                    }
                    _ => continue,
                };
                inside.push(Found {
                    element: part,
                    class,
                    frame,
                    source: self.source.clone(),
                });
            }
            open.extend(inside.into_iter().rev());
        }
        self.source = source;
        Ok(found)
    }

    fn make_joint(
        &mut self,
        jointed: &Found<'a>,
        place: &Place,
        (body, to): (&str, &str),
    ) -> Outcome<()> {
        let joint = jointed.element;
        let of = self.classes.of(joint, jointed.class)?;
        let attribute = |name: &str| self.classes.attribute(joint, of, name);
        let kind = self.kind_of(joint, of)?;
        let mut at = Frame::identity();
        if let Some(position) = attribute("pos").filter(|_| kind != JointKind::Prismatic) {
            at.position = exactly(position)?;
        }
        let at = one_after_another(&jointed.frame, &at);
        let axis = self.axis_of(joint, of)?;
        let digits = axis.0.iter().filter_map(Number::stated);
        let decimals = digits
            .filter(|digits| digits.significant > 0)
            .map(|digits| digits.decimals);
        self.decimals_of_axes = decimals.fold(self.decimals_of_axes, i32::max);
        let limit = match kind {
            JointKind::Spherical => None,
            _ => self.limit(joint, of, kind)?,
        };
        self.tell_unread_of(joint, of, kind);
        let dynamics = self.dynamics_of(joint, of)?;
        let own = joint.attribute("name").map(|own| own.value);
        let name = self.name_of(own, &format!("{body}_joint"), joint)?;
        let mut place = place.clone();
        place.chain.push(at.clone());
        let (parent, origin) = self.at(&place, body);
        let held = own.is_some_and(|own| self.held.contains(own));
        self.coordinates.push(Coordinate {
            joint: name.clone(),
            width: if kind == JointKind::Spherical { 4 } else { 1 },
            zero: self.reference(joint, of, kind)?,
            frame: at.clone(),
            is_held: held,
            within: Rc::clone(&self.source.within),
        });
        let made = match held {
            true => tree(&name, JointKind::Fixed, &parent, to),
            false => tree(&name, kind, &parent, to),
        };
        let mut made = made.origin(origin).successor_origin(at);
        if kind != JointKind::Spherical && !held {
            made = made.axis(axis);
            if dynamics.damping.is_some() || dynamics.friction.is_some() {
                made = made.dynamics(dynamics);
            }
            made = limit.into_iter().fold(made, JointBuilder::limit);
        }
        self.builder.joint(made);
        if let Some(own) = own {
            self.joints.insert(
                own,
                Known {
                    kind,
                    element: joint,
                },
            );
        }
        Ok(())
    }
}

/// The frame of a site or a geom that is drawn from one point to another: in the middle, its z axis along them.
pub(super) fn between([a, b, c, d, e, f]: [Number; 6]) -> Option<Frame> {
    let (from, to) = ([a, b, c], [d, e, f]);
    let half = Number::ratio(1, 2)?;
    let along = [0, 1, 2].map(|i| difference(&from[i], &to[i]));
    Some(Frame {
        position: [0, 1, 2].map(|i| &(&from[i] + &to[i]) * &half),
        roll_pitch_yaw: least_turn(along.each_ref())?,
    })
}
