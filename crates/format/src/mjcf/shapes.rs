//! `<geom>`: which solid it is and where, whether it touches others, whether it is drawn, and what it weighs.

use super::Mjcf;
use super::bodies::{Found, between};
use super::mass::full;
use super::pose::{exactly, numbers};
use crate::element::Element;
use crate::error::Outcome;
use crate::frames::one_after_another;
use crate::words::quoted;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Frame, Geometry, Shape};

/// Groups of geoms that MuJoCo draws unless it is told otherwise: those below this one.
const FIRST_HIDDEN: f64 = 3.0;

/// Types that `fromto` can place.
const LONG: [&str; 4] = ["capsule", "cylinder", "ellipsoid", "box"];

/// A solid by its half sizes, as MuJoCo has them.
pub(super) enum Form<'a> {
    Sphere(Number),
    Capsule {
        radius: Number,
        half: Number,
    },
    Cylinder {
        radius: Number,
        half: Number,
    },
    Ellipsoid([Number; 3]),
    Box([Number; 3]),
    /// What has no volume: planes and height fields, which stand still.
    Flat(&'a str),
    /// What another file says: meshes, and solids that are fitted to meshes.
    Unknown(&'a str),
}

/// What a geom says of its mass.
pub(super) enum Weight {
    Mass(Number),
    /// In kg/m³.
    Density(f64),
}

/// A geom as it was read.
pub(super) struct Geom<'a> {
    name: Option<&'a str>,
    pub(super) frame: Frame,
    pub(super) form: Form<'a>,
    pub(super) weight: Weight,
    /// Whether it is a shell, whose moments are those of its surface.
    pub(super) is_shell: bool,
    pub(super) touches: bool,
    pub(super) is_drawn: bool,
}

impl Form<'_> {
    /// The solid in words of the model; `None` for what it has no word for.
    fn geometry(&self) -> Option<Geometry> {
        let twice = |half: &Number| half + half;
        Some(match self {
            Self::Sphere(radius) => Geometry::Sphere(radius.clone()),
            Self::Capsule { radius, half } => Geometry::Capsule {
                radius: radius.clone(),
                length: twice(half),
            },
            Self::Cylinder { radius, half } => Geometry::Cylinder {
                radius: radius.clone(),
                length: twice(half),
            },
            Self::Box(half) => Geometry::Box(half.each_ref().map(twice)),
            Self::Ellipsoid(_) | Self::Flat(_) | Self::Unknown(_) => return None,
        })
    }

    /// MuJoCo's word for it.
    pub(super) fn word(&self) -> &str {
        match self {
            Self::Sphere(_) => "sphere",
            Self::Capsule { .. } => "capsule",
            Self::Cylinder { .. } => "cylinder",
            Self::Ellipsoid(_) => "ellipsoid",
            Self::Box(_) => "box",
            Self::Flat(word) | Self::Unknown(word) => word,
        }
    }
}

impl Geom<'_> {
    /// The shape, where the model has a word for it.
    pub(super) fn shape(&self) -> Option<Shape> {
        Some(Shape {
            name: self.name.map(str::to_owned),
            origin: self.frame.clone(),
            geometry: self.form.geometry()?,
        })
    }
}

impl<'a> Mjcf<'a> {
    /// Reads a geom.
    pub(super) fn geom(&self, found: &Found<'a>) -> Outcome<Geom<'a>> {
        let element = found.element;
        let class = self.classes.of(element, found.class)?;
        let attribute = |name: &str| self.classes.attribute(element, class, name);
        let word = attribute("type").map_or("sphere", |word| word.value);
        let (own, form) = match attribute("mesh") {
            Some(_) => (self.frame(element, class)?, Form::Unknown("mesh")),
            None => self.form(element, class, word)?,
        };
        let number = |name: &str| -> Outcome<Option<Number>> {
            let Some(attribute) = attribute(name) else {
                return Ok(None);
            };
            let [number] = exactly(attribute)?;
            Ok(Some(number))
        };
        let is_zero = |name: &str| -> Outcome<bool> {
            Ok(number(name)?.is_some_and(|number| number.is_zero()))
        };
        let weight = match number("mass")? {
            Some(mass) => Weight::Mass(mass),
            None => Weight::Density(number("density")?.map_or(1000.0, |own| own.value())),
        };
        let touches = !(is_zero("contype")? && is_zero("conaffinity")?);
        let group = number("group")?.map_or(0.0, |group| group.value());
        Ok(Geom {
            name: element.attribute("name").map(|name| name.value),
            frame: one_after_another(&found.frame, &own),
            form,
            weight,
            is_shell: attribute("shellinertia").is_some_and(|word| word.value == "true"),
            touches,
            is_drawn: !touches || group < FIRST_HIDDEN,
        })
    }

    /// The solid of a geom and its frame in the body.
    fn form(&self, element: Element<'a>, class: &str, word: &'a str) -> Outcome<(Frame, Form<'a>)> {
        let mut sizes = self.sizes(element, class)?;
        let ends = self.classes.attribute(element, class, "fromto");
        let frame = match ends {
            Some(ends) if LONG.contains(&word) => {
                let points: [Number; 6] = exactly(ends)?;
                let [a, b, c, d, e, f] = points.each_ref().map(Number::value);
                let half = full((a - d).hypot(b - e).hypot(c - f) / 2.0);
                let [first, ..] = sizes;
                // Boxes and ellipsoids are as wide as they are deep.
                sizes = match word {
                    "capsule" | "cylinder" => [first, half, Number::zero()],
                    _ => [first.clone(), first, half],
                };
                between(points).ok_or_else(|| ends.fault("the two points of `fromto` are one"))?
            }
            _ => self.frame(element, class)?,
        };
        let [x, y, z] = sizes;
        let (form, needed) = match word {
            "sphere" => (Form::Sphere(x.clone()), vec![x]),
            "capsule" | "cylinder" => {
                let needed = vec![x.clone(), y.clone()];
                let form = match word {
                    "capsule" => Form::Capsule { radius: x, half: y },
                    _ => Form::Cylinder { radius: x, half: y },
                };
                (form, needed)
            }
            "ellipsoid" | "box" => {
                let needed = vec![x.clone(), y.clone(), z.clone()];
                let form = match word {
                    "box" => Form::Box([x, y, z]),
                    _ => Form::Ellipsoid([x, y, z]),
                };
                (form, needed)
            }
            "plane" | "hfield" => (Form::Flat(word), Vec::new()),
            "mesh" | "sdf" => (Form::Unknown(word), Vec::new()),
            other => {
                return Err(element.fault(format!("there is no type of geom {}", quoted(other))));
            }
        };
        if needed.iter().any(|size| size.value() <= 0.0) {
            return Err(element.fault(format!("a {word} needs sizes above zero")));
        }
        Ok((frame, form))
    }

    /// Up to three half sizes. Fewer numbers leave the others to the class.
    fn sizes(&self, element: Element<'a>, class: &str) -> Outcome<[Number; 3]> {
        let mut sizes = [Number::zero(), Number::zero(), Number::zero()];
        for level in self.classes.each(element, class, "size").into_iter().rev() {
            for (size, own) in sizes.iter_mut().zip(numbers(level)?) {
                *size = own;
            }
        }
        Ok(sizes)
    }
}
