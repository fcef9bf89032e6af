"""Parts with one feature each, and parts that nearly have it, as STEP files: solids of revolution and prisms, written without a kernel.

    python3 tests/step/features.py [FOLDER]

Writes FOLDER/NAME.step and FOLDER/NAME_near.step (FOLDER: tests/step/features). Lengths are millimetres. What each has is in
tests/step_features.rs.
"""

import sys
from math import atan, hypot, sqrt
from pathlib import Path


class Solid:
    """Entities of one solid; every method adds some and gives the number of the last."""

    def __init__(self):
        self.lines, self.known, self.faces = [], {}, []

    def add(self, entity, shared=True):
        if shared and entity in self.known:
            return self.known[entity]
        self.lines.append(entity)
        self.known[entity] = len(self.lines)
        return len(self.lines)

    def point(self, p):
        return self.add("CARTESIAN_POINT('',(%s))" % ",".join(number(x) for x in p))

    def direction(self, p):
        return self.add("DIRECTION('',(%s))" % ",".join(number(x) for x in p))

    def frame(self, at, z=(0, 0, 1)):
        x = (1, 0, 0) if z[0] == 0 else (0, 0, 1)
        return self.add(f"AXIS2_PLACEMENT_3D('',#{self.point(at)},#{self.direction(z)},#{self.direction(x)})")

    def vertex(self, p):
        return self.add(f"VERTEX_POINT('',#{self.point(p)})")

    def line(self, p, q):
        length = hypot(*[b - a for a, b in zip(p, q)])
        along = self.direction([(b - a) / length for a, b in zip(p, q)])
        vector = self.add(f"VECTOR('',#{along},1.)")
        curve = self.add(f"LINE('',#{self.point(p)},#{vector})")
        return self.add(f"EDGE_CURVE('',#{self.vertex(p)},#{self.vertex(q)},#{curve},.T.)")

    def arc(self, p, q, centre, left=True):
        """Around an axis along z, to the left or to the right, all around where both ends are one."""
        radius = hypot(p[0] - centre[0], p[1] - centre[1])
        curve = self.add(f"CIRCLE('',#{self.frame(centre)},{number(radius)})")
        return self.add(f"EDGE_CURVE('',#{self.vertex(p)},#{self.vertex(q)},#{curve},{truth(left)})")

    def face(self, surface, outward, loops):
        """`loops`: edges with their senses; seen from outside the face is to the left."""
        bounds = []
        for edges in loops:
            used = [self.add(f"ORIENTED_EDGE('',*,*,#{edge},{truth(forward)})", False) for edge, forward in edges]
            loop = self.add("EDGE_LOOP('',(%s))" % references(used), False)
            bounds.append(self.add(f"FACE_BOUND('',#{loop},.T.)", False))
        self.faces.append(self.add(f"ADVANCED_FACE('',({references(bounds)}),#{surface},{truth(outward)})", False))

    def plane(self, at, normal):
        return self.add(f"PLANE('',#{self.frame(at, normal)})")

    def cylinder(self, at, radius):
        return self.add(f"CYLINDRICAL_SURFACE('',#{self.frame(at)},{number(radius)})")

    def text(self, name):
        shell = self.add("CLOSED_SHELL('',(%s))" % references(self.faces))
        solid = self.add(f"MANIFOLD_SOLID_BREP('',#{shell})")
        length = self.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))")
        angle = self.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))")
        space = self.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())")
        digits = self.add(f"UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-06),#{length},'distance_accuracy_value','')")
        context = self.add(
            f"(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{digits}))"
            f"GLOBAL_UNIT_ASSIGNED_CONTEXT((#{length},#{angle},#{space}))REPRESENTATION_CONTEXT('',''))"
        )
        shape = self.add(f"ADVANCED_BREP_SHAPE_REPRESENTATION('',(#{self.frame((0, 0, 0))},#{solid}),#{context})")
        application = self.add("APPLICATION_CONTEXT('automotive design')")
        self.add(f"APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#{application})")
        mechanical = self.add(f"PRODUCT_CONTEXT('',#{application},'mechanical')")
        product = self.add(f"PRODUCT('{name}','{name}','',(#{mechanical}))")
        formation = self.add(f"PRODUCT_DEFINITION_FORMATION('','',#{product})")
        design = self.add(f"PRODUCT_DEFINITION_CONTEXT('part definition',#{application},'design')")
        definition = self.add(f"PRODUCT_DEFINITION('','',#{formation},#{design})")
        defined = self.add(f"PRODUCT_DEFINITION_SHAPE('','',#{definition})")
        self.add(f"SHAPE_DEFINITION_REPRESENTATION(#{defined},#{shape})")
        return "\n".join([
            "ISO-10303-21;", "HEADER;", "FILE_DESCRIPTION(('a part by tests/step/features.py'),'2;1');",
            f"FILE_NAME('{name}.step','2026-11-28T00:00:00',(''),(''),'','','');",
            "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));", "ENDSEC;", "DATA;",
            *[f"#{place}={line};" for place, line in enumerate(self.lines, 1)],
            "ENDSEC;", "END-ISO-10303-21;", "",
        ])


def number(x):
    text = repr(float(x)).removesuffix("0") if float(x).is_integer() else repr(float(x))
    return "0." if text == "-0." else text


def truth(holds):
    return ".T." if holds else ".F."


def references(numbers):
    return ",".join(f"#{n}" for n in numbers)


