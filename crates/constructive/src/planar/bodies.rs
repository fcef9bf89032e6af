//! Which links are one body, and which joints one element.

use super::NotPlanar;
use super::body::Exact;
use super::places::View;
use kutzbach_model::mechanism::{ExactPose, JointKind, Mechanism, Placement};

/// Elements by body.
pub(super) struct Bodies {
    /// A first joint of every element.
    pub(super) names: Vec<String>,
    /// Where that is drawn.
    pub(super) elements: Vec<Exact>,
    /// Name of a first link, and the elements where the body has them.
    of_body: Vec<(String, Vec<(usize, Exact)>)>,
}

/// Where every link is drawn at home.
pub(super) fn homes(mechanism: &Mechanism) -> Vec<ExactPose> {
    let mut homes = vec![ExactPose::identity(); mechanism.links().len()];
    for &link in mechanism.placement_order() {
        homes[link.0] = match &mechanism.link(link).placement {
            Placement::World => ExactPose::identity(),
            Placement::Joint(joint) => {
                let joint = mechanism.joint(*joint);
                let parent = &homes[joint.predecessor.link.0];
                let back = ExactPose::of(&joint.successor.frame).inverse();
                parent
                    .then(&ExactPose::of(&joint.predecessor.frame))
                    .then(&back)
            }
            Placement::Floating { parent, origin, .. } => {
                homes[parent.0].then(&ExactPose::of(origin))
            }
        };
    }
    homes
}

impl Bodies {
    pub(super) fn of(
        mechanism: &Mechanism,
        homes: &[ExactPose],
        view: &View,
    ) -> Result<Self, NotPlanar> {
        let body = welded(mechanism, homes)?;
        let mut bodies = Self {
            names: Vec::new(),
            elements: Vec::new(),
            of_body: mechanism
                .links()
                .iter()
                .map(|l| (l.name.clone(), Vec::new()))
                .collect(),
        };
        for joint in mechanism.joints() {
            if joint.kind == JointKind::Fixed {
                continue;
            }
            let sides = [&joint.predecessor, &joint.successor];
            let places = sides.map(|side| view.element(joint, side, homes));
            let [one, other] = places;
            let on = sides.map(|s| body[s.link.0]);
            if on[0] == on[1] {
                continue; // held by other joints already
            }
            bodies.add(&joint.name, on, [one?, other?]);
        }
        Ok(bodies)
    }

    /// What each body has.
    pub(super) fn held(&self) -> impl Iterator<Item = (&str, &[(usize, Exact)])> {
        self.of_body.iter().map(|(name, held)| (&**name, &**held))
    }

    /// An element of two bodies: one that is there on either of them, or a new one.
    fn add(&mut self, name: &str, on: [usize; 2], places: [Exact; 2]) {
        let there = |k: usize| {
            let held = &self.of_body[on[k]].1;
            held.iter().find(|h| h.1.same(&places[k])).map(|h| h.0)
        };
        let known = [there(0), there(1)];
        let element = known[0].or(known[1]).unwrap_or_else(|| {
            self.names.push(name.to_owned());
            self.elements.push(places[0].clone());
            self.names.len() - 1
        });
        for (k, place) in places.into_iter().enumerate() {
            if known[k].is_none() {
                self.of_body[on[k]].1.push((element, place));
            }
        }
    }
}

/// A link that stands for the body of every link.
fn welded(mechanism: &Mechanism, homes: &[ExactPose]) -> Result<Vec<usize>, NotPlanar> {
    let mut body: Vec<usize> = (0..homes.len()).collect();
    for joint in mechanism.joints() {
        if joint.kind != JointKind::Fixed {
            continue;
        }
        let sides = [&joint.predecessor, &joint.successor];
        let [one, other] = sides.map(|s| homes[s.link.0].then(&ExactPose::of(&s.frame)));
        if joint.closes_loop && one != other {
            let joint = joint.name.clone();
            return Err(NotPlanar::Fixed { joint });
        }
        let [a, b] = sides.map(|s| body[s.link.0]);
        let kept = a.min(b);
        for of in &mut body {
            if *of == a || *of == b {
                *of = kept;
            }
        }
    }
    Ok(body)
}
