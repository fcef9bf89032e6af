//! What the limits of its joints leave of a four-bar's motion, from the pose drawn.
//!
//! All poses of one circuit are a closed curve. Where the input turns fully its angle is the curve's parameter; where it swings between
//! two extremes it is m + h cos s, which passes an extreme as the mechanism does, onto the other side of coupler and output. The
//! curve is followed both ways until a joint meets its limit.

use super::FourBar;
use super::found::Pin;
use kutzbach_closure::{JointState, nearest_turn};
use kutzbach_math::space::{cross, dot, scale, subtract, unit};
use kutzbach_model::mechanism::Mechanism;
use std::f64::consts::{PI, TAU};

/// Steps of the curve: so many that between two of them no joint turns back by more than (2π/N)²/2 = 1e-6 rad.
const STEPS: i32 = 4_000;

/// A joint may be beyond its limit by this (rad), which is rounding.
const ROUNDING: f64 = 1e-9;

/// How far input and output go, as angles from the ground line to either side, and the transmission angle (rad).
pub(super) struct Reach {
    pub(super) input: [f64; 2],
    pub(super) output: [f64; 2],
    pub(super) transmission: [f64; 2],
    pub(super) stopped_by: Vec<String>,
}

/// The plane of a four-bar, and its joints.
struct Plane {
    lengths: [f64; 4],
    /// Of each joint its sense in the ring, and by how much its angle may change from the pose drawn.
    joints: [(f64, [f64; 2]); 4],
    middle: f64,
    half: Option<f64>,
}

/// Angles of input, coupler and output from the ground line (rad), over as many turns as they made.
#[derive(Clone, Copy)]
struct At {
    s: f64,
    angles: [f64; 3],
}

/// What limits leave; `None` where they stop nothing, or where a joint is drawn beyond its own. The first pin is that of the input on the
/// ground.
pub(super) fn within_limits(
    mechanism: &Mechanism,
    pins: &[Pin; 4],
    states: &[JointState<f64>],
    bar: &FourBar,
) -> Option<Reach> {
    let limited = |pin: &Pin| mechanism.joints()[pin.joint].bounds().is_some();
    if !pins.iter().any(limited) {
        return None;
    }
    let (plane, start) = Plane::new(mechanism, pins, states, bar)?;
    if plane.stopping(&start, &start).is_some() {
        return None;
    }
    let sides = [1, -1].map(|way| plane.follow(&start, way));
    // A way that no limit ends passes every pose of the circuit, whatever ends the other: a limit on one side only.
    let [(there, Some(first)), (back, Some(last))] = sides else {
        return None;
    };
    // From one end to the other.
    let poses: Vec<At> = back
        .into_iter()
        .rev()
        .chain(there.into_iter().skip(1))
        .collect();
    let input = extent(&poses, |at| at.angles[0]);
    let output = extent(&poses, |at| PI - at.angles[2]);
    let transmission = extent(&poses, |at| {
        let between = (at.angles[2] - at.angles[1]).rem_euclid(TAU);
        between.min(TAU - between)
    });
    let mut names: Vec<String> = [first, last]
        .map(|i| mechanism.joints()[pins[i].joint].name.clone())
        .to_vec();
    names.dedup();
    Some(Reach {
        input: to_either_side(input),
        output: to_either_side(output),
        transmission,
        stopped_by: names,
    })
}

/// The same interval with its middle from 0 to π.
fn to_either_side([from, to]: [f64; 2]) -> [f64; 2] {
    let turns = TAU * ((from + to) / (2.0 * TAU)).round();
    let [from, to] = [from - turns, to - turns];
    match from + to < 0.0 {
        true => [-to, -from],
        false => [from, to],
    }
}

/// Least and greatest value along a curve; inside it by the parabola through three points.
fn extent(poses: &[At], value: impl Fn(&At) -> f64) -> [f64; 2] {
    let values: Vec<f64> = poses.iter().map(value).collect();
    let mut found = [f64::INFINITY, f64::NEG_INFINITY];
    let mut take = |x: f64| found = [found[0].min(x), found[1].max(x)];
    values.iter().for_each(|x| take(*x));
    for (three, at) in values.windows(3).zip(poses.windows(3)) {
        let [a, b, c] = [three[0], three[1], three[2]];
        let even = ((at[2].s - at[1].s) - (at[1].s - at[0].s)).abs() < 1e-12;
        let bend = a - 2.0 * b + c;
        // An extreme in the middle, not the corner that folding an angle to less than π makes.
        if even && (b - a) * (c - b) <= 0.0 && bend.abs() > 0.0 && bend.abs() < 1e-4 {
            take(b - (c - a) * (c - a) / (8.0 * bend));
        }
    }
    found
}

