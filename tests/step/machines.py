"""Ten mechanisms as solids, each tight and with room, as STEP assemblies.

    python3 -m venv solids && solids/bin/pip install build123d==0.13.0
    solids/bin/python tests/step/machines.py [FOLDER] [NAME ...]

Writes FOLDER/NAME_tight.step, FOLDER/NAME_room.step (FOLDER: tests/step/machines) and four_bar_askew.step. Lengths are millimetres. `room` is what a hole is larger
than its shaft all around, and a groove than its tongue on each side. With room there are bolts where a designer would have some, and
holes whose cylinders come as two halves. What joints each file has to show is in tests/step_machines.rs.
"""

import copy
import re
import sys
from math import atan2, degrees, hypot
from pathlib import Path

from build123d import Box, Compound, Cylinder, Location, Plane, Polyline, Pos, Rot, SkipClean, export_step, extrude, make_face
from build123d import Unit


def box(x, y, z):
    """A block between two corners, each axis given as (from, to)."""
    size = [b - a for a, b in (x, y, z)]
    return Pos(*[(a + b) / 2 for a, b in (x, y, z)]) * Box(*size)


def rod(radius, along, at=(0, 0), axis="z"):
    """A cylinder along an axis, from and to given by `along`, its centre at `at` in the other two coordinates (in the order x, y, z)."""
    low, high = along
    cylinder = Cylinder(radius, high - low)
    middle = (low + high) / 2
    if axis == "z":
        return Pos(at[0], at[1], middle) * cylinder
    if axis == "y":
        return Pos(at[0], middle, at[1]) * Rot(90, 0, 0) * cylinder
    return Pos(middle, at[0], at[1]) * Rot(0, 90, 0) * cylinder


def prism(corners, along, plane=Plane.XY):
    """A polygon of a plane, from and to along its normal."""
    low, high = along
    face = make_face(Polyline(*corners, close=True))
    return plane * Pos(0, 0, low) * extrude(face, high - low)


class Drill:
    """Makes holes: whole cylinders, or such whose face comes as two halves."""

    def __init__(self, room, halves):
        self.room, self.halves = room, halves

    def __call__(self, part, radius, along, at=(0, 0), axis="z"):
        tool = rod(radius + self.room, along, at, axis)
        if not self.halves:
            return part - tool
        big = 1000
        other = {"z": (0, 1), "y": (0, 2), "x": (1, 2)}[axis]
        spans = [(-big, big)] * 3
        for side in ((at[0] - big, at[0]), (at[0], at[0] + big)):
            spans[other[0]] = side
            half = tool & box(*spans)
            with SkipClean():
                part = part - half
        return part


def bar(drill, start, end, layer, radius, width=12, holes=(True, True)):
    """A bar between two points of the plane, with a hole of that radius at each end; and where it goes in the assembly."""
    length = hypot(end[0] - start[0], end[1] - start[1])
    part = box((-width / 2, length + width / 2), (-width / 2, width / 2), layer)
    for place, wanted in zip((0, length), holes):
        if wanted:
            part = drill(part, radius, layer, (place, 0))
    angle = degrees(atan2(end[1] - start[1], end[0] - start[0]))
    return part, Location((start[0], start[1], 0), (0, 0, angle))


class Machine:
    def __init__(self):
        self.children = []

    def add(self, name, shape, at=Location()):
        """A part; the same shape again at another place is a further occurrence of one product."""
        child = copy.copy(shape)
        child.label = name
        child.location = at * shape.location
        self.children.append(child)


def bolt(radius, depth, head=None):
    """A bolt whose head stands on z = 0 and whose shaft goes down."""
    head = head or 1.8 * radius
    return rod(radius, (-depth, 0)) + rod(head, (0, 1.2 * radius))


