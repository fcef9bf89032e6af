//! Logs read back with the container's own reader: the numbers put in, the same bytes every time, and what is left when
//! writing ends early.

#![allow(clippy::unwrap_used)]

mod support;

use foxglove::Decode;
use foxglove::messages::{FrameTransforms, JointStates, Log, SceneUpdate};
use kutzbach::closure::{Arithmetic, Geometry, Rigid};
use kutzbach::mechanism::{Frame, JointBuilder, JointKind, Mechanism, MechanismBuilder};
use kutzbach::number::Number;
use kutzbach::record::{
    Closure, ClosureError, Drawing, Gap, Header, JointClosure, Level, LogFile, Motion, Part,
    Prediction, RecordError, Recorder, Role, Roles, Stream, frame_id, robot_description,
};
use mcap::read::Options;
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};
use std::path::PathBuf;
use support::{in_parallel, own_mechanisms, zoo, zoo_mechanism};

/// A mechanism with all that a header refers to.
struct Subject {
    mechanism: Mechanism,
    geometry: Geometry<f64>,
    roles: Roles,
    facts: BTreeMap<String, String>,
    source: Vec<u8>,
    simulated_at: Option<[f64; 3]>,
}

impl Subject {
    fn new(mechanism: Mechanism) -> Self {
        Self {
            geometry: Geometry::new(&mechanism, None, &Arithmetic::double()),
            source: kutzbach::format::write(&mechanism).into_bytes(),
            mechanism,
            roles: Roles::default(),
            facts: BTreeMap::from([("verdict".to_owned(), "mobile".to_owned())]),
            simulated_at: None,
        }
    }

    fn header(&self) -> Header<'_> {
        Header {
            mechanism: &self.mechanism,
            geometry: &self.geometry,
            source_name: "mechanism.urdf",
            source: &self.source,
            report: Some("{\"verdict\": \"mobile\"}"),
            facts: &self.facts,
            roles: &self.roles,
            simulated_at: self.simulated_at,
        }
    }

    fn recorder<W: Write>(&self, writer: W) -> Result<Recorder<'_, W>, RecordError> {
        Recorder::to_writer(writer, &self.header())
    }

    fn joint_values(&self, factor: f64) -> Vec<Vec<f64>> {
        let states = self.geometry.states.iter().enumerate();
        states
            .map(|(i, state)| {
                state
                    .values
                    .iter()
                    .map(|_| factor * (i as f64 + 1.0))
                    .collect()
            })
            .collect()
    }
}

/// The poses of the home pose, moved as a whole and each by itself.
fn moved(home: &[Rigid<f64>], angle: f64) -> Vec<Rigid<f64>> {
    home.iter()
        .enumerate()
        .map(|(i, pose)| {
            let angular = [0.3 * angle, -0.2 * angle, angle + i as f64];
            Rigid::exponential(&angular, &[0.5, angle, -1.0]).compose(pose)
        })
        .collect()
}

/// A log of both motions with everything a log can hold.
fn record<W: Write>(subject: &Subject, writer: W, moments: usize) -> Result<W, RecordError> {
    let mut recorder = subject.recorder(writer)?;
    recorder.log(0.0, Level::Info, "begin")?;
    for moment in 0..moments {
        let time = 0.1 * moment as f64;
        let links = moved(&subject.geometry.home, time);
        let other = moved(&subject.geometry.home, time + 0.01);
        let joints = subject.joint_values(time);
        let rates = subject.joint_values(1.0);
        let gaps = [Gap {
            joint: 0,
            predecessor: [0.0, time, 0.0],
            successor: [0.0, time, 0.001],
        }];
        let predicted = Motion {
            joints: &joints,
            ..Motion::of_links(&links)
        };
        let simulated = Motion {
            links: &other,
            joints: &joints,
            rates: &rates,
            gaps: &gaps,
        };
        recorder.moment(time, Some(&predicted), Some(&simulated))?;
        let error = ClosureError {
            position: 1e-3,
            angle: 1e-4,
            relative: 1e-3,
            joints: vec![JointClosure {
                joint: "a".to_owned(),
                position: 1e-3,
                angle: f64::NAN,
            }],
        };
        recorder.closure(
            time,
            &Closure {
                predicted: None,
                simulated: Some(error),
            },
        )?;
        recorder.prediction(time, &Prediction::default())?;
    }
    Ok(recorder.finish_into()?.1)
}

fn bytes(subject: &Subject, moments: usize) -> Vec<u8> {
    record(subject, Vec::new(), moments).unwrap()
}

