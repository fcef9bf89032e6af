"""A robot's description as joints, loops and linear equations: a reader of its own, for checking the program's.

Read are URDF and URDF+ (`loop`, `coupling`), `loop_joint`, `mimic`, and links and joints inside `gazebo` elements. It is made to be
short and independent, not to be complete: what it does not know is an error, and such a file is not compared.
"""

import math
import xml.etree.ElementTree as xml
from dataclasses import dataclass, field

import numpy as np


@dataclass
class Joint:
    """`displacement` runs from the frame on link `a` to the frame on link `b`; `freedoms` are (kind, axis, pitch)."""

    name: str
    a: str
    b: str
    frame_a: np.ndarray
    frame_b: np.ndarray
    freedoms: list


@dataclass
class Description:
    links: list = field(default_factory=list)
    tree: list = field(default_factory=list)
    loops: list = field(default_factory=list)
    # {joint: factor} of rates, and the offset of positions.
    equations: list = field(default_factory=list)


def rotation(axis, angle):
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k


def frame(xyz=(0, 0, 0), rpy=(0, 0, 0)):
    found = np.eye(4)
    found[:3, :3] = rotation([0, 0, 1], rpy[2]) @ rotation([0, 1, 0], rpy[1]) @ rotation([1, 0, 0], rpy[0])
    found[:3, 3] = xyz
    return found


def numbers(text, count=3):
    found = [float(word) for word in text.split()]
    if len(found) != count:
        raise ValueError(f"needed {count} numbers, found {text!r}")
    return found


def origin(element):
    if element is None:
        return np.eye(4)
    return frame(numbers(element.get("xyz", "0 0 0")), numbers(element.get("rpy", "0 0 0")))


def freedoms(kind, axis, lead=0.0):
    axis = np.asarray([1, 0, 0] if axis is None else axis, float)
    across = np.cross(axis, [1, 0, 0] if abs(axis[0]) < 0.9 * np.linalg.norm(axis) else [0, 1, 0])
    unit = np.eye(3)
    return {
        "fixed": lambda: [],
        "revolute": lambda: [("R", axis, 0)],
        "continuous": lambda: [("R", axis, 0)],
        "prismatic": lambda: [("P", axis, 0)],
        "screw": lambda: [("R", axis, lead / (2 * math.pi))],
        "cylindrical": lambda: [("P", axis, 0), ("R", axis, 0)],
        "spherical": lambda: [("R", e, 0) for e in unit],
        "ball": lambda: [("R", e, 0) for e in unit],
        "planar": lambda: [("P", across, 0), ("P", np.cross(axis, across), 0), ("R", axis, 0)],
        "floating": lambda: [("P", e, 0) for e in unit] + [("R", e, 0) for e in unit],
    }[kind]()


def axis_of(element):
    axis = element.find("axis")
    return [1, 0, 0] if axis is None or axis.get("xyz") is None else numbers(axis.get("xyz"))