def four_bar(room, bolted=True):
    """A bar on the ground, crank, coupler, rocker, and four headed pins; with room the lowest bar is bolted to a plate."""
    machine, drill = Machine(), Drill(room, room > 0)
    a, b, c, d = (0, 0), (0, 30), (64, 78), (80, 0)
    for name, start, end, layer in (
        ("ground bar", a, d, (0, 5)),
        ("crank", a, b, (5, 10)),
        ("rocker", d, c, (5, 10)),
        ("coupler", b, c, (10, 15)),
    ):
        part, at = bar(drill, start, end, layer, 3)
        if name == "ground bar" and room and bolted:
            part = part + box((-46, -6), (-10, 10), layer)
            for y in (-5, 5):
                part = Drill(room, False)(part, 2.5, (-1, 6), (-30, y))
        machine.add(name, part, at)
    low = rod(3, (0, 9.5)) + rod(4.5, (-3, 0))
    high = rod(3, (-9.5, 0)) + rod(4.5, (0, 3))
    machine.add("pin", low, Pos(*a))
    machine.add("pin", low, Pos(*d))
    machine.add("cap pin", high, Pos(*b, 15))
    machine.add("cap pin", high, Pos(*c, 15))
    if room and bolted:
        screw, plate = bolt(2.5, 12), box((-60, -14), (-20, 20), (-12, 0))
        for y in (-5, 5):
            plate = Drill(room, False)(plate, 2.5, (-9, 1), (-30, y))
            machine.add("M5x12 bolt", screw, Pos(-30, y, 5))
        machine.add("table plate", plate)
    return machine


def slider_crank(room):
    """Studs with shoulders instead of pins, a slider in a channel; with room a cover is bolted on the channel."""
    machine, drill = Machine(), Drill(room, room > 0)
    base = box((-25, 130), (-25, 25), (-8, 0)) + rod(4, (0, 6))
    base += box((60, 130), (10, 25), (0, 18)) + box((60, 130), (-25, -10), (0, 18))
    crank, at_crank = bar(drill, (0, 0), (0, 30), (0, 6), 4, 16, (True, False))
    crank += rod(3, (6, 12), (30, 0))
    bore = Drill(room, False)
    if room:
        for x, y in ((70, -18), (120, 18)):
            base = bore(base, 2, (6, 20), (x, y))
    machine.add("base", base)
    machine.add("crank", crank, at_crank)
    rod_part, at_rod = bar(drill, (0, 30), (72, 0), (6, 12), 3, 10)
    machine.add("connecting rod", rod_part, at_rod)
    slider = box((-4, 40), (-10 + room, 10 - room), (0, 6)) + box((8, 40), (-10 + room, 10 - room), (6, 18 - room))
    slider += rod(3, (6, 12))
    machine.add("slider", slider, Pos(72, 0, 0))
    if room:
        cover = box((60, 130), (-25, 25), (18, 22))
        screw = bolt(2, 12)
        for x, y in ((70, -18), (120, 18)):
            cover = bore(cover, 2, (17, 23), (x, y))
            machine.add("ISO 4762 M4x12", screw, Pos(x, y, 22))
        machine.add("cover", cover)
    return machine


def oldham(room):
    """Two hubs with shafts that are 3 mm apart and a disc with two tongues; with room one bearing has a cap with two bolts."""
    machine, drill = Machine(), Drill(room, False)
    frame = box((-30, 60), (-40, 40), (-40, -32))
    caps = []
    for x, y in (((-20, 0), 0), ((28, 48), 3)):
        block = box(x, (y - 22, y + 22), (-32, 16))
        block = drill(block, 6, (x[0] - 1, x[1] + 1), (y, 0), "x")
        if not room or y:
            frame += block
            continue
        middle = (x[0] + x[1]) / 2
        for side in (-15, 15):
            block = drill(block, 2.5, (-12, 17), (middle, y + side))
        lower = block & box((-100, 100), (-100, 100), (-100, 0))
        caps.append((block & box((-100, 100), (-100, 100), (0, 100)), [(middle, y + s) for s in (-15, 15)]))
        frame += lower
    machine.add("frame", frame)
    first = rod(20, (0, 10), (0, 0), "x") + rod(6, (-30, 0), (0, 0), "x")
    first -= box((6, 11), (-30, 30), (-4 - room, 4 + room))
    second = rod(20, (18, 28), (3, 0), "x") + rod(6, (28, 58), (3, 0), "x")
    second -= box((17, 22), (3 - 4 - room, 3 + 4 + room), (-30, 30))
    disc = rod(20, (10, 18), (3, 0), "x")
    disc += box((6 + room, 10), (-12, 18), (-4, 4)) + box((18, 22 - room), (3 - 4, 3 + 4), (-15, 15))
    machine.add("driving hub", first)
    machine.add("driven hub", second)
    machine.add("floating disc", disc)
    screw = bolt(2.5, 22)
    for cap, places in caps:
        machine.add("bearing cap", cap)
        for x, y in places:
            machine.add("bolt M5", screw, Pos(x, y, 16))
    return machine


