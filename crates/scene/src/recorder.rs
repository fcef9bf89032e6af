//! The recorder: a mechanism first, then moment after moment.

use super::appearance::Roles;
use super::attachments::{attachment, media_type};
use super::channels::{Channel, Channels};
use super::error::RecordError;
use super::log_file::LogFile;
use super::messages::{
    Closure, Estimate, Level, Motion, Prediction, nanoseconds, rotation, stamp, vector,
};
use super::names::{Stream, frame_id, variable_names};
use super::robot_description::{cdr_string, robot_description};
use super::scene;
use super::shapes::Drawing;
use super::vectors::is_finite;
use foxglove::Encode;
use foxglove::messages::{FrameTransform, FrameTransforms, JointState, JointStates, Log};
use kutzbach_closure::{Geometry, Rigid};
use kutzbach_model::mechanism::{Mechanism, Placement};
use mcap::records::MessageHeader;
use mcap::write::{Metadata, NoSeek, WriteOptions};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;

/// A chunk ends when it is as large as this (bytes), …
const CHUNK_SIZE: u64 = 256 * 1024;
/// … or after this many moments: what a crash can lose. Counted and not timed, so that logs do not depend on the clock.
const MOMENTS_PER_CHUNK: u64 = 32;

/// The name of the frame that everything stands in.
pub const WORLD: &str = "world";

/// Distance of the simulated motion from the predicted one, in units of the mechanism's extent.
const SIDE_BY_SIDE: f64 = 1.5;

/// What a log says once, before anything moves.
#[derive(Clone, Copy, Debug)]
pub struct Header<'a, 'b> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// Its frames at home.
    pub geometry: &'a Geometry<f64>,
    /// The file's name, as the attachment will have it.
    pub source_name: &'b str,
    /// The mechanism file, byte for byte.
    pub source: &'b [u8],
    /// The mobility report as JSON, if there is one: attached as `report.json`.
    pub report: Option<&'b str>,
    /// What the metadata record `mobility` says: verdict, finite freedom, class, seed, settings.
    pub facts: &'b BTreeMap<String, String>,
    /// What links and joints do in the motion shown.
    pub roles: &'b Roles,
    /// Where the simulated motion is drawn, seen from the predicted one (m); `None` puts it beside.
    pub simulated_at: Option<[f64; 3]>,
}

/// What a finished log holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Summary {
    /// Moments recorded by [`Recorder::moment`].
    pub moments: u64,
    /// Messages on all topics.
    pub messages: u64,
    /// The latest time recorded (s).
    pub until: f64,
}

/// Writes a log as it happens. Memory: one chunk, and some bytes per chunk written.
///
/// Nothing is written after an error; the log is then incomplete and [`LogFile`] removes it.
pub struct Recorder<'a, W: Write> {
    writer: mcap::Writer<NoSeek<W>>,
    channels: Channels,
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    roles: Roles,
    drawing: Drawing,
    rods: Vec<(usize, [Rigid<f64>; 2])>,
    /// Names of joint variables, joint by joint.
    variables: Vec<Vec<String>>,
    /// `world_from_stream`, as far as it is a translation.
    offsets: [[f64; 3]; 2],
    /// Streams whose shapes the scene has.
    shown: [bool; 2],
    moments: u64,
    messages: u64,
    /// Nanoseconds.
    until: u64,
    buffer: Vec<u8>,
}

impl<'a> Recorder<'a, LogFile> {
    /// Starts a log file; it appears under its name when it is [finished](Self::finish).
    ///
    /// # Errors
    /// [`RecordError::Io`] where the file cannot be made, and those of [`to_writer`](Self::to_writer).
    pub fn create(path: &Path, header: &Header<'a, '_>) -> Result<Self, RecordError> {
        Self::to_writer(LogFile::create(path)?, header)
    }

    /// Ends the log and gives the file its name.
    ///
    /// # Errors
    /// [`RecordError::Io`]; nothing is left behind then.
    pub fn finish(self) -> Result<Summary, RecordError> {
        let (summary, file) = self.finish_into()?;
        file.complete()?;
        Ok(summary)
    }

    /// Ends the log before its time, which it says on `/log`: why, and how far it came.
    ///
    /// # Errors
    /// Those of [`finish`](Self::finish).
    pub fn finish_early(mut self, reason: &str) -> Result<Summary, RecordError> {
        self.tell_early_end(reason)?;
        self.finish()
    }
}

