//! Whether a constraint that others imply agrees with them.

use crate::analysis::s_tree;
use crate::construction::{Construction, NotConstructive, Shape};
use crate::pebbles::Circuit;
use crate::relation::measured;
use crate::sketch::{Constraint, Element, Sketch};
use crate::together::{seconds, together_within};
use kutzbach_math::number::Number;
use std::collections::HashMap;

/// Solutions of the others that are compared, at most.
const MOST_SOLUTIONS: usize = 256;
/// Part of the largest coordinate by which a value may be off that agrees: rounding, with what flat triangles make of it.
const SAME: f64 = 1e-9;

/// What the other constraints say of one that they imply.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Redundancy {
    /// Some of their solutions have its value, to rounding.
    Agrees,
    /// None of them has as it is written, but one has with other digits after those stated; this is its value (length, rad).
    WithinDigits {
        /// That value.
        nearest: f64,
    },
    /// None of their solutions has; this is the nearest value (length, rad).
    Contradicts {
        /// That value.
        nearest: f64,
    },
    /// They have no solutions by ruler and compass, or too many to compare.
    Unknown,
}

/// Compares the constraint of a circuit with all solutions of the independent constraints that imply it; `refused` are the
/// edges that are not independent.
#[must_use]
pub fn redundancy(sketch: &Sketch, circuit: &Circuit, refused: &[usize]) -> Redundancy {
    if let Some(turned) = turned(sketch, circuit, refused) {
        return angle_judged(sketch, circuit, turned);
    }
    if circuit.edge >= sketch.constraints().len() || !sketch.relations().is_empty() {
        return judged_at_once(sketch, circuit, refused).unwrap_or(Redundancy::Unknown);
    }
    let local = |e: usize| circuit.vertices.binary_search(&e).ok();
    let elements: Vec<Element> = circuit
        .vertices
        .iter()
        .map(|&e| sketch.elements()[e])
        .collect();
    let moved = |(i, c): (usize, &Constraint)| {
        let [u, v] = c.ends;
        (!refused.contains(&i)).then_some(())?;
        Some(Constraint {
            ends: [local(u)?, local(v)?],
            value: c.value.clone(),
        })
    };
    let constraints = sketch.constraints().iter().enumerate().filter_map(moved);
    let Ok(others) = Sketch::new(elements, constraints.collect()) else {
        return Redundancy::Unknown;
    };
    let rigid = sketch
        .rigid_triangles()
        .into_iter()
        .filter_map(|(three, places)| {
            let [a, b, c] = three.map(local);
            Some(([a?, b?, c?], places))
        });
    let others = others.with_rigid(rigid.collect());
    let Ok(construction) = Construction::new(&others) else {
        return Redundancy::Unknown;
    };
    let asked = &sketch.constraints()[circuit.edge];
    let [Some(u), Some(v)] = asked.ends.map(local) else {
        return Redundancy::Unknown;
    };
    let value = asked.value.value();
    let angle = asked
        .ends
        .iter()
        .all(|&e| matches!(sketch.elements()[e], Element::Line { .. }));
    let mut nearest: Option<(f64, f64, Vec<bool>)> = None;
    let mut solutions = construction.solutions();
    for solution in solutions.by_ref().take(MOST_SOLUTIONS) {
        let found = Construction::value_between(&solution.shapes[u], &solution.shapes[v]);
        let off = match angle {
            true => (found - value).sin().atan2((found - value).cos()).abs(),
            false => (found - value).abs(),
        };
        let size = solution.shapes.iter().map(Shape::extent);
        let size = if angle {
            1.0
        } else {
            size.fold(value.abs(), f64::max)
        };
        if off <= SAME * size {
            return Redundancy::Agrees;
        }
        if nearest.as_ref().is_none_or(|(least, ..)| off < *least) {
            nearest = Some((off, found, solution.left));
        }
    }
    let count = construction.count();
    let all = count.complete && !count.degenerate && count.between.is_none();
    let Some((off, nearest, left)) = nearest else {
        return Redundancy::Unknown;
    };
    match off <= left_open(&asked.value) + spread(&others, [u, v], &left, nearest) {
        true => Redundancy::WithinDigits { nearest },
        false if all && solutions.next().is_none() => Redundancy::Contradicts { nearest },
        false => Redundancy::Unknown,
    }
}

