//! The reduction itself: from the closure equations to a few equations in as many variables as there are motions.
//!
//! With B an orthonormal basis of ker J and N one of ker Jᵀ, joint variables are z = B y + ψ(y), ψ orthogonal to ker J.
//! Degree by degree, ψ_k = −J⁺ \[F(B y + ψ_{<k})\]_k solves all equations but those of the left kernel; then
//! κ(y) = Nᵀ F(B y + ψ(y)), whose part of degree k depends on ψ_{<k} only because Nᵀ J = 0. What is below degree two is
//! zero: the pose is closed, and κ has no linear part (Golubitsky and Schaeffer 1985, chapter VII; Kuranishi 1962).

use super::effective::independent;
use super::ideal::drop_consequences;
use super::loop_equations::LoopEquations;
use super::noise::noise_of;
use super::splitting::{LARGEST_SIDE, Splitting};
use crate::PartRank;
use kutzbach_math::group::{Monomials, Series};
use kutzbach_math::interruption;
use kutzbach_math::matrix::MatrixError;
use kutzbach_model::mechanism::Mechanism;
use std::sync::Arc;

/// No germ of more monomials is computed: twelve variables to degree four have 1820, and take a second.
const MOST_MONOMIALS: usize = 2000;

/// No germ of a part with more unknowns is computed.
const MOST_UNKNOWNS: usize = 300;

/// The germ of the configuration space of one part at its pose: {κ = 0} in δ variables y, up to a degree K.
///
/// The variables y are coordinates along an orthonormal basis of the kernel of the Jacobian with unit columns; |y| = 0.1
/// moves the joints by the order of a tenth of a radian or cycle length.
#[derive(Clone, Debug)]
pub struct Germ {
    monomials: Arc<Monomials>,
    equations: Vec<Series>,
    stresses: Vec<Vec<f64>>,
    noise: Vec<f64>,
    margin: f64,
    variables: Vec<(usize, usize)>,
    increments: Vec<Series>,
    tangent: Vec<Vec<f64>>,
}

impl Germ {
    /// Computes the germ at the pose that `rank` was decided at, to degree `degree` (at least 2).
    ///
    /// `None` where the rank is undecided, where the part has more than 300 unknowns or 600 equations, or where more than
    /// 2000 monomials would be needed. Time: C(2δ+K, K) products of displacements per joint and degree.
    ///
    /// # Errors
    /// [`MatrixError`] where the Jacobian cannot be decomposed or numbers overflow.
    pub fn of_part(
        mechanism: &Mechanism,
        rank: &PartRank,
        degree: usize,
    ) -> Result<Option<Self>, MatrixError> {
        Self::of_part_across(mechanism, rank, degree, &[])
    }

    /// [`of_part`](Self::of_part) on the part of the kernel across some of its directions: orthonormal vectors, one number
    /// per column of the Jacobian with unit columns. The variables y are fewer by as many.
    ///
    /// Where the mechanism has motions in these directions at all poses nearby, its configuration space is the product of
    /// these motions and of what this germ describes.
    ///
    /// # Errors
    /// As [`of_part`](Self::of_part).
    pub fn of_part_across(
        mechanism: &Mechanism,
        rank: &PartRank,
        degree: usize,
        directions: &[Vec<f64>],
    ) -> Result<Option<Self>, MatrixError> {
        let Some(freedom) = rank
            .instantaneous
            .and_then(|freedom| freedom.checked_sub(directions.len()))
        else {
            return Ok(None);
        };
        let degree = degree.max(2);
        let unknowns = rank.unknowns();
        if unknowns > MOST_UNKNOWNS
            || rank.equations() > LARGEST_SIDE
            || monomial_count(freedom, degree) > MOST_MONOMIALS
        {
            return Ok(None);
        }
        let equations = LoopEquations::new(mechanism, rank);
        let mut splitting = Splitting::of(
            &rank.matrix,
            unknowns.saturating_sub(freedom + directions.len()),
        )?;
        splitting.leave_out(directions);
        let Some(reduced) = reduce(&equations, &splitting, unknowns, degree) else {
            return Ok(None);
        };
        let accuracy = rank.open_by_digits().max(rank.accuracy);
        let Some(noise) = noise_of(&equations, &splitting, &reduced, accuracy)? else {
            return Ok(None);
        };
        let mut effective = independent(&reduced.kappa, &noise)?;
        drop_consequences(&mut effective, &noise)?;
        let units = equations.units();
        let stresses = effective.combinations.iter().map(|combination| {
            let mut stress = vec![0.0; rank.equations()];
            for (factor, basis) in combination.iter().zip(&splitting.left) {
                stress
                    .iter_mut()
                    .zip(basis)
                    .for_each(|(s, b)| *s += factor * b);
            }
            stress
        });
        let increments = reduced.variables.into_iter().zip(units).map(|(z, unit)| {
            let coefficients = z.into_iter().map(|c| c * unit).collect();
            Series::from_coefficients(&reduced.monomials, coefficients)
        });
        let tangent = splitting
            .kernel
            .iter()
            .map(|basis| basis.iter().zip(units).map(|(b, unit)| b * unit).collect());
        Ok(Some(Self {
            stresses: stresses.collect(),
            increments: increments.collect(),
            tangent: tangent.collect(),
            monomials: reduced.monomials.clone(),
            equations: effective.equations,
            noise,
            margin: effective.margin,
            variables: rank.jacobian.variables.clone(),
        }))
    }

    /// The number of variables y: δ, the dimension of the kernel, less the directions left out.
    #[must_use]
    pub fn freedom(&self) -> usize {
        self.monomials.variables()
    }

