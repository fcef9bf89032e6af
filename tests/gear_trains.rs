//! Gear trains on moving carriers, against Willis in exact numbers: the rate of each wheel seen from the carrier is the ratio times that of
//! the other. Axes point in any sense, any link is the root, and any tree of hinges holds the wheels.

use crate::support;

use kutzbach::matrix::SplitMix64;
use kutzbach::mechanism::{CouplingOrigin, Mechanism};
use kutzbach::number::Number;
use std::fmt::Write;

/// A hinge: its links, whether it is one of a planet's across the main axis, and whether its axis points backwards.
struct Hinge {
    links: [usize; 2],
    across: bool,
    reversed: bool,
}

/// Wheels and carriers. Link 0 is the ground; rates are unknowns, by link, those of planets across the main axis as seen from their carrier.
struct Train {
    links: usize,
    hinges: Vec<Hinge>,
    /// Carrier, both wheels, and the ratio.
    gears: Vec<([usize; 3], [i64; 2])>,
}

fn fraction([p, q]: [i64; 2]) -> Number {
    Number::ratio(p, q).unwrap()
}

impl Train {
    /// One to three carriers, two to four wheels and one to three planets.
    fn random(case: u64) -> Self {
        let mut random = SplitMix64::new(0x6EA2_0000 + case);
        let mut below = |most: usize| (random.next_u64() % most as u64) as usize;
        let central = 3 + below(4);
        let bevel = below(2) == 0;
        let mut hinges = Vec::new();
        // The ground, carriers and central wheels in any tree of hinges about the main axis.
        for link in 1..central {
            hinges.push(Hinge {
                links: [below(link), link],
                across: false,
                reversed: below(2) == 0,
            });
        }
        let planets = 1 + below(3);
        let carriers = 1 + below(central.min(3));
        let mut gears = Vec::new();
        let ratio = |below: &mut dyn FnMut(usize) -> usize| {
            let p = 1 + below(5) as i64;
            let sign = if below(2) == 0 { 1 } else { -1 };
            [sign * p, 1 + below(4) as i64]
        };
        for planet in central..central + planets {
            let carrier = below(carriers);
            hinges.push(Hinge {
                links: [carrier, planet],
                across: bevel,
                reversed: below(2) == 0,
            });
            for _ in 0..2 {
                let wheel = below(central);
                let ends = if below(2) == 0 {
                    [wheel, planet]
                } else {
                    [planet, wheel]
                };
                if wheel != carrier {
                    gears.push(([carrier, ends[0], ends[1]], ratio(&mut below)));
                }
            }
        }
        let [carrier, one, other] = [0; 3].map(|_| below(central));
        if carrier != one && carrier != other && one != other {
            gears.push(([carrier, one, other], ratio(&mut below)));
        }
        Self {
            links: central + planets,
            hinges,
            gears,
        }
    }

    /// The hinges on the way between two links, the last one last.
    fn way(&self, from: usize, to: usize) -> Vec<usize> {
        let mut found = vec![None; self.links];
        let mut open = vec![(from, Vec::new())];
        while let Some((link, way)) = open.pop() {
            if found[link].is_some() {
                continue;
            }
            for (number, hinge) in self.hinges.iter().enumerate() {
                if let Some(side) = hinge.links.iter().position(|l| *l == link) {
                    let mut longer: Vec<usize> = way.clone();
                    longer.push(number);
                    open.push((hinge.links[1 - side], longer));
                }
            }
            found[link] = Some(way);
        }
        found[to].take().unwrap()
    }

    fn is_across(&self, link: usize) -> bool {
        self.hinges.iter().any(|h| h.across && h.links[1] == link)
    }

    /// Willis' equations in the rates of all links; that of the ground is zero.
    fn equations(&self) -> Vec<Vec<Number>> {
        let mut rows = vec![vec![Number::zero(); self.links]];
        rows[0][0] = Number::one();
        for ([carrier, one, other], ratio) in &self.gears {
            let mut row = vec![Number::zero(); self.links];
            let bevel = self.is_across(*one) != self.is_across(*other);
            for (link, factor) in [(*other, Number::one()), (*one, -&fraction(*ratio))] {
                // Shafts across each other count about their own axes, all others in one direction.
                let last = *self.way(*carrier, link).last().unwrap();
                let backwards = bevel && self.hinges[last].reversed;
                let factor = if backwards { -&factor } else { factor };
                row[link] = &row[link] + &factor;
                if !self.is_across(link) {
                    row[*carrier] = &row[*carrier] - &factor;
                }
            }
            rows.push(row);
        }
        rows
    }

