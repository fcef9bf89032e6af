//! `<link>`: mass properties and shapes.

use super::element::{Attribute, Element};
use super::error::Outcome;
use super::names::Named;
use super::reader::{Reader, SKIPPED};
use crate::mechanism::{Frame, Geometry, Inertial, Shape};
use crate::number::Number;

impl<'a> Reader<'a> {
    /// `<link name>` with `<inertial>`, any number of `<collision>` and `<visual>`.
    pub(super) fn read_link(&mut self, link: Element<'a>) -> Outcome<()> {
        self.note_foreign_attributes(link, &["name"])?;
        let name = self.directory.add(Named::Link, link)?;
        let parts = self.parts(link, &["inertial"], &["collision", "visual"], &SKIPPED)?;
        let mut inertial = None;
        let mut collisions = Vec::new();
        let mut visuals = Vec::new();
        for part in parts {
            match part.name() {
                "inertial" => inertial = Some(self.read_inertial(part)?),
                "collision" => collisions.push(self.read_shape(part)?),
                // A picture says nothing about motion, so a faulty one is no reason to refuse the file.
                _ => match self.read_shape(part) {
                    Ok(shape) => visuals.push(shape),
                    Err(fault) => self.skip_faulty(part, &fault),
                },
            }
        }
        self.builder
            .detailed_link(name, inertial, collisions, visuals);
        Ok(())
    }

    fn read_inertial(&mut self, inertial: Element<'a>) -> Outcome<Inertial> {
        self.note_foreign_attributes(inertial, &[])?;
        let parts = self.parts(inertial, &["origin", "mass", "inertia"], &[], &[])?;
        let mut origin = Frame::identity();
        let (mut mass, mut inertia) = (None, None);
        for part in parts {
            match part.name() {
                "origin" => origin = self.origin(part)?,
                "mass" => {
                    self.leaf(part, &["value"])?;
                    let value = part.required("value")?;
                    let number = self.number(value)?;
                    if number.value() < 0.0 {
                        return Err(value.fault("the mass is negative"));
                    }
                    mass = Some(number);
                }
                _ => {
                    const COMPONENTS: [&str; 6] = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
                    self.leaf(part, &COMPONENTS)?;
                    let mut component = |name| {
                        let attribute = part.required(name)?;
                        self.number(attribute)
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

    /// `<collision>` and `<visual>`. The material is no part of the model and recorded as skipped.
    fn read_shape(&mut self, shape: Element<'a>) -> Outcome<Shape> {
        self.note_foreign_attributes(shape, &["name"])?;
        let parts = self.parts(shape, &["origin", "geometry"], &[], &["material"])?;
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
        self.note_foreign_attributes(geometry, &[])?;
        let parts = self.parts(geometry, &SOLIDS, &[], &[])?;
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
                self.leaf(solid, &["size"])?;
                let size = solid.required("size")?;
                Ok(Geometry::Box(self.lengths(size)?))
            }
            "sphere" => {
                self.leaf(solid, &["radius"])?;
                let radius = solid.required("radius")?;
                let [radius] = self.lengths(radius)?;
                Ok(Geometry::Sphere(radius))
            }
            "mesh" => {
                self.leaf(solid, &["filename", "scale"])?;
                let scale = solid.attribute("scale").map(|scale| self.numbers(scale));
                Ok(Geometry::Mesh {
                    filename: solid.required("filename")?.value.to_owned(),
                    scale: scale.transpose()?,
                })
            }
            round => {
                self.leaf(solid, &["radius", "length"])?;
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
