//! What the tests of logs share: a mechanism with a motion to record, and reading back.

use foxglove::Decode;
use foxglove::messages::FrameTransforms;
use kutzbach::closure::{Arithmetic, Geometry, Rigid};
use kutzbach::mechanism::Mechanism;
use kutzbach::record::{
    Closure, ClosureError, Gap, Header, JointClosure, Level, Motion, Prediction, RecordError,
    Recorder, Roles,
};
use mcap::read::Options;
use std::collections::BTreeMap;
use std::io::Write;

/// A mechanism with all that a header refers to.
pub struct Subject {
    pub mechanism: Mechanism,
    pub geometry: Geometry<f64>,
    pub roles: Roles,
    pub facts: BTreeMap<String, String>,
    pub source: Vec<u8>,
    pub simulated_at: Option<[f64; 3]>,
}

impl Subject {
    pub fn new(mechanism: Mechanism) -> Self {
        Self {
            geometry: Geometry::new(&mechanism, None, &Arithmetic::double()),
            source: kutzbach::format::write(&mechanism).into_bytes(),
            mechanism,
            roles: Roles::default(),
            facts: BTreeMap::from([("verdict".to_owned(), "mobile".to_owned())]),
            simulated_at: None,
        }
    }

    pub fn header(&self) -> Header<'_, '_> {
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

    pub fn recorder<W: Write>(&self, writer: W) -> Result<Recorder<'_, W>, RecordError> {
        Recorder::to_writer(writer, &self.header())
    }

    pub fn joint_values(&self, factor: f64) -> Vec<Vec<f64>> {
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
pub fn moved(home: &[Rigid<f64>], angle: f64) -> Vec<Rigid<f64>> {
    home.iter()
        .enumerate()
        .map(|(i, pose)| {
            let angular = [0.3 * angle, -0.2 * angle, angle + i as f64];
            Rigid::exponential(&angular, &[0.5, angle, -1.0]).compose(pose)
        })
        .collect()
}

/// A log of both motions with everything a log can hold.
pub fn record<W: Write>(subject: &Subject, writer: W, moments: usize) -> Result<W, RecordError> {
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

pub fn bytes(subject: &Subject, moments: usize) -> Vec<u8> {
    record(subject, Vec::new(), moments).unwrap()
}

/// Messages up to the first fault: (topic, time in ns, data), and whether there was a fault.
pub fn messages(log: &[u8]) -> (Vec<(String, u64, Vec<u8>)>, bool) {
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

pub fn on_topic<T: Decode>(log: &[u8], topic: &str) -> Vec<(u64, T)> {
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
pub fn pose_in_stream(transforms: &FrameTransforms, frame: &str) -> Rigid<f64> {
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

pub fn distance(a: &Rigid<f64>, b: &Rigid<f64>) -> f64 {
    let turns = a.rotation.iter().flatten().zip(b.rotation.iter().flatten());
    let ways = a.translation.iter().zip(&b.translation);
    turns
        .chain(ways)
        .map(|(x, y)| (x - y).abs())
        .fold(0.0, f64::max)
}
