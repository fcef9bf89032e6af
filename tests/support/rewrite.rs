//! A mechanism taken apart into names and exact numbers, to be written differently and put together again.
//!
//! All rewritings keep the mechanism and change the description: the unit of length, where and how frames lie in their
//! links, names and order, which joints are loops, how many digits are written.

use super::decimal;
use kutzbach::mechanism::{
    CouplingOrigin, Direction, Frame, JointBuilder, JointKind, Mechanism, MechanismBuilder,
    Placement,
};
use kutzbach::number::Number;
use std::collections::BTreeMap;

/// One side of a joint: the link's name and the joint's frame in it.
#[derive(Clone)]
pub struct End {
    pub link: String,
    pub frame: Frame,
}

#[derive(Clone)]
pub struct DraftJoint {
    pub name: String,
    pub kind: JointKind,
    /// Predecessor and successor.
    pub ends: [End; 2],
    pub axis: Direction,
    pub axis2: Direction,
    pub lead: Option<Number>,
    pub distance: Option<Number>,
    pub closes_loop: bool,
}

/// `child` is drawn at `origin` in `parent`, without constraint.
#[derive(Clone)]
pub struct Placed {
    pub parent: String,
    pub child: String,
    pub origin: Frame,
}

#[derive(Clone)]
pub struct DraftMimic {
    pub follower: String,
    pub leader: String,
    pub multiplier: Number,
    pub offset: Number,
}

#[derive(Clone)]
pub struct DraftRatio {
    pub name: String,
    pub ends: [String; 2],
    pub ratio: Number,
    pub carrier: Option<String>,
}

/// A sum over joints: its name, joints with coefficients, and what it is.
#[derive(Clone)]
pub struct DraftSum {
    pub name: String,
    pub terms: Vec<(String, u32, Number)>,
    pub offset: Number,
}

/// A named pose: joints with their values, those that keep them and those that only begin there.
#[derive(Clone)]
pub struct DraftPose {
    pub name: String,
    pub held: Vec<(String, Vec<Number>)>,
    pub starts: Vec<(String, Vec<Number>)>,
}

/// A mechanism as plain data.
#[derive(Clone)]
pub struct Draft {
    pub name: String,
    pub ground: String,
    pub links: Vec<String>,
    pub joints: Vec<DraftJoint>,
    pub placed: Vec<Placed>,
    pub mimics: Vec<DraftMimic>,
    pub ratios: Vec<DraftRatio>,
    pub sums: Vec<DraftSum>,
    /// Named poses.
    pub poses: Vec<DraftPose>,
}

