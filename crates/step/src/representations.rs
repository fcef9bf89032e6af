//! Representations: what they hold, and which others they are the same as or contain.

use crate::error::{Problem, StepError};
use crate::part21::{Exchange, Instance, Record};
use crate::placement::{operator, placement};
use crate::units::Units;
use kutzbach_math::group::Pose;
use std::collections::{BTreeMap, BTreeSet};

/// The most representations of which one product may consist.
const MOST: usize = 100_000;

/// The most representations through which one leads to another by mapped items.
const DEEPEST: usize = 256;

/// Another representation in the frame of one.
#[derive(Clone, Copy, Debug)]
struct Link {
    other: u64,
    /// The frame of this one from that of the other.
    pose: Pose,
}

/// What the relationships between representations say.
#[derive(Debug, Default)]
pub(crate) struct Relations {
    links: BTreeMap<u64, Vec<Link>>,
}

/// The leaf of a representation that has its name, its items and its context; `None` where the entity is something else.
pub(crate) fn representation(instance: Instance<'_>) -> Option<Record<'_>> {
    instance.leaf("REPRESENTATION").or_else(|| {
        let mut leaves = instance.leaves();
        leaves.find(|leaf| leaf.keyword().ends_with("REPRESENTATION") && leaf.len() >= 3)
    })
}

/// As [`representation`].
///
/// # Errors
/// Where the entity is something else.
pub(crate) fn expect_representation(instance: Instance<'_>) -> Result<Record<'_>, StepError> {
    representation(instance).ok_or_else(|| instance.wrong_kind("a representation"))
}

/// The two representations of a relationship; `None` where the entity is something else.
fn related(instance: Instance<'_>) -> Option<Record<'_>> {
    instance.leaf("REPRESENTATION_RELATIONSHIP").or_else(|| {
        let mut leaves = instance.leaves();
        leaves
            .find(|leaf| leaf.keyword().ends_with("REPRESENTATION_RELATIONSHIP") && leaf.len() >= 4)
    })
}

/// Relationships between the links of a mechanism are pairs, not places of what shows a product.
fn is_kinematic(instance: Instance<'_>) -> bool {
    instance.leaves().any(|leaf| {
        let keyword = leaf.keyword();
        keyword == "PAIR_REPRESENTATION_RELATIONSHIP" || keyword.contains("KINEMATIC")
    })
}

/// A relationship with a transformation: where the first representation stands in the second.
#[derive(Clone, Copy)]
pub(crate) struct Placed<'e> {
    /// First representation.
    pub first: Instance<'e>,
    /// Second representation.
    pub second: Instance<'e>,
    /// The frame of the second from that of the first.
    pub second_from_first: Pose,
}

/// Reads a relationship between representations; without a transformation the two share one frame.
///
/// Which of the two items of an ITEM_DEFINED_TRANSFORMATION belongs to which representation is what the representations' own
/// lists say: writers disagree about the order.
///
/// # Errors
/// Where the entity is no relationship, or its transformation is not understood.
pub(crate) fn relationship(instance: Instance<'_>) -> Result<Placed<'_>, StepError> {
    let record = related(instance)
        .ok_or_else(|| instance.wrong_kind("a relationship between representations"))?;
    let (first, second) = (record.entity_at(2)?, record.entity_at(3)?);
    let mut placed = Placed {
        first,
        second,
        second_from_first: Pose::identity(),
    };
    let Some(with) = transformation(instance) else {
        return Ok(placed);
    };
    let transformation = with.entity_at(with.len().saturating_sub(1))?;
    let (one, two) = (
        expect_representation(first)?,
        expect_representation(second)?,
    );
    let (one_units, two_units) = (
        Units::of_representation(one)?,
        Units::of_representation(two)?,
    );
    let Some(defined) = transformation.leaf("ITEM_DEFINED_TRANSFORMATION") else {
        // The operator moves what is first into the space of the second, whose units are its own.
        placed.second_from_first = operator(transformation, &two_units)?;
        return Ok(placed);
    };
    let (mut item_one, mut item_two) = (defined.entity_at(2)?, defined.entity_at(3)?);
    let holds = |representation: Record<'_>, item: Instance<'_>| -> Result<bool, StepError> {
        Ok(representation
            .entities_at(1)?
            .iter()
            .any(|held| held.number() == item.number()))
    };
    let in_order = holds(one, item_one)? && holds(two, item_two)?;
    if !in_order && (holds(one, item_two)? || holds(two, item_one)?) {
        std::mem::swap(&mut item_one, &mut item_two);
    }
    placed.second_from_first =
        placement(item_two, &two_units)? * placement(item_one, &one_units)?.inverse();
    Ok(placed)
}

/// The leaf of a relationship that names its transformation.
fn transformation(instance: Instance<'_>) -> Option<Record<'_>> {
    let mut leaves = instance.leaves();
    leaves.find(|leaf| {
        leaf.keyword()
            .ends_with("REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION")
    })
}

/// A MAPPED_ITEM: the representation that it repeats, and where.
///
/// # Errors
/// Where its origin or target are no placements.
pub(crate) fn mapped<'e>(
    item: Record<'e>,
    units: &Units,
) -> Result<(Instance<'e>, Pose), StepError> {
    let map = item.entity_at(1)?;
    let map = map.expect("REPRESENTATION_MAP", "REPRESENTATION_MAP")?;
    let source = map.entity_at(1)?;
    let source_units = Units::of_representation(expect_representation(source)?)?;
    let origin = placement(map.entity_at(0)?, &source_units)?;
    let target = item.entity_at(2)?;
    let target = if target.is("AXIS2_PLACEMENT_3D") {
        placement(target, units)?
    } else {
        operator(target, units)?
    };
    Ok((source, target * origin.inverse()))
}

impl Relations {
    /// All relationships of a file, without those numbered in `except`: they place components.
    ///
    /// # Errors
    /// As for [`relationship`].
    pub fn new(file: &Exchange<'_>, except: &BTreeSet<u64>) -> Result<Self, StepError> {
        let mut relations = Self::default();
        for instance in file.instances() {
            let is_shape = related(instance).is_some()
                && instance
                    .leaves()
                    .any(|leaf| leaf.keyword().contains("SHAPE_REPRESENTATION"));
            // A relationship with a transformation may be written without naming shapes.
            let counts =
                is_shape || (related(instance).is_some() && transformation(instance).is_some());
            if !counts || is_kinematic(instance) || except.contains(&instance.number()) {
                continue;
            }
            let placed = relationship(instance)?;
            let pose = placed.second_from_first;
            relations.link(placed.second.number(), placed.first.number(), pose);
            relations.link(
                placed.first.number(),
                placed.second.number(),
                pose.inverse(),
            );
        }
        Ok(relations)
    }

    fn link(&mut self, from: u64, other: u64, pose: Pose) {
        self.links
            .entry(from)
            .or_default()
            .push(Link { other, pose });
    }

    /// Every representation that shows one of these, with its pose in their frame: they themselves, what is related to them,
    /// and what mapped items repeat. `owners` says which belong to other products than `product`, and which mapped items place
    /// components.
    ///
    /// # Errors
    /// Mapped items that contain themselves; more representations than can be read.
    pub fn spread<'e>(
        &self,
        start: &[Instance<'e>],
        product: Option<u64>,
        owners: &Owners,
    ) -> Result<Vec<(Record<'e>, Pose)>, StepError> {
        let foreign = |number: u64| {
            let owner = owners.representations.get(&number);
            owner.is_some() && owner.copied() != product
        };
        let mut spread = Vec::new();
        // What is related is visited once; what is mapped once for every mapped item.
        let mut seen: BTreeSet<u64> = start.iter().map(|instance| instance.number()).collect();
        let mut open: Vec<Step<'e>> = start
            .iter()
            .rev()
            .map(|instance| Step {
                instance: *instance,
                pose: Pose::identity(),
                above: Vec::new(),
            })
            .collect();
        while let Some(step) = open.pop() {
            let instance = step.instance;
            if spread.len() >= MOST {
                return Err(instance.error(Problem::TooMuch {
                    what: "representations of one product",
                    limit: MOST as u64,
                }));
            }
            let record = expect_representation(instance)?;
            spread.push((record, step.pose));
            self.follow_links(record, &step, &foreign, &mut seen, &mut open)?;
            follow_mapped(record, &step, owners, &mut open)?;
        }
        Ok(spread)
    }

    fn follow_links<'e>(
        &self,
        record: Record<'e>,
        step: &Step<'e>,
        foreign: &dyn Fn(u64) -> bool,
        seen: &mut BTreeSet<u64>,
        open: &mut Vec<Step<'e>>,
    ) -> Result<(), StepError> {
        for link in self.links.get(&record.number()).into_iter().flatten() {
            // Below a mapped item what is related is visited anew, but not along the way back.
            let new = if step.above.is_empty() {
                seen.insert(link.other)
            } else {
                !step.above.contains(&link.other)
            };
            if !new || foreign(link.other) {
                continue;
            }
            let above = if step.above.is_empty() {
                Vec::new()
            } else {
                step.deeper(record)?
            };
            open.push(Step {
                instance: record.resolve(link.other)?,
                pose: step.pose * link.pose,
                above,
            });
        }
        Ok(())
    }
}

/// What belongs to products and components.
#[derive(Debug, Default)]
pub(crate) struct Owners {
    /// The product (by its PRODUCT_DEFINITION) of every representation that has one.
    pub representations: BTreeMap<u64, u64>,
    /// Mapped items that place components.
    pub mapped_items: BTreeSet<u64>,
}

/// A representation on the way, with those that led to it through mapped items.
struct Step<'e> {
    instance: Instance<'e>,
    pose: Pose,
    above: Vec<u64>,
}

impl Step<'_> {
    /// The way to what this representation leads to.
    fn deeper(&self, record: Record<'_>) -> Result<Vec<u64>, StepError> {
        if self.above.len() >= DEEPEST {
            return Err(self.instance.error(Problem::TooMuch {
                what: "representations within each other",
                limit: DEEPEST as u64,
            }));
        }
        let mut above = self.above.clone();
        above.push(record.number());
        Ok(above)
    }
}

fn follow_mapped<'e>(
    record: Record<'e>,
    step: &Step<'e>,
    owners: &Owners,
    open: &mut Vec<Step<'e>>,
) -> Result<(), StepError> {
    for item in record.entities_at(1)? {
        let Some(mapped_item) = item.leaf("MAPPED_ITEM") else {
            continue;
        };
        if owners.mapped_items.contains(&item.number()) {
            continue;
        }
        let units = Units::of_representation(record)?;
        let (source, pose) = mapped(mapped_item, &units)?;
        let above = step.deeper(record)?;
        if above.contains(&source.number()) {
            return Err(item.error(Problem::Cycle {
                what: "mapped items",
            }));
        }
        open.push(Step {
            instance: source,
            pose: step.pose * pose,
            above,
        });
    }
    Ok(())
}
