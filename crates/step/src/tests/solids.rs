//! Faces of blocks with holes, and of pins, for the tests' STEP texts. All axes of holes and pins are along z.

use super::builder::{Text, list};
use std::f64::consts::{PI, TAU};

/// A circular hole or disc: x, y, radius (mm).
pub(super) type Circle = (f64, f64, f64);

const UP: [f64; 3] = [0.0, 0.0, 1.0];

impl Text {
    fn vertex(&mut self, at: [f64; 3]) -> u64 {
        let point = self.point(at);
        self.add(&format!("VERTEX_POINT('',#{point})"))
    }

    fn oriented(&mut self, from: u64, to: u64, curve: u64, forward: bool) -> u64 {
        let edge = self.add(&format!("EDGE_CURVE('',#{from},#{to},#{curve},.T.)"));
        let sign = if forward { "T" } else { "F" };
        self.add(&format!("ORIENTED_EDGE('',*,*,#{edge},.{sign}.)"))
    }

    fn straight(&mut self, from: [f64; 3], to: [f64; 3]) -> u64 {
        let (a, b) = (self.vertex(from), self.vertex(to));
        let start = self.point(from);
        let along = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
        let direction = self.direction(along);
        let vector = self.add(&format!("VECTOR('',#{direction},1.)"));
        let line = self.add(&format!("LINE('',#{start},#{vector})"));
        self.oriented(a, b, line, true)
    }

    /// An arc about an axis along z, counterclockwise from one angle to another, or that way back.
    fn arc(&mut self, circle: Circle, height: f64, angles: (f64, f64), forward: bool) -> u64 {
        let (x, y, radius) = circle;
        let on = |angle: f64| [x + radius * angle.cos(), y + radius * angle.sin(), height];
        let from = self.vertex(on(angles.0));
        let whole = angles.1 - angles.0 > TAU - 1e-9;
        let to = if whole {
            from
        } else {
            self.vertex(on(angles.1))
        };
        let frame = self.placement([x, y, height], UP, [1.0, 0.0, 0.0]);
        let size = self.length(radius);
        let curve = self.add(&format!("CIRCLE('',#{frame},{size})"));
        self.oriented(from, to, curve, forward)
    }

    fn bound(&mut self, edges: &[u64]) -> u64 {
        let edge_loop = self.add(&format!("EDGE_LOOP('',({}))", list(edges)));
        self.add(&format!("FACE_BOUND('',#{edge_loop},.T.)"))
    }

    /// A face; `same` says whether the surface's own normal points out of the material.
    pub fn face(&mut self, bounds: &[u64], surface: u64, same: bool) -> u64 {
        let sign = if same { "T" } else { "F" };
        self.add(&format!(
            "ADVANCED_FACE('',({}),#{surface},.{sign}.)",
            list(bounds)
        ))
    }

    /// A flat face with straight edges and round holes, whose axes are along z.
    pub fn polygon(&mut self, corners: &[[f64; 3]], normal: [f64; 3], holes: &[Circle]) -> u64 {
        let mut edges = Vec::new();
        for (place, corner) in corners.iter().enumerate() {
            edges.push(self.straight(*corner, corners[(place + 1) % corners.len()]));
        }
        let mut bounds = vec![self.bound(&edges)];
        for hole in holes {
            let ring = self.arc(*hole, corners[0][2], (0.0, TAU), false);
            bounds.push(self.bound(&[ring]));
        }
        let across = if normal[0].abs() > 0.5 {
            UP
        } else {
            [1.0, 0.0, 0.0]
        };
        let frame = self.placement(corners[0], normal, across);
        let plane = self.add(&format!("PLANE('',#{frame})"));
        self.face(&bounds, plane, true)
    }

    /// A flat round face.
    pub fn disc(&mut self, circle: Circle, height: f64, up: bool) -> u64 {
        let ring = self.arc(circle, height, (0.0, TAU), up);
        let bound = self.bound(&[ring]);
        let z = if up { UP } else { [0.0, 0.0, -1.0] };
        let frame = self.placement([circle.0, circle.1, height], z, [1.0, 0.0, 0.0]);
        let plane = self.add(&format!("PLANE('',#{frame})"));
        self.face(&[bound], plane, true)
    }

