//! A mechanism taken apart into names and exact numbers, to be written differently and put together again.
//!
//! All rewritings keep the mechanism and change the description: the unit of length, where and how frames lie in their
//! links, names and order, which joints are loops, how many digits are written.

mod changes;

pub use changes::TURN;
use kutzbach::mechanism::{
    CouplingOrigin, Direction, Frame, JointBuilder, JointKind, Mechanism, MechanismBuilder,
    Placement,
};
use kutzbach::number::Number;

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
}