/// Seconds of work for what a circuit with relations leaves.
const WORK: f64 = 2.0;

/// The same where relations are among the others, or refused: at all places that the others leave.
fn judged_at_once(sketch: &Sketch, circuit: &Circuit, refused: &[usize]) -> Option<Redundancy> {
    let count = sketch.constraints().len();
    let local = |e: usize| circuit.vertices.binary_search(&e).ok();
    let same = |v: usize| Some(v);
    let elements = circuit.vertices.iter().map(|&e| sketch.elements()[e]);
    let kept = |i: &usize| !refused.contains(i);
    let constraints = sketch.constraints().iter().enumerate();
    let constraints = constraints.filter(|(i, _)| kept(i)).filter_map(|(_, c)| {
        Some(Constraint {
            ends: [local(c.ends[0])?, local(c.ends[1])?],
            value: c.value.clone(),
        })
    });
    let constraints: Vec<Constraint> = constraints.collect();
    let open: f64 = constraints.iter().map(|c| left_open(&c.value)).sum();
    let relations = sketch.relations().iter().enumerate();
    let relations = relations.filter(|(i, _)| kept(&(count + i)));
    let relations = relations
        .filter_map(|(_, r)| r.moved(local, same))
        .collect();
    let values = sketch.unknown_values();
    let others = Sketch::new(elements.collect(), constraints).ok()?;
    let others = others.with_relations(relations, values).ok()?;
    let asked = sketch.constraints().get(circuit.edge);
    let relation = sketch.relations().get(circuit.edge.wrapping_sub(count));
    let mut nearest: Option<(f64, f64)> = None;
    for all in &all_solutions(&others)? {
        let (off, value) = match (asked, relation) {
            (Some(c), _) => {
                let [u, v] = [local(c.ends[0])?, local(c.ends[1])?];
                let value = Construction::value_between(&all[u], &all[v]);
                let off = value - c.value.value();
                let angle = all[u].is_line() && all[v].is_line();
                (
                    if angle {
                        off.sin().atan2(off.cos())
                    } else {
                        off
                    }
                    .abs(),
                    value,
                )
            }
            (None, Some(relation)) => {
                let known = measured(others.relations().iter(), all, values);
                let off = relation.moved(local, same)?.off(all, &known);
                (off, off)
            }
            (None, None) => return None,
        };
        let size = all.iter().map(Shape::extent).fold(1.0, f64::max);
        if off <= SAME * size {
            return Some(Redundancy::Agrees);
        }
        if off.is_nan() {
            return None;
        }
        if nearest.is_none_or(|(least, _)| off < least) {
            nearest = Some((off, value));
        }
    }
    let (off, nearest) = nearest?;
    // Values of rounded digits move what they leave by some multiple of what they are off; how far was not calculated.
    (open == 0.0 || off > SURELY * open).then_some(Redundancy::Contradicts { nearest })
}

/// More than so many times what digits leave open is no matter of digits, unless elements lie nearly degenerate.
const SURELY: f64 = 1e3;