impl<'a, W: Write> Recorder<'a, W> {
    /// Starts a log on any writer: attachments, metadata and topics come first.
    ///
    /// # Errors
    /// [`RecordError::Io`] where writing fails, [`RecordError::NotFinite`] for an offset or a home pose that is not.
    pub fn to_writer(writer: W, header: &Header<'a, '_>) -> Result<Self, RecordError> {
        let not_finite = |what: &str| RecordError::NotFinite {
            what: what.to_owned(),
        };
        if !header.geometry.home.iter().all(is_finite) {
            return Err(not_finite("a home pose"));
        }
        let drawing = Drawing::new(header.mechanism, header.geometry, header.roles);
        let beside = [SIDE_BY_SIDE * drawing.extent, 0.0, 0.0];
        let offset = header.simulated_at.unwrap_or(beside);
        if !offset.iter().all(|x| x.is_finite()) {
            return Err(not_finite("the place of the simulated motion"));
        }
        let writer_name = concat!("kutzbach ", env!("CARGO_PKG_VERSION"));
        let options = WriteOptions::library(WriteOptions::new(), writer_name)
            .chunk_size(Some(CHUNK_SIZE))
            .compression(None)
            // A chunk is written when it is complete, and never touched again.
            .disable_seeking(true);
        let mut writer = options.create(NoSeek::new(writer))?;
        let attachments = [
            (
                header.source_name,
                media_type(header.source_name),
                Some(header.source),
            ),
            (
                "report.json",
                "application/json",
                header.report.map(str::as_bytes),
            ),
        ];
        for (name, media_type, data) in attachments {
            if let Some(data) = data {
                writer.attach(&attachment(name, media_type, data))?;
            }
        }
        writer.write_metadata(&Metadata {
            name: "mobility".to_owned(),
            metadata: header.facts.clone(),
        })?;
        let channels = Channels::new(&mut writer)?;
        Ok(Self {
            writer,
            channels,
            mechanism: header.mechanism,
            geometry: header.geometry,
            roles: header.roles.clone(),
            rods: scene::rods(header.mechanism, &header.geometry.sides),
            variables: variable_names(header.mechanism),
            offsets: [[0.0; 3], offset],
            drawing,
            shown: [false; 2],
            moments: 0,
            messages: 0,
            until: 0,
            buffer: Vec::new(),
        })
    }

    /// The shapes that the scene shows.
    #[must_use]
    pub fn drawing(&self) -> &Drawing {
        &self.drawing
    }

    /// Records the motions of one moment: frames, joint values, gaps. The first moment of a motion also brings its shapes
    /// into the scene.
    ///
    /// # Errors
    /// [`RecordError::Count`], [`RecordError::NotFinite`] and [`RecordError::Time`] for numbers that cannot be logged, before
    /// anything is written; [`RecordError::Io`] where writing fails.
    pub fn moment(
        &mut self,
        time: f64,
        predicted: Option<&Motion<'_>>,
        simulated: Option<&Motion<'_>>,
    ) -> Result<(), RecordError> {
        let at = nanoseconds(time)?;
        let motions = [predicted, simulated];
        for motion in motions.into_iter().flatten() {
            motion.check(self.mechanism)?;
        }
        let new = [0, 1].map(|i| motions[i].is_some() && !self.shown[i]);
        if new != [false; 2] {
            for (i, stream) in Stream::BOTH.into_iter().enumerate() {
                if new[i] {
                    self.describe(at, i, stream)?;
                }
            }
            for (shown, motion) in self.shown.iter_mut().zip(&motions) {
                *shown |= motion.is_some();
            }
            self.write_scene(at)?;
        }
        let mut transforms = Vec::new();
        let mut lines = Vec::new();
        for (i, stream) in Stream::BOTH.into_iter().enumerate() {
            let Some(motion) = motions[i] else { continue };
            self.transforms(at, i, stream, motion, &mut transforms);
            lines.push(scene::lines(
                self.mechanism,
                &self.drawing,
                &self.rods,
                &self.roles,
                stream,
                motion,
                at,
            ));
            if !motion.joints.is_empty() {
                let message = self.joint_states(at, motion);
                self.send(|channels| &mut channels.joint_states[i], at, &message)?;
            }
        }
        if !transforms.is_empty() {
            self.send(|c| &mut c.transforms, at, &FrameTransforms { transforms })?;
            self.send(|c| &mut c.gaps, at, &scene::update(lines))?;
        }
        self.moments += 1;
        if self.moments.is_multiple_of(MOMENTS_PER_CHUNK) {
            self.writer.flush()?;
        }
        Ok(())
    }

