//! Making a mechanism: collect links, joints and couplings by name, then check everything at once.

use super::configuration::Configuration;
use super::coupling::{Coupling, CouplingOrigin, CouplingTerm};
use super::error::{Entity, MechanismError};
use super::frame::{Direction, Frame};
use super::joint::{Dynamics, Joint, Limit, Side};
use super::kind::JointKind;
use super::link::{Inertial, Link, Placement, Shape};
use super::model::{JointId, LinkId, Mechanism, Precision};
use super::scene::{Drive, Expectation, Scene};
use crate::number::Number;
use std::collections::{BTreeMap, BTreeSet};

/// A joint under construction. Links are named; [`MechanismBuilder::build`] resolves them.
#[derive(Clone, Debug)]
pub struct JointBuilder {
    name: String,
    kind: JointKind,
    predecessor: String,
    successor: String,
    predecessor_frame: Frame,
    successor_frame: Frame,
    axis: Option<Direction>,
    axis2: Option<Direction>,
    lead: Option<Number>,
    distance: Option<Number>,
    limit: Option<Limit>,
    dynamics: Option<Dynamics>,
    independent: Option<bool>,
    closes_loop: bool,
}

impl JointBuilder {
    /// A joint of the file's tree, which also places its child at home.
    #[must_use]
    pub fn tree(name: &str, kind: JointKind, parent: &str, child: &str) -> Self {
        Self::new(name, kind, parent, child, false)
    }

    /// A joint that closes a loop between two links placed otherwise.
    #[must_use]
    pub fn closing(name: &str, kind: JointKind, predecessor: &str, successor: &str) -> Self {
        Self::new(name, kind, predecessor, successor, true)
    }

    fn new(
        name: &str,
        kind: JointKind,
        predecessor: &str,
        successor: &str,
        closes_loop: bool,
    ) -> Self {
        Self {
            name: name.to_owned(),
            kind,
            predecessor: predecessor.to_owned(),
            successor: successor.to_owned(),
            predecessor_frame: Frame::identity(),
            successor_frame: Frame::identity(),
            axis: None,
            axis2: None,
            lead: None,
            distance: None,
            limit: None,
            dynamics: None,
            independent: None,
            closes_loop,
        }
    }

    /// The joint frame in the predecessor (a tree joint's origin in its parent).
    #[must_use]
    pub fn origin(mut self, frame: Frame) -> Self {
        self.predecessor_frame = frame;
        self
    }

    /// The joint frame in the successor; a tree joint's is the link frame itself.
    #[must_use]
    pub fn successor_origin(mut self, frame: Frame) -> Self {
        self.successor_frame = frame;
        self
    }

    /// Axis, direction or plane normal in the predecessor's joint frame.
    #[must_use]
    pub fn axis(mut self, axis: Direction) -> Self {
        self.axis = Some(axis);
        self
    }

    /// Second axis, line or plane normal in the successor's joint frame.
    #[must_use]
    pub fn axis2(mut self, axis: Direction) -> Self {
        self.axis2 = Some(axis);
        self
    }

    /// Metres per turn.
    #[must_use]
    pub fn lead(mut self, lead: Number) -> Self {
        self.lead = Some(lead);
        self
    }

    /// Metres between the two origins of a distance joint.
    #[must_use]
    pub fn distance(mut self, distance: Number) -> Self {
        self.distance = Some(distance);
        self
    }

    /// Range and rates.
    #[must_use]
    pub fn limit(mut self, limit: Limit) -> Self {
        self.limit = Some(limit);
        self
    }

    /// Friction and damping.
    #[must_use]
    pub fn dynamics(mut self, dynamics: Dynamics) -> Self {
        self.dynamics = Some(dynamics);
        self
    }

    /// URDF+'s mark of an independent coordinate.
    #[must_use]
    pub fn independent(mut self, independent: bool) -> Self {
        self.independent = Some(independent);
        self
    }
}

#[derive(Clone, Debug)]
enum CouplingSpec {
    Ratio {
        predecessor: String,
        successor: String,
        ratio: Number,
    },
    Mimic {
        follower: String,
        leader: String,
        multiplier: Number,
        offset: Number,
    },
}

