//! Masses and shapes of links, for simulations and pictures. No answer about motion hangs on them: what of them cannot be read is counted.

use super::pose::pose_of;
use super::{Sdf, only};
use crate::element::Element;
use crate::error::Outcome;
use crate::frames::one_after_another;
use crate::gazebo::needed;
use crate::unread::truth;
use crate::values::exactly;
use crate::words::cut;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Frame, Geometry, Inertial, Shape};

/// What a link weighs, and its shapes for contact and for pictures.
#[derive(Default)]
pub(super) struct Solids {
    pub(super) inertial: Option<Inertial>,
    pub(super) collisions: Vec<Shape>,
    pub(super) visuals: Vec<Shape>,
}

/// Moments of inertia and their defaults in SDFormat (kg m²).
const MOMENTS: [(&str, i64); 6] = [
    ("ixx", 1),
    ("ixy", 0),
    ("ixz", 0),
    ("iyy", 1),
    ("iyz", 0),
    ("izz", 1),
];

impl<'a> Sdf<'a> {
    /// The mass and the shapes of a link.
    pub(super) fn solids(&mut self, link: usize) -> Solids {
        let mut solids = Solids::default();
        let Some(element) = self.links.get(link).map(|link| link.element) else {
            return solids;
        };
        for part in element.elements() {
            let read = match part.name() {
                "inertial" => self
                    .inertial(part, link)
                    .map(|read| solids.inertial = Some(read)),
                "collision" => self
                    .shape(part, link)
                    .map(|read| solids.collisions.extend(read)),
                "visual" => self
                    .shape(part, link)
                    .map(|read| solids.visuals.extend(read)),
                _ => Ok(()),
            };
            if let Err(fault) = read {
                let what = format!("<{}>: {}", part.name(), fault.message);
                self.unread.text(part.start(), what);
            }
        }
        solids
    }

    /// Where a part of a link is in it.
    fn place_in(&mut self, part: Element<'a>, link: usize) -> Outcome<Frame> {
        let pose = pose_of(part)?;
        let Some((scope, node)) = self.links.get(link).map(|link| (link.scope, link.node)) else {
            return Ok(pose.frame);
        };
        let Some(name) = pose.relative_to else {
            return Ok(pose.frame);
        };
        let Some(thing) = self.reference(scope, name)? else {
            return Ok(pose.frame);
        };
        let seen = self.graph.seen_from(node, self.node_of(thing));
        let seen = seen.ok_or_else(|| part.fault("its place is not finite"))?;
        Ok(one_after_another(&seen, &pose.frame))
    }

    fn inertial(&mut self, part: Element<'a>, link: usize) -> Outcome<Inertial> {
        let is_computed = part.attribute("auto").map(truth).transpose()?;
        if is_computed == Some(true) {
            return Err(part.fault("a mass that follows from shapes is not computed"));
        }
        self.skip_others(part, &["pose", "mass", "inertia"]);
        let origin = self.place_in(part, link)?;
        let mass = number(part, "mass", 1)?;
        if mass.value() < 0.0 {
            return Err(part.fault("the mass is negative"));
        }
        let inertia = only(part, "inertia")?;
        let mut moments = Vec::with_capacity(MOMENTS.len());
        for (name, default) in MOMENTS {
            moments.push(match inertia {
                Some(inertia) => number(inertia, name, default)?,
                None => Number::integer(default),
            });
        }
        let inertia = <[Number; 6]>::try_from(moments);
        let inertia = inertia.map_err(|_| part.fault("there are six moments of inertia"))?;
        Ok(Inertial {
            origin,
            mass,
            inertia,
        })
    }

    /// A shape; `None` for one that the model has no word for.
    fn shape(&mut self, part: Element<'a>, link: usize) -> Outcome<Option<Shape>> {
        self.skip_others(part, &["pose", "geometry"]);
        let origin = self.place_in(part, link)?;
        let geometry = match only(part, "geometry")? {
            Some(geometry) => geometry,
            None => return Err(part.fault("it needs <geometry>")),
        };
        let mut solids = geometry.elements();
        let Some(solid) = solids.next() else {
            return Err(geometry.fault("<geometry> needs a solid, found nothing"));
        };
        if let Some(second) = solids.next() {
            let what = format!("<{}>, a second solid of one <geometry>", cut(second.name()));
            self.unread.text(second.start(), what);
        }
        let geometry = match solid.name() {
            "box" => Geometry::Box(lengths(solid, "size")?),
            "sphere" => {
                let [radius] = lengths(solid, "radius")?;
                Geometry::Sphere(radius)
            }
            round @ ("cylinder" | "capsule") => {
                let ([radius], [length]) = (lengths(solid, "radius")?, lengths(solid, "length")?);
                match round {
                    "cylinder" => Geometry::Cylinder { radius, length },
                    _ => Geometry::Capsule { radius, length },
                }
            }
            "mesh" => {
                self.skip_others(solid, &["uri", "scale"]);
                let uri = only(solid, "uri")?.ok_or_else(|| solid.fault("it needs <uri>"))?;
                let scale = match only(solid, "scale")? {
                    Some(scale) => Some(exactly(needed(scale)?)?),
                    None => None,
                };
                Geometry::Mesh {
                    filename: needed(uri)?.value.trim().to_owned(),
                    scale,
                }
            }
            // No shape at all is meant.
            "empty" => return Ok(None),
            other => {
                let what = format!("<geometry>: {}", cut(other));
                self.unread.text(solid.start(), what);
                return Ok(None);
            }
        };
        Ok(Some(Shape {
            name: part.attribute("name").map(|name| name.value.to_owned()),
            origin,
            geometry,
        }))
    }

    /// Counts what else stands in an element.
    fn skip_others(&mut self, element: Element<'a>, known: &[&str]) {
        let others = element
            .elements()
            .filter(|part| !known.contains(&part.name()));
        for other in others {
            self.unread.standard(other);
        }
    }
}

/// A number in an element of its own.
fn number(element: Element<'_>, name: &str, default: i64) -> Outcome<Number> {
    let Some(part) = only(element, name)? else {
        return Ok(Number::integer(default));
    };
    let [number] = exactly(needed(part)?)?;
    Ok(number)
}

/// Lengths, none of them negative.
fn lengths<const N: usize>(solid: Element<'_>, name: &str) -> Outcome<[Number; N]> {
    let part = only(solid, name)?.ok_or_else(|| solid.fault(format!("it needs <{name}>")))?;
    let value = needed(part)?;
    let lengths: [Number; N] = exactly(value)?;
    match lengths.iter().any(|length| length.value() < 0.0) {
        true => Err(value.fault("a length of a solid is negative")),
        false => Ok(lengths),
    }
}
