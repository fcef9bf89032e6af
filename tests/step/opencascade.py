"""Holds the faces of STEP files, as `cargo run -p kutzbach-step --example faces` prints them, against those that Open CASCADE reads.

    python opencascade.py FACES FILE ...

Run by `.ci/step-against-opencascade`. Prints a table with a row for each file, and every difference below it; fails where there is one.
Lengths are metres. Halves of one cylinder are one face here and two there: faces on one surface of a part with the material on one side count
as one, planes excepted, of which every face counts.
"""

import collections
import math
import sys

from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.GeomAbs import GeomAbs_Cone, GeomAbs_Cylinder, GeomAbs_Plane, GeomAbs_Sphere
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_FACE, TopAbs_REVERSED
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from OCP.TopLoc import TopLoc_Location
from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_ShapeTool
from OCP.collections import Sequence_TDF_Label

# Points and radii agree within a nanometre, which the digits of millimetres in files allow; directions within 1e-9 rad.
METRES, RADIANS = 1e-9, 1e-9


def of_opencascade(path):
    """Parts in the order of the file: (name of the product, list of faces)."""
    document = TDocStd_Document(TCollection_ExtendedString("XCAF"))
    reader = STEPCAFControl_Reader()
    reader.SetNameMode(True)
    reader.ReadFile(path)
    reader.Transfer(document)
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    parts = []

    def walk(label, location):
        target = label
        if XCAFDoc_ShapeTool.IsReference_s(label):
            target = TDF_Label()
            XCAFDoc_ShapeTool.GetReferredShape_s(label, target)
            location = location.Multiplied(XCAFDoc_ShapeTool.GetLocation_s(label))
        if XCAFDoc_ShapeTool.IsAssembly_s(target):
            for component in components(target):
                walk(component, location)
            return
        shape = XCAFDoc_ShapeTool.GetShape_s(target).Located(location)
        parts.append((name(target), faces(shape)))

    for label in free_shapes(tool):
        walk(label, TopLoc_Location())
    return parts


def listed(fill):
    """The labels that a function of Open CASCADE puts into a sequence."""
    labels = Sequence_TDF_Label()
    fill(labels)
    return [labels.Value(i) for i in range(1, labels.Length() + 1)]


def components(label):
    return listed(lambda labels: XCAFDoc_ShapeTool.GetComponents_s(label, labels))


def free_shapes(tool):
    return listed(tool.GetFreeShapes)


def name(label):
    attribute = TDataStd_Name()
    return attribute.Get().ToExtString() if label.FindAttribute(TDataStd_Name.GetID_s(), attribute) else ""


def faces(shape):
    found = []
    explorer = TopExp_Explorer(shape, TopAbs_FACE)
    while explorer.More():
        face = TopoDS.Face_s(explorer.Current()) if hasattr(TopoDS, "Face_s") else TopoDS.Face(explorer.Current())
        found.append(surface(face))
        explorer.Next()
    return found


def triple(vector):
    return (vector.X(), vector.Y(), vector.Z())


def surface(face):
    """(kind, side, point, direction, radius or half angle, (from, to)) of a face, in metres."""
    adaptor = BRepAdaptor_Surface(face, True)
    kind, reversed_face = adaptor.GetType(), face.Orientation() == TopAbs_REVERSED
    milli = lambda p: tuple(x / 1000 for x in triple(p))
    if kind == GeomAbs_Plane:
        plane = adaptor.Plane()
        normal = triple(plane.Axis().Direction())
        # Normals of planes that are not right-handed point the other way.
        if reversed_face != (not plane.Position().Direct()):
            normal = tuple(-x for x in normal)
        return ("plane", "inside", milli(plane.Location()), normal, 0.0, (0.0, 0.0))
    along = (adaptor.FirstVParameter() / 1000, adaptor.LastVParameter() / 1000)
    if kind == GeomAbs_Cylinder:
        body = adaptor.Cylinder()
        outward = reversed_face != body.Position().Direct()
        side = "inside" if outward else "outside"
        return ("cylinder", side, milli(body.Location()), triple(body.Axis().Direction()), body.Radius() / 1000, along)
    if kind == GeomAbs_Cone:
        body = adaptor.Cone()
        outward = reversed_face != body.Position().Direct()
        angle = body.SemiAngle()
        sign = 1 if angle > 0 else -1
        apex, direction = milli(body.Apex()), tuple(sign * x for x in triple(body.Axis().Direction()))
        # Along its lines from the reference circle; here along the axis from the apex.
        start = body.RefRadius() / 1000 / math.tan(abs(angle))
        ends = sorted(start + sign * v * math.cos(angle) for v in along)
        return ("cone", "inside" if outward else "outside", apex, direction, abs(angle), tuple(ends))
    if kind == GeomAbs_Sphere:
        body = adaptor.Sphere()
        outward = reversed_face != body.Position().Direct()
        return ("sphere", "inside" if outward else "outside", milli(body.Location()), (0, 0, 0), body.Radius() / 1000, (0.0, 0.0))
    return (str(kind), "inside", (0, 0, 0), (0, 0, 0), 0.0, (0.0, 0.0))


