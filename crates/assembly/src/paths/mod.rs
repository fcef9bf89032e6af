//! All solutions of as many equations as unknowns, by following them along paths, proven afterwards.
//!
//! The solutions of F(x) = c are followed while c goes round loops through complex values. What they come back to at c = 0 are
//! solutions again, in general others (*monodromy*): since the pairs (x, F(x)) form one irreducible set, loops lead from every
//! simple solution to every other (Duff, Hill, Jensen, Lee, Leykin, Sommars 2019). How many there are in all is known from exact
//! algebra, so that the search knows its end; and nothing of it has to be trusted: at the end Krawczyk's operator proves one
//! solution, and only one, in each of some boxes, which are apart. As many boxes as there are solutions hold all of them, and each
//! solution is simple.

mod boxes;
mod complex;
mod equations;
mod tracking;

use boxes::Proven;
use complex::Complex;
use equations::Equations;
use kutzbach_algebra::{Budget, Polynomial, Stop};
use tracking::{Tracker, corrected};

/// A real solution, and how far each of its coordinates may be off.
#[derive(Clone, Debug)]
pub(crate) struct RealRoot {
    pub(crate) values: Vec<f64>,
    pub(crate) off: f64,
}

/// Loops that are tried, of which so many in a row may find nothing new.
const MOST_LOOPS: usize = 80;
const MOST_IN_VAIN: usize = 16;

/// Loops that find nothing are followed by ones so many times as wide, up to so many in turn: what goes round no branch leads back.
const WIDER: f64 = 2.0;
const WIDENINGS: i32 = 6;

/// A coordinate that is smaller in half of the solutions tells no size.
const LEAST: f64 = 1e-3;

/// Parts of their size that two solutions differ by at least; nearer ones are taken for one, and then the count does not come out.
const SAME: f64 = 1e-7;

/// The real ones of the `count` complex solutions, all proven; `None` where not all were found or proven. Solutions stay solutions when all
/// variables of a set in `mirrors` change their sign. Equations in `kept` hold all along the paths: those of unit quaternions and circles, without
/// which the others have solutions that mean nothing.
///
/// # Errors
/// [`Stop`] where the budget does not suffice.
pub(crate) fn real_solutions(
    polynomials: &[Polynomial],
    count: usize,
    mirrors: &[Vec<usize>],
    kept: &[usize],
    budget: &Budget,
) -> Result<Option<Vec<RealRoot>>, Stop> {
    let variables = polynomials.first().map_or(0, Polynomial::variables);
    if variables == 0 || polynomials.len() != variables {
        return Ok(None);
    }
    let Some(equations) = Equations::of(polynomials) else {
        return Ok(None);
    };
    let mirrors = mirrors
        .iter()
        .filter(|set| is_even(polynomials, set))
        .cloned()
        .collect();
    let mut search = Search {
        tracker: Tracker::new(&equations, budget),
        equations: &equations,
        mirrors,
        kept,
        known: Vec::new(),
        count,
        lots: Lots::new(),
    };
    if !search.run()? {
        return Ok(None);
    }
    Ok(proven(&equations, &search.known))
}

/// The real ones of some solutions, where all are proven and apart.
fn proven(equations: &Equations, solutions: &[Vec<Complex>]) -> Option<Vec<RealRoot>> {
    let proven: Vec<Proven> = solutions
        .iter()
        .map(|at| boxes::prove(equations, at))
        .collect::<Option<_>>()?;
    let apart = |(i, a): (usize, &Proven)| proven[..i].iter().all(|b| a.is_apart_from(b));
    proven.iter().enumerate().all(apart).then(|| {
        let real = proven.iter().filter_map(Proven::real);
        real.map(|(values, off)| RealRoot { values, off }).collect()
    })
}

/// Whether every term has an even degree in the variables of a set.
fn is_even(polynomials: &[Polynomial], set: &[usize]) -> bool {
    let degree = |m: &[u32]| set.iter().map(|&v| m[v]).sum::<u32>();
    let mut terms = polynomials.iter().flat_map(Polynomial::terms);
    terms.all(|(m, _)| degree(m).is_multiple_of(2))
}

struct Search<'a> {
    equations: &'a Equations,
    tracker: Tracker<'a>,
    mirrors: Vec<Vec<usize>>,
    kept: &'a [usize],
    known: Vec<Vec<Complex>>,
    count: usize,
    lots: Lots,
}

