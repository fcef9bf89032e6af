//! Mechanisms of any size whose loops hang together in two directions.

use super::at;
use super::drawn::{Hinge, Triple, hinged, integers};
use kutzbach_model::mechanism::{
    JointBuilder, JointKind, Mechanism, MechanismBuilder, MechanismError,
};

/// Directions of hinges, no three of which lie in a plane.
const AXES: [[i64; 3]; 4] = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 2, 2]];

/// A square grid of `side` × `side` bodies (2 at least), neighbours joined by limbs: of three hinges along the columns and the
/// first row, of six elsewhere. Six hinges hold nothing, so that the hinges of the others are the freedoms: `3 (side² − 1)`.
///
/// # Errors
/// None in practice.
pub fn limb_grid(side: usize) -> Result<Mechanism, MechanismError> {
    let side = side.max(2);
    let mut hinges = Vec::new();
    for row in 0..side {
        for column in 0..side {
            let here = (row, column);
            if row > 0 {
                limb((row - 1, column), here, 3, &mut hinges);
            } else if column > 0 {
                limb((row, column - 1), here, 3, &mut hinges);
            }
        }
    }
    for row in 1..side {
        for column in 1..side {
            limb((row, column - 1), (row, column), 6, &mut hinges);
        }
    }
    hinged(&format!("limb_grid_{side}"), &hinges)
}

/// A limb between two bodies of the grid, which stand ten metres apart: hinges on the way, off it by up to two metres.
fn limb(from: (usize, usize), to: (usize, usize), count: i64, hinges: &mut Vec<Hinge>) {
    let body = |(row, column): (usize, usize)| format!("body_{row}_{column}");
    let name = format!("{}_to_{}_{}", body(from), to.0, to.1);
    let place = |(row, column): (usize, usize)| {
        [row, column].map(|k| 10 * i64::try_from(k).unwrap_or(i64::MAX / 1000))
    };
    let (a, b) = (place(from), place(to));
    let mut link = body(from);
    for number in 1..=count {
        let next = match number == count {
            true => body(to),
            false => format!("{name}_{number}"),
        };
        // Any numbers without a pattern will do, as long as they are the same every time.
        let mixed = (31 * a[0] + 17 * b[0] + 47 * a[1] + 29 * b[1]) / 10;
        let off = |factor: i64| (factor * (mixed + number * number) + number).rem_euclid(5) - 2;
        let [x, y] = [0, 1].map(|k| a[k] + (b[k] - a[k]) * number / (count + 1));
        let point: Triple = integers(x + off(3), y + off(7), off(11));
        let [i, j, k] = AXES[usize::try_from((mixed + number).rem_euclid(4)).unwrap_or(0)];
        let hinge = format!("{name}_hinge_{number}");
        hinges.push(Hinge::new(&hinge, &link, &next, point, integers(i, j, k)));
        link = next;
    }
}

/// A tower of `layers` triangles on the ground, each a quarter of a turn askew, of small balls that bars hold: nine to a layer. It is
/// rigid but for the balls, which spin by themselves: `9 layers` freedoms, all of them idle.
///
/// # Errors
/// None in practice.
pub fn layer_tower(layers: usize) -> Result<Mechanism, MechanismError> {
    const CORNERS: [[[i64; 2]; 3]; 2] = [
        [[100, 0], [-50, 87], [-50, -87]],
        [[50, 87], [-100, 0], [50, -87]],
    ];
    let corner = |layer: usize, k: usize| {
        let height = 130 * i64::try_from(layer).unwrap_or(i64::MAX / 130);
        let [x, y] = CORNERS[layer % 2][k];
        at(x, y, height)
    };
    let ball = |layer: usize, k: usize| match layer {
        0 => "ground".to_owned(),
        _ => format!("ball_{layer}_{k}"),
    };
    let mut builder = MechanismBuilder::new(&format!("layer_tower_{layers}"));
    builder.link("ground");
    for layer in 1..=layers {
        for k in 0..3 {
            let name = ball(layer, k);
            builder.link(&name);
            builder.floating(&format!("{name}_at"), "ground", &name, corner(layer, k));
        }
        for k in 0..3 {
            let beside = (ball(layer, k), ball(layer, (k + 1) % 3));
            builder.joint(JointBuilder::closing(
                &format!("ring_{layer}_{k}"),
                JointKind::Distance,
                &beside.0,
                &beside.1,
            ));
            for other in [k, (k + 1) % 3] {
                let mut bar = JointBuilder::closing(
                    &format!("bar_{layer}_{k}_{other}"),
                    JointKind::Distance,
                    &ball(layer - 1, other),
                    &ball(layer, k),
                );
                if layer == 1 {
                    bar = bar.origin(corner(0, other));
                }
                builder.joint(bar);
            }
        }
    }
    builder.build()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::{AnalysisOptions, analyse};

    #[test]
    fn freedoms_are_as_told() {
        for (mechanism, freedom) in [(limb_grid(3), 24), (limb_grid(4), 45), (layer_tower(3), 27)] {
            let mechanism = mechanism.unwrap();
            let analysis = analyse(&mechanism, &AnalysisOptions::default()).unwrap();
            assert!(analysis.assembly.closed, "{}", mechanism.name());
            let found = analysis.home.unwrap().instantaneous;
            assert_eq!(found, Some(freedom), "{}", mechanism.name());
        }
    }
}
