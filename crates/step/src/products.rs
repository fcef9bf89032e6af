//! Products of a file and where they occur.

use crate::error::{Problem, StepError};
use crate::part21::{Exchange, Instance, Record};
use crate::representations::{
    Owners, Relations, expect_representation, mapped, relationship, representation,
};
use crate::units::Units;
use kutzbach_math::group::Pose;
use std::collections::{BTreeMap, BTreeSet};

/// A product: what it is called, what shows it, what it is made of.
pub(crate) struct Product<'e> {
    /// Its PRODUCT_DEFINITION.
    pub definition: Instance<'e>,
    /// Its name.
    pub name: String,
    /// Its representations.
    pub representations: Vec<Instance<'e>>,
    /// Its components.
    pub occurrences: Vec<Occurrence<'e>>,
}

/// A component of a product.
pub(crate) struct Occurrence<'e> {
    /// Its NEXT_ASSEMBLY_USAGE_OCCURRENCE.
    pub usage: Instance<'e>,
    /// Its name.
    pub name: String,
    /// The product that it is one of, by the number of its PRODUCT_DEFINITION.
    pub child: u64,
    /// Its place: `parent_from_child`. `None` where the file does not say it.
    pub pose: Option<Pose>,
}

/// All products of a file.
pub(crate) struct Products<'e> {
    /// By the numbers of their PRODUCT_DEFINITIONs.
    pub all: BTreeMap<u64, Product<'e>>,
    /// How representations are related.
    pub relations: Relations,
    /// Mapped items that place components.
    mapped_items: BTreeSet<u64>,
}

impl<'e> Products<'e> {
    /// Reads the products of a file.
    ///
    /// # Errors
    /// References to nothing, entities of the wrong kind, placements that are none, products that contain themselves.
    pub fn new(file: &'e Exchange<'e>) -> Result<Self, StepError> {
        let mut all = definitions(file)?;
        for record in file.of_type("SHAPE_DEFINITION_REPRESENTATION") {
            let shape = record.entity_at(0)?;
            let Some(of) = defined(shape)? else {
                continue;
            };
            if let Some(product) = all.get_mut(&of.number()) {
                product.representations.push(record.entity_at(1)?);
            }
        }
        let placements = placements(file)?;
        let except: BTreeSet<u64> = placements.values().map(|r| r.number()).collect();
        let mut products = Self {
            relations: Relations::new(file, &except)?,
            all,
            mapped_items: BTreeSet::new(),
        };
        for record in file.of_type("NEXT_ASSEMBLY_USAGE_OCCURRENCE") {
            products.occurrence(record, &placements)?;
        }
        products.place_by_mapped_items()?;
        products.refuse_cycles()?;
        Ok(products)
    }

    /// Reads one NEXT_ASSEMBLY_USAGE_OCCURRENCE.
    fn occurrence(
        &mut self,
        record: Record<'e>,
        placements: &BTreeMap<u64, Instance<'e>>,
    ) -> Result<(), StepError> {
        let (parent, child) = (record.entity_at(3)?, record.entity_at(4)?);
        let pose = match placements.get(&record.number()) {
            Some(relation) => Some(self.placed(*relation, parent.number(), child.number())?),
            None => None,
        };
        let Some(component) = self.all.get(&child.number()) else {
            return Err(child.wrong_kind("PRODUCT_DEFINITION"));
        };
        let names = [record.text_at(1), record.text_at(5), record.text_at(0)];
        let name = names.into_iter().find(|name| !name.trim().is_empty());
        let occurrence = Occurrence {
            usage: record.instance(),
            name: name.unwrap_or_else(|| component.name.clone()),
            child: child.number(),
            pose,
        };
        match self.all.get_mut(&parent.number()) {
            Some(product) => product.occurrences.push(occurrence),
            None => return Err(parent.wrong_kind("PRODUCT_DEFINITION")),
        }
        Ok(())
    }