#[derive(Clone, Debug)]
struct LinkSpec {
    name: String,
    inertial: Option<Inertial>,
    collisions: Vec<Shape>,
    visuals: Vec<Shape>,
}

#[derive(Clone, Debug)]
struct FloatingSpec {
    name: String,
    parent: String,
    child: String,
    origin: Frame,
}

/// Collects a mechanism by names and checks it as a whole.
///
/// ```
/// use kutzbach::mechanism::{Direction, Frame, JointBuilder, JointKind, MechanismBuilder};
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let z = Direction::of([0.0, 0.0, 1.0]).ok_or("not finite")?;
/// let at = |x: f64, y: f64| Frame::at_point([x, y, 0.0]).ok_or("not finite");
/// let mut builder = MechanismBuilder::new("parallelogram");
/// builder.link("ground").link("crank").link("coupler").link("rocker");
/// builder.joint(JointBuilder::tree("A", JointKind::Revolute, "ground", "crank").axis(z.clone()));
/// builder.joint(JointBuilder::tree("B", JointKind::Revolute, "crank", "coupler").origin(at(0.0, 1.0)?).axis(z.clone()));
/// builder.joint(JointBuilder::tree("D", JointKind::Revolute, "ground", "rocker").origin(at(2.0, 0.0)?).axis(z.clone()));
/// builder.joint(
///     JointBuilder::closing("C", JointKind::Revolute, "coupler", "rocker")
///         .origin(at(2.0, 0.0)?)
///         .successor_origin(at(0.0, 1.0)?)
///         .axis(z),
/// );
/// let mechanism = builder.build()?;
/// assert_eq!(mechanism.joints().len(), 4);
/// # Ok(()) }
/// ```
#[derive(Clone, Debug, Default)]
pub struct MechanismBuilder {
    name: String,
    ground: Option<String>,
    links: Vec<LinkSpec>,
    joints: Vec<JointBuilder>,
    floating: Vec<FloatingSpec>,
    couplings: Vec<(String, CouplingSpec)>,
    configurations: Vec<(String, Vec<(String, Vec<Number>)>)>,
    scene: Option<Scene>,
    drives: Vec<(String, Number, Option<Number>)>,
    expectation: Option<Expectation>,
}

