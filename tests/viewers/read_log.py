#!/usr/bin/env python3
"""Reads a log with the Python packages `mcap` and `mcap-protobuf-support` and prints what it holds as JSON.

    python read_log.py LOG.mcap

Keys of the answer:
    topics        {topic: {schema, schema_encoding, message_encoding, messages}}
    schemas       [name]
    poses         [{time, stream, links: {link: {translation: [x, y, z], rotation: [x, y, z, w]}}}], in the world of the
                  stream: chained up from every link to the root frame `predicted` or `simulated`
    offsets       {stream: [x, y, z]}: where the root frames stand in `world`
    joint_states  [{time, topic, joints: {name: [position, velocity]}}]
    closure, prediction, log
                  [{time, ...fields as in the message}]
    scene         [{time, entities: {id: {frame, shapes, centres}}}]
    gaps          [{time, stream, segments: [[from, to]]}]
    descriptions  {topic: URDF}
    attachments   {name: {media_type, size, crc, text}}
    metadata      {record: {key: value}}
    times         {first, last}: nanoseconds
"""

import json
import sys
from pathlib import Path

from google.protobuf.json_format import MessageToDict
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

STREAMS = ("predicted", "simulated")


def multiply(a, b):
    """Product of two quaternions (x, y, z, w)."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def rotate(q, v):
    """A vector turned by a unit quaternion."""
    x, y, z, _ = multiply(multiply(q, (*v, 0.0)), (-q[0], -q[1], -q[2], q[3]))
    return (x, y, z)


def compose(a, b):
    """Pose `a_from_c` of poses `a_from_b` and `b_from_c`; a pose is (translation, quaternion)."""
    turned = rotate(a[1], b[0])
    return (tuple(p + q for p, q in zip(a[0], turned)), multiply(a[1], b[1]))


def xyz(message):
    return (message.x, message.y, message.z)


def quaternion(message):
    return (message.x, message.y, message.z, message.w)


def poses_of(message):
    """The link poses of one FrameTransforms message by stream, and the places of the streams' roots."""
    parents = {}
    for transform in message.transforms:
        pose = (xyz(transform.translation), quaternion(transform.rotation))
        assert transform.child_frame_id not in parents, "a frame with two parents"
        parents[transform.child_frame_id] = (transform.parent_frame_id, pose)
    in_stream = {stream: ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)) for stream in STREAMS}

    def pose_of(frame):
        way = []
        while frame not in in_stream:
            way.append(frame)
            frame = parents[frame][0]
        for step in reversed(way):
            in_stream[step] = compose(in_stream[frame], parents[step][1])
            frame = step
        return in_stream[frame]

    poses, offsets = {}, {}
    for frame, (parent, pose) in parents.items():
        if frame in STREAMS:
            assert parent == "world", parent
            offsets[frame] = pose[0]
            continue
        stream, link = frame.split("/", 1)
        translation, rotation = pose_of(frame)
        found = {"translation": translation, "rotation": rotation}
        poses.setdefault(stream, {})[link] = found
    return poses, offsets


def string_of_cdr(data):
    """The text of a std_msgs/msg/String in little-endian CDR."""
    assert data[:4] == b"\x00\x01\x00\x00", data[:4]
    length = int.from_bytes(data[4:8], "little")
    assert len(data) == 8 + length and data[-1] == 0
    return data[8:-1].decode()


def segments_of(entity):
    pairs = []
    for line in entity.lines:
        points = [xyz(point) for point in line.points]
        pairs.extend(zip(points[0::2], points[1::2]))
    return pairs


def read(path):
    answer = {
        "topics": {},
        "schemas": [],
        "poses": [],
        "offsets": {},
        "joint_states": [],
        "closure": [],
        "prediction": [],
        "log": [],
        "scene": [],
        "gaps": [],
        "descriptions": {},
        "attachments": {},
        "metadata": {},
        "times": {},
    }
    with open(path, "rb") as stream:
        reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
        summary = reader.get_summary()
        assert summary is not None and summary.statistics is not None, "the log has no summary"
        counts = summary.statistics.channel_message_counts
        answer["schemas"] = sorted(schema.name for schema in summary.schemas.values())
        for channel in summary.channels.values():
            schema = summary.schemas[channel.schema_id]
            answer["topics"][channel.topic] = {
                "schema": schema.name,
                "schema_encoding": schema.encoding,
                "message_encoding": channel.message_encoding,
                "messages": counts.get(channel.id, 0),
            }
        answer["times"] = {
            "first": summary.statistics.message_start_time,
            "last": summary.statistics.message_end_time,
        }
        for attachment in reader.iter_attachments():
            answer["attachments"][attachment.name] = {
                "media_type": attachment.media_type,
                "size": len(attachment.data),
                "log_time": attachment.log_time,
                "create_time": attachment.create_time,
                "text": attachment.data.decode("utf-8", "replace"),
            }
        for record in reader.iter_metadata():
            answer["metadata"][record.name] = dict(record.metadata)

    with open(path, "rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        factory = DecoderFactory()
        for schema, channel, message in reader.iter_messages():
            time = message.log_time * 1e-9
            if channel.message_encoding == "cdr":
                answer["descriptions"][channel.topic] = string_of_cdr(message.data)
                continue
            decoded = factory.decoder_for(channel.message_encoding, schema)(message.data)
            if channel.topic == "/tf":
                poses, offsets = poses_of(decoded)
                answer["offsets"].update(offsets)
                for name, links in poses.items():
                    answer["poses"].append({"time": time, "stream": name, "links": links})
            elif schema.name == "foxglove.JointStates":
                joints = {
                    joint.name: [joint.position, joint.velocity if joint.HasField("velocity") else None]
                    for joint in decoded.joints
                }
                assert len(joints) == len(decoded.joints), "two joints of one name"
                answer["joint_states"].append(
                    {"time": time, "topic": channel.topic, "joints": joints}
                )
            elif channel.topic == "/scene/gaps":
                for entity in decoded.entities:
                    name = entity.id.split("/", 1)[0]
                    answer["gaps"].append(
                        {"time": time, "stream": name, "segments": segments_of(entity)}
                    )
            elif channel.topic == "/scene":
                entities = {}
                for entity in decoded.entities:
                    solids = [*entity.arrows, *entity.cubes, *entity.spheres, *entity.cylinders]
                    assert entity.id not in entities, "two entities of one name"
                    entities[entity.id] = {
                        "frame": entity.frame_id,
                        "shapes": len(solids) + len(entity.lines) + len(entity.texts),
                        "centres": [xyz(solid.pose.position) for solid in solids],
                    }
                answer["scene"].append({"time": time, "entities": entities})
            else:
                key = channel.topic.rsplit("/", 1)[-1]
                fields = MessageToDict(
                    decoded,
                    preserving_proto_field_name=True,
                    always_print_fields_with_no_presence=True,
                )
                answer[key].append({"time": time, **fields})
    return answer


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    json.dump(read(Path(sys.argv[1])), sys.stdout)
