//! Masses: `<inertial>`, or where a body has none, those of its geoms, as MuJoCo adds them up.
//!
//! Of several geoms the moments are those about the common centre of mass, along the axes of the body (parallel axes: Steiner). Nothing here says
//! how a body can move, so what cannot be read is counted and no reason to refuse the file.

use super::Mjcf;
use super::bodies::Found;
use super::classes::MAIN;
use super::pose::exactly;
use super::shapes::{Form, Geom, Weight};
use crate::element::Element;
use crate::error::{Fault, Outcome};
use crate::frames::{is_turned, one_after_another, sum};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Frame, Inertial, Shape};
use std::f64::consts::PI;

/// What a body weighs and what it looks like.
#[derive(Default)]
pub(super) struct Load {
    pub(super) inertial: Option<Inertial>,
    pub(super) collisions: Vec<Shape>,
    pub(super) visuals: Vec<Shape>,
}

/// A mass in a body: its centre, and the moments about that along the axes of the body.
struct Lump {
    mass: Number,
    centre: [f64; 3],
    inertia: [[f64; 3]; 3],
}

/// What geoms of a body weigh.
#[derive(Default)]
struct Lumps {
    all: Vec<Lump>,
    /// Whether there is one whose mass or moments only another file says.
    is_open: bool,
}

/// A double as the shortest decimal that says it.
pub(super) fn full(value: f64) -> Number {
    match value == 0.0 {
        true => Number::zero(),
        false => Number::decimal(&format!("{value:e}")).unwrap_or_else(|_| Number::zero()),
    }
}

impl<'a> Mjcf<'a> {
    /// Mass and shapes of a body, or the shapes of the world.
    ///
    /// # Errors
    /// Classes that are not there, and frames inside the body that cannot be read: they place joints too.
    pub(super) fn load_of(&mut self, body: Element<'a>, class: Option<&'a str>) -> Outcome<Load> {
        let mut load = Load::default();
        let mut stated = None;
        let mut lumps = Lumps::default();
        let source = self.source.clone();
        for found in self.parts_of(body, class, &["geom", "inertial"])? {
            self.source = found.source.clone();
            let read = match found.element.name() {
                "inertial" if stated.is_some() => {
                    Err(found.element.fault("the body has one already"))
                }
                "inertial" => self.inertial(&found).map(|own| stated = Some(own)),
                _ => self
                    .geom(&found)
                    .map(|geom| self.take_geom(found.element, &geom, &mut load, &mut lumps)),
            };
            if let Err(fault) = read {
                self.not_read(found.element, &fault);
            }
        }
        self.source = source;
        if body.name() != "body" {
            return Ok(load);
        }
        load.inertial = match (self.source.compiler.mass_of_geoms, stated) {
            (Some(false), stated) | (None, stated @ Some(_)) => stated,
            _ if lumps.is_open => {
                let what = "mass of a body that depends on a mesh or a shell";
                self.unread.standard_text(body.start(), what.to_owned());
                None
            }
            _ => together(&lumps.all),
        };
        Ok(load)
    }

    fn not_read(&mut self, element: Element<'a>, fault: &Fault) {
        let what = format!("<{}>: {}", element.name(), fault.message);
        self.unread.text(element.start(), what);
    }

    fn take_geom(
        &mut self,
        element: Element<'a>,
        geom: &Geom<'a>,
        load: &mut Load,
        lumps: &mut Lumps,
    ) {
        match geom.shape() {
            Some(shape) => {
                if geom.is_drawn {
                    load.visuals.push(shape.clone());
                }
                if geom.touches {
                    load.collisions.push(shape);
                }
            }
            None => {
                let what = format!("shape of <geom type=\"{}\">", geom.form.word());
                self.unread.standard_text(element.start(), what);
            }
        }
        let weighs_nothing = match &geom.weight {
            Weight::Mass(mass) => mass.value() <= 0.0,
            Weight::Density(density) => *density <= 0.0,
        };
        match &geom.form {
            Form::Flat(_) => {}
            _ if weighs_nothing => {}
            Form::Unknown(_) => lumps.is_open = true,
            _ if geom.is_shell => lumps.is_open = true,
            _ => lumps.all.push(lump(geom)),
        }
    }

