//! Robots drawn by others, with loops or couplings. They are not part of the repository: these tests run for who has them.

use crate::support;

use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, AnalysisOptions, PoseKind, analyse};
use support::{analysis, shared};

/// A robot's file, with poses to look at added: (name of the pose, joint that is set, value).
fn robot(file: &str, poses: &[(&str, &str, &str)]) -> Mechanism {
    let path = shared("models").join(file);
    let text = std::fs::read_to_string(&path).unwrap();
    let added: String = poses
        .iter()
        .map(|(name, joint, value)| {
            format!("<configuration name=\"{name}\"><position joint=\"{joint}\" value=\"{value}\"/></configuration>\n")
        })
        .collect();
    let text = text.replace("</robot>", &format!("{added}</robot>"));
    kutzbach::format::read(&text, file, &[])
        .unwrap_or_else(|error| panic!("{error}"))
        .mechanism
}

fn at(mechanism: &Mechanism, configuration: &str) -> Analysis {
    let options = AnalysisOptions {
        configuration: Some(configuration.to_owned()),
        ..AnalysisOptions::default()
    };
    analyse(mechanism, &options).unwrap()
}

fn instantaneous_and_redundant(analysis: &Analysis) -> (Option<usize>, Option<i64>) {
    assert!(
        analysis.assembly.closed,
        "misses by {:.1e}",
        analysis.assembly.residual
    );
    let home = analysis.home.as_ref().unwrap();
    (home.instantaneous, home.redundant)
}

#[test]
#[ignore = "needs the robots of others in ../shared/models, or KUTZBACH_SHARED"]
fn four_bar_is_drawn_flat_where_its_rank_drops() {
    let poses = [
        ("little", "joint1", "0.001"),
        ("turned", "joint1", "0.3"),
        ("far", "joint1", "-1.2"),
    ];
    let robot = robot("grbda_four_bar/four_bar.urdf", &poses);
    let home = analysis(&robot);
    assert_eq!(home.kutzbach, -2);
    assert_eq!(instantaneous_and_redundant(&home), (Some(2), Some(4)));
    assert!(home.mobility.pose != Some(PoseKind::Regular));
    for (pose, ..) in poses {
        let there = at(&robot, pose);
        assert_eq!(
            instantaneous_and_redundant(&there),
            (Some(1), Some(3)),
            "the rank grows at the pose `{pose}`"
        );
        assert!(
            there.assembly.moved > 1e-4,
            "{pose}: the pose is another one"
        );
    }
}

#[test]
#[ignore = "needs the robots of others in ../shared/models, or KUTZBACH_SHARED"]
fn planar_leg_is_drawn_flat_where_its_rank_drops() {
    let poses = [
        ("bent", "thigh_to_driver", "0.3"),
        ("back", "thigh_to_support", "-0.8"),
    ];
    let robot = robot("grbda_planar_leg_linkage/planar_leg_linkage.urdf", &poses);
    let home = analysis(&robot);
    assert_eq!(home.kutzbach, -1);
    assert_eq!(instantaneous_and_redundant(&home), (Some(3), Some(4)));
    for (pose, ..) in poses {
        assert_eq!(
            instantaneous_and_redundant(&at(&robot, pose)),
            (Some(2), Some(3)),
            "the rank grows at the pose `{pose}`"
        );
    }
}

#[test]
#[ignore = "needs the robots of others in ../shared/models, or KUTZBACH_SHARED"]
fn six_bar_is_drawn_open_and_assembles() {
    let robot = robot("grbda_six_bar/six_bar.urdf", &[]);
    let home = analysis(&robot);
    let [gap] = home.assembly.gaps.as_slice() else {
        panic!("one loop: {:?}", home.assembly.gaps)
    };
    assert!(
        (gap.position - 0.3).abs() < 1e-12,
        "drawn open by {}",
        gap.position
    );
    assert!(gap.left_position < 1e-12 && gap.left_angle < 1e-12);
    // Closing a gap of 0.3 m moves something by no less than half of it, and nothing by more than the longest link.
    assert!((0.15..1.0).contains(&home.assembly.moved));
    assert_eq!(home.kutzbach, 0);
    assert_eq!(instantaneous_and_redundant(&home), (Some(3), Some(3)));
}

#[test]
#[ignore = "needs the robots of others in ../shared/models, or KUTZBACH_SHARED"]
fn humanoid_leg_is_five_geared_joints() {
    let robot = robot("grbda_mit_humanoid_leg/mit_humanoid_leg.urdf", &[]);
    let home = analysis(&robot);
    assert_eq!((robot.joints().len(), robot.couplings().len()), (10, 5));
    assert_eq!(home.kutzbach, 5);
    assert_eq!(instantaneous_and_redundant(&home), (Some(5), Some(0)));
    assert_eq!(home.mobility.finite(), Some(5));
    assert!(home.roles.iter().all(|role| role.locked == Some(false)));
}