def sarrus(room):
    """Two legs of two plates each, at right angles; trunnions with shoulders in lugs, whose holes are halves with room."""
    machine, drill = Machine(), Drill(room, room > 0)
    base = box((-20, 36), (-20, 36), (-5, 0))
    # Two lugs of each hinge, from the plate's face to above the axis: along y at x = 30, along x at y = 30.
    for side in ((6, 12), (-12, -6)):
        base += box((25, 35), side, (0, 13)) + box(side, (25, 35), (0, 13))
    base = drill(drill(base, 2, (-13, 13), (30, 8), "y"), 2, (-13, 13), (30, 8), "x")
    machine.add("base plate", base)
    # Turned over about the line x = y the same part is the platform, 52 higher.
    machine.add("base plate", base, Location(Plane((0, 0, 52), x_dir=(0, 1, 0), z_dir=(0, 0, -1))))
    # A plate lies along x with its hinges along y, 30 apart.
    eye = rod(4, (-6, 6), (0, 0), "y") + rod(2, (-12, 12), (0, 0), "y")
    lower = eye + box((0, 22), (-6, 6), (-2, 2))
    fork = box((18, 22), (-12, 12), (-2, 2))
    for y in ((6, 12), (-12, -6)):
        fork += box((22, 34), y, (-4, 4))
    lower = drill(lower + fork, 2, (-13, 13), (30, 0), "y")
    upper = eye + box((0, 30), (-6, 6), (-2, 2)) + Pos(30, 0, 0) * eye
    # 3-4-5: outwards and up, then back.
    machine.add("lower plate", lower, Location((30, 0, 8), (0, -degrees(atan2(18, 24)), 0)))
    machine.add("upper plate", upper, Location((54, 0, 26), (0, -degrees(atan2(18, -24)), 0)))
    turn = Location((0, 0, 0), (0, 0, 90))
    machine.add("lower plate", lower, turn * Location((30, 0, 8), (0, -degrees(atan2(18, 24)), 0)))
    machine.add("upper plate", upper, turn * Location((54, 0, 26), (0, -degrees(atan2(18, -24)), 0)))
    return machine


def scissor(room):
    """One stage with plain pins, two blocks in grooves; drawn in a plane that stands upright."""
    machine, drill = Machine(), Drill(room, False)
    a, b, c, d = (0, 0), (72, 0), (0, 54), (72, 54)
    upright = Location((0, 0, 0), (90, 0, 0))
    base = box((-12, 100), (-20, -8), (0, 24)) + box((-8, 8), (-8, 6), (0, 6))
    base += box((40, 100), (-8, 6), (18, 24))
    base = drill(base, 3, (0, 6), a)
    # The grooves in which the blocks slide.
    base -= box((44, 96), (-5 - room, 5 + room), (18, 21))
    platform = box((-12, 100), (62, 74), (0, 24)) + box((-8, 8), (48, 62), (18, 24))
    platform += box((40, 100), (48, 62), (0, 6))
    platform = drill(platform, 3, (18, 24), c)
    platform -= box((44, 96), (49 - room, 59 + room), (3, 6))
    first, at_first = bar(drill, a, d, (6, 12), 3)
    second, at_second = bar(drill, c, b, (12, 18), 3)
    first, second = [drill(arm, 3, layer, (45, 0)) for arm, layer in ((first, (6, 12)), (second, (12, 18)))]
    machine.add("base", base, upright)
    machine.add("platform", platform, upright)
    machine.add("arm", first, upright * at_first)
    machine.add("outer arm", second, upright * at_second)
    pin = rod(3, (0, 12))
    machine.add("pin", pin, upright * Pos(*a, 0))
    machine.add("pin", pin, upright * Pos(36, 27, 6))
    machine.add("pin", pin, upright * Pos(*c, 12))
    # Each block has a stud that turns in an arm, whose hole has no other pin.
    block = box((-6, 6), (-5, 5), (0, 3)) + rod(3, (-6, 0))
    machine.add("block", block, upright * Pos(*b, 18))
    other = box((-6, 6), (-5, 5), (-3, 0)) + rod(3, (0, 6))
    machine.add("upper block", other, upright * Pos(*d, 6))
    return machine