    fn inertial(&self, found: &Found<'a>) -> Outcome<Inertial> {
        let element = found.element;
        let weight = element.required("mass")?;
        let [mass]: [Number; 1] = exactly(weight)?;
        if mass.value() < 0.0 {
            return Err(weight.fault("the mass is negative"));
        }
        let own = self.frame(element, MAIN)?;
        let zero = Number::zero;
        let full = element.attribute("fullinertia");
        let inertia = match (full, element.attribute("diaginertia")) {
            (Some(_), Some(twice)) => {
                return Err(twice.fault("`fullinertia` and `diaginertia` say the same"));
            }
            (Some(full), None) if is_turned(&own) => {
                return Err(full.fault(
                    "`fullinertia` is along the axes of the body: its frame is not turned",
                ));
            }
            (Some(full), None) => {
                let [xx, yy, zz, xy, xz, yz]: [Number; 6] = exactly(full)?;
                [xx, xy, xz, yy, yz, zz]
            }
            (None, Some(diagonal)) => {
                let [x, y, z]: [Number; 3] = exactly(diagonal)?;
                [x, zero(), zero(), y, zero(), z]
            }
            (None, None) => [zero(), zero(), zero(), zero(), zero(), zero()],
        };
        Ok(Inertial {
            origin: one_after_another(&found.frame, &own),
            mass,
            inertia,
        })
    }
}

/// The volume of a solid, and its moments about its axes for a mass of 1.
fn measures(form: &Form<'_>) -> (f64, [f64; 3]) {
    let ball = |[a, b, c]: [f64; 3]| 4.0 / 3.0 * PI * a * b * c;
    let spread = |part: f64, [a, b, c]: [f64; 3]| {
        [b * b + c * c, a * a + c * c, a * a + b * b].map(|squares| squares / part)
    };
    match form {
        Form::Sphere(radius) => {
            let all = [radius.value(); 3];
            (ball(all), spread(5.0, all))
        }
        Form::Ellipsoid(half) => {
            let half = half.each_ref().map(Number::value);
            (ball(half), spread(5.0, half))
        }
        Form::Box(half) => {
            let half = half.each_ref().map(Number::value);
            (8.0 * half.iter().product::<f64>(), spread(3.0, half))
        }
        Form::Cylinder { radius, half } => {
            let (r, h) = (radius.value(), half.value());
            let across = r * r / 4.0 + h * h / 3.0;
            (2.0 * PI * r * r * h, [across, across, r * r / 2.0])
        }
        Form::Capsule { radius, half } => {
            let (r, h) = (radius.value(), half.value());
            let (rod, ends) = (2.0 * PI * r * r * h, ball([r; 3]));
            let whole = rod + ends;
            // Centres of half balls are 3/8 of the radius beyond the ends of the rod.
            let of_ends = 0.4 * r * r + h * h + 0.75 * r * h;
            let across = (rod * (r * r / 4.0 + h * h / 3.0) + ends * of_ends) / whole;
            let along = (rod * r * r / 2.0 + ends * 0.4 * r * r) / whole;
            (whole, [across, across, along])
        }
        Form::Flat(_) | Form::Unknown(_) => (0.0, [0.0; 3]),
    }
}

fn lump(geom: &Geom<'_>) -> Lump {
    let (volume, moments) = measures(&geom.form);
    let mass = match &geom.weight {
        Weight::Mass(mass) => mass.clone(),
        Weight::Density(density) => full(density * volume),
    };
    let pose = geom.frame.to_doubles();
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|e| pose.rotate(&e));
    let weight = mass.value();
    let entry = |i: usize, j: usize| -> f64 {
        (0..3)
            .map(|k| weight * moments[k] * axes[k][i] * axes[k][j])
            .sum()
    };
    Lump {
        mass,
        centre: pose.apply(&[0.0; 3]),
        inertia: [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j))),
    }
}

/// Masses as one; `None` where there is none.
fn together(lumps: &[Lump]) -> Option<Inertial> {
    let mass = lumps
        .iter()
        .fold(Number::zero(), |all, lump| sum(&all, &lump.mass));
    let whole = mass.value();
    if !(whole > 0.0 && whole.is_finite()) {
        return None;
    }
    let centre = [0, 1, 2].map(|i| {
        let moment: f64 = lumps
            .iter()
            .map(|lump| lump.mass.value() * lump.centre[i])
            .sum();
        moment / whole
    });
    let entry = |i: usize, j: usize| -> Number {
        let parts = lumps.iter().map(|lump| {
            let arm = [0, 1, 2].map(|k| lump.centre[k] - centre[k]);
            let square: f64 = arm.iter().map(|x| x * x).sum();
            let own = if i == j { square } else { 0.0 };
            lump.inertia[i][j] + lump.mass.value() * (own - arm[i] * arm[j])
        });
        full(parts.sum())
    };
    Some(Inertial {
        origin: Frame::at(centre.map(full)),
        mass,
        inertia: [
            entry(0, 0),
            entry(0, 1),
            entry(0, 2),
            entry(1, 1),
            entry(1, 2),
            entry(2, 2),
        ],
    })
}
