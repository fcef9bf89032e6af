//! The Miura fold.

use super::{along, at};
use kutzbach_model::mechanism::{
    JointBuilder, JointKind, Mechanism, MechanismBuilder, MechanismError,
};

/// Steps of the folded sheet in hundredths of a metre: vertex (i, j) is at
/// `(S i, L j + V (i mod 2), H (j mod 2))`. Any four positive lengths give a Miura fold with panels of sides
/// `√(S² + V²)` and `√(L² + H²)` and the cosine of the acute angle `V L / (a b)` (Schenk & Guest 2013).
const S: i64 = 100;
const V: i64 = 50;
const L: i64 = 100;
const H: i64 = 75;

/// A sheet of `columns` × `rows` parallelogram panels hinged along their common edges, half folded.
///
/// One finite freedom from two by two panels on; every inner vertex is a spherical 4R loop.
///
/// # Errors
/// None in practice: the sheet is valid for any size, 0 counted as 1.
pub fn miura_sheet(columns: usize, rows: usize) -> Result<Mechanism, MechanismError> {
    let (columns, rows) = (columns.max(1), rows.max(1));
    let panel = |i: usize, j: usize| format!("panel_{i}_{j}");
    // Steps between vertices: along i the edge alternates in y, along j in z.
    let turn = |i: usize| if i.is_multiple_of(2) { V } else { -V };
    let lift = |j: usize| if j.is_multiple_of(2) { H } else { -H };
    let mut builder = MechanismBuilder::new(&format!("miura_{columns}_{rows}"));
    for j in 0..rows {
        for i in 0..columns {
            builder.link(&panel(i, j));
            // Every panel's frame is at its vertex (i, j).
            if j > 0 {
                builder.joint(
                    JointBuilder::tree(
                        &format!("across_{i}_{j}"),
                        JointKind::Revolute,
                        &panel(i, j - 1),
                        &panel(i, j),
                    )
                    .origin(at(0, L, lift(j - 1)))
                    .axis(along(S, turn(i), 0)),
                );
            }
            if i > 0 {
                let name = format!("along_{i}_{j}");
                let (left, right) = (panel(i - 1, j), panel(i, j));
                let joint = if j == 0 {
                    JointBuilder::tree(&name, JointKind::Revolute, &left, &right)
                } else {
                    JointBuilder::closing(&name, JointKind::Revolute, &left, &right)
                };
                builder.joint(
                    joint
                        .origin(at(S, turn(i - 1), 0))
                        .axis(along(0, L, lift(j))),
                );
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
    fn a_folded_sheet_has_one_freedom() {
        for (columns, rows) in [(2, 2), (3, 4), (6, 6)] {
            let sheet = miura_sheet(columns, rows).unwrap();
            let analysis = analyse(&sheet, &AnalysisOptions::default()).unwrap();
            assert!(analysis.assembly.closed);
            assert_eq!(analysis.assembly.steps, 0, "the sheet is drawn closed");
            assert_eq!(analysis.home.unwrap().instantaneous, Some(1));
            let kutzbach =
                6 * (columns * rows - 1) as i64 - 5 * (2 * columns * rows - columns - rows) as i64;
            assert_eq!(analysis.kutzbach, kutzbach);
        }
    }
}