impl MechanismBuilder {
    /// An empty mechanism.
    #[must_use]
    pub fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            ..Self::default()
        }
    }

    /// Adds a link.
    pub fn link(&mut self, name: &str) -> &mut Self {
        self.detailed_link(name, None, Vec::new(), Vec::new())
    }

    /// Adds a link with mass properties and shapes.
    pub fn detailed_link(
        &mut self,
        name: &str,
        inertial: Option<Inertial>,
        collisions: Vec<Shape>,
        visuals: Vec<Shape>,
    ) -> &mut Self {
        self.links.push(LinkSpec {
            name: name.to_owned(),
            inertial,
            collisions,
            visuals,
        });
        self
    }

    /// Adds a joint. A tree joint whose child already has a tree joint closes a loop instead.
    pub fn joint(&mut self, joint: JointBuilder) -> &mut Self {
        self.joints.push(joint);
        self
    }

    /// Places a link at home without constraining it.
    pub fn floating(&mut self, name: &str, parent: &str, child: &str, origin: Frame) -> &mut Self {
        self.floating.push(FloatingSpec {
            name: name.to_owned(),
            parent: parent.to_owned(),
            child: child.to_owned(),
            origin,
        });
        self
    }

    /// Couples two links by a ratio of rates.
    pub fn coupling(
        &mut self,
        name: &str,
        predecessor: &str,
        successor: &str,
        ratio: Number,
    ) -> &mut Self {
        let spec = CouplingSpec::Ratio {
            predecessor: predecessor.to_owned(),
            successor: successor.to_owned(),
            ratio,
        };
        self.couplings.push((name.to_owned(), spec));
        self
    }

    /// Makes one joint follow another: `follower = multiplier × leader + offset`. The coupling is named after the follower.
    pub fn mimic(
        &mut self,
        follower: &str,
        leader: &str,
        multiplier: Number,
        offset: Number,
    ) -> &mut Self {
        let spec = CouplingSpec::Mimic {
            follower: follower.to_owned(),
            leader: leader.to_owned(),
            multiplier,
            offset,
        };
        self.couplings.push((format!("{follower}.mimic"), spec));
        self
    }

    /// Holds this link fixed instead of the tree's root.
    pub fn ground(&mut self, link: &str) -> &mut Self {
        self.ground = Some(link.to_owned());
        self
    }

    /// Adds a named pose.
    pub fn configuration(
        &mut self,
        name: &str,
        positions: Vec<(String, Vec<Number>)>,
    ) -> &mut Self {
        self.configurations.push((name.to_owned(), positions));
        self
    }

    /// Sets the effects of a simulation; drives are added by [`drive`](Self::drive).
    pub fn scene(&mut self, scene: Scene) -> &mut Self {
        self.scene = Some(scene);
        self
    }

    /// Adds a driven joint to the scene.
    pub fn drive(&mut self, joint: &str, velocity: Number, torque: Option<Number>) -> &mut Self {
        self.drives.push((joint.to_owned(), velocity, torque));
        self
    }

    /// States what is known of the answer.
    pub fn expect(&mut self, expectation: Expectation) -> &mut Self {
        self.expectation = Some(expectation);
        self
    }

    /// Checks everything and makes the mechanism. Linear in its size but for name look-ups.
    ///
    /// # Errors
    /// The first thing that contradicts the rules of the [module](super), with the entity it is about.
    pub fn build(self) -> Result<Mechanism, MechanismError> {
        let link_by_name = self.index_links()?;
        let mut links: Vec<Option<Placement>> = vec![None; self.links.len()];
        let resolve = |entity: &Entity, name: &str| {
            link_by_name.get(name).copied().ok_or_else(|| {
                MechanismError::new(entity.clone(), format!("there is no link named `{name}`"))
                    .help(nearest(name, link_by_name.keys()))
            })
        };

        let mut joint_by_name = BTreeMap::new();
        let mut used_names: BTreeSet<&str> = BTreeSet::new();
        let mut joints = Vec::with_capacity(self.joints.len());
        for spec in &self.joints {
            let entity = Entity::Joint(spec.name.clone());
            if spec.name.is_empty() {
                return Err(MechanismError::new(entity, "a joint needs a name"));
            }
            if !used_names.insert(&spec.name) {
                return Err(
                    MechanismError::new(entity, "two joints have this name").help(
                        "joints, loops and couplings share one set of names; rename one of them",
                    ),
                );
            }
            let predecessor = resolve(&entity, &spec.predecessor)?;
            let successor = resolve(&entity, &spec.successor)?;
            if predecessor == successor {
                return Err(MechanismError::new(
                    entity,
                    format!(
                        "both sides are link `{}`; a joint connects two different links",
                        spec.predecessor
                    ),
                ));
            }
            let id = JointId(joints.len());
            let mut closes_loop = spec.closes_loop;
            if !closes_loop {
                let placement = &mut links[successor.0];
                if placement.is_some() {
                    closes_loop = true;
                } else {
                    *placement = Some(Placement::Joint(id));
                }
            }
            joints.push(check_joint(
                spec,
                &entity,
                predecessor,
                successor,
                closes_loop,
            )?);
            joint_by_name.insert(spec.name.clone(), id);
        }
        for spec in &self.floating {
            let entity = Entity::Joint(spec.name.clone());
            if !used_names.insert(&spec.name) {
                return Err(MechanismError::new(entity, "two joints have this name"));
            }
            let parent = resolve(&entity, &spec.parent)?;
            let child = resolve(&entity, &spec.child)?;
            if parent == child {
                return Err(MechanismError::new(
                    entity,
                    "parent and child are the same link",
                ));
            }
            if links[child.0].is_some() {
                return Err(MechanismError::new(
                    entity,
                    format!("link `{}` is placed by another joint already", spec.child),
                )
                .help("a floating joint only places its child at home; remove one of the two"));
            }
            check_frame(&entity, &spec.origin)?;
            links[child.0] = Some(Placement::Floating {
                name: spec.name.clone(),
                parent,
                origin: spec.origin.clone(),
            });
        }

        let (root, placement_order) = self.order_placements(&links, &joints)?;
        let ground = match &self.ground {
            Some(name) => resolve(&Entity::Ground, name)?,
            None => root,
        };
        let links: Vec<Link> = self
            .links
            .iter()
            .zip(links)
            .map(|(spec, placement)| Link {
                name: spec.name.clone(),
                placement: placement.unwrap_or(Placement::World),
                inertial: spec.inertial.clone(),
                collisions: spec.collisions.clone(),
                visuals: spec.visuals.clone(),
            })
            .collect();

        let couplings = self.resolve_couplings(
            &links,
            &joints,
            &link_by_name,
            &joint_by_name,
            &mut used_names.clone(),
        )?;
        let configurations = self.resolve_configurations(&joints, &joint_by_name)?;
        let scene = self.resolve_scene(&joints, &joint_by_name)?;
        self.check_expectation(&joints, &joint_by_name, &link_by_name)?;
        let precision = Precision::of(&links, &joints);
        Ok(Mechanism {
            name: self.name,
            ground,
            links,
            joints,
            couplings,
            configurations,
            scene,
            expectation: self.expectation,
            placement_order,
            precision,
            link_by_name,
            joint_by_name,
        })
    }

    fn index_links(&self) -> Result<BTreeMap<String, LinkId>, MechanismError> {
        if self.links.is_empty() {
            return Err(MechanismError::new(Entity::Mechanism, "there is no link")
                .help("a mechanism has at least one <link name=\"...\"/>"));
        }
        let mut by_name = BTreeMap::new();
        for (index, link) in self.links.iter().enumerate() {
            let entity = Entity::Link(link.name.clone());
            if link.name.is_empty() {
                return Err(MechanismError::new(entity, "a link needs a name"));
            }
            if by_name.insert(link.name.clone(), LinkId(index)).is_some() {
                return Err(MechanismError::new(entity, "two links have this name"));
            }
            if let Some(inertial) = &link.inertial {
                check_frame(&entity, &inertial.origin)?;
                check_finite(&entity, "mass", &inertial.mass)?;
                for component in &inertial.inertia {
                    check_finite(&entity, "inertia", component)?;
                }
                if inertial.mass.value() < 0.0 {
                    return Err(MechanismError::new(entity, "the mass is negative"));
                }
            }
        }
        Ok(by_name)
    }

    /// The root of the placement tree and an order in which every link follows the one it is placed by.
    fn order_placements(
        &self,
        placements: &[Option<Placement>],
        joints: &[Joint],
    ) -> Result<(LinkId, Vec<LinkId>), MechanismError> {
        let mut children: Vec<Vec<usize>> = vec![Vec::new(); placements.len()];
        let mut roots = Vec::new();
        for (index, placement) in placements.iter().enumerate() {
            match placement {
                None | Some(Placement::World) => roots.push(index),
                Some(Placement::Joint(joint)) => {
                    children[joints[joint.0].predecessor.link.0].push(index)
                }
                Some(Placement::Floating { parent, .. }) => children[parent.0].push(index),
            }
        }
        let Some(&root) = roots.first() else {
            return Err(MechanismError::new(
                Entity::Link(self.links[0].name.clone()),
                "every link is the child of another: the tree joints run in a circle and nothing is at the root",
            )
            .help("write the joint that closes the circle as a <loop>"));
        };
        if let Some(&second) = roots.get(1) {
            return Err(MechanismError::new(
                Entity::Link(self.links[second].name.clone()),
                format!(
                    "nothing connects it to `{}`: no joint has it as its child, so its home pose is unknown",
                    self.links[root].name
                ),
            )
            .help("add a <joint> with this link as <child>; type=\"floating\" places it without constraining it"));
        }
        let mut order = Vec::with_capacity(placements.len());
        let mut queue = std::collections::VecDeque::from([root]);
        while let Some(index) = queue.pop_front() {
            order.push(LinkId(index));
            queue.extend(&children[index]);
        }
        if order.len() < placements.len() {
            let reached: BTreeSet<usize> = order.iter().map(|l| l.0).collect();
            let lost = (0..placements.len())
                .find(|i| !reached.contains(i))
                .unwrap_or(root);
            return Err(MechanismError::new(
                Entity::Link(self.links[lost].name.clone()),
                format!(
                    "it is not connected to the root `{}`: its tree joints run in a circle",
                    self.links[root].name
                ),
            )
            .help("write the joint that closes the circle as a <loop>"));
        }
        Ok((LinkId(root), order))
    }

    fn resolve_couplings(
        &self,
        links: &[Link],
        joints: &[Joint],
        link_by_name: &BTreeMap<String, LinkId>,
        joint_by_name: &BTreeMap<String, JointId>,
        used_names: &mut BTreeSet<&str>,
    ) -> Result<Vec<Coupling>, MechanismError> {
        let mut couplings = Vec::with_capacity(self.couplings.len());
        let mut leaders: BTreeMap<JointId, JointId> = BTreeMap::new();
        let mut names: BTreeSet<String> = used_names.iter().map(|n| (*n).to_owned()).collect();
        for (name, spec) in &self.couplings {
            let entity = match spec {
                CouplingSpec::Ratio { .. } => Entity::Coupling(name.clone()),
                CouplingSpec::Mimic { follower, .. } => Entity::Joint(follower.clone()),
            };
            if name.is_empty() {
                return Err(MechanismError::new(entity, "a coupling needs a name"));
            }
            if !names.insert(name.clone()) {
                return Err(MechanismError::new(
                    entity,
                    format!("the name `{name}` is taken already"),
                )
                .help("joints, loops and couplings share one set of names; rename one of them"));
            }
            let coupling = match spec {
                CouplingSpec::Ratio {
                    predecessor,
                    successor,
                    ratio,
                } => {
                    let link = |n: &str| {
                        link_by_name.get(n).copied().ok_or_else(|| {
                            MechanismError::new(
                                entity.clone(),
                                format!("there is no link named `{n}`"),
                            )
                            .help(nearest(n, link_by_name.keys()))
                        })
                    };
                    check_finite(&entity, "ratio", ratio)?;
                    let (predecessor, successor) = (link(predecessor)?, link(successor)?);
                    Coupling {
                        name: name.clone(),
                        terms: ratio_terms(&entity, links, joints, predecessor, successor, ratio)?,
                        offset: Number::zero(),
                        origin: CouplingOrigin::Ratio {
                            predecessor,
                            successor,
                            ratio: ratio.clone(),
                        },
                    }
                }
                CouplingSpec::Mimic {
                    follower,
                    leader,
                    multiplier,
                    offset,
                } => {
                    check_finite(&entity, "multiplier", multiplier)?;
                    check_finite(&entity, "offset", offset)?;
                    let joint = |n: &str| {
                        let id = joint_by_name.get(n).copied().ok_or_else(|| {
                            MechanismError::new(
                                entity.clone(),
                                format!("mimic names joint `{n}`, which does not exist"),
                            )
                            .help(nearest(n, joint_by_name.keys()))
                        })?;
                        one_freedom(&entity, &joints[id.0]).map(|()| id)
                    };
                    let (follower, leader) = (joint(follower)?, joint(leader)?);
                    if follower == leader {
                        return Err(MechanismError::new(entity, "the joint mimics itself"));
                    }
                    leaders.insert(follower, leader);
                    let mut terms = vec![CouplingTerm {
                        joint: follower,
                        factor: Number::one(),
                    }];
                    if !multiplier.is_zero() {
                        terms.push(CouplingTerm {
                            joint: leader,
                            factor: -multiplier,
                        });
                    }
                    Coupling {
                        name: name.clone(),
                        terms,
                        offset: offset.clone(),
                        origin: CouplingOrigin::Mimic {
                            follower,
                            leader,
                            multiplier: multiplier.clone(),
                            offset: offset.clone(),
                        },
                    }
                }
            };
            couplings.push(coupling);
        }
        check_mimic_circles(&leaders, joints)?;
        Ok(couplings)
    }

    fn resolve_configurations(
        &self,
        joints: &[Joint],
        joint_by_name: &BTreeMap<String, JointId>,
    ) -> Result<Vec<Configuration>, MechanismError> {
        let mut names = BTreeSet::new();
        let mut configurations = Vec::new();
        for (name, positions) in &self.configurations {
            let entity = Entity::Configuration(name.clone());
            if !names.insert(name) {
                return Err(MechanismError::new(
                    entity,
                    "two configurations have this name",
                ));
            }
            let mut resolved: Vec<(JointId, Vec<Number>)> = Vec::new();
            for (joint, values) in positions {
                let id = joint_by_name.get(joint).copied().ok_or_else(|| {
                    MechanismError::new(
                        entity.clone(),
                        format!("there is no joint named `{joint}`"),
                    )
                    .help(nearest(joint, joint_by_name.keys()))
                })?;
                if resolved.iter().any(|(other, _)| *other == id) {
                    return Err(MechanismError::new(
                        entity,
                        format!("joint `{joint}` has two positions"),
                    ));
                }
                let freedom = joints[id.0].freedom();
                if values.len() != freedom {
                    return Err(MechanismError::new(
                        entity,
                        format!(
                            "joint `{joint}` has {freedom} freedoms but {} values",
                            values.len()
                        ),
                    ));
                }
                for value in values {
                    check_finite(&entity, "position", value)?;
                }
                resolved.push((id, values.clone()));
            }
            configurations.push(Configuration {
                name: name.clone(),
                positions: resolved,
            });
        }
        Ok(configurations)
    }

    fn resolve_scene(
        &self,
        joints: &[Joint],
        joint_by_name: &BTreeMap<String, JointId>,
    ) -> Result<Option<Scene>, MechanismError> {
        let mut scene = self.scene.clone();
        if scene.is_none() && !self.drives.is_empty() {
            scene = Some(Scene::default());
        }
        let Some(mut scene) = scene else {
            return Ok(None);
        };
        for component in scene.gravity.iter().flatten() {
            check_finite(&Entity::Scene, "gravity", component)?;
        }
        for (name, velocity, torque) in &self.drives {
            let joint = joint_by_name.get(name).copied().ok_or_else(|| {
                MechanismError::new(
                    Entity::Scene,
                    format!("the drive names joint `{name}`, which does not exist"),
                )
                .help(nearest(name, joint_by_name.keys()))
            })?;
            one_freedom(&Entity::Scene, &joints[joint.0])?;
            check_finite(&Entity::Scene, "velocity", velocity)?;
            if let Some(torque) = torque {
                check_finite(&Entity::Scene, "torque", torque)?;
            }
            scene.drives.push(Drive {
                joint,
                velocity: velocity.clone(),
                torque: torque.clone(),
            });
        }
        Ok(Some(scene))
    }

    fn check_expectation(
        &self,
        joints: &[Joint],
        joint_by_name: &BTreeMap<String, JointId>,
        link_by_name: &BTreeMap<String, LinkId>,
    ) -> Result<(), MechanismError> {
        let Some(expectation) = &self.expectation else {
            return Ok(());
        };
        let fail = |problem: String| Err(MechanismError::new(Entity::Expectation, problem));
        if let Some(pose) = &expectation.pose
            && !["regular", "singular"].contains(&pose.as_str())
        {
            return fail(format!("pose is `regular` or `singular`, not `{pose}`"));
        }
        for locked in expectation.locked.iter().flatten() {
            let known = locked == "all"
                || joint_by_name.contains_key(locked)
                || joints.iter().any(|joint| {
                    (0..joint.freedom())
                        .any(|f| joint.freedom_name(f) == *locked || part_name(joint, f) == *locked)
                });
            if !known {
                return fail(format!(
                    "locked names `{locked}`, which is neither a joint nor a part of one"
                ));
            }
        }
        for idle in expectation.idle.iter().flatten() {
            if !link_by_name.contains_key(idle) {
                return fail(format!("idle names `{idle}`, which is not a link"));
            }
        }
        Ok(())
    }
}

