//! Screws on one line: the one case in which a screw's equations are algebraic, because they are linear.
//!
//! Where all joints of a block turn about or slide along one common line, displacements commute. In unwound angles,
//! counted in turns from the drawn pose, a cycle closes if the turns around it add up to zero and so do the ways, a screw
//! going `lead` per turn. (Sums of turns that are other whole numbers give parallel copies of the same set.)

use super::element::Element;
use super::field::Field;
use super::model::JointModel;
use super::poly::Poly;
use super::space::{Doubles, Pose, Vector, apply, cross, dot, identity, subtract};
use super::variables::{Meaning, Names};
use super::walks::Path;
use kutzbach_model::mechanism::{Coupling, JointId, JointKind, Mechanism};

/// A joint on the common line.
#[derive(Clone, Debug)]
pub(super) struct LinearJoint {
    /// Turns, and metres of free travel.
    pub(super) turns: Option<usize>,
    pub(super) way: Option<usize>,
    /// Metres per turn.
    lead: Element,
    /// Whether its axis points along the line.
    along: bool,
}

/// The joints of a block on one line, in the order given; `None` where they are not, or not exactly.
pub(super) fn on_one_line(
    field: &Field,
    mechanism: &Mechanism,
    models: &[JointModel],
    drawn: &[Pose<Element>],
    block: &[usize],
) -> Option<Vec<bool>> {
    let mut line: Option<(Vector<Element>, Vector<Element>)> = None;
    let mut along = vec![true; block.len()];
    // Hinges and screws first: a slide stands anywhere and says nothing of where the line is.
    let mut order: Vec<usize> = (0..block.len()).collect();
    order.sort_by_key(|&place| models[block[place]].kind == JointKind::Prismatic);
    for place in order {
        let index = block[place];
        let joint = &mechanism.joints()[index];
        let model = &models[index];
        let predecessor = &drawn[joint.predecessor.link.0];
        let successor = &drawn[joint.successor.link.0];
        let relative = super::displacement::relative(field, model, predecessor, successor);
        if model.kind == JointKind::Fixed {
            if !is_identity(field, &relative) {
                return None;
            }
            continue;
        }
        let axis = model.axis.as_ref()?;
        let allowed = match model.kind {
            // A tree joint stands where its value puts it; a closing one could be at any turn but this.
            JointKind::Screw => {
                model.lead.is_some() && (!joint.closes_loop || is_identity(field, &relative))
            }
            JointKind::Revolute => relative.translation.iter().all(Element::is_zero),
            JointKind::Prismatic => relative.rotation == identity(field),
            JointKind::Cylindrical => true,
            _ => false,
        };
        let turned = apply(field, &relative.rotation, &axis.direction);
        let off = cross(field, &axis.direction, &relative.translation);
        if !allowed || turned != axis.direction || !off.iter().all(Element::is_zero) {
            return None;
        }
        let frame = predecessor.then(field, &model.sides[0]);
        let direction = apply(field, &frame.rotation, &axis.direction);
        let (first_point, first_direction) =
            line.get_or_insert_with(|| (frame.translation.clone(), direction.clone()));
        let skew = cross(field, first_direction, &direction);
        let apart = subtract(field, &frame.translation, first_point);
        let beside = cross(field, first_direction, &apart);
        let slides = model.kind == JointKind::Prismatic;
        if !skew.iter().all(Element::is_zero) || !(slides || beside.iter().all(Element::is_zero)) {
            return None;
        }
        along[place] = field.approximate(&dot(field, first_direction, &direction)) > 0.0;
    }
    Some(along)
}

fn is_identity(field: &Field, pose: &Pose<Element>) -> bool {
    pose.rotation == identity(field) && pose.translation.iter().all(Element::is_zero)
}

impl LinearJoint {
    /// A joint's variables in the linear form.
    pub(super) fn new(
        names: &mut Names,
        name: &str,
        id: JointId,
        model: &JointModel,
        along: bool,
    ) -> Self {
        let mut result = Self {
            turns: None,
            way: None,
            lead: Element::zero(),
            along,
        };
        if matches!(
            model.kind,
            JointKind::Screw | JointKind::Revolute | JointKind::Cylindrical
        ) {
            result.turns = Some(names.add(format!("turns({name})"), Meaning::Turns { joint: id }));
        }
        if matches!(model.kind, JointKind::Prismatic | JointKind::Cylindrical) {
            let way = format!("way({name})");
            result.way = Some(names.add(way, Meaning::Way { joint: id }));
        }
        if let (JointKind::Screw, Some(lead)) = (model.kind, &model.lead) {
            result.lead = lead.clone();
        }
        result
    }

