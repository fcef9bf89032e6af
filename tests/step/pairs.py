"""STEP files of AP242 with kinematic pairs, one of each kind: two blocks that do not touch, and a pair between the two; of gears three.

    solids/bin/python tests/step/pairs.py [FOLDER]

(`solids` as in machines.py.) The entities are those of the AP242 schema (ISO 10303-442, managed model based 3D engineering). A pair's frame
stands at (20, 10, 5) mm of the whole, z upwards; each block's own frame is in its middle. What is read of each is in tests/step_pairs.rs.
"""

import re
import sys
from pathlib import Path

from build123d import Compound, Location, Unit, export_step

from machines import Machine, box, smaller

LOW = "*,*,*,*,*,*"
# Keyword, and what follows the joint.
KINDS = {
    "revolute": ("REVOLUTE_PAIR", LOW),
    "revolute_with_range": ("REVOLUTE_PAIR_WITH_RANGE", LOW + ",-1.,1."),
    "prismatic": ("PRISMATIC_PAIR", LOW),
    "cylindrical": ("CYLINDRICAL_PAIR", LOW),
    "spherical": ("SPHERICAL_PAIR", LOW),
    "spherical_with_pin": ("SPHERICAL_PAIR_WITH_PIN", LOW),
    "planar": ("PLANAR_PAIR", LOW),
    "universal": ("UNIVERSAL_PAIR", LOW + ",$"),
    "homokinetic": ("HOMOKINETIC_PAIR", LOW + ",$"),
    "fully_constrained": ("FULLY_CONSTRAINED_PAIR", LOW),
    "unconstrained": ("UNCONSTRAINED_PAIR", LOW),
    "low_order": ("LOW_ORDER_KINEMATIC_PAIR", ".T.,.T.,.F.,.F.,.F.,.F."),
    "screw": ("SCREW_PAIR", "2.5"),
    "rack_and_pinion": ("RACK_AND_PINION_PAIR", "10."),
    "gear": ("GEAR_PAIR", "20.,10.,0.,0.,2."),
}


class Text:
    """A file that grows by entities."""

    def __init__(self, text):
        self.head, self.tail = text.split("ENDSEC;\nEND-ISO", 1)
        self.number = max(int(n) for n in re.findall(r"^#(\d+)=", text, re.M))
        self.more = []

    def add(self, entity):
        self.number += 1
        self.more.append(f"#{self.number}={entity};")
        return self.number

    def whole(self):
        return self.head + "\n".join(self.more) + "\nENDSEC;\nEND-ISO" + self.tail


def placement(text, point):
    origin = text.add(f"CARTESIAN_POINT('',{point})")
    z, x = text.add("DIRECTION('',(0.,0.,1.))"), text.add("DIRECTION('',(1.,0.,0.))")
    return text.add(f"AXIS2_PLACEMENT_3D('',#{origin},#{z},#{x})")


def occurrences(text):
    """The numbers of usage, shape and context of each occurrence, and that of the whole's definition."""
    line = {int(n): e for n, e in re.findall(r"^#(\d+)=(.*);$", text, re.M)}
    find = lambda start: [n for n, e in line.items() if e.startswith(start)]
    refers = lambda n: [int(x) for x in re.findall(r"#(\d+)", line[n])]
    found, whole = [], None
    for usage in find("NEXT_ASSEMBLY_USAGE_OCCURRENCE("):
        parent, child = refers(usage)
        whole = parent
        shape = next(n for n in find("PRODUCT_DEFINITION_SHAPE(") if refers(n) == [child])
        shown = next(refers(n)[1] for n in find("SHAPE_DEFINITION_REPRESENTATION(") if refers(n)[0] == shape)
        found.append((usage, shown, refers(shown)[-1]))
    return found, whole


def link(text, name, occurrence, points):
    """A link: its number, that of its representation, and those of its placements."""
    usage, shape, context = occurrence
    number = text.add(f"KINEMATIC_LINK('{name}')")
    items = [placement(text, point) for point in points]
    shown = text.add(f"RIGID_LINK_REPRESENTATION('{name}',({','.join(f'#{i}' for i in items)}),#{context},#{number})")
    association = text.add(f"KINEMATIC_LINK_REPRESENTATION_ASSOCIATION('','',#{shown},#{shape})")
    property = text.add(f"PRODUCT_DEFINITION_RELATIONSHIP_KINEMATICS('','',#{usage})")
    text.add(f"CONTEXT_DEPENDENT_KINEMATIC_LINK_REPRESENTATION(#{association},#{property})")
    return number, shown, items


def pair(text, keyword, rest, one, two, items):
    """A pair between two links: its joint, and its relationship."""
    joint = text.add(f"KINEMATIC_JOINT('',#{one[0]},#{two[0]})")
    number = text.add(f"{keyword}('',*,$,#{items[0]},#{items[1]},#{joint},{rest})")
    related = text.add(f"PAIR_REPRESENTATION_RELATIONSHIP('','','',#{one[1]},#{two[1]},#{number})")
    return joint, related


def mechanism(text, whole, base, context, made):
    joints, relations = (",".join(f"#{n[i]}" for n in made) for i in (0, 1))
    topology = text.add(f"KINEMATIC_TOPOLOGY_STRUCTURE('',({joints}),#{context})")
    shown = text.add(f"MECHANISM_REPRESENTATION('',({relations}),#{context},#{topology})")
    property = text.add(f"PRODUCT_DEFINITION_KINEMATICS('','',#{whole})")
    text.add(f"KINEMATIC_PROPERTY_MECHANISM_REPRESENTATION(#{property},#{shown},#{base[1]})")


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent / "pairs"
    folder.mkdir(parents=True, exist_ok=True)
    for name, (keyword, rest) in KINDS.items():
        machine = Machine()
        places = [(0, 0, 0), (30, 0, 0), (0, 30, 0)][: 3 if name == "gear" else 2]
        for part, place, size in zip(("first", "second", "third"), places, (10, 12, 14)):
            machine.add(part, box((0, size), (0, size), (0, size)), Location(place))
        path = folder / f"{name}.step"
        export_step(Compound(label="whole", children=machine.children), path, unit=Unit.MM, write_pcurves=False)
        raw = smaller(path.read_text(encoding="latin-1"), path.name)
        raw = re.sub(r"FILE_SCHEMA.*?;", "FILE_SCHEMA(('AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }'));", raw)
        text = Text(raw)
        found, whole = occurrences(raw)
        if name == "gear":
            # The first block bears both gears; each has its hinge and its frame of the pair at (5, 5, 5) mm from its corner.
            base = link(text, "frame", found[0], ["(30.,0.,0.)", "(0.,30.,0.)"])
            one = link(text, "gear", found[1], ["(-1.,-1.,-1.)"])
            two = link(text, "gear", found[2], ["(-2.,-2.,-2.)"])
            made = [
                pair(text, "REVOLUTE_PAIR", LOW, base, one, (base[2][0], one[2][0])),
                pair(text, "REVOLUTE_PAIR", LOW, base, two, (base[2][1], two[2][0])),
                pair(text, keyword, rest, one, two, (one[2][0], two[2][0])),
            ]
        else:
            base = link(text, "first", found[0], ["(15.,5.,0.)"])
            other = link(text, "second", found[1], ["(-16.,4.,-1.)"])
            made = [pair(text, keyword, rest, base, other, (base[2][0], other[2][0]))]
        mechanism(text, whole, base, found[0][2], made)
        path.write_text(text.whole(), encoding="ascii")
        print(f"{path.name:28} {path.stat().st_size:6} bytes")


if __name__ == "__main__":
    main()
