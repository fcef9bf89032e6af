"""Writes loader_freecad.FCStd: the loader as FreeCAD's Assembly workbench saves it, without shapes. `python3 loader_freecad.py`"""

import pathlib
import zipfile

UNTURNED = (0, 0, 0, 1)
# The z axis of a joint is its axis: a quarter turn about x points it along -y.
ALONG = (0.7071067811865475, 0, 0, 0.7071067811865476)

objects, data = [], []


def prop(name, inside):
    return f'<Property name="{name}">{inside}</Property>'


def placed(name, place, turn=UNTURNED):
    numbers = zip(("Px", "Py", "Pz", "Q0", "Q1", "Q2", "Q3"), (*place, *turn))
    said = " ".join(f'{word}="{number:.16f}"' for word, number in numbers)
    return prop(name, f"<PropertyPlacement {said}/>")


def links(names):
    return prop("Group", "<LinkList>" + "".join(f'<Link value="{name}"/>' for name in names) + "</LinkList>")


def add(kind, name, label, properties):
    objects.append(f'<Object type="{kind}" name="{name}"/>')
    label = prop("Label", f'<String value="{label}"/>')
    data.append(f'<Object name="{name}"><Properties>{label}{properties}</Properties></Object>')


# Millimetres.
parts = {"base": (0, 0, 0), "boom": (0, 0, 400), "bar": (0, 0, 600), "bucket": (1200, 0, 400)}
for name, place in parts.items():
    add("App::Part", name.title(), name, placed("Placement", place))
    add("PartDesign::Body", f"{name.title()}Body", f"body of {name}", placed("Placement", (0, 0, 0)))

add("App::FeaturePython", "GroundedJoint", "ground", prop("ObjectToGround", '<Link value="Base"/>'))
joints = {
    "lift": (("base", (0, 0, 400)), ("boom", (0, 0, 0)), (-28, 52)),
    "tip": (("boom", (1200, 0, 0)), ("bucket", (0, 0, 0)), None),
    "stay": (("base", (0, 0, 600)), ("bar", (0, 0, 0)), None),
    "end": (("bar", (1200, 0, 0)), ("bucket", (0, 0, 200)), None),
}
for index, (label, (*ends, limits)) in enumerate(joints.items(), start=1):
    kind = '<Integer value="1" CustomEnum="true"/><CustomEnumList count="1"><Enum value="Revolute"/></CustomEnumList>'
    said = prop("JointType", kind)
    for number, (part, place) in enumerate(ends, start=1):
        part = part.title()
        element = f'<Sub value="{part}.{part}Body.Pad.Face1"/>'
        said += prop(f"Reference{number}", f'<XLink file="" name="Assembly" count="2">{element * 2}</XLink>')
        said += placed(f"Placement{number}", place, ALONG)
    for end, limit in zip(("Min", "Max"), limits or ()):
        said += prop(f"EnableAngle{end}", '<Bool value="true"/>')
        said += prop(f"Angle{end}", f'<Float value="{limit:.16f}"/>')
    add("App::FeaturePython", f"Joint{index:03}", label, said)

add("Assembly::JointGroup", "Joints", "Joints", links(["GroundedJoint", *(f"Joint{i:03}" for i in range(1, 5))]))
add("Assembly::AssemblyObject", "Assembly", "loader", links([*(name.title() for name in parts), "Joints"]))
text = f"""<?xml version='1.0' encoding='utf-8'?>
<Document SchemaVersion="4" ProgramVersion="1.0">
<Objects Count="{len(objects)}">
{chr(10).join(objects)}
</Objects>
<ObjectData Count="{len(data)}">
{chr(10).join(data)}
</ObjectData>
</Document>
"""
with zipfile.ZipFile(pathlib.Path(__file__).with_name("loader_freecad.FCStd"), "w", zipfile.ZIP_DEFLATED) as file:
    file.writestr(zipfile.ZipInfo("Document.xml"), text, zipfile.ZIP_DEFLATED)
