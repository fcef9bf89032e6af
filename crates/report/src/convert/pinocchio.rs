//! A Python program that makes Pinocchio's models: of the open tree, from URDF inside the program, and of what closes its loops.
//!
//! Pinocchio closes loops by points that coincide (three rows) or frames that do (six rows). A ball is such a point, a fixed joint such a
//! frame; a hinge is two points of its axis, which are six rows of rank five, since there is no model of five rows. Other kinds have no
//! model of their own: a link hangs at the predecessor by the freedoms of the joint, as part of the tree, and its frame coincides with
//! the successor's. Couplings, of any number of joints, and the leads of screws are rows over the joint velocities.

use super::Converted;
use super::gaps::{gap, is_spoken_of, lever, tolerance};
use super::place::{is_identity, rounded, settled, values};
use super::urdf::{Chain, Reader, Tree, written};
use kutzbach_closure::{Arithmetic, Geometry, Rigid};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{
    Coupling, Joint, JointId, JointKind, LinkId, Mechanism, MechanismError,
};
use std::collections::BTreeMap;

/// A point that coincides with another, or a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Contact {
    Point,
    Frame,
}

impl Contact {
    fn word(self) -> &'static str {
        match self {
            Self::Point => "CONTACT_3D",
            Self::Frame => "CONTACT_6D",
        }
    }
}

/// A constraint model: the frames of two links that coincide.
struct Closure {
    name: String,
    contact: Contact,
    sides: [(String, Rigid<f64>); 2],
}

/// `Σ factor · variable = offset` (rad, m).
struct Row {
    name: String,
    terms: Vec<(String, Number)>,
    offset: Number,
}

struct Pinocchio<'a> {
    tree: Tree<'a>,
    /// Largest coordinate of a joint's frame in a link (m).
    size: f64,
    closures: Vec<Closure>,
    rows: Vec<Row>,
    /// The value that joints have where the variables of the tree are zero (rad, m).
    drawn: BTreeMap<JointId, f64>,
}

/// A mechanism as a Python program with `build()`, which returns Pinocchio's model of the open tree and the list of constraint models
/// that close its loops.
///
/// # Errors
/// Where the tree that comes of it is no mechanism, which would be a fault of this program.
pub fn to_pinocchio(mechanism: &Mechanism) -> Result<Converted, MechanismError> {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let mut made = Pinocchio {
        tree: Tree::new(mechanism, &geometry, Reader::Pinocchio),
        size: geometry.size_of(0..mechanism.joints().len()),
        closures: Vec::new(),
        rows: Vec::new(),
        drawn: BTreeMap::new(),
    };
    let closing = mechanism.joints().iter().enumerate();
    for (index, joint) in closing.filter(|(_, joint)| joint.closes_loop) {
        made.close(JointId(index), joint);
    }
    made.threads();
    made.couplings();
    for id in mechanism.actuated() {
        let name = &mechanism.joint(*id).name;
        made.tree.not_said.push(format!("the motor of `{name}`"));
    }
    made.tree.beside();
    let Pinocchio {
        tree,
        closures,
        rows,
        ..
    } = made;
    let Tree {
        builder, not_said, ..
    } = tree;
    let text = program(mechanism.name(), &written(builder)?, &closures, &rows);
    Ok(Converted { text, not_said })
}

