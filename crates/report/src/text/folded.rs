//! What a first screen leaves out because it says nothing: links that are only fixed to others.

use crate::schema::Report;
use std::collections::BTreeSet;

/// Fixed joints of the spanning tree, and the links that hang on them.
#[derive(Debug, Default)]
pub(super) struct Folded<'a> {
    /// The joints, by name.
    pub joints: BTreeSet<&'a str>,
    /// The links, by name: each moves as another does that is shown.
    pub links: BTreeSet<&'a str>,
}

impl<'a> Folded<'a> {
    /// All of a report; none before an analysis.
    pub fn of(report: &'a Report) -> Self {
        let fixed: BTreeSet<&str> = report
            .joints
            .iter()
            .filter(|joint| joint.freedom == 0)
            .map(|joint| joint.name.as_str())
            .collect();
        let hanging = report.tree.iter().flat_map(|tree| &tree.links);
        let mut folded = Self::default();
        for link in hanging.filter(|link| fixed.contains(link.joint.as_str())) {
            folded.joints.insert(&link.joint);
            folded.links.insert(&link.link);
        }
        folded
    }
}