    /// Gives every frame a place before anything moves: both motions at one pose. Viewers that draw nothing until all frames have one
    /// then show the mechanism from the beginning.
    ///
    /// # Errors
    /// As [`moment`](Self::moment).
    pub fn rest(&mut self, time: f64, pose: &Motion<'_>) -> Result<(), RecordError> {
        let at = nanoseconds(time)?;
        pose.check(self.mechanism)?;
        let mut transforms = Vec::new();
        for (index, stream) in Stream::BOTH.into_iter().enumerate() {
            self.transforms(at, index, stream, pose, &mut transforms);
        }
        self.send(|c| &mut c.transforms, at, &FrameTransforms { transforms })
    }

    /// Shows links and joints in other roles from a moment on.
    ///
    /// # Errors
    /// [`RecordError::Time`], [`RecordError::Io`].
    pub fn set_roles(&mut self, time: f64, roles: &Roles) -> Result<(), RecordError> {
        let at = nanoseconds(time)?;
        if *roles != self.roles {
            self.roles = roles.clone();
            self.drawing = Drawing::new(self.mechanism, self.geometry, roles);
            if self.shown != [false; 2] {
                self.write_scene(at)?;
            }
        }
        Ok(())
    }

    /// Records how well the loops close.
    ///
    /// # Errors
    /// [`RecordError::Time`], [`RecordError::Io`]. Numbers that are not finite are allowed here: they are findings.
    pub fn closure(&mut self, time: f64, closure: &Closure) -> Result<(), RecordError> {
        let at = nanoseconds(time)?;
        self.send(|channels| &mut channels.closure, at, closure)
    }

    /// Records where the motion stands on its branch.
    ///
    /// # Errors
    /// [`RecordError::Time`], [`RecordError::Io`].
    pub fn prediction(&mut self, time: f64, prediction: &Prediction) -> Result<(), RecordError> {
        let at = nanoseconds(time)?;
        self.send(|channels| &mut channels.prediction, at, prediction)
    }

    /// Records how far the simulated motion is off at a moment, which may lie before the latest one: it is known when more runs have ended.
    ///
    /// # Errors
    /// [`RecordError::Time`], [`RecordError::Io`]. Numbers that are not finite are allowed here: they are findings.
    pub fn estimate(&mut self, time: f64, estimate: &Estimate) -> Result<(), RecordError> {
        let at = nanoseconds(time)?;
        self.send(|channels| &mut channels.error, at, estimate)
    }

    /// Records a sentence.
    ///
    /// # Errors
    /// [`RecordError::Time`], [`RecordError::Io`].
    pub fn log(&mut self, time: f64, level: Level, text: &str) -> Result<(), RecordError> {
        let at = nanoseconds(time)?;
        let level = match level {
            Level::Debug => 1,
            Level::Info => 2,
            Level::Warning => 3,
            Level::Error => 4,
        };
        let message = Log {
            timestamp: Some(stamp(at)),
            level,
            message: text.to_owned(),
            name: "kutzbach".to_owned(),
            file: String::new(),
            line: 0,
        };
        self.send(|channels| &mut channels.log, at, &message)
    }

