//! A mechanism as coloured solids: plain data for whatever draws it.

use super::appearance::{AXIS, Colour, GROUND, Roles, joint_colour, link_colour};
use super::joint_symbols::{Piece, axis_arrow, symbol};
use super::link_shapes::{Solid, joined, visuals};
use super::vectors::{Point, difference, norm, pose_of, sum, times};
use kutzbach_closure::{Geometry, Rigid, least_length};
use kutzbach_model::mechanism::{JointKind, Mechanism};

/// A solid about its own origin; lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Primitive {
    /// Edge lengths along x, y and z.
    Box {
        /// Edge lengths.
        size: [f64; 3],
    },
    /// Along z, centred.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Length along z.
        length: f64,
    },
    /// A ball.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// From the origin along +z.
    Arrow {
        /// Radius of the shaft.
        radius: f64,
        /// Length, head included.
        length: f64,
    },
}

impl Primitive {
    /// Its extension along each axis of its own frame.
    #[must_use]
    pub fn size(&self) -> [f64; 3] {
        match *self {
            Self::Box { size } => size,
            Self::Cylinder { radius, length } | Self::Arrow { radius, length } => {
                [2.0 * radius, 2.0 * radius, length]
            }
            Self::Sphere { radius } => [2.0 * radius; 3],
        }
    }
}

/// What a shape stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// The link itself.
    Link,
    /// A joint's symbol, by index of the joint.
    Joint(usize),
    /// A joint's axis, by index of the joint.
    Axis(usize),
}

/// A solid fixed in a link.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Index of the link that carries it.
    pub link: usize,
    /// What it stands for.
    pub part: Part,
    /// `link_from_shape`.
    pub pose: Rigid<f64>,
    /// The solid.
    pub primitive: Primitive,
    /// Its colour.
    pub colour: Colour,
}

/// All shapes of a mechanism and the lengths they were chosen by.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// By link, then by joint.
    pub shapes: Vec<Shape>,
    /// Diagonal of the box around all joints and shapes of links at home (m); positive.
    pub extent: f64,
    /// Radius of a joint's symbol (m); positive.
    pub radius: f64,
    /// Smallest and largest coordinates of that box, in the world frame (m).
    pub bounds: [[f64; 3]; 2],
}

/// Radius of a joint's symbol, in units of the usual distance between joints of a link.
const RADIUS_BY_DISTANCE: f64 = 0.07;
/// However far or close joints are: bounds of the radius in units of the mechanism's extent.
const RADIUS_BY_EXTENT: [f64; 2] = [0.002, 0.02];

/// A link with one joint only, of which nothing else is known, reaches on in the direction in which the link before it came: half as far.
/// The ground needs no end.
fn reach_on(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    own: &[Option<Vec<Solid>>],
    incident: &mut [Vec<Point>],
) {
    let place = |link: usize, point: Point| {
        let point = Rigid::translation(point);
        geometry.home[link].compose(&point).translation
    };
    let ends: Vec<(usize, Point)> = mechanism
        .joints()
        .iter()
        .flat_map(|joint| {
            let [a, b] = [joint.predecessor.link.0, joint.successor.link.0];
            [[a, b], [b, a]]
        })
        .filter(|[before, last]| {
            let single = incident[*last].len() == 1 && incident[*before].len() > 1;
            let bare = own[*last].is_none() && mechanism.links()[*last].inertial.is_none();
            single && bare && *last != mechanism.ground().0
        })
        .filter_map(|[before, last]| {
            let here = place(last, *incident[last].first()?);
            let others = incident[before].iter().map(|point| place(before, *point));
            let ways = others.map(|other| difference(here, other));
            let way = ways.max_by(|a, b| norm(*a).total_cmp(&norm(*b)))?;
            let end = Rigid::translation(sum(here, times(way, 0.5)));
            let inside = geometry.home[last].inverse().compose(&end).translation;
            Some((last, inside))
        })
        .collect();
    for (link, point) in ends {
        incident[link].push(point);
    }
}