def gripper(room):
    """A piston in a round bore, two links, two fingers on studs; with room the body is bolted to a flange."""
    machine, drill = Machine(), Drill(room, False)
    body = box((-34, 34), (-12, 12), (-12, 6))
    body = drill(body, 5, (-13, 6), (0, -3), "y")
    for x in (-24, 24):
        body += rod(7, (6, 12), (x, 0)) + rod(3, (12, 18), (x, 0))
    piston = rod(5, (-24, 2), (0, -3), "y") + box((-14, 14), (-36, -24), (-9, 6))
    for x in (-8, 8):
        piston += rod(3, (6, 12), (x, -30))
    if room:
        screw, flange = bolt(2, 14), box((-34, 34), (12, 18), (-12, 6))
        for x in (-26, 26):
            body = Drill(room, False)(body, 2, (2, 13), (x, -3), "y")
            flange = Drill(room, False)(flange, 2, (11, 19), (x, -3), "y")
            machine.add("hex bolt M4", screw, Location((x, 18, -3), (-90, 0, 0)))
        machine.add("wrist flange", flange)
    machine.add("gripper base", body)
    machine.add("piston", piston)
    for name, side in (("left", -1), ("right", 1)):
        tail = (side * 32, -20)
        link, at = bar(drill, (side * 8, -30), tail, (6, 12), 3, 10)
        machine.add(f"{name} link", link, at)
        corners = [(20, -24), (36, -24), (28, 50), (20, 50)]
        finger = prism([(side * x, y) for x, y in corners], (12, 18))
        finger = drill(finger, 3, (12, 18), (side * 24, 0))
        finger += rod(3, (6, 12), tail)
        machine.add(f"{name} finger", finger)
    return machine


def dovetail(width, top, height, room):
    """Half widths of a dovetail: a trapezoid that is wider where it is higher."""
    return [(-width - room, 0), (width + room, 0), (top + room, height), (-top - room, height)]


def cartesian_table(room):
    """Bed, saddle and table on dovetails, a head on two rods of the bed's column; with room the rods' bracket is bolted on."""
    machine, bore = Machine(), Drill(room, False)
    along_y = Plane((0, 0, 0), x_dir=(1, 0, 0), z_dir=(0, -1, 0))
    along_x = Plane((0, 0, 0), x_dir=(0, 1, 0), z_dir=(1, 0, 0))
    bed = box((-80, 80), (-50, 50), (-20, 0)) + prism(dovetail(12, 18, 10, 0), (-70, 70), along_x)
    bed += box((-20, 20), (50, 70), (-20, 90))
    saddle = box((-30, 30), (-40, 40), (0, 24))
    saddle -= prism(dovetail(12, 18, 10 + room, room), (-100, 100), along_x)
    saddle += Pos(0, 0, 24) * prism(dovetail(12, 18, 10, 0), (-40, 40), along_y)
    table = box((-40, 40), (-35, 35), (24, 44))
    table -= Pos(0, 0, 24) * prism(dovetail(12, 18, 10 + room, room), (-100, 100), along_y)
    head = box((-14, 14), (10, 40), (60, 80))
    rods = []
    for x in (-8, 8):
        head = bore(head, 4, (59, 81), (x, 30))
        rods.append(rod(4, (52, 100), (x, 30)))
    arm = box((-20, 20), (20, 50 if room else 70), (100, 110)) + rods[0] + rods[1]
    if room:
        screw = bolt(3, 36)
        arm = arm + box((-20, 20), (50, 70), (90, 100)) + box((-20, 20), (50, 70), (100, 110))
        for x in (-12, 12):
            arm = bore(arm, 3, (89, 111), (x, 60))
            bed = bore(bed, 3, (70, 91), (x, 60))
            machine.add("washer-head screw M6", screw, Pos(x, 60, 110))
        machine.add("rod bracket", arm)
    else:
        bed = bed + box((-20, 20), (50, 70), (90, 110)) + arm
    machine.add("machine bed", bed)
    machine.add("saddle", saddle)
    machine.add("table", table)
    machine.add("head", head)
    return machine


