//! Links that are one body.

use super::nodes::Nodes;
use super::one_body::Joined;
use super::{Exact3, Gap, Mismatch, Placed, Slack, Unsuited, collection, cross, minus, square};
use crate::collection::{Bar, Body};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{ExactPose, Joint, JointKind, LinkId, Mechanism, Placement};
use std::collections::BTreeSet;

/// A link and its place in a body.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedLink {
    /// The link.
    pub link: LinkId,
    /// `body_from_link`.
    pub pose: ExactPose,
}

/// A body: its links, and its shared points.
#[derive(Clone, Debug)]
pub struct PlacedBody {
    /// Its links; none for the cross of a universal joint.
    pub links: Vec<PlacedLink>,
    /// Index and place (m) of each of its points, by index.
    pub points: Vec<(usize, Exact3)>,
}

/// Links by the body that they belong to.
pub(super) struct Groups {
    /// Body and `body_from_link` of every link.
    places: Vec<(usize, ExactPose)>,
    /// Names of the bodies: that of a first link, or of a joint.
    names: Vec<String>,
    /// Joint, body and `body_from_cross` of every cross of a universal joint.
    crosses: Vec<(String, usize, ExactPose)>,
}

impl Groups {
    pub(super) fn of(mechanism: &Mechanism) -> Self {
        let links = mechanism.links();
        let mut places: Vec<Option<(usize, ExactPose)>> = vec![None; links.len()];
        let mut names = Vec::new();
        for first in 0..links.len() {
            if places[first].is_some() {
                continue;
            }
            let group = names.len();
            names.push(links[first].name.clone());
            places[first] = Some((group, ExactPose::identity()));
            let mut waiting = vec![first];
            while let Some(link) = waiting.pop() {
                let Some((_, pose)) = places[link].clone() else {
                    continue;
                };
                for joint in mechanism
                    .joints()
                    .iter()
                    .filter(|j| j.kind == JointKind::Fixed)
                {
                    let sides = [&joint.predecessor, &joint.successor];
                    for (near, far) in [(sides[0], sides[1]), (sides[1], sides[0])] {
                        if near.link.0 != link {
                            continue;
                        }
                        if places[far.link.0].is_none() {
                            let back = ExactPose::of(&far.frame).inverse();
                            let at = pose.then(&ExactPose::of(&near.frame)).then(&back);
                            places[far.link.0] = Some((group, at));
                            waiting.push(far.link.0);
                        }
                    }
                }
            }
        }
        Self {
            places: places.into_iter().flatten().collect(),
            names,
            crosses: Vec::new(),
        }
    }

    /// What a body is called.
    pub(super) fn name(&self, group: usize) -> &str {
        &self.names[group]
    }

    /// The links of the only body there is, apart from rods between two balls of it; `None` where there are more.
    ///
    /// # Errors
    /// A rod that is longer or shorter than the way between its balls.
    pub(super) fn only_body(
        &self,
        mechanism: &Mechanism,
        slack: &Slack,
    ) -> Result<Option<Vec<PlacedLink>>, Unsuited> {
        let is_rod = |group: usize| is_rod(mechanism, &self.links_of(group));
        let mut bodies = self.places.iter().map(|place| place.0);
        let Some(body) = bodies.clone().find(|&group| !is_rod(group)) else {
            return Ok(None);
        };
        if bodies.any(|group| group != body && !is_rod(group)) {
            return Ok(None);
        }
        for (link, &(rod, _)) in self.places.iter().enumerate() {
            if rod == body {
                continue;
            }
            // Where its balls are in the rod and in the body, and their joints.
            let mut balls: Vec<([Exact3; 2], &str)> = Vec::new();
            for joint in mechanism.joints() {
                let sides = [&joint.predecessor, &joint.successor];
                let Some(near) = sides.iter().position(|side| side.link.0 == link) else {
                    continue;
                };
                let at = [near, 1 - near].map(|i| {
                    let (group, pose) = &self.places[sides[i].link.0];
                    (*group, pose.apply(&sides[i].frame.position))
                });
                if at[1].0 != body {
                    return Ok(None);
                }
                balls.push((at.map(|(_, at)| at), &joint.name));
            }
            let [(one, first), (other, second)] = balls.as_slice() else {
                return Ok(None);
            };
            let long = [0, 1].map(|i| square(&minus(&one[i], &other[i])));
            if long[0].is_zero() {
                return Ok(None);
            }
            if differ(&long[0], &long[1], slack) {
                let points = [first, second].map(|name| (*name).to_owned());
                let bodies = [rod, body].map(|group| self.names[group].clone());
                return Err(unequal(points, bodies, [&long[0], &long[1]]));
            }
        }
        Ok(Some(self.links_of(body)))
    }