/// `joint.rot` for every rotation of a joint, whether it has one or more.
fn part_name(joint: &Joint, freedom: usize) -> String {
    format!("{}.{}", joint.name, joint.kind.freedoms()[freedom].suffix())
}

fn check_joint(
    spec: &JointBuilder,
    entity: &Entity,
    predecessor: LinkId,
    successor: LinkId,
    closes_loop: bool,
) -> Result<Joint, MechanismError> {
    check_frame(entity, &spec.predecessor_frame)?;
    check_frame(entity, &spec.successor_frame)?;
    let kind = spec.kind;
    for (direction, what, used) in [
        (&spec.axis, "axis", kind.uses_axis()),
        (&spec.axis2, "axis2", kind.uses_second_axis()),
    ] {
        let Some(direction) = direction else { continue };
        for component in &direction.0 {
            check_finite(entity, what, component)?;
        }
        if used && direction.is_zero() {
            return Err(MechanismError::new(
                entity.clone(),
                format!("{what} is the zero vector, which names no direction"),
            ));
        }
    }
    match (&spec.lead, kind.uses_lead()) {
        (None, true) => {
            return Err(MechanismError::new(
                entity.clone(),
                format!("a {kind} joint needs its lead"),
            )
            .help("<screw lead=\"metres per turn\"/>"));
        }
        (Some(_), false) => {
            return Err(MechanismError::new(
                entity.clone(),
                format!("a {kind} joint has no lead"),
            ));
        }
        (Some(lead), true) => check_finite(entity, "lead", lead)?,
        (None, false) => {}
    }
    if let Some(distance) = &spec.distance {
        if kind != JointKind::Distance {
            return Err(MechanismError::new(
                entity.clone(),
                format!("a {kind} joint keeps no distance"),
            ));
        }
        check_finite(entity, "distance", distance)?;
        if distance.value() <= 0.0 {
            return Err(MechanismError::new(
                entity.clone(),
                "the distance must be greater than zero",
            )
            .help("two points that coincide are a `spherical` joint"));
        }
    } else if kind == JointKind::Distance && !closes_loop {
        return Err(MechanismError::new(
            entity.clone(),
            "the two points of a tree joint coincide at home, so a distance joint needs its <distance value=\"...\"/>",
        ));
    }
    if let Some(limit) = &spec.limit {
        for (what, value) in [
            ("lower limit", &limit.lower),
            ("upper limit", &limit.upper),
            ("effort", &limit.effort),
            ("velocity", &limit.velocity),
        ] {
            if let Some(value) = value {
                check_finite(entity, what, value)?;
            }
        }
        if let (Some(lower), Some(upper)) = (&limit.lower, &limit.upper)
            && lower.value() > upper.value()
        {
            return Err(MechanismError::new(
                entity.clone(),
                "the lower limit is above the upper limit",
            ));
        }
    }
    for value in spec
        .dynamics
        .iter()
        .flat_map(|d| d.damping.iter().chain(&d.friction))
    {
        check_finite(entity, "dynamics", value)?;
    }
    Ok(Joint {
        name: spec.name.clone(),
        kind,
        predecessor: Side {
            link: predecessor,
            frame: spec.predecessor_frame.clone(),
        },
        successor: Side {
            link: successor,
            frame: spec.successor_frame.clone(),
        },
        axis: spec.axis.clone().unwrap_or_else(Direction::x),
        axis2: spec.axis2.clone().unwrap_or_else(Direction::x),
        lead: spec.lead.clone(),
        distance: spec.distance.clone(),
        limit: spec.limit.clone(),
        dynamics: spec.dynamics.clone(),
        independent: spec.independent,
        closes_loop,
    })
}

