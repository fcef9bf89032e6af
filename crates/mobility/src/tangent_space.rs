//! The tangent space of a branch at one of its poses, and how far its numbers can be trusted.
//!
//! What moves along a branch is read off the tangents of a few of its poses: a component that is zero at all of them is a
//! freedom that rests. None of the zeros is exact, so each reading needs to know how far a tangent can be from the true
//! one ([`Limits`]).
//!
//! # The error of a tangent
//! At a pose where the closure equations of a part are known to within ε (their rounding, what the file's precision
//! leaves open, what is left of their residual, and what is left of the equations for the tangents given), a null vector
//! of their Jacobian is off by ε/σ with σ its smallest kept singular value (Wedin 1972), all relative to the largest.
//! That needs the tangents to *be* its null space. Where it is larger, as along a permanently shaky branch, the equations
//! have a double zero: a residual of ε leaves the pose itself uncertain by √ε, its screws too, and a tangent by √ε/σ, where
//! singular values up to √ε count as zero.
//!
//! Cost: one rank decision for every part and, for `d` tangents of a part with `n` components each, `n d²` operations.

use super::branch::{BranchPose, Tangent};
use super::one_sided::{dot, norm};
use super::pose_rank::known_to;
use kutzbach_closure::Structure;
use kutzbach_closure::{Geometry, Part, jacobian, least_length};
use kutzbach_math::matrix::{MatrixError, RankDecision, Real, SparseMatrix, decide_each};
use kutzbach_model::mechanism::{FreedomPart, Mechanism};
use petgraph::unionfind::UnionFind;

/// What counts as rest and what as motion among numbers that come from unit tangents.
///
/// Up to ten times the error a magnitude is zero, from a thousand times the error on it is not, and between it is
/// doubtful: the rule of [`kutzbach_math::matrix::coloops`]. Components of a unit vector of length n are of the order of a share,
/// 1/√n. However coarse the numbers, three ten-thousandths of a share are not called zero: lead screws and gears move joints by
/// a thousandth of others. Whatever exceeds both a hundredth of a share and three errors is called motion. An error beyond a third of a share leaves only exact zeros.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Bound on the error of a unit vector.
    pub error: f64,
    rest: f64,
    moves: f64,
}

impl Limits {
    pub fn new(error: f64, length: usize) -> Self {
        let share = 1.0 / (length.max(1) as f64).sqrt();
        // Written so that an error that is not a number is hopeless.
        if !(error <= share / 3.0) {
            return Self {
                error,
                rest: 0.0,
                moves: f64::INFINITY,
            };
        }
        Self {
            error,
            rest: (10.0 * error).min(3e-4 * share),
            moves: (1e3 * error).min((1e-2 * share).max(3.0 * error)),
        }
    }

    /// Whether a magnitude is motion (`Some(true)`), rest (`Some(false)`), or neither for certain.
    pub fn moves(&self, magnitude: f64) -> Option<bool> {
        if magnitude <= self.rest {
            Some(false)
        } else if magnitude >= self.moves {
            Some(true)
        } else {
            None
        }
    }

    /// How many singular values are not zero; `None` where one is doubtful.
    pub fn rank(&self, values: &[f64]) -> Option<usize> {
        values
            .iter()
            .map(|value| self.moves(*value).map(usize::from))
            .sum()
    }
}

/// Tangent spaces whose bases take more operations than this are not worked out.
const MOST_WORK: usize = 2_000_000_000;

/// An orthonormal basis of the tangent space, rotations in radians and translations in lengths of their part.
///
/// Tangents that have no variable in common are orthogonal as they are: the basis is made of groups, one for every part that
/// moves and every free joint at least, and nothing is stored or computed across groups.
#[derive(Clone, Debug)]
pub(super) struct TangentSpace {
    groups: Vec<Group>,
    /// Group and place therein of every variable that moves.
    place: Vec<Place>,
    /// Group and place therein of every basis vector.
    home: Vec<(usize, usize)>,
    /// Limits for what comes from all components together.
    pub limits: Limits,
    /// Bound on the error of a unit vector where the numbers are taken as they are written; infinite where the tangents are not all of
    /// the kernel then.
    pub as_written: f64,
    /// First variable of every joint, and the number of all.
    first: Vec<usize>,
    /// Radians or metres per unit of every variable.
    units: Vec<f64>,
    joint_limits: Vec<Limits>,
}

