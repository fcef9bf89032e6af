#!/usr/bin/env bash
# steputils 0.1: a STEP file that is read and written again has numbers without a decimal point, which are no reals in STEP.
#
# ISO 10303-21 asks for the point in every real: 1.E-07, not 1E-07, since 1 is an integer and E-07 then belongs to nothing. steputils reads
# 1.E-07, the uncertainty that stands in nearly every STEP file, as a float and writes 1E-07; 1.E+22 becomes 1E+22. Numbers that need
# no exponent get their point (1. is written 1.0). It reads its own output without a complaint. A reader that follows the grammar
# must refuse the file.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check steputils==0.1
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import io
import re
import sys
from steputils import p21

text = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION((''),'2;1');
FILE_NAME('part','2026-01-01T00:00:00',(''),(''),'','','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));
ENDSEC;
DATA;
#1=CARTESIAN_POINT('',(1.,0.123456789012345,-2.5E+3));
#2=CARTESIAN_POINT('',(1.E-07,1.E+22,-4.E-12));
#3=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));
#4=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),#3,'distance_accuracy_value','');
ENDSEC;
END-ISO-10303-21;
"""
real = re.compile(r"[+-]?\d+\.\d*(E[+-]?\d+)?")


def numbers(file):
    lines = [line for line in file.splitlines() if line.startswith(("#1=", "#2=", "#4="))]
    return [word for line in lines for word in re.findall(r"[+-]?\d[\d.]*(?:E[+-]?\d+)?", line.split("(", 1)[1].replace("#3", ""))]


written = io.StringIO()
p21.loads(text).write(written)
before, after = numbers(text), numbers(written.getvalue())
wrong = [word for word in after if not real.fullmatch(word)]
again = p21.loads(written.getvalue()).data[0].get("#2").entity.params[1]
print("read:", before)
print("written:", after)
print("no reals by the grammar:", wrong, "- read again by steputils:", list(again))
print("steputils", importlib.metadata.version("steputils"))
same = [float(word) for word in before] == [float(word) for word in after]
sys.exit(not (all(map(real.fullmatch, before)) and same and wrong == ["1E-07", "1E+22", "-4E-12", "1E-07"] and list(again) == [1e-7, 1e22, -4e-12]))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
