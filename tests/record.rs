//! Logs read back with the container's own reader: the numbers put in, shapes of every mechanism, the same bytes every time.

use crate::record_support;
use crate::support;

use foxglove::messages::{FrameTransforms, JointStates, SceneUpdate};
use kutzbach::closure::Rigid;
use kutzbach::mechanism::{Frame, JointBuilder, JointKind, Mechanism, MechanismBuilder};
use kutzbach::number::Number;
use kutzbach::record::{
    Drawing, Gap, Level, Motion, Part, RecordError, Role, Roles, Stream, frame_id,
    robot_description,
};
use proptest::prelude::*;
use record_support::{Subject, bytes, distance, moved, on_topic, pose_in_stream};
use std::collections::BTreeSet;
use support::{in_parallel, own_mechanisms, zoo, zoo_mechanism};

#[test]
fn poses_and_values_come_back() {
    let subject = Subject::new(zoo_mechanism("bennett_rational"));
    let log = bytes(&subject, 7);
    let frames: Vec<(u64, FrameTransforms)> = on_topic(&log, "/tf");
    assert_eq!(frames.len(), 7);
    for (moment, (time, transforms)) in frames.iter().enumerate() {
        assert_eq!(*time, 100_000_000 * moment as u64);
        let at = 0.1 * moment as f64;
        for (stream, angle) in [(Stream::Predicted, at), (Stream::Simulated, at + 0.01)] {
            let poses = moved(&subject.geometry.home, angle);
            for (link, pose) in subject.mechanism.links().iter().zip(&poses) {
                let found = pose_in_stream(transforms, &frame_id(stream, &link.name));
                // Coordinates up to ten, chained over four frames: some tens of roundings of 1e-15.
                assert!(distance(&found, pose) < 1e-13, "{}", link.name);
            }
        }
        for stamped in &transforms.transforms {
            let stamp = stamped.timestamp.unwrap();
            assert_eq!(u64::from(stamp.nsec()), time % 1_000_000_000);
        }
    }
    for (topic, has_rates) in [("/joint_states", false), ("/simulated/joint_states", true)] {
        let states: Vec<(u64, JointStates)> = on_topic(&log, topic);
        assert_eq!(states.len(), 7);
        for (moment, (_, states)) in states.iter().enumerate() {
            for (index, joint) in states.joints.iter().enumerate() {
                assert_eq!(joint.name, subject.mechanism.joints()[index].name);
                let value = 0.1 * moment as f64 * (index as f64 + 1.0);
                assert_eq!(joint.position, Some(value));
                assert_eq!(joint.velocity.is_some(), has_rates);
            }
        }
    }
}

#[test]
fn attachments_metadata_and_topics() {
    let subject = Subject::new(zoo_mechanism("sarrus_6r"));
    let log = bytes(&subject, 1);
    let summary = mcap::Summary::read(&log).unwrap().unwrap();
    let topics: BTreeSet<(String, String)> = summary
        .channels
        .values()
        .map(|c| (c.topic.clone(), c.schema.as_ref().unwrap().name.clone()))
        .collect();
    let expected = [
        ("/joint_states", "foxglove.JointStates"),
        ("/log", "foxglove.Log"),
        ("/mobility/closure", "closure.Closure"),
        ("/mobility/error", "estimate.Estimate"),
        ("/mobility/prediction", "prediction.Prediction"),
        ("/robot_description", "std_msgs/msg/String"),
        ("/scene", "foxglove.SceneUpdate"),
        ("/scene/gaps", "foxglove.SceneUpdate"),
        ("/simulated/joint_states", "foxglove.JointStates"),
        ("/simulated/robot_description", "std_msgs/msg/String"),
        ("/tf", "foxglove.FrameTransforms"),
    ];
    let expected = expected.map(|(topic, schema)| (topic.to_owned(), schema.to_owned()));
    assert_eq!(topics, BTreeSet::from(expected));
    let attached: Vec<_> = summary
        .attachment_indexes
        .iter()
        .map(|index| mcap::read::attachment(&log, index).unwrap())
        .collect();
    assert_eq!(attached[0].name, "mechanism.urdf");
    assert_eq!(attached[0].data, subject.source);
    assert_eq!(attached[1].name, "report.json");
    assert!(
        attached
            .iter()
            .all(|a| a.log_time == 0 && a.create_time == 0)
    );
    let facts = mcap::read::metadata(&log, &summary.metadata_indexes[0]).unwrap();
    assert_eq!(facts.name, "mobility");
    assert_eq!(facts.metadata, subject.facts);
}