impl Plane {
    /// The plane with the ground line along x, and the pose drawn in it.
    fn new(
        mechanism: &Mechanism,
        pins: &[Pin; 4],
        states: &[JointState<f64>],
        bar: &FourBar,
    ) -> Option<(Self, At)> {
        let normal = pins[0].axis;
        let across = |v: [f64; 3]| subtract(&v, &scale(&normal, &dot(&v, &normal)));
        let way = |i: usize, j: usize| across(subtract(&pins[j].point, &pins[i].point));
        let x = unit(&way(0, 3));
        let y = cross(&normal, &x);
        let angle = |v: [f64; 3]| dot(&v, &y).atan2(dot(&v, &x));
        let drawn = [angle(way(0, 1)), angle(way(1, 2)), angle(way(3, 2))];
        let mut joints = [(1.0, [f64::NEG_INFINITY, f64::INFINITY]); 4];
        for (pin, (sense, left)) in pins.iter().zip(&mut joints) {
            let joint = &mechanism.joints()[pin.joint];
            let along = dot(&pin.axis, &normal).signum();
            *sense = if pin.forward { along } else { -along };
            if let Some((lower, upper)) = joint.bounds() {
                let value = nearest_turn(joint, *states[pin.joint].values.first()?);
                *left = [lower - value, upper - value];
            }
        }
        let (middle, half) = match bar.swings[0].extremes {
            None => (drawn[0], None),
            Some([from, to]) => {
                let half = (to - from) / 2.0;
                // To the side on which it is drawn.
                let off = |middle: f64| {
                    let off = drawn[0] - middle;
                    (off - TAU * (off / TAU).round()).abs()
                };
                let middle = (from + to) / 2.0;
                let middle = if off(middle) <= off(-middle) {
                    middle
                } else {
                    -middle
                };
                (drawn[0] - signed(drawn[0] - middle), Some(half))
            }
        };
        let s = match half {
            None => 0.0,
            Some(half) => ((drawn[0] - middle) / half).clamp(-1.0, 1.0).acos(),
        };
        let plane = Self {
            lengths: bar.lengths,
            joints,
            middle,
            half,
        };
        Some((plane, At { s, angles: drawn }))
    }

    /// The pose at a parameter, of the two that there are the one nearer to what is expected.
    fn at(&self, s: f64, expected: [f64; 3]) -> At {
        let [g, a, c, b] = self.lengths;
        let theta = match self.half {
            None => self.middle + s,
            Some(half) => self.middle + half * s.cos(),
        };
        let from = [a * theta.cos(), a * theta.sin()];
        let way = [g - from[0], -from[1]];
        let d = way[0].hypot(way[1]);
        let along = (c * c - b * b + d * d) / (2.0 * d);
        let across = (c * c - along * along).max(0.0).sqrt();
        let poses = [across, -across].map(|across| {
            let pin = [0, 1].map(|i| {
                let other = [-way[1], way[0]][i];
                from[i] + (along * way[i] + across * other) / d
            });
            let coupler = (pin[1] - from[1]).atan2(pin[0] - from[0]);
            let output = pin[1].atan2(pin[0] - g);
            let near = |angle: f64, wanted: f64| wanted + signed(angle - wanted);
            [theta, near(coupler, expected[1]), near(output, expected[2])]
        });
        let off = |angles: &[f64; 3]| (1..3).map(|i| (angles[i] - expected[i]).abs()).sum::<f64>();
        let [one, other] = poses;
        let angles = if off(&one) <= off(&other) { one } else { other };
        At { s, angles }
    }

    /// The pin of a joint that is beyond its limit, seen from the pose drawn.
    fn stopping(&self, at: &At, start: &At) -> Option<usize> {
        let [t, p, q] = [0, 1, 2].map(|i| at.angles[i] - start.angles[i]);
        let turned = [t, p - t, q - p, -q];
        (0..4).find(|&i| {
            let (sense, [least, most]) = self.joints[i];
            let by = sense * turned[i];
            by < least - ROUNDING || by > most + ROUNDING
        })
    }

    /// The poses from the one drawn until a joint meets its limit, which is told, or until all were passed.
    fn follow(&self, start: &At, way: i32) -> (Vec<At>, Option<usize>) {
        let step = f64::from(way) * TAU / f64::from(STEPS);
        let mut poses = vec![*start];
        let mut before = *start;
        for number in 1..=STEPS {
            let last = poses[poses.len() - 1];
            let expected = [0, 1, 2].map(|i| match number {
                1 => last.angles[i],
                _ => 2.0 * last.angles[i] - before.angles[i],
            });
            let next = self.at(start.s + step * f64::from(number), expected);
            if let Some(stop) = self.stopping(&next, start) {
                poses.push(self.limit(start, last, next));
                return (poses, Some(stop));
            }
            before = last;
            poses.push(next);
        }
        (poses, None)
    }

    /// The pose at which a limit is met, between one within and one beyond it.
    fn limit(&self, start: &At, within: At, beyond: At) -> At {
        let [mut within, mut beyond] = [within, beyond];
        for _ in 0..60 {
            let expected = [0, 1, 2].map(|i| (within.angles[i] + beyond.angles[i]) / 2.0);
            let middle = self.at((within.s + beyond.s) / 2.0, expected);
            match self.stopping(&middle, start) {
                None => within = middle,
                Some(_) => beyond = middle,
            }
        }
        within
    }
}

/// An angle within half a turn.
fn signed(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}
