//! Twists that vanish.

use super::drawn::{built, integers, isogram, power_of_ten, ratio, rectangle};
use super::ladder::{Known, Ladder, Law, Rung, regular};
use super::offsets::DEEP;
use kutzbach::mechanism::Mechanism;
use kutzbach::number::Number;

/// A Bennett linkage over the flat parallelogram (1, 0), (1, 1), (−1, 0), (−1, −1), two opposite corners lifted by `h`: its
/// twists are `atan(h)`-like, about `h` and `√5 h` rad, its sides 1 m and √5 m.
///
/// A skew isogram with each hinge across its two sides is a Bennett linkage (Bennett 1903): one finite freedom. Its
/// instantaneous freedom is one at every `h`: four axes of rank 2 or less would have to lie in a pencil, which is flat, and
/// the corners are not in line. So every member is regular, with one branch. At 0 it is a planar parallelogram that is not
/// folded, of which the same is true.
fn bennett(h: &Number) -> Mechanism {
    let a = integers(1, 0, 0);
    let b = [Number::one(), Number::one(), h.clone()];
    built("bennett_twist", &isogram(&a, &b, &integers(0, 0, 0)))
}

/// A rectangular parallelogram of which one hinge is turned towards the crank by `atan(epsilon)`.
///
/// Three parallel hinges that are not in a plane are independent, and span the velocities of their plane only. The fourth
/// direction is none of these unless `epsilon` is zero: four independent axes, rigid and regular. At 0 it moves with one
/// freedom.
fn tilted(epsilon: &Number) -> Mechanism {
    let mut hinges = rectangle(&Number::integer(2));
    hinges[0].along = [Number::zero(), epsilon.clone(), Number::one()];
    built("tilted_hinge", &hinges)
}

pub fn ladders() -> Vec<Ladder> {
    let ladder = |name, parameter, law, build: fn(&Number) -> Mechanism, known: Known| {
        // The first rung is one degree (1/57).
        let degree = ratio(1, 57);
        let mut rungs = vec![Rung {
            label: "1 deg".to_owned(),
            decades: Some(degree.value().log10()),
            mechanism: build(&degree),
            configuration: None,
            known,
        }];
        let exponents = DEEP.into_iter().filter(|e| *e >= 2);
        rungs.extend(exponents.map(|exponent| {
            let exponent = -(exponent as i32);
            Rung::at(exponent, build(&power_of_ten(exponent)), known)
        }));
        rungs.push(Rung::limit(build(&Number::zero()), regular(1)));
        Ladder {
            name,
            parameter,
            law: Some(Law::new(2.0, law)),
            rungs,
        }
    };
    vec![
        // Rank 3, at the limit too: nothing vanishes.
        ladder(
            "bennett_twist",
            "twists of all sides (rad)",
            |_| 0.0,
            bennett,
            regular(1),
        ),
        // The fourth axis is as far from the space of the others as it is tilted.
        ladder(
            "tilted_hinge",
            "one hinge of four parallel ones turned by (rad)",
            |decades| decades,
            tilted,
            regular(0),
        ),
    ]
}