    /// The frame of a parent from that of its child, by a relationship between representations of both, whatever their order.
    fn placed(&self, relation: Instance<'e>, parent: u64, child: u64) -> Result<Pose, StepError> {
        let placed = relationship(relation)?;
        let shows = |product: u64, r: Instance<'_>| self.shows(product, r.number());
        // By the standard the first is the component's; where the representations say nothing else, that counts.
        let other_way = shows(child, placed.second) && shows(parent, placed.first);
        let in_order = shows(child, placed.first) && shows(parent, placed.second);
        let reversed = if in_order || other_way {
            other_way && !in_order
        } else {
            // Representations may be the products' own by a further relationship: one end is enough to tell.
            shows(parent, placed.first) || shows(child, placed.second)
        };
        let pose = placed.second_from_first;
        Ok(if reversed { pose.inverse() } else { pose })
    }

    /// Components without a relationship of their own are placed by the mapped items of their parents, in the order of both.
    /// Mapped items that repeat a component that has its place are no geometry of the parent either.
    fn place_by_mapped_items(&mut self) -> Result<(), StepError> {
        let mut poses = Vec::new();
        let mut mapped_items = BTreeSet::new();
        for (number, product) in &self.all {
            if product.occurrences.is_empty() {
                continue;
            }
            let mut items = placed_items(product)?;
            for (place, occurrence) in product.occurrences.iter().enumerate() {
                let shows = |item: &PlacedItem| self.shows(occurrence.child, item.source);
                if occurrence.pose.is_none()
                    && let Some(at) = items.iter().position(shows)
                {
                    let item = items.remove(at);
                    mapped_items.insert(item.number);
                    poses.push((*number, place, item.pose));
                }
            }
            for item in items {
                let mut children = product.occurrences.iter().map(|o| o.child);
                if children.any(|child| self.shows(child, item.source)) {
                    mapped_items.insert(item.number);
                }
            }
        }
        self.mapped_items = mapped_items;
        for (number, place, pose) in poses {
            let product = self.all.get_mut(&number);
            if let Some(occurrence) = product.and_then(|p| p.occurrences.get_mut(place)) {
                occurrence.pose = Some(pose);
            }
        }
        Ok(())
    }

    /// True where a representation (by its number) is one of those of a product.
    fn shows(&self, product: u64, representation: u64) -> bool {
        self.all.get(&product).is_some_and(|product| {
            let mut shown = product.representations.iter();
            shown.any(|r| r.number() == representation)
        })
    }

    /// Which representations and mapped items belong to which products and components.
    pub fn owners(&self) -> Owners {
        let mut representations = BTreeMap::new();
        for (number, product) in &self.all {
            for shown in &product.representations {
                representations.insert(shown.number(), *number);
            }
        }
        Owners {
            representations,
            mapped_items: self.mapped_items.clone(),
        }
    }

    /// The products that are nobody's components, in the order of their numbers.
    pub fn roots(&self) -> Vec<u64> {
        let children: BTreeSet<u64> = self
            .all
            .values()
            .flat_map(|product| product.occurrences.iter().map(|o| o.child))
            .collect();
        let numbers = self.all.keys().copied();
        numbers.filter(|n| !children.contains(n)).collect()
    }

    /// Takes away products whose components are all taken away: what remains contains itself.
    fn refuse_cycles(&self) -> Result<(), StepError> {
        let mut missing: BTreeMap<u64, usize> = BTreeMap::new();
        let mut parents: BTreeMap<u64, Vec<u64>> = BTreeMap::new();
        for (number, product) in &self.all {
            missing.insert(*number, product.occurrences.len());
            for occurrence in &product.occurrences {
                parents.entry(occurrence.child).or_default().push(*number);
            }
        }
        let whole = |(number, count): (&u64, &usize)| (*count == 0).then_some(*number);
        let mut open: Vec<u64> = missing.iter().filter_map(whole).collect();
        while let Some(number) = open.pop() {
            for parent in parents.get(&number).into_iter().flatten() {
                if let Some(count) = missing.get_mut(parent) {
                    *count = count.saturating_sub(1);
                    if *count == 0 {
                        open.push(*parent);
                    }
                }
            }
        }
        for (number, _) in missing.iter().filter(|(_, count)| **count > 0) {
            let product = self.all.get(number);
            let inside =
                |o: &&Occurrence<'_>| missing.get(&o.child).is_some_and(|count| *count > 0);
            if let Some(occurrence) = product.and_then(|p| p.occurrences.iter().find(inside)) {
                return Err(occurrence.usage.error(Problem::Cycle {
                    what: "assemblies (occurrences of products)",
                }));
            }
        }
        Ok(())
    }
}

