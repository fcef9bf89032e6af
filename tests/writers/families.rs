//! Linkages in world coordinates, at a pose where every loop closes: two sides of a joint have one place and one axis.

use kutzbach::matrix::SplitMix64;
use std::f64::consts::PI;

pub type Vector = [f64; 3];

/// A joint between two links, link 0 being the ground.
pub struct Joint {
    pub kind: &'static str,
    pub ends: [usize; 2],
    pub point: Vector,
    pub axis: Vector,
    pub closes: bool,
}

/// A linkage and its finite mobility.
pub struct Drawn {
    pub joints: Vec<Joint>,
    pub finite: usize,
    /// By how much a look-alike is spoiled (m, rad).
    pub spoiled: Option<f64>,
}

/// A rule by which linkages are drawn by lot.
pub struct Family {
    pub name: &'static str,
    pub draw: fn(&mut SplitMix64) -> Drawn,
}

const Z: Vector = [0.0, 0.0, 1.0];

pub const FAMILIES: [Family; 19] = [
    Family {
        name: "four_bar",
        draw: four_bar,
    },
    Family {
        name: "slider_crank",
        draw: slider_crank,
    },
    Family {
        name: "rssr",
        draw: rssr,
    },
    Family {
        name: "bennett",
        draw: bennett,
    },
    Family {
        name: "spherical",
        draw: spherical,
    },
    Family {
        name: "three_rrr",
        draw: three_rrr,
    },
    Family {
        name: "sarrus",
        draw: sarrus,
    },
    Family {
        name: "door",
        draw: door,
    },
    Family {
        name: "hexapod",
        draw: hexapod,
    },
    Family {
        name: "five_bar",
        draw: five_bar,
    },
    Family {
        name: "three_cranks",
        draw: three_cranks,
    },
    Family {
        name: "cylinders",
        draw: cylinders,
    },
    Family {
        name: "four_bar_tilted",
        draw: |r| tilted(four_bar(r), r),
    },
    Family {
        name: "slider_tilted",
        draw: |r| tilted(slider_crank(r), r),
    },
    Family {
        name: "bennett_spoiled",
        draw: |r| shifted(bennett(r), r),
    },
    Family {
        name: "spherical_spoiled",
        draw: |r| shifted(spherical(r), r),
    },
    Family {
        name: "sarrus_tilted",
        draw: sarrus_tilted,
    },
    Family {
        name: "door_bent",
        draw: |r| shifted(door(r), r),
    },
    Family {
        name: "cranks_unequal",
        draw: cranks_unequal,
    },
];

/// Between two bounds.
fn between(random: &mut SplitMix64, low: f64, high: f64) -> f64 {
    low + (high - low) * 0.5 * (1.0 + random.symmetric())
}

/// Of 0.1 to 10 %, evenly in its logarithm, with a sign by lot.
fn spoiling(random: &mut SplitMix64) -> f64 {
    let size = 10f64.powf(between(random, -3.0, -1.0));
    if random.symmetric() < 0.0 {
        -size
    } else {
        size
    }
}

