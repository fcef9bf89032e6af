//! The world that is no link of a file, and links that nothing places.
//!
//! Drake (`multibody/parsing/parsing_doxygen.h`) welds nothing to the ground by itself: `world` is a link that every file has without
//! writing it, joints may connect to it, and what no joint places floats in it. SDFormat, inside `<gazebo>`, has the same word for what
//! a model stands on.
//!
//! Elsewhere a link that nothing places is most often a joint that was forgotten, and stays an error: links float only where a file
//! shows that it is Drake's, by such a world or by one of Drake's elements.

use super::WarningKind;
use super::gazebo::IN_GAZEBO;
use super::reader::Reader;
use super::unread::slip_of;
use super::words::listed;
use kutzbach_model::mechanism::{Frame, JointBuilder, JointKind};

/// The word of Drake and SDFormat for no link: what everything stands on.
pub(super) const WORLD: &str = "world";

impl<'a> Reader<'a> {
    /// Makes `world` a link if joints name it and no link of the file has that name, or nearly that name.
    pub(super) fn find_world(&mut self) {
        if !self.meets_world {
            return;
        }
        let links = self.directory.link_names().map(|(link, _)| link);
        if slip_of(WORLD, links).is_some() {
            return;
        }
        let Some(at) = self.directory.assume_link(WORLD) else {
            return;
        };
        self.implicit_world = true;
        self.builder.link(WORLD);
        if self.ground.is_none() {
            self.builder.ground(WORLD);
        }
        self.warn_of(
            at,
            WarningKind::Guessed,
            format!("no link of the file is called `{WORLD}`: it is the ground, as in Drake"),
        );
    }

    /// The link that nothing in the file's tree places; the world, where there is one.
    pub(super) fn root_link(&self) -> Option<&'a str> {
        if self.implicit_world && self.is_root(WORLD) {
            return Some(WORLD);
        }
        let mut links = self.directory.link_names().map(|(link, _)| link);
        links.find(|link| self.is_root(link))
    }

    fn is_root(&self, link: &str) -> bool {
        let placed = self.placed_by.contains_key(link);
        !placed && !self.floating.contains(link) && !self.sdf_links.contains(link)
    }

    /// In a file of Drake's, lets every link that nothing places float in the root.
    pub(super) fn float_roots(&mut self) {
        let Some(root) = self.tree_root else {
            return;
        };
        let links = self.directory.link_names();
        let loose: Vec<(&'a str, usize)> = links
            .filter(|(link, _)| *link != root && self.is_root(link))
            .map(|(link, place)| (link, place.start))
            .collect();
        let Some((_, at)) = loose.first().copied() else {
            return;
        };
        if !self.implicit_world && !self.root.has_any_of("drake:") {
            return;
        }
        for (link, _) in &loose {
            let name = self.name_unnamed(&format!("{link}_floating"));
            self.builder.floating(&name, root, link, Frame::identity());
            self.floating.insert(link);
        }
        let names: Vec<&str> = loose.iter().map(|(link, _)| *link).collect();
        self.warn_of(
            at,
            WarningKind::Guessed,
            format!(
                "no joint places {}: such a link floats, as in Drake",
                listed(&names)
            ),
        );
    }

    /// Adds the world as a link where joints inside `<gazebo>` connect to it, placed so that nothing holds the robot in it but they.
    pub(super) fn add_world(&mut self) {
        let Some(root) = self.tree_root.filter(|_| self.joins_world) else {
            return;
        };
        self.builder.link(WORLD);
        let name = format!("{root}{IN_GAZEBO}");
        if self.root_is_held {
            let held = JointBuilder::tree(&name, JointKind::Fixed, WORLD, root);
            self.builder.joint(held);
        } else {
            self.builder.floating(&name, WORLD, root, Frame::identity());
        }
    }
}