impl Draft {
    pub fn of(mechanism: &Mechanism) -> Self {
        let link = |id| mechanism.link(id).name.clone();
        let joints = mechanism
            .joints()
            .iter()
            .map(|joint| DraftJoint {
                name: joint.name.clone(),
                kind: joint.kind,
                ends: [&joint.predecessor, &joint.successor].map(|side| End {
                    link: link(side.link),
                    frame: side.frame.clone(),
                }),
                axis: joint.axis.clone(),
                axis2: joint.axis2.clone(),
                lead: joint.lead.clone(),
                distance: joint.distance.clone(),
                closes_loop: joint.closes_loop,
            })
            .collect();
        let placed = mechanism
            .links()
            .iter()
            .filter_map(|l| match &l.placement {
                Placement::Floating { parent, origin, .. } => Some(Placed {
                    parent: link(*parent),
                    child: l.name.clone(),
                    origin: origin.clone(),
                }),
                _ => None,
            })
            .collect();
        let mut draft = Self {
            name: mechanism.name().to_owned(),
            ground: link(mechanism.ground()),
            links: mechanism.links().iter().map(|l| l.name.clone()).collect(),
            joints,
            placed,
            mimics: Vec::new(),
            ratios: Vec::new(),
            sums: Vec::new(),
            poses: Vec::new(),
        };
        for configuration in mechanism.configurations() {
            let named = |free: bool| -> Vec<(String, Vec<Number>)> {
                let positions = configuration.positions.iter();
                let these = positions.filter(|(id, _)| configuration.free.contains(id) == free);
                these
                    .map(|(id, v)| (mechanism.joint(*id).name.clone(), v.clone()))
                    .collect()
            };
            draft.poses.push(DraftPose {
                name: configuration.name.clone(),
                held: named(false),
                starts: named(true),
            });
        }
        for coupling in mechanism.couplings() {
            match &coupling.origin {
                CouplingOrigin::Sum => draft.sums.push(DraftSum {
                    name: coupling.name.clone(),
                    terms: (coupling.terms.iter())
                        .flat_map(|term| {
                            let name = &mechanism.joint(term.joint).name;
                            let factors = (1..).zip(term.factors());
                            factors.map(|(power, factor)| (name.clone(), power, factor.clone()))
                        })
                        .collect(),
                    offset: coupling.offset.clone(),
                }),
                CouplingOrigin::Ratio {
                    predecessor,
                    successor,
                    ratio,
                    carrier,
                    ..
                } => draft.ratios.push(DraftRatio {
                    name: coupling.name.clone(),
                    ends: [link(*predecessor), link(*successor)],
                    ratio: ratio.clone(),
                    carrier: carrier.map(link),
                }),
                CouplingOrigin::Mimic {
                    follower,
                    leader,
                    multiplier,
                    offset,
                } => draft.mimics.push(DraftMimic {
                    follower: mechanism.joint(*follower).name.clone(),
                    leader: mechanism.joint(*leader).name.clone(),
                    multiplier: multiplier.clone(),
                    offset: offset.clone(),
                }),
            }
        }
        draft
    }

    /// Adds a named pose that holds one joint at a value.
    pub fn hold_at(&mut self, name: &str, joint: &str, value: Number) {
        self.poses.push(DraftPose {
            name: name.to_owned(),
            held: vec![(joint.to_owned(), vec![value])],
            starts: Vec::new(),
        });
    }

    pub fn build(&self) -> Mechanism {
        let mut builder = MechanismBuilder::new(&self.name);
        builder.ground(&self.ground);
        for link in &self.links {
            builder.link(link);
        }
        for joint in &self.joints {
            let [a, b] = &joint.ends;
            let make = if joint.closes_loop {
                JointBuilder::closing
            } else {
                JointBuilder::tree
            };
            let mut spec = make(&joint.name, joint.kind, &a.link, &b.link)
                .origin(a.frame.clone())
                .successor_origin(b.frame.clone());
            if joint.kind.uses_axis() {
                spec = spec.axis(joint.axis.clone());
            }
            if joint.kind.uses_second_axis() {
                spec = spec.axis2(joint.axis2.clone());
            }
            if let Some(lead) = &joint.lead {
                spec = spec.lead(lead.clone());
            }
            if let Some(distance) = &joint.distance {
                spec = spec.distance(distance.clone());
            }
            builder.joint(spec);
        }
        for (index, placed) in self.placed.iter().enumerate() {
            let name = format!("place_{index}");
            builder.floating(&name, &placed.parent, &placed.child, placed.origin.clone());
        }
        for mimic in &self.mimics {
            let (multiplier, offset) = (mimic.multiplier.clone(), mimic.offset.clone());
            builder.mimic(&mimic.follower, &mimic.leader, multiplier, offset);
        }
        for ratio in &self.ratios {
            let [one, other] = &ratio.ends;
            builder.coupling_on(
                ratio.carrier.as_deref(),
                &ratio.name,
                [one, other],
                ratio.ratio.clone(),
            );
        }
        for DraftSum {
            name,
            terms,
            offset,
        } in &self.sums
        {
            builder.polynomial_coupling(name, terms.clone(), offset.clone());
        }
        for DraftPose { name, held, starts } in &self.poses {
            builder.configuration_with_starts(name, held.clone(), starts.clone());
        }
        builder
            .build()
            .unwrap_or_else(|error| panic!("{}: {error}", self.name))
    }