/// Group of a variable and its place therein; `None` for one that nothing moves.
type Place = Option<(usize, usize)>;

/// Basis vectors that have variables in common.
#[derive(Clone, Debug)]
struct Group {
    /// The variables that these vectors move, increasing.
    variables: Vec<usize>,
    /// Indices of the vectors, increasing.
    vectors: Vec<usize>,
    /// The vectors, one component for each of the variables.
    basis: Vec<Vec<f64>>,
}

/// The components of one variable along the vectors of its group; all others are zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row<'a> {
    /// Indices of the vectors, increasing.
    pub vectors: &'a [usize],
    group: Option<(&'a Group, usize)>,
}

impl Row<'_> {
    /// One component for each of the vectors.
    pub fn values(&self) -> impl Iterator<Item = f64> {
        let columns = self.group.into_iter();
        columns.flat_map(|(group, at)| group.basis.iter().map(move |vector| vector[at]))
    }
}

impl TangentSpace {
    /// `None` where numbers leave their range, the pose belongs to another mechanism, or the work would be too much.
    ///
    /// Joints in no loop and no coupling move on every branch: where the tangents leave such a freedom out it is added.
    pub fn at(
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        structure: &Structure,
        pose: &BranchPose,
    ) -> Option<Self> {
        let first = mechanism.variable_offsets();
        let count = mechanism.freedom();
        if pose.tangents.iter().any(|t| t.variables() != count) {
            return None;
        }
        let mut units = vec![1.0; count];
        let mut equations = Vec::with_capacity(structure.parts.len());
        for part in &structure.parts {
            let found = PartEquations::at(mechanism, geometry, pose, part).ok()?;
            set_units(mechanism, &part.joints, found.length, &first, &mut units);
            equations.push(found);
        }
        // Nothing measures a free slider: the size of what is free does as well as any length.
        let moving = structure.free_joints.iter().copied();
        let size = geometry.size_of(moving.filter(|&j| mechanism.joints()[j].freedom() > 0));
        let size = if size > least_length(size) { size } else { 1.0 };
        set_units(mechanism, &structure.free_joints, size, &first, &mut units);
        let mut tangents = pose.tangents.clone();
        let mut moved = vec![false; count];
        for (variable, _) in tangents.iter().flat_map(Tangent::entries) {
            moved[*variable] = true;
        }
        for &joint in &structure.free_joints {
            let left_out = (first[joint]..first[joint + 1]).filter(|&variable| !moved[variable]);
            tangents.extend(left_out.map(|v| Tangent::new(count, [(v, units[v])])));
        }
        let (groups, place) = grouped(&tangents, &units)?;
        let dimension = groups.iter().map(|group| group.vectors.len()).sum();
        let mut home = vec![(0, 0); dimension];
        for (index, group) in groups.iter().enumerate() {
            for (at, &vector) in group.vectors.iter().enumerate() {
                home[vector] = (index, at);
            }
        }
        let free: usize = structure
            .free_joints
            .iter()
            .map(|&joint| first[joint + 1] - first[joint])
            .sum();
        let [whole_kernel, as_written] = whole_kernels(&equations, free, dimension);
        let own = |length| Limits::new(8.0 * f64::EPSILON, length);
        let mut found = Self {
            groups,
            place,
            home,
            limits: own(count),
            as_written: if as_written {
                8.0 * f64::EPSILON
            } else {
                f64::INFINITY
            },
            joint_limits: vec![own(1); mechanism.joints().len()],
            first,
            units,
        };
        found.bound_errors(structure, &equations, whole_kernel)?;
        Some(found)
    }

