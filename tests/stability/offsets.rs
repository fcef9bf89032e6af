//! Offsets from a mechanism or a pose that moves otherwise, from the families of the library.
//!
//! What is true of the members, and why, is told at the functions in `kutzbach::families`. `tests/families.rs` follows them
//! down to 1e-14; here they go on until nothing is decided any more.

use super::ladder::{Known, Ladder, Law, Rung};
use kutzbach::families::{continuous_families, negative_power_of_ten};
use kutzbach::number::Number;

/// The offsets are ten to the minus these.
pub const DEEP: [u32; 20] = [
    1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 16, 20, 30, 50, 80, 120,
];

/// How the smallest singular value kept follows the offset.
///
/// - Flattening parallelogram: three hinges on a line have rank 2, and the fourth is as far from that line as the offset.
/// - Spoiled parallelogram: the nearest pose that closes is turned by the root of the offset. Assembly may go farther, where a
///   start beside the pose drawn succeeds first.
/// - Flat change point: the hinges stay on a line and keep rank 2, near dead centre: they stay off every line.
/// - Spoiled Bennett: the fourth axis leaves the space of the three others in proportion to the angle.
/// - Double planar: of six directions three are those of a plane turned by the skew.
fn power(name: &str) -> fn(f64) -> f64 {
    match name {
        "flattening_parallelogram" | "spoiled_bennett" | "double_planar" => |decades| decades,
        "spoiled_parallelogram" => |decades| 0.5 * decades,
        _ => |_| 0.0,
    }
}

pub fn ladders() -> Vec<Ladder> {
    let each = continuous_families().into_iter().map(|family| {
        let offsets = DEEP.into_iter().map(|exponent| {
            let epsilon = negative_power_of_ten(exponent);
            let known = Known::Moves(*family.truth(&epsilon));
            Rung::at(-(exponent as i32), family.member(&epsilon).unwrap(), known)
        });
        let limit = Rung::limit(
            family.member(&Number::zero()).unwrap(),
            Known::Moves(family.limit),
        );
        let law = Law::new(2.0, power(family.name));
        Ladder {
            name: family.name,
            parameter: family.epsilon,
            law: Some(if family.name == "spoiled_parallelogram" {
                law.at_least()
            } else {
                law
            }),
            rungs: offsets.chain([limit]).collect(),
        }
    });
    each.collect()
}