/// All solutions of a well-constrained sketch; `None` where they are not known to be all, or are too many to compare.
fn all_solutions(sketch: &Sketch) -> Option<Vec<Vec<Shape>>> {
    let construction = match Construction::new(sketch) {
        Ok(construction) => construction,
        Err(NotConstructive::Clusters(_)) => {
            let tree = s_tree(sketch.graph());
            let found = together_within(sketch, &tree, &seconds(WORK));
            let all = found.solutions(sketch, MOST_SOLUTIONS)?;
            return Some(all.into_iter().map(|(shapes, _)| shapes).collect());
        }
        Err(_) => return None,
    };
    let count = construction.count();
    let sure = count.complete && !count.degenerate && count.between.is_none();
    count
        .value()
        .filter(|&c| sure && c <= MOST_SOLUTIONS as u128)?;
    Some(construction.solutions().map(|s| s.shapes).collect())
}

/// How far the second line of a circuit's angle is turned from the first one by the other angles of the circuit, and how far digits leave that
/// open (rad); `None` where it is no angle, or where the others do not lead from one to the other.
fn turned(sketch: &Sketch, circuit: &Circuit, refused: &[usize]) -> Option<(f64, f64)> {
    let is_line = |e: &usize| sketch.elements()[*e].is_line();
    let [from, to] = sketch.constraints().get(circuit.edge)?.ends;
    if !circuit.vertices.iter().all(is_line) {
        return None;
    }
    let angles = sketch.constraints().iter().enumerate().filter(|(i, c)| {
        let inside = |e: &usize| circuit.vertices.binary_search(e).is_ok();
        !refused.contains(i) && c.ends.iter().all(inside)
    });
    let angles: Vec<&Constraint> = angles.map(|(_, c)| c).collect();
    let mut known: HashMap<usize, (f64, f64)> = HashMap::from([(from, (0.0, 0.0))]);
    let mut open = vec![from];
    while let Some(at) = open.pop() {
        let (angle, spread) = known[&at];
        for c in &angles {
            let (next, sign) = match c.ends {
                [u, v] if u == at => (v, 1.0),
                [u, v] if v == at => (u, -1.0),
                _ => continue,
            };
            known.entry(next).or_insert_with(|| {
                open.push(next);
                (angle + sign * c.value.value(), spread + left_open(&c.value))
            });
        }
    }
    known.get(&to).copied()
}

/// Whether an angle is the one that others make; a whole turn is none.
fn angle_judged(sketch: &Sketch, circuit: &Circuit, (nearest, spread): (f64, f64)) -> Redundancy {
    let asked = &sketch.constraints()[circuit.edge].value;
    let off = nearest - asked.value();
    let off = off.sin().atan2(off.cos()).abs();
    if off <= SAME {
        Redundancy::Agrees
    } else if off <= left_open(asked) + spread {
        Redundancy::WithinDigits { nearest }
    } else {
        Redundancy::Contradicts { nearest }
    }
}

/// Constraints whose digits are looked at, at most: each is a construction anew.
const MOST_CONSTRAINTS: usize = 400;

/// Values of fewer decimals are meant as they are.
const ROUNDED: i32 = 3;

/// Half a unit of the last decimal that a rounded value states.
fn left_open(value: &Number) -> f64 {
    let stated = value.stated().filter(|s| s.decimals >= ROUNDED);
    stated.map_or(0.0, |s| 0.5 * 10_f64.powi(-s.decimals))
}

/// How far the value between two elements may be off, to first order, with other digits of all constraints; zero where these are too many.
fn spread(sketch: &Sketch, [u, v]: [usize; 2], left: &[bool], value: f64) -> f64 {
    let constraints = sketch.constraints();
    if constraints.len() > MOST_CONSTRAINTS {
        return 0.0;
    }
    let moved = |i: usize| -> Option<f64> {
        let by = left_open(&constraints[i].value);
        if by == 0.0 {
            return None;
        }
        let other = Number::from_f64(constraints[i].value.value() + by)?;
        let other = sketch.with_value(i, other);
        let solution = Construction::new(&other).ok()?.with_sides(left).ok()?;
        let shapes = &solution.shapes;
        Some((Construction::value_between(&shapes[u], &shapes[v]) - value).abs())
    };
    (0..constraints.len()).filter_map(moved).sum()
}
