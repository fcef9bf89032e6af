//! From places of the elements to poses of the links.

use super::body::Exact;
use super::places::View;
use crate::construction::{Motion, Shape};
use kutzbach_math::space::Rigid;
use kutzbach_model::mechanism::ExactPose;

/// Where the links of a planar mechanism are drawn, and what their bodies have of the elements there.
#[derive(Clone, Debug)]
pub(super) struct Links {
    pub(super) homes: Vec<ExactPose>,
    /// The body of each link.
    pub(super) body: Vec<usize>,
    /// The elements of each body.
    pub(super) held: Vec<Vec<(usize, Exact)>>,
}

impl Links {
    /// `world_from_link`, up to one motion of the plane for all; `None` where a body has no two elements that hold it.
    pub(super) fn poses(&self, view: &View, shapes: &[Shape]) -> Option<Vec<Rigid<f64>>> {
        let motions: Vec<Option<Motion>> =
            self.held.iter().map(|held| motion(held, shapes)).collect();
        let links = self.homes.iter().zip(&self.body);
        links
            .map(|(home, &body)| {
                let (turn, shift) = motions[body].as_ref()?.parts();
                Some(view.lifted(turn, shift).compose(&home.to_doubles()))
            })
            .collect()
    }
}

/// The motion of the plane that brings a body from where it is drawn to where its elements are.
fn motion(held: &[(usize, Exact)], shapes: &[Shape]) -> Option<Motion> {
    let drawn: Vec<Shape> = held.iter().map(|(_, e)| Shape::drawn(&e.drawn())).collect();
    let firm = |i: usize, j: usize| match (&drawn[i], &drawn[j]) {
        (Shape::Point(p), Shape::Point(q)) => (3, (p[0] - q[0]).hypot(p[1] - q[1])),
        (Shape::Line { direction: a, .. }, Shape::Line { direction: b, .. }) => {
            (1, (a[0] * b[1] - a[1] * b[0]).abs())
        }
        _ => (2, 0.0),
    };
    let pairs = (0..held.len()).flat_map(|j| (0..j).map(move |i| (i, j)));
    let (i, j) = pairs.max_by(|a, b| {
        let [(kind, size), (other, than)] = [firm(a.0, a.1), firm(b.0, b.1)];
        kind.cmp(&other).then(size.total_cmp(&than))
    })?;
    let there = [&shapes[held[i].0], &shapes[held[j].0]];
    Motion::onto([&drawn[i], &drawn[j]], there)
}