    /// Limits by what the equations of each part tell of the error of a tangent.
    fn bound_errors(
        &mut self,
        structure: &Structure,
        equations: &[PartEquations],
        whole_kernel: bool,
    ) -> Option<()> {
        for (part, equations) in structure.parts.iter().zip(equations) {
            let variables: Vec<usize> = part
                .joints
                .iter()
                .flat_map(|&joint| self.variables(joint))
                .collect();
            let left = equations.left_by(self, &variables)?;
            let error = equations.tangent_error(left, whole_kernel);
            self.as_written = self.as_written.max(equations.error_as_written(left));
            // Written so that an error that is not a number stays one.
            if !(error <= self.limits.error) {
                self.limits = Limits::new(error, self.length());
            }
            for &joint in &part.joints {
                self.joint_limits[joint] = Limits::new(error, variables.len());
            }
        }
        Some(())
    }

    /// Number of basis vectors.
    pub fn dimension(&self) -> usize {
        self.home.len()
    }

    /// Number of variables of the mechanism.
    pub fn length(&self) -> usize {
        self.place.len()
    }

    /// The variables of a joint.
    pub fn variables(&self, joint: usize) -> std::ops::Range<usize> {
        self.first[joint]..self.first[joint + 1]
    }

    /// Limits for the components of a joint.
    pub fn limits_of(&self, joint: usize) -> Limits {
        self.joint_limits[joint]
    }

    /// How a variable moves along the basis.
    pub fn row(&self, variable: usize) -> Row<'_> {
        match self.place[variable] {
            None => Row {
                vectors: &[],
                group: None,
            },
            Some((group, at)) => {
                let group = &self.groups[group];
                Row {
                    vectors: &group.vectors,
                    group: Some((group, at)),
                }
            }
        }
    }

    /// Rate of a variable (rad or m) along a basis vector.
    pub fn rate(&self, vector: usize, variable: usize) -> f64 {
        self.component(vector, variable) * self.units[variable]
    }

    /// The component of a basis vector along a variable.
    fn component(&self, vector: usize, variable: usize) -> f64 {
        let (group, index) = self.home[vector];
        match self.place[variable] {
            Some((own, at)) if own == group => self.groups[group].basis[index][at],
            _ => 0.0,
        }
    }

    /// How much a variable moves in all of the tangent space: the length of its row in the basis, whichever basis it is.
    pub fn magnitude(&self, variable: usize) -> f64 {
        let row: Vec<f64> = self.row(variable).values().collect();
        norm(&row)
    }

    /// The variables that move along any vector of the groups of some vectors.
    pub fn moved_with(&self, vectors: &[usize]) -> Vec<usize> {
        let mut groups: Vec<usize> = vectors.iter().map(|&vector| self.home[vector].0).collect();
        groups.sort_unstable();
        groups.dedup();
        let variables = groups
            .iter()
            .flat_map(|&group| &self.groups[group].variables);
        let mut variables: Vec<usize> = variables.copied().collect();
        variables.sort_unstable();
        variables
    }

    /// The basis vectors that move any of some variables, or share variables with one that does, increasing.
    pub fn vectors_of(&self, variables: impl IntoIterator<Item = usize>) -> Vec<usize> {
        let places = variables
            .into_iter()
            .filter_map(|variable| self.place[variable]);
        let mut groups: Vec<usize> = places.map(|(group, _)| group).collect();
        groups.sort_unstable();
        groups.dedup();
        let vectors = groups.iter().flat_map(|&group| &self.groups[group].vectors);
        let mut vectors: Vec<usize> = vectors.copied().collect();
        vectors.sort_unstable();
        vectors
    }

    /// The components of a variable along some vectors, those of its group among them.
    pub fn components(&self, variable: usize, vectors: &[usize]) -> Vec<f64> {
        let mut components = vec![0.0; vectors.len()];
        let row = self.row(variable);
        for (vector, value) in row.vectors.iter().zip(row.values()) {
            if let Ok(at) = vectors.binary_search(vector) {
                components[at] = value;
            }
        }
        components
    }

    /// The finest sets of vectors that no variable and none of the `ties` reaches across: each increasing, and the set of every vector
    /// with its place therein.
    pub fn blocks<'a>(&self, ties: impl IntoIterator<Item = &'a [usize]>) -> Blocks {
        let mut joined = UnionFind::<usize>::new(self.groups.len());
        for tie in ties {
            for vector in tie {
                joined.union(self.home[tie[0]].0, self.home[*vector].0);
            }
        }
        let mut named = vec![usize::MAX; self.groups.len()];
        let mut blocks = Blocks {
            vectors: Vec::new(),
            place: Vec::with_capacity(self.dimension()),
        };
        for (vector, (group, _)) in self.home.iter().enumerate() {
            let name = &mut named[joined.find(*group)];
            if *name == usize::MAX {
                *name = blocks.vectors.len();
                blocks.vectors.push(Vec::new());
            }
            let block = &mut blocks.vectors[*name];
            blocks.place.push((*name, block.len()));
            block.push(vector);
        }
        blocks
    }
}

