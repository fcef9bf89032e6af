//! Links: where they are drawn, their masses and shapes.

use super::super::body::{EXTENT, is_body};
use super::super::place::{Place, texts};
use super::{Sdf, holding, line, six};
use kutzbach_format::escaped;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Geometry, Inertial, LinkId, Shape};
use std::collections::BTreeSet;

/// Mass (kg) and moments of inertia (kg m²) of a link that the file gives none, and of one that only stands between joints.
const DEFAULT: [&str; 2] = ["0.1", "0.001"];
const SMALL: [&str; 2] = ["0.001", "1e-06"];

impl Sdf<'_> {
    /// Writes a link, where it is in a frame of the file.
    pub(super) fn link(&mut self, link: LinkId, at: Option<(&str, &Place)>) {
        let mechanism = self.mechanism;
        let known = mechanism.link(link);
        let name = escaped(self.body(link)).into_owned();
        let mut lines = vec![format!("<link name=\"{name}\">")];
        lines.extend(at.map(pose));
        let mass = known.inertial.as_ref().filter(|mass| is_body(mass));
        match mass {
            Some(mass) => lines.extend(inertial(mass)),
            None => {
                if known.inertial.is_some() {
                    self.not_said.push(format!(
                        "the mass of `{}`: no body has this mass and these moments of inertia",
                        known.name
                    ));
                }
                if link != mechanism.ground() {
                    self.without_mass += 1;
                    lines.extend(round(DEFAULT));
                }
            }
        }
        for (element, shapes) in [("visual", &known.visuals), ("collision", &known.collisions)] {
            let mut names = BTreeSet::new();
            for shape in shapes {
                match solid(shape) {
                    Some(solid) => lines.extend(drawn(element, shape, &solid, &mut names)),
                    None => self.lost_shapes += 1,
                }
            }
        }
        self.put_link(lines);
    }

    /// Writes a link that only stands between two joints.
    pub(super) fn small_link(&mut self, name: &str, frame: &str, place: &Place) {
        let mut lines = vec![
            format!("<link name=\"{}\">", escaped(name)),
            pose((frame, place)),
        ];
        lines.extend(round(SMALL));
        self.put_link(lines);
    }

    fn put_link(&mut self, lines: Vec<String>) {
        let Some((first, inside)) = lines.split_first() else {
            return;
        };
        if inside.is_empty() {
            let empty = format!("{}/>", first.trim_end_matches('>'));
            return line(&mut self.links, 2, &empty);
        }
        line(&mut self.links, 2, first);
        for one in inside {
            line(&mut self.links, 3, one);
        }
        line(&mut self.links, 2, "</link>");
    }
}

fn pose((frame, place): (&str, &Place)) -> String {
    let frame = escaped(frame);
    format!("<pose relative_to=\"{frame}\">{}</pose>", six(place))
}

/// Masses as the file states them.
fn inertial(mass: &Inertial) -> Vec<String> {
    let names = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"];
    let moments: String = names
        .iter()
        .zip(&mass.inertia)
        .map(|(name, moment)| holding(name, moment))
        .collect();
    let mut lines = vec!["<inertial>".to_owned()];
    if !mass.origin.is_identity() {
        let place = six(&Place::Stated(mass.origin.clone()));
        lines.push(format!("  <pose>{place}</pose>"));
    }
    lines.push(format!("  {}", holding("mass", &mass.mass)));
    lines.push(format!("  <inertia>{moments}</inertia>"));
    lines.push("</inertial>".to_owned());
    lines
}

/// A mass at the link's origin, the same about all axes.
fn round([mass, moment]: [&str; 2]) -> Vec<String> {
    let moments = ["ixx", "iyy", "izz"].map(|name| format!("<{name}>{moment}</{name}>"));
    vec![format!(
        "<inertial><mass>{mass}</mass><inertia>{}</inertia></inertial>",
        moments.concat()
    )]
}

/// A shape under a name that no other one of its sort has in the link.
fn drawn(element: &str, shape: &Shape, solid: &str, names: &mut BTreeSet<String>) -> Vec<String> {
    let wanted = shape.name.as_deref().unwrap_or(element);
    let name = super::unused(names, &super::allowed(wanted));
    let mut lines = vec![format!("<{element} name=\"{}\">", escaped(&name))];
    if !shape.origin.is_identity() {
        let place = six(&Place::Stated(shape.origin.clone()));
        lines.push(format!("  <pose>{place}</pose>"));
    }
    lines.push(format!("  <geometry>{solid}</geometry>"));
    lines.push(format!("</{element}>"));
    lines
}

/// What is inside of `<geometry>`; `None` for a shape without extent.
fn solid(shape: &Shape) -> Option<String> {
    let round = |word: &str, radius: &Number, length: &Number| {
        let [radius, length] = [("radius", radius), ("length", length)]
            .map(|(element, number)| holding(element, number));
        format!("<{word}>{radius}{length}</{word}>")
    };
    let (sizes, text): (Vec<&Number>, String) = match &shape.geometry {
        Geometry::Box(edges) => (
            edges.iter().collect(),
            format!("<box><size>{}</size></box>", texts(edges)),
        ),
        Geometry::Cylinder { radius, length } => {
            (vec![radius, length], round("cylinder", radius, length))
        }
        Geometry::Capsule { radius, length } => {
            (vec![radius, length], round("capsule", radius, length))
        }
        Geometry::Sphere(radius) => (
            vec![radius],
            format!("<sphere>{}</sphere>", holding("radius", radius)),
        ),
        Geometry::Mesh { filename, scale } => {
            let scale = scale.as_ref();
            let scale = scale.map(|scale| format!("<scale>{}</scale>", texts(scale)));
            let (file, scale) = (escaped(filename), scale.unwrap_or_default());
            let text = format!("<mesh><uri>{file}</uri>{scale}</mesh>");
            (Vec::new(), text)
        }
    };
    let has_extent = sizes.iter().all(|size| size.value() > EXTENT);
    has_extent.then_some(text)
}