def read(text):
    root = xml.fromstring(text)
    robot = Description(links=[link.get("name") for link in root if link.tag == "link"])
    mimics, couplings, inside_gazebo, links_of_gazebo = [], [], [], []
    placed = set()
    for element in root:
        if element.tag == "joint":
            kind = element.get("type")
            moves = freedoms(kind, [1, 0, 0] if kind in ("fixed", "floating") else axis_of(element))
            child = element.find("child").get("link")
            joint = Joint(
                element.get("name"), element.find("parent").get("link"), child, origin(element.find("origin")), np.eye(4), moves
            )
            (robot.loops if child in placed else robot.tree).append(joint)
            placed.add(child)
            if element.find("mimic") is not None and kind != "fixed":
                mimics.append((joint.name, element.find("mimic")))
        elif element.tag == "loop":
            sides = [element.find(side) for side in ("predecessor", "successor")]
            robot.loops.append(
                Joint(
                    element.get("name"),
                    *[side.get("link") for side in sides],
                    *[origin(side.find("origin")) for side in sides],
                    freedoms(element.get("type"), axis_of(element)),
                )
            )
        elif element.tag == "loop_joint":
            sides = [element.find(side) for side in ("link1", "link2")]
            robot.loops.append(
                Joint(
                    element.get("name"),
                    *[side.get("link") for side in sides],
                    *[origin(side) for side in sides],
                    freedoms(element.get("type"), axis_of(element)),
                )
            )
        elif element.tag == "coupling":
            couplings.append(element)
        elif element.tag == "gazebo":
            inside_gazebo += [inner for inner in element if kind_of(inner) in OLD_KINDS or inner.tag == "joint"]
            links_of_gazebo += element.findall("link")
    of_link = {joint.b: joint for joint in robot.tree}

    def path(link):
        found = []
        while link in of_link:
            found.append(of_link[link])
            link = of_link[link].a
        return found[::-1]

    for name, mimic in mimics:
        factors = {name: 1.0}
        leader = mimic.get("joint")
        factors[leader] = factors.get(leader, 0.0) - float(mimic.get("multiplier", 1))
        robot.equations.append((factors, float(mimic.get("offset", 0))))
    for element in couplings:
        before, after = (path(element.find(side).get("link")) for side in ("predecessor", "successor"))
        while before and after and before[0] is after[0]:
            before, after = before[1:], after[1:]
        ratio = float(element.find("ratio").get("value"))
        factors = {joint.name: -ratio for joint in before}
        factors.update({joint.name: 1.0 for joint in after})
        robot.equations.append((factors, 0.0))
    if links_of_gazebo:
        base = next(link for link in robot.links if link not in placed)
    for link in links_of_gazebo:
        name, at = link.get("name"), frame(*np.split(np.array(numbers(link.find("pose").text, 6)), 2))
        of_link[name] = Joint(f"place of {name}", base, name, at, np.eye(4), freedoms("floating", None))
        robot.tree.append(of_link[name])
        robot.links.append(name)
    for element in inside_gazebo:
        joint = (gazebo_joint if element.tag == "joint" else old_gazebo_joint)(drawn(path), element)
        if joint.name in {other.name for other in robot.tree}:
            # Two joints of one name are one to a controller.
            joint.name, name = f"{joint.name} in gazebo", joint.name
            robot.equations.append(({joint.name: 1.0, name: -1.0}, 0.0))
        robot.loops.append(joint)
    return robot


def drawn(path):
    """Where a link is drawn, in the frame of the base."""

    def pose(link):
        found = np.eye(4)
        for joint in path(link):
            found = found @ joint.frame_a
        return found

    return pose


OLD_KINDS = {"hinge": "revolute", "slider": "prismatic", "ball": "ball"}


def kind_of(element):
    """`hinge` of `joint:hinge`."""
    return element.tag.split("}")[-1]


def old_gazebo_joint(pose, element):
    """Gazebo before SDFormat: the joint is at an offset from its anchor body, along the axes of the world."""
    names = [element.find(side).text.strip() for side in ("body1", "body2")]
    at = pose(element.find("anchor").text.strip()).copy()
    offset = element.find("anchorOffset")
    at = at @ frame(numbers(offset.text, 3), [0, 0, 0]) if offset is not None else at
    sides = [np.linalg.inv(pose(name)) @ at for name in names]
    return Joint(element.get("name"), *names, *sides, freedoms(OLD_KINDS[kind_of(element)], numbers(element.find("axis").text, 3)))


def gazebo_joint(pose_of, element):
    """SDFormat: the pose of a joint is given in its child; the side on the parent follows from how the links are drawn."""
    names = [element.find(side).text.strip() for side in ("parent", "child")]
    pose = element.find("pose")
    on_child = frame(*np.split(np.array(numbers(pose.text, 6)), 2)) if pose is not None else np.eye(4)

    on_parent = np.linalg.inv(pose_of(names[0])) @ pose_of(names[1]) @ on_child
    axis = element.find("axis")
    along = numbers(axis.find("xyz").text) if axis is not None and axis.find("xyz") is not None else [0, 0, 1]
    lead = 0.0
    if element.find("thread_pitch") is not None:
        lead = -2 * math.pi / float(element.find("thread_pitch").text)
    return Joint(element.get("name"), *names, on_parent, on_child, freedoms(element.get("type"), along, lead))
