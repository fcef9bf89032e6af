"""One neutral description of a mechanism, from which every peer's model is built.

Reads the mechanism files of this repository: links, joints of the tree, joints that close loops, numbers as decimals
or expressions. All poses are those at home, in double precision.
"""

import ast
import math
import xml.etree.ElementTree as xml
from dataclasses import dataclass, field

import numpy as np

FUNCTIONS = {
    name: getattr(math, name) for name in ("sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "radians")
} | {"abs": abs}

OPERATORS = {
    ast.Add: lambda a, b: a + b,
    ast.Sub: lambda a, b: a - b,
    ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b,
    ast.Pow: lambda a, b: a**b,
}


class Unsupported(Exception):
    """A mechanism that this reader, or a peer, has no words for."""


def evaluate(node, names):
    """The value of an expression; only arithmetic, the functions above, and known names."""
    if isinstance(node, ast.Expression):
        return evaluate(node.body, names)
    if isinstance(node, ast.Constant) and isinstance(node.value, (int, float)):
        return float(node.value)
    if isinstance(node, ast.Name):
        return math.pi if node.id == "pi" else names[node.id]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.UAdd)):
        value = evaluate(node.operand, names)
        return -value if isinstance(node.op, ast.USub) else value
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATORS:
        return OPERATORS[type(node.op)](evaluate(node.left, names), evaluate(node.right, names))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in FUNCTIONS:
        return FUNCTIONS[node.func.id](*(evaluate(a, names) for a in node.args))
    raise Unsupported(f"expression {ast.dump(node)[:60]}")


def number(text, names):
    text = text.strip()
    if text[:2] in ("${", "$("):
        return evaluate(ast.parse(text[2:-1].strip(), mode="eval"), names)
    return float(text)


def numbers(text, names):
    """Numbers between blanks; blanks within braces belong to the expression."""
    parts, depth, part = [], 0, ""
    for c in text + " ":
        depth += c in "{("
        depth -= c in "})"
        if c.isspace() and depth == 0:
            parts += [part] if part else []
            part = ""
        else:
            part += c
    return np.array([number(p, names) for p in parts])


def unit(vector):
    vector = np.asarray(vector, float)
    return vector / np.linalg.norm(vector)


def frame_along(z):
    """A rotation whose third column is `z`."""
    z = unit(z)
    x = unit(np.cross(np.eye(3)[np.argmin(abs(z))], z))
    return np.column_stack([x, np.cross(z, x), z])


def pose(xyz=(0, 0, 0), rpy=(0, 0, 0)):
    """A 4 × 4 pose; `rpy` turns about x, then y, then z of the fixed frame."""
    (sr, sp, sy), (cr, cp, cy) = np.sin(rpy), np.cos(rpy)
    answer = np.eye(4)
    answer[:3, :3] = (
        np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
        @ np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
        @ np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    )
    answer[:3, 3] = xyz
    return answer


@dataclass
class Joint:
    """A joint between two links; its frame is given in both, its axes in world coordinates at home."""

    name: str
    kind: str
    a: str
    b: str
    in_a: np.ndarray
    in_b: np.ndarray
    closes: bool
    axis: np.ndarray = None
    axis2: np.ndarray = None
    lead: float = 0.0
    point: np.ndarray = None

    def chain(self):
        """The joint as a row of simple freedoms from `a` to `b`: turn, slide, screw (about or along a direction), ball."""
        u, w = self.axis, self.axis2
        across = lambda n: frame_along(n)[:, :2].T
        plane = lambda n: [("slide", across(n)[0]), ("slide", across(n)[1])]
        rows = {
            "fixed": lambda: [],
            "floating": lambda: [("slide", e) for e in np.eye(3)] + [("ball", None)],
            "revolute": lambda: [("turn", u)],
            "prismatic": lambda: [("slide", u)],
            "screw": lambda: [("screw", u)],
            "cylindrical": lambda: [("slide", u), ("turn", u)],
            "universal": lambda: [("turn", u), ("turn", w)],
            "planar": lambda: plane(u) + [("turn", u)],
            "spherical": lambda: [("ball", None)],
            "point_on_plane": lambda: plane(w) + [("ball", None)],
            "line_on_plane": lambda: [("turn", u)] + plane(w) + [("turn", w)],
        }
        if self.kind not in rows:
            raise Unsupported(f"joint type {self.kind}")
        return rows[self.kind]()

    def freedom_screws(self):
        """Columns (ω; v at the world's origin) of what `b` may do as seen from `a`, at home."""
        columns = []
        for kind, u in self.chain():
            if kind == "turn":
                columns.append(np.r_[u, np.cross(self.point, u)])
            elif kind == "slide":
                columns.append(np.r_[0, 0, 0, u])
            elif kind == "screw":
                columns.append(np.r_[u, np.cross(self.point, u) + self.lead / math.tau * u])
            else:
                columns += [np.r_[e, np.cross(self.point, e)] for e in np.eye(3)]
        return np.array(columns).reshape(-1, 6).T