/// `Σ(ancestor → successor) − ratio Σ(ancestor → predecessor) = 0` along the file's tree.
fn ratio_terms(
    entity: &Entity,
    links: &[Link],
    joints: &[Joint],
    predecessor: LinkId,
    successor: LinkId,
    ratio: &Number,
) -> Result<Vec<CouplingTerm>, MechanismError> {
    let path_to_root = |mut link: LinkId| {
        let mut path = vec![link];
        loop {
            link = match &links[link.0].placement {
                Placement::World => return path,
                Placement::Joint(joint) => joints[joint.0].predecessor.link,
                Placement::Floating { parent, .. } => *parent,
            };
            path.push(link);
        }
    };
    let predecessor_path = path_to_root(predecessor);
    let ancestors: BTreeSet<LinkId> = predecessor_path.iter().copied().collect();
    let successor_path = path_to_root(successor);
    let ancestor = successor_path
        .iter()
        .copied()
        .find(|link| ancestors.contains(link))
        .unwrap_or(predecessor);
    let mut terms = Vec::new();
    for (path, factor) in [
        (&successor_path, Number::one()),
        (&predecessor_path, -ratio),
    ] {
        for link in path.iter().take_while(|link| **link != ancestor) {
            match &links[link.0].placement {
                Placement::Joint(joint) if joints[joint.0].kind == JointKind::Fixed => {}
                Placement::Joint(joint) => {
                    one_freedom(entity, &joints[joint.0])?;
                    if !factor.is_zero() {
                        terms.push(CouplingTerm {
                            joint: *joint,
                            factor: factor.clone(),
                        });
                    }
                }
                Placement::Floating { name, .. } => {
                    return Err(MechanismError::new(
                        entity.clone(),
                        format!(
                            "its path through the tree crosses floating joint `{name}`, which has no rate"
                        ),
                    ));
                }
                Placement::World => {}
            }
        }
    }
    if terms.is_empty() {
        return Err(MechanismError::new(
            entity.clone(),
            format!(
                "no joint moves between `{}` and `{}`, so their rates cannot be coupled",
                links[predecessor.0].name, links[successor.0].name
            ),
        ));
    }
    Ok(terms)
}

