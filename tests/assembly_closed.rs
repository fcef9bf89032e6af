//! Configurations put to the test by code of its own: poses are multiplied, and joints are looked at one by one. Those of random loops
//! are held against Newton's method from many starts.

use crate::support;

use kutzbach::algebra::Limits;
use kutzbach::assembly::modes::{Complete, Configuration, Modes, Question, assembly_modes};
use kutzbach::matrix::SplitMix64;
use kutzbach::mechanism::{Frame, Joint, JointId, JointKind, Mechanism, Side};
use kutzbach::number::Number;
use std::f64::consts::TAU;
use std::fmt::Write;
use support::{in_parallel, own_mechanisms, zoo};

type V = [f64; 3];
type M = [V; 3];

/// A rotation and a translation.
#[derive(Clone, Copy)]
struct At(M, V);

fn dot(a: V, b: V) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}
fn cross(a: V, b: V) -> V {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
fn minus(a: V, b: V) -> V {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}
fn unit(a: V) -> V {
    let n = dot(a, a).sqrt();
    a.map(|x| x / n)
}
fn turn(m: &M, v: V) -> V {
    [dot(m[0], v), dot(m[1], v), dot(m[2], v)]
}
fn times(a: &M, b: &M) -> M {
    let column = |j: usize| [b[0][j], b[1][j], b[2][j]];
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| dot(a[i], column(j))))
}
fn numbers(n: &[Number; 3]) -> V {
    [n[0].value(), n[1].value(), n[2].value()]
}

impl At {
    fn then(&self, b: &At) -> At {
        let moved = turn(&self.0, b.1);
        At(
            times(&self.0, &b.0),
            [0, 1, 2].map(|i| self.1[i] + moved[i]),
        )
    }

    fn of(frame: &Frame) -> At {
        let [r, p, y] = numbers(&frame.roll_pitch_yaw);
        let x = [
            [1.0, 0.0, 0.0],
            [0.0, r.cos(), -r.sin()],
            [0.0, r.sin(), r.cos()],
        ];
        let m = [
            [p.cos(), 0.0, p.sin()],
            [0.0, 1.0, 0.0],
            [-p.sin(), 0.0, p.cos()],
        ];
        let z = [
            [y.cos(), -y.sin(), 0.0],
            [y.sin(), y.cos(), 0.0],
            [0.0, 0.0, 1.0],
        ];
        At(times(&times(&z, &m), &x), numbers(&frame.position))
    }
}

/// What of two sides of a joint should be zero; `length` is that of a bar.
fn residuals(joint: &Joint, one: &At, other: &At, length: f64) -> Vec<f64> {
    let way = minus(other.1, one.1);
    let axis = || unit(numbers(&joint.axis.0));
    let second = || unit(numbers(&joint.axis2.0));
    let along = || turn(&one.0, axis());
    let normal = || turn(&other.0, second());
    let same_axis = || minus(turn(&other.0, axis()), along()).to_vec();
    let unturned = || -> Vec<f64> {
        let entries = one.0.iter().flatten().zip(other.0.iter().flatten());
        entries.map(|(a, b)| a - b).collect()
    };
    let leaning = || dot(along(), normal()) - dot(axis(), second());
    // Of the travel along a thread what its turn does not account for, whole turns apart.
    let off_thread = || {
        let lead = joint.lead.as_ref().map_or(0.0, Number::value);
        let transposed = [0, 1, 2].map(|i| [0, 1, 2].map(|j| one.0[j][i]));
        let r = times(&transposed, &other.0);
        let skew = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]];
        let angle = dot(skew, axis()).atan2(r[0][0] + r[1][1] + r[2][2] - 1.0);
        let off = dot(way, along()) - lead * angle / std::f64::consts::TAU;
        if lead == 0.0 {
            off
        } else {
            off - lead * (off / lead).round()
        }
    };
    let all = |parts: Vec<Vec<f64>>| parts.concat();
    match joint.kind {
        JointKind::Fixed => all(vec![way.to_vec(), unturned()]),
        JointKind::Revolute => all(vec![way.to_vec(), same_axis()]),
        JointKind::Prismatic => all(vec![cross(along(), way).to_vec(), unturned()]),
        JointKind::Screw => all(vec![
            cross(along(), way).to_vec(),
            same_axis(),
            vec![off_thread()],
        ]),
        JointKind::Cylindrical => all(vec![cross(along(), way).to_vec(), same_axis()]),
        JointKind::Universal => all(vec![way.to_vec(), vec![leaning()]]),
        JointKind::PlanarTranslation => all(vec![vec![dot(along(), way)], unturned()]),
        JointKind::Planar => all(vec![vec![dot(along(), way)], same_axis()]),
        JointKind::Spherical => way.to_vec(),
        JointKind::Translational => unturned(),
        JointKind::TranslatingScrew => all(vec![same_axis(), vec![off_thread()]]),
        JointKind::Schoenflies => same_axis(),
        JointKind::PointOnLine => cross(normal(), way).to_vec(),
        JointKind::PointOnPlane => vec![dot(normal(), way)],
        JointKind::LineOnPlane => vec![dot(normal(), way), leaning()],
        JointKind::Distance => vec![dot(way, way).sqrt() - length],
    }
}

