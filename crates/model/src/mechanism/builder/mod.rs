//! Making a mechanism: collect links, joints and couplings by name, then check everything at once.
//!
//! A maker, be it a reader of files or a program, knows things by name and in any order; a [`Mechanism`] refers by index
//! and is valid. Between the two stands [`MechanismBuilder::build`], which looks at the whole in the order links, joints,
//! home poses, ground, couplings, configurations, actuated joints, scene, expectation, and stops at the first contradiction. The same
//! builder gives the same mechanism or the same error.
//!
//! Cost: `O(n log n)` for n names, plus the number of terms of the couplings.
//!
//! | file | what it knows |
//! |---|---|
//! | `joint_builder` | a joint under construction |
//! | `names` | which names are taken, and what they stand for |
//! | `did_you_mean` | the hint for a mistyped name |
//! | `checks` | rules about single values |
//! | `links`, `joints` | rules about one link, one joint |
//! | `placements` | the tree of home poses |
//! | `home_frames` | joints that are closed at home by construction |
//! | `ratio` | the joints between two links whose rates are coupled |
//! | `couplings`, `configurations`, `actuation`, `scene`, `expectation` | what refers to links and joints |

mod actuation;
mod checks;
mod configurations;
mod couplings;
mod did_you_mean;
mod expectation;
mod far_frames;
mod home_frames;
mod joint_builder;
mod joints;
mod links;
mod names;
mod placements;
mod ratio;
#[cfg(test)]
mod samples;
mod scene;
#[cfg(test)]
mod tests;

pub use joint_builder::JointBuilder;

use super::precision_by_block::Precisions;
use super::{
    Entity, Expectation, Frame, Inertial, JointId, Link, Mechanism, MechanismError, Placement,
    Recognised, Scene, Shape,
};
use actuation::resolve_actuated;
use configurations::{ConfigurationSpec, resolve_configurations};
use couplings::{CouplingSpec, Relation, resolve_couplings};
use expectation::check_expectation;
use home_frames::close_at_home;
use joints::make_joint;
use kutzbach_math::number::Number;
use links::check_link;
use names::Names;
use placements::{FloatingSpec, Placements};
use scene::{DriveSpec, resolve_scene};