impl Pinocchio<'_> {
    fn close(&mut self, id: JointId, joint: &Joint) {
        let (mechanism, geometry) = (self.tree.mechanism, self.tree.geometry);
        let fitted = geometry.displacements[id.0].displacement(&geometry.states[id.0]);
        let open = gap(mechanism, geometry, id, &fitted);
        let is_open = open > tolerance(geometry, self.size);
        if is_open {
            self.tree.not_said.push(format!(
                "loop `{}` is open as drawn, by {open:.3e} m or rad, and so it is at the neutral configuration",
                joint.name
            ));
        }
        let [predecessor, successor] = geometry.sides[id.0].clone();
        let sides = [joint.predecessor.link, joint.successor.link].map(|link| self.name_of(link));
        let carried = is_spoken_of(mechanism, id);
        match joint.kind {
            JointKind::Fixed => {
                let places = [predecessor, successor];
                self.coincide(&joint.name, Contact::Frame, sides, places);
            }
            JointKind::Spherical if !carried => {
                let places = [predecessor, successor];
                self.coincide(&joint.name, Contact::Point, sides, places);
            }
            JointKind::Revolute if !carried => {
                let axis = values(&joint.axis.0);
                let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
                let lever = lever(self.size, length).value();
                let along = Rigid::translation(axis.map(|x| x * lever));
                let ends = [predecessor.compose(&along), successor.compose(&along)];
                let second = format!("{}.2", joint.name);
                let places = [predecessor, successor];
                self.coincide(&joint.name, Contact::Point, sides.clone(), places);
                self.coincide(&second, Contact::Point, sides, ends);
            }
            _ => self.carry(id, joint, fitted, is_open),
        }
    }

    fn name_of(&self, link: LinkId) -> String {
        self.tree.mechanism.link(link).name.clone()
    }

    fn coincide(
        &mut self,
        name: &str,
        contact: Contact,
        [first, second]: [String; 2],
        [one, other]: [Rigid<f64>; 2],
    ) {
        self.closures.push(Closure {
            name: name.to_owned(),
            contact,
            sides: [(first, one), (second, other)],
        });
    }

    /// A link at the predecessor that has the freedoms of the joint, and whose frame coincides with that of the successor.
    fn carry(&mut self, id: JointId, joint: &Joint, fitted: Rigid<f64>, is_open: bool) {
        let geometry = self.tree.geometry;
        let displacement = &geometry.displacements[id.0];
        let standing = match is_open {
            // Where all its variables are zero.
            true => displacement.displacement(&displacement.home()),
            false => fitted,
        };
        let value = match (is_open, joint.freedom()) {
            (false, 1) => geometry.states[id.0].values.first().copied(),
            _ => None,
        };
        let value = value.map_or(0.0, settled);
        self.drawn.insert(id, value);
        let carrier = self.tree.between(&format!("{}_carrier", joint.name));
        let predecessor = self.name_of(joint.predecessor.link);
        self.tree.chain(&Chain {
            id,
            ends: [predecessor, carrier.clone()],
            standing: (!is_identity(&standing)).then_some(standing),
            end: Rigid::identity(&1.0),
            value,
        });
        let [_, successor] = &geometry.sides[id.0];
        let places = [Rigid::identity(&1.0), successor.clone()];
        let links = [carrier, self.name_of(joint.successor.link)];
        self.coincide(&joint.name, Contact::Frame, links, places);
    }

    /// The leads of screws.
    fn threads(&mut self) {
        for (slide, turn, pitch) in std::mem::take(&mut self.tree.threads) {
            self.rows.push(Row {
                name: format!("{turn}.lead"),
                terms: vec![(slide, Number::one()), (turn, -&pitch)],
                offset: Number::zero(),
            });
        }
    }

    fn couplings(&mut self) {
        let mechanism = self.tree.mechanism;
        for coupling in mechanism.couplings() {
            match self.row(coupling) {
                Some(row) => self.rows.push(row),
                None => self
                    .tree
                    .not_said
                    .push(format!("coupling `{}`", coupling.name)),
            }
        }
    }

    fn row(&self, coupling: &Coupling) -> Option<Row> {
        if !coupling.is_linear() {
            return None;
        }
        let mut terms = Vec::with_capacity(coupling.terms.len());
        let mut shift = 0.0;
        for term in &coupling.terms {
            let joint = self.tree.variables.get(&term.joint)?;
            shift += term.factor.value() * self.drawn.get(&term.joint).copied().unwrap_or(0.0);
            terms.push((joint.clone(), term.factor.clone()));
        }
        let offset = match shift == 0.0 {
            true => coupling.offset.clone(),
            false => rounded(settled(coupling.offset.value() - shift)),
        };
        Some(Row {
            name: coupling.name.clone(),
            terms,
            offset,
        })
    }
}

/// A double in as many digits, at most 17, as give it back.
fn digits(x: f64) -> String {
    format!("{:?}", x + 0.0)
}

/// A text in quotes: what JSON writes, Python reads.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

fn tuple(numbers: &[f64; 3]) -> String {
    format!("({})", numbers.map(digits).join(", "))
}

