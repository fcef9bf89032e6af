//! Links inside `<gazebo>`, which stand where their poses say.

use super::element::Element;
use super::error::{Fault, Outcome};
use super::gazebo::{IN_GAZEBO, MODEL};
use super::names::Named;
use super::reader::Reader;
use super::words::{cut, listed};
use kutzbach_model::mechanism::FrameTree;
use std::collections::HashMap;
use std::ops::Range;

impl<'a> Reader<'a> {
    /// A link that only Gazebo knows, as those that close the PR2's grippers. It stands in the model's frame until joints
    /// inside `<gazebo>` hold it.
    pub(super) fn read_sdf_link(&mut self, link: Element<'a>) -> Outcome<()> {
        let name = self.directory.add(Named::Link, link)?;
        let pose = link.elements().find(|part| part.name() == "pose");
        let place = self.sdf_place(pose, MODEL)?;
        self.builder.link(name);
        self.sdf_links.insert(name);
        self.late_links.push((link, name, place.link, place.frame));
        for part in link.elements().filter(|part| part.name() != "pose") {
            let what = format!("<{}> of a <link> inside <gazebo>", cut(part.name()));
            self.skip_because(part, what);
        }
        Ok(())
    }

    /// Places the links that only Gazebo knows.
    pub(super) fn place_sdf_links(&mut self) -> Outcome<()> {
        let root = self.tree_root.unwrap_or_default();
        let late = std::mem::take(&mut self.late_links);
        let indices = late.iter().enumerate();
        let indices: HashMap<&str, usize> = indices
            .map(|(index, (_, name, ..))| (*name, index))
            .collect();
        let given_in = late.iter().map(|(_, _, reference, _)| *reference);
        let parents = given_in.map(|reference| indices.get(reference).copied());
        if let Err(circle) = FrameTree::new(parents.collect()) {
            let of_circle = circle.iter().filter_map(|index| late.get(*index));
            let names: Vec<&str> = of_circle.map(|(_, name, ..)| *name).collect();
            let first = circle.first().and_then(|index| late.get(*index));
            let range = first.map_or(0..0, |(link, ..)| link.range());
            return Err(poses_in_a_circle(range, &names));
        }
        for (_, link, reference, frame) in late {
            let reference = if reference == MODEL { root } else { reference };
            let name = format!("{link}{IN_GAZEBO}");
            self.builder.floating(&name, reference, link, frame);
        }
        Ok(())
    }
}

/// The fault of poses of which each is given in the next one, by the names of what has them.
pub(super) fn poses_in_a_circle(range: Range<usize>, names: &[&str]) -> Fault {
    let what = match names.len() {
        // A model that is placed by one of its frames stands at two nodes.
        0 => "this one is given in itself".to_owned(),
        1 => format!("{} is given in itself", listed(names)),
        _ => format!("{} are each given in the next one", listed(names)),
    };
    Fault::new(range, format!("poses run in a circle: {what}"))
        .help("give one of them in the model's frame")
}
