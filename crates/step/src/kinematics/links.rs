//! The links of a mechanism: which occurrence each of them is, and where the frames of its pairs are.
//!
//! A link has a representation with the frames of its pairs; an association makes that one of a shape's, and says by an occurrence which of
//! several parts of that shape is meant (CONTEXT_DEPENDENT_KINEMATIC_LINK_REPRESENTATION). Without the latter the shape has to occur once.

use crate::error::StepError;
use crate::part21::{Exchange, Instance, Record};
use crate::representations::{expect_representation, relationship};
use crate::units::Units;
use kutzbach_math::group::Pose;
use std::collections::BTreeMap;

/// An occurrence of a product on the way from the whole assembly.
pub(crate) struct Occurred {
    /// The numbers of the NEXT_ASSEMBLY_USAGE_OCCURRENCEs that lead to it; empty for a product that is no one's component.
    pub chain: Vec<u64>,
    /// The number of its PRODUCT_DEFINITION.
    pub product: u64,
    /// Where it stands: `assembly_from_product`.
    pub pose: Pose,
    /// Its place among the parts, where it has faces of its own.
    pub part: Option<usize>,
}

/// Which product each representation shows, by their numbers, and where its frame is in the product's.
pub(crate) type Shown = BTreeMap<u64, (u64, Pose)>;

/// A link that is one occurrence.
pub(super) struct Link<'e> {
    /// Where the frame of its representation stands in the assembly.
    pub pose: Pose,
    /// Its parts, by their places.
    pub parts: Vec<usize>,
    /// Its representation, and that of the shape.
    representations: Vec<Record<'e>>,
}

impl<'e> Link<'e> {
    /// The units of the frames of its pairs.
    ///
    /// # Errors
    /// Where neither representation has units.
    pub fn units(&self, item: Instance<'e>) -> Result<Units, StepError> {
        let mut outcome = None;
        for representation in &self.representations {
            match Units::of_representation(*representation) {
                Ok(units) => return Ok(units),
                Err(error) => outcome = outcome.or(Some(error)),
            }
        }
        Err(outcome.unwrap_or_else(|| item.wrong_kind("a placement in a representation")))
    }
}

/// The links of a file, by their numbers; those that are not one occurrence with why.
pub(super) struct Links<'e> {
    all: BTreeMap<u64, Result<Link<'e>, &'static str>>,
}

/// How the frame of a link is that of a shape.
struct Association<'e> {
    number: u64,
    shape: Instance<'e>,
    shape_from_link: Pose,
}

impl<'e> Links<'e> {
    /// Finds the links of a file.
    ///
    /// # Errors
    /// References to nothing, entities of the wrong kind.
    pub fn new(
        file: &'e Exchange<'e>,
        occurred: &[Occurred],
        shown: &Shown,
    ) -> Result<Self, StepError> {
        let associations = associations(file)?;
        let usages = usages(file)?;
        let mut all: BTreeMap<u64, Result<Link<'e>, &'static str>> = BTreeMap::new();
        for (link, representation) in representations(file)? {
            let known = all.get(&link).is_some_and(Result::is_ok);
            if known {
                continue;
            }
            let found = match associations.get(&representation.number()) {
                None => Err("one of its links is associated with no shape"),
                Some(association) => {
                    let usage = usages.get(&association.number).copied();
                    let shape = expect_representation(association.shape)?;
                    occurrence(association, usage, occurred, shown).map(|(at, pose)| Link {
                        pose: pose * association.shape_from_link,
                        parts: parts_of(at, occurred),
                        representations: vec![representation, shape],
                    })
                }
            };
            all.insert(link, found);
        }
        Ok(Self { all })
    }

    /// The link of a representation, by its number.
    pub fn shown_by(&self, representation: u64) -> Option<&Link<'e>> {
        let mut links = self.all.values().filter_map(|link| link.as_ref().ok());
        links.find(|link| {
            let own = link.representations.first();
            own.is_some_and(|record| record.number() == representation)
        })
    }

    /// A link by its number, or why it is no part.
    pub fn find(&self, number: u64) -> Result<&Link<'e>, &'static str> {
        match self.all.get(&number) {
            Some(Ok(link)) => Ok(link),
            Some(Err(why)) => Err(*why),
            None => Err("one of its links has no representation"),
        }
    }
}