/// Messages up to the first fault: (topic, time in ns, data), and whether there was a fault.
fn messages(log: &[u8]) -> (Vec<(String, u64, Vec<u8>)>, bool) {
    let options = Options::IgnoreEndMagic | Options::ValidateChunkCrcs;
    let mut found = Vec::new();
    let Ok(stream) = mcap::MessageStream::new_with_options(log, options) else {
        return (found, true);
    };
    for message in stream {
        match message {
            Ok(m) => found.push((m.channel.topic.clone(), m.log_time, m.data.to_vec())),
            Err(_) => return (found, true),
        }
    }
    (found, false)
}

fn on_topic<T: Decode>(log: &[u8], topic: &str) -> Vec<(u64, T)> {
    let (all, fault) = messages(log);
    assert!(!fault);
    all.into_iter()
        .filter(|(name, _, _)| name == topic)
        .map(|(_, time, data)| match T::decode(data.as_slice()) {
            Ok(message) => (time, message),
            Err(error) => panic!("{topic}: {error}"),
        })
        .collect()
}

/// The pose of a frame in the root frame of its stream, chained up link by link.
fn pose_in_stream(transforms: &FrameTransforms, frame: &str) -> Rigid<f64> {
    let mut pose = Rigid::identity(&0.0);
    let mut frame = frame.to_owned();
    while frame != "predicted" && frame != "simulated" {
        let step = transforms
            .transforms
            .iter()
            .find(|t| t.child_frame_id == frame)
            .unwrap_or_else(|| panic!("no frame {frame}"));
        let t = step.translation.unwrap();
        let q = step.rotation.unwrap();
        let (x, y, z, w) = (q.x, q.y, q.z, q.w);
        assert!((x * x + y * y + z * z + w * w - 1.0).abs() < 1e-14);
        let row = |a: [f64; 3]| a;
        let parent_from_child = Rigid {
            rotation: [
                row([
                    1.0 - 2.0 * (y * y + z * z),
                    2.0 * (x * y - z * w),
                    2.0 * (x * z + y * w),
                ]),
                row([
                    2.0 * (x * y + z * w),
                    1.0 - 2.0 * (x * x + z * z),
                    2.0 * (y * z - x * w),
                ]),
                row([
                    2.0 * (x * z - y * w),
                    2.0 * (y * z + x * w),
                    1.0 - 2.0 * (x * x + y * y),
                ]),
            ],
            translation: [t.x, t.y, t.z],
        };
        pose = parent_from_child.compose(&pose);
        frame = step.parent_frame_id.clone();
    }
    pose
}

fn distance(a: &Rigid<f64>, b: &Rigid<f64>) -> f64 {
    let turns = a.rotation.iter().flatten().zip(b.rotation.iter().flatten());
    let ways = a.translation.iter().zip(&b.translation);
    turns
        .chain(ways)
        .map(|(x, y)| (x - y).abs())
        .fold(0.0, f64::max)
}

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
fn an_empty_recording_is_a_log() {
    let subject = Subject::new(zoo_mechanism("bennett_rational"));
    let log = bytes(&subject, 0);
    let (found, fault) = messages(&log);
    assert!(!fault);
    assert_eq!(found.len(), 1, "the log's own entry");
    let recorder = subject.recorder(Vec::new()).unwrap();
    let (summary, log) = recorder.finish_into().unwrap();
    assert_eq!((summary.moments, summary.messages), (0, 0));
    let read = mcap::Summary::read(&log).unwrap().unwrap();
    assert_eq!(read.stats.unwrap().message_count, 0);
    assert_eq!(read.attachment_indexes.len(), 2);
}

#[test]
fn a_log_cut_anywhere_is_readable_up_to_the_cut() {
    let subject = Subject::new(zoo_mechanism("bennett_rational"));
    let log = bytes(&subject, 200);
    let (whole, _) = messages(&log);
    let mut last = 0;
    let step = log.len() / 211;
    for cut in (0..log.len()).step_by(step) {
        let (found, _) = messages(&log[..cut]);
        assert!(found.len() >= last, "more bytes, fewer messages");
        last = found.len();
        assert_eq!(found, whole[..last]);
        // No more than one chunk of 32 moments, 7 messages each, and the summary is lost.
        let bytes_per_moment = log.len() / 200;
        let kept = cut.saturating_sub(34 * bytes_per_moment) / bytes_per_moment;
        let data_ends = 200 - 32;
        assert!(
            found.len() >= 7 * kept.min(data_ends).saturating_sub(32),
            "{cut} of {}: {} messages",
            log.len(),
            found.len()
        );
    }
    assert!(last * 10 > whole.len() * 9);
}

/// Takes some bytes and then no more.
struct Full {
    room: usize,
    taken: Vec<u8>,
}