def universal_joint(room):
    """Two forked shafts at 30 degrees in bearings of one frame, and a cross with shoulders."""
    machine, drill = Machine(), Drill(room, room > 0)
    turned = Location((0, 0, 0), (0, 0, 30))

    def fork():
        part = rod(6, (-56, -26), (0, 0), "x") + box((-26, -20), (-9, 9), (-15, 15))
        for z in ((10, 15), (-15, -10)):
            part += box((-20, 6), (-6, 6), z)
        return drill(part, 3, (-16, 16))

    def bearing():
        return drill(box((-46, -26), (-14, 14), (-30, 14)), 6, (-47, -25), (0, 0), "x")

    output = Location((0, 0, 0), (0, 0, 210)) * Location((0, 0, 0), (90, 0, 0))
    frame = bearing() + Location((0, 0, 0), (0, 0, 210)) * bearing() + box((-50, 50), (-50, 50), (-36, -30))
    cross = rod(5, (-10, 10)) + rod(3, (-15, 15))
    cross += turned * (rod(5, (-10, 10), (0, 0), "y") + rod(3, (-15, 15), (0, 0), "y"))
    machine.add("frame", frame)
    shaft = fork()
    machine.add("fork", shaft)
    machine.add("fork", shaft, output)
    machine.add("cross", cross)
    return machine


def screw_jack(room):
    """A screw that turns in a base by its collar and a nut that two columns guide; the thread is a plain cylinder. With room the top
    plate is bolted to the columns, and there is a cap on the collar."""
    machine, bore = Machine(), Drill(room, False)
    base = bore(box((-40, 40), (-20, 20), (0, 12)), 6, (-1, 13))
    for x in (-30, 30):
        base += rod(6, (12, 100), (x, 0))
    top = bore(box((-40, 40), (-20, 20), (100, 108)), 6, (99, 109))
    screw = rod(6, (-10, 112)) + rod(12, (12, 18)) + box((-4, 4), (-4, 4), (-20, -10))
    nut = bore(box((-40, 40), (-16, 16), (50, 66)), 6, (49, 67))
    for x in (-30, 30):
        nut = bore(nut, 6, (49, 67), (x, 0))
    if room:
        screw_of_top = bolt(2.5, 25)
        for x in (-30, 30):
            base = bore(base, 2.5, (80, 101), (x, 0))
            top = bore(top, 2.5, (99, 109), (x, 0))
            machine.add("DIN 912 M5x25", screw_of_top, Pos(x, 0, 108))
        machine.add("top plate", top)
    else:
        base += top
    machine.add("base", base)
    machine.add("lead screw", screw)
    machine.add("travelling nut", nut)
    return machine


def planetary(room):
    """Sun, three planets and a carrier in a ring, as cylinders at their pitch circles; with room the cover is bolted on."""
    machine, bore = Machine(), Drill(room, room > 0)
    frame = rod(42, (-8, 16)) - rod(30, (0, 17))
    frame = bore(frame, 4, (-9, 1))
    cover = bore(rod(42, (16, 22)), 6, (15, 23))
    if room:
        plain, screw = Drill(room, False), bolt(2, 18)
        for x, y in ((36, 0), (-36, 0), (0, 36), (0, -36)):
            frame = plain(frame, 2, (2, 17), (x, y))
            cover = plain(cover, 2, (15, 23), (x, y))
            machine.add("bolt", screw, Pos(x, y, 22))
        machine.add("cover", cover)
    else:
        frame += cover
    sun = rod(10, (0, 10)) + rod(4, (-16, 0))
    carrier = rod(28, (11, 16)) + rod(6, (16, 30))
    planet = rod(10, (1, 9))
    planet = bore(planet, 3, (0, 10))
    places = [Location((0, 0, 0), (0, 0, 120 * i)) * Pos(20, 0, 0) for i in range(3)]
    for at in places:
        carrier += at * (rod(3, (2, 11)) + rod(5, (9, 11)))
    machine.add("ring gear frame", frame)
    machine.add("sun gear", sun)
    machine.add("carrier", carrier)
    for at in places:
        machine.add("planet gear", planet, at)
    return machine


MACHINES = [
    four_bar, slider_crank, oldham, sarrus, scissor, gripper, cartesian_table, universal_joint, screw_jack, planetary,
]