/// Basis vectors in sets that have nothing to do with one another.
#[derive(Clone, Debug)]
pub(super) struct Blocks {
    /// The vectors of every set, increasing.
    pub vectors: Vec<Vec<usize>>,
    /// Set and place therein of every vector.
    pub place: Vec<(usize, usize)>,
}

fn set_units(
    mechanism: &Mechanism,
    joints: &[usize],
    length: f64,
    first: &[usize],
    units: &mut [f64],
) {
    for &joint in joints {
        let freedoms = mechanism.joints()[joint].kind.freedoms();
        for (unit, part) in units[first[joint]..].iter_mut().zip(freedoms) {
            if *part == FreedomPart::Translation {
                *unit = length;
            }
        }
    }
}

/// Whether tangents of this dimension are the whole kernel of the equations, as the numbers stand for it and as they are written.
fn whole_kernels(equations: &[PartEquations], free: usize, dimension: usize) -> [bool; 2] {
    let freedom = |kernel: fn(&PartEquations) -> &Kernel| {
        let nullities = equations.iter().map(|part| kernel(part).nullity);
        nullities.sum::<Option<usize>>().map(|sum| sum + free)
    };
    let whole = |simple, multiple| {
        freedom(simple) == Some(dimension)
            && freedom(multiple).is_none_or(|freedom| freedom == dimension)
    };
    [
        whole(|part| &part.simple, |part| &part.multiple),
        whole(|part| &part.as_written[0], |part| &part.as_written[1]),
    ]
}

/// The closure equations of a part at a pose, as far as they tell how good a tangent is.
struct PartEquations {
    length: f64,
    /// What the equations are uncertain by.
    uncertainty: f64,
    /// The kernel if the equations have a simple zero here, and if they have a double one.
    simple: Kernel,
    multiple: Kernel,
    /// What they are uncertain by as they are written, and both kernels then.
    rounding: f64,
    as_written: [Kernel; 2],
    matrix: SparseMatrix<f64>,
}

/// What a rank decision says of the kernel.
#[derive(Clone, Copy)]
struct Kernel {
    /// Smallest kept singular value, relative to the largest.
    kept: f64,
    nullity: Option<usize>,
}

impl From<&RankDecision> for Kernel {
    fn from(decision: &RankDecision) -> Self {
        Self {
            kept: if decision.kept > 0.0 {
                decision.kept.min(1.0)
            } else {
                1.0
            },
            nullity: decision.nullity(),
        }
    }
}