impl Write for &mut Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.room == 0 {
            return Err(io::Error::from(io::ErrorKind::StorageFull));
        }
        let count = bytes.len().min(self.room);
        self.room -= count;
        self.taken.extend(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error_and_what_is_there_is_readable() {
    let subject = Subject::new(zoo_mechanism("planar_4r_general"));
    let whole = bytes(&subject, 70);
    let (all, _) = messages(&whole);
    let rooms = (0..200)
        .chain((200..whole.len()).step_by(997))
        .chain(whole.len() - 40..whole.len());
    for room in rooms {
        let mut disk = Full {
            room,
            taken: Vec::new(),
        };
        match record(&subject, &mut disk, 70) {
            Err(RecordError::Io(error)) => assert_eq!(error.kind(), io::ErrorKind::StorageFull),
            Err(other) => panic!("{other}"),
            Ok(_) => panic!("{room} bytes are not enough"),
        }
        assert!(
            disk.taken == whole[..room],
            "what was written is the log's beginning"
        );
        let (found, _) = messages(&disk.taken);
        assert_eq!(found, all[..found.len()]);
    }
    let mut disk = Full {
        room: whole.len(),
        taken: Vec::new(),
    };
    assert!(record(&subject, &mut disk, 70).is_ok());
}

#[test]
fn nothing_is_written_after_an_error() {
    let subject = Subject::new(zoo_mechanism("planar_4r_general"));
    let mut disk = Full {
        room: 9_000,
        taken: Vec::new(),
    };
    let mut recorder = subject.recorder(&mut disk).unwrap();
    let links = subject.geometry.home.clone();
    let mut failed = 0;
    for moment in 0..200 {
        let motion = Motion::of_links(&links);
        if recorder
            .moment(f64::from(moment), Some(&motion), None)
            .is_err()
        {
            failed += 1;
        }
    }
    assert!(failed > 100);
    assert!(recorder.finish_into().is_err());
}

/// A folder of its own for one test.
fn scratch(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn names_in(folder: &PathBuf) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn a_file_appears_when_it_is_complete() {
    let folder = scratch("appears");
    let path = folder.join("log.mcap");
    std::fs::write(&path, "old").unwrap();
    let subject = Subject::new(zoo_mechanism("bennett_rational"));
    let recorder = Recorder::create(&path, &subject.header()).unwrap();
    assert_eq!(std::fs::read(&path).unwrap(), b"old");
    assert_eq!(names_in(&folder).len(), 2);
    drop(recorder);
    assert_eq!(names_in(&folder), ["log.mcap"]);
    assert_eq!(std::fs::read(&path).unwrap(), b"old");

    let mut recorder = Recorder::create(&path, &subject.header()).unwrap();
    let motion = Motion::of_links(&subject.geometry.home);
    recorder.moment(0.0, Some(&motion), None).unwrap();
    recorder.moment(0.5, Some(&motion), None).unwrap();
    let summary = recorder.finish_early("interrupted").unwrap();
    assert_eq!((summary.moments, summary.until), (2, 0.5));
    assert_eq!(names_in(&folder), ["log.mcap"]);
    let log = std::fs::read(&path).unwrap();
    let entries: Vec<(u64, Log)> = on_topic(&log, "/log");
    let [(500_000_000, entry)] = entries.as_slice() else {
        panic!("{entries:?}")
    };
    assert_eq!(
        entry.message,
        "stopped early: interrupted; 2 moments recorded, up to 0.5 s"
    );

    let nowhere = folder.join("no").join("such.mcap");
    assert!(matches!(
        Recorder::create(&nowhere, &subject.header()),
        Err(RecordError::Io(_))
    ));
}

/// Chunks are on the disk long before the log ends: this is what a crash leaves.
#[test]
fn an_unfinished_file_is_readable() {
    let folder = scratch("unfinished");
    let path = folder.join("log.mcap");
    let subject = Subject::new(zoo_mechanism("bennett_rational"));
    let mut recorder = Recorder::create(&path, &subject.header()).unwrap();
    for moment in 0..100 {
        let motion = Motion::of_links(&subject.geometry.home);
        recorder
            .moment(f64::from(moment), Some(&motion), None)
            .unwrap();
    }
    let part = folder.join(&names_in(&folder)[0]);
    assert!(part.extension().is_some_and(|e| e == "part"));
    let (found, _) = messages(&std::fs::read(part).unwrap());
    let frames = found.iter().filter(|(topic, _, _)| topic == "/tf").count();
    assert_eq!(frames, 96);
    recorder.finish().unwrap();
}

#[cfg(target_os = "linux")]
#[test]
fn a_device_that_is_full() {
    let full = PathBuf::from("/dev/full");
    if !full.exists() {
        println!("skipped: there is no /dev/full");
        return;
    }
    let subject = Subject::new(zoo_mechanism("bennett_rational"));
    let file = LogFile::create(&full).unwrap();
    assert!(matches!(
        record(&subject, file, 50),
        Err(RecordError::Io(_))
    ));
    assert!(full.exists());
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