/// Collects a mechanism by names and checks it as a whole.
///
/// ```
/// # use kutzbach_model as kutzbach;
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
    /// All at the world's origin until [`build`](Self::build) places them.
    links: Vec<Link>,
    joints: Vec<JointBuilder>,
    floating: Vec<FloatingSpec>,
    couplings: Vec<CouplingSpec>,
    configurations: Vec<ConfigurationSpec>,
    actuated: Vec<String>,
    scene: Option<Scene>,
    drives: Vec<DriveSpec>,
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
        self.links.push(Link {
            name: name.to_owned(),
            placement: Placement::World,
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

    /// Couples two links by a ratio of rates, seen from their nearest common link in the tree.
    pub fn coupling(
        &mut self,
        name: &str,
        predecessor: &str,
        successor: &str,
        ratio: Number,
    ) -> &mut Self {
        self.coupling_on(None, name, [predecessor, successor], ratio)
    }

    /// Couples two links, the driving one first, by a ratio of their rates seen from a link that bears them both, such as the
    /// carrier of a planetary gear.
    pub fn coupling_on(
        &mut self,
        carrier: Option<&str>,
        name: &str,
        [predecessor, successor]: [&str; 2],
        ratio: Number,
    ) -> &mut Self {
        let relation = Relation::Ratio {
            predecessor: predecessor.to_owned(),
            successor: successor.to_owned(),
            ratio,
            carrier: carrier.map(str::to_owned),
        };
        self.couplings.push(CouplingSpec {
            name: name.to_owned(),
            relation,
        });
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
        let relation = Relation::Mimic {
            follower: follower.to_owned(),
            leader: leader.to_owned(),
            multiplier,
            offset,
        };
        self.couplings.push(CouplingSpec {
            name: format!("{follower}.mimic"),
            relation,
        });
        self
    }

    /// Couples any number of joints of one freedom: `Σ coefficient × variable = offset` (rad, m).
    pub fn linear_coupling(
        &mut self,
        name: &str,
        terms: Vec<(String, Number)>,
        offset: Number,
    ) -> &mut Self {
        let terms = terms.into_iter().map(|(joint, x)| (joint, 1, x)).collect();
        self.polynomial_coupling(name, terms, offset)
    }

    /// Couples any number of joints of one freedom by powers of their variables: `Σ coefficient × variable^power = offset` (rad, m),
    /// each term a joint, a power of 1 to [`HIGHEST_POWER`](crate::mechanism::HIGHEST_POWER), and its coefficient.
    pub fn polynomial_coupling(
        &mut self,
        name: &str,
        terms: Vec<(String, u32, Number)>,
        offset: Number,
    ) -> &mut Self {
        self.couplings.push(CouplingSpec {
            name: name.to_owned(),
            relation: Relation::Sum { terms, offset },
        });
        self
    }

    /// Holds this link fixed instead of the tree's root.
    pub fn ground(&mut self, link: &str) -> &mut Self {
        self.ground = Some(link.to_owned());
        self
    }

    /// Adds a named pose: joints that keep their values (rad, m; one for each freedom), and the others follow.
    pub fn configuration(
        &mut self,
        name: &str,
        positions: Vec<(String, Vec<Number>)>,
    ) -> &mut Self {
        self.configuration_with_starts(name, positions, Vec::new())
    }

    /// Adds a named pose of which some joints keep their values and others, those of `starts`, only begin at theirs: assembly starts there
    /// and may move them.
    pub fn configuration_with_starts(
        &mut self,
        name: &str,
        positions: Vec<(String, Vec<Number>)>,
        starts: Vec<(String, Vec<Number>)>,
    ) -> &mut Self {
        self.configurations.push(ConfigurationSpec {
            name: name.to_owned(),
            positions,
            starts,
        });
        self
    }

    /// Says that a motor drives this joint; saying it twice is saying it once.
    pub fn actuate(&mut self, joint: &str) -> &mut Self {
        self.actuated.push(joint.to_owned());
        self
    }

    /// Sets the effects of a simulation; drives are added by [`drive`](Self::drive).
    pub fn scene(&mut self, scene: Scene) -> &mut Self {
        self.scene = Some(scene);
        self
    }

    /// Adds a driven joint to the scene.
    pub fn drive(&mut self, joint: &str, velocity: Number, torque: Option<Number>) -> &mut Self {
        self.drives.push(DriveSpec {
            joint: joint.to_owned(),
            velocity,
            torque,
        });
        self
    }

    /// States what is known of the answer.
    pub fn expect(&mut self, expectation: Expectation) -> &mut Self {
        self.expectation = Some(expectation);
        self
    }

    /// Checks everything and makes the mechanism, in `O(n log n)` for n names.
    ///
    /// # Errors
    /// The first thing that contradicts the rules of the [module](super), with the entity it is about.
    pub fn build(self) -> Result<Mechanism, MechanismError> {
        let mut links = self.links;
        if links.is_empty() {
            return Err(MechanismError::new(Entity::Mechanism, "there is no link")
                .help("a mechanism has at least one <link name=\"...\"/>"));
        }
        let mut names = Names::of_links(&links)?;
        links.iter().try_for_each(check_link)?;

        let mut placements = Placements::new(links.len());
        let mut joints = Vec::with_capacity(self.joints.len());
        let mut at_home = Vec::new();
        for mut spec in self.joints {
            let id = JointId(joints.len());
            at_home.extend(spec.at_home.take().map(|frame| (id, frame)));
            joints.push(make_joint(spec, id, &mut names, &mut placements)?);
        }
        for spec in self.floating {
            placements.place_by_floating(spec, &mut names)?;
        }
        let placement_order = placements.settle(&mut links, &joints)?;
        close_at_home(at_home, &mut joints, &links, &names)?;
        let ground = match &self.ground {
            Some(name) => names.link(&Entity::Ground, name)?,
            None => placement_order[0],
        };

        let couplings = resolve_couplings(
            self.couplings,
            &links,
            &joints,
            &placement_order,
            &mut names,
        )?;
        let configurations = resolve_configurations(self.configurations, &joints, &names)?;
        let actuated = resolve_actuated(self.actuated, &joints, &names)?;
        let scene = resolve_scene(self.scene, self.drives, &joints, &names)?;
        if let Some(expectation) = &self.expectation {
            check_expectation(expectation, &joints, &names)?;
        }
        let mechanism = Mechanism {
            name: self.name,
            ground,
            links,
            joints,
            couplings,
            configurations,
            actuated,
            scene,
            expectation: self.expectation,
            placement_order,
            precisions: Precisions::default(),
            recognised: Recognised::default(),
            link_by_name: names.links,
            joint_by_name: names.joints,
        };
        Ok(mechanism.read_digits())
    }
}
