"""Holds the faces of STEP files, as `cargo run -p kutzbach-step --example faces` prints them, against those that Open CASCADE reads.

    python opencascade.py FACES FILE ...

Run by `.ci/step-against-opencascade`. Prints a table with a row for each file, and every difference below it; fails where there is one.
Lengths are metres. Halves of one cylinder are one face here and two there: faces on one surface of a part with the material on one side count
as one, planes excepted, of which every face counts. Splines and swept surfaces that are a plane, cylinder, cone or sphere are recognised by both, each
in its own way.
"""

import collections
import math
import sys

from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.GeomAbs import GeomAbs_Cone, GeomAbs_Cylinder, GeomAbs_Plane, GeomAbs_Sphere, GeomAbs_Torus
from OCP.gp import gp_Cone, gp_Cylinder, gp_Pln, gp_Sphere
from OCP.ShapeAnalysis import ShapeAnalysis_CanonicalRecognition
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_FACE, TopAbs_REVERSED, TopAbs_VERTEX
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS
from OCP.TopLoc import TopLoc_Location
from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_ShapeTool
from OCP.collections import Sequence_TDF_Label

# Points and radii agree within a nanometre, which the digits of millimetres in files allow; directions within 1e-9 rad.
METRES, RADIANS = 1e-9, 1e-9

# What is recognised in other surfaces is found within this (mm), and agrees within so many times more than what is written.
RECOGNISED, LOOSE = 1e-5, 100

# How much of its length a round face may be shorter here: curved ends are taken in steps of 15 degrees, whose chords miss 1 - cos(7.5 degrees) of the radius,
# and splines in 32 steps.
CHORDS = 0.01

# The names of shapes that are no products of their own but what a product is made of.
PIECES = {"SOLID", "COMPOUND", "SHELL", "COMPSOLID", "FACE", ""}


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
        target = referred(label)
        if not target.IsEqual(label):
            location = location.Multiplied(XCAFDoc_ShapeTool.GetLocation_s(label))
        if not XCAFDoc_ShapeTool.IsAssembly_s(target):
            add(name(target), faces(XCAFDoc_ShapeTool.GetShape_s(target).Located(location)))
            return
        # The shapes of the product itself are one part, before those of its components.
        own = [component for component in components(target) if name(referred(component)) in PIECES]
        add(name(target), [face for component in own for face in shapes_of(component, location)])
        for component in components(target):
            if name(referred(component)) not in PIECES:
                walk(component, location)

    def shapes_of(label, location):
        location = location.Multiplied(XCAFDoc_ShapeTool.GetLocation_s(label))
        return faces(XCAFDoc_ShapeTool.GetShape_s(referred(label)).Located(location))

    def add(product, found):
        if found:
            parts.append((product, found))

    for label in free_shapes(tool):
        walk(label, TopLoc_Location())
    return parts


def referred(label):
    """What a component refers to; any other label itself."""
    if not XCAFDoc_ShapeTool.IsReference_s(label):
        return label
    target = TDF_Label()
    XCAFDoc_ShapeTool.GetReferredShape_s(label, target)
    return target


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
    return recognised(face, reversed_face, adaptor) if kind != GeomAbs_Torus else OTHER


# A face on a surface of another kind.
OTHER = ("other", "inside", (0, 0, 0), (0, 0, 0), 0.0, (0.0, 0.0))