/// The occurrence that is meant, and where the frame of the shape stands.
fn occurrence<'o>(
    association: &Association<'_>,
    usage: Option<u64>,
    occurred: &'o [Occurred],
    shown: &Shown,
) -> Result<(&'o Occurred, Pose), &'static str> {
    let shape = shown.get(&association.shape.number());
    let meant = |at: &&Occurred| match usage {
        Some(usage) => at.chain.last() == Some(&usage),
        None => shape.is_some_and(|(product, _)| *product == at.product),
    };
    let mut all = occurred.iter().filter(meant);
    match (all.next(), all.next()) {
        (Some(at), None) => {
            let own = shape.filter(|(product, _)| *product == at.product);
            let product_from_shape = own.map_or_else(Pose::identity, |(_, pose)| *pose);
            Ok((at, at.pose * product_from_shape))
        }
        (None, _) => Err("one of its links is no occurrence of a product"),
        _ => Err("one of its links occurs several times, and the file does not say which is meant"),
    }
}

/// The parts that an occurrence is or contains.
fn parts_of(at: &Occurred, occurred: &[Occurred]) -> Vec<usize> {
    // Products that are no one's components stand side by side: their chains are empty.
    let below = occurred.iter().filter(|other| match at.chain.is_empty() {
        true => std::ptr::eq(*other, at),
        false => other.chain.starts_with(&at.chain),
    });
    below.filter_map(|other| other.part).collect()
}

/// The links of a file with their representations.
fn representations<'e>(file: &'e Exchange<'e>) -> Result<Vec<(u64, Record<'e>)>, StepError> {
    let mut found = Vec::new();
    for keyword in ["RIGID_LINK_REPRESENTATION", "KINEMATIC_LINK_REPRESENTATION"] {
        for record in file.of_type(keyword) {
            let Some(last) = record.len().checked_sub(1) else {
                continue;
            };
            // In AP214 the last of its parameters is the context, and an entity of its own names the link.
            let link = record.entity_at(last)?;
            if link.is("KINEMATIC_LINK") {
                found.push((link.number(), expect_representation(record.instance())?));
            }
        }
    }
    for record in file.of_type("KINEMATIC_LINK_REPRESENTATION_RELATION") {
        let (link, shown) = (record.entity_at(0)?, record.entity_at(1)?);
        found.push((link.number(), expect_representation(shown)?));
    }
    Ok(found)
}

/// The associations of links with shapes, by the numbers of the links' representations.
fn associations<'e>(file: &'e Exchange<'e>) -> Result<BTreeMap<u64, Association<'e>>, StepError> {
    let mut found = BTreeMap::new();
    for record in file.of_type("KINEMATIC_LINK_REPRESENTATION_ASSOCIATION") {
        let instance = record.instance();
        let (link, shape, shape_from_link) = match instance.is("REPRESENTATION_RELATIONSHIP") {
            true => {
                let placed = relationship(instance)?;
                (placed.first, placed.second, placed.second_from_first)
            }
            false => (record.entity_at(2)?, record.entity_at(3)?, Pose::identity()),
        };
        let number = instance.number();
        found.insert(
            link.number(),
            Association {
                number,
                shape,
                shape_from_link,
            },
        );
    }
    Ok(found)
}

/// The occurrences that associations mean, by the numbers of the associations.
fn usages(file: &Exchange<'_>) -> Result<BTreeMap<u64, u64>, StepError> {
    let mut found = BTreeMap::new();
    for record in file.of_type("CONTEXT_DEPENDENT_KINEMATIC_LINK_REPRESENTATION") {
        let (association, property) = (record.entity_at(0)?, record.entity_at(1)?);
        let property = property
            .leaf("PROPERTY_DEFINITION")
            .or_else(|| property.leaf("PRODUCT_DEFINITION_RELATIONSHIP_KINEMATICS"))
            .ok_or_else(|| property.wrong_kind("PRODUCT_DEFINITION_RELATIONSHIP_KINEMATICS"))?;
        found.insert(association.number(), property.entity_at(2)?.number());
    }
    Ok(found)
}