def of_reader(path):
    """By file: parts in order, (name, list of faces)."""
    files = collections.defaultdict(list)
    for line in open(path, encoding="utf-8"):
        file, part, kind, side, *numbers = line.rstrip("\n").split("\t")
        x = [float(word) for word in numbers]
        parts = files[file]
        if not parts or parts[-1][0] != part:
            parts.append((part, []))
        parts[-1][1].append((kind, side, tuple(x[0:3]), tuple(x[3:6]), x[6], (x[7], x[8])))
    return files


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a):
    return math.sqrt(dot(a, a))


def same_surface(a, b):
    """Whether two faces lie on one surface, with the material on one side."""
    if a[:2] != b[:2] or abs(a[4] - b[4]) > METRES:
        return False
    between = minus(b[2], a[2])
    if a[0] == "plane":
        return norm(minus(a[3], b[3])) < RADIANS and abs(dot(between, a[3])) < METRES
    if a[0] == "cylinder":
        return norm(cross(a[3], b[3])) < RADIANS and norm(cross(between, a[3])) < METRES
    return norm(between) < METRES and norm(minus(a[3], b[3])) < RADIANS


def span(face, of):
    """From where to where a face goes along the axis of another on the same surface."""
    shift, sign = dot(minus(face[2], of[2]), of[3]), dot(face[3], of[3])
    return sorted(shift + sign * x for x in face[5])


def united(faces):
    """Faces of one surface that overlap along its axis as one; planes and what is unknown as they are."""
    out = []
    for face in faces:
        if face[0] in ("cylinder", "cone", "sphere"):
            for place, other in enumerate(out):
                low, high = span(face, other)
                overlap = other[0] == "sphere" or (low < other[5][1] - METRES and other[5][0] < high - METRES)
                if same_surface(face, other) and overlap:
                    out[place] = (*other[:5], (min(low, other[5][0]), max(high, other[5][1])))
                    break
            else:
                out.append(face)
        else:
            out.append(face)
    return out


def compared(theirs, ours):
    """What differs between two lists of faces, and the largest distance of radii and axes among those that agree."""
    theirs, ours, told, worst = united(theirs), united(ours), [], 0.0
    left = list(ours)
    for face in theirs:
        for other in left:
            if same_surface(face, other):
                low, high = span(other, face)
                lengths = max(abs(low - face[5][0]), abs(high - face[5][1])) if face[0] in ("cylinder", "cone") else 0.0
                if lengths < METRES:
                    worst = max(worst, abs(face[4] - other[4]), lengths)
                    left.remove(other)
                    break
        else:
            told.append(("Open CASCADE only", face))
    return told + [("here only", face) for face in left], worst


def main():
    ours_of, failed = of_reader(sys.argv[1]), False
    print(f"{'file':34} {'parts':>6} {'planes':>7} {'cylinders':>10} {'cones':>6} {'spheres':>8} {'worst':>9}  differences")
    for path in sys.argv[2:]:
        theirs, ours = of_opencascade(path), ours_of[path]
        kinds, told, worst = collections.Counter(), [], 0.0
        if len(theirs) != len(ours):
            told.append(f"{len(theirs)} parts in Open CASCADE, {len(ours)} here")
        for (their_name, their_faces), (our_name, our_faces) in zip(theirs, ours):
            if our_name.split(" (")[0] != their_name.split(" (")[0]:
                told.append(f"`{their_name}` in Open CASCADE is `{our_name}` here")
            differ, off = compared(their_faces, our_faces)
            told += [f"`{our_name}`, {who}: {face}" for who, face in differ]
            worst = max(worst, off)
            kinds.update(face[0] for face in united(our_faces))
        counts = [kinds[kind] for kind in ("plane", "cylinder", "cone", "sphere")]
        row = f"{path.split('/')[-1]:34} {len(ours):6} {counts[0]:7} {counts[1]:10} {counts[2]:6} {counts[3]:8} {worst:9.1e}"
        print(row, "", len(told) or "none")
        for line in told:
            print("    ", line)
        failed |= bool(told)
    sys.exit(failed)


if __name__ == "__main__":
    main()