/// The PRODUCT_DEFINITIONs of a file with the names of their products.
fn definitions<'e>(file: &'e Exchange<'e>) -> Result<BTreeMap<u64, Product<'e>>, StepError> {
    let mut all = BTreeMap::new();
    for keyword in [
        "PRODUCT_DEFINITION",
        "PRODUCT_DEFINITION_WITH_ASSOCIATED_DOCUMENTS",
    ] {
        for record in file.of_type(keyword) {
            all.insert(
                record.number(),
                Product {
                    definition: record.instance(),
                    name: product_name(record)?,
                    representations: Vec::new(),
                    occurrences: Vec::new(),
                },
            );
        }
    }
    Ok(all)
}

/// The name of the product of a PRODUCT_DEFINITION, its identifier where it has no name.
fn product_name(definition: Record<'_>) -> Result<String, StepError> {
    let formation = definition.entity_at(2)?;
    let formation = formation
        .leaves()
        .find(|leaf| leaf.len() >= 3)
        .ok_or_else(|| formation.wrong_kind("PRODUCT_DEFINITION_FORMATION"))?;
    let product = formation.entity_at(2)?.expect("PRODUCT", "PRODUCT")?;
    let names = [product.text_at(1), product.text_at(0)];
    let named = names.into_iter().find(|name| !name.trim().is_empty());
    Ok(named.unwrap_or_else(|| format!("#{}", product.number())))
}

/// What a PRODUCT_DEFINITION_SHAPE is the shape of; `None` for other properties.
fn defined(shape: Instance<'_>) -> Result<Option<Instance<'_>>, StepError> {
    let record = shape
        .leaf("PRODUCT_DEFINITION_SHAPE")
        .filter(|leaf| leaf.len() >= 3)
        .or_else(|| shape.leaf("PROPERTY_DEFINITION"));
    match record {
        Some(record) if record.len() >= 3 => record.entity_at(2).map(Some),
        _ => Ok(None),
    }
}

/// The relationship between representations that places each occurrence, by the occurrence's number.
fn placements<'e>(file: &'e Exchange<'e>) -> Result<BTreeMap<u64, Instance<'e>>, StepError> {
    let mut placements = BTreeMap::new();
    for record in file.of_type("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION") {
        let (relation, shape) = (record.entity_at(0)?, record.entity_at(1)?);
        if let Some(usage) = defined(shape)? {
            let twice = placements.insert(usage.number(), relation);
            if twice.is_some_and(|other: Instance<'_>| other.number() != relation.number()) {
                return Err(record.instance().geometry(
                    "one place for every occurrence",
                    format!("a second one for #{}", usage.number()),
                ));
            }
        }
    }
    Ok(placements)
}

/// A mapped item: its number, the number of what it repeats, and where.
struct PlacedItem {
    number: u64,
    source: u64,
    pose: Pose,
}

/// The mapped items among what shows a product.
fn placed_items(product: &Product<'_>) -> Result<Vec<PlacedItem>, StepError> {
    let mut items = Vec::new();
    for instance in &product.representations {
        let record = expect_representation(*instance)?;
        for item in record.entities_at(1)? {
            if let Some(mapped_item) = item.leaf("MAPPED_ITEM") {
                let units = Units::of_representation(record)?;
                let (source, pose) = mapped(mapped_item, &units)?;
                items.push(PlacedItem {
                    number: item.number(),
                    source: source.number(),
                    pose,
                });
            }
        }
    }
    Ok(items)
}

/// Representations that belong to no product and are nobody's mapped item, for files that have no products.
pub(crate) fn loose_representations<'e>(
    file: &'e Exchange<'e>,
) -> Result<Vec<Instance<'e>>, StepError> {
    let mut repeated = BTreeSet::new();
    for map in file.of_type("REPRESENTATION_MAP") {
        repeated.insert(map.entity_at(1)?.number());
    }
    let shows_shape = |instance: &Instance<'_>| {
        representation(*instance).is_some_and(|r| r.keyword().ends_with("SHAPE_REPRESENTATION"))
            && !repeated.contains(&instance.number())
    };
    Ok(file.instances().filter(shows_shape).collect())
}