impl PartEquations {
    fn at(
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        pose: &BranchPose,
        part: &Part,
    ) -> Result<Self, MatrixError> {
        let here = jacobian(mechanism, geometry, &pose.states, part)?;
        let (stated, rounding, coarse) = known_to(&here);
        let residual = 0.0.norm(&here.residual);
        let uncertainty = rounding + residual + if coarse { 0.0 } else { stated };
        let mut scaled = here.matrix.clone();
        scaled.scale_columns();
        let written = rounding + residual;
        let mut accuracies = vec![uncertainty, uncertainty.sqrt()];
        if written < uncertainty {
            accuracies.extend([written, written.sqrt()]);
        }
        let found = decide_each(&scaled, &accuracies)?;
        let kernels: Vec<Kernel> = found.iter().map(Kernel::from).collect();
        let [simple, multiple] = [kernels[0], kernels[1]];
        let as_written = [kernels[kernels.len() - 2], kernels[kernels.len() - 1]];
        Ok(Self {
            length: here.length,
            uncertainty,
            simple,
            multiple,
            rounding: written,
            as_written,
            matrix: here.matrix,
        })
    }

    /// What is left of the equations for unit tangents in the components of this part, whose variables are given in the order of its
    /// columns.
    fn left_by(&self, tangents: &TangentSpace, variables: &[usize]) -> Option<f64> {
        let mut left: f64 = 0.0;
        for vector in tangents.vectors_of(variables.iter().copied()) {
            let own: Vec<f64> = variables
                .iter()
                .map(|&variable| tangents.component(vector, variable))
                .collect();
            left = left.max(norm(&self.matrix.multiply(&own).ok()?));
        }
        Some(left)
    }

    /// The error of such tangents.
    fn tangent_error(&self, left: f64, whole_kernel: bool) -> f64 {
        let uncertainty = self.uncertainty + left;
        if whole_kernel {
            uncertainty / self.simple.kept
        } else {
            uncertainty.sqrt() / self.multiple.kept
        }
    }

    /// The same of the whole kernel of the equations as they are written.
    fn error_as_written(&self, left: f64) -> f64 {
        (self.rounding + left) / self.as_written[0].kept
    }
}

/// An orthonormal basis of the span of some tangents, in units of every variable: its groups, and group and place therein of every
/// variable. `None` where numbers are not finite, or the work would be too much.
fn grouped(tangents: &[Tangent], units: &[f64]) -> Option<(Vec<Group>, Vec<Place>)> {
    let mut joined = UnionFind::<usize>::new(units.len());
    for tangent in tangents {
        for pair in tangent.entries().windows(2) {
            joined.union(pair[0].0, pair[1].0);
        }
    }
    // Groups in the order of their first tangents, with the indices of these.
    let mut group_of = vec![usize::MAX; units.len()];
    let mut members: Vec<Vec<usize>> = Vec::new();
    for (index, tangent) in tangents.iter().enumerate() {
        let Some((variable, _)) = tangent.entries().first() else {
            continue;
        };
        let group = &mut group_of[joined.find(*variable)];
        if *group == usize::MAX {
            *group = members.len();
            members.push(Vec::new());
        }
        members[*group].push(index);
    }
    let mut variables = vec![Vec::new(); members.len()];
    let mut place = vec![None; units.len()];
    for (variable, place) in place.iter_mut().enumerate() {
        let group = group_of[joined.find(variable)];
        if let Some(own) = variables.get_mut(group) {
            *place = Some((group, own.len()));
            own.push(variable);
        }
    }
    let work = members
        .iter()
        .zip(&variables)
        .map(|(members, own)| own.len().saturating_mul(members.len() * members.len()));
    if work.fold(0, usize::saturating_add) > MOST_WORK {
        return None;
    }
    // The vectors are counted in the order of the tangents that they come from.
    let mut came_from = Vec::new();
    let mut groups = Vec::with_capacity(members.len());
    for (group, (members, variables)) in members.into_iter().zip(variables).enumerate() {
        let vectors = members.iter().map(|&index| {
            let mut vector = vec![0.0; variables.len()];
            for &(variable, rate) in tangents[index].entries() {
                if let Some((_, at)) = place[variable] {
                    vector[at] = rate / units[variable];
                }
            }
            vector
        });
        let (kept, basis): (Vec<usize>, _) =
            orthonormalised(vectors.collect())?.into_iter().unzip();
        came_from.extend(kept.iter().map(|&kept| (members[kept], group)));
        groups.push(Group {
            variables,
            vectors: Vec::with_capacity(kept.len()),
            basis,
        });
    }
    came_from.sort_unstable();
    for (vector, (_, group)) in came_from.into_iter().enumerate() {
        groups[group].vectors.push(vector);
    }
    Some((groups, place))
}

