//! The analysis of a mechanism at one pose: as stated, and completed by what rounded numbers were meant to be.

use super::analysis::Analysis;
use super::as_stated::analyse_as_stated_within;
use super::meant::completed;
use super::options::{AnalysisError, AnalysisOptions};
use super::vocabulary::Verdict;
use kutzbach_closure::Structure;
use kutzbach_math::matrix::MatrixError;
use kutzbach_model::mechanism::Mechanism;
use std::sync::Arc;

/// Analyses a mechanism: counts, assembles, ranks, names what is locked and redundant.
///
/// # Errors
/// [`AnalysisError`]; see there.
pub fn analyse(
    mechanism: &Mechanism,
    options: &AnalysisOptions,
) -> Result<Analysis, AnalysisError> {
    analyse_within(mechanism, &Arc::new(Structure::new(mechanism)), options)
}

/// [`analyse`] of a mechanism whose structure is known, as that is common to mechanisms that differ in the numbers of their joints only.
///
/// ```
/// # mod kutzbach { pub use kutzbach_mobility as mobility; pub use kutzbach_model::mechanism; pub use kutzbach_math::number; }
/// use kutzbach::mechanism::{JointBuilder, JointKind, MechanismBuilder};
/// use kutzbach::mobility::{AnalysisOptions, Structure, analyse_within};
/// use kutzbach::number::Number;
/// use std::sync::Arc;
///
/// let mut builder = MechanismBuilder::new("door");
/// builder.link("frame").link("leaf");
/// builder.joint(JointBuilder::tree("hinge", JointKind::Revolute, "frame", "leaf"));
/// let door = builder.build()?;
/// let structure = Arc::new(Structure::new(&door));
/// for width in 1..4 {
///     let wider = door.clone().with_joint_numbers([(0, 0, Number::integer(width))]);
///     let analysis = analyse_within(&wider, &structure, &AnalysisOptions::default())?;
///     assert_eq!(analysis.mobility.finite(), Some(1));
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// As [`analyse`]; [`AnalysisError::OutOfRange`] where the structure has another number of joints.
pub fn analyse_within(
    mechanism: &Mechanism,
    structure: &Arc<Structure>,
    options: &AnalysisOptions,
) -> Result<Analysis, AnalysisError> {
    let (expected, found) = (mechanism.joints().len(), structure.graph.edge_count());
    if found != expected {
        return Err(AnalysisError::OutOfRange(MatrixError::Length {
            what: "joints of the structure",
            expected,
            found,
        }));
    }
    let stated = analyse_as_stated_within(mechanism, structure, options)?;
    let analysis = completed(mechanism, options, stated)?;
    let undecided = analysis.mobility.verdict == Verdict::Undecided && analysis.assembly.closed;
    let Some(tolerance) = options.closure_tolerance.filter(|_| undecided) else {
        return Ok(analysis);
    };
    // What stays open at the pose drowns what happens near it. Loops that count as closed within a gap have dimensions that are known
    // to within that gap: read like this, the file may say what was meant.
    let coarse = mechanism.clone().with_precision(tolerance);
    let options = AnalysisOptions {
        closure_tolerance: None,
        ..options.clone()
    };
    let stated = analyse_as_stated_within(&coarse, structure, &options)?;
    let mut meant = completed(&coarse, &options, stated)?;
    if let Some(nominal) = &mut meant.mobility.nominal {
        nominal.known_to = Some(tolerance);
    }
    Ok(match meant.mobility.finite() {
        Some(_) => meant,
        None => analysis,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::depth::Depth;
    use kutzbach_closure::samples::{
        CRANK_ROCKER, Written, add_ring, four_bar, general_four, planar,
    };
    use kutzbach_closure::{Arithmetic, Geometry, Structure};
    use kutzbach_math::number::Number;
    use kutzbach_model::mechanism::{Frame, JointBuilder, JointKind, MechanismBuilder};
    use std::collections::BTreeSet;

    #[test]
    fn configurations_are_looked_up_by_name() {
        let options = AnalysisOptions {
            configuration: Some("open".to_owned()),
            ..AnalysisOptions::default()
        };
        let error = analyse(&four_bar(), &options).unwrap_err();
        assert!(error.to_string().contains("`open`") && error.to_string().contains("none"));
    }

    #[test]
    fn held_joints_keep_their_value_and_their_freedom() {
        let mut builder = MechanismBuilder::new("held");
        builder.link("ground");
        add_ring(
            &mut builder,
            "r",
            "ground",
            &planar(&CRANK_ROCKER),
            [0.0; 3],
            Written::Exactly,
        );
        let value = Number::from_f64(0.5).unwrap();
        builder.configuration("turned", vec![("r_a".to_owned(), vec![value])]);
        let mechanism = builder.build().unwrap();
        let options = AnalysisOptions {
            configuration: Some("turned".to_owned()),
            ..AnalysisOptions::default()
        };
        let analysis = analyse(&mechanism, &options).unwrap();
        assert_eq!(analysis.assembly.states[0].values, [0.5]);
        // The pose is one where the crank has this value; that it is held there is no constraint.
        assert_eq!(analysis.home.unwrap().instantaneous, Some(1));
        assert_eq!(analysis.roles[0].locked, Some(false));
    }

    /// A triangle that exact algebra decides, and a four-bar that subgroups do.
    #[test]
    fn digits_of_starting_values_switch_no_engine_off() {
        for corners in [3, 4] {
            let decided = |start: Option<&str>| {
                let mut builder = MechanismBuilder::new("ring");
                builder.link("ground");
                let places = planar(&CRANK_ROCKER[..corners]);
                let written = Written::Exactly;
                add_ring(&mut builder, "r", "ground", &places, [0.0; 3], written);
                let at = |text| vec![("r_a".to_owned(), vec![Number::decimal(text).unwrap()])];
                let starts = start.map(at).unwrap_or_default();
                builder.configuration_with_starts("begun", Vec::new(), starts);
                let options = AnalysisOptions {
                    configuration: Some("begun".to_owned()),
                    ..AnalysisOptions::default()
                };
                let found = analyse(&builder.build().unwrap(), &options).unwrap();
                let part = &found.findings[0];
                let bounds = [part.lower(), part.upper()];
                (found.mobility.verdict, part.level(), bounds)
            };
            assert_eq!(decided(Some("0.02345")), decided(None), "{corners}");
        }
    }

    #[test]
    fn every_depth_says_what_the_deeper_ones_say() {
        for mechanism in [four_bar(), general_four()] {
            let at = |depth| {
                let options = AnalysisOptions {
                    depth,
                    ..AnalysisOptions::default()
                };
                analyse(&mechanism, &options).unwrap()
            };
            let [rank, verdict, motions, everything] = [
                Depth::Rank,
                Depth::Verdict,
                Depth::Motions,
                Depth::Everything,
            ]
            .map(at);
            for analysis in [&rank, &verdict, &motions] {
                assert_eq!(analysis.home, everything.home);
                assert_eq!(analysis.kutzbach, everything.kutzbach);
                assert!(analysis.generic.is_none() && analysis.advice.is_empty());
            }
            assert_eq!(rank.mobility.finite(), None);
            assert_eq!(
                rank.mobility.bounds.1,
                everything.home.as_ref().unwrap().instantaneous
            );
            for analysis in [&verdict, &motions] {
                let (one, other) = (&analysis.mobility, &everything.mobility);
                assert_eq!(one.finite(), other.finite());
                assert_eq!(
                    (one.pose, one.kind, one.class),
                    (other.pose, other.kind, other.class)
                );
            }
            assert!(verdict.branches.is_none());
            let shapes = |analysis: &Analysis| {
                let branches = analysis.branches.as_ref().unwrap();
                branches
                    .iter()
                    .map(|b| (b.dimension, b.roles.clone()))
                    .collect::<Vec<_>>()
            };
            assert_eq!(shapes(&motions), shapes(&everything));
        }
    }

    #[test]
    fn two_points_that_coincide_have_no_distance() {
        let mut builder = MechanismBuilder::new("rod");
        builder.link("ground").link("arm");
        builder.joint(JointBuilder::tree(
            "pin",
            JointKind::Revolute,
            "ground",
            "arm",
        ));
        builder.joint(JointBuilder::closing(
            "rod",
            JointKind::Distance,
            "ground",
            "arm",
        ));
        let error = analyse(&builder.build().unwrap(), &AnalysisOptions::default()).unwrap_err();
        assert!(matches!(error, AnalysisError::NoDistance { joint } if joint == "rod"));
    }

    #[test]
    fn freedoms_add_up_over_the_parts() {
        let mut builder = MechanismBuilder::new("sum");
        builder.link("ground").link("arm").link("stone");
        add_ring(
            &mut builder,
            "r",
            "ground",
            &planar(&CRANK_ROCKER),
            [0.0; 3],
            Written::Exactly,
        );
        builder.joint(
            JointBuilder::tree("arm_joint", JointKind::Universal, "r1", "arm").axis2(
                kutzbach_model::mechanism::Direction([
                    Number::zero(),
                    Number::one(),
                    Number::zero(),
                ]),
            ),
        );
        builder.floating("drop", "ground", "stone", Frame::identity());
        let analysis = analyse(&builder.build().unwrap(), &AnalysisOptions::default()).unwrap();
        let home = analysis.home.unwrap();
        assert_eq!(home.instantaneous, Some(1 + 2 + 6));
        assert_eq!(home.candidates, (9, 9));
        assert_eq!(home.redundant, Some(9 - analysis.kutzbach));
        assert_eq!(
            analysis
                .redundant_wrenches
                .iter()
                .filter(|w| **w == Some(0))
                .count(),
            1
        );
    }

    #[test]
    fn a_mechanism_of_one_link_stands() {
        let block = MechanismBuilder::new("block")
            .link("ground")
            .clone()
            .build()
            .unwrap();
        let analysis = analyse(&block, &AnalysisOptions::default()).unwrap();
        assert!(analysis.assembly.closed);
        assert_eq!(analysis.home.unwrap().instantaneous, Some(0));
    }

    #[test]
    fn the_order_of_the_file_changes_no_result() {
        let plain = analyse(&general_four(), &AnalysisOptions::default()).unwrap();
        assert_eq!(plain.generic.unwrap().mobility, 0);
        let rings = |first: &str, second: &str| {
            let mut builder = MechanismBuilder::new("two");
            builder.link("ground");
            for name in [first, second] {
                let gap = if name == "p" {
                    [0.5, -0.25, 0.0]
                } else {
                    [0.0; 3]
                };
                add_ring(
                    &mut builder,
                    name,
                    "ground",
                    &planar(&CRANK_ROCKER),
                    gap,
                    Written::Exactly,
                );
            }
            let mechanism = builder.build().unwrap();
            let analysis = analyse(&mechanism, &AnalysisOptions::default()).unwrap();
            let advice: Vec<String> = analysis
                .advice
                .iter()
                .map(|a| {
                    format!(
                        "{} {} {}",
                        mechanism.joints()[a.joint].name,
                        a.to,
                        a.redundant_after
                    )
                })
                .collect();
            (analysis.home, advice, analysis.assembly.residual.to_bits())
        };
        assert_eq!(rings("p", "q"), rings("q", "p"));
    }

    #[test]
    fn many_loops_are_each_looked_at_once() {
        // Each has to be assembled. Work that grew with the square of their number would take minutes.
        let mut builder = MechanismBuilder::new("many");
        builder.link("ground");
        for i in 0..2000 {
            let name = format!("ring_{i}_");
            let gap = [0.25, 0.125, 0.0];
            add_ring(
                &mut builder,
                &name,
                "ground",
                &planar(&CRANK_ROCKER),
                gap,
                Written::Exactly,
            );
        }
        let mechanism = builder.build().unwrap();
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let parts = Structure::new(&mechanism).parts;
        let assembly =
            kutzbach_closure::assemble(&mechanism, &geometry, &parts, &BTreeSet::new()).unwrap();
        assert!(assembly.closed);
        assert_eq!(parts.len(), 2000);
        assert_eq!(JointKind::Revolute.freedom() * 8000, mechanism.freedom());
    }
}
