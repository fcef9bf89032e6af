//! Small mechanisms for the tests of this module and of `kutzbach::mobility`.

use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{
    Direction, Frame, JointBuilder, JointKind, Mechanism, MechanismBuilder,
};

/// A joint of a ring: its kind, where it is and along which axis, in the world at home.
pub type Place = (JointKind, [f64; 3], [f64; 3]);

/// How the numbers of a sample are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Written {
    /// As the doubles they are, without a stated precision.
    Exactly,
    /// With so many decimals.
    Decimals(usize),
}

impl Written {
    pub fn number(self, value: f64) -> Number {
        match self {
            Self::Exactly => Number::from_f64(value).unwrap(),
            Self::Decimals(decimals) => Number::decimal(&format!("{value:.decimals$}")).unwrap(),
        }
    }

    fn frame(self, at: [f64; 3]) -> Frame {
        Frame::at(at.map(|x| self.number(x)))
    }

    fn direction(self, along: [f64; 3]) -> Direction {
        Direction(along.map(|x| self.number(x)))
    }
}

/// Adds a ring of links `{name}0` (which must exist or is added as the first link) … joined by joints `{name}_a`, `_b`, …;
/// frames parallel to the world at home, every link's frame at its first joint. The last joint closes the ring, its side
/// in the first link displaced by `gap`.
pub fn add_ring(
    builder: &mut MechanismBuilder,
    name: &str,
    ground: &str,
    places: &[Place],
    gap: [f64; 3],
    written: Written,
) {
    let letter = |i: usize| char::from(b'a' + u8::try_from(i).unwrap());
    let link = |i: usize| {
        if i == 0 || i == places.len() {
            ground.to_owned()
        } else {
            format!("{name}{i}")
        }
    };
    let mut before = [0.0; 3];
    for (i, (kind, at, along)) in places.iter().enumerate() {
        let step = [0, 1, 2].map(|k| at[k] - before[k]);
        let last = i + 1 == places.len();
        let joint_name = format!("{name}_{}", letter(i));
        let mut joint = if last {
            JointBuilder::closing(&joint_name, *kind, &link(i), ground)
                .successor_origin(written.frame([0, 1, 2].map(|k| at[k] + gap[k])))
        } else {
            builder.link(&link(i + 1));
            JointBuilder::tree(&joint_name, *kind, &link(i), &link(i + 1))
        };
        joint = joint.origin(written.frame(step));
        if kind.uses_axis() {
            joint = joint.axis(written.direction(*along));
        }
        if kind.uses_second_axis() {
            joint = joint.axis2(written.direction(*along));
        }
        if kind.uses_lead() {
            joint = joint.lead(written.number(0.25));
        }
        builder.joint(joint);
        before = *at;
    }
}

/// One ring alone.
pub fn ring(places: &[Place], gap: [f64; 3], written: Written) -> Mechanism {
    let mut builder = MechanismBuilder::new("ring");
    builder.link("ground");
    add_ring(&mut builder, "r", "ground", places, gap, written);
    builder.build().unwrap()
}

/// Revolute joints along z at points of a plane.
pub fn planar(points: &[[f64; 2]]) -> Vec<Place> {
    points
        .iter()
        .map(|[x, y]| (JointKind::Revolute, [*x, *y, 0.0], [0.0, 0.0, 1.0]))
        .collect()
}

/// Corners of a crank and rocker: ground 4, crank 2, coupler 5, rocker 5.
pub const CRANK_ROCKER: [[f64; 2]; 4] = [[0.0, 0.0], [0.0, 2.0], [4.0, 5.0], [4.0, 0.0]];

/// The planar four-bar, drawn closed.
pub fn four_bar() -> Mechanism {
    ring(&planar(&CRANK_ROCKER), [0.0; 3], Written::Exactly)
}

/// A Sarrus linkage: three hinges along x, three along y; one translation along z.
pub fn sarrus() -> Mechanism {
    ring(&sarrus_places(), [0.0; 3], Written::Exactly)
}

pub fn sarrus_places() -> Vec<Place> {
    let hinge = |at, along| (JointKind::Revolute, at, along);
    let (x, y) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    vec![
        hinge([0.0, -1.0, 0.0], x),
        hinge([0.0, -2.0, 1.0], x),
        hinge([0.0, -1.0, 2.0], x),
        hinge([1.0, 0.0, 2.0], y),
        hinge([2.0, 0.0, 1.0], y),
        hinge([1.0, 0.0, 0.0], y),
    ]
}

/// A spherical four-bar about `centre`, its joints drawn at distances along their axes.
pub fn spherical(centre: [f64; 3], distances: [f64; 4]) -> Vec<Place> {
    let axes = [
        [0.0, 0.0, 1.0],
        [0.6, 0.0, 0.8],
        [0.48, 0.6, 0.64],
        [0.0, 0.8, 0.6],
    ];
    axes.iter()
        .zip(distances)
        .map(|(axis, d)| {
            let at = [0, 1, 2].map(|i| centre[i] + d * axis[i]);
            (JointKind::Revolute, at, *axis)
        })
        .collect()
}

/// Four revolute joints in general position: rigid, and over-constrained twice.
pub fn general_four() -> Mechanism {
    let places = [
        (JointKind::Revolute, [0.0, 0.0, 0.0], [0.0, 0.25, 1.0]),
        (JointKind::Revolute, [1.0, 0.25, 0.0], [0.5, 0.0, 1.0]),
        (JointKind::Revolute, [1.0, 1.5, 0.5], [0.0, 1.0, 0.5]),
        (JointKind::Revolute, [0.25, 1.0, -0.5], [1.0, -0.5, 0.25]),
    ];
    ring(&places, [0.0; 3], Written::Exactly)
}

/// A four-bar folded flat whose two sides are equally long: the crank dead, two freedoms at the pose.
pub fn flat_parallelogram() -> Mechanism {
    ring(
        &planar(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [2.0, 0.0]]),
        [0.0; 3],
        Written::Exactly,
    )
}