/// Gram–Schmidt, each vector twice (Giraud, Langou & Rozložník 2005); what is left of a dependent vector is dropped. The vectors
/// kept are given with their indices; `None` where numbers are not finite.
fn orthonormalised(vectors: Vec<Vec<f64>>) -> Option<Vec<(usize, Vec<f64>)>> {
    let mut basis: Vec<(usize, Vec<f64>)> = Vec::with_capacity(vectors.len());
    for (index, mut vector) in vectors.into_iter().enumerate() {
        let largest = vector.iter().fold(0.0f64, |m, x| m.max(x.abs()));
        if !vector.iter().all(|x| x.is_finite()) {
            return None;
        }
        if largest == 0.0 {
            continue;
        }
        vector.iter_mut().for_each(|x| *x /= largest);
        let before = norm(&vector);
        for _ in 0..2 {
            for (_, done) in &basis {
                let along = dot(done, &vector);
                if along != 0.0 {
                    vector
                        .iter_mut()
                        .zip(done)
                        .for_each(|(x, y)| *x -= along * y);
                }
            }
        }
        let left = norm(&vector);
        // Half of the digits have to survive for the rest to be a direction.
        if left > 1e-8 * before {
            vector.iter_mut().for_each(|x| *x /= left);
            basis.push((index, vector));
        }
    }
    Some(basis)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn limits_leave_a_gap_between_rest_and_motion() {
        for length in [1, 10, 1000] {
            for exponent in -16..2 {
                let limits = Limits::new(10f64.powi(exponent), length);
                assert!(3.0 * limits.rest <= limits.moves, "{limits:?}");
                assert!(limits.moves >= 3.0 * limits.error, "{limits:?}");
                assert_eq!(limits.moves(0.0), Some(false));
            }
        }
        let fine = Limits::new(1e-13, 4);
        assert_eq!(fine.rank(&[0.7, 1e-3, 1e-14]), Some(2));
        assert_eq!(fine.rank(&[0.7, 1e-11]), None);
        // Coarse numbers: a component of some per cent of a share may be rounding and may be not.
        let coarse = Limits::new(3e-3, 100);
        assert_eq!(coarse.moves(0.02), Some(true));
        assert_eq!(coarse.moves(0.004), None);
        assert_eq!(coarse.moves(1e-5), Some(false));
        assert_eq!(Limits::new(0.1, 100).moves(0.9), None);
        assert_eq!(Limits::new(f64::NAN, 100).moves(0.9), None);
    }

    #[test]
    fn bases_are_orthonormal_and_dependent_vectors_dropped() {
        let basis = orthonormalised(vec![
            vec![1e200, 1e200, 0.0],
            vec![0.0, 0.0, 0.0],
            vec![2.0, 2.0, 0.0],
            vec![1.0, 0.0, 1e-3],
        ])
        .unwrap();
        assert_eq!(basis.len(), 2);
        assert_eq!((basis[0].0, basis[1].0), (0, 3));
        assert!(dot(&basis[0].1, &basis[1].1).abs() < 1e-15);
        assert!((norm(&basis[1].1) - 1.0).abs() < 1e-15);
        assert!(orthonormalised(vec![vec![f64::INFINITY, 1.0]]).is_none());
    }
}