/// Where a joint has its sides, by the poses of the links.
fn sides(joint: &Joint, poses: &[Option<At>]) -> Option<[At; 2]> {
    let side = |side: &Side| Some(poses[side.link.0].as_ref()?.then(&At::of(&side.frame)));
    Some([side(&joint.predecessor)?, side(&joint.successor)?])
}

/// The value of a hinge or slider.
fn value(joint: &Joint, [one, other]: &[At; 2]) -> f64 {
    let axis = unit(numbers(&joint.axis.0));
    let along = turn(&one.0, axis);
    if joint.kind == JointKind::Prismatic {
        return dot(minus(other.1, one.1), along);
    }
    let least = (0..3).min_by(|&i, &j| axis[i].abs().total_cmp(&axis[j].abs()));
    let mut across = [0.0; 3];
    across[least.unwrap()] = 1.0;
    let across = unit(cross(axis, across));
    let [from, to] = [turn(&one.0, across), turn(&other.0, across)];
    dot(along, cross(from, to)).atan2(dot(from, to))
}

/// A mechanism, and the lengths of its bars: as stated, or as drawn.
struct Checked<'a> {
    mechanism: &'a Mechanism,
    lengths: Vec<f64>,
    size: f64,
}

impl<'a> Checked<'a> {
    fn new(mechanism: &'a Mechanism, drawn: &[Option<At>]) -> Self {
        let length = |joint: &Joint| match &joint.distance {
            Some(length) => length.value(),
            None => sides(joint, drawn).map_or(0.0, |[a, b]| {
                let way = minus(b.1, a.1);
                dot(way, way).sqrt()
            }),
        };
        let lengths = mechanism.joints().iter().map(length).collect();
        let sides = mechanism.joints().iter();
        let numbers = sides.flat_map(|j| [&j.predecessor.frame, &j.successor.frame]);
        let size = numbers.flat_map(|f| f.position.iter().map(|x| x.value().abs()));
        Self {
            mechanism,
            lengths,
            size: size.fold(1.0, f64::max),
        }
    }

    /// The joint that is most open, and by how much, in parts of the size.
    fn opening(&self, poses: &[Option<At>]) -> (String, f64) {
        let of = |(joint, length): (&Joint, &f64)| {
            let found = match sides(joint, poses) {
                Some([a, b]) => residuals(joint, &a, &b, *length),
                None => Vec::new(),
            };
            let most = found.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            (joint.name.clone(), most / self.size)
        };
        let joints = self.mechanism.joints().iter().zip(&self.lengths);
        let rods = self.rods(poses).into_iter();
        let all = joints.map(of).chain(rods);
        all.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap()
    }