def turned(*corners):
    """A solid of revolution about z: corners (r, z) to the left of whose outline the material is. (r, z, c) is reached along a sphere with its
    centre at height c."""
    solid = Solid()
    edge = lambda r, z: solid.arc((r, 0, z), (r, 0, z), (0, 0, z))
    for (r, z, *_), (s, t, *centre) in zip(corners, corners[1:] + corners[:1]):
        if r == 0 and s == 0:
            continue
        # The outline leaves its first circle to the left of a way around the axis, and reaches its last one to the right.
        loops = [[(edge(*place), forward)] for place, forward in (((r, z), True), ((s, t), False)) if place[0] > 0]
        if centre:
            sphere = solid.add(f"SPHERICAL_SURFACE('',#{solid.frame((0, 0, centre[0]))},{number(hypot(r, z - centre[0]))})")
            solid.face(sphere, r * (t - centre[0]) - (z - centre[0]) * s > 0, loops)
        elif z == t:
            solid.face(solid.plane((0, 0, z), (0, 0, 1 if s < r else -1)), True, loops)
        elif r == s:
            solid.face(solid.cylinder((0, 0, z), r), t > z, loops)
        else:
            (low, at), (high, to) = sorted([(r, z), (s, t)])
            angle = number(atan((high - low) / abs(to - at)))
            frame = solid.frame((0, 0, at), (0, 0, 1 if to > at else -1))
            solid.face(solid.add(f"CONICAL_SURFACE('',#{frame},{number(low)},{angle})"), t > z, loops)
    return solid


def prism(height, *outlines):
    """A prism over outlines of (start, centre or None), to the left of which the material is: straight to the next start, or around the centre to
    the left. An outline of one start is a circle, as ("hole" or "rim", centre, radius)."""
    solid, caps = Solid(), {0: [], height: []}
    for outline in outlines:
        if outline[0] in ("hole", "rim"):
            (word, (x, y), radius), left = outline, outline[0] == "rim"
            sides = {z: solid.arc((x + radius, y, z), (x + radius, y, z), (x, y, z), left) for z in caps}
            solid.face(solid.cylinder((x, y, 0), radius), left, [[(sides[0], True)], [(sides[height], False)]])
            steps = [sides]
        else:
            steps = []
            for (start, centre), (end, _) in zip(outline, outline[1:] + outline[:1]):
                up = [solid.line((*corner, 0), (*corner, height)) for corner in (start, end)]
                way = lambda z: (solid.arc((*start, z), (*end, z), (*centre, z)) if centre else solid.line((*start, z), (*end, z)))
                sides = {z: way(z) for z in caps}
                loop = [(sides[0], True), (up[1], True), (sides[height], False), (up[0], False)]
                if centre:
                    surface = solid.cylinder((*centre, 0), hypot(start[0] - centre[0], start[1] - centre[1]))
                else:
                    length = hypot(end[0] - start[0], end[1] - start[1])
                    surface = solid.plane((*start, 0), ((end[1] - start[1]) / length, (start[0] - end[0]) / length, 0))
                solid.face(surface, True, [loop])
                steps.append(sides)
        caps[0].append([(sides[0], False) for sides in reversed(steps)])
        caps[height].append([(sides[height], True) for sides in steps])
    solid.face(solid.plane((0, 0, 0), (0, 0, -1)), True, caps[0])
    solid.face(solid.plane((0, 0, height), (0, 0, 1)), True, caps[height])
    return solid


def keyed(half_floor):
    """A shaft with a groove 6 mm wide at its mouth."""
    mouth = sqrt(10**2 - 3**2)
    outline = [((-3, mouth), (0, 0)), ((3, mouth), None), ((half_floor, 6), None), ((-half_floor, 6), None)]
    return prism(30, outline)


def flange(first):
    holes = [("hole", centre, 2) for centre in (first, (0, 20), (-20, 0), (0, -20))]
    return prism(6, ("rim", (0, 0), 30), ("hole", (0, 0), 8), *holes)


PARTS = {
    "pin": turned((0, 0), (20, 0), (20, 5), (4, 5), (4, 15), (0, 15)),
    # A taper is no pin.
    "pin_near": turned((0, 0), (20, 0), (20, 5), (4, 5), (3, 15), (0, 15)),
    "round_hole": turned((5, 0), (20, 0), (20, 6), (5, 6)),
    "round_hole_near": turned((0, 0), (20, 0), (20, 6), (5, 6), (5, 2), (0, 2)),
    "ball": turned((0, 0), (12, 0), (12, 4), (3, 4), (3, 12), (0, 21, 16)),
    # A round end goes on smoothly.
    "ball_near": turned((0, 0), (12, 0), (12, 4), (5, 4), (5, 16), (0, 21, 16)),
    "socket": turned((0, 0), (12, 0), (12, 10), (4, 10), (0, 8, 13)),
    "socket_near": turned((0, 0), (12, 0), (12, 10), (4, 10), (0, 7)),
    "counterbore": turned((3, 0), (15, 0), (15, 12), (6, 12), (6, 7), (3, 7)),
    # Wide below and narrow above.
    "counterbore_near": turned((0, 0), (15, 0), (15, 12), (3, 12), (3, 7), (6, 7), (6, 2), (0, 2)),
    "countersink": turned((3, 0), (15, 0), (15, 10), (7, 10), (3, 6)),
    "countersink_near": turned((5, 0), (15, 0), (15, 10), (3, 10), (5, 6)),
    "keyway": keyed(3),
    # Walls that lean.
    "keyway_near": keyed(3.5),
    "bolt_circle": flange((20, 0)),
    # One hole half a millimetre off the circle.
    "bolt_circle_near": flange((20.5, 0)),
}


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent / "features"
    folder.mkdir(parents=True, exist_ok=True)
    for name, solid in PARTS.items():
        (folder / f"{name}.step").write_text(solid.text(name), encoding="ascii")


if __name__ == "__main__":
    main()