impl Search<'_> {
    /// Whether as many were found as there are, and not one more.
    fn run(&mut self) -> Result<bool, Stop> {
        let none = vec![Complex::ZERO; self.equations.count()];
        let mut in_vain = 0;
        for _ in 0..MOST_LOOPS {
            let before = self.known.len();
            // Any point solves F(x) = c for one c.
            let times = WIDER.powi(in_vain as i32 % WIDENINGS);
            let [start, other] = [self.point(times), self.point(times)];
            let [first, b] = [&start, &other].map(|x| self.equations.at(x).values);
            let [a, b] = [&first, &b].map(|c| self.with_kept(c));
            if let Some(at_a) = self.tracker.follow(&start, &first, &a)?
                && let Some(end) = self.tracker.follow(&at_a, &a, &none)?
            {
                self.take(end);
            }
            // Mirror images of paths are paths.
            for solution in self.representatives() {
                let Some(at_a) = self.tracker.follow(&solution, &none, &a)? else {
                    continue;
                };
                let Some(at_b) = self.tracker.follow(&at_a, &a, &b)? else {
                    continue;
                };
                if let Some(end) = self.tracker.follow(&at_b, &b, &none)? {
                    self.take(end);
                }
            }
            // One loop more than is needed finds nothing more, or the count is wrong.
            if before >= self.count || self.known.len() > self.count {
                break;
            }
            in_vain = if self.known.len() > before {
                0
            } else {
                in_vain + 1
            };
            if in_vain == MOST_IN_VAIN {
                break;
            }
        }
        Ok(self.known.len() == self.count)
    }

    /// With nothing on the right side of what is kept.
    fn with_kept(&self, right: &[Complex]) -> Vec<Complex> {
        let mut right = right.to_vec();
        self.kept.iter().for_each(|&r| right[r] = Complex::ZERO);
        right
    }

    /// A point by lot, as large as half of the solutions are: those far out are of no measure for the right sides that go with them.
    fn point(&mut self, times: f64) -> Vec<Complex> {
        let middle = |i: usize| {
            let mut sizes: Vec<f64> = self.known.iter().map(|x| x[i].size()).collect();
            sizes.sort_by(f64::total_cmp);
            sizes.get(sizes.len() / 2).copied()
        };
        let sizes: Vec<f64> = (0..self.equations.count())
            .map(|i| middle(i).filter(|size| *size > LEAST).unwrap_or(1.0))
            .collect();
        let mut lot = || self.lots.next();
        let point = |size: &f64| Complex::new(lot(), lot()).scaled(times * size);
        sizes.iter().map(point).collect()
    }

    /// Takes a solution with its mirror images and its conjugates, unless it is known.
    fn take(&mut self, at: Vec<Complex>) {
        let Some(at) = corrected(self.equations, &at) else {
            return;
        };
        let mut images = vec![at.clone(), at.iter().map(|z| z.conjugate()).collect()];
        for set in &self.mirrors {
            let mirrored: Vec<Vec<Complex>> = images.iter().map(|x| mirror(x, set)).collect();
            images.extend(mirrored);
        }
        for image in images {
            if !self.known.iter().any(|other| are_same(other, &image)) {
                self.known.push(image);
            }
        }
    }

    /// Of solutions that are mirror images of one another the first.
    fn representatives(&self) -> Vec<Vec<Complex>> {
        let mut found: Vec<Vec<Complex>> = Vec::new();
        for solution in &self.known {
            let known = self.mirrors.iter().any(|set| {
                let image = mirror(solution, set);
                found.iter().any(|other| are_same(other, &image))
            });
            if !known {
                found.push(solution.clone());
            }
        }
        found
    }
}

fn mirror(at: &[Complex], set: &[usize]) -> Vec<Complex> {
    let sign = |i: usize| if set.contains(&i) { -1.0 } else { 1.0 };
    let parts = at.iter().enumerate();
    parts.map(|(i, z)| z.scaled(sign(i))).collect()
}

fn are_same(a: &[Complex], b: &[Complex]) -> bool {
    let near = |(a, b): (&Complex, &Complex)| a.minus(*b).size() <= SAME * (1.0 + a.size());
    a.iter().zip(b).all(near)
}

/// Numbers between -1 and 1 by lot, the same in every run: SplitMix64 (Steele, Lea and Flood 2014).
struct Lots(u64);

impl Lots {
    fn new() -> Self {
        Self(0x9e37_79b9_7f4a_7c15)
    }

    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let bits = (z ^ (z >> 31)) >> 11;
        bits as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_algebra::Rational;

    fn polynomial(terms: &[(i64, [u32; 2])]) -> Polynomial {
        let terms = terms
            .iter()
            .map(|(c, m)| (m.to_vec(), Rational::from_integer((*c).into())));
        Polynomial::from_terms(terms.collect(), 2)
    }

    /// A circle of radius 5 and a hyperbola: (3, 4) and three more.
    fn circle_and_hyperbola(product: i64) -> [Polynomial; 2] {
        [
            polynomial(&[(1, [2, 0]), (1, [0, 2]), (-25, [0, 0])]),
            polynomial(&[(1, [1, 1]), (-product, [0, 0])]),
        ]
    }

    #[test]
    fn real_solutions_are_told_from_complex_ones() {
        let mirrors = [vec![0, 1], vec![0]];
        for (product, real) in [(12, 4), (13, 0)] {
            let system = circle_and_hyperbola(product);
            let found = real_solutions(&system, 4, &mirrors, &[], &Budget::unlimited());
            let found = found.unwrap().unwrap();
            assert_eq!(found.len(), real, "{product}");
            for root in found {
                let [x, y] = root.values[..] else { panic!() };
                assert!((x * y - 12.0).abs() < 1e-12 && (x * x + y * y - 25.0).abs() < 1e-12);
                assert!(root.off < 1e-10);
            }
        }
    }

    #[test]
    fn double_solutions_and_wrong_counts_are_not_proven() {
        // The hyperbola touches the circle: 2 x y = 25.
        let [circle, _] = circle_and_hyperbola(0);
        let touching = polynomial(&[(2, [1, 1]), (-25, [0, 0])]);
        let budget = Budget::unlimited();
        for count in [2, 4] {
            let found = real_solutions(
                &[circle.clone(), touching.clone()],
                count,
                &[],
                &[],
                &budget,
            );
            assert!(found.unwrap().is_none(), "{count}");
        }
        for count in [3, 5] {
            let found = real_solutions(&circle_and_hyperbola(12), count, &[], &[], &budget);
            assert!(found.unwrap().is_none(), "{count}");
        }
    }
}