    /// Of rods without a pose by how much the way between their balls is not their length.
    fn rods(&self, poses: &[Option<At>]) -> Vec<(String, f64)> {
        let mechanism = self.mechanism;
        let spinning = (0..poses.len()).filter(|&link| poses[link].is_none());
        spinning
            .map(|link| {
                let mut own = Vec::new();
                let mut there = Vec::new();
                let mut balls = true;
                for joint in mechanism.joints() {
                    let [p, s] = [&joint.predecessor, &joint.successor];
                    for (near, far) in [(p, s), (s, p)] {
                        if near.link.0 == link {
                            balls &= joint.kind == JointKind::Spherical;
                            own.push(numbers(&near.frame.position));
                            let body = poses[far.link.0].as_ref();
                            there.extend(body.map(|body| body.then(&At::of(&far.frame)).1));
                        }
                    }
                }
                if !balls || own.len() != 2 || there.len() != 2 {
                    return (mechanism.links()[link].name.clone(), f64::INFINITY);
                }
                let [a, b] = [minus(own[0], own[1]), minus(there[0], there[1])];
                let off = dot(a, a).sqrt() - dot(b, b).sqrt();
                (mechanism.links()[link].name.clone(), off.abs() / self.size)
            })
            .collect()
    }

    /// What is wrong with a configuration; empty where nothing is.
    fn wrong(&self, configuration: &Configuration, held: &[(JointId, Number)]) -> String {
        let poses = poses(configuration);
        let mut text = String::new();
        let (joint, open) = self.opening(&poses);
        if !(open <= 1e-9) {
            let _ = write!(text, "`{joint}` open by {open:e}; ");
        }
        for (index, joint) in self.mechanism.joints().iter().enumerate() {
            let Some(sides) = sides(joint, &poses) else {
                continue;
            };
            let one = matches!(joint.kind, JointKind::Revolute | JointKind::Prismatic);
            if !one {
                continue;
            }
            let found = value(joint, &sides);
            let turns = joint.kind == JointKind::Revolute;
            let whole = |x: f64| {
                if turns {
                    x - (x / TAU).round() * TAU
                } else {
                    x
                }
            };
            if let Some((_, wanted)) = held.iter().find(|(id, _)| id.0 == index)
                && !(whole(found - wanted.value()).abs() < 1e-9 * self.size)
            {
                let _ = write!(
                    text,
                    "`{}` held at {} stands at {found}; ",
                    joint.name,
                    wanted.value()
                );
            }
            if let Some((lower, upper)) = joint.bounds()
                && (!turns || lower.is_finite() && upper.is_finite())
            {
                let within = |x: f64| (lower - 1e-8..=upper + 1e-8).contains(&x);
                let again = lower + (found - lower).rem_euclid(TAU);
                if !(within(found) || turns && (within(again) || within(again - TAU))) {
                    let _ = write!(text, "`{}` beyond its limits at {found}; ", joint.name);
                }
            }
        }
        text
    }
}

fn poses(configuration: &Configuration) -> Vec<Option<At>> {
    let poses = configuration.poses.iter();
    poses
        .map(|pose| pose.as_ref().map(|p| At(p.rotation, p.translation)))
        .collect()
}

fn answer(mechanism: &Mechanism, held: Option<Vec<(JointId, Number)>>, seconds: f64) -> Modes {
    let question = Question {
        held,
        limits: Limits::seconds(seconds),
    };
    assembly_modes(mechanism, &question).unwrap()
}

/// What is wrong with an answer, and how many configurations it has.
fn checked(name: &str, mechanism: &Mechanism, modes: &Modes) -> (Vec<String>, usize) {
    let drawn: Vec<Option<At>> = home(mechanism);
    let checked = Checked::new(mechanism, &drawn);
    let mut wrong = Vec::new();
    for (number, configuration) in modes.configurations.iter().enumerate() {
        let said = checked.wrong(configuration, &modes.held);
        if !said.is_empty() {
            wrong.push(format!("{name}, configuration {}: {said}", number + 1));
        }
    }
    let drawn = modes.configurations.iter().filter(|c| c.drawn).count();
    if drawn > 1 {
        wrong.push(format!("{name}: drawn {drawn} times"));
    }
    (wrong, modes.configurations.len())
}

