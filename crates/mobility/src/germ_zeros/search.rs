//! Collecting the zeros on the outer sphere and sorting them into curves and sheets.

use super::correct::{Landing, Within, land};
use super::deflate::deflated;
use super::local::{Local, local, more_regular};
use super::plane;
use super::sheets::Sheets;
use super::small::{distance, plus, unit};
use super::system::{Level, System, Work};
use super::track::{Track, follow, inwards};
use super::{GermZeroOptions, small};
use kutzbach_math::matrix::SplitMix64;

/// A half-branch of dimension 1.
#[derive(Clone, Debug)]
pub(super) struct Half {
    pub(super) track: Track,
    pub(super) reduced: bool,
    pub(super) hits: usize,
    /// Points closer than this are the same.
    pub(super) same: f64,
}

/// What has been found so far.
pub(super) struct Search<'a> {
    pub(super) system: &'a System,
    pub(super) radii: Vec<f64>,
    pub(super) halves: Vec<Half>,
    pub(super) sheets: Vec<Sheets>,
    /// Zeros on the outer sphere that do not lead to the origin.
    strangers: Vec<Vec<f64>>,
    pub(super) starts: usize,
    pub(super) doubts: Vec<String>,
    /// Whether zeros were found at an inner radius that are not there at the outer one.
    pub(super) varies: bool,
    pub(super) random: SplitMix64,
    pub(super) work: Work,
}

impl<'a> Search<'a> {
    pub(super) fn new(system: &'a System, options: &GermZeroOptions) -> Self {
        Self {
            system,
            radii: ladder(system, options.outermost),
            halves: Vec::new(),
            sheets: Vec::new(),
            strangers: Vec::new(),
            starts: 0,
            doubts: Vec::new(),
            varies: false,
            random: SplitMix64::new(options.seed),
            work: Work::default(),
        }
    }

    /// Finds all classes of zeros at the outer radius, and checks them against those at a smaller one.
    pub(super) fn run(&mut self, options: &GermZeroOptions) {
        let level = Level::new(self.system, self.radii[0]);
        if self.system.variables() == 2 {
            self.scan(0);
            self.scan(2);
            return;
        }
        let mut last_new = 0;
        let mut queue: Vec<Vec<f64>> = Vec::new();
        loop {
            let lonely = self.halves.iter().any(|half| half.hits < 2);
            let enough = self.starts >= options.fewest_starts.max(2 * last_new) && !lonely;
            if enough || self.starts >= options.most_starts || self.system.left() == 0 {
                if !enough {
                    self.doubts.push(format!(
                        "{} starts were not enough to find every class of zeros twice",
                        self.starts
                    ));
                }
                break;
            }
            let start = match queue.pop() {
                Some(start) => start,
                None => self.next_start(),
            };
            self.starts += 1;
            let landed = land(&level, &start, &Within::Sphere, 80, &mut self.work);
            let landed = self.settled(&level, landed);
            if self.sort(&level, &landed) {
                last_new = self.starts;
                queue.push(landed.z.iter().map(|x| -x).collect());
            }
        }
        let level = Level::new(self.system, self.radii[2]);
        for _ in 0..self.starts / 3 {
            if self.system.left() == 0 {
                return;
            }
            let start = self.next_start();
            let landed = land(&level, &start, &Within::Sphere, 80, &mut self.work);
            let landed = self.settled(&level, landed);
            self.sort_inner(&level, 2, &landed);
        }
    }

    fn next_start(&mut self) -> Vec<f64> {
        let variables = self.system.variables();
        let direction = random_direction(variables, &mut self.random);
        let known: Vec<&Vec<f64>> = self
            .halves
            .iter()
            .map(|half| &half.track.z[0])
            .chain(
                self.sheets
                    .iter()
                    .flat_map(|s| s.members.iter().map(|m| &m.z)),
            )
            .collect();
        match self.starts % 4 {
            // A zero of the leading forms: the equations at a radius where nothing else counts.
            1 => {
                let level = Level::new(self.system, 1e-3 * self.radii[0]);
                let cone = land(&level, &direction, &Within::Sphere, 15, &mut self.work).z;
                let by = random_direction(variables, &mut self.random);
                unit(plus(&cone, 0.02, &by))
            }
            // Branches that are tangent to a known one hide close to it.
            3 if !known.is_empty() => {
                let pick = (self.random.next_u64() % known.len() as u64) as usize;
                let scale = [0.5, 0.2, 0.05][(self.random.next_u64() % 3) as usize];
                unit(plus(known[pick], scale, &direction))
            }
            _ => direction,
        }
    }

