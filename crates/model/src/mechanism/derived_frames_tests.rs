//! What is said of derived frames is held against frames whose numbers are others within half a unit of their last digit, multiplied exactly.

#![allow(clippy::unwrap_used)]

use super::super::ExactPose;
use super::*;

/// Numbers that look random, the same every time (Knuth's MMIX generator), in −1 … 1.
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// A frame of numbers of so many decimals, and one that these numbers may be meant for.
fn rounded(dice: &mut Dice, decimals: usize) -> [Frame; 2] {
    let half = 0.5 * 0.1f64.powi(decimals as i32);
    let mut number = |size: f64| {
        let text = format!("{:.decimals$}", size * dice.roll());
        let written = Number::decimal(&text).unwrap();
        let off = Number::from_f64(half * dice.roll()).unwrap();
        [&written + &off, written]
    };
    let [x, y, z] = [2.0, 2.0, 2.0].map(&mut number);
    let [roll, pitch, yaw] = [3.0, 1.2, 3.0].map(&mut number);
    [1, 0].map(|which: usize| Frame {
        position: [x[which].clone(), y[which].clone(), z[which].clone()],
        roll_pitch_yaw: [
            roll[which].clone(),
            pitch[which].clone(),
            yaw[which].clone(),
        ],
    })
}

fn numbers(frame: &Frame) -> [f64; 6] {
    let [x, y, z] = frame.position.each_ref().map(Number::value);
    let [roll, pitch, yaw] = frame.roll_pitch_yaw.each_ref().map(Number::value);
    [x, y, z, roll, pitch, yaw]
}

/// How far the numbers of a frame may be off, if their literals are by so much.
fn spreads(frame: &Frame, literal: f64) -> [f64; 6] {
    let of = |number: &Number| {
        let slopes = number.inputs().iter().map(|input| input.slope);
        slopes.sum::<f64>() * literal
    };
    let [x, y, z] = frame.position.each_ref().map(of);
    let [roll, pitch, yaw] = frame.roll_pitch_yaw.each_ref().map(of);
    [x, y, z, roll, pitch, yaw]
}

#[test]
fn what_was_meant_lies_within_the_spread() {
    let mut dice = Dice(3);
    let (mut within, mut nearest) = (0, 0.0f64);
    for decimals in [4, 5, 6, 9] {
        for _ in 0..6 {
            let [first, second, third] = [(); 3].map(|()| rounded(&mut dice, decimals));
            let derived = Frame::between(&[&first[0]], &[&second[0], &third[0]]).unwrap();
            let [a, b, c] = [&first[1], &second[1], &third[1]].map(ExactPose::of);
            let meant = a.inverse().then(&b).then(&c).frame().unwrap();
            let half = 0.5 * 0.1f64.powi(decimals as i32);
            let (found, meant) = (numbers(&derived), numbers(&meant));
            for (i, spread) in spreads(&derived, half).into_iter().enumerate() {
                let turn = std::f64::consts::TAU;
                let mut off = found[i] - meant[i];
                if i >= 3 {
                    off -= turn * (off / turn).round();
                }
                // Products of two uncertainties are left out; doubles round.
                let room = 1.0 + 1e3 * half;
                assert!(
                    off.abs() <= spread * room + 1e-13,
                    "{i} of {decimals} decimals: {off:e} is more than {spread:e}"
                );
                nearest = nearest.max(off.abs() / spread);
                within += 1;
            }
        }
    }
    // It says something: none is held against a spread of its own making that nothing comes near.
    assert!(within == 144 && nearest > 0.3, "{nearest}");
}

#[test]
fn an_angle_counts_with_its_lever_arm() {
    let number = |text: &str| Number::decimal(text).unwrap();
    let turned = Frame {
        roll_pitch_yaw: [Number::zero(), Number::zero(), number("0.123457")],
        ..Frame::identity()
    };
    let three_away = Frame::at([Number::integer(3), Number::zero(), Number::zero()]);
    let tip = Frame::between(&[], &[&turned, &three_away]).unwrap();
    let [x, y, z, roll, pitch, yaw] = spreads(&tip, 0.5e-6);
    let (sine, cosine) = 0.123457f64.sin_cos();
    assert!((x - 1.5e-6 * sine).abs() < 1e-12 && (y - 1.5e-6 * cosine).abs() < 1e-12);
    assert_eq!([z, roll, pitch], [0.0; 3]);
    assert!((yaw - 0.5e-6).abs() < 1e-12);
}

#[test]
fn what_is_exact_stays_so() {
    let number = |text: &str| Number::decimal(text).unwrap();
    let right = &Number::pi() * &Number::ratio(1, 2).unwrap();
    let turned = Frame {
        position: ["0.125", "0", "3"].map(number),
        roll_pitch_yaw: [right, Number::zero(), Number::zero()],
    };
    let found = Frame::between(&[], &[&turned, &turned]).unwrap();
    // Its value is exact, and it is as uncertain as the literals of both; its turn has none.
    let twice = ["0.25", "-3", "3"].map(number);
    assert_eq!(found.position, twice);
    assert_eq!(spreads(&found, 1.0), [2.0, 2.0, 2.0, 0.0, 0.0, 0.0]);
    // Three radians are no literal, and what follows is computed from exact numbers alone.
    let three = Frame {
        roll_pitch_yaw: [Number::integer(3), Number::zero(), Number::zero()],
        ..Frame::identity()
    };
    let found = Frame::between(&[], &[&three, &Frame::at_point([0.0, 1.0, 0.0]).unwrap()]).unwrap();
    assert_eq!(spreads(&found, 1.0), [0.0; 6]);
}

#[test]
fn upright_frames_have_spreads_that_are_finite() {
    let number = |text: &str| Number::decimal(text).unwrap();
    let upright = Frame {
        roll_pitch_yaw: [number("0.1"), number("1.570796"), number("0.2")],
        ..Frame::identity()
    };
    let tilted = Frame {
        roll_pitch_yaw: [number("0.00001"), Number::zero(), Number::zero()],
        ..Frame::identity()
    };
    let found = Frame::between(&[], &[&upright, &tilted]).unwrap();
    assert!(spreads(&found, 0.5e-6).iter().all(|spread| *spread < 1e-4));
}