/// Where the links are drawn.
fn home(mechanism: &Mechanism) -> Vec<Option<At>> {
    use kutzbach::closure::{Arithmetic, Geometry};
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let poses = geometry.home.iter();
    poses.map(|p| Some(At(p.rotation, p.translation))).collect()
}

/// Words for a vector of whole numbers.
fn words(v: [i64; 3]) -> String {
    format!("{} {} {}", v[0], v[1], v[2])
}

/// Loops of hinges, balls, universals and sliders between points of a small cube, along its edges and diagonals: many axes meet, some
/// coincide. Drawn by the number of the case; closed as drawn.
fn random_loops(case: u64) -> Mechanism {
    let mut random = SplitMix64::new(0xC105_ED00 + case);
    let mut below = |most: u64| random.next_u64() % most;
    let links = 3 + below(3);
    let more = [0, 0, 1, 2][below(4) as usize];
    let reach = 1 + below(2) as i64;
    let mut text = String::from("<robot name=\"random\"><link name=\"b0\"/>");
    // Where every link's frame is; all stand upright.
    let mut frames = vec![[0_i64; 3]];
    let mut body = String::new();
    let mut ring: Vec<[u64; 2]> = (1..links).map(|link| [link - 1, link]).collect();
    ring.push([links - 1, 0]);
    for _ in 0..more {
        let one = below(links);
        ring.push([one, (one + 1 + below(links - 1)) % links]);
    }
    for (number, [one, other]) in ring.into_iter().enumerate() {
        let mut vector = |size: i64| [0; 3].map(|_| below(2 * size as u64 + 1) as i64 - size);
        let at = vector(reach);
        let axis = match vector(1) {
            [0, 0, 0] => [0, 0, 1],
            axis => axis,
        };
        let kind = below(20);
        let across = match axis {
            [x, y, _] if x != 0 || y != 0 => [-y, x, 0],
            _ => [1, 0, 0],
        };
        let (kind, inside) = match kind {
            0..=10 => ("continuous", format!("<axis xyz=\"{}\"/>", words(axis))),
            11..=14 => ("spherical", String::new()),
            15..=16 => (
                "universal",
                format!(
                    "<axis xyz=\"{}\"/><axis2 xyz=\"{}\"/>",
                    words(axis),
                    words(across)
                ),
            ),
            _ => ("prismatic", format!("<axis xyz=\"{}\"/>", words(axis))),
        };
        let seen = |link: u64, frames: &[[i64; 3]]| {
            let frame = frames[link as usize];
            words([0, 1, 2].map(|i| at[i] - frame[i]))
        };
        if frames.len() as u64 == other {
            let from = seen(one, &frames);
            frames.push(at);
            let _ = write!(
                text,
                "<link name=\"b{other}\"/><joint name=\"j{number}\" type=\"{kind}\"><parent link=\"b{one}\"/>\
                 <child link=\"b{other}\"/><origin xyz=\"{from}\"/>{inside}</joint>"
            );
        } else {
            let _ = write!(
                body,
                "<loop name=\"j{number}\" type=\"{kind}\"><predecessor link=\"b{one}\"><origin xyz=\"{}\"/></predecessor>\
                 <successor link=\"b{other}\"><origin xyz=\"{}\"/></successor>{inside}</loop>",
                seen(one, &frames),
                seen(other, &frames)
            );
        }
    }
    let text = format!("{text}{body}</robot>");
    let reading = kutzbach::format::read(&text, "random.urdf", &[]);
    reading
        .unwrap_or_else(|e| panic!("{case}: {e}\n{text}"))
        .mechanism
}