/// A ring of joints: link k − 1 to link k, the last one back to the ground.
fn ring(joints: Vec<(&'static str, Vector, Vector)>, finite: usize) -> Drawn {
    let count = joints.len();
    let joints = joints
        .into_iter()
        .enumerate()
        .map(|(k, (kind, point, axis))| Joint {
            kind,
            ends: if k + 1 == count { [k, 0] } else { [k, k + 1] },
            point,
            axis,
            closes: k + 1 == count,
        });
    Drawn {
        joints: joints.collect(),
        finite,
        spoiled: None,
    }
}

fn corner(random: &mut SplitMix64, x: f64, y: f64) -> Vector {
    [
        x + between(random, -0.08, 0.08),
        y + between(random, -0.08, 0.08),
        0.0,
    ]
}

fn four_bar(random: &mut SplitMix64) -> Drawn {
    let at = [(0.0, 0.0), (0.1, 0.25), (0.6, 0.4), (0.5, 0.0)];
    let points = at.map(|(x, y)| corner(random, x, y));
    ring(points.map(|p| ("continuous", p, Z)).to_vec(), 1)
}

fn five_bar(random: &mut SplitMix64) -> Drawn {
    let at = [(0.0, 0.0), (-0.2, 0.3), (0.3, 0.6), (0.7, 0.3), (0.5, 0.0)];
    let points = at.map(|(x, y)| corner(random, x, y));
    ring(points.map(|p| ("continuous", p, Z)).to_vec(), 2)
}

fn slider_crank(random: &mut SplitMix64) -> Drawn {
    let points = [(0.0, 0.0), (0.1, 0.2), (0.6, 0.0)].map(|(x, y)| corner(random, x, y));
    let angle = between(random, -0.4, 0.4);
    let along = [angle.cos(), angle.sin(), 0.0];
    let [a, b, c] = points.map(|p| ("continuous", p, Z));
    ring(vec![a, b, c, ("prismatic", points[2], along)], 1)
}

fn rssr(random: &mut SplitMix64) -> Drawn {
    let axis = |random: &mut SplitMix64| unit([0; 3].map(|_| random.symmetric()));
    let (one, other) = (axis(random), axis(random));
    let b = corner(random, 0.1, 0.3);
    let mut c = corner(random, 0.6, 0.4);
    c[2] = between(random, 0.1, 0.3);
    let joints = vec![
        ("continuous", corner(random, 0.0, 0.0), one),
        ("spherical", b, Z),
        ("spherical", c, Z),
        ("continuous", corner(random, 0.5, 0.0), other),
    ];
    // The rod spins.
    ring(joints, 2)
}

/// R C C C at any places.
fn cylinders(random: &mut SplitMix64) -> Drawn {
    let at = [(0.0, 0.0), (0.1, 0.3), (0.5, 0.4), (0.5, 0.0)];
    let joints = at.map(|(x, y)| {
        let mut point = corner(random, x, y);
        point[2] = between(random, -0.2, 0.2);
        (
            "cylindrical",
            point,
            unit([0; 3].map(|_| random.symmetric())),
        )
    });
    let mut joints = joints.to_vec();
    joints[0].0 = "continuous";
    ring(joints, 1)
}

/// Links a, b with twists α, β, a sin β = b sin α, closed at a turn of the first joint.
fn bennett(random: &mut SplitMix64) -> Drawn {
    let (a, alpha) = (between(random, 0.3, 0.5), between(random, 0.4, 0.8));
    let beta = between(random, 1.0, 1.5);
    let b = a * beta.sin() / alpha.sin();
    let turn = between(random, 0.7, 2.0);
    let ratio = ((beta + alpha) / 2.0).sin() / ((beta - alpha) / 2.0).sin();
    let other = 2.0 * (ratio / (turn / 2.0).tan()).atan();
    let links = [
        (a, alpha, turn),
        (b, beta, other),
        (a, alpha, -turn),
        (b, beta, -other),
    ];
    let mut frame = Placement::identity();
    let mut joints = Vec::new();
    for (length, twist, turn) in links {
        joints.push(("continuous", frame.point, frame.axes[2]));
        frame = frame.turned(2, turn).moved(0, length).turned(0, twist);
    }
    ring(joints, 1)
}

fn spherical(random: &mut SplitMix64) -> Drawn {
    let at = [(0.0, 0.0), (0.5, 0.6), (1.3, 0.7), (1.2, 0.0)];
    let joints = at.map(|(x, y)| {
        let axis = unit([
            x + 0.1 * random.symmetric(),
            y + 0.1 * random.symmetric(),
            1.0,
        ]);
        ("continuous", axis.map(|c| c * 0.4), axis)
    });
    ring(joints.to_vec(), 1)
}

/// A platform on three legs of two links in a plane.
fn three_rrr(random: &mut SplitMix64) -> Drawn {
    let mut joints = Vec::new();
    let platform = 7;
    for leg in 0..3 {
        let angle = 2.0 * PI / 3.0 * leg as f64 + 0.2 * random.symmetric();
        let at = |radius: f64, turn: f64| {
            [
                radius * (angle + turn).cos(),
                radius * (angle + turn).sin(),
                0.0,
            ]
        };
        let knee = between(random, 0.3, 0.7);
        let (first, second) = (1 + 2 * leg, 2 + 2 * leg);
        let closes = leg > 0;
        joints.push(hinge([0, first], at(0.6, 0.0), Z, false));
        joints.push(hinge([first, second], at(0.5, knee), Z, false));
        joints.push(hinge([second, platform], at(0.15, 0.3), Z, closes));
    }
    Drawn {
        joints,
        finite: 3,
        spoiled: None,
    }
}

fn hinge(ends: [usize; 2], point: Vector, axis: Vector, closes: bool) -> Joint {
    Joint {
        kind: "continuous",
        ends,
        point,
        axis,
        closes,
    }
}

/// Two pairs of plates, at right angles, carry one above the other.
fn sarrus(random: &mut SplitMix64) -> Drawn {
    let (x, y) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let height = between(random, 0.2, 0.4);
    let mut side = |along: Vector, across: Vector| -> Vec<(&'static str, Vector, Vector)> {
        let (low, knee, high) = (
            between(random, 0.2, 0.3),
            between(random, 0.4, 0.5),
            between(random, 0.2, 0.3),
        );
        let at = |out: f64, up: f64| [across[0] * out, across[1] * out, up];
        let middle = between(random, 0.4, 0.6) * height;
        vec![
            ("continuous", at(low, 0.0), along),
            ("continuous", at(knee, middle), along),
            ("continuous", at(high, height), along),
        ]
    };
    let mut joints = side(x, y);
    let mut back = side(y, x);
    back.reverse();
    joints.extend(back);
    ring(joints, 1)
}

/// A plate on two hinges of one axis, with a third between them.
fn door(random: &mut SplitMix64) -> Drawn {
    let heights = [0.2, 0.7, 1.2].map(|h| h + between(random, -0.1, 0.1));
    let joints = heights.into_iter().enumerate();
    let joints = joints.map(|(k, h)| hinge([0, 1], [0.1, 0.05, h], Z, k > 0));
    Drawn {
        joints: joints.collect(),
        finite: 1,
        spoiled: None,
    }
}

/// Six legs of two links, a ball and two hinges each.
fn hexapod(random: &mut SplitMix64) -> Drawn {
    let platform = 13;
    let mut joints = Vec::new();
    for leg in 0..6 {
        let angle = PI / 3.0 * leg as f64;
        let sway = 0.3 * if leg % 2 == 0 { 1.0 } else { -1.0 };
        let below = [0.6 * (angle + sway).cos(), 0.6 * (angle + sway).sin(), 0.0]
            .map(|x| x + 0.02 * random.symmetric());
        let above = [0.3 * (angle - sway).cos(), 0.3 * (angle - sway).sin(), 0.7]
            .map(|x| x + 0.02 * random.symmetric());
        let along = unit([0, 1, 2].map(|i| above[i] - below[i]));
        let (first, second) = (1 + 2 * leg, 2 + 2 * leg);
        let ball = |ends, point, closes| Joint {
            kind: "spherical",
            ends,
            point,
            axis: Z,
            closes,
        };
        joints.push(ball([0, first], below, false));
        joints.push(Joint {
            kind: "prismatic",
            ends: [first, second],
            point: below,
            axis: along,
            closes: false,
        });
        joints.push(ball([second, platform], above, leg > 0));
    }
    // Each leg spins.
    Drawn {
        joints,
        finite: 12,
        spoiled: None,
    }
}

/// A bar on three equal, parallel cranks.
fn cranks(random: &mut SplitMix64, change: f64) -> Drawn {
    let length = between(random, 0.3, 0.5);
    let angle = between(random, 0.6, 1.2);
    let crank = |length: f64| [length * angle.cos(), length * angle.sin(), 0.0];
    let feet = [0.0, between(random, 0.4, 0.5), between(random, 0.8, 1.0)];
    let mut joints = Vec::new();
    for (k, foot) in feet.into_iter().enumerate() {
        let way = crank(if k == 2 {
            length * (1.0 + change)
        } else {
            length
        });
        let foot = [foot, 0.0, 0.0];
        joints.push(hinge([0, 1 + k], foot, Z, false));
        joints.push(hinge(
            [1 + k, 4],
            [0, 1, 2].map(|i| foot[i] + way[i]),
            Z,
            k > 0,
        ));
    }
    Drawn {
        joints,
        finite: 1,
        spoiled: None,
    }
}

fn three_cranks(random: &mut SplitMix64) -> Drawn {
    cranks(random, 0.0)
}

/// One crank has another length, parallel to the others: it gives way to first order, and no farther.
fn cranks_unequal(random: &mut SplitMix64) -> Drawn {
    let change = spoiling(random);
    Drawn {
        finite: 0,
        spoiled: Some(0.3 * change.abs()),
        ..cranks(random, change)
    }
}

/// One hinge leans over by a share of a radian.
fn tilted(mut drawn: Drawn, random: &mut SplitMix64) -> Drawn {
    let tilt = spoiling(random);
    let way = 2.0 * PI * random.symmetric();
    let axis = &mut drawn.joints[1].axis;
    *axis = unit([tilt * way.cos(), tilt * way.sin(), 1.0]);
    drawn.finite = 0;
    drawn.spoiled = Some(tilt.abs());
    drawn
}

/// One hinge of one side of a Sarrus linkage leans over.
fn sarrus_tilted(random: &mut SplitMix64) -> Drawn {
    let mut drawn = sarrus(random);
    let tilt = spoiling(random);
    drawn.joints[1].axis = unit([1.0, tilt, 0.6 * tilt]);
    drawn.finite = 0;
    drawn.spoiled = Some(tilt.abs());
    drawn
}

/// One hinge is aside by a share of half a metre, across its axis.
fn shifted(mut drawn: Drawn, random: &mut SplitMix64) -> Drawn {
    let size = 0.5 * spoiling(random);
    let joint = &mut drawn.joints[1];
    let across = unit(cross(joint.axis, unit([0.3, -0.5, 0.2])));
    joint.point = [0, 1, 2].map(|i| joint.point[i] + size * across[i]);
    drawn.finite = 0;
    drawn.spoiled = Some(size.abs());
    drawn
}

/// A frame that goes along a chain.
struct Placement {
    point: Vector,
    /// Its axes in the world.
    axes: [Vector; 3],
}

impl Placement {
    fn identity() -> Self {
        Self {
            point: [0.0; 3],
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], Z],
        }
    }

    fn turned(mut self, about: usize, angle: f64) -> Self {
        let (i, j) = ((about + 1) % 3, (about + 2) % 3);
        let (a, b) = (self.axes[i], self.axes[j]);
        self.axes[i] = [0, 1, 2].map(|k| angle.cos() * a[k] + angle.sin() * b[k]);
        self.axes[j] = [0, 1, 2].map(|k| angle.cos() * b[k] - angle.sin() * a[k]);
        self
    }

    fn moved(mut self, along: usize, way: f64) -> Self {
        self.point = [0, 1, 2].map(|k| self.point[k] + way * self.axes[along][k]);
        self
    }
}

pub fn cross(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}

pub fn unit(v: Vector) -> Vector {
    let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
    v.map(|x| x / length)
}