    fn frames(&mut self) -> impl Iterator<Item = &mut Frame> {
        let ends = self.joints.iter_mut().flat_map(|j| &mut j.ends);
        ends.map(|end| &mut end.frame)
            .chain(self.placed.iter_mut().map(|p| &mut p.origin))
    }

    /// Whether some number of the geometry is neither a decimal nor whole.
    pub fn has_fractions(&self) -> bool {
        let found = std::cell::Cell::new(false);
        let look = |number: &Number| {
            let plain = number.stated().is_some() || number.rational().is_some_and(|r| r.is_int());
            found.set(found.get() || !plain);
            number.clone()
        };
        let _ = self.clone().each_number(&look);
        found.get()
    }

    /// Whether every frame is parallel to its link's.
    pub fn is_parallel(&self) -> bool {
        let ends = self.joints.iter().flat_map(|joint| &joint.ends);
        ends.map(|end| &end.frame)
            .chain(self.placed.iter().map(|placed| &placed.origin))
            .all(|frame| frame.roll_pitch_yaw.iter().all(Number::is_zero))
    }

    /// Every number of the geometry, each by itself: coordinates, angles, directions, leads, distances.
    #[must_use]
    pub fn each_number(self, change: &dyn Fn(&Number) -> Number) -> Self {
        self.each_number_of_a_kind(&mut |_, number| change(number))
    }

    /// The same, told the kind of each: 0 for lengths, 1 for angles, 2 for components of directions.
    #[must_use]
    pub fn each_number_of_a_kind(
        mut self,
        change: &mut dyn FnMut(usize, &Number) -> Number,
    ) -> Self {
        for frame in self.frames() {
            for number in &mut frame.position {
                *number = change(0, number);
            }
            for number in &mut frame.roll_pitch_yaw {
                *number = change(1, number);
            }
        }
        for joint in &mut self.joints {
            for number in joint.axis.0.iter_mut().chain(&mut joint.axis2.0) {
                *number = change(2, number);
            }
            for number in joint.lead.iter_mut().chain(&mut joint.distance) {
                *number = change(0, number);
            }
        }
        self
    }

    /// All lengths times a power of ten, digit for digit.
    #[must_use]
    pub fn scaled(mut self, exponent: i32) -> Self {
        let change = |number: &mut Number| *number = decimal::shifted(number, exponent);
        for frame in self.frames() {
            frame.position.iter_mut().for_each(change);
        }
        for joint in &mut self.joints {
            joint.lead.iter_mut().for_each(change);
            joint.distance.iter_mut().for_each(change);
        }
        self
    }

    /// The coordinates of every link frame turned alike. Frames must be parallel to their links.
    #[must_use]
    pub fn turned(mut self) -> Self {
        for frame in self.frames() {
            assert_parallel(frame);
            frame.position = turned(&frame.position);
        }
        for joint in &mut self.joints {
            joint.axis.0 = turned(&joint.axis.0);
            joint.axis2.0 = turned(&joint.axis2.0);
        }
        self
    }

    /// The coordinates of every link frame turned alike, decimals staying decimals that are as exact as before, with three digits more.
    /// Frames must be parallel to their links.
    #[must_use]
    pub fn turned_in_decimals(mut self) -> Self {
        let decimals = 3 + self.decimals().max(0);
        let turned = |v: &[Number; 3]| {
            [0, 1, 2].map(|i| {
                let sum = (0..3).fold(Number::zero(), |total, j| {
                    &total + &(&Number::ratio(TURN_IN_DECIMALS[i][j], 125).unwrap() * &v[j])
                });
                decimal::finite(&sum, decimals)
            })
        };
        for frame in self.frames() {
            assert_parallel(frame);
            frame.position = turned(&frame.position);
        }
        for joint in &mut self.joints {
            joint.axis.0 = turned(&joint.axis.0);
            joint.axis2.0 = turned(&joint.axis2.0);
        }
        self
    }

