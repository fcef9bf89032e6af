//! Mechanisms whose poses near home are the zeros of polynomials.
//!
//! The polynomial p in sin θ₁, sin θ₂, … is a sum of cosines and sines of whole combinations of the angles. An arm of links that gears
//! turn by these combinations has in its x what the sum says, and a contact holds its tip at the x that it has at home: the
//! mechanism closes where p = 0. The inputs θᵢ are free hinges on the ground. Since sin θ is θ up to a change of coordinates, the germ is
//! that of p.

use super::polynomial::Polynomial;
use kutzbach::mechanism::{Direction, Frame, JointBuilder, JointKind, Mechanism, MechanismBuilder};
use kutzbach::number::Number;
use std::collections::BTreeMap;

/// Complex coefficients by the combination of angles that they turn with.
type Waves = BTreeMap<Vec<i64>, [Number; 2]>;

/// The mechanism that is closed where all polynomials vanish.
pub fn mechanism(name: &str, polynomials: &[Polynomial]) -> Mechanism {
    let mut builder = MechanismBuilder::new(name);
    builder.link("ground");
    for input in 0..polynomials[0].variables {
        let (joint, link) = (format!("theta{input}"), format!("in{input}"));
        builder.link(&link);
        builder.joint(hinge(&joint, "ground", &link).origin(at(-2 - input as i64, 0)));
    }
    for (index, polynomial) in polynomials.iter().enumerate() {
        add_arm(&mut builder, index, &waves(polynomial));
    }
    builder.build().unwrap()
}

fn at(x: i64, y: i64) -> Frame {
    Frame::at([Number::integer(x), Number::integer(y), Number::zero()])
}

fn hinge(name: &str, parent: &str, child: &str) -> JointBuilder {
    let up = Direction([Number::zero(), Number::zero(), Number::one()]);
    JointBuilder::tree(name, JointKind::Revolute, parent, child).axis(up)
}

/// An arm on the ground, one vector in each body that turns with a combination of the inputs, and the contact at its tip.
fn add_arm(builder: &mut MechanismBuilder, index: usize, waves: &Waves) {
    let mut tip = ("ground".to_owned(), [Number::zero(), Number::zero()]);
    let mut home = [Number::zero(), Number::zero()];
    let mut turned: Vec<i64> = Vec::new();
    let mut links = 0;
    for (angles, c) in waves {
        let positive = angles.iter().find(|m| **m != 0).is_some_and(|m| *m > 0);
        if !positive {
            continue; // That is the conjugate of another, or the constant term.
        }
        turned.resize(angles.len(), 0);
        for (input, (wanted, has)) in angles.iter().zip(&mut turned).enumerate() {
            if wanted == has {
                continue;
            }
            let (joint, link) = (format!("j{index}_{links}"), format!("a{index}_{links}"));
            links += 1;
            builder.link(&link);
            let [x, y] = tip.1;
            builder.joint(hinge(&joint, &tip.0, &link).origin(Frame::at([x, y, Number::zero()])));
            let gear = Number::integer(wanted - *has);
            builder.mimic(&joint, &format!("theta{input}"), gear, Number::zero());
            tip = (link, [Number::zero(), Number::zero()]);
            *has = *wanted;
        }
        // c e^{imθ} and its conjugate together are the x of the vector (2 Re c, 2 Im c) turned by mθ.
        let two = Number::integer(2);
        tip.1 = [&two * &c[0], &two * &c[1]];
        home = [&home[0] + &tip.1[0], &home[1] + &tip.1[1]];
    }
    let frame = |[x, y]: [Number; 2]| Frame::at([x, y, Number::zero()]);
    let normal = Direction([Number::one(), Number::zero(), Number::zero()]);
    builder.joint(
        JointBuilder::closing(
            &format!("contact{index}"),
            JointKind::PointOnPlane,
            &tip.0,
            "ground",
        )
        .origin(frame(tip.1))
        .successor_origin(frame(home))
        .axis2(normal),
    );
}

/// The polynomial of sines as a sum of e^{imθ}.
fn waves(polynomial: &Polynomial) -> Waves {
    let mut all = Waves::new();
    for (exponents, c) in &polynomial.terms {
        let mut product: Waves =
            BTreeMap::from([(vec![0; polynomial.variables], [c.clone(), Number::zero()])]);
        for (variable, exponent) in exponents.iter().enumerate() {
            for _ in 0..*exponent {
                product = times_sine(&product, variable);
            }
        }
        for (angles, value) in product {
            add(&mut all, angles, value);
        }
    }
    all.retain(|_, [re, im]| !re.is_zero() || !im.is_zero());
    all
}

/// The product with sin θ = (e^{iθ} − e^{−iθ}) / 2i.
fn times_sine(waves: &Waves, variable: usize) -> Waves {
    let half = Number::ratio(1, 2).unwrap();
    let mut product = Waves::new();
    for (angles, [re, im]) in waves {
        let quarter = [im * &half, -(re * &half)];
        for (step, [re, im]) in [(1, quarter.clone()), (-1, quarter.map(|x| -x))] {
            let mut there = angles.clone();
            there[variable] += step;
            add(&mut product, there, [re, im]);
        }
    }
    product
}

fn add(waves: &mut Waves, angles: Vec<i64>, [re, im]: [Number; 2]) {
    let own = waves
        .entry(angles)
        .or_insert_with(|| [Number::zero(), Number::zero()]);
    *own = [&own[0] + &re, &own[1] + &im];
}