fn check_mimic_circles(
    leaders: &BTreeMap<JointId, JointId>,
    joints: &[Joint],
) -> Result<(), MechanismError> {
    let mut settled: BTreeSet<JointId> = BTreeSet::new();
    for &start in leaders.keys() {
        let mut walk = Vec::new();
        let mut on_walk = BTreeSet::new();
        let mut joint = start;
        while let Some(&leader) = leaders.get(&joint) {
            if settled.contains(&joint) {
                break;
            }
            if !on_walk.insert(joint) {
                let names: Vec<&str> = walk
                    .iter()
                    .map(|j: &JointId| joints[j.0].name.as_str())
                    .collect();
                return Err(MechanismError::new(
                    Entity::Joint(joints[joint.0].name.clone()),
                    format!("mimic runs in a circle: {}", names.join(" -> ")),
                ));
            }
            walk.push(joint);
            joint = leader;
        }
        settled.extend(walk);
    }
    Ok(())
}

fn one_freedom(entity: &Entity, joint: &Joint) -> Result<(), MechanismError> {
    if joint.freedom() == 1 {
        return Ok(());
    }
    Err(MechanismError::new(
        entity.clone(),
        format!(
            "joint `{}` is {} with {} freedoms; only a joint of one freedom has a single rate",
            joint.name,
            joint.kind,
            joint.freedom()
        ),
    ))
}

