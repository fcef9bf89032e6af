//! Poses at a small distance from one where branches meet, and crossings at small angles.

use super::drawn::{
    Place, Triple, built, circle_point, four_bar, integers, isogram, power_of_ten, ratio,
};
use super::ladder::{Known, Ladder, Law, Rung, regular, singular};
use super::offsets::DEEP;
use kutzbach::mechanism::{JointKind, Mechanism};
use kutzbach::number::Number;

fn half(x: &Number) -> Number {
    x * &ratio(1, 2)
}

fn point(x: Number, y: Number) -> Triple {
    [x, y, Number::zero()]
}

/// A slider-crank of crank and rod 1 m whose crank is `2 atan(epsilon / 2)`, about `epsilon` rad, from upright.
///
/// With the slider at s and the crank's end at B = (cos θ, sin θ) the rod asks for |s − B| = 1, that is s (s − 2 cos θ) = 0:
/// the slider stays while crank and rod turn as one, or it moves by 2 cos θ. The two curves cross where s = 0 and cos θ = 0
/// (two branches, one finite and two instantaneous freedoms); elsewhere on the second the pose is regular.
fn slider_crank(epsilon: &Number) -> Mechanism {
    let (y, x) = circle_point(&half(epsilon));
    let slider = point(&Number::integer(2) * &x, Number::zero());
    let up = || integers(0, 0, 1);
    let places = [
        Place::hinge("crank_pin", ["ground", "crank"], integers(0, 0, 0), up()),
        Place::hinge("rod_pin", ["crank", "rod"], point(x, y), up()),
        Place::hinge("slider_pin", ["rod", "slider"], slider.clone(), up()),
        Place::new(
            "slide",
            JointKind::Prismatic,
            ["ground", "slider"],
            slider,
            integers(1, 0, 0),
        ),
    ];
    built("isosceles_slider_crank", &places)
}

/// Three equal parallel cranks of 1 m on a line, 1 m and 2 m apart, with one coupler, `2 atan(epsilon / 2)` rad from flat.
///
/// Each crank keeps its end of the coupler from moving along the crank: three forces on parallel lines, which are different
/// unless the cranks are flat, and of which two are independent. So the coupler has 3 − 2 freedoms at the instant, and it
/// does translate along a circle: regular, one freedom, one branch. The two loops have six equations of which one or more
/// depend on the others.
fn three_cranks(epsilon: &Number) -> Mechanism {
    let (x, y) = circle_point(&half(epsilon));
    let tip = |foot: i64| point(&x + &Number::integer(foot), y.clone());
    let up = || integers(0, 0, 1);
    let foot = |x: i64| integers(x, 0, 0);
    let places = [
        Place::hinge("A", ["ground", "crank_a"], foot(0), up()),
        Place::hinge("B", ["ground", "crank_b"], foot(1), up()),
        Place::hinge("C", ["ground", "crank_c"], foot(3), up()),
        Place::hinge("a", ["crank_a", "coupler"], tip(0), up()),
        Place::hinge("b", ["crank_b", "coupler"], tip(1), up()),
        Place::hinge("c", ["crank_c", "coupler"], tip(3), up()),
    ];
    built("three_cranks", &places)
}

/// Four hinges through one point: (1, 0, 2), (2, e, 1) and their images under the half turn about z.
///
/// Four directions of three dimensions unless they lie in a plane, which they do at e = 0 only: then the equations of the
/// spherical loop are independent, and it moves with 4 − 3 freedoms at a regular pose.
fn spherical(epsilon: &Number) -> Mechanism {
    let two = || Number::integer(2);
    let directions = [
        integers(1, 0, 2),
        [two(), epsilon.clone(), Number::one()],
        integers(-1, 0, 2),
        [-two(), -epsilon, Number::one()],
    ];
    let [a, b, c, d] = directions;
    let hinge = |name, links, along| Place::hinge(name, links, integers(0, 0, 0), along);
    let places = [
        hinge("A", ["ground", "crank"], a),
        hinge("B", ["crank", "coupler"], b),
        hinge("D", ["ground", "rocker"], d),
        hinge("C", ["coupler", "rocker"], c),
    ];
    built("flattening_spherical", &places)
}

/// A four-bar drawn on a line: crank 1, coupler 2, rocker 3 − d, ground d, which add up to a flat pose.
///
/// To first order the end of the coupler is where the rocker has it if 1 α + 2 β = (3 − d) γ, with the angles of crank,
/// coupler and rocker; to second order if α² + 2 β² = (3 − d) γ². Without γ that is a form in α and β of discriminant
/// 1 · 2 · (3 − d) · d. For d > 0 it is positive: two curves cross, at an angle of the order of √d. For d < 0 it is
/// negative: the pose is isolated.
fn flat(name: &str, ground: &Number) -> Mechanism {
    let hinges = four_bar([
        integers(0, 0, 0),
        integers(1, 0, 0),
        integers(3, 0, 0),
        point(ground.clone(), Number::zero()),
    ]);
    built(name, &hinges)
}

/// The Bennett linkage over a parallelogram whose corners come into line: (1, 0, 0), (2, e, 0)… lifted by e.
///
/// A skew isogram for every e but zero, so that it moves with one freedom, at a regular pose (see [`super::twists`]). All its
/// sides lie on one line where e vanishes.
fn folded_bennett(epsilon: &Number) -> Mechanism {
    let a = integers(1, 0, 0);
    let b = [Number::integer(2), epsilon.clone(), epsilon.clone()];
    built("folding_bennett", &isogram(&a, &b, &integers(0, 0, 0)))
}

type Build<'a> = &'a dyn Fn(&Number) -> Mechanism;

pub fn ladders() -> Vec<Ladder> {
    let ladder = |name, parameter, law: Option<fn(f64) -> f64>, build: Build<'_>, known: Known| {
        let rung = |exponent: u32| {
            let exponent = -(exponent as i32);
            Rung::at(exponent, build(&power_of_ten(exponent)), known)
        };
        Ladder {
            name,
            parameter,
            law: law.map(|decades| Law::new(3.0, decades)),
            rungs: DEEP.into_iter().map(rung).collect(),
        }
    };
    let mut crank = ladder(
        "isosceles_slider_crank",
        "crank angle from upright (rad)",
        Some(|d| d),
        &slider_crank,
        regular(1),
    );
    let upright = slider_crank(&Number::zero());
    crank.rungs.push(Rung::limit(upright, singular(1, 2, 2)));
    vec![
        crank,
        ladder(
            "three_cranks",
            "cranks out of the flat pose (rad)",
            Some(|d| d),
            &three_cranks,
            regular(1),
        ),
        ladder(
            "flattening_spherical",
            "hinges out of their plane (rad)",
            Some(|d| d),
            &spherical,
            regular(1),
        ),
        ladder(
            "folding_bennett",
            "corners out of line (m)",
            None,
            &folded_bennett,
            regular(1),
        ),
        // The pose is flat for every ground, of rank 2.
        ladder(
            "narrow_crossing",
            "ground of a flat four-bar (m)",
            Some(|_| 0.0),
            &|ground| flat("narrow_crossing", ground),
            singular(1, 2, 2),
        ),
        ladder(
            "narrowly_isolated",
            "ground of a flat four-bar, reversed (m)",
            Some(|_| 0.0),
            &|ground| flat("narrowly_isolated", &-ground),
            singular(0, 2, 0),
        ),
    ]
}