def four_bar_askew():
    """The four-bar with room, its pins off the middle of their holes, standing at an angle to all axes of the file."""
    machine, off = four_bar(0.1, bolted=False), iter([(0.04, -0.03), (-0.05, 0.02), (0.01, 0.06), (-0.03, -0.04)])
    for child in machine.children:
        if "pin" in child.label:
            child.location = Pos(*next(off)) * child.location
        child.location = Location((12.3, -45.6, 7.89), (13.7, 41.3, 77.1)) * child.location
    return machine


ENTITY = re.compile(r"#(\d+) *= *(.*)", re.S)
# What is the same wherever it is used. Placements are too, where only surfaces and curves use them: representations hold their own.
SHARED = ("CARTESIAN_POINT(", "DIRECTION(", "VECTOR(", "LINE(", "CIRCLE(", "PLANE(", "CYLINDRICAL_SURFACE(")


def real(text):
    """The shortest text of the same number; ISO 10303-21 asks for a point."""
    mantissa, _, exponent = repr(float(text)).partition("e")
    mantissa = mantissa.removesuffix(".0") + ("." if "." not in mantissa.removesuffix(".0") else "")
    return mantissa + (f"E{exponent}" if exponent else "")


def smaller(text, name):
    """The same assembly in a smaller text: points and directions once, no breaks in entities, a header without a date."""
    header, data = text.split("DATA;", 1)
    data = data.split("ENDSEC;", 1)[0]
    schema = re.search(r"FILE_SCHEMA.*?;", header, re.S).group(0).replace("\n", "")
    entities = {}
    for entity in data.split(";"):
        found = ENTITY.match(entity.strip())
        if found:
            words = re.split(r"('(?:[^']|'')*')", found.group(2))
            joined = "".join(w if w.startswith("'") else re.sub(r"\s+", "", w) for w in words)
            joined = re.sub(r"(?<=[(,])(-?\d+\.\d*)E([+-]\d+)", lambda m: real(m.group(0)), joined)
            joined = re.sub(r"(?<=[(,])(-?\d+\.)0+(?=[,)])", r"\1", joined)
            entities[int(found.group(1))] = joined
    held = set()
    for entity in entities.values():
        if not entity.startswith(SHARED):
            held.update(int(n) for n in re.findall(r"#(\d+)", entity))
    while True:
        known, merged = {}, {}
        for number, entity in entities.items():
            shared = entity.startswith(SHARED) or (entity.startswith("AXIS2_PLACEMENT_3D(") and number not in held)
            if shared and known.setdefault(entity, number) != number:
                merged[number] = known[entity]
        if not merged:
            break
        refer = lambda m: f"#{merged.get(int(m.group(1)), int(m.group(1)))}"
        entities = {n: re.sub(r"#(\d+)", refer, e) for n, e in entities.items() if n not in merged}
    places = {number: place for place, number in enumerate(sorted(entities), 1)}
    renumber = lambda m: f"#{places[int(m.group(1))]}"
    lines = [f"#{places[n]}={re.sub(r'#([0-9]+)', renumber, entities[n])};" for n in sorted(entities)]
    return "\n".join([
        "ISO-10303-21;", "HEADER;", "FILE_DESCRIPTION(('solids by tests/step/machines.py'),'2;1');",
        f"FILE_NAME('{name}','2026-11-28T00:00:00',(''),(''),'Open CASCADE 8.0','build123d 0.13','');", schema,
        "ENDSEC;", "DATA;", *lines, "ENDSEC;", "END-ISO-10303-21;", "",
    ])


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent / "machines"
    folder.mkdir(parents=True, exist_ok=True)
    made = [(f"{make.__name__}_{word}", make, room) for make in MACHINES for word, room in (("tight", 0.0), ("room", 0.1))]
    for name, make, room in [*made, ("four_bar_askew", lambda _: four_bar_askew(), None)]:
        if len(sys.argv) > 2 and not any(name.startswith(wanted) for wanted in sys.argv[2:]):
            continue
        machine = make(room)
        path = folder / f"{name}.step"
        export_step(Compound(label=name.rsplit("_", 1)[0], children=machine.children), path, unit=Unit.MM, write_pcurves=False)
        path.write_text(smaller(path.read_text(encoding="latin-1"), path.name), encoding="ascii")
        several = [child.label for child in machine.children if len(child.solids()) != 1]
        print(f"{path.name:30} {len(machine.children):3} parts {path.stat().st_size:7} bytes", *several)


if __name__ == "__main__":
    main()
