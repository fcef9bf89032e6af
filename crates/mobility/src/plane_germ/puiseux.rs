//! Half-branches of a real plane curve by Newton's polygon.
//!
//! On the side x > 0 a half-branch is y = xᵖᐟᵠ (c + y₁) with p/q the slope of an edge of the polygon and c a real root of the edge's
//! polynomial; y₁ is a half-branch of what remains, with x = t^q. A root that is simple has one continuation, which is a
//! convergent series (Hensel's lemma, the implicit function theorem): then everything that follows is known to exist and to be one.
//! A multiple one is looked at with the next polygon. Nothing is concluded from coefficients beyond those that are known: an edge
//! counts only if no unknown term can lie on it or below.

use super::fuzzy::Fuzzy;
use super::polynomial::{Root, real_roots};
use super::taylor::Plane;
use crate::leftover::Doubt;
use kutzbach_math::matrix::Real;

/// More polygons in a row are not followed: each separates what touches to some order.
const DEEPEST: usize = 40;

/// One polygon's step: x = t^q, y = t^p (c + y₁).
#[derive(Clone, Debug)]
pub(super) struct Step<R> {
    pub p: usize,
    pub q: usize,
    pub c: Fuzzy<R>,
}

/// A way out of the origin: the side of x that it lies on, and the steps after which it is alone.
#[derive(Clone, Debug)]
pub(super) struct Half<R> {
    pub positive: bool,
    pub steps: Vec<Step<R>>,
    /// One, or more where no known term separates so many.
    pub multiplicity: usize,
}

impl<R: Real> Half<R> {
    /// x = ± t^N: the exponent.
    pub fn ramification(&self) -> usize {
        self.steps.iter().map(|step| step.q).product()
    }

    /// The slope of its tangent, dy/dx.
    pub fn slope(&self, one: &R) -> Fuzzy<R> {
        match self.steps.first() {
            // On the side x < 0 steps are in |x|.
            Some(step) if step.p == step.q && self.positive => step.c.clone(),
            Some(step) if step.p == step.q => step.c.negated(),
            _ => Fuzzy::zero(one),
        }
    }

    /// (x, y) by its steps alone, at a parameter t > 0.
    pub fn point(&self, t: &R) -> [R; 2] {
        self.point_beside(t, t.zero_like())
    }

    /// The same with a value for what remains of y behind the last step.
    pub fn point_beside(&self, t: &R, rest: R) -> [R; 2] {
        let mut y = rest;
        let mut t = t.clone();
        for step in self.steps.iter().rev() {
            y = power(&t, step.p) * (step.c.value.clone() + y);
            t = power(&t, step.q);
        }
        [if self.positive { t } else { -t }, y]
    }

    /// The half-branch that continues it analytically through the origin: t < 0.
    pub fn opposite(&self) -> Self {
        // Sign of t behind each step, from the innermost outward.
        let mut signs = vec![false; self.steps.len() + 1];
        signs[self.steps.len()] = true;
        for (index, step) in self.steps.iter().enumerate().rev() {
            signs[index] = signs[index + 1] && step.q % 2 == 1;
        }
        let mut turned = false;
        let steps = self
            .steps
            .iter()
            .zip(&signs[1..])
            .map(|(step, negative)| {
                turned ^= *negative && step.p % 2 == 1;
                Step {
                    c: if turned {
                        step.c.negated()
                    } else {
                        step.c.clone()
                    },
                    ..step.clone()
                }
            })
            .collect();
        Self {
            positive: self.positive != signs[0],
            steps,
            multiplicity: self.multiplicity,
        }
    }