/// Poses that Newton's method finds from starts drawn by lot, each once, with whether the equations are independent there.
fn by_newton(checked: &Checked<'_>, held: &[(JointId, Number)], starts: u64) -> Vec<Vec<At>> {
    let links = checked.mechanism.links().len();
    let ground = checked.mechanism.ground().0;
    let mut random = SplitMix64::new(77);
    let mut unit_number = || random.next_u64() as f64 / u64::MAX as f64 * 2.0 - 1.0;
    let mut found: Vec<Vec<At>> = Vec::new();
    let drawn: Vec<At> = home(checked.mechanism).into_iter().flatten().collect();
    for _ in 0..starts {
        let mut at = drawn.clone();
        for (link, pose) in at.iter_mut().enumerate() {
            if link != ground {
                let q = [0; 4].map(|_| unit_number());
                let place = [0; 3].map(|_| 2.0 * checked.size * unit_number());
                *pose = At(rotation(q), place);
            }
        }
        let mut damping = 1e-2;
        let mut now = checked.all(&at, held);
        for _ in 0..60 {
            let rows = jacobian(checked, &at, held, ground);
            let step = damped(&rows, &now, damping);
            let next = stepped(&at, &step, ground);
            let there = checked.all(&next, held);
            if norm(&there) < norm(&now) {
                at = next;
                now = there;
                damping = (damping * 0.2).max(1e-15);
            } else {
                damping *= 8.0;
            }
            if norm(&now) < 1e-13 || damping > 1e6 {
                break;
            }
        }
        let closed = norm(&now) < 1e-11;
        if closed && !found.iter().any(|other| far(other, &at, links) < 1e-4) {
            found.push(at);
        }
    }
    found
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The largest difference of entries of poses.
fn far(one: &[At], other: &[At], links: usize) -> f64 {
    let entries = |p: &At| [p.0[0], p.0[1], p.0[2], p.1].concat();
    let off = (0..links).flat_map(|l| {
        let pairs = entries(&one[l]).into_iter().zip(entries(&other[l]));
        pairs.map(|(a, b)| (a - b).abs()).collect::<Vec<f64>>()
    });
    off.fold(0.0, f64::max)
}

fn rotation([w, x, y, z]: [f64; 4]) -> M {
    let n = w * w + x * x + y * y + z * z;
    let m = [
        [
            w * w + x * x - y * y - z * z,
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
        ],
        [
            2.0 * (x * y + w * z),
            w * w - x * x + y * y - z * z,
            2.0 * (y * z - w * x),
        ],
        [
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            w * w - x * x - y * y + z * z,
        ],
    ];
    m.map(|row| row.map(|e| e / n))
}

/// Poses after a small turn about the world's axes and a small way of every link but the ground.
fn stepped(at: &[At], step: &[f64], ground: usize) -> Vec<At> {
    let mut next = at.to_vec();
    let moving = (0..at.len()).filter(|&link| link != ground);
    for (number, link) in moving.enumerate() {
        let s = &step[6 * number..6 * number + 6];
        let turn = rotation([1.0, s[0] / 2.0, s[1] / 2.0, s[2] / 2.0]);
        next[link] = At(
            times(&turn, &at[link].0),
            [0, 1, 2].map(|i| at[link].1[i] + s[3 + i]),
        );
    }
    next
}

/// Columns of derivatives, by central differences.
fn jacobian(
    checked: &Checked<'_>,
    at: &[At],
    held: &[(JointId, Number)],
    ground: usize,
) -> Vec<Vec<f64>> {
    const H: f64 = 1e-6;
    let unknowns = 6 * (at.len() - 1);
    (0..unknowns)
        .map(|k| {
            let moved = |by: f64| {
                let mut step = vec![0.0; unknowns];
                step[k] = by;
                checked.all(&stepped(at, &step, ground), held)
            };
            let pairs = moved(H).into_iter().zip(moved(-H));
            pairs.map(|(a, b)| (a - b) / (2.0 * H)).collect()
        })
        .collect()
}

/// The step of Levenberg and Marquardt.
fn damped(columns: &[Vec<f64>], now: &[f64], damping: f64) -> Vec<f64> {
    let n = columns.len();
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut rows: Vec<Vec<f64>> = (0..n)
        .map(|i| {
            let mut row: Vec<f64> = (0..n).map(|j| product(&columns[i], &columns[j])).collect();
            row[i] += damping;
            row.push(-product(&columns[i], now));
            row
        })
        .collect();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| rows[a][k].abs().total_cmp(&rows[b][k].abs()));
        rows.swap(k, pivot.unwrap());
        let (above, below) = rows.split_at_mut(k + 1);
        for row in below {
            let factor = row[k] / above[k][k];
            for (entry, other) in row.iter_mut().zip(&above[k]).skip(k) {
                *entry -= factor * other;
            }
        }
    }
    let mut step = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| rows[k][j] * step[j]).sum();
        step[k] = (rows[k][n] - known) / rows[k][k];
    }
    step
}

