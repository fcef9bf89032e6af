#!/usr/bin/env bash
# clifford 1.5.1: of its two logarithms of a motion one is NaN for every translation, and the other takes half turns for no turn.
#
# clifford.tools.g3c.rotor_parameterisation has ga_log for motions and general_logarithm for all conformal rotors. ga_log divides by the angle without
# asking whether there is one: a translation, and the identity, come out as NaN. general_logarithm loses the turn where it is by half a turn:
# of the screw by 180 degrees and 2 along its axis it keeps the translation, and interpolate_rotors, which is built on it, gives poses between
# the identity and a half turn that are no turn or the whole one. Elsewhere both agree, up to the sign of the rotor.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check clifford==1.5.1 numpy==2.4.6 scipy==1.17.1
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import numpy
from clifford import general_exp
from clifford.g3c import e1, e2, e3
from clifford.tools.g3c import generate_rotation_rotor, generate_translation_rotor
from clifford.tools.g3c.rotor_parameterisation import ga_log, general_logarithm, interpolate_rotors

screw = generate_translation_rotor(2 * e3)
one = generate_translation_rotor(0 * e1)
cases = {
    "turn by 3 rad": (generate_rotation_rotor(3.0, e1, e2), True, True),
    "screw by 3 rad": (screw * generate_rotation_rotor(3.0, e1, e2), True, True),
    "half turn": (generate_rotation_rotor(math.pi, e1, e2), True, False),
    "screw by half a turn": (screw * generate_rotation_rotor(math.pi, e1, e2), True, False),
    "translation": (generate_translation_rotor(1 * e1 + 2 * e2), False, True),
    "identity": (one, False, True),
}
right = True
for name, (motor, *expected) in cases.items():
    seen = []
    for logarithm in (ga_log, general_logarithm):
        bivector = logarithm(motor)
        if numpy.isnan(bivector.value).any():
            seen.append("NaN")
            continue
        # A rotor and its negative are one motion.
        back = general_exp(bivector)
        off = min(abs((back - motor).value).max(), abs((back + motor).value).max())
        seen.append(f"off by {off:.1e}" if off > 1e-9 else "exact")
    print(f"{name}: exp(ga_log) {seen[0]}, exp(general_logarithm) {seen[1]}")
    right &= [each == "exact" for each in seen] == expected
between = interpolate_rotors(one, cases["half turn"][0], 0.5)
print("half way from nothing to a half turn:", between)
# A quarter turn has cos 45 degrees as its scalar.
right &= abs(abs(between[()]) - math.sqrt(0.5)) > 0.2
print("clifford", importlib.metadata.version("clifford"))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" -W ignore "$folder/try.py"
