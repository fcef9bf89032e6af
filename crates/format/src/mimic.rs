//! Joints that follow others: `<mimic>`, and what other tools write for it.
//!
//! - `<mimic joint multiplier offset/>` inside a joint. ROS takes a joint whose leader does not exist for a free one.
//! - `<ros2_control><joint name><param name="mimic">` with `multiplier` and `offset` (ros2_control documentation, *Joint kinematics*).
//! - `<gazebo><plugin filename="…mimic_joint_plugin.so"><joint/><mimicJoint/><multiplier/><offset/></plugin></gazebo>` (roboticsgroup).
//! - `<mujoco><equality><joint joint1 joint2 polycoef/></equality></mujoco>` (MuJoCo XML reference, *equality/joint*): joint1 is a
//!   polynomial in joint2, both counted from the pose drawn; read where it is of the first degree.
//!
//! Where several of them speak of one joint they must agree: followed up to the joints that follow nothing, they are one equation.

use super::WarningKind;
use super::element::Element;
use super::error::{Fault, Outcome};
use super::names::Named;
use super::reader::Reader;
use super::words::{cut, did_you_mean, quoted};
use kutzbach_math::number::Number;

/// What a joint follows: `multiplier × leader + offset`.
#[derive(Clone, PartialEq)]
pub(super) struct Follows<'a> {
    pub(super) leader: &'a str,
    pub(super) multiplier: Number,
    pub(super) offset: Number,
}

/// What an element of another tool says.
struct Said<'a> {
    element: Element<'a>,
    follower: &'a str,
    follows: Follows<'a>,
}

/// The names of everything in a file that may be a joint, wherever it stands.
pub(super) fn joint_names<'a>(root: Element<'a>) -> impl Iterator<Item = &'a str> {
    let inside = |part: Element<'a>| {
        let parts: Vec<Element<'a>> = match part.name() {
            "gazebo" => part.elements().collect(),
            _ => vec![part],
        };
        parts
    };
    root.elements().flat_map(inside).filter_map(|part| {
        let is_joint = matches!(part.name(), "joint" | "loop" | "loop_joint" | "constraint")
            || part.written_name().starts_with("joint:");
        part.attribute("name")
            .filter(|_| is_joint)
            .map(|name| name.value)
    })
}