impl Checked<'_> {
    /// The residuals of all joints, and of those held.
    fn all(&self, at: &[At], held: &[(JointId, Number)]) -> Vec<f64> {
        let poses: Vec<Option<At>> = at.iter().copied().map(Some).collect();
        let mut all = Vec::new();
        for (joint, length) in self.mechanism.joints().iter().zip(&self.lengths) {
            let [a, b] = sides(joint, &poses).unwrap();
            all.extend(residuals(joint, &a, &b, *length));
        }
        for (joint, wanted) in held {
            let joint = self.mechanism.joint(*joint);
            let sides = sides(joint, &poses).unwrap();
            let off = value(joint, &sides) - wanted.value();
            all.push(match joint.kind {
                JointKind::Revolute => off - (off / TAU).round() * TAU,
                _ => off,
            });
        }
        all
    }
}

/// Of a random mechanism what is wrong with its answer; and whether that is proven, how many configurations are listed, and how many of
/// these and of others Newton's method finds.
fn against_newton(case: u64, starts: u64) -> (Vec<String>, [usize; 4]) {
    let mechanism = random_loops(case);
    let held = case.is_multiple_of(3).then(Vec::new);
    let modes = answer(&mechanism, held, 2.0);
    let name = format!("case {case}");
    let (mut wrong, listed) = checked(&name, &mechanism, &modes);
    let proven = modes.complete == Complete::Proven && modes.moves.is_none_or(|m| m == 0);
    if !proven {
        return (wrong, [0, listed, 0, 0]);
    }
    let drawn = home(&mechanism);
    let by_hand = Checked::new(&mechanism, &drawn);
    let found = by_newton(&by_hand, &modes.held, starts);
    let mut met = vec![false; listed];
    for at in &found {
        let same = |c: &Configuration| {
            let poses = poses(c);
            let known = poses
                .iter()
                .zip(at)
                .filter_map(|(a, b)| Some((a.as_ref()?, b)));
            let (one, other): (Vec<At>, Vec<At>) = known.map(|(a, b)| (*a, *b)).unzip();
            // Near a double solution residuals of e leave √e.
            far(&one, &other, one.len()) < 1e-4
        };
        match modes.configurations.iter().position(same) {
            Some(place) => met[place] = true,
            None => wrong.push(format!(
                "{name}: {} configurations are said to be all, and there is another one",
                listed
            )),
        }
    }
    let met = met.iter().filter(|m| **m).count();
    (wrong, [1, listed, met, found.len()])
}

