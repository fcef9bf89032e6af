//! Products of displacements along paths, cut where the two halves weigh the same.

use super::displacement::Displacement;
use super::error::SystemError;
use super::field::Field;
use super::implicit::Implicit;
use super::model::JointModel;
use super::poly::Poly;
use super::space::{Polynomials, Pose, subtract};

/// Most terms of one pose.
const MAX_TERMS: usize = 60_000;

/// Most products of terms that one equation between two poses may take where nothing is said.
pub(super) const MAX_PRODUCTS: u64 = 4_000_000;

/// Products of terms that a direction of one link with a way between both takes at most.
fn products(one: &Pose<Poly>, other: &Pose<Poly>) -> usize {
    let terms = |entries: &mut dyn Iterator<Item = &Poly>| entries.map(|p| p.terms().len()).sum();
    let [a, b]: [usize; 2] = [one, other].map(|p| terms(&mut p.rotation.iter().flatten()));
    let [s, t]: [usize; 2] = [one, other].map(|p| terms(&mut p.translation.iter()));
    // A direction is a combination of three entries of a row.
    (a.max(b) / 3).saturating_mul(s + t)
}

/// Joints in order, each with whether it is passed from predecessor to successor.
pub(super) type Path = [(usize, bool)];

/// What a walk needs to know.
pub(super) struct Walker<'a> {
    pub(super) field: &'a Field,
    pub(super) models: &'a [JointModel],
    pub(super) displacements: &'a [Displacement],
    pub(super) unoriented: bool,
    /// Most products of terms that one equation between two poses may take.
    pub(super) most_products: u64,
}

impl Walker<'_> {
    /// The pose of a path's last link in its first.
    pub(super) fn walk(
        &self,
        path: impl Iterator<Item = (usize, bool)>,
    ) -> Result<Pose<Poly>, SystemError> {
        let mut place = Pose::identity(&Polynomials(self.field));
        for (joint, forward) in path {
            place =
                self.displacements[joint].pass(self.field, &self.models[joint], &place, forward);
            let entries = place.rotation.iter().flatten().chain(&place.translation);
            if entries.map(|p| p.terms().len()).sum::<usize>() > MAX_TERMS {
                return Err(SystemError::TooLarge {
                    what: "a cycle".to_owned(),
                    limit: MAX_TERMS,
                });
            }
        }
        Ok(place)
    }

    fn weight(&self, path: &Path) -> usize {
        path.iter()
            .map(|(joint, _)| self.displacements[*joint].variables.len())
            .sum()
    }

    /// The closure of a cycle as (left half) − (right half), twelve entries row by row, the translation last in each row.
    /// Start and cut are those that make the halves' weights most equal, the first such.
    pub(super) fn closure(&self, cycle: &Path) -> Result<Vec<Poly>, SystemError> {
        let count = cycle.len();
        let total = self.weight(cycle);
        let mut best = (usize::MAX, 0, 1);
        for start in 0..count {
            let mut left = 0;
            for cut in 1..count {
                left += self.weight(&[cycle[(start + cut - 1) % count]]);
                let off = (2 * left).abs_diff(total);
                if off < best.0 {
                    best = (off, start, cut);
                }
            }
        }
        let (_, start, cut) = best;
        let at = |step: usize| cycle[(start + step) % count];
        let left = self.walk((0..cut).map(at))?;
        let right = self.walk((cut..count).rev().map(at).map(|(joint, f)| (joint, !f)))?;
        let ring = Polynomials(self.field);
        let offset = subtract(&ring, &left.translation, &right.translation);
        let mut entries = Vec::with_capacity(12);
        for (i, off) in offset.into_iter().enumerate() {
            entries.extend(subtract(&ring, &left.rotation[i], &right.rotation[i]));
            entries.push(off);
        }
        Ok(entries)
    }

    /// What one joint of a cycle asks of its two links, whose poses are products along the rest of the cycle from a link
    /// in its middle.
    pub(super) fn implicit(&self, cycle: &Path, place: usize) -> Result<Vec<Poly>, SystemError> {
        let count = cycle.len();
        let (joint, forward) = cycle[place];
        let path: Vec<(usize, bool)> = (1..count).map(|i| cycle[(place + i) % count]).collect();
        let total = self.weight(&path);
        let middle = (0..=path.len())
            .min_by_key(|&cut| (2 * self.weight(&path[..cut])).abs_diff(total))
            .unwrap_or(0);
        let after = self.walk(path[..middle].iter().rev().map(|&(j, f)| (j, !f)))?;
        let before = self.walk(path[middle..].iter().copied())?;
        let (predecessor, successor) = if forward {
            (&before, &after)
        } else {
            (&after, &before)
        };
        let model = &self.models[joint];
        if model.multiplies_poses(self.unoriented)
            && products(predecessor, successor) as u64 > self.most_products
        {
            return Err(SystemError::TooManyProducts {
                what: "a cycle".to_owned(),
                limit: self.most_products,
            });
        }
        Ok(Implicit {
            field: self.field,
            model,
            predecessor,
            successor,
            unoriented: self.unoriented,
        }
        .equations())
    }
}
