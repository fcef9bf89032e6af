//! From a mechanism to its polynomial system.

use super::coaxial::LinearJoint;
use super::displacement::{Displacement, relative, values_at};
use super::element::Element;
use super::error::SystemError;
use super::field::Field;
use super::file_pose::drawn_poses;
use super::joint_form::Writer;
use super::model::{JointModel, circle_field, read_joint};
use super::poly::Poly;
use super::space::{Doubles, Pose};
use super::variables::{Meaning, Names};
use super::{
    CycleEquations, Formulation, Origin, PolynomialSystem, Relaxation, SystemOptions, flatten,
    home, positional,
};
use kutzbach_math::space::Rigid;
use kutzbach_model::graph::ConstraintGraph;
use kutzbach_model::mechanism::{Configuration, JointId, JointKind, LinkId, Mechanism};

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
    /// Every joint's displacement in its variables, by joint; none in the positional form.
    pub(super) displacements: Vec<Displacement>,
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
    let mut displacements = Vec::new();
    let mut joint_variables = vec![Vec::new(); models.len()];
    if options.formulation == Formulation::Positional {
        let setting = Setting {
            mechanism,
            field: &field,
            models: &models,
            unoriented: options.unoriented,
        };
        positional::write(&setting, options, &mut draft);
    } else {
        let writer = Writer {
            mechanism,
            field: &mut field,
            models: &models,
            drawn: drawn.as_deref(),
            draft: &mut draft,
            linear: &mut linear,
            joint_variables: &mut joint_variables,
            displacements: &mut displacements,
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
        displacements,
        ends,
        ground: mechanism.ground().0,
        drawn,
        generators: Vec::new(),
        point: None,
    };
    let mut charts = charts(&draft.names, mechanism);
    if options.formulation != Formulation::Positional {
        charts.extend(unattached(mechanism));
    }
    let mut system = flatten::system(draft, construction, joint_variables, charts);
    system.rounded_numbers = !mechanism.precision().is_exact();
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

/// Links that no joint holds to the ground: the joint forms have no variables for their place.
fn unattached(mechanism: &Mechanism) -> Option<String> {
    let graph = ConstraintGraph::of(mechanism);
    let ground = mechanism.ground().0;
    let loose: Vec<String> = graph
        .components()
        .iter()
        .filter(|component| !component.contains(&ground))
        .map(|component| {
            let links = component
                .iter()
                .map(|&l| mechanism.links()[l].name.as_str());
            format!("`{}`", links.collect::<Vec<_>>().join("` with `"))
        })
        .collect();
    (!loose.is_empty()).then(|| {
        format!(
            "{}: joined to nothing that is joined to the ground; six freedoms each, which are not counted here",
            loose.join(", ")
        )
    })
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
    let ends = &system.construction.ends;
    let meets = |link: LinkId| joints.iter().any(|(j, _)| ends[j.0].contains(&link.0));
    let mut equations: Vec<usize> = Vec::new();
    for (number, equation) in system.equations.iter().enumerate() {
        let belongs = match equation.origin {
            Origin::Cycle { cycle, .. } => cycle == index,
            Origin::Joint { joint } | Origin::Freedom { joint } => in_cycle(joint),
            Origin::Orthonormality { link } => meets(link),
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
