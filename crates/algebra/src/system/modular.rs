//! A system and its drawn pose modulo a prime: what a local dimension is computed from.
//!
//! Modulo a prime in which every minimal polynomial has a root, the algebraic numbers have images, and so have the
//! coefficients and the point. Which root is taken does not matter for dimensions: the minimal polynomials generate a
//! field, whose embeddings differ by an isomorphism, so that all conjugates of the system at the conjugates of its point
//! have the same dimension; for all but finitely many primes that dimension is the one modulo the prime.

use super::PolynomialSystem;
use super::element::Element;
use super::field::{Field, Relation};
use super::fraction::{from_rational, multiply_modulo as multiply, power_modulo as power, residue};
use super::variables::Meaning;

/// A system modulo a prime, the drawn pose at the origin.
#[derive(Clone, Debug)]
pub struct ModularSystem {
    /// The prime, below 2⁶².
    pub prime: u64,
    /// Indices of the unknowns in [`PolynomialSystem::variables`]; algebraic numbers have been replaced by their images,
    /// parameters by those of their values in the file.
    pub variables: Vec<usize>,
    /// Left sides as terms: exponents (one per unknown) and coefficient. None has a constant term.
    pub equations: Vec<Vec<(Vec<u32>, u64)>>,
}

/// Where the search for primes begins: far below 2⁶², so that sums of two residues fit a word.
const FIRST: u64 = 1 << 61;
/// Most primes tried.
const MOST_PRIMES: usize = 200_000;
/// A term of a system at its pose takes about five hundred bytes; four times that is reckoned, so that a basis has room too.
const BYTES_PER_TERM: u64 = 2000;

impl PolynomialSystem {
    /// The system and its drawn pose modulo a prime, the pose moved to the origin. Different `attempt`s give different
    /// primes. `None` where the drawn pose is no exact solution, or no prime was found (hundreds of thousands are tried,
    /// of which at least one in the degree of the field does).
    ///
    /// Nothing is expanded where that would take more than `memory` (bytes): see [`fits_at_home`](Self::fits_at_home).
    #[must_use]
    pub fn home_modulo(&self, attempt: usize, memory: u64) -> Option<ModularSystem> {
        let point = self.construction.point.as_ref()?;
        if !self.fits_at_home(memory) {
            return None;
        }
        let field = &self.construction.field;
        let step = u64::from(field.circle.unwrap_or(1)) * 2;
        let mut candidate = FIRST / step * step + 1;
        let mut found = 0;
        for _ in 0..MOST_PRIMES * 40 {
            candidate -= step;
            if !is_prime(candidate) {
                continue;
            }
            let Some(images) = images(field, candidate) else {
                continue;
            };
            let Some(system) = self.reduced(point, &images, candidate) else {
                continue;
            };
            if found == attempt {
                return Some(system);
            }
            found += 1;
            if found > MOST_PRIMES {
                return None;
            }
        }
        None
    }

    /// Whether the system moved to its drawn pose takes no more than `memory` (bytes): see [`terms_at_home`](Self::terms_at_home).
    #[must_use]
    pub fn fits_at_home(&self, memory: u64) -> bool {
        self.terms_at_home() <= memory / BYTES_PER_TERM
    }

    /// How many terms the system has where it is moved to its drawn pose; zero where no pose is drawn. A factor xᵉ of a monomial becomes
    /// (x + a)ᵉ, of e + 1 terms where the value a at the pose is not zero: counted, with multiplicity, before anything is expanded.
    #[must_use]
    pub fn terms_at_home(&self) -> u64 {
        let Some(point) = &self.construction.point else {
            return 0;
        };
        let monomials = self.equations.iter().flat_map(|e| e.polynomial.terms());
        let counts = monomials.map(|(exponents, _)| {
            let factors = exponents.iter().zip(point).filter(|(_, x)| !x.is_zero());
            factors.fold(1usize, |all, (&e, _)| all.saturating_mul(e as usize + 1))
        });
        counts.fold(0, usize::saturating_add) as u64
    }

