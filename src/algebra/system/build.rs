//! From a mechanism to its polynomial system.

use super::coaxial::{self, LinearJoint, on_one_line};
use super::displacement::{Displacement, relative, values_at};
use super::element::Element;
use super::error::SystemError;
use super::field::Field;
use super::file_pose::drawn_poses;
use super::model::{JointModel, circle_field, read_joint};
use super::poly::Poly;
use super::space::{Doubles, Pose};
use super::variables::{Meaning, Names};
use super::walks::Walker;
use super::{
    CycleEquations, Formulation, Origin, PolynomialSystem, Relaxation, SystemOptions, couplings,
    flatten, home, positional,
};
use crate::closure::Rigid;
use crate::graph::{ConstraintGraph, Cycle, CycleBasis, SpanningTree, fundamental_cycle};
use crate::mechanism::{Configuration, JointId, JointKind, LinkId, Mechanism};

/// What the equations are made of.
pub(super) struct Setting<'a> {
    pub(super) mechanism: &'a Mechanism,
    pub(super) field: &'a Field,
    pub(super) models: &'a [JointModel],
    pub(super) unoriented: bool,
}

/// Variables and equations before they are polynomials over the rationals.
#[derive(Debug, Default)]
pub(super) struct Draft {
    pub(super) names: Names,
    pub(super) equations: Vec<(Poly, Origin)>,
    pub(super) relaxations: Vec<Relaxation>,
    pub(super) cycles: Vec<Vec<(JointId, bool)>>,
}

/// What is kept of the construction: values of variables at other poses are found with it.
#[derive(Clone, Debug)]
pub(super) struct Construction {
    pub(super) field: Field,
    pub(super) models: Vec<JointModel>,
    pub(super) linear: Vec<Option<LinearJoint>>,
    /// Predecessor and successor link of every joint.
    pub(super) ends: Vec<[usize; 2]>,
    pub(super) ground: usize,
    /// Drawn poses of the links, where they are known.
    pub(super) drawn: Option<Vec<Pose<Element>>>,
    /// The generator that every trailing variable of the system stands for.
    pub(super) generators: Vec<usize>,
    /// Values of all variables at home.
    pub(super) point: Option<Vec<Element>>,
}

/// The polynomial system of a mechanism.
///
/// # Errors
/// [`SystemError`] where a number of the geometry is not algebraic (in the forms that are recognised), the field of all
/// numbers has too high a degree, a distance is missing, or the equations would be too long.
pub fn polynomial_system(
    mechanism: &Mechanism,
    options: &SystemOptions,
) -> Result<PolynomialSystem, SystemError> {
    let configuration = configuration(mechanism, options)?;
    let mut field = match circle_field(mechanism, configuration) {
        Ok(field) => field,
        // The configuration alone may be what is in the way.
        Err(_) => circle_field(mechanism, None)?,
    };
    let mut models = mechanism
        .joints()
        .iter()
        .map(|joint| read_joint(&mut field, joint))
        .collect::<Result<Vec<JointModel>, SystemError>>()?;
    let drawn = drawn_poses(&mut field, mechanism, &models, configuration);
    let mut not_drawn = None;
    let drawn = match drawn {
        Ok(drawn) => {
            for (joint, model) in mechanism.joints().iter().zip(&mut models) {
                let [a, b] = [joint.predecessor.link.0, joint.successor.link.0];
                let at = relative(&field, model, &drawn[a], &drawn[b]);
                model.drawn_at(&at, &field);
            }
            Some(drawn)
        }
        Err(error) => {
            not_drawn = Some(error);
            None
        }
    };
    for (index, (joint, model)) in mechanism.joints().iter().zip(&models).enumerate() {
        if model.kind == JointKind::Distance && options.includes(index) {
            let missing = match &model.distance_square {
                None => Some(SystemError::UnknownDistance {
                    joint: joint.name.clone(),
                }),
                Some(square) if square.is_zero() => Some(SystemError::NoDistance {
                    joint: joint.name.clone(),
                }),
                Some(_) => None,
            };
            if let Some(error) = missing {
                return Err(error);
            }
        }
    }
    let mut draft = Draft::default();
    let mut linear = vec![None; models.len()];
    let mut joint_variables = vec![Vec::new(); models.len()];
    if options.formulation == Formulation::Positional {
        let setting = Setting {
            mechanism,
            field: &field,
            models: &models,
            unoriented: options.unoriented,
        };
        positional::write(&setting, &mut draft);
    } else {
        let writer = Writer {
            mechanism,
            field: &mut field,
            models: &models,
            drawn: drawn.as_deref(),
            draft: &mut draft,
            linear: &mut linear,
            joint_variables: &mut joint_variables,
        };
        writer.write(options)?;
    }
    let ends = mechanism
        .joints()
        .iter()
        .map(|joint| [joint.predecessor.link.0, joint.successor.link.0])
        .collect();
    let construction = Construction {
        field,
        models,
        linear,
        ends,
        ground: mechanism.ground().0,
        drawn,
        generators: Vec::new(),
        point: None,
    };
    let charts = charts(&draft.names, mechanism);
    let mut system = flatten::system(draft, construction, joint_variables, charts);
    system.home = home::drawn_point(&mut system, not_drawn);
    Ok(system)
}

