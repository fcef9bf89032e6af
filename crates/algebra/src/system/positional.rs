//! Absolute coordinates: the twelve entries of every link's matrix relative to the ground.

use super::build::{Draft, Setting};
use super::implicit::Implicit;
use super::poly::Poly;
use super::space::{Polynomials, Pose, Scalars};
use super::spanning::basic_cycles;
use super::variables::Meaning;
use super::{Origin, Relaxation, SystemOptions};
use kutzbach_model::graph::Cycle;
use kutzbach_model::mechanism::{JointId, LinkId};

/// The eight equations of a rotation matrix (Ruiz 1994, (3.5)): three columns of length one, two pairs perpendicular,
/// third column = first × second. The first column and the second are orthonormal by these, so the third is their product
/// and the determinant is one.
fn orthonormality(setting: &Setting<'_>, pose: &Pose<Poly>) -> Vec<Poly> {
    let ring = Polynomials(setting.field);
    let column = |j: usize| [0, 1, 2].map(|i| pose.rotation[i][j].clone());
    let columns = [column(0), column(1), column(2)];
    let product = |a: usize, b: usize| super::space::dot(&ring, &columns[a], &columns[b]);
    let mut equations: Vec<Poly> = (0..3)
        .map(|j| ring.minus(&product(j, j), &ring.integer(1)))
        .collect();
    equations.extend([product(1, 2), product(0, 1)]);
    let third = super::space::cross(&ring, &columns[0], &columns[1]);
    equations.extend((0..3).map(|i| ring.minus(&columns[2][i], &third[i])));
    equations
}

/// Adds variables of all moving links and the equations of all joints.
pub(super) fn write(setting: &Setting<'_>, options: &SystemOptions, draft: &mut Draft) {
    let ring = Polynomials(setting.field);
    let mechanism = setting.mechanism;
    let mut poses: Vec<Pose<Poly>> = Vec::with_capacity(mechanism.links().len());
    let mut own = Vec::new();
    for (index, link) in mechanism.links().iter().enumerate() {
        let id = LinkId(index);
        if id == mechanism.ground() {
            poses.push(Pose::identity(&ring));
            continue;
        }
        let name = &link.name;
        let rotation = [0, 1, 2].map(|row| {
            [0, 1, 2].map(|column| {
                let meaning = Meaning::BodyRotation {
                    link: id,
                    row,
                    column,
                };
                let name = format!("x{}{}({name})", row + 1, column + 1);
                Poly::variable(draft.names.add(name, meaning))
            })
        });
        let translation = [0, 1, 2].map(|row| {
            let meaning = Meaning::BodyTranslation { link: id, row };
            let name = format!("T{}({name})", ["x", "y", "z"][row]);
            Poly::variable(draft.names.add(name, meaning))
        });
        let pose = Pose {
            rotation,
            translation,
        };
        let equations = orthonormality(setting, &pose);
        own.extend(
            equations
                .into_iter()
                .map(|p| (p, Origin::Orthonormality { link: id })),
        );
        poses.push(pose);
    }
    draft.equations.extend(own);
    for (index, joint) in mechanism.joints().iter().enumerate() {
        let id = JointId(index);
        if joint.kind.uses_lead() {
            draft.relaxations.push(Relaxation::Screw {
                joint: id,
                name: joint.name.clone(),
            });
        }
        let equations = Implicit {
            field: setting.field,
            model: &setting.models[index],
            predecessor: &poses[joint.predecessor.link.0],
            successor: &poses[joint.successor.link.0],
            unoriented: setting.unoriented,
        }
        .equations();
        draft.equations.extend(
            equations
                .into_iter()
                .map(|p| (p, Origin::Joint { joint: id })),
        );
    }
    let (_, cycles) = basic_cycles(mechanism, options);
    let joints = |cycle: &Cycle| {
        let joints = cycle.edges.iter().map(|&(edge, f)| (JointId(edge), f));
        joints.collect()
    };
    draft.cycles = cycles.iter().map(joints).collect();
    for (index, coupling) in mechanism.couplings().iter().enumerate() {
        draft.relaxations.push(Relaxation::Coupling {
            coupling: index,
            name: coupling.name.clone(),
            reason: "the positional form has no joint variables".to_owned(),
        });
    }
}