    /// All zeros on a circle of the plane.
    fn scan(&mut self, at: usize) {
        let radius = self.radii[at];
        let level = Level::new(self.system, radius);
        for (from, z) in plane::candidates(self.system, radius, &mut self.random) {
            self.starts += 1;
            let there = Level::new(self.system, from);
            let landed = land(&there, &z, &Within::Sphere, 80, &mut self.work);
            let landed = self.settled(&there, landed);
            if landed.above_truncation > 1.0 {
                continue;
            }
            let kind = local(&there, &landed, &mut self.random, &mut self.work);
            let rank = kind.reduced.then_some(1);
            let moved = follow(self.system, &landed.z, from, radius, rank, &mut self.work);
            if let Some(moved) = moved {
                if at == 0 {
                    self.sort(&level, &moved);
                } else {
                    self.sort_inner(&level, at, &moved);
                }
            }
        }
    }

    /// A point where the equations are too large for noise but small enough for terms that were cut off may be a saddle
    /// between two zeros: kicked away from it, the search goes on.
    fn settled(&mut self, level: &Level<'_>, landed: Landing) -> Landing {
        if landed.above_noise <= 1.0 || landed.above_truncation > 1.0 {
            return landed;
        }
        if let Some(multiple) = deflated(level, &landed, &mut self.work) {
            return multiple;
        }
        // Zeros of multiplicity two are as far away as the root of the values.
        let reach = (4.0 * landed.size.sqrt()).min(0.1);
        let mut best = landed;
        for _ in 0..4 {
            let by = random_direction(best.z.len(), &mut self.random);
            let start = unit(plus(&best.z, reach, &by));
            let again = land(level, &start, &Within::Sphere, 80, &mut self.work);
            if again.size < 0.5 * best.size && distance(&again.z, &best.z) < 4.0 * reach {
                best = again;
            }
        }
        best
    }

    /// Puts a landing on the outer sphere where it belongs; whether it is something new.
    fn sort(&mut self, level: &Level<'_>, landed: &Landing) -> bool {
        if landed.above_truncation > 1.0 {
            return false;
        }
        if let Some(half) = self
            .halves
            .iter_mut()
            .find(|half| distance(&half.track.z[0], &landed.z) <= half.same)
        {
            half.hits += 1;
            return false;
        }
        if self.strangers.iter().any(|z| distance(z, &landed.z) < 1e-4) {
            return false;
        }
        let mut landed = landed.clone();
        let mut kind = local(level, &landed, &mut self.random, &mut self.work);
        if !kind.reduced
            && let Some(regular) =
                more_regular(level, &landed, kind.rank, &mut self.random, &mut self.work)
        {
            self.strangers.push(landed.z);
            landed = regular;
            kind = local(level, &landed, &mut self.random, &mut self.work);
        }
        let landed = &landed;
        let rank = kind
            .reduced
            .then_some(self.system.variables() - kind.dimension);
        if kind.dimension == 1 {
            let Some(track) = inwards(self.system, &self.radii, landed, rank, &mut self.work)
            else {
                self.strangers.push(landed.z.clone());
                return false;
            };
            self.halves.push(Half {
                track,
                reduced: kind.reduced,
                hits: 1,
                same: same_point(level, landed, &kind),
            });
            return true;
        }
        self.sort_sheet(level, landed, kind, rank)
    }

    fn sort_sheet(
        &mut self,
        level: &Level<'_>,
        landed: &Landing,
        kind: Local,
        rank: Option<usize>,
    ) -> bool {
        let slot = self
            .sheets
            .iter()
            .position(|s| s.dimension == kind.dimension);
        let slot = slot.unwrap_or_else(|| {
            self.sheets.push(Sheets::new(kind.dimension));
            self.sheets.len() - 1
        });
        let reached = self.sheets[slot].reached(
            level,
            &landed.z,
            &kind.tangent,
            kind.reduced,
            &mut self.work,
        );
        if reached.is_empty()
            && inwards(self.system, &self.radii, landed, rank, &mut self.work).is_none()
        {
            self.strangers.push(landed.z.clone());
            return false;
        }
        self.sheets[slot].add(landed.z.clone(), kind, &reached)
    }