fn configuration<'a>(
    mechanism: &'a Mechanism,
    options: &SystemOptions,
) -> Result<Option<&'a Configuration>, SystemError> {
    let Some(name) = &options.configuration else {
        return Ok(None);
    };
    match mechanism.configuration(name) {
        Some(configuration) => Ok(Some(configuration)),
        None => {
            let names: Vec<String> = mechanism
                .configurations()
                .iter()
                .map(|c| format!("`{}`", c.name))
                .collect();
            Err(SystemError::UnknownConfiguration {
                name: name.clone(),
                known: if names.is_empty() {
                    "the mechanism has none".to_owned()
                } else {
                    format!("there are {}", names.join(", "))
                },
            })
        }
    }
}

fn charts(names: &Names, mechanism: &Mechanism) -> Vec<String> {
    let mut charts = Vec::new();
    for variable in &names.variables {
        match &variable.meaning {
            Meaning::Quaternion {
                joint,
                component: 0,
            } => {
                let name = &mechanism.joint(*joint).name;
                charts.push(format!(
                    "{name}.q0 .. {name}.q3: the unit quaternion of `{name}`'s turn from the drawn pose; q and -q are the same pose, so that every pose counts twice"
                ));
            }
            Meaning::Sine { axis_square, .. } if variable.name.starts_with("s(") => {
                charts.push(format!(
                    "{}: the sine divided by the length of the axis as written, the square root of {}",
                    variable.name,
                    axis_square.value()
                ));
            }
            Meaning::Translation { unit_square, .. } if variable.name.starts_with("t(") => {
                charts.push(format!(
                    "{}: counted in the length of the direction as written, the square root of {} m",
                    variable.name,
                    unit_square.value()
                ));
            }
            _ => {}
        }
    }
    charts
}

/// Writes the equations in joint variables.
struct Writer<'a> {
    mechanism: &'a Mechanism,
    field: &'a mut Field,
    models: &'a [JointModel],
    drawn: Option<&'a [Pose<Element>]>,
    draft: &'a mut Draft,
    linear: &'a mut Vec<Option<LinearJoint>>,
    joint_variables: &'a mut Vec<Vec<usize>>,
}

