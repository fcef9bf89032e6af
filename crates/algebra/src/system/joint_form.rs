//! The equations in joint variables: the canonical form and the tree form.

use super::build::Draft;
use super::coaxial::{self, LinearJoint, on_one_line};
use super::displacement::Displacement;
use super::element::Element;
use super::error::SystemError;
use super::field::Field;
use super::model::JointModel;
use super::space::Pose;
use super::spanning::{basic_cycles, implicit_joints};
use super::walks::{MAX_PRODUCTS, Walker};
use super::{Origin, Relaxation, SystemOptions, couplings};
use kutzbach_model::graph::{ConstraintGraph, Cycle};
use kutzbach_model::mechanism::{JointId, JointKind, Mechanism};

/// Writes the equations in joint variables.
pub(super) struct Writer<'a> {
    pub(super) mechanism: &'a Mechanism,
    pub(super) field: &'a mut Field,
    pub(super) models: &'a [JointModel],
    pub(super) drawn: Option<&'a [Pose<Element>]>,
    pub(super) draft: &'a mut Draft,
    pub(super) linear: &'a mut Vec<Option<LinearJoint>>,
    pub(super) joint_variables: &'a mut Vec<Vec<usize>>,
    /// Every joint's displacement in its variables, by joint, for the poses of links.
    pub(super) displacements: &'a mut Vec<Displacement>,
}

impl Writer<'_> {
    pub(super) fn write(mut self, options: &SystemOptions) -> Result<(), SystemError> {
        let (graph, cycles) = basic_cycles(self.mechanism, options);
        let implicit = implicit_joints(self.mechanism, &cycles, options.formulation);
        self.linear_blocks(&graph, options);
        let mut displacements = Vec::with_capacity(self.models.len());
        let joints = self.mechanism.joints().iter().enumerate();
        for ((index, joint), model) in joints.zip(self.models) {
            let id = JointId(index);
            let without = !options.includes(index) || implicit.contains(&Some(index));
            let displacement = if self.linear[index].is_some() || without {
                Displacement::none()
            } else {
                Displacement::new(self.field, &mut self.draft.names, joint, id, model)
            };
            let own = displacement.own.iter().cloned();
            self.draft
                .equations
                .extend(own.map(|p| (p, Origin::Freedom { joint: id })));
            self.joint_variables[index] = match &self.linear[index] {
                Some(linear) => linear.variables(),
                None => displacement.variables.clone(),
            };
            if joint.kind.uses_lead() && self.linear[index].is_none() && options.includes(index) {
                self.draft.relaxations.push(Relaxation::Screw {
                    joint: id,
                    name: joint.name.clone(),
                });
            }
            displacements.push(displacement);
        }
        let walker = Walker {
            field: self.field,
            models: self.models,
            displacements: &displacements,
            unoriented: options.unoriented,
            most_products: options.most_products.unwrap_or(MAX_PRODUCTS),
        };
        for (index, cycle) in cycles.iter().enumerate() {
            let joints = cycle.edges.iter().map(|&(edge, f)| (JointId(edge), f));
            self.draft.cycles.push(joints.collect());
            if cycle
                .edges
                .iter()
                .any(|(edge, _)| self.linear[*edge].is_some())
            {
                for (row, equation) in coaxial::closure(self.field, &cycle.edges, self.linear)
                    .into_iter()
                    .enumerate()
                {
                    let origin = Origin::Cycle {
                        cycle: index,
                        row,
                        column: 3,
                    };
                    self.draft.equations.push((equation, origin));
                }
                continue;
            }
            let place = implicit[index]
                .and_then(|joint| cycle.edges.iter().position(|(edge, _)| *edge == joint));
            let named = |error| name_cycle(error, self.mechanism, cycle);
            if let Some(place) = place {
                let joint = JointId(cycle.edges[place].0);
                let equations = walker.implicit(&cycle.edges, place).map_err(named)?;
                self.draft
                    .equations
                    .extend(equations.into_iter().map(|p| (p, Origin::Joint { joint })));
            } else {
                let entries = walker.closure(&cycle.edges).map_err(named)?;
                for (entry, polynomial) in entries.into_iter().enumerate() {
                    let origin = Origin::Cycle {
                        cycle: index,
                        row: entry / 4,
                        column: entry % 4,
                    };
                    self.draft.equations.push((polynomial, origin));
                }
            }
        }
        *self.displacements = displacements.clone();
        self.couplings(&displacements, options);
        Ok(())
    }

    /// Blocks with a screw whose joints are all on one line get their linear variables.
    fn linear_blocks(&mut self, graph: &ConstraintGraph, options: &SystemOptions) {
        let Some(drawn) = self.drawn else { return };
        for block in graph.coupled_blocks() {
            let screws = |&joint: &usize| self.models[joint].kind == JointKind::Screw;
            let included = block.edges.iter().all(|&joint| options.includes(joint));
            if !included || !block.edges.iter().any(screws) {
                continue;
            }
            // A pose known exactly at home only: couplings have to hold there.
            let along = on_one_line(self.field, self.mechanism, self.models, drawn, &block.edges);
            let Some(along) = along else { continue };
            let mut joints: Vec<(usize, bool)> = block.edges.iter().copied().zip(along).collect();
            joints.sort_unstable();
            for (joint, along) in joints {
                self.linear[joint] = Some(LinearJoint::new(
                    &mut self.draft.names,
                    &self.mechanism.joints()[joint].name,
                    JointId(joint),
                    &self.models[joint],
                    along,
                ));
            }
        }
    }

    fn couplings(self, displacements: &[Displacement], options: &SystemOptions) {
        for (index, coupling) in self.mechanism.couplings().iter().enumerate() {
            let included = |joint: JointId| options.includes(joint.0);
            if !coupling.terms.iter().all(|term| included(term.joint)) {
                continue;
            }
            let linear = coupling
                .terms
                .iter()
                .any(|term| self.linear[term.joint.0].is_some());
            let equations = if linear {
                coaxial::coupling(
                    self.field,
                    self.mechanism,
                    self.models,
                    self.drawn,
                    coupling,
                    self.linear,
                )
            } else {
                couplings::equations(self.field, self.mechanism, coupling, displacements)
            };
            match equations {
                Ok(equations) => self.draft.equations.extend(
                    equations
                        .into_iter()
                        .map(|p| (p, Origin::Coupling { coupling: index })),
                ),
                Err(reason) => self.draft.relaxations.push(Relaxation::Coupling {
                    coupling: index,
                    name: coupling.name.clone(),
                    reason,
                }),
            }
        }
    }
}

fn name_cycle(error: SystemError, mechanism: &Mechanism, cycle: &Cycle) -> SystemError {
    match error {
        SystemError::TooLarge { limit, .. } => {
            let names: Vec<String> = cycle
                .edges
                .iter()
                .map(|(edge, _)| mechanism.joints()[*edge].name.clone())
                .collect();
            SystemError::TooLarge {
                what: format!("the cycle of {} joints {}", names.len(), names.join(", ")),
                limit,
            }
        }
        other => other,
    }
}