impl<'a> Reader<'a> {
    /// `<mimic joint multiplier offset/>` of a joint; `None` where no joint of the file has that name.
    pub(super) fn read_mimic(
        &mut self,
        mimic: Element<'a>,
        follower: &str,
    ) -> Outcome<Option<Follows<'a>>> {
        self.leaf_of(mimic, &["joint", "multiplier", "offset"], true)?;
        let multiplier = self.optional_number(mimic, "multiplier")?;
        let offset = self.optional_number(mimic, "offset")?;
        let leader = self.leader_of(mimic, follower)?;
        Ok(leader.map(|leader| Follows {
            leader,
            multiplier: multiplier.unwrap_or_else(Number::one),
            offset: offset.unwrap_or_else(Number::zero),
        }))
    }

    /// The joint that an element names as the leader; `None`, and told, where the file has none of that name.
    pub(super) fn leader_of(
        &mut self,
        mimic: Element<'a>,
        follower: &str,
    ) -> Outcome<Option<&'a str>> {
        let leader = mimic.required("joint")?.value;
        if self.joint_names.contains(leader) {
            return self.directory.refer(Named::Joint, mimic, "joint").map(Some);
        }
        let known = self.joint_names.iter().copied();
        let help = did_you_mean(leader, known, ("`", "`"));
        let message = format!(
            "joint {} follows {}, which the file does not have: it is free, as in ROS{}",
            quoted(follower),
            quoted(leader),
            help.map_or_else(String::new, |help| format!(" ({help})"))
        );
        self.warn_of(mimic.start(), WarningKind::Guessed, message);
        Ok(None)
    }

    /// Makes a joint follow another one.
    pub(super) fn follow(&mut self, follower: &'a str, follows: Follows<'a>) {
        self.builder.mimic(
            follower,
            follows.leader,
            follows.multiplier.clone(),
            follows.offset.clone(),
        );
        self.followers.insert(follower, follows);
    }

    /// Reads what other tools say of joints that follow others.
    pub(super) fn read_other_mimics(&mut self) -> Vec<Fault> {
        let mut said = Vec::new();
        for element in self.set_aside.clone() {
            let mut open = vec![element];
            while let Some(next) = open.pop() {
                open.extend(next.elements());
                said.extend(self.said_by(next));
            }
        }
        said.sort_by_key(|said| said.element.start());
        said.into_iter()
            .filter_map(|said| self.heed(said).err())
            .collect()
    }

    fn said_by(&mut self, element: Element<'a>) -> Option<Said<'a>> {
        let text = |name: &str| {
            let part = element.elements().find(|part| part.name() == name)?;
            part.value()
        };
        let param = |name: &str| {
            let mut params = element.elements().filter(|part| part.name() == "param");
            let named =
                |part: &Element<'a>| part.attribute("name").is_some_and(|n| n.value == name);
            params.find(named).and_then(|part| part.value())
        };
        let given = |name: &str| element.attribute(name);
        let (follower, leader, multiplier, offset) = match element.name() {
            "joint" if given("joint1").is_some() => {
                if given("active").is_some_and(|word| word.value == "false") {
                    return None;
                }
                let [offset, multiplier] = self.line_of(element)?;
                (given("joint1")?, given("joint2")?, multiplier, offset)
            }
            "joint" => {
                let numbers = [param("multiplier"), param("offset")];
                let [multiplier, offset] = self.line(numbers)?;
                (given("name")?, param("mimic")?, multiplier, offset)
            }
            "plugin" if given("filename")?.value.contains("mimic_joint") => {
                let numbers = [text("multiplier"), text("offset")];
                let [multiplier, offset] = self.line(numbers)?;
                (text("mimicJoint")?, text("joint")?, multiplier, offset)
            }
            _ => return None,
        };
        let [follower, leader] = [follower, leader].map(|name| name.value.trim());
        let turns = |joint| {
            self.kinds
                .get(joint)
                .is_some_and(|kind| kind.freedom() == 1)
        };
        (turns(follower) && turns(leader) && follower != leader).then_some(Said {
            element,
            follower,
            follows: Follows {
                leader,
                multiplier,
                offset,
            },
        })
    }

    /// A multiplier and an offset, each of which may be left out; `None` where one is no number.
    fn line(
        &mut self,
        [multiplier, offset]: [Option<super::element::Attribute<'a>>; 2],
    ) -> Option<[Number; 2]> {
        let multiplier = multiplier.map(|text| self.number(text)).transpose().ok()?;
        let offset = offset.map(|text| self.number(text)).transpose().ok()?;
        Some([
            multiplier.unwrap_or_else(Number::one),
            offset.unwrap_or_else(Number::zero),
        ])
    }

    /// Offset and multiplier of a polynomial of the first degree.
    fn line_of(&mut self, equality: Element<'a>) -> Option<[Number; 2]> {
        let Some(polynomial) = equality.attribute("polycoef") else {
            return Some([Number::zero(), Number::one()]);
        };
        let mut terms = self.number_list(polynomial).ok()?.into_iter();
        let offset = terms.next()?;
        let multiplier = terms.next().unwrap_or_else(Number::one);
        terms
            .all(|term| term.is_zero())
            .then_some([offset, multiplier])
    }

    /// Reads what was said, unless it is known already.
    fn heed(&mut self, said: Said<'a>) -> Outcome<()> {
        let (root, of_root) = self.traced(&said.follows);
        let known = match self.followers.get(said.follower) {
            Some(known) => Some(self.traced(known)),
            // It follows one that follows it.
            None if root == said.follower => Some((root, [1.0, 0.0])),
            None => None,
        };
        self.taken.insert(said.element.start());
        let name = cut(said.element.written_name());
        match known {
            None => {
                let message = format!(
                    "joint {} follows {}, as <{name}> says; it is read as <mimic>",
                    quoted(said.follower),
                    quoted(said.follows.leader)
                );
                let kind = WarningKind::ReadAs {
                    joint: said.follower.to_owned(),
                    element: "mimic".to_owned(),
                };
                self.warn_of(said.element.start(), kind, message);
                self.followers_in_gazebo += usize::from(said.element.name() == "plugin");
                self.follow(said.follower, said.follows);
                Ok(())
            }
            Some((other, line)) if other == root && same(line, of_root) => Ok(()),
            Some(_) => Err(said
                .element
                .fault(format!(
                    "<{name}> says otherwise than <mimic> how joint {} follows",
                    quoted(said.follower)
                ))
                .help("remove one of the two, or make them agree")),
        }
    }

    /// The joint at the end of a chain of followers, and multiplier and offset of the whole.
    fn traced(&self, follows: &Follows<'a>) -> (&'a str, [f64; 2]) {
        let mut leader = follows.leader;
        let (mut factor, mut sum) = (follows.multiplier.value(), follows.offset.value());
        // A circle is told when the mechanism is built.
        for _ in 0..self.followers.len() {
            let Some(next) = self.followers.get(leader) else {
                break;
            };
            sum += factor * next.offset.value();
            factor *= next.multiplier.value();
            leader = next.leader;
        }
        (leader, [factor, sum])
    }
}

/// Whether two lines are one, but for the rounding of a few products.
fn same(one: [f64; 2], other: [f64; 2]) -> bool {
    const ROUNDING: f64 = 1e-12;
    let near = |a: f64, b: f64| (a - b).abs() <= ROUNDING * a.abs().max(b.abs()).max(1.0);
    near(one[0], other[0]) && near(one[1], other[1])
}