    /// Two bodies become one; the second is empty from then on.
    pub(super) fn merge(&mut self, joined: &Joined) {
        let [into, from] = joined.groups;
        let links = self.places.iter_mut().map(|(group, pose)| (group, pose));
        let crosses = self.crosses.iter_mut();
        for (group, pose) in links.chain(crosses.map(|(_, group, pose)| (group, pose))) {
            if *group == from {
                *group = into;
                *pose = joined.pose.then(pose);
            }
        }
    }

    /// Whether a joint that is not needed for that joins two sides of one body.
    fn redundant(&self, mechanism: &Mechanism) -> bool {
        let inside = |joint: &&Joint| {
            self.places[joint.predecessor.link.0].0 == self.places[joint.successor.link.0].0
        };
        let bodies: BTreeSet<usize> = self.places.iter().map(|place| place.0).collect();
        let joints = mechanism.joints().iter().filter(inside).count();
        joints > self.places.len() - bodies.len()
    }

    fn links_of(&self, group: usize) -> Vec<PlacedLink> {
        let places = self.places.iter().enumerate();
        places
            .filter(|(_, place)| place.0 == group)
            .map(|(link, place)| PlacedLink {
                link: LinkId(link),
                pose: place.1.clone(),
            })
            .collect()
    }

    /// No body has one point in two places.
    pub(super) fn check_torn(&self, nodes: &Nodes) -> Result<(), Unsuited> {
        let Some(torn) = nodes.torn() else {
            return Ok(());
        };
        let [one, other] = torn.map(|n| &nodes.all[n]);
        let metres = square(&minus(&one.at, &other.at)).value().sqrt();
        let gap = Gap {
            metres,
            radians: 0.0,
        };
        Err(Unsuited::Contradiction(Box::new(Mismatch::Torn {
            points: [one.name.clone(), other.name.clone()],
            body: self.names[one.group].clone(),
            gap,
        })))
    }

    /// Body and `body_from_link` of a link.
    pub(super) fn place(&self, link: LinkId) -> (usize, ExactPose) {
        self.places[link.0].clone()
    }

    /// Body and `body_from_cross` of the cross of a universal joint: a body without links, as long as it is none with another.
    pub(super) fn cross(&mut self, joint: &str) -> (usize, ExactPose) {
        if let Some((_, group, pose)) = self.crosses.iter().find(|(name, ..)| name == joint) {
            return (*group, pose.clone());
        }
        let group = self.names.len();
        self.names.push(joint.to_owned());
        let pose = ExactPose::identity();
        self.crosses.push((joint.to_owned(), group, pose.clone()));
        (group, pose)
    }

    /// Bodies, bars and points put together.
    pub(super) fn finish(
        self,
        mechanism: &Mechanism,
        nodes: &Nodes,
        bars: Vec<(String, [usize; 2], Number)>,
        slack: &Slack,
    ) -> Result<Placed, Unsuited> {
        let mut of_group: Vec<Vec<usize>> = vec![Vec::new(); self.names.len()];
        for (index, node) in nodes.all.iter().enumerate() {
            let used =
                nodes.users(index) > 1 || bars.iter().any(|(_, ends, _)| ends.contains(&index));
            if used {
                of_group[node.group].push(index);
            }
        }
        let mut classes: Vec<usize> = of_group.iter().flatten().map(|&n| nodes.class(n)).collect();
        classes.sort_unstable();
        classes.dedup();
        let index = |node: usize| classes.binary_search(&nodes.class(node)).unwrap_or(0);
        let mut bars: Vec<(String, [usize; 2], Number)> = bars
            .into_iter()
            .map(|(name, ends, square)| (name, ends.map(index), square))
            .collect();
        let mut bodies = Vec::new();
        let mut placed = Vec::new();
        for (group, own) in of_group.iter().enumerate() {
            let mut points: Vec<(usize, Exact3)> = own
                .iter()
                .map(|&n| (index(n), nodes.all[n].at.clone()))
                .collect();
            points.sort_by_key(|(p, _)| *p);
            points.dedup_by_key(|(p, _)| *p);
            let links = self.links_of(group);
            if links.is_empty() && points.is_empty() {
                continue;
            }
            if points.len() == 2 && is_rod(mechanism, &links) {
                let way = minus(&points[0].1, &points[1].1);
                bars.push((
                    self.names[group].clone(),
                    [points[0].0, points[1].0],
                    square(&way),
                ));
                continue;
            }
            if points.len() < 3 {
                return Err(Unsuited::Loose {
                    link: self.names[group].clone(),
                    points: points.len(),
                });
            }
            if on_one_line(&points) {
                return Err(Unsuited::Collinear {
                    link: self.names[group].clone(),
                });
            }
            bodies.push(Body {
                name: self.names[group].clone(),
                points: points.iter().map(|(p, _)| *p).collect(),
            });
            placed.push(PlacedBody { links, points });
        }
        let names: Vec<String> = classes.iter().map(|&c| nodes.all[c].name.clone()).collect();
        for (point, name) in names.iter().enumerate() {
            if !bodies.iter().any(|b| b.points.contains(&point)) {
                return Err(Unsuited::OnlyBars {
                    point: name.clone(),
                });
            }
        }
        let bar_squares = bars.iter().map(|(_, _, square)| square.clone()).collect();
        let bars = bars
            .into_iter()
            .map(|(name, ends, _)| Bar { name, ends })
            .collect();
        let collection = collection(names, bodies, bars).ok_or_else(|| Unsuited::Loose {
            link: mechanism.name().to_owned(),
            points: 0,
        })?;
        let placed = Placed {
            collection,
            bodies: placed,
            redundant: self.redundant(mechanism),
            lever: 1.0,
            bar_squares,
        };
        placed.check_distances(slack)?;
        Ok(placed)
    }
}