impl Drawing {
    /// Draws every link and joint of a mechanism at its home pose.
    ///
    /// A link is drawn by the file's visuals where these are simple solids, otherwise by rods between its joints, so that
    /// every link has at least one shape. Where all joints lie in one point (spherical mechanisms), those with an axis
    /// are drawn at unit distance along it. Cost: linear in the mechanism, but for sorting distances.
    #[must_use]
    pub fn new(mechanism: &Mechanism, geometry: &Geometry<f64>, roles: &Roles) -> Self {
        let own: Vec<Option<Vec<Solid>>> = mechanism.links().iter().map(visuals).collect();
        let points = joint_points(mechanism, geometry);
        let mut incident: Vec<Vec<Point>> = vec![Vec::new(); mechanism.links().len()];
        for (joint, sides) in mechanism.joints().iter().zip(&points) {
            incident[joint.predecessor.link.0].push(sides[0]);
            incident[joint.successor.link.0].push(sides[1]);
        }
        reach_on(mechanism, geometry, &own, &mut incident);
        let bounds = bounds(geometry, &incident, &own);
        let mut extent = norm(difference(bounds[1], bounds[0]));
        if !(extent > least_length(geometry.size_of(0..geometry.sides.len())) && extent.is_finite())
        {
            extent = 1.0;
        }
        for (link, points) in mechanism.links().iter().zip(&mut incident) {
            // A link with one joint reaches as far as its centre of mass.
            if let (1, Some(inertial)) = (points.len(), &link.inertial) {
                points.push(pose_of(&inertial.origin).translation);
            }
        }
        let radius = symbol_radius(&incident, extent);
        let mut shapes = Vec::new();
        for (index, own) in own.into_iter().enumerate() {
            let colour = if index == mechanism.ground().0 {
                GROUND
            } else {
                link_colour(index, roles.link(index))
            };
            let solids = own.unwrap_or_else(|| joined(&incident[index], 0.6 * radius));
            shapes.extend(solids.into_iter().map(|(pose, primitive)| Shape {
                link: index,
                part: Part::Link,
                pose,
                primitive,
                colour,
            }));
        }
        for (index, joint) in mechanism.joints().iter().enumerate() {
            let displacement = &geometry.displacements[index];
            let colour = joint_colour(roles.joint(index));
            let links = [joint.predecessor.link.0, joint.successor.link.0];
            let mut add = |piece: Piece, part: Part, colour: Colour| {
                let side = usize::from(piece.on_successor);
                // The symbol stands where the rods of its links end.
                let mut frame = geometry.sides[index][side].clone();
                frame.translation = points[index][side];
                shapes.push(Shape {
                    link: links[side],
                    part,
                    pose: frame.compose(&piece.pose),
                    primitive: piece.primitive,
                    colour,
                });
            };
            for piece in symbol(displacement, radius) {
                add(piece, Part::Joint(index), colour);
            }
            if let Some(piece) = axis_arrow(displacement, radius) {
                add(piece, Part::Axis(index), AXIS);
            }
        }
        Self {
            shapes,
            extent,
            radius,
            bounds,
        }
    }
}

/// Where every joint is drawn, in the frames of its two links.
fn joint_points(mechanism: &Mechanism, geometry: &Geometry<f64>) -> Vec<[Point; 2]> {
    let mut points: Vec<[Point; 2]> = geometry
        .sides
        .iter()
        .map(|[a, b]| [a.translation, b.translation])
        .collect();
    let size = geometry.size_of(0..geometry.sides.len());
    let least = least_length(size);
    let mut in_world = mechanism
        .joints()
        .iter()
        .zip(&points)
        .flat_map(|(joint, sides)| {
            let home = |link: usize, point: &Point| geometry.home[link].apply(point);
            [
                home(joint.predecessor.link.0, &sides[0]),
                home(joint.successor.link.0, &sides[1]),
            ]
        });
    let one_point = match in_world.next() {
        Some(first) => in_world.all(|point| !(norm(difference(point, first)) > least)),
        None => false,
    };
    if one_point {
        let distance = if size > least { size } else { 1.0 };
        for (index, joint) in mechanism.joints().iter().enumerate() {
            // Any point of the axis serves these: it is the same axis on both sides.
            if matches!(
                joint.kind,
                JointKind::Revolute
                    | JointKind::Prismatic
                    | JointKind::Screw
                    | JointKind::Cylindrical
            ) {
                let offset = times(*geometry.displacements[index].axis(), distance);
                for (point, side) in points[index].iter_mut().zip(&geometry.sides[index]) {
                    *point = sum(*point, side.rotate(&offset));
                }
            }
        }
    }
    points
}

/// The box around all joints and visuals at home, in the world frame; one point where there is nothing.
fn bounds(
    geometry: &Geometry<f64>,
    incident: &[Vec<Point>],
    own: &[Option<Vec<Solid>>],
) -> [Point; 2] {
    let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    let mut include = |point: Point, reach: f64| {
        for i in 0..3 {
            bounds[0][i] = bounds[0][i].min(point[i] - reach);
            bounds[1][i] = bounds[1][i].max(point[i] + reach);
        }
    };
    for (index, home) in geometry.home.iter().enumerate() {
        for point in &incident[index] {
            include(home.apply(point), 0.0);
        }
        for (pose, primitive) in own[index].iter().flatten() {
            include(home.apply(&pose.translation), 0.5 * norm(primitive.size()));
        }
    }
    if bounds.iter().flatten().all(|x| x.is_finite()) {
        bounds
    } else {
        [[0.0; 3]; 2]
    }
}

