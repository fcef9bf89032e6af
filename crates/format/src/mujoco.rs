//! `<mujoco>` inside URDF: the equality that closes a loop by a ball.
//!
//! `<equality><connect body1 body2 anchor/></equality>` (MuJoCo XML reference, *equality/connect*): a point, given in the first body,
//! is held to where it is in the second one at the pose that the file draws; without a second body to where it is in the world, which
//! is the root link here. So the loop is closed at home by construction.

use super::element::Element;
use super::error::{Fault, Outcome};
use super::gazebo::ordered;
use super::names::Named;
use super::reader::{Dialect, Reader};
use super::world::WORLD;
use kutzbach_model::mechanism::{Frame, JointBuilder, JointKind};

impl<'a> Reader<'a> {
    /// Keeps the loops of a `<mujoco>` until all links are known.
    pub(super) fn read_mujoco(&mut self, mujoco: Element<'a>) {
        let equalities = mujoco.elements().filter(|part| part.name() == "equality");
        for part in equalities.flat_map(|equality| equality.elements()) {
            let has = |name: &str| part.attribute(name).is_some();
            if part.name() != "connect" || !has("body1") || !has("anchor") {
                continue;
            }
            self.taken.insert(part.start());
            if part
                .attribute("active")
                .is_some_and(|word| word.value == "false")
            {
                self.skip_because(part, "<connect> that is not active".to_owned());
            } else {
                self.connects.push(part);
            }
        }
    }

    /// Reads the loops that had to wait.
    pub(super) fn read_connects(&mut self) -> Vec<Fault> {
        let connects = std::mem::take(&mut self.connects);
        connects
            .into_iter()
            .filter_map(|connect| self.read_connect(connect).err())
            .collect()
    }

    fn read_connect(&mut self, connect: Element<'a>) -> Outcome<()> {
        let anchor = self.numbers(connect.required("anchor")?)?;
        let first = self.directory.refer(Named::Link, connect, "body1")?;
        let in_world = match connect.attribute("body2") {
            None => true,
            Some(body) => body.value == WORLD && !self.directory.has(Named::Link, WORLD),
        };
        let second = match self.tree_root.filter(|_| in_world) {
            Some(root) => root,
            None => self.directory.refer(Named::Link, connect, "body2")?,
        };
        let given = connect.attribute("name").map(|name| name.value);
        let name = match given.filter(|name| !self.directory.has_joint_or_coupling(name)) {
            Some(_) => self.directory.add(Named::Joint, connect)?.to_owned(),
            None => self.name_unnamed("connect"),
        };
        self.joined
            .entry(ordered([first, second]))
            .or_insert("connect");
        self.uses(Dialect::Own);
        self.other_closures = true;
        self.builder.joint(
            JointBuilder::closing(&name, JointKind::Spherical, first, second).at_home(
                first,
                Frame::at(anchor),
                false,
            ),
        );
        Ok(())
    }
}