/// Whether a body is a link that two balls hold and nothing else.
fn is_rod(mechanism: &Mechanism, links: &[PlacedLink]) -> bool {
    let [link] = links else { return false };
    let mut joints = 0;
    let balls = mechanism.joints().iter().all(|joint| {
        let own = [&joint.predecessor, &joint.successor]
            .iter()
            .any(|s| s.link == link.link);
        joints += usize::from(own);
        !own || joint.kind == JointKind::Spherical
    });
    balls && joints == 2 && link.link != mechanism.ground()
}

/// Whether two squared distances (m²) are those of different distances, as far as the numbers are known.
fn differ(one: &Number, other: &Number, slack: &Slack) -> bool {
    let off = (one.value().sqrt() - other.value().sqrt()).abs();
    one != other && (slack.metres == 0.0 || off > slack.metres)
}

/// Two points that are not equally far apart in two bodies, by the squares of the distances (m²).
fn unequal(points: [String; 2], bodies: [String; 2], squares: [&Number; 2]) -> Unsuited {
    Unsuited::Contradiction(Box::new(Mismatch::Distances {
        points,
        bodies,
        distances: squares.map(|square| format!("{:.6}", square.value().sqrt())),
    }))
}

fn on_one_line(points: &[(usize, Exact3)]) -> bool {
    let first = minus(&points[1].1, &points[0].1);
    points[2..].iter().all(|(_, p)| {
        let off = cross(&first, &minus(p, &points[0].1));
        off.iter().all(Number::is_zero)
    })
}

impl Placed {
    /// Two points that two bodies, or a body and a bar, share must be equally far apart in both.
    fn check_distances(&self, slack: &Slack) -> Result<(), Unsuited> {
        let mut known: std::collections::BTreeMap<[usize; 2], (String, Number)> =
            std::collections::BTreeMap::new();
        let mut check = |ends: [usize; 2], name: &str, value: Number| {
            let ends = [ends[0].min(ends[1]), ends[0].max(ends[1])];
            match known.get(&ends) {
                Some((body, other)) if differ(other, &value, slack) => Err(unequal(
                    ends.map(|p| self.collection.points()[p].clone()),
                    [body.clone(), name.to_owned()],
                    [other, &value],
                )),
                Some(_) => Ok(()),
                None => {
                    known.insert(ends, (name.to_owned(), value));
                    Ok(())
                }
            }
        };
        for (body, placed) in self.collection.bodies().iter().zip(&self.bodies) {
            for (i, (p, at)) in placed.points.iter().enumerate() {
                for (q, there) in &placed.points[i + 1..] {
                    check([*p, *q], &body.name, square(&minus(at, there)))?;
                }
            }
        }
        for (bar, length) in self.collection.bars().iter().zip(&self.bar_squares) {
            check(bar.ends, &bar.name, length.clone())?;
        }
        Ok(())
    }

    /// The squared distance of two points in a body or bar that has both (m²).
    #[must_use]
    pub fn distance_square(&self, one: usize, other: usize) -> Option<Number> {
        for placed in &self.bodies {
            let at = |p: usize| {
                placed
                    .points
                    .iter()
                    .find(|(q, _)| *q == p)
                    .map(|(_, at)| at)
            };
            if let (Some(a), Some(b)) = (at(one), at(other)) {
                return Some(square(&minus(a, b)));
            }
        }
        let bar = self
            .collection
            .bars()
            .iter()
            .position(|bar| bar.ends == [one, other] || bar.ends == [other, one])?;
        self.bar_squares.get(bar).cloned()
    }
}

/// `world_from_link` of all links as the file draws them, joints at zero.
pub(super) fn home_poses(mechanism: &Mechanism) -> Vec<ExactPose> {
    let mut poses = vec![ExactPose::identity(); mechanism.links().len()];
    for &link in mechanism.placement_order() {
        match &mechanism.link(link).placement {
            Placement::World => {}
            Placement::Floating { parent, origin, .. } => {
                poses[link.0] = poses[parent.0].then(&ExactPose::of(origin));
            }
            Placement::Joint(id) => {
                let joint = mechanism.joint(*id);
                let before =
                    poses[joint.predecessor.link.0].then(&ExactPose::of(&joint.predecessor.frame));
                poses[link.0] = before.then(&ExactPose::of(&joint.successor.frame).inverse());
            }
        }
    }
    poses
}
