//! Gazebo's plugin `DetachableJoint`, which holds a link of one model to one of another until a message lets it go.
//!
//! `<parent_link>` is a link of the model that the plugin stands in, `<child_link>` one of `<child_model>`. Both have to be in the file for
//! anything to be held; in URDF, which is one model, `<child_model>` is then the robot itself, by its name or as `__model__`.

use super::WarningKind;
use super::element::{Attribute, Element};
use super::error::Outcome;
use super::gazebo::MODEL;
use super::names::{Named, unused};
use super::reader::{Dialect, Reader};
use super::words::quoted;
use kutzbach_model::mechanism::{Frame, JointBuilder, JointKind};

/// Parts of the plugin's names.
const DETACHABLE: [&str; 2] = ["DetachableJoint", "detachable-joint"];

/// What is told where there is nothing to hold.
pub(super) const NO_SUCH_LINK: &str =
    "<plugin> DetachableJoint of a link that the file does not have";
pub(super) const HELD_ALREADY: &str = "<plugin> DetachableJoint between links that are held";

/// Whether an element is this plugin.
pub(super) fn is_detachable(element: Element<'_>) -> bool {
    let says = |attribute: Attribute<'_>| DETACHABLE.iter().any(|p| attribute.value.contains(p));
    element.name() == "plugin"
        && ["name", "filename"]
            .into_iter()
            .filter_map(|word| element.attribute(word))
            .any(says)
}

/// How it is read.
pub(super) fn told([parent, child]: [&str; 2]) -> String {
    format!(
        "the plugin DetachableJoint holds {} to {} until it lets go: it is read as a fixed joint",
        quoted(child),
        quoted(parent)
    )
}

impl<'a> Reader<'a> {
    /// Holds two links of the robot as they are drawn; where there are no two, that is told.
    pub(super) fn read_detachable(&mut self, plugin: Element<'a>) -> Outcome<()> {
        let said = |name: &str| {
            let part = plugin.elements().find(|part| part.name() == name)?;
            part.value().map(|value| value.value.trim())
        };
        let own = self.root.attribute("name").map(|name| name.value.trim());
        let in_robot = said("child_model").is_some_and(|m| m == MODEL || Some(m) == own);
        let links = ["parent_link", "child_link"].map(|name| self.link_said(said(name)));
        let (true, [Some(parent), Some(child)]) = (in_robot, links) else {
            self.skip_because(plugin, NO_SUCH_LINK.to_owned());
            return Ok(());
        };
        if parent == child {
            self.skip_because(plugin, HELD_ALREADY.to_owned());
            return Ok(());
        }
        let wanted = format!("{parent}_{child}_detachable");
        let name = unused(&wanted, |name| {
            self.directory.has_joint_or_coupling(name) || self.in_gazebo.contains_key(name)
        });
        let kind = WarningKind::ReadAs {
            joint: name.clone(),
            element: "joint".to_owned(),
        };
        self.warn_of(plugin.start(), kind, told([parent, child]));
        let joint = JointBuilder::closing(&name, JointKind::Fixed, parent, child).at_home(
            child,
            Frame::identity(),
            false,
        );
        self.uses(Dialect::UrdfPlus);
        self.first_in_gazebo.get_or_insert(plugin.start());
        self.in_gazebo.insert(name, 0);
        self.builder.joint(joint);
        Ok(())
    }

    /// A link of the file by its name, or by the last part of a scoped one.
    fn link_said(&self, name: Option<&'a str>) -> Option<&'a str> {
        let name = name?;
        let last = name.rsplit("::").next().unwrap_or(name);
        let known = |name: &&str| self.directory.has(Named::Link, name);
        [name, last].into_iter().find(known)
    }
}