fn check_frame(entity: &Entity, frame: &Frame) -> Result<(), MechanismError> {
    for value in frame.position.iter().chain(&frame.roll_pitch_yaw) {
        check_finite(entity, "origin", value)?;
    }
    Ok(())
}

/// Exact numbers are always finite, but may be too large to compute with.
fn check_finite(entity: &Entity, what: &str, value: &Number) -> Result<(), MechanismError> {
    const LARGEST: f64 = 1e100;
    if value.value().abs() <= LARGEST {
        return Ok(());
    }
    Err(MechanismError::new(
        entity.clone(),
        format!(
            "{what} is {}, beyond the largest number accepted, 1e100",
            value.value()
        ),
    ))
}

/// A hint that names the most similar known name, by edit distance.
fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a String>) -> String {
    let best = known
        .take(1000)
        .map(|candidate| (edit_distance(name, candidate), candidate))
        .min();
    match best {
        Some((distance, candidate)) if distance * 2 <= name.len().max(2) => {
            format!("did you mean `{candidate}`?")
        }
        _ => "names are compared letter by letter, capitals included".to_owned(),
    }
}

/// Levenshtein distance, on at most 64 characters of each word.
fn edit_distance(a: &str, b: &str) -> usize {
    let a: Vec<char> = a.chars().take(64).collect();
    let b: Vec<char> = b.chars().take(64).collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let substitution = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = substitution.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}
