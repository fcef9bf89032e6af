#!/usr/bin/env bash
# dxfwrite 1.2.2: an arc of an ellipse ends one segment before its end angle, and a whole one that begins at -90 degrees has a gap.
#
# dxf.ellipse writes a polyline of so many segments from startangle to endangle. The last point is not written: a quarter in six segments ends at 75
# degrees, the default of 100 segments at 89.1, so that a cam or a slot put together from arcs and lines is open at every arc. A whole ellipse
# hides it, since it is closed; but whether it is one is asked of the angles as they are written, and from -90 to 270, where 0 to 360
# is closed, it stays open by a segment. Read with dxfgrabber 1.0.1.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --disable-pip-version-check --root-user-action ignore --target "$folder/packages" \
  dxfwrite==1.2.2 dxfgrabber==1.0.1
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import dxfgrabber
from dxfwrite import DXFEngine as dxf

path = sys.argv[1] + "/ellipse.dxf"


def written(start, end, **options):
    drawing = dxf.drawing(path)
    drawing.add(dxf.ellipse((0.0, 0.0), 2.0, 1.0, startangle=start, endangle=end, **options))
    drawing.save()
    polyline = next(iter(dxfgrabber.readfile(path).entities))
    x, y = list(polyline.points)[-1][:2]
    return len(polyline.points), math.degrees(math.atan2(y, x / 2)), polyline.is_closed


right = True
for start, end, options, expected in (
    (0, 90, {"segments": 6}, (6, 75, False)),
    (0, 90, {}, (100, 89.1, False)),
    (0, 360, {"segments": 6}, (6, -60, True)),
    (-90, 270, {"segments": 6}, (6, -150, False)),
):
    points, last, closed = written(start, end, **options)
    print(f"from {start} to {end} degrees {options}: {points} points, the last at {last:.4f} degrees, {'closed' if closed else 'open'}")
    right &= (points, closed) == (expected[0], expected[2]) and abs(last - expected[1]) < 1e-4
for name in ("dxfwrite", "dxfgrabber"):
    print(name, importlib.metadata.version(name))
sys.exit(not right)
PYTHON
PYTHONPATH="$folder/packages" python3 "$folder/try.py" "$folder"