impl Writer<'_> {
    fn write(mut self, options: &SystemOptions) -> Result<(), SystemError> {
        let graph = ConstraintGraph::of(self.mechanism);
        let tree = SpanningTree::low_depth(&graph);
        let mut cycles: Vec<Cycle> = match options.formulation {
            Formulation::Tree => lightest_tree_cycles(&graph, &tree, self.mechanism),
            _ if options.shortest_cycles => CycleBasis::minimum(&graph, &tree).cycles,
            _ => tree
                .chords()
                .iter()
                .filter_map(|&chord| fundamental_cycle(&graph, &tree, chord))
                .collect(),
        };
        cycles.retain(|c| c.edges.iter().all(|(edge, _)| options.includes(*edge)));
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

/// The fundamental cycles of the spanning tree whose joints have the fewest variables; where that leaves a choice, of one
/// that has as much of the low-depth tree as possible (Kruskal 1956).
fn lightest_tree_cycles(
    graph: &ConstraintGraph,
    low_depth: &SpanningTree,
    mechanism: &Mechanism,
) -> Vec<Cycle> {
    let coupled: Vec<usize> = mechanism
        .couplings()
        .iter()
        .flat_map(|c| &c.terms)
        .map(|term| term.joint.0)
        .collect();
    let mut order: Vec<usize> = graph.edges_by_name().to_vec();
    order.sort_by_key(|&edge| {
        let kind = mechanism.joints()[edge].kind;
        // A coupled joint needs its variables.
        let weight = match coupled.contains(&edge) {
            true => 0,
            false => variable_count(kind),
        };
        (weight, !low_depth.contains(edge))
    });
    let mut piece: Vec<usize> = (0..graph.node_count()).collect();
    let mut kept = vec![false; graph.edge_count()];
    for &edge in &order {
        let [a, b] = graph.edge(edge).ends.map(|end| piece[end]);
        if a != b {
            kept[edge] = true;
            piece.iter_mut().filter(|p| **p == b).for_each(|p| *p = a);
        }
    }
    let specs = |keep: bool| {
        graph
            .edges_by_name()
            .iter()
            .copied()
            .filter(move |&edge| kept[edge] == keep)
    };
    cycles_of_tree(graph, specs.clone()(true).collect(), specs(false).collect())
}

fn variable_count(kind: JointKind) -> usize {
    match kind {
        JointKind::Fixed => 0,
        JointKind::Prismatic => 1,
        JointKind::Revolute | JointKind::PlanarTranslation => 2,
        JointKind::Screw | JointKind::Cylindrical | JointKind::Translational => 3,
        JointKind::Universal | JointKind::Planar | JointKind::Spherical => 4,
        JointKind::TranslatingScrew | JointKind::Schoenflies | JointKind::PointOnLine => 5,
        JointKind::LineOnPlane | JointKind::PointOnPlane => 6,
        JointKind::Distance => 7,
    }
}

/// One cycle per chord: the chord and the way through the tree.
fn cycles_of_tree(graph: &ConstraintGraph, tree: Vec<usize>, chords: Vec<usize>) -> Vec<Cycle> {
    let mut incident = vec![Vec::new(); graph.node_count()];
    for edge in tree {
        let [a, b] = graph.edge(edge).ends;
        incident[a].push((edge, b));
        incident[b].push((edge, a));
    }
    chords
        .into_iter()
        .filter_map(|chord| {
            let [from, to] = graph.edge(chord).ends;
            // Breadth first from one end to the other.
            let mut came = vec![None; graph.node_count()];
            let mut queue = std::collections::VecDeque::from([from]);
            while let Some(node) = queue.pop_front() {
                for &(edge, next) in &incident[node] {
                    if next != from && came[next].is_none() {
                        came[next] = Some((edge, node));
                        queue.push_back(next);
                    }
                }
            }
            let mut walk = vec![chord];
            let mut at = to;
            while at != from {
                let (edge, node) = came[at]?;
                walk.push(edge);
                at = node;
            }
            Cycle::from_walk(graph, &walk)
        })
        .collect()
}

/// For every cycle the joint that gets no variables: in the tree form the one that only this cycle passes and that saves
/// most, otherwise a distance joint that only this cycle passes.
fn implicit_joints(
    mechanism: &Mechanism,
    cycles: &[Cycle],
    formulation: Formulation,
) -> Vec<Option<usize>> {
    let mut passed = vec![0; mechanism.joints().len()];
    for (edge, _) in cycles.iter().flat_map(|c| &c.edges) {
        passed[*edge] += 1;
    }
    let coupled: Vec<usize> = mechanism
        .couplings()
        .iter()
        .flat_map(|c| &c.terms)
        .map(|term| term.joint.0)
        .collect();
    cycles
        .iter()
        .map(|cycle| {
            let own = cycle.edges.iter().map(|(edge, _)| *edge);
            let own = own.filter(|&edge| passed[edge] == 1 && !coupled.contains(&edge));
            let kind = |edge: usize| mechanism.joints()[edge].kind;
            match formulation {
                Formulation::Tree => own.max_by_key(|&edge| {
                    let name = std::cmp::Reverse(&mechanism.joints()[edge].name);
                    (variable_count(kind(edge)), name)
                }),
                _ => own
                    .filter(|&edge| kind(edge) == JointKind::Distance)
                    .min_by_key(|&edge| &mechanism.joints()[edge].name),
            }
        })
        .collect()
}

impl PolynomialSystem {
    /// The values of all variables where the links stand at given poses (`world_from_link`, in doubles, by link): what
    /// the mechanism's joints and links do there. Joint values that a pose does not tell apart are chosen.
    #[must_use]
    pub fn point_at(&self, links: &[Rigid<f64>]) -> Vec<f64> {
        let construction = &self.construction;
        let doubles = Doubles(&construction.field);
        let poses: Vec<Pose<f64>> = links
            .iter()
            .map(|rigid| Pose {
                rotation: rigid.rotation,
                translation: rigid.translation,
            })
            .collect();
        let mut point = vec![f64::NAN; self.variables.len()];
        for (joint, variables) in self.joint_variables.iter().enumerate() {
            if variables.is_empty() {
                continue;
            }
            let [a, b] = construction.ends[joint];
            let model = &construction.models[joint];
            let at = relative(&doubles, model, &poses[a], &poses[b]);
            let values = match (&construction.linear[joint], &construction.drawn) {
                (Some(linear), Some(drawn)) => {
                    let home = relative(&construction.field, model, &drawn[a], &drawn[b]);
                    linear.values_at(&construction.field, model, &home, &at)
                }
                _ => values_at(&doubles, &construction.field, model, &at).unwrap_or_default(),
            };
            for (&variable, value) in variables.iter().zip(values) {
                point[variable] = value;
            }
        }
        let ground = poses[construction.ground].inverse(&doubles);
        for (index, variable) in self.variables.iter().enumerate() {
            let body = |link: LinkId| ground.then(&doubles, &poses[link.0]);
            match &variable.meaning {
                Meaning::BodyRotation { link, row, column } => {
                    point[index] = body(*link).rotation[*row][*column];
                }
                Meaning::BodyTranslation { link, row } => {
                    point[index] = body(*link).translation[*row];
                }
                Meaning::Algebraic { value } | Meaning::Parameter { value } => {
                    point[index] = value.value();
                }
                _ => {}
            }
        }
        point
    }
}

/// Indices of equations and variables of one cycle, from what each equation mentions.
pub(super) fn cycle_equations(
    joints: Vec<(JointId, bool)>,
    index: usize,
    system: &PolynomialSystem,
) -> CycleEquations {
    let in_cycle = |joint: JointId| joints.iter().any(|(j, _)| *j == joint);
    let mut equations: Vec<usize> = Vec::new();
    for (number, equation) in system.equations.iter().enumerate() {
        let belongs = match equation.origin {
            Origin::Cycle { cycle, .. } => cycle == index,
            Origin::Joint { joint } | Origin::Freedom { joint } => in_cycle(joint),
            _ => false,
        };
        if belongs {
            equations.push(number);
        }
    }
    let mentioned = |equations: &[usize]| -> Vec<usize> {
        (0..system.variables.len())
            .filter(|&v| {
                equations
                    .iter()
                    .any(|&e| system.equations[e].polynomial.mentions(v))
            })
            .collect()
    };
    // Minimal polynomials may need those of other numbers.
    loop {
        let variables = mentioned(&equations);
        let needed: Vec<usize> = system
            .equations
            .iter()
            .enumerate()
            .filter(|(number, equation)| {
                let about = match equation.origin {
                    Origin::MinimalPolynomial { variable } | Origin::Parameter { variable } => {
                        variables.contains(&variable)
                    }
                    _ => false,
                };
                about && !equations.contains(number)
            })
            .map(|(number, _)| number)
            .collect();
        if needed.is_empty() {
            return CycleEquations {
                joints,
                equations,
                variables,
            };
        }
        equations.extend(needed);
    }
}