def recognised(face, reversed_face, adaptor):
    """The same of a face on a spline or a swept surface, with `True` behind it where Open CASCADE finds that it is one of the four."""
    search = ShapeAnalysis_CanonicalRecognition(face)
    milli = lambda p: tuple(x / 1000 for x in triple(p))
    # A normal of the surface, and where it is: out of the material.
    middle = [(adaptor.FirstUParameter() + adaptor.LastUParameter()) / 2, (adaptor.FirstVParameter() + adaptor.LastVParameter()) / 2]
    shift = [1e-4 * (adaptor.LastUParameter() - adaptor.FirstUParameter()), 1e-4 * (adaptor.LastVParameter() - adaptor.FirstVParameter())]
    at = lambda i, j: milli(adaptor.Value(middle[0] + i * shift[0], middle[1] + j * shift[1]))
    normal = cross(minus(at(1, 0), at(-1, 0)), minus(at(0, 1), at(0, -1)))
    normal = tuple((-x if reversed_face else x) / norm(normal) for x in normal)
    plane, cylinder, cone, sphere = gp_Pln(), gp_Cylinder(), gp_Cone(), gp_Sphere()
    if search.IsPlane(RECOGNISED, plane):
        own = triple(plane.Axis().Direction())
        own = own if dot(own, normal) > 0 else tuple(-x for x in own)
        return ("plane", "inside", milli(plane.Location()), own, 0.0, (0.0, 0.0), True)
    if search.IsCylinder(RECOGNISED, cylinder):
        point, axis = milli(cylinder.Location()), triple(cylinder.Axis().Direction())
        side = side_of(minus(at(0, 0), point), axis, normal)
        return ("cylinder", side, point, axis, cylinder.Radius() / 1000, along(face, point, axis), True)
    if search.IsSphere(RECOGNISED, sphere):
        point = milli(sphere.Location())
        side = "inside" if dot(minus(at(0, 0), point), normal) > 0 else "outside"
        return ("sphere", side, point, (0, 0, 0), sphere.Radius() / 1000, (0.0, 0.0), True)
    if search.IsCone(RECOGNISED, cone):
        point, axis = milli(cone.Apex()), triple(cone.Axis().Direction())
        axis = axis if cone.SemiAngle() > 0 else tuple(-x for x in axis)
        side = side_of(minus(at(0, 0), point), axis, normal)
        return ("cone", side, point, axis, abs(cone.SemiAngle()), along(face, point, axis), True)
    return OTHER


def side_of(arm, axis, normal):
    """Where the material is whose normal points out, by the arm from a point of the axis."""
    height = dot(arm, axis)
    away = tuple(x - height * y for x, y in zip(arm, axis))
    return "inside" if dot(away, normal) > 0 else "outside"


def along(face, point, axis):
    """From where to where the corners of a face go along an axis."""
    heights, explorer = [], TopExp_Explorer(face, TopAbs_VERTEX)
    while explorer.More():
        vertex = TopoDS.Vertex_s(explorer.Current()) if hasattr(TopoDS, "Vertex_s") else TopoDS.Vertex(explorer.Current())
        corner = tuple(x / 1000 for x in triple(BRep_Tool.Pnt_s(vertex)))
        heights.append(dot(minus(corner, point), axis))
        explorer.Next()
    return (min(heights), max(heights))


def of_reader(path):
    """By file: parts in order, (name, list of faces)."""
    files = collections.defaultdict(list)
    for line in open(path, encoding="utf-8"):
        file, part, kind, side, *numbers = line.rstrip("\n").split("\t")
        x = [float(word) for word in numbers]
        parts = files[file]
        if not parts or parts[-1][0] != part:
            parts.append((part, []))
        known = kind in ("plane", "cylinder", "cone", "sphere")
        parts[-1][1].append((kind, side, tuple(x[0:3]), tuple(x[3:6]), x[6], (x[7], x[8])) if known else OTHER)
    return files


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def norm(a):
    return math.sqrt(dot(a, a))


def within(*faces):
    """Within how many times what is written faces have to agree."""
    return LOOSE if any(len(face) > 6 for face in faces) else 1


def same_surface(a, b):
    """Whether two faces lie on one surface, with the material on one side."""
    metres, radians = (limit * within(a, b) for limit in (METRES, RADIANS))
    if a[:2] != b[:2] or abs(a[4] - b[4]) > metres:
        return False
    between = minus(b[2], a[2])
    if a[0] == "plane":
        # The points of a plane may be far apart.
        return norm(minus(a[3], b[3])) < radians and abs(dot(between, a[3])) < metres + radians * norm(between)
    if a[0] == "cylinder":
        return norm(cross(a[3], b[3])) < radians and norm(cross(between, a[3])) < metres + radians * norm(between)
    return norm(between) < metres and norm(minus(a[3], b[3])) < radians


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
                    out[place] = (*other[:5], (min(low, other[5][0]), max(high, other[5][1])), *other[6:])
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
                chords = CHORDS * max(face[4] if face[0] == "cylinder" else 0.0, face[5][1] - face[5][0])
                if lengths < METRES * within(face, other) + chords:
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
        print(row, "", len(told) or "none", flush=True)
        for line in told:
            print("    ", line)
        failed |= bool(told)
    sys.exit(failed)


if __name__ == "__main__":
    main()