    /// Attaches a file. Its times are zero: a log knows of no clock.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn attach(&mut self, name: &str, media_type: &str, data: &[u8]) -> Result<(), RecordError> {
        Ok(self.writer.attach(&attachment(name, media_type, data))?)
    }

    /// Adds a metadata record, such as what came out at the end.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn metadata(
        &mut self,
        name: &str,
        facts: &BTreeMap<String, String>,
    ) -> Result<(), RecordError> {
        Ok(self.writer.write_metadata(&Metadata {
            name: name.to_owned(),
            metadata: facts.clone(),
        })?)
    }

    /// Says on `/log` that the log ends before its time: why, and how far it came.
    ///
    /// # Errors
    /// [`RecordError::Io`].
    pub fn tell_early_end(&mut self, reason: &str) -> Result<(), RecordError> {
        let until = self.until as f64 * 1e-9;
        let text = format!(
            "stopped early: {reason}; {} moments recorded, up to {until} s",
            self.moments
        );
        self.log(until, Level::Warning, &text)
    }

    /// Ends the log and gives the writer back, flushed.
    ///
    /// # Errors
    /// [`RecordError::Io`] where writing fails.
    pub fn finish_into(mut self) -> Result<(Summary, W), RecordError> {
        let summary = Summary {
            moments: self.moments,
            messages: self.messages,
            until: self.until as f64 * 1e-9,
        };
        self.writer.finish()?;
        let mut writer = self.writer.into_inner().into_inner();
        writer.flush()?;
        Ok((summary, writer))
    }

    /// The frames of one stream: its root in the world, and every link in its parent of the file's tree, as
    /// `/robot_description` has it.
    fn transforms(
        &self,
        at: u64,
        index: usize,
        stream: Stream,
        motion: &Motion<'_>,
        transforms: &mut Vec<FrameTransform>,
    ) {
        let mut push = |parent: String, child: String, pose: &Rigid<f64>| {
            transforms.push(FrameTransform {
                timestamp: Some(stamp(at)),
                parent_frame_id: parent,
                child_frame_id: child,
                translation: Some(vector(pose.translation)),
                rotation: Some(rotation(pose)),
            });
        };
        let root = stream.word().to_owned();
        let offset = Rigid::translation(self.offsets[index]);
        push(WORLD.to_owned(), root.clone(), &offset);
        for (link, pose) in self.mechanism.links().iter().zip(motion.links) {
            let child = frame_id(stream, &link.name);
            let parent = match &link.placement {
                Placement::World => None,
                Placement::Joint(joint) => Some(self.mechanism.joint(*joint).predecessor.link),
                Placement::Floating { parent, .. } => Some(*parent),
            };
            match parent {
                None => push(root.clone(), child, pose),
                Some(parent) => {
                    let name = &self.mechanism.link(parent).name;
                    let relative = motion.links[parent.0].inverse().compose(pose);
                    push(frame_id(stream, name), child, &relative);
                }
            }
        }
    }

    fn joint_states(&self, at: u64, motion: &Motion<'_>) -> JointStates {
        let mut joints = Vec::new();
        for (joint, (names, values)) in self.variables.iter().zip(motion.joints).enumerate() {
            for (freedom, (name, value)) in names.iter().zip(values).enumerate() {
                let rate = motion.rates.get(joint).and_then(|rates| rates.get(freedom));
                joints.push(JointState {
                    name: name.clone(),
                    position: Some(*value + 0.0),
                    velocity: rate.map(|rate| *rate + 0.0),
                    acceleration: None,
                    effort: None,
                });
            }
        }
        JointStates {
            timestamp: Some(stamp(at)),
            joints,
        }
    }

    fn describe(&mut self, at: u64, index: usize, stream: Stream) -> Result<(), RecordError> {
        let text = robot_description(self.mechanism, self.geometry, &self.drawing, stream);
        let bytes = cdr_string(&text).ok_or(RecordError::TooLong {
            what: "the robot description",
        })?;
        self.put(|channels| &mut channels.descriptions[index], at, &bytes)
    }

    /// The whole scene, so that a viewer that starts here has everything.
    fn write_scene(&mut self, at: u64) -> Result<(), RecordError> {
        let ghost = self.shown == [true; 2] && self.offsets[0] == self.offsets[1];
        let mut entities = Vec::new();
        for (stream, shown) in Stream::BOTH.into_iter().zip(self.shown) {
            if shown {
                let opacity = match stream {
                    Stream::Predicted if ghost => scene::GHOST,
                    _ => 1.0,
                };
                entities.extend(scene::entities(
                    self.mechanism,
                    &self.drawing,
                    &self.roles,
                    stream,
                    opacity,
                    at,
                ));
            }
        }
        self.send(|channels| &mut channels.scene, at, &scene::update(entities))
    }

    fn send(
        &mut self,
        channel: impl FnOnce(&mut Channels) -> &mut Channel,
        at: u64,
        message: &impl Encode,
    ) -> Result<(), RecordError> {
        let mut buffer = std::mem::take(&mut self.buffer);
        buffer.clear();
        let written = message
            .encode(&mut buffer)
            .map_err(|error| RecordError::Container(error.to_string()))
            .and_then(|()| self.put(channel, at, &buffer));
        self.buffer = buffer;
        written
    }

    fn put(
        &mut self,
        channel: impl FnOnce(&mut Channels) -> &mut Channel,
        at: u64,
        data: &[u8],
    ) -> Result<(), RecordError> {
        let channel = channel(&mut self.channels);
        let header = MessageHeader {
            channel_id: channel.id,
            sequence: channel.sent,
            log_time: at,
            publish_time: at,
        };
        channel.sent = channel.sent.wrapping_add(1);
        self.writer.write_to_known_channel(&header, data)?;
        self.messages += 1;
        self.until = self.until.max(at);
        Ok(())
    }
}