    fn reduced(&self, point: &[Element], images: &[u64], p: u64) -> Option<ModularSystem> {
        let at: Vec<u64> = point
            .iter()
            .map(|x| element_image(x, images, p))
            .collect::<Option<_>>()?;
        let variables: Vec<usize> = self
            .variables
            .iter()
            .enumerate()
            .filter(|(_, v)| {
                !matches!(
                    v.meaning,
                    Meaning::Algebraic { .. } | Meaning::Parameter { .. }
                )
            })
            .map(|(index, _)| index)
            .collect();
        let mut equations = Vec::with_capacity(self.equations.len());
        for equation in &self.equations {
            let mut terms = std::collections::BTreeMap::<Vec<u32>, u64>::new();
            for (exponents, coefficient) in equation.polynomial.terms() {
                let mut partial = vec![(
                    vec![0u32; variables.len()],
                    residue(&from_rational(coefficient), p)?,
                )];
                for (index, &exponent) in exponents.iter().enumerate().filter(|(_, e)| **e > 0) {
                    let place = variables.iter().position(|v| *v == index);
                    let power = shifted_power(exponent, at[index], place.is_some(), p);
                    partial = partial
                        .iter()
                        .flat_map(|(exponents, c)| {
                            power.iter().map(move |&(degree, factor)| {
                                let mut exponents = exponents.clone();
                                if let Some(place) = place {
                                    exponents[place] += degree;
                                }
                                (exponents, multiply(*c, factor, p))
                            })
                        })
                        .collect();
                }
                for (exponents, c) in partial {
                    let entry = terms.entry(exponents).or_insert(0);
                    *entry = (*entry + c) % p;
                }
            }
            terms.retain(|_, c| *c != 0);
            if terms.is_empty() {
                continue;
            }
            // The point is an exact solution, so that only an unlucky prime could leave a constant.
            if terms.keys().any(|e| e.iter().all(|e| *e == 0)) {
                return None;
            }
            equations.push(terms.into_iter().collect());
        }
        Some(ModularSystem {
            prime: p,
            variables,
            equations,
        })
    }
}

/// The terms of (x + a)ᵉ modulo a prime, as degrees and coefficients, none of which is zero; of aᵉ where x is no unknown.
fn shifted_power(e: u32, a: u64, is_unknown: bool, p: u64) -> Vec<(u32, u64)> {
    if !is_unknown {
        return vec![(0, power(a, u64::from(e), p))];
    }
    // Row e of Pascal's triangle, from that of 0.
    let mut binomials = vec![1u64];
    for _ in 0..e {
        let next = binomials.windows(2).map(|pair| (pair[0] + pair[1]) % p);
        binomials = std::iter::once(1).chain(next).chain([1]).collect();
    }
    (0..=e)
        .zip(binomials)
        .map(|(degree, binomial)| {
            let rest = power(a, u64::from(e - degree), p);
            (degree, multiply(binomial, rest, p))
        })
        .filter(|(_, c)| *c != 0)
        .collect()
}

/// Images of all generators, each a root of its polynomial at the images of those before; `None` where one has none.
fn images(field: &Field, p: u64) -> Option<Vec<u64>> {
    let mut images: Vec<u64> = Vec::with_capacity(field.generators().len());
    for generator in field.generators() {
        let image = match &generator.relation {
            // The point was made for values of the parameters and does not speak of them.
            _ if generator.parametric => 0,
            Relation::Free | Relation::Inverse(_) => return None,
            Relation::Power { degree: 2, tail } if !tail.mentions(images.len()) => {
                square_root(element_image(tail, &images, p)?, p)?
            }
            Relation::Power { .. } => {
                // 2 cos(2π/M) is ζ + 1/ζ with ζ of order M, which divides p − 1.
                let m = u64::from(field.circle?);
                let zeta = (2..p).map(|g| power(g, (p - 1) / m, p)).find(|&z| {
                    (1..m)
                        .filter(|d| m.is_multiple_of(*d))
                        .all(|d| power(z, d, p) != 1)
                })?;
                (zeta + power(zeta, p - 2, p)) % p
            }
        };
        images.push(image);
    }
    Some(images)
}