#[test]
fn same_input_same_bytes() {
    let subject = Subject::new(zoo_mechanism("stewart_6UPS"));
    let first = bytes(&subject, 100);
    let again = Subject::new(zoo_mechanism("stewart_6UPS"));
    assert!(first == bytes(&again, 100));
}

/// What has to hold for the drawing and the log of any mechanism.
fn shown(name: &str, mechanism: &Mechanism) -> Vec<String> {
    let subject = Subject::new(mechanism.clone());
    let mut wrong = Vec::new();
    let drawing = Drawing::new(&subject.mechanism, &subject.geometry, &subject.roles);
    let links = subject.mechanism.links();
    let mut has_shape = vec![false; links.len()];
    for shape in &drawing.shapes {
        let size = shape.primitive.size();
        if !size
            .iter()
            .all(|x| x.is_finite() && *x > 0.0 && *x < 100.0 * drawing.extent)
        {
            wrong.push(format!("{name}: a shape of size {size:?}"));
        }
        if !shape.pose.translation.iter().all(|x| x.is_finite()) {
            wrong.push(format!("{name}: a shape at {:?}", shape.pose.translation));
        }
        has_shape[shape.link] |= shape.part == Part::Link;
    }
    for (link, has) in links.iter().zip(&has_shape) {
        if !has {
            wrong.push(format!("{name}: link `{}` has no shape", link.name));
        }
    }
    let log = bytes(&subject, 2);
    let frames: Vec<(u64, FrameTransforms)> = on_topic(&log, "/tf");
    let known: BTreeSet<&str> = frames[0]
        .1
        .transforms
        .iter()
        .map(|t| t.child_frame_id.as_str())
        .collect();
    if known.len() != 2 * links.len() + 2 {
        wrong.push(format!("{name}: {} frames", known.len()));
    }
    let scenes: Vec<(u64, SceneUpdate)> = on_topic(&log, "/scene");
    assert_eq!(scenes.len(), 1);
    let mut ids = BTreeSet::new();
    for entity in &scenes[0].1.entities {
        if !known.contains(entity.frame_id.as_str()) {
            wrong.push(format!("{name}: no frame {}", entity.frame_id));
        }
        if !ids.insert(&entity.id) {
            wrong.push(format!("{name}: two entities {}", entity.id));
        }
        assert!(entity.frame_locked);
    }
    for stream in Stream::BOTH {
        let text = robot_description(&subject.mechanism, &subject.geometry, &drawing, stream);
        match urdf_rs::read_from_string(&text) {
            Ok(robot) => {
                if robot.links.len() != links.len() + 1 || robot.joints.len() != links.len() {
                    wrong.push(format!("{name}: URDF is no tree"));
                }
                let unknown = |l: &&urdf_rs::Link| !known.contains(l.name.as_str());
                if let Some(link) = robot.links.iter().find(unknown) {
                    wrong.push(format!("{name}: URDF link {} has no frame", link.name));
                }
            }
            Err(error) => wrong.push(format!("{name}: URDF: {error}")),
        }
    }
    wrong
}

#[test]
fn every_mechanism_can_be_shown() {
    let mut all = zoo();
    all.extend(own_mechanisms());
    assert!(all.len() > 100);
    let wrong = in_parallel(&all, |(name, mechanism)| shown(name, mechanism));
    support::assert_none(&wrong.concat());
}

/// Every kind of joint between two links, home poses apart.
#[test]
fn every_kind_of_joint_has_a_symbol() {
    for kind in JointKind::ALL {
        let mut builder = MechanismBuilder::new("pair");
        builder.link("a").link("b");
        let at = |text: &str| Frame::at([text, "0", "0"].map(|t| Number::decimal(t).unwrap()));
        let mut joint = JointBuilder::tree("j", kind, "a", "b").origin(at("0.5"));
        if kind.uses_lead() {
            joint = joint.lead(Number::decimal("0.1").unwrap());
        }
        if kind == JointKind::Distance {
            joint = joint.distance(Number::decimal("0.2").unwrap());
        }
        builder.joint(joint);
        let mechanism = builder.build().unwrap();
        let subject = Subject::new(mechanism);
        let drawing = Drawing::new(&subject.mechanism, &subject.geometry, &subject.roles);
        let symbol = |s: &&kutzbach::record::Shape| s.part == Part::Joint(0);
        assert!(drawing.shapes.iter().any(|s| symbol(&s)), "{kind:?}");
        let log = bytes(&subject, 1);
        // A rod joins the two points of a distance joint at every moment.
        let gaps: Vec<(u64, SceneUpdate)> = on_topic(&log, "/scene/gaps");
        let rods = gaps[0].1.entities[0].cylinders.len();
        assert_eq!(rods, usize::from(kind == JointKind::Distance));
    }
}