    /// Only the ground's own frame turned: what hangs on it gets roll, pitch and yaw. Frames in the ground must be parallel
    /// to it; the ground must be the root.
    #[must_use]
    pub fn ground_turned(mut self) -> Self {
        let ground = self.ground.clone();
        let rpy = turn_angles();
        let turn = |frame: &mut Frame| {
            assert_parallel(frame);
            frame.position = turned(&frame.position);
            frame.roll_pitch_yaw = rpy.clone();
        };
        for joint in &mut self.joints {
            for end in joint.ends.iter_mut().filter(|end| end.link == ground) {
                turn(&mut end.frame);
            }
        }
        for placed in self.placed.iter_mut().filter(|p| p.parent == ground) {
            turn(&mut placed.origin);
        }
        self
    }

    /// Most decimals of any coordinate. Moved coordinates are written with as many, so that they state the same precision.
    fn decimals(&mut self) -> i32 {
        let stated = |number: &Number| number.stated().map(|stated| stated.decimals);
        self.frames()
            .flat_map(|frame| frame.position.clone())
            .filter_map(|number| stated(&number))
            .max()
            .unwrap_or(0)
    }

    /// The frames in the ground moved by a vector; the ground must be the root.
    #[must_use]
    pub fn ground_moved(mut self, by: &[Number; 3]) -> Self {
        let ground = self.ground.clone();
        let decimals = self.decimals();
        let moved = |p: &[Number; 3]| sum(p, by).map(|n| decimal::with_decimals(&n, decimals));
        let shift = |frame: &mut Frame| frame.position = moved(&frame.position);
        for joint in &mut self.joints {
            for end in joint.ends.iter_mut().filter(|end| end.link == ground) {
                shift(&mut end.frame);
            }
        }
        for placed in self.placed.iter_mut().filter(|p| p.parent == ground) {
            shift(&mut placed.origin);
        }
        self
    }

    /// Every link's own frame far from its joints, each link's in another direction. Frames must be parallel.
    #[must_use]
    pub fn frames_moved(mut self, by: &[Number; 3]) -> Self {
        let shift_of: BTreeMap<String, [Number; 3]> = self
            .links
            .iter()
            .enumerate()
            .map(|(index, link)| {
                let component = |i: usize| {
                    let component = by[(i + index) % 3].clone();
                    if index % 2 == 0 {
                        component
                    } else {
                        -component
                    }
                };
                (link.clone(), [0, 1, 2].map(component))
            })
            .collect();
        let stated = |number: &Number| number.stated().map_or(0, |stated| stated.decimals);
        let decimals = self
            .decimals()
            .max(by.iter().map(stated).max().unwrap_or(0));
        let moved = |p: &[Number; 3], by: &[Number; 3]| {
            sum(p, by).map(|n| decimal::with_decimals(&n, decimals))
        };
        for joint in &mut self.joints {
            for end in &mut joint.ends {
                end.frame.position = moved(&end.frame.position, &shift_of[&end.link]);
            }
        }
        for placed in &mut self.placed {
            assert_parallel(&placed.origin);
            let apart = difference(&shift_of[&placed.parent], &shift_of[&placed.child]);
            placed.origin.position = sum(&placed.origin.position, &apart);
        }
        self
    }