    /// The effective equations κ, sorted by order: independent up to the noise, combined with orthonormal factors from all
    /// that the left kernel gives, without those that follow from the ones before. None are left where all vanish to every computed degree.
    #[must_use]
    pub fn equations(&self) -> &[Series] {
        &self.equations
    }

    /// The self-stress of each equation, one number per row of the Jacobian: κ_i is its product with the closure equations.
    #[must_use]
    pub fn stresses(&self) -> &[Vec<f64>] {
        &self.stresses
    }

    /// K: the degree up to which the series are computed.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.monomials.degree()
    }

    /// Lowest degree in which an equation has a coefficient above the noise; `None` if there is no equation.
    #[must_use]
    pub fn order(&self) -> Option<usize> {
        self.equations.iter().filter_map(order_of).min()
    }

    /// Estimate of the largest error of the coefficients of one degree, in the Frobenius norm over equations and monomials. Zero
    /// below degree two, where the equations have no terms; infinite above [`degree`](Self::degree).
    #[must_use]
    pub fn noise(&self, degree: usize) -> f64 {
        self.noise.get(degree).copied().unwrap_or(f64::INFINITY)
    }

    /// [`noise`](Self::noise) of every degree from 0 to K.
    #[must_use]
    pub fn noise_by_degree(&self) -> &[f64] {
        &self.noise
    }

    /// How clearly equations were told from noise: the smallest factor by which a singular value of the coefficients of
    /// one degree exceeds the noise, if kept, or stays below it, if dropped; and by which the noise is below the size of
    /// coefficients of that degree in general, without which being below it means nothing. Infinite where nothing was to
    /// be decided, as without self-stresses.
    #[must_use]
    pub fn margin(&self) -> f64 {
        self.margin
    }

    /// Joint increments (rad, m) from the pose at `y`, one per column of the part: B y + ψ(y), to be applied with
    /// [`JointDisplacement::advance`](kutzbach_closure::JointDisplacement::advance). Where κ(y) = 0 they close the cycles up
    /// to terms of degree K + 1.
    ///
    /// # Panics
    /// If `y` has not [`freedom`](Self::freedom) coordinates.
    #[must_use]
    pub fn increments(&self, y: &[f64]) -> Vec<f64> {
        self.increments.iter().map(|x| x.evaluate(y)).collect()
    }

    /// [`increments`](Self::increments) as power series, one per column.
    #[must_use]
    pub fn increment_series(&self) -> &[Series] {
        &self.increments
    }

    /// (joint, index of the variable in the joint) of every column.
    #[must_use]
    pub fn variables(&self) -> &[(usize, usize)] {
        &self.variables
    }

    /// The kernel basis as joint rates (rad, m), one vector per variable y, one number per column.
    #[must_use]
    pub fn tangent(&self) -> &[Vec<f64>] {
        &self.tangent
    }
}

/// Lowest degree with a nonzero coefficient.
pub(super) fn order_of(equation: &Series) -> Option<usize> {
    (0..=equation.monomials().degree()).find(|d| equation.size_of_degree(*d) > 0.0)
}

/// C(m+K, K), cut off where it is too large anyway.
fn monomial_count(variables: usize, degree: usize) -> usize {
    let mut count = 1usize;
    for i in 1..=degree {
        count = count.saturating_mul(variables + i) / i;
        if count > MOST_MONOMIALS {
            return count;
        }
    }
    count
}

/// What the reduction gives before anything is decided about it.
pub(super) struct Reduced {
    pub monomials: Arc<Monomials>,
    /// Coefficients of every variable, in units of the matrix with unit columns.
    pub variables: Vec<Vec<f64>>,
    /// Nᵀ F, what is below degree two exactly zero.
    pub kappa: Vec<Series>,
}

/// Solves for ψ and returns κ; `None` where the table of monomials would be too large.
pub(super) fn reduce(
    equations: &LoopEquations,
    splitting: &Splitting,
    unknowns: usize,
    degree: usize,
) -> Option<Reduced> {
    let freedom = splitting.kernel.len();
    let monomials = Monomials::new(freedom, degree).ok()?;
    let mut variables = vec![vec![0.0; monomials.count()]; unknowns];
    for (slot, basis) in monomials.of_degree(1).zip(&splitting.kernel) {
        for (variable, value) in variables.iter_mut().zip(basis) {
            variable[slot] = *value;
        }
    }
    let mut residual = Vec::new();
    for k in 2..=degree {
        interruption::look().ok()?;
        // Numbering is by degree, so that a shorter table numbers the same monomials.
        let table = if k == degree {
            Arc::clone(&monomials)
        } else {
            Monomials::new(freedom, k).ok()?
        };
        residual = equations.evaluate(&table, &variables);
        for slot in table.of_degree(k) {
            let right: Vec<f64> = residual
                .iter()
                .map(|row| row.coefficients()[slot])
                .collect();
            if right.iter().all(|r| *r == 0.0) {
                continue;
            }
            for (variable, x) in variables.iter_mut().zip(splitting.solve(&right)) {
                variable[slot] = -x;
            }
        }
    }
    let below = monomials.count_up_to(1);
    let kappa = splitting.left.iter().map(|stress| {
        let mut sum = Series::zero(&monomials);
        for (factor, row) in stress.iter().zip(&residual) {
            sum.add_scaled(*factor, row);
        }
        sum.coefficients_mut()[..below].fill(0.0);
        sum
    });
    Some(Reduced {
        kappa: kappa.collect(),
        variables,
        monomials,
    })
}