    /// The file, with another link as the root of the tree, and how the hinges are named.
    fn text(&self, root: usize) -> String {
        let mut text = String::from("<robot name=\"train\">");
        (0..self.links).for_each(|l| {
            let _ = write!(text, "<link name=\"l{l}\"/>");
        });
        let mut reached = vec![root];
        let mut next = 0;
        while let Some(&link) = reached.get(next) {
            next += 1;
            for (number, hinge) in self.hinges.iter().enumerate() {
                let Some(side) = hinge.links.iter().position(|l| *l == link) else {
                    continue;
                };
                let child = hinge.links[1 - side];
                if reached.contains(&child) {
                    continue;
                }
                reached.push(child);
                let sign = if hinge.reversed { -1 } else { 1 };
                let axis = if hinge.across { [2, -1, 0] } else { [1, 2, 2] };
                let [x, y, z] = axis.map(|c| sign * c);
                let _ = write!(
                    text,
                    "<joint name=\"h{number}\" type=\"continuous\"><parent link=\"l{link}\"/><child link=\"l{child}\"/>\
                     <origin xyz=\"{number} 1 0\"/><axis xyz=\"{x} {y} {z}\"/></joint>"
                );
            }
        }
        for (number, ([carrier, one, other], [p, q])) in self.gears.iter().enumerate() {
            let _ = write!(
                text,
                "<coupling name=\"g{number}\"><predecessor link=\"l{one}\"/><successor link=\"l{other}\"/>\
                 <ratio value=\"${{{p}/{q}}}\"/><carrier link=\"l{carrier}\"/></coupling>"
            );
        }
        text + "<ground link=\"l0\"/></robot>"
    }

    /// What the couplings of a mechanism say of the rates of all links.
    fn told(&self, mechanism: &Mechanism) -> Vec<Vec<Number>> {
        let mut rows = vec![vec![Number::zero(); self.links]];
        rows[0][0] = Number::one();
        for coupling in mechanism.couplings() {
            let CouplingOrigin::Ratio { assumed, .. } = &coupling.origin else {
                panic!("no ratio")
            };
            assert!(assumed.is_empty(), "{assumed:?}");
            let mut row = vec![Number::zero(); self.links];
            for term in &coupling.terms {
                let joint = mechanism.joint(term.joint);
                let hinge: usize = joint.name[1..].parse().unwrap();
                let hinge = &self.hinges[hinge];
                let number = |link| mechanism.link(link).name[1..].parse::<usize>().unwrap();
                let [parent, child] =
                    [&joint.predecessor, &joint.successor].map(|s| number(s.link));
                let factor = if hinge.reversed {
                    -&term.factor
                } else {
                    term.factor.clone()
                };
                if hinge.across {
                    // The planet's rate is that seen from its carrier, whichever is drawn first.
                    let planet = hinge.links[1];
                    let factor = if child == planet { factor } else { -&factor };
                    row[planet] = &row[planet] + &factor;
                } else {
                    row[child] = &row[child] + &factor;
                    row[parent] = &row[parent] - &factor;
                }
            }
            rows.push(row);
        }
        rows
    }
}

/// The reduced echelon form, exact.
fn reduced(mut rows: Vec<Vec<Number>>) -> Vec<Vec<Number>> {
    let columns = rows[0].len();
    let mut done = 0;
    for column in 0..columns {
        let Some(pivot) = (done..rows.len()).find(|&r| !rows[r][column].is_zero()) else {
            continue;
        };
        rows.swap(done, pivot);
        let lead = rows[done][column].clone();
        for entry in &mut rows[done] {
            *entry = entry.checked_div(&lead).unwrap();
        }
        let own = rows[done].clone();
        for (number, row) in rows.iter_mut().enumerate() {
            let factor = row[column].clone();
            if number != done && !factor.is_zero() {
                for (entry, other) in row.iter_mut().zip(&own) {
                    *entry = &*entry - &(&factor * other);
                }
            }
        }
        done += 1;
    }
    rows.truncate(done);
    rows
}

/// The same rates are possible, and as many of them are independent, from three roots.
fn check(case: u64) {
    let train = Train::random(case);
    let wanted = reduced(train.equations());
    for root in [0, 1, train.links - 1] {
        let text = train.text(root);
        let reading = kutzbach::format::read(&text, "train.urdf", &[]);
        let mechanism = reading
            .unwrap_or_else(|e| panic!("{case}: {e}\n{text}"))
            .mechanism;
        assert_eq!(
            reduced(train.told(&mechanism)),
            wanted,
            "case {case}, root {root}: {text}"
        );
        let finite = support::analysis(&mechanism).mobility.finite();
        assert_eq!(
            finite,
            Some(train.links - wanted.len()),
            "case {case}, root {root}: {text}"
        );
    }
}

#[test]
fn random_trains_obey_willis_from_any_root() {
    (0..60).for_each(check);
}

mod corpus {
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn many_random_trains_obey_willis_from_any_root() {
        (60..300).for_each(super::check);
    }
}