#[test]
fn gaps_are_drawn_as_they_are() {
    let subject = Subject::new(zoo_mechanism("bennett_rational"));
    let log = bytes(&subject, 3);
    let gaps: Vec<(u64, SceneUpdate)> = on_topic(&log, "/scene/gaps");
    for (moment, (_, update)) in gaps.iter().enumerate() {
        assert_eq!(update.entities[0].id, "predicted/gaps");
        assert!(update.entities[0].lines.is_empty());
        let [line] = update.entities[1].lines.as_slice() else {
            panic!("one gap, one line")
        };
        let points: Vec<[f64; 3]> = line.points.iter().map(|p| [p.x, p.y, p.z]).collect();
        let y = 0.1 * moment as f64;
        assert_eq!(points, [[0.0, y, 0.0], [0.0, y, 0.001]]);
        assert_eq!(update.entities[1].frame_id, "simulated");
    }
}

#[test]
fn names_of_any_kind() {
    let names = [
        "a b",
        "a/b",
        "a\tb",
        "a\u{1}",
        "a\\u{1}",
        "<a>&\"'",
        "Größe",
        "机构",
        "a\nb",
        "--",
        "]]>",
        "../a",
        "world",
        "predicted",
    ];
    let mut builder = MechanismBuilder::new("strange \u{2}<&>\"--");
    builder.link("ground");
    for name in names {
        builder.link(name);
        let joint = JointBuilder::tree(name, JointKind::Revolute, "ground", name);
        builder.joint(joint);
    }
    // As the two freedoms of this one are called, so is another joint.
    builder.link("x").link("y");
    builder.joint(JointBuilder::tree(
        "c",
        JointKind::Cylindrical,
        "ground",
        "x",
    ));
    builder.joint(JointBuilder::tree(
        "c.rot",
        JointKind::Revolute,
        "ground",
        "y",
    ));
    let mechanism = builder.build().unwrap();
    support::assert_none(&shown("strange", &mechanism));
    let subject = Subject::new(mechanism);
    let log = bytes(&subject, 1);
    let states: Vec<(u64, JointStates)> = on_topic(&log, "/joint_states");
    let found: BTreeSet<&str> = states[0].1.joints.iter().map(|j| j.name.as_str()).collect();
    assert_eq!(found.len(), subject.mechanism.freedom());
}

#[test]
fn loops_between_hostile_names_stay_inside_their_comment() {
    let mut builder = MechanismBuilder::new("loop");
    builder.link("ground").link("--><robot>");
    builder.joint(JointBuilder::tree(
        "a",
        JointKind::Revolute,
        "ground",
        "--><robot>",
    ));
    builder.joint(JointBuilder::closing(
        "--->",
        JointKind::Revolute,
        "ground",
        "--><robot>",
    ));
    support::assert_none(&shown("loop", &builder.build().unwrap()));
}