    /// Links and joints in another order, under other names; also the maps from old names to new ones.
    #[must_use]
    pub fn shuffled(mut self, seed: u64) -> (Self, BTreeMap<String, String>) {
        let mut random = Shuffle(seed);
        random.shuffle(&mut self.links);
        random.shuffle(&mut self.joints);
        random.shuffle(&mut self.placed);
        let mut new_names = |old: Vec<String>, prefix: &str| -> BTreeMap<String, String> {
            let mut numbers: Vec<usize> = (0..old.len()).collect();
            random.shuffle(&mut numbers);
            let named = |(old, number): (String, usize)| (old, format!("{prefix}{number}"));
            old.into_iter().zip(numbers).map(named).collect()
        };
        let links = new_names(self.links.clone(), "body ");
        let joints = new_names(self.joints.iter().map(|j| j.name.clone()).collect(), "j.");
        for link in &mut self.links {
            *link = links[link].clone();
        }
        self.ground = links[&self.ground].clone();
        for joint in &mut self.joints {
            joint.name = joints[&joint.name].clone();
            for end in &mut joint.ends {
                end.link = links[&end.link].clone();
            }
        }
        for placed in &mut self.placed {
            placed.parent = links[&placed.parent].clone();
            placed.child = links[&placed.child].clone();
        }
        for mimic in &mut self.mimics {
            mimic.follower = joints[&mimic.follower].clone();
            mimic.leader = joints[&mimic.leader].clone();
        }
        for ratio in &mut self.ratios {
            ratio.ends = ratio.ends.clone().map(|end| links[&end].clone());
            ratio.carrier = ratio.carrier.as_ref().map(|link| links[link].clone());
        }
        for (joint, ..) in self.sums.iter_mut().flat_map(|sum| &mut sum.terms) {
            *joint = joints[joint].clone();
        }
        let poses = self.poses.iter_mut();
        for (joint, _) in poses.flat_map(|pose| pose.held.iter_mut().chain(&mut pose.starts)) {
            *joint = joints[joint].clone();
        }
        (self, joints)
    }

    /// Another spanning tree, grown from another link: some loops become tree joints and some tree joints loops, links get
    /// their frames at the joint that now carries them, and a joint passed backward has its sides exchanged. A joint whose
    /// two frames do not coincide at home stays a loop. Frames must be parallel at home, couplings and named poses absent.
    #[must_use]
    pub fn with_another_tree(mut self, seed: u64) -> Self {
        assert!(self.mimics.is_empty() && self.ratios.is_empty() && self.poses.is_empty());
        assert!(self.sums.is_empty());
        let old_origins = self.origins();
        let at = |end: &End| sum(&old_origins[&end.link], &end.frame.position);
        let mut random = Shuffle(seed);
        let mut order: Vec<usize> = (0..self.joints.len()).collect();
        random.shuffle(&mut order);
        // Loops of the file first, so that they become tree joints.
        order.sort_by_key(|&index| !self.joints[index].closes_loop);
        let root = self.links[random.below(self.links.len())].clone();
        let mut new_origins = BTreeMap::from([(root.clone(), old_origins[&root].clone())]);
        let mut tree = vec![false; self.joints.len()];
        while let Some((index, backward)) = order.iter().find_map(|&index| {
            let joint = &self.joints[index];
            let [a, b] = &joint.ends;
            let [near, far] = [a, b].map(|end| new_origins.contains_key(&end.link));
            let fits = near != far && coincide(&at(a), &at(b)) && (near || reversible(joint.kind));
            fits.then_some((index, far))
        }) {
            tree[index] = true;
            let joint = &mut self.joints[index];
            if backward {
                joint.ends.swap(0, 1);
                if joint.kind == JointKind::Universal {
                    std::mem::swap(&mut joint.axis, &mut joint.axis2);
                }
            }
            new_origins.insert(joint.ends[1].link.clone(), at(&joint.ends[0]));
        }
        self.placed.clear();
        for link in &self.links {
            if !new_origins.contains_key(link) {
                new_origins.insert(link.clone(), old_origins[link].clone());
                self.placed.push(Placed {
                    parent: root.clone(),
                    child: link.clone(),
                    origin: Frame::at(difference(&old_origins[link], &old_origins[&root])),
                });
            }
        }
        for (joint, tree) in self.joints.iter_mut().zip(tree) {
            joint.closes_loop = !tree;
            for (side, end) in joint.ends.iter_mut().enumerate() {
                end.frame = if tree && side == 1 {
                    Frame::identity()
                } else {
                    let position = sum(&old_origins[&end.link], &end.frame.position);
                    Frame::at(difference(&position, &new_origins[&end.link]))
                };
            }
        }
        self
    }