@dataclass
class Mechanism:
    """Links by name with their poses at home, joints in the order of the file, the link at rest."""

    name: str
    links: dict = field(default_factory=dict)
    joints: list = field(default_factory=list)
    ground: str = ""

    def tree(self):
        """Pairs (joint, link that it places) outwards from the ground over joints that close nothing."""
        reached, rows, rest = {self.ground}, [], [j for j in self.joints if not j.closes]
        around = {}
        for j in rest:
            around.setdefault(j.a, []).append(j)
            around.setdefault(j.b, []).append(j)
        queue = [self.ground]
        for link in queue:
            for j in around.get(link, []):
                other = j.b if j.a == link else j.a
                if other not in reached:
                    reached.add(other)
                    rows.append((j, other))
                    queue.append(other)
        if len(reached) != len(self.links):
            raise Unsupported("links that no joint of the tree holds")
        return rows

    def chords(self):
        return [j for j in self.joints if j.closes]


def finish(mechanism):
    """Completes joints from link poses: axes and points in the world."""
    for j in mechanism.joints:
        at = mechanism.links[j.a] @ j.in_a
        there = mechanism.links[j.b] @ j.in_b
        j.point = at[:3, 3]
        j.axis = None if j.axis is None else at[:3, :3] @ unit(j.axis)
        j.axis2 = None if j.axis2 is None else there[:3, :3] @ unit(j.axis2)
    return mechanism


def read(path):
    """A mechanism file."""
    root = xml.parse(path).getroot()
    names = {}
    for element in root.iter():
        tag = element.tag.rsplit("}", 1)[-1]
        if tag == "property":
            names[element.get("name")] = number(f"${{{element.get('value').strip().removeprefix('${').removesuffix('}')}}}", names)
        elif tag == "arg":
            names[element.get("name")] = number(f"${{{element.get('default')}}}", names)
    if root.find("coupling") is not None or root.find("joint/mimic") is not None:
        raise Unsupported("couplings")

    def origin(element):
        found = None if element is None else element.find("origin")
        if found is None:
            return np.eye(4)
        return pose(numbers(found.get("xyz", "0 0 0"), names), numbers(found.get("rpy", "0 0 0"), names))

    def direction(element, tag):
        found = element.find(tag)
        return numbers(found.get("xyz"), names) if found is not None else np.array([1.0, 0, 0])

    def joint(element, a, b, in_a, in_b, closes):
        kind = {"continuous": "revolute", "plane_on_plane": "planar", "line_on_line": "cylindrical",
                "point_on_point": "spherical"}.get(element.get("type"), element.get("type"))
        screw = element.find("screw")
        return Joint(
            element.get("name"), kind, a, b, in_a, in_b, closes,
            axis=direction(element, "axis"), axis2=direction(element, "axis2"),
            lead=number(screw.get("lead"), names) if screw is not None else 0.0,
        )

    answer = Mechanism(root.get("name"))
    order = [link.get("name") for link in root.findall("link")]
    hung = {}
    for element in root.findall("joint"):
        parent, child = element.find("parent").get("link"), element.find("child").get("link")
        in_a, in_b = origin(element), origin(element.find("child"))
        hung[child] = (parent, in_a @ np.linalg.inv(in_b))
        answer.joints.append(joint(element, parent, child, in_a, in_b, False))
    for element in root.findall("loop"):
        p, s = element.find("predecessor"), element.find("successor")
        answer.joints.append(joint(element, p.get("link"), s.get("link"), origin(p), origin(s), True))

    def place(link):
        if link not in hung:
            return np.eye(4)
        parent, offset = hung[link]
        return place(parent) @ offset

    answer.links = {link: place(link) for link in order}
    ground = root.find("ground")
    answer.ground = ground.get("link") if ground is not None else next(l for l in order if l not in hung)
    return finish(answer)