/// A radius that suits the usual distance between the joints of a link: the median, so that neither a long base nor a
/// small cross decides for all.
fn symbol_radius(incident: &[Vec<Point>], extent: f64) -> f64 {
    let mut distances: Vec<f64> = incident
        .iter()
        .flat_map(|points| points.windows(2))
        .map(|pair| norm(difference(pair[0], pair[1])))
        .filter(|distance| *distance > 1e-9 * extent)
        .collect();
    distances.sort_by(f64::total_cmp);
    let [least, most] = RADIUS_BY_EXTENT.map(|share| share * extent);
    match distances.get(distances.len() / 2) {
        Some(usual) => (RADIUS_BY_DISTANCE * usual).clamp(least, most),
        None => most,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_closure::Arithmetic;

    fn drawing(text: &str) -> (Mechanism, Geometry<f64>, Drawing) {
        let mechanism = kutzbach_format::read(text, "test", &[]).unwrap().mechanism;
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let drawing = Drawing::new(&mechanism, &geometry, &Roles::default());
        (mechanism, geometry, drawing)
    }

    /// Where the shapes of a part are in the world, at home.
    fn places(drawing: &Drawing, geometry: &Geometry<f64>, part: Part) -> Vec<Point> {
        let shapes = drawing.shapes.iter().filter(|shape| shape.part == part);
        shapes
            .map(|shape| geometry.home[shape.link].compose(&shape.pose).translation)
            .collect()
    }

    #[test]
    fn a_rod_runs_from_joint_to_joint() {
        let (_, geometry, drawing) = drawing(
            r#"<robot name="arm"><link name="g"/><link name="a"/><link name="b"/>
            <joint name="p" type="continuous"><parent link="g"/><child link="a"/>
              <origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>
            <joint name="q" type="continuous"><parent link="a"/><child link="b"/>
              <origin xyz="0 2 0"/><axis xyz="0 0 1"/></joint></robot>"#,
        );
        let rod = drawing
            .shapes
            .iter()
            .find(|s| s.link == 1 && matches!(s.primitive, Primitive::Cylinder { .. }))
            .unwrap();
        let Primitive::Cylinder { radius, length } = rod.primitive else {
            panic!()
        };
        assert!((length - 2.0).abs() < 1e-15 && radius < 0.1);
        let pose = geometry.home[1].compose(&rod.pose);
        let ends = [-1.0, 1.0].map(|z| pose.apply(&[0.0, 0.0, z]));
        for end in [[1.0, 0.0, 0.0], [1.0, 2.0, 0.0]] {
            assert!(ends.iter().any(|e| norm(difference(*e, end)) < 1e-15));
        }
        // Half a rod more, for the link after the last joint.
        assert!((drawing.extent - 3.0).abs() < 1e-15);
        // The pin lies along the hinge's axis, at the joint.
        assert_eq!(
            places(&drawing, &geometry, Part::Joint(1)),
            [[1.0, 2.0, 0.0]]
        );
    }

    #[test]
    fn axes_through_one_point_are_drawn_apart() {
        let (mechanism, geometry, drawing) = drawing(
            r#"<robot name="cross"><link name="g"/><link name="a"/><link name="b"/>
            <joint name="p" type="continuous"><parent link="g"/><child link="a"/>
              <axis xyz="0 0 1"/></joint>
            <joint name="q" type="continuous"><parent link="a"/><child link="b"/>
              <axis xyz="1 0 0"/></joint></robot>"#,
        );
        assert_eq!(mechanism.joints().len(), 2);
        assert_eq!(
            places(&drawing, &geometry, Part::Joint(0)),
            [[0.0, 0.0, 1.0]]
        );
        assert_eq!(
            places(&drawing, &geometry, Part::Joint(1)),
            [[1.0, 0.0, 0.0]]
        );
        assert!(drawing.radius > 1e-3 && drawing.radius < 0.1);
    }

    #[test]
    fn visuals_come_first_and_meshes_do_not_count() {
        let (_, _, drawing) = drawing(
            r#"<robot name="seen"><link name="g"><visual><geometry><mesh filename="m.stl"/></geometry></visual></link>
            <link name="a"><visual><origin xyz="0 0 3"/><geometry><capsule radius="0.5" length="2"/></geometry></visual>
              <visual><geometry><box size="0 1 1"/></geometry></visual></link>
            <joint name="p" type="continuous"><parent link="g"/><child link="a"/><axis xyz="0 0 1"/></joint></robot>"#,
        );
        let of = |link: usize| {
            let own = drawing.shapes.iter();
            own.filter(move |s| s.link == link && s.part == Part::Link)
        };
        assert!(matches!(
            of(0).next().unwrap().primitive,
            Primitive::Sphere { .. }
        ));
        let heights: Vec<f64> = of(1).map(|s| s.pose.translation[2]).collect();
        assert_eq!(
            heights,
            [2.0, 4.0, 3.0],
            "two ends and a body; nothing flat"
        );
    }
}