/// What is wrong with the answers to some cases, and how many proven answers there are.
fn random_cases(cases: &[u64], starts: u64) -> usize {
    let found = in_parallel(cases, |case| against_newton(*case, starts));
    let sum = |i: usize| found.iter().map(|(_, counts)| counts[i]).sum::<usize>();
    eprintln!(
        "{} cases, {} answers proven, {} configurations listed, {} of the proven ones found by Newton's method",
        cases.len(),
        sum(0),
        sum(1),
        sum(2)
    );
    let wrong: Vec<&String> = found.iter().flat_map(|(wrong, _)| wrong).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
    sum(0)
}

#[test]
fn configurations_of_random_loops_close_and_are_all() {
    let cases: Vec<u64> = (0..24).collect();
    assert!(random_cases(&cases, 10) > 6);
}

mod corpus {
    use super::*;

    /// All configurations of all files close on all joints.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn configurations_of_all_files_close() {
        let mut all = own_mechanisms();
        all.extend(zoo());
        let all = support::sample(all, 3);
        let found = in_parallel(&all, |(name, mechanism)| {
            checked(name, mechanism, &answer(mechanism, None, 2.0))
        });
        let count: usize = found.iter().map(|(_, count)| count).sum();
        let wrong: Vec<String> = found.into_iter().flat_map(|(wrong, _)| wrong).collect();
        eprintln!("{count} configurations of {} files", all.len());
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
        assert!(count > support::at_least(500));
    }

    /// The same of many more.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn configurations_of_many_random_loops_close_and_are_all() {
        let cases = support::sample(24..500, 6);
        assert!(random_cases(&cases, 40) > support::at_least(100));
    }
}

/// Poses of a trace are put to the test by the same code: all joints closed, within the limits that the start keeps.
#[test]
fn poses_of_traces_close_on_all_joints_and_keep_limits() {
    use kutzbach::mobility::{AnalysisOptions, Depth, analyse};
    use kutzbach::motion::{Trace, TraceOptions, trace};
    let all = own_mechanisms().into_iter().chain(zoo());
    let drawn = support::sample(all, 3);
    let wrong = in_parallel(&drawn, |(name, mechanism)| {
        let options = AnalysisOptions {
            depth: Depth::Motions,
            ..AnalysisOptions::default()
        };
        let Ok(analysis) = analyse(mechanism, &options) else {
            return (Vec::new(), 0);
        };
        let mechanism = analysis.of(mechanism);
        let options = TraceOptions {
            samples: 12,
            ..TraceOptions::default()
        };
        let Ok(Trace::Moving(motion)) = trace(mechanism, &analysis, &options) else {
            return (Vec::new(), 0);
        };
        let checked = Checked::new(mechanism, &home(mechanism));
        let ignored = |joint: &Joint| {
            let mut notes = motion.notes.iter();
            notes.any(|note| note.contains(&format!("`{}` starts outside", joint.name)))
        };
        let offsets = mechanism.variable_offsets();
        let mut wrong = Vec::new();
        for sample in &motion.samples {
            let poses: Vec<Option<At>> = sample
                .links
                .iter()
                .map(|link| Some(At(link.rotation, link.translation)))
                .collect();
            let (joint, open) = checked.opening(&poses);
            // What the trace itself allows: rounding, or more where the file's numbers do.
            if !(open <= 1e-9_f64.max(10.0 * motion.allowed_closure)) {
                wrong.push(format!("{name}: `{joint}` open by {open:e}"));
            }
            for (index, joint) in mechanism.joints().iter().enumerate() {
                let Some((lower, upper)) = joint.bounds() else {
                    continue;
                };
                let value = sample.values[offsets[index]];
                if !ignored(joint) && !(lower - 1e-8..=upper + 1e-8).contains(&value) {
                    wrong.push(format!("{name}: `{}` at {value}", joint.name));
                }
            }
        }
        (wrong, 1)
    });
    let traced: usize = wrong.iter().map(|(_, traced)| traced).sum();
    assert!(traced >= support::at_least(100), "{traced}");
    support::assert_none(
        &wrong
            .into_iter()
            .flat_map(|(wrong, _)| wrong)
            .collect::<Vec<_>>(),
    );
}
