//! The topics of a log and their schemas.

use super::error::RecordError;
use super::messages::{Closure, Estimate, Prediction};
use super::names::Stream;
use foxglove::Encode;
use foxglove::messages::{FrameTransforms, JointStates, Log, SceneUpdate};
use mcap::write::NoSeek;
use std::collections::BTreeMap;
use std::io::Write;

/// A topic of the log.
#[derive(Clone, Copy, Debug)]
pub struct Channel {
    /// Its number in the log.
    pub id: u16,
    /// Messages sent.
    pub sent: u32,
}

/// All topics.
#[derive(Debug)]
pub struct Channels {
    pub transforms: Channel,
    pub scene: Channel,
    pub gaps: Channel,
    pub closure: Channel,
    pub prediction: Channel,
    pub error: Channel,
    pub log: Channel,
    /// By stream.
    pub joint_states: [Channel; 2],
    pub descriptions: [Channel; 2],
}

impl Channels {
    /// Adds all topics to a log that has none.
    pub fn new<W: Write>(writer: &mut mcap::Writer<NoSeek<W>>) -> Result<Self, RecordError> {
        let both = |name: &str, add: &mut dyn FnMut(&str) -> Result<Channel, RecordError>| {
            let [predicted, simulated] = Stream::BOTH.map(|stream| stream.topic(name));
            Ok::<_, RecordError>([add(&predicted)?, add(&simulated)?])
        };
        Ok(Self {
            transforms: typed::<FrameTransforms, W>(writer, "/tf")?,
            scene: typed::<SceneUpdate, W>(writer, "/scene")?,
            gaps: typed::<SceneUpdate, W>(writer, "/scene/gaps")?,
            closure: typed::<Closure, W>(writer, "/mobility/closure")?,
            prediction: typed::<Prediction, W>(writer, "/mobility/prediction")?,
            error: typed::<Estimate, W>(writer, "/mobility/error")?,
            log: typed::<Log, W>(writer, "/log")?,
            joint_states: both("joint_states", &mut |topic| {
                typed::<JointStates, W>(writer, topic)
            })?,
            descriptions: both("robot_description", &mut |topic| {
                let schema =
                    writer.add_schema("std_msgs/msg/String", "ros2msg", b"string data\n")?;
                add_channel(writer, schema, topic, "cdr")
            })?,
        })
    }
}

/// A topic for messages of one type.
fn typed<T: Encode, W: Write>(
    writer: &mut mcap::Writer<NoSeek<W>>,
    topic: &str,
) -> Result<Channel, RecordError> {
    let schema = match T::get_schema() {
        Some(schema) => writer.add_schema(&schema.name, &schema.encoding, &schema.data)?,
        None => 0,
    };
    add_channel(writer, schema, topic, &T::get_message_encoding())
}

fn add_channel<W: Write>(
    writer: &mut mcap::Writer<NoSeek<W>>,
    schema: u16,
    topic: &str,
    encoding: &str,
) -> Result<Channel, RecordError> {
    let id = writer.add_channel(schema, topic, encoding, &BTreeMap::new())?;
    Ok(Channel { id, sent: 0 })
}