    /// Where every link's frame is at home, all parallel, the root's in the origin.
    fn origins(&self) -> BTreeMap<String, [Number; 3]> {
        let zero = || [Number::zero(), Number::zero(), Number::zero()];
        let mut carried: BTreeMap<&str, (&str, [Number; 3])> = BTreeMap::new();
        for joint in self.joints.iter().filter(|joint| !joint.closes_loop) {
            let [a, b] = &joint.ends;
            assert_parallel(&a.frame);
            assert_parallel(&b.frame);
            let step = difference(&a.frame.position, &b.frame.position);
            carried.insert(&b.link, (&a.link, step));
        }
        for placed in &self.placed {
            assert_parallel(&placed.origin);
            let step = placed.origin.position.clone();
            carried.insert(&placed.child, (&placed.parent, step));
        }
        let origin_of = |link: &str| {
            let (mut link, mut total) = (link, zero());
            while let Some((parent, step)) = carried.get(link) {
                total = sum(&total, step);
                link = parent;
            }
            total
        };
        self.links
            .iter()
            .map(|link| (link.clone(), origin_of(link)))
            .collect()
    }
}

/// Kinds whose displacements can be told from either side.
fn reversible(kind: JointKind) -> bool {
    kind.is_subgroup() || kind == JointKind::Universal
}

fn coincide(a: &[Number; 3], b: &[Number; 3]) -> bool {
    // The files carry some sixty digits.
    difference(a, b).iter().all(|d| d.value().abs() < 1e-50)
}

fn assert_parallel(frame: &Frame) {
    assert!(frame.roll_pitch_yaw.iter().all(Number::is_zero));
}

fn sum(a: &[Number; 3], b: &[Number; 3]) -> [Number; 3] {
    [0, 1, 2].map(|i| decimal::sum(&a[i], &b[i]))
}

fn difference(a: &[Number; 3], b: &[Number; 3]) -> [Number; 3] {
    [0, 1, 2].map(|i| decimal::sum(&a[i], &decimal::negated(&b[i])))
}

/// The rotation of the quaternion (1, 2, 3, 4)/√30, times fifteen: w² + x² − y² − z², 2(xy − wz), ….
pub const TURN: [[i64; 3]; 3] = [[-10, 2, 11], [10, -5, 10], [5, 14, 2]];

/// 125 times a rotation: by the angle of the triangle 3, 4, 5 about z, then by that of 7, 24, 25 about x.
const TURN_IN_DECIMALS: [[i64; 3]; 3] = [[75, -100, 0], [28, 21, -120], [96, 72, 35]];

/// Turns a vector by [`TURN`], exactly.
fn turned(v: &[Number; 3]) -> [Number; 3] {
    [0, 1, 2].map(|i| {
        (0..3).fold(Number::zero(), |total, j| {
            &total + &(&Number::ratio(TURN[i][j], 15).unwrap() * &v[j])
        })
    })
}

/// Roll, pitch and yaw of [`TURN`] as exact angles.
fn turn_angles() -> [Number; 3] {
    let entry = |i: usize, j: usize| Number::integer(TURN[i][j]);
    [
        Number::atan2(&entry(2, 1), &entry(2, 2)).unwrap(),
        Number::ratio(-TURN[2][0], 15).unwrap().asin().unwrap(),
        Number::atan2(&entry(1, 0), &entry(0, 0)).unwrap(),
    ]
}

/// A small generator for shuffles (Knuth's multiplier, the high bits).
struct Shuffle(u64);

impl Shuffle {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % bound
    }

    fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            let other = self.below(last + 1);
            items.swap(last, other);
        }
    }
}
