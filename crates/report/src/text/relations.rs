//! The relations that the mechanism meant by rounded numbers satisfies exactly, for a page with everything on it.

use super::page::Page;
use super::style::Tint;
use crate::schema::{Relation, Report};
use kutzbach_mobility::RelationKind;

/// Every relation by which the mechanism meant was found, kind by kind.
pub(super) fn relations(report: &Report, page: &mut Page) {
    let nominal = report.mobility.nominal.as_ref();
    let relations = nominal.map_or(&[][..], |nominal| &nominal.relations);
    if relations.is_empty() || !page.layout().verbose {
        return;
    }
    page.heading("Relations that the numbers nearly satisfy, taken for exact");
    for kind in RelationKind::ALL {
        let of_kind: Vec<String> = relations
            .iter()
            .filter(|relation| relation.kind == *kind)
            .map(between)
            .collect();
        if !of_kind.is_empty() {
            let item = format!("{}: {}", words(*kind), of_kind.join(", "));
            page.item(&item, Tint::Plain);
        }
    }
}

/// `A – B`, with the angle where it is one; `A – B as C – D` of two links.
fn between(relation: &Relation) -> String {
    let pairs: Vec<String> = relation
        .joints
        .chunks(2)
        .map(|pair| pair.join(" – "))
        .collect();
    let angle = relation.degrees.map(|angle| format!(" ({angle}°)"));
    pairs.join(" as ") + &angle.unwrap_or_default()
}

fn words(kind: RelationKind) -> &'static str {
    match kind {
        RelationKind::Parallel => "parallel axes",
        RelationKind::Angle => "axes at an angle",
        RelationKind::Coincide => "coinciding axes or points",
        RelationKind::Meet => "axes that meet",
        RelationKind::EqualAngles => "equal or supplementary angles",
        RelationKind::EqualDistances => "equal distances",
        RelationKind::NormalsMeet => "common normals that meet",
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn a_relation_names_the_joints_of_each_link() {
        let relation = Relation {
            kind: RelationKind::Angle,
            joints: ["a", "b"].map(str::to_owned).to_vec(),
            degrees: Some(90.0),
        };
        assert_eq!(between(&relation), "a – b (90°)");
        let alike = Relation {
            kind: RelationKind::EqualDistances,
            joints: ["a", "b", "c", "d"].map(str::to_owned).to_vec(),
            degrees: None,
        };
        assert_eq!(between(&alike), "a – b as c – d");
    }
}