/// The program.
fn program(name: &str, urdf: &str, closures: &[Closure], rows: &[Row]) -> String {
    let title = quoted(&format!(
        "{name}: the open tree, and what closes its loops, as models of Pinocchio."
    ));
    // The text of a string in three quotes: nothing ends it early.
    let urdf = urdf.replace('\\', "\\\\").replace('\'', "\\'");
    let mut text = format!("{title}\n\nimport numpy\nimport pinocchio\n\nURDF = '''{urdf}'''\n\n");
    text += "# What closes the loops: name, kind, and on either side a link, the rows of a rotation and a point in it.\n";
    text += "LOOPS = [\n";
    for closure in closures {
        let (name, word) = (quoted(&closure.name), closure.contact.word());
        text += &format!("    (\n        {name},\n        \"{word}\",\n");
        for (link, place) in &closure.sides {
            let [x, y, z] = place.rotation.each_ref().map(tuple);
            let (link, point) = (quoted(link), tuple(&place.translation));
            text += &format!("        ({link}, ({x}, {y}, {z}), {point}),\n");
        }
        text += "    ),\n";
    }
    text += "]\n\n# What couples joints: name, factors of joint variables, and what their sum is (rad, m).\nCOUPLINGS = [\n";
    for row in rows {
        let factors: Vec<String> = row
            .terms
            .iter()
            .map(|(joint, factor)| format!("({}, {})", quoted(joint), digits(factor.value())))
            .collect();
        let (name, offset) = (quoted(&row.name), digits(row.offset.value()));
        let factors = factors.join(", ");
        text += &format!("    ({name}, [{factors}], {offset}),\n");
    }
    text += "]\n";
    text + FUNCTIONS
}

/// What makes models of the data.
const FUNCTIONS: &str = r#"

def constraint(model, loop):
    """A loop as a constraint model."""
    name, kind, *sides = loop
    places = []
    for link, rotation, point in sides:
        frame = model.frames[model.getFrameId(link, pinocchio.FrameType.BODY)]
        place = pinocchio.SE3(numpy.array(rotation), numpy.array(point))
        places += [frame.parentJoint, frame.placement * place]
    kind = getattr(pinocchio.ContactType, kind)
    made = pinocchio.RigidConstraintModel(kind, model, *places, pinocchio.ReferenceFrame.LOCAL)
    made.name = name
    return made


def build():
    """The model of the open tree, and the list of constraint models that close its loops."""
    model = pinocchio.buildModelFromXML(URDF)
    return model, [constraint(model, loop) for loop in LOOPS]


def coupling_rows(model):
    """A row for each coupling, whose product with the joint velocities is zero."""
    rows = numpy.zeros((len(COUPLINGS), model.nv))
    for row, (_, factors, _) in zip(rows, COUPLINGS):
        for joint, factor in factors:
            row[model.joints[model.getJointId(joint)].idx_v] += factor
    return rows


def all_rows(model, constraints, configuration):
    """The rows of all couplings and constraint models over the joint velocities."""
    data = model.createData()
    pinocchio.computeJointJacobians(model, data, configuration)
    rows = [coupling_rows(model)]
    for made in constraints:
        there = made.createData()
        if hasattr(made, "calc"):  # Since Pinocchio 4 the places of a constraint are not worked out with its Jacobian.
            made.calc(model, data, there)
        rows.append(pinocchio.getConstraintJacobian(model, data, made, there))
    return numpy.vstack(rows)


if __name__ == "__main__":
    tree, loops = build()
    found = all_rows(tree, loops, pinocchio.neutral(tree))
    rank = numpy.linalg.matrix_rank(found) if found.size else 0
    print(f"{tree.nv} velocities, {len(found)} rows of rank {rank}, freedom {tree.nv - rank}")
"#;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_and_numbers_are_what_python_reads() {
        assert_eq!(quoted("a \"b\" \\ c\n"), r#""a \"b\" \\ c\n""#);
        assert_eq!(digits(-0.0), "0.0");
        assert_eq!(digits(0.1 + 0.2), "0.30000000000000004");
        assert_eq!(tuple(&[1.0, 0.5, 1e-20]), "(1.0, 0.5, 1e-20)");
        let text = program("it's", "<robot name=\"a'''\\\"/>\n", &[], &[]);
        assert!(
            text.contains("URDF = '''<robot name=\"a\\'\\'\\'\\\\\"/>\n'''"),
            "{text}"
        );
    }
}