#[test]
fn numbers_that_cannot_be_shown_are_refused() {
    let subject = Subject::new(zoo_mechanism("bennett_rational"));
    let mut recorder = subject.recorder(Vec::new()).unwrap();
    let good = subject.geometry.home.clone();
    let mut bad = good.clone();
    bad[1].translation[2] = f64::NAN;
    let mut infinite = good.clone();
    infinite[2].rotation[0][0] = f64::INFINITY;
    for links in [&bad, &infinite] {
        let motion = Motion::of_links(links);
        for (predicted, simulated) in [(Some(&motion), None), (None, Some(&motion))] {
            let refused = recorder.moment(0.0, predicted, simulated);
            assert!(matches!(refused, Err(RecordError::NotFinite { .. })));
        }
    }
    let values = vec![vec![0.0]; 3];
    let wrong_joints = Motion {
        joints: &values,
        ..Motion::of_links(&good)
    };
    let wrong_links = Motion::of_links(&good[1..]);
    let gaps = [Gap {
        joint: 99,
        predecessor: [0.0; 3],
        successor: [0.0; 3],
    }];
    let wrong_gap = Motion {
        gaps: &gaps,
        ..Motion::of_links(&good)
    };
    for motion in [&wrong_joints, &wrong_links, &wrong_gap] {
        let refused = recorder.moment(0.0, Some(motion), None);
        assert!(matches!(refused, Err(RecordError::Count { .. })));
    }
    let motion = Motion::of_links(&good);
    for time in [-1.0, f64::NAN, 1e300] {
        let refused = recorder.moment(time, Some(&motion), None);
        assert!(matches!(refused, Err(RecordError::Time { .. })));
        assert!(recorder.log(time, Level::Error, "x").is_err());
    }
    // Nothing of all this has left a trace.
    let untouched = subject.recorder(Vec::new()).unwrap().finish_into().unwrap();
    assert!(recorder.finish_into().unwrap().1 == untouched.1);

    let mut nowhere = Subject::new(zoo_mechanism("bennett_rational"));
    nowhere.simulated_at = Some([f64::NAN, 0.0, 0.0]);
    assert!(nowhere.recorder(Vec::new()).is_err());
}

#[test]
fn roles_colour_the_scene_and_may_change() {
    let mut subject = Subject::new(zoo_mechanism("bennett_rational"));
    subject.simulated_at = Some([0.0; 3]);
    let mut recorder = subject.recorder(Vec::new()).unwrap();
    let motion = Motion::of_links(&subject.geometry.home);
    recorder.moment(0.0, Some(&motion), None).unwrap();
    let mut roles = Roles::default();
    recorder.set_roles(0.5, &roles).unwrap();
    roles.joints = vec![Role::Driven];
    recorder.set_roles(1.0, &roles).unwrap();
    recorder.moment(2.0, Some(&motion), Some(&motion)).unwrap();
    let (_, log) = recorder.finish_into().unwrap();
    let scenes: Vec<(u64, SceneUpdate)> = on_topic(&log, "/scene");
    let times: Vec<u64> = scenes
        .iter()
        .map(|(time, _)| time / 1_000_000_000)
        .collect();
    assert_eq!(times, [0, 1, 2], "same roles, same scene");
    let first = &subject.mechanism.joints()[0].name;
    let colour = |scene: &SceneUpdate, id: &str| {
        let entity = scene
            .entities
            .iter()
            .find(|e| e.id == format!("{id}{first}"));
        entity.unwrap().cylinders[0].color.unwrap()
    };
    let [before, driven, both] = [0, 1, 2].map(|i| colour(&scenes[i].1, "predicted/joint/"));
    assert!(before != driven);
    // In one place with the simulated motion, the predicted one is seen through.
    assert!(before.a == 1.0 && driven.a == 1.0 && both.a < 0.5);
    assert_eq!(colour(&scenes[2].1, "simulated/joint/").a, 1.0);
    assert_eq!(scenes[1].1.entities.len() * 2, scenes[2].1.entities.len());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Whatever the poses, the chain of frames gives them back.
    #[test]
    fn any_poses_come_back(
        twists in prop::collection::vec((prop::array::uniform3(-3.1..3.1f64), prop::array::uniform3(-9.0..9.0f64)), 6),
        time in 0.0..1e6f64,
    ) {
        let subject = Subject::new(zoo_mechanism("general_6r_rigid"));
        let links: Vec<Rigid<f64>> = twists
            .iter()
            .map(|(angular, place)| {
                let mut pose = Rigid::exponential(angular, &[0.0; 3]);
                pose.translation = *place;
                pose
            })
            .collect();
        let mut recorder = subject.recorder(Vec::new()).unwrap();
        recorder.moment(time, None, Some(&Motion::of_links(&links))).unwrap();
        let (_, log) = recorder.finish_into().unwrap();
        let frames: Vec<(u64, FrameTransforms)> = on_topic(&log, "/tf");
        // One nanosecond, and the rounding of a million seconds.
        prop_assert!((frames[0].0 as f64 * 1e-9 - time).abs() < 1.1e-9);
        for (link, pose) in subject.mechanism.links().iter().zip(&links) {
            let found = pose_in_stream(&frames[0].1, &frame_id(Stream::Simulated, &link.name));
            prop_assert!(distance(&found, pose) < 2e-13);
        }
    }
}