def scissor_lift(stages, width=0.8, height=0.6):
    """The lift of `kutzbach::families::scissor_lift`: crossed bars between a rail and a platform."""
    answer = Mechanism(f"scissor_lift_{stages}", ground="ground")
    w, h = width, height
    z, x = np.array([0.0, 0, 1]), np.array([1.0, 0, 0])
    answer.links["ground"] = np.eye(4)

    def hang(name, kind, parent, child, offset=(0, 0, 0)):
        answer.links[child] = answer.links[parent] @ pose(offset)
        answer.joints.append(Joint(name, kind, parent, child, pose(offset), np.eye(4), False,
                                   axis=z if kind == "revolute" else x))

    def close(name, a, b, in_a=(0, 0, 0), in_b=(0, 0, 0)):
        answer.joints.append(Joint(name, "revolute", a, b, pose(in_a), pose(in_b), True, axis=z))

    hang("lower_slide", "prismatic", "ground", "lower_slider", (2 * w, 0, 0))
    for i in range(stages):
        if i == 0:
            hang("lower_pin", "revolute", "ground", "rising_0")
        else:
            hang(f"left_{i}", "revolute", f"falling_{i - 1}", f"rising_{i}", (-w, h, 0))
        hang(f"cross_{i}", "revolute", f"rising_{i}", f"falling_{i}", (w, h, 0))
        if i == 0:
            close("lower_slider_pin", "lower_slider", "falling_0", in_b=(w, -h, 0))
        else:
            close(f"right_{i}", f"rising_{i - 1}", f"falling_{i}", (2 * w, 2 * h, 0), (w, -h, 0))
    top = stages - 1
    hang("upper_pin", "revolute", f"falling_{top}", "platform", (-w, h, 0))
    hang("upper_slide", "prismatic", "platform", "upper_slider", (2 * w, 0, 0))
    close("upper_slider_pin", f"rising_{top}", "upper_slider", (2 * w, 2 * h, 0))
    return finish(answer)


def text(v):
    return " ".join(format(c, ".17g") for c in v)


def write_urdf(mechanism):
    """The file of a mechanism whose frames are all parallel to the world's, such as the lift."""
    rows = ['<?xml version="1.0"?>', f'<robot name="{mechanism.name}">']
    rows += [f'  <link name="{link}"/>' for link in mechanism.links]
    decimal = lambda m: " ".join(f"{c:.2f}" for c in m[:3, 3])
    axis = lambda j: " ".join(str(int(c)) for c in j.axis)
    for j in mechanism.joints:
        if j.closes:
            rows.append(
                f'  <loop name="{j.name}" type="{j.kind}"><predecessor link="{j.a}"><origin xyz="{decimal(j.in_a)}"/></predecessor>'
                f'<successor link="{j.b}"><origin xyz="{decimal(j.in_b)}"/></successor><axis xyz="{axis(j)}"/></loop>'
            )
        else:
            rows.append(
                f'  <joint name="{j.name}" type="{j.kind}"><parent link="{j.a}"/><child link="{j.b}"/>'
                f'<origin xyz="{decimal(j.in_a)}"/><axis xyz="{axis(j)}"/></joint>'
            )
    return "\n".join(rows + ["</robot>", ""])


def rates_of_one_turn(mechanism, crank):
    """World twists (ω; v of the link's origin) of all links where joint `crank` turns at 1 rad/s, for one freedom.

    From the null space of the equations of relative motion at home.
    """
    links = [l for l in mechanism.links if l != mechanism.ground]
    place = {l: 6 * i for i, l in enumerate(links)}
    rows, wanted = [], []
    for j in mechanism.joints:
        free = j.freedom_screws()
        full = np.linalg.svd(free, full_matrices=True)[0]
        for across in full[:, free.shape[1]:].T:
            row = np.zeros(6 * len(links))
            if j.b in place:
                row[place[j.b]:place[j.b] + 6] += across
            if j.a in place:
                row[place[j.a]:place[j.a] + 6] -= across
            rows.append(row)
            wanted.append(0.0)
    driven = next(j for j in mechanism.joints if j.name == crank)
    row = np.zeros(6 * len(links))
    row[place[driven.b]:place[driven.b] + 3] = driven.axis
    rows.append(row)
    wanted.append(1.0)
    answer = np.linalg.lstsq(np.array(rows), np.array(wanted), rcond=None)[0]
    twists = {mechanism.ground: (np.zeros(3), np.zeros(3))}
    for l in links:
        w, v = answer[place[l]:place[l] + 3], answer[place[l] + 3:place[l] + 6]
        twists[l] = (w, v + np.cross(w, mechanism.links[l][:3, 3]))
    return twists


def closure_error(mechanism, rotations, positions, length):
    """The largest gap of any hinge in any of the poses: distance over `length`, or the angle between its axes.

    `rotations[link]` is an array n × 3 × 3, `positions[link]` n × 3. The same figures for every tool.
    """
    worst = 0.0
    for j in mechanism.joints:
        ends = []
        for link, inside in ((j.a, j.in_a), (j.b, j.in_b)):
            axis = mechanism.links[link][:3, :3].T @ j.axis
            at = np.einsum("nij,j->ni", rotations[link], inside[:3, 3]) + positions[link]
            ends.append((at, np.einsum("nij,j->ni", rotations[link], axis)))
        gap = np.linalg.norm(ends[0][0] - ends[1][0], axis=1).max() / length
        tilt = np.arcsin(np.minimum(1, np.linalg.norm(np.cross(ends[0][1], ends[1][1]), axis=1))).max()
        worst = max(worst, gap, tilt)
    return float(worst)


def rotations_of(quaternions):
    """Arrays n × 4 (w x y z) to n × 3 × 3."""
    q = quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)
    w, x, y, z = q.T
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]).transpose(2, 0, 1)