    /// The joint's variables.
    pub(super) fn variables(&self) -> Vec<usize> {
        self.turns.into_iter().chain(self.way).collect()
    }
}

/// The two equations of a cycle: its turns, its ways.
pub(super) fn closure(field: &Field, cycle: &Path, joints: &[Option<LinearJoint>]) -> Vec<Poly> {
    let mut turns = Poly::default();
    let mut ways = Poly::default();
    for (joint, forward) in cycle {
        let Some(joint) = &joints[*joint] else {
            continue;
        };
        // Turning about a reversed axis and travelling along it both count negative; a lead does not change.
        let sign = Element::integer(if *forward == joint.along { 1 } else { -1 });
        let signed = |variable: usize| Poly::variable(variable).scaled(&sign, field);
        if let Some(turn) = joint.turns.map(signed) {
            ways = ways.plus(&turn.scaled(&joint.lead, field));
            turns = turns.plus(&turn);
        }
        if let Some(way) = joint.way.map(signed) {
            ways = ways.plus(&way);
        }
    }
    vec![turns, ways]
}

/// A coupling in the linear variables. It has to hold at the drawn pose, from which they count; that is known where all
/// its joints are drawn at zero.
pub(super) fn coupling(
    field: &mut Field,
    mechanism: &Mechanism,
    models: &[JointModel],
    drawn: Option<&[Pose<Element>]>,
    coupling: &Coupling,
    joints: &[Option<LinearJoint>],
) -> Result<Vec<Poly>, String> {
    let zero = coupling.offset.rational().is_some_and(|x| x.is_zero())
        && drawn.is_some_and(|drawn| {
            coupling.terms.iter().all(|term| {
                let joint = mechanism.joint(term.joint);
                let [a, b] = [joint.predecessor.link.0, joint.successor.link.0];
                let model = &models[term.joint.0];
                let at = super::displacement::relative(field, model, &drawn[a], &drawn[b]);
                is_identity(field, &at)
            })
        });
    if !zero {
        return Err("it ties screws that are not drawn at zero".to_owned());
    }
    let mut sum = Poly::default();
    let mut kinds = [0, 0];
    for term in &coupling.terms {
        let Some(joint) = &joints[term.joint.0] else {
            return Err("it ties screws on one line to joints elsewhere".to_owned());
        };
        let factor = field
            .read(&term.factor)
            .map_err(|_| format!("its ratio {} is not algebraic", term.factor.source()))?;
        let variable = match (joint.turns, joint.way) {
            (Some(turns), None) => {
                kinds[0] += 1;
                turns
            }
            (None, Some(way)) => {
                kinds[1] += 1;
                way
            }
            _ => return Err("a joint of it has no single variable".to_owned()),
        };
        sum = sum.plus(&Poly::variable(variable).scaled(&factor, field));
    }
    if kinds[0] > 0 && kinds[1] > 0 {
        return Err("it ties an angle to a length, which is no algebraic relation".to_owned());
    }
    Ok(vec![sum])
}

impl LinearJoint {
    /// Turns and ways from the drawn pose, in doubles; turns between −1/2 and 1/2.
    pub(super) fn values_at(
        &self,
        field: &Field,
        model: &JointModel,
        drawn: &Pose<Element>,
        at: &Pose<f64>,
    ) -> Vec<f64> {
        let Some(axis) = &model.axis else {
            return Vec::new();
        };
        let doubles = Doubles(field);
        let u = super::space::vector(&doubles, &axis.direction);
        let length = (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]).sqrt();
        let u = u.map(|x| x / length);
        let drawn = super::space::pose(&doubles, drawn);
        let r = super::space::multiply(
            &doubles,
            &super::space::transpose(&drawn.rotation),
            &at.rotation,
        );
        let sine =
            (u[0] * (r[2][1] - r[1][2]) + u[1] * (r[0][2] - r[2][0]) + u[2] * (r[1][0] - r[0][1]))
                / 2.0;
        let cosine = (r[0][0] + r[1][1] + r[2][2] - 1.0) / 2.0;
        let turns = sine.atan2(cosine) / std::f64::consts::TAU;
        let moved = subtract(&doubles, &at.translation, &drawn.translation);
        let way = dot(&doubles, &u, &moved);
        // A screw's turns are told by its way, which goes on.
        let lead = field.approximate(&self.lead);
        let turns = if lead != 0.0 { way / lead } else { turns };
        let turns = self.turns.map(|_| turns);
        turns.into_iter().chain(self.way.map(|_| way)).collect()
    }
}