    /// A round face from one height to another and from one angle to another: of a pin, or of a hole.
    pub fn tube(
        &mut self,
        circle: Circle,
        heights: (f64, f64),
        angles: (f64, f64),
        hole: bool,
    ) -> u64 {
        let bound = self.tube_bound(circle, heights, angles);
        let frame = self.placement([circle.0, circle.1, 0.0], UP, [1.0, 0.0, 0.0]);
        let size = self.length(circle.2);
        let surface = self.add(&format!("CYLINDRICAL_SURFACE('',#{frame},{size})"));
        self.face(&[bound], surface, !hole)
    }

    /// The bound of such a face: an arc, a line up, the arc back, a line down.
    pub fn tube_bound(&mut self, circle: Circle, heights: (f64, f64), angles: (f64, f64)) -> u64 {
        let (x, y, radius) = circle;
        let on =
            |angle: f64, height: f64| [x + radius * angle.cos(), y + radius * angle.sin(), height];
        let edges = [
            self.arc(circle, heights.0, angles, true),
            self.straight(on(angles.1, heights.0), on(angles.1, heights.1)),
            self.arc(circle, heights.1, angles, false),
            self.straight(on(angles.0, heights.1), on(angles.0, heights.0)),
        ];
        self.bound(&edges)
    }

    /// The faces of a block between two corners with holes through it along z, each in one piece or in halves.
    pub fn block(
        &mut self,
        low: [f64; 3],
        high: [f64; 3],
        holes: &[Circle],
        halves: bool,
    ) -> Vec<u64> {
        let [a, b, c] = low;
        let [d, e, f] = high;
        let mut faces = vec![
            self.polygon(
                &[[a, b, c], [a, e, c], [d, e, c], [d, b, c]],
                [0.0, 0.0, -1.0],
                holes,
            ),
            self.polygon(&[[a, b, f], [d, b, f], [d, e, f], [a, e, f]], UP, holes),
            self.polygon(
                &[[a, b, c], [d, b, c], [d, b, f], [a, b, f]],
                [0.0, -1.0, 0.0],
                &[],
            ),
            self.polygon(
                &[[a, e, c], [a, e, f], [d, e, f], [d, e, c]],
                [0.0, 1.0, 0.0],
                &[],
            ),
            self.polygon(
                &[[a, b, c], [a, b, f], [a, e, f], [a, e, c]],
                [-1.0, 0.0, 0.0],
                &[],
            ),
            self.polygon(
                &[[d, b, c], [d, e, c], [d, e, f], [d, b, f]],
                [1.0, 0.0, 0.0],
                &[],
            ),
        ];
        for hole in holes {
            if halves {
                faces.push(self.tube(*hole, (c, f), (0.0, PI), true));
                faces.push(self.tube(*hole, (c, f), (PI, TAU), true));
            } else {
                faces.push(self.tube(*hole, (c, f), (0.0, TAU), true));
            }
        }
        faces
    }

    /// The faces of a pin about the z axis, from one height to another.
    pub fn pin(&mut self, radius: f64, heights: (f64, f64)) -> Vec<u64> {
        let circle = (0.0, 0.0, radius);
        vec![
            self.disc(circle, heights.0, false),
            self.disc(circle, heights.1, true),
            self.tube(circle, heights, (0.0, TAU), false),
        ]
    }

    /// The faces of a pin with a head above it: the head's lower side is at height zero, the shaft below.
    pub fn headed_pin(&mut self, radius: f64, length: f64, head: (f64, f64)) -> Vec<u64> {
        let (wide, high) = head;
        let ring = [
            self.arc((0.0, 0.0, wide), 0.0, (0.0, TAU), false),
            self.arc((0.0, 0.0, radius), 0.0, (0.0, TAU), true),
        ];
        let bounds = ring.map(|edge| self.bound(&[edge]));
        let frame = self.placement([0.0; 3], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]);
        let plane = self.add(&format!("PLANE('',#{frame})"));
        vec![
            self.face(&bounds, plane, true),
            self.disc((0.0, 0.0, radius), -length, false),
            self.disc((0.0, 0.0, wide), high, true),
            self.tube((0.0, 0.0, radius), (-length, 0.0), (0.0, TAU), false),
            self.tube((0.0, 0.0, wide), (0.0, high), (0.0, TAU), false),
        ]
    }
}