    /// A landing at an inner radius: a half-branch that was missed at the outer one is followed outwards.
    fn sort_inner(&mut self, level: &Level<'_>, at: usize, landed: &Landing) {
        let known = |half: &Half| distance(&half.track.z[at], &landed.z) <= half.same;
        if landed.above_truncation > 1.0 || self.halves.iter().any(known) {
            return;
        }
        let kind = local(level, landed, &mut self.random, &mut self.work);
        let singular = !kind.reduced
            && more_regular(level, landed, kind.rank, &mut self.random, &mut self.work).is_some();
        if singular {
            return;
        }
        if kind.dimension > 1 {
            if self.sheets.iter().all(|s| s.dimension != kind.dimension) {
                self.varies = true;
                self.doubts.push(format!(
                    "zeros of dimension {} were found at radius {:.2e} only",
                    kind.dimension, level.radius
                ));
            }
            return;
        }
        let rank = kind.reduced.then(|| self.system.variables() - 1);
        let inner = inwards(self.system, &self.radii[at..], landed, rank, &mut self.work);
        if inner.is_none() {
            return;
        }
        let outer = Level::new(self.system, self.radii[0]);
        let before = self.halves.len();
        let followed = follow(
            self.system,
            &landed.z,
            level.radius,
            self.radii[0],
            rank,
            &mut self.work,
        );
        if let Some(outside) = followed {
            self.sort(&outer, &outside);
        }
        if self.halves.len() == before && !self.halves.iter().any(known) {
            self.varies = true;
            self.doubts.push(format!(
                "a half-branch found at radius {:.2e} was not found at {:.2e}",
                level.radius, self.radii[0]
            ));
        }
    }

    /// Directions in which the equations are smallest at one radius, and the norm there.
    pub(super) fn smallest(
        &mut self,
        radius: f64,
        starts: usize,
        hints: &[Vec<f64>],
    ) -> (f64, Vec<f64>) {
        let level = Level::new(self.system, radius);
        let mut guesses = hints.to_vec();
        if self.system.variables() == 2 {
            let found = plane::candidates(self.system, radius, &mut self.random);
            guesses.extend(found.into_iter().map(|(_, z)| z));
        }
        while self.system.variables() > 2 && guesses.len() < starts {
            guesses.push(random_direction(self.system.variables(), &mut self.random));
        }
        let mut best = (f64::INFINITY, Vec::new());
        for guess in guesses {
            let landed = land(&level, &guess, &Within::Sphere, 60, &mut self.work);
            level.evaluate(&landed.z, &mut self.work);
            let size = level.absolute(&self.work.values);
            if size < best.0 {
                best = (size, landed.z);
            }
        }
        best
    }
}

/// Within which distance two zeros on the sphere are one: the accuracy with which they are known. A simple zero is known
/// to (accuracy of the values)/(smallest singular value), a zero of multiplicity up to three to the cube root of it.
fn same_point(level: &Level<'_>, landed: &Landing, kind: &Local) -> f64 {
    let accuracy = level.tolerance().max(landed.size);
    if kind.reduced {
        (100.0 * accuracy / kind.smallest).clamp(1e-7, 1e-3)
    } else {
        (10.0 * accuracy.cbrt()).min(0.02)
    }
}

/// The radii, outermost first.
///
/// The outermost leaves the terms beyond the truncation degree K about 1e-4 of the quadratic ones, but is at most a
/// fifth of the radius at which the higher degrees outweigh the lowest. The innermost is as small as the noise allows if
/// a term of degree K is still to be told from zero.
pub(super) fn ladder(system: &System, outermost: f64) -> Vec<f64> {
    const COUNT: usize = 7;
    let (lowest, _) = system.lowest();
    let span = (system.degree() + 1 - lowest).max(1) as f64;
    let outer =
        (system.radius * 1e-4_f64.powf(1.0 / span.max(2.0)).clamp(0.02, 0.2)).min(outermost);
    let tolerance = Level::new(system, outer).tolerance();
    let noisy = system.radius * (1e3 * tolerance).powf(1.0 / span);
    let inner = noisy.clamp(outer / 24.0, outer / 4.0);
    (0..COUNT)
        .map(|i| outer * (inner / outer).powf(i as f64 / (COUNT - 1) as f64))
        .collect()
}

/// A direction drawn evenly enough: sums of four uniform numbers are close to normal.
pub(super) fn random_direction(variables: usize, random: &mut SplitMix64) -> Vec<f64> {
    let direction = (0..variables)
        .map(|_| (0..4).map(|_| random.symmetric()).sum())
        .collect();
    small::unit(direction)
}
