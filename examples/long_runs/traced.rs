//! What all runs need of a mechanism: its analysis, and the energy and the rates of its traced motion.

use super::watch::Result;
use kutzbach::closure::{Arithmetic, Geometry, JointState};
use kutzbach::mechanism::{LinkId, Mechanism};
use kutzbach::mobility::{Analysis, AnalysisOptions, analyse};
use kutzbach::motion::{Curve, TraceOptions, trace};
use kutzbach::simulate::verification::Prediction;
use kutzbach::simulate::{Effects, Energy, World, WorldOptions};
use std::fmt::Write;

/// A mechanism, analysed.
pub struct Traced {
    /// As read.
    pub mechanism: Mechanism,
    /// In double precision.
    pub geometry: Geometry<f64>,
    /// What is predicted.
    pub analysis: Analysis,
    /// Characteristic length (m).
    pub length: f64,
}

/// Every joint gives each of its two links a ball of this mass (kg) and radius (m).
const BALL: (f64, f64) = (1.0, 0.3);

impl Traced {
    /// Analyses a mechanism, with masses stated for all links.
    ///
    /// Masses that no one states are derived for each world from its pose at the start; energies at different poses can be
    /// compared only where the masses are the same.
    pub fn new(mechanism: &Mechanism) -> Result<Self> {
        let mut text = kutzbach::format::write(mechanism);
        let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
        for (index, link) in mechanism.links().iter().enumerate() {
            let bare = format!("<link name=\"{}\"/>", link.name);
            let weighed = format!(
                "<link name=\"{}\">{}</link>",
                link.name,
                balls(mechanism, &geometry, index)
            );
            if !text.contains(&bare) {
                return Err(format!("link `{}` is more than a name", link.name).into());
            }
            text = text.replace(&bare, &weighed);
        }
        let mechanism = kutzbach::format::read(&text, mechanism.name(), &[])?.mechanism;
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let analysis = analyse(&mechanism, &AnalysisOptions::default())?;
        let start = &analysis.assembly.states;
        let home = World::new(&mechanism, &geometry, start, &WorldOptions::default())?;
        Ok(Self {
            length: home.scale().0,
            mechanism,
            geometry,
            analysis,
        })
    }

    /// A world at the start.
    pub fn world(&self, options: &WorldOptions) -> Result<World> {
        let (mechanism, geometry) = (&self.mechanism, &self.geometry);
        Ok(World::new(mechanism, geometry, self.start(), options)?)
    }

    /// The states at the start.
    pub fn start(&self) -> &[JointState<f64>] {
        &self.analysis.assembly.states
    }

    /// The index of a joint.
    pub fn joint(&self, name: &str) -> Result<usize> {
        let joints = &mut self.mechanism.joints().iter();
        let found = joints.position(|joint| joint.name == name);
        found.ok_or_else(|| format!("there is no joint `{name}`").into())
    }

    /// The prediction at the start, with so many freedoms.
    pub fn prediction(&self, freedom: usize) -> Result<Prediction<'_>> {
        let structure = &self.analysis.structure;
        let (mechanism, geometry) = (&self.mechanism, &self.geometry);
        Ok(Prediction::new(
            mechanism,
            geometry,
            structure,
            self.start(),
            freedom,
            self.length,
        )?)
    }

    /// The traced motion with one joint as its input.
    pub fn curve(&self, drive: &str) -> Result<Curve> {
        let options = TraceOptions {
            drive: Some(drive.to_owned()),
            samples: 2,
            ..TraceOptions::default()
        };
        let motion = trace(&self.mechanism, &self.analysis, &options)?.into_motion();
        Ok(motion.ok_or("the joint does not move")?.curve)
    }

    /// Rates of all joints halfway between two poses that are `time` (s) apart.
    pub fn rates(
        &self,
        before: &[JointState<f64>],
        after: &[JointState<f64>],
        time: f64,
    ) -> Vec<Vec<f64>> {
        let pairs = self.geometry.displacements.iter().zip(before).zip(after);
        pairs
            .map(|((joint, before), after)| {
                let increments = joint.increments(before, after);
                increments.iter().map(|x| x / time).collect()
            })
            .collect()
    }

    /// The energy of the links as they stand, moving at such rates.
    pub fn energy(
        &self,
        states: &[JointState<f64>],
        rates: Option<&[Vec<f64>]>,
        effects: Effects,
    ) -> Result<Energy> {
        let options = WorldOptions {
            effects,
            ..WorldOptions::default()
        };
        let mut world = World::new(&self.mechanism, &self.geometry, states, &options)?;
        if let Some(rates) = rates {
            world.set_rates(rates)?;
        }
        Ok(world.energy())
    }
}

/// The mass properties of balls at all joints of a link, as the format writes them.
fn balls(mechanism: &Mechanism, geometry: &Geometry<f64>, link: usize) -> String {
    let (mass, radius) = BALL;
    let mut places: Vec<[f64; 3]> = Vec::new();
    for (joint, sides) in mechanism.joints().iter().zip(&geometry.sides) {
        for (frame, side) in [&joint.predecessor, &joint.successor]
            .into_iter()
            .zip(sides)
        {
            if frame.link == LinkId(link) {
                places.push(side.translation);
            }
        }
    }
    let count = places.len().max(1) as f64;
    let centre = [0, 1, 2].map(|i| places.iter().map(|p| p[i]).sum::<f64>() / count);
    let mut moments = [[0.0; 3]; 3];
    for place in &places {
        let arm = [0, 1, 2].map(|i| place[i] - centre[i]);
        let square: f64 = arm.iter().map(|x| x * x).sum();
        for i in 0..3 {
            moments[i][i] += mass * (square + 0.4 * radius * radius);
            for j in 0..3 {
                moments[i][j] -= mass * arm[i] * arm[j];
            }
        }
    }
    let [x, y, z] = centre;
    let mut text = format!(
        "<inertial><origin xyz=\"{x} {y} {z}\"/><mass value=\"{}\"/><inertia",
        mass * count
    );
    for (name, i, j) in [
        ("ixx", 0, 0),
        ("ixy", 0, 1),
        ("ixz", 0, 2),
        ("iyy", 1, 1),
        ("iyz", 1, 2),
        ("izz", 2, 2),
    ] {
        // Writing to a string does not fail.
        let _ = write!(text, " {name}=\"{}\"", moments[i][j]);
    }
    text + "/></inertial>"
}