    /// Whether two are the same.
    ///
    /// # Errors
    /// [`Doubt`] where their coefficients are neither equal nor clearly different.
    pub fn is(&self, other: &Self) -> Result<bool, Doubt> {
        if self.positive != other.positive
            || self.multiplicity != other.multiplicity
            || self.steps.len() != other.steps.len()
        {
            return Ok(false);
        }
        for (a, b) in self.steps.iter().zip(&other.steps) {
            if (a.p, a.q) != (b.p, b.q) {
                return Ok(false);
            }
            if !a.c.minus(&b.c).is_zero()? {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

/// All half-branches on one side of a series that begins with order `order` and has a term in yᵒʳᵈᵉʳ there. What no known term separates is
/// one of them, of a multiplicity.
///
/// # Errors
/// [`Doubt`] where the known coefficients do not separate them.
pub(super) fn half_branches<R: Real>(
    plane: &Plane<R>,
    order: usize,
    positive: bool,
) -> Result<Vec<Half<R>>, Doubt> {
    let rows: Vec<Vec<Fuzzy<R>>> = plane
        .by_y
        .iter()
        .map(|row| {
            let signed = row
                .iter()
                .enumerate()
                .map(|(i, c)| match positive || i % 2 == 0 {
                    true => c.clone(),
                    false => c.negated(),
                });
            signed.collect()
        })
        .collect();
    let local = Local {
        known: plane.degree() + 1,
        rows,
    };
    let mut found = Vec::new();
    local.expand(order, &[], &mut found)?;
    Ok(found
        .into_iter()
        .map(|(steps, multiplicity)| Half {
            positive,
            steps,
            multiplicity,
        })
        .collect())
}

/// A series in t and y of which terms with tⁱ, i < known, are known (i + j < known at first).
struct Local<R> {
    rows: Vec<Vec<Fuzzy<R>>>,
    known: usize,
}

/// An edge of the polygon: from (i, j) by slope p/q down to the row `end`.
struct Edge {
    i: usize,
    j: usize,
    p: usize,
    q: usize,
    end: usize,
}

impl<R: Real> Local<R> {
    /// Appends the steps of every half-branch in t > 0; y has the multiplicity given at t = 0.
    fn expand(
        &self,
        multiplicity: usize,
        before: &[Step<R>],
        found: &mut Vec<(Vec<Step<R>>, usize)>,
    ) -> Result<(), Doubt> {
        if multiplicity == 1 || before.len() >= DEEPEST {
            found.push((before.to_vec(), multiplicity));
            return Ok(());
        }
        let first = self.first_terms(multiplicity)?;
        let (mut i, mut j) = (0, multiplicity);
        while j > 0 {
            let Some(edge) = self.edge(i, j, &first) else {
                // The first terms of so many series lie beyond what is known.
                found.push((before.to_vec(), j));
                return Ok(());
            };
            for root in self.roots(&edge)? {
                let mut steps = before.to_vec();
                steps.push(Step {
                    p: edge.p,
                    q: edge.q,
                    c: root.at.clone(),
                });
                let next = match root.multiplicity {
                    1 => None,
                    _ => self.substituted(&edge, &root),
                };
                match next {
                    Some(next) => next.expand(root.multiplicity, &steps, found)?,
                    None => found.push((steps, root.multiplicity)),
                }
            }
            i += edge.p * (j - edge.end) / edge.q;
            j = edge.end;
        }
        Ok(())
    }

    /// The lowest power of t in each row up to the multiplicity; `None` where all known terms vanish.
    fn first_terms(&self, multiplicity: usize) -> Result<Vec<Option<usize>>, Doubt> {
        let mut first = Vec::with_capacity(multiplicity + 1);
        for row in &self.rows[..multiplicity.min(self.rows.len())] {
            let mut lowest = None;
            for (i, c) in row.iter().enumerate().skip(1) {
                if !c.is_zero()? {
                    lowest = Some(i);
                    break;
                }
            }
            first.push(lowest);
        }
        first.push(Some(0));
        Ok(first)
    }

    /// The next edge of the lower hull from a corner; `None` where unknown terms may lie on it or below.
    fn edge(&self, i: usize, j: usize, first: &[Option<usize>]) -> Option<Edge> {
        // Slopes as fractions: rise over the number of rows.
        let mut best: Option<(usize, usize, usize)> = None;
        for (end, lowest) in first.iter().enumerate().take(j) {
            let Some(lowest) = *lowest else { continue };
            let (rise, run) = (lowest - i.min(lowest), j - end);
            let flatter = best.is_none_or(|(r, n, _)| rise * n < r * run);
            if flatter {
                best = Some((rise, run, end));
            }
        }
        let (rise, run, end) = best?;
        // Rows of which nothing is known to be there may begin where knowledge ends.
        let hidden = (0..j).any(|row| {
            let unknown = self.rows[row].len();
            (unknown - i.min(unknown)) * run <= rise * (j - row)
        });
        if hidden || rise == 0 {
            return None;
        }
        let divisor = gcd(rise, run);
        Some(Edge {
            i,
            j,
            p: rise / divisor,
            q: run / divisor,
            end,
        })
    }

    /// Roots of the edge's polynomial.
    fn roots(&self, edge: &Edge) -> Result<Vec<Root<R>>, Doubt> {
        let zero = Fuzzy::zero(&self.rows[0][0].value);
        let polynomial: Vec<Fuzzy<R>> = (edge.end..=edge.j)
            .map(|row| {
                let down = edge.p * (edge.j - row);
                match down % edge.q {
                    0 => self.rows[row][edge.i + down / edge.q].clone(),
                    _ => zero.clone(),
                }
            })
            .collect();
        real_roots(&polynomial)
    }

    /// x = t^q, y = t^p (c + y₁), divided by the power of t that the edge has; `None` where nothing of it is known.
    fn substituted(&self, edge: &Edge, root: &Root<R>) -> Option<Self> {
        let lowest = edge.q * edge.i + edge.p * edge.j;
        let known = (edge.q * self.known)
            .checked_sub(lowest)
            .filter(|known| *known > 0)?;
        let like = &self.rows[0][0].value;
        let zero = Fuzzy::zero(like);
        let mut rows = vec![vec![zero.clone(); known]; self.rows.len()];
        // (c + y)ʲ, row by row.
        let mut binomial = vec![Fuzzy::exact(like.one_like())];
        for (j, row) in self.rows.iter().enumerate() {
            for (i, a) in row.iter().enumerate() {
                let Some(at) = (edge.q * i + edge.p * j).checked_sub(lowest) else {
                    continue;
                };
                if at >= known {
                    continue;
                }
                for (power, b) in binomial.iter().enumerate() {
                    rows[power][at] = rows[power][at].plus(&a.times(b));
                }
            }
            let mut next = vec![zero.clone(); binomial.len() + 1];
            for (power, b) in binomial.iter().enumerate() {
                next[power] = next[power].plus(&b.times(&root.at));
                next[power + 1] = next[power + 1].plus(b);
            }
            binomial = next;
        }
        // What vanishes because c is a root.
        for row in rows.iter_mut().take(root.multiplicity) {
            row[0] = zero.clone();
        }
        Some(Self { rows, known })
    }
}

fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}

pub(super) fn power<R: Real>(base: &R, exponent: usize) -> R {
    (0..exponent).fold(base.one_like(), |product, _| product * base.clone())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)] // a test may panic
mod tests {
    use super::*;
    use kutzbach_math::matrix::Extended;

    /// A series from its terms (coefficient, power of x, power of y), cut off at a degree.
    fn plane(terms: &[(f64, usize, usize)], degree: usize) -> Plane<Extended> {
        let one = Extended::new(1.0, 300);
        let known = |x: f64| Fuzzy {
            value: one.constant(x),
            error: 1e-60,
        };
        let mut by_y: Vec<Vec<Fuzzy<Extended>>> = (0..=degree)
            .map(|j| vec![known(0.0); degree - j + 1])
            .collect();
        for (c, i, j) in terms.iter().filter(|(_, i, j)| i + j <= degree) {
            by_y[*j][*i] = known(*c);
        }
        Plane { by_y }
    }

    fn sides(
        terms: &[(f64, usize, usize)],
        order: usize,
        degree: usize,
    ) -> Result<[usize; 2], Doubt> {
        let curve = plane(terms, degree);
        let mut counts = [0; 2];
        for (count, positive) in counts.iter_mut().zip([true, false]) {
            let halves = half_branches(&curve, order, positive)?;
            if halves.iter().any(|half| half.multiplicity > 1) {
                return Err(Doubt::Multiple);
            }
            *count = halves.len();
        }
        Ok(counts)
    }

    #[test]
    fn half_branches_of_the_simple_singularities_are_counted() {
        for (name, terms, order, wanted) in [
            ("node", vec![(1.0, 0, 2), (-1.0, 2, 0)], 2, [2, 2]),
            ("isolated point", vec![(1.0, 0, 2), (1.0, 2, 0)], 2, [0, 0]),
            (
                "nearly isolated",
                vec![(1.0, 0, 2), (1e-12, 2, 0), (-1.0, 4, 0)],
                2,
                [0, 0],
            ),
            (
                "nearly a tacnode",
                vec![(1.0, 0, 2), (-1e-12, 2, 0), (-1.0, 4, 0)],
                2,
                [2, 2],
            ),
            ("cusp", vec![(1.0, 0, 2), (-1.0, 3, 0)], 2, [2, 0]),
            ("a6", vec![(1.0, 0, 2), (-1.0, 7, 0)], 2, [2, 0]),
            ("tacnode", vec![(1.0, 0, 2), (-1.0, 4, 0)], 2, [2, 2]),
            (
                "isolated at order 8",
                vec![(1.0, 0, 2), (1.0, 8, 0)],
                2,
                [0, 0],
            ),
            ("e6", vec![(1.0, 0, 3), (-1.0, 4, 0)], 3, [1, 1]),
            ("e8", vec![(1.0, 0, 3), (-1.0, 5, 0)], 3, [1, 1]),
            ("puiseux 3/7", vec![(1.0, 0, 3), (-1.0, 7, 0)], 3, [1, 1]),
            (
                "two cusps to one side",
                vec![(1.0, 0, 4), (-3.0, 3, 2), (2.0, 6, 0)],
                4,
                [4, 0],
            ),
            // (y² − x³)² = x⁵ y, of pairs (3, 2) and (7, 2).
            (
                "puiseux 4, 6, 7",
                vec![(1.0, 0, 4), (-2.0, 3, 2), (1.0, 6, 0), (-1.0, 5, 1)],
                4,
                [2, 0],
            ),
        ] {
            assert_eq!(sides(&terms, order, 12).unwrap(), wanted, "{name}");
        }
    }

    #[test]
    fn what_may_split_beyond_the_known_terms_is_not_decided() {
        // y² = x⁷ looks like y² = 0 up to degree 6.
        assert_eq!(
            sides(&[(1.0, 0, 2), (-1.0, 7, 0)], 2, 6),
            Err(Doubt::Multiple)
        );
        assert_eq!(sides(&[(1.0, 0, 2)], 2, 12), Err(Doubt::Multiple));
        // (y − x²)² = x⁹.
        let touching = [(1.0, 0, 2), (-2.0, 2, 1), (1.0, 4, 0), (-1.0, 9, 0)];
        assert_eq!(sides(&touching, 2, 8), Err(Doubt::Multiple));
        assert_eq!(sides(&touching, 2, 9).unwrap(), [2, 0]);
    }

    #[test]
    fn continuing_twice_leads_back() {
        let terms = [(1.0, 0, 4), (-2.0, 3, 2), (1.0, 6, 0), (-1.0, 5, 1)];
        let curve = plane(&terms, 12);
        let halves = half_branches(&curve, 4, true).unwrap();
        assert_eq!(halves.len(), 2);
        let [a, b] = [&halves[0], &halves[1]];
        assert_eq!(a.ramification(), 4);
        assert!(a.opposite().is(b).unwrap());
        assert!(a.opposite().opposite().is(a).unwrap());
        assert!(!a.is(b).unwrap());
        // A smooth one goes to the other side with the slope that it has.
        let line = plane(&[(1.0, 0, 1), (-2.0, 1, 0), (1.0, 2, 0)], 6);
        let right = half_branches(&line, 1, true).unwrap();
        assert_eq!(right.len(), 1);
        assert!(!right[0].opposite().positive);
    }

    #[test]
    fn points_lie_on_the_curve() {
        let one = Extended::new(1.0, 300);
        let curve = plane(&[(1.0, 0, 2), (-1.0, 3, 0)], 8);
        for half in half_branches(&curve, 2, true).unwrap() {
            let [x, y] = half.point(&one.constant(0.125));
            let left = (y.clone() * y - power(&x, 3)).to_f64();
            assert_eq!(left, 0.0);
        }
    }
}
