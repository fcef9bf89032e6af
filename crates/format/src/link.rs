//! `<link>`: mass properties and shapes.

use super::element::{Attribute, Element};
use super::error::Outcome;
use super::names::Named;
use super::reader::Reader;
use super::unread::Parts;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Frame, Geometry, Inertial, Shape};

impl<'a> Reader<'a> {
    /// `<link name>` with `<inertial>`, any number of `<collision>` and `<visual>`.
    pub(super) fn read_link(&mut self, link: Element<'a>) -> Outcome<()> {
        self.attributes_of(link, &["name"], true)?;
        let name = self.directory.add(Named::Link, link)?;
        let kinds = Parts {
            known: &["inertial"],
            often: &["collision", "visual"],
            bearing: &["link", "joint", "loop", "coupling"],
        };
        let parts = self.parts_of(link, &kinds)?;
        let mut inertial = None;
        let mut collisions = Vec::new();
        let mut visuals = Vec::new();
        for part in parts {
            // Nothing in a link says how it can move, so a fault there is no reason to refuse the file.
            let read = match part.name() {
                "inertial" => self.read_inertial(part).map(|read| inertial = Some(read)),
                "collision" => self.read_shape(part).map(|shape| collisions.push(shape)),
                _ => self.read_shape(part).map(|shape| visuals.push(shape)),
            };
            if let Err(fault) = read {
                self.skip_faulty(part, &fault);
            }
        }
        self.builder
            .detailed_link(name, inertial, collisions, visuals);
        Ok(())
    }

    fn read_inertial(&mut self, inertial: Element<'a>) -> Outcome<Inertial> {
        self.attributes_of(inertial, &[], false)?;
        let parts = self.passive(inertial, &["origin", "mass", "inertia"])?;
        let mut origin = Frame::identity();
        let (mut mass, mut inertia) = (None, None);
        for part in parts {
            match part.name() {
                "origin" => origin = self.origin(part)?,
                "mass" => {
                    self.leaf_of(part, &["value"], false)?;
                    let value = part.required("value")?;
                    let number = self.number(value)?;
                    if number.value() < 0.0 {
                        return Err(value.fault("the mass is negative"));
                    }
                    mass = Some(number);
                }
                _ => {
                    const COMPONENTS: [&str; 6] = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
                    self.leaf_of(part, &COMPONENTS, false)?;
                    let mut component = |name: &str| match part.attribute(name) {
                        Some(attribute) => self.number(attribute),
                        // The products of inertia are zero in principal axes, and so commonly left out.
                        None if !["ixx", "iyy", "izz"].contains(&name) => {
                            let what = format!("<inertia> without `{name}`, taken as 0");
                            self.skip_because(part, what);
                            Ok(Number::zero())
                        }
                        None => part.required(name).map(|_| Number::zero()),
                    };
                    let [xx, xy, xz, yy, yz, zz] = COMPONENTS;
                    inertia = Some([
                        component(xx)?,
                        component(xy)?,
                        component(xz)?,
                        component(yy)?,
                        component(yz)?,
                        component(zz)?,
                    ]);
                }
            }
        }
        let needs = |what: &str| {
            inertial.fault(format!("<inertial> needs <{what}>")).help(
                "<inertial><mass value=\"...\"/><inertia ixx ixy ixz iyy iyz izz/></inertial>",
            )
        };
        Ok(Inertial {
            origin,
            mass: mass.ok_or_else(|| needs("mass"))?,
            inertia: inertia.ok_or_else(|| needs("inertia"))?,
        })
    }

    /// The parts of an element that says nothing about motion.
    fn passive(&mut self, element: Element<'a>, known: &[&str]) -> Outcome<Vec<Element<'a>>> {
        let kinds = Parts {
            known,
            often: &[],
            bearing: &[],
        };
        self.parts_of(element, &kinds)
    }

    /// `<collision>` and `<visual>`. The material is no part of the model and recorded as skipped.
    fn read_shape(&mut self, shape: Element<'a>) -> Outcome<Shape> {
        self.attributes_of(shape, &["name"], false)?;
        let parts = self.passive(shape, &["origin", "geometry"])?;
        let mut origin = Frame::identity();
        let mut geometry = None;
        for part in parts {
            match part.name() {
                "origin" => origin = self.origin(part)?,
                _ => geometry = Some(self.read_geometry(part)?),
            }
        }
        Ok(Shape {
            name: shape.attribute("name").map(|name| name.value.to_owned()),
            origin,
            geometry: geometry
                .ok_or_else(|| shape.fault(format!("<{}> needs <geometry>", shape.name())))?,
        })
    }

    fn read_geometry(&mut self, geometry: Element<'a>) -> Outcome<Geometry> {
        const SOLIDS: [&str; 5] = ["box", "cylinder", "capsule", "sphere", "mesh"];
        self.attributes_of(geometry, &[], false)?;
        let parts = self.passive(geometry, &SOLIDS)?;
        let solid = match parts.as_slice() {
            [] => {
                return Err(geometry
                    .fault("<geometry> needs a solid, found nothing")
                    .help("a box, cylinder, capsule, sphere or mesh"));
            }
            [solid] => *solid,
            [_, second, ..] => return Err(second.fault("<geometry> has a second solid")),
        };
        match solid.name() {
            "box" => {
                self.leaf_of(solid, &["size"], false)?;
                let size = solid.required("size")?;
                Ok(Geometry::Box(self.lengths(size)?))
            }
            "sphere" => {
                self.leaf_of(solid, &["radius"], false)?;
                let radius = solid.required("radius")?;
                let [radius] = self.lengths(radius)?;
                Ok(Geometry::Sphere(radius))
            }
            "mesh" => {
                self.leaf_of(solid, &["filename", "scale"], false)?;
                let scale = solid.attribute("scale").map(|scale| self.numbers(scale));
                Ok(Geometry::Mesh {
                    filename: solid.required("filename")?.value.to_owned(),
                    scale: scale.transpose()?,
                })
            }
            round => {
                self.leaf_of(solid, &["radius", "length"], false)?;
                let (radius, length) = (solid.required("radius")?, solid.required("length")?);
                let ([radius], [length]) = (self.lengths(radius)?, self.lengths(length)?);
                Ok(if round == "cylinder" {
                    Geometry::Cylinder { radius, length }
                } else {
                    Geometry::Capsule { radius, length }
                })
            }
        }
    }

    /// Lengths of a solid in metres, none negative.
    fn lengths<const N: usize>(&mut self, attribute: Attribute<'a>) -> Outcome<[Number; N]> {
        let lengths = self.numbers(attribute)?;
        if lengths.iter().any(|length: &Number| length.value() < 0.0) {
            return Err(attribute.fault("a length of a solid is negative"));
        }
        Ok(lengths)
    }
}
