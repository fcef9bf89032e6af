#!/usr/bin/env bash
# python-sdformat 0.4.0 (pysdf): the reference body of a gearbox joint reads "__default__", and is written to an element of no format.
#
# SDFormat's gearbox joint has <gearbox_reference_body>, the link to which both angles are measured. The bindings follow the specification
# element by element, with the names of its elements. Their element is gearbox_reference_bodx: a file that names "frame" reads
# "__default__", and a file that is built or changed through it gets <gearbox_reference_bodx>, which readers of SDFormat
# pass over. Setting gearbox_reference_body raises nothing and writes nothing. The ratio beside it works.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check python-sdformat==0.4.0 numpy==1.26.4
cat > "$folder/try.py" <<'PYTHON'
import sys
import pysdf

start = '<sdf version="1.6"><model name="drive"><link name="frame"/><link name="wheel"/><link name="pinion"/>'
joint = '<joint name="gears" type="gearbox"><parent>wheel</parent><child>pinion</child>'
end = "</joint></model></sdf>"
reference = "<gearbox_ratio>3</gearbox_ratio><gearbox_reference_body>frame</gearbox_reference_body>"

gears = pysdf.SDF.from_xml(start + joint + reference + end).models[0].joints[0]
read = gears.gearbox_reference_bodx
print("read: ratio", gears.gearbox_ratio, "reference body", read, "; has gearbox_reference_body:", hasattr(gears, "gearbox_reference_body"))
file = pysdf.SDF.from_xml(start + joint + end)
gears = file.models[0].joints[0]
gears.gearbox_ratio = 3
gears.gearbox_reference_body = "frame"
silent = file.to_xml()
gears.gearbox_reference_bodx = "frame"
written = file.to_xml()
print("written:", written[written.index("<gearbox") : written.index("</joint>")])
lost = "gearbox_reference" not in silent and "<gearbox_ratio>" in silent
sys.exit(not (read == "__default__" and lost and "<gearbox_reference_bodx>frame<" in written))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