fn element_image(a: &Element, images: &[u64], p: u64) -> Option<u64> {
    let mut sum = 0;
    for (exponents, coefficient) in &a.0 {
        let mut term = residue(coefficient, p)?;
        for (image, &e) in images.iter().zip(exponents) {
            term = multiply(term, power(*image, u64::from(e), p), p);
        }
        sum = (sum + term) % p;
    }
    Some(sum)
}

/// A square root modulo a prime, where there is one (Tonelli 1891, Shanks 1973).
fn square_root(a: u64, p: u64) -> Option<u64> {
    if a == 0 {
        return Some(0);
    }
    if power(a, (p - 1) / 2, p) != 1 {
        return None;
    }
    let twos = (p - 1).trailing_zeros();
    let odd = (p - 1) >> twos;
    let nonresidue = (2..p).find(|&g| power(g, (p - 1) / 2, p) == p - 1)?;
    let mut generator = power(nonresidue, odd, p);
    let mut root = power(a, odd.div_ceil(2), p);
    let mut rest = power(a, odd, p);
    let mut order = twos;
    while rest != 1 {
        // The least i with rest^(2^i) = 1.
        let mut i = 0;
        let mut square = rest;
        while square != 1 {
            square = multiply(square, square, p);
            i += 1;
        }
        let step = (0..order - i - 1).fold(generator, |g, _| multiply(g, g, p));
        root = multiply(root, step, p);
        generator = multiply(step, step, p);
        rest = multiply(rest, generator, p);
        order = i;
    }
    Some(root)
}

/// Miller and Rabin's test with the bases that suffice for 64 bits (Sinclair 2011: the first twelve primes do).
fn is_prime(n: u64) -> bool {
    const BASES: [u64; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];
    if n < 2 {
        return false;
    }
    if let Some(small) = BASES.iter().find(|&&b| n.is_multiple_of(b)) {
        return n == *small;
    }
    let twos = (n - 1).trailing_zeros();
    let odd = (n - 1) >> twos;
    BASES.iter().all(|&base| {
        let mut x = power(base, odd, n);
        if x == 1 || x == n - 1 {
            return true;
        }
        for _ in 1..twos {
            x = multiply(x, x, n);
            if x == n - 1 {
                return true;
            }
        }
        false
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_a_shifted_unknown() {
        let p = 10_007;
        let cube = shifted_power(3, 2, true, p);
        assert_eq!(cube, [(0, 8), (1, 12), (2, 6), (3, 1)]);
        assert_eq!(shifted_power(3, 0, true, p), [(3, 1)]);
        assert_eq!(shifted_power(3, 2, false, p), [(0, 8)]);
    }

    #[test]
    fn primes_and_roots() {
        assert!(is_prime(2) && is_prime(97) && is_prime((1 << 61) - 1));
        assert!(!is_prime(1) && !is_prime(91) && !is_prime((1 << 59) - 1));
        for p in [97u64, 1_000_003, (1 << 61) - 1] {
            for a in 1..40 {
                if let Some(root) = square_root(a, p) {
                    assert_eq!(multiply(root, root, p), a);
                }
            }
            assert!((1..40).filter(|&a| square_root(a, p).is_some()).count() > 9);
        }
    }

    #[test]
    fn generators_have_consistent_images() {
        let mut field = Field::with_circle(28).unwrap();
        let two = field.root(&Element::integer(2)).unwrap();
        let nested = field.root(&two.plus(&Element::integer(3))).unwrap();
        let mut p = (1u64 << 61) / 56 * 56 + 1;
        let images = loop {
            p -= 56;
            if let Some(images) = is_prime(p).then(|| images(&field, p)).flatten() {
                break images;
            }
        };
        let square = element_image(&field.square(&nested), &images, p).unwrap();
        let root = element_image(&nested, &images, p).unwrap();
        assert_eq!(multiply(root, root, p), square);
        // An identity of the field holds modulo the prime: cos²(2π/28) + cos²(2π·6/28) = 1.
        let c = super::super::circle::cosine(&field, 1, 28);
        let s = super::super::circle::cosine(&field, 6, 28);
        let [c, s] = [c, s].map(|x| element_image(&x, &images, p).unwrap());
        assert_eq!((multiply(c, c, p) + multiply(s, s, p)) % p, 1);
    }
}
