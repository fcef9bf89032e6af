#!/usr/bin/env bash
# gscrew 1.1.0: the inverse of a multivector is rounded to five decimals, dividing by one gives 0; adding a screw to another moves the other.
#
# A module for screws and coscrews in geometric algebra. inverse() solves its equations in double precision and then rounds every number to five
# decimals, whatever its size: a vector of length 3 times its inverse is 0.99999, one of length 3000 (a bar in millimetres) 0.99, and the inverse
# of one of length 300000 is 0. Any multivector divided by another is 0, which its documentation allows. change_point "computes and returns" a screw on another point: it
# changes the screw itself. So adding two wrenches that are given at two points takes the second one to the point of the first, and its moment, read
# afterwards, is another one. show(point), which is to print, does it too.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check gscrew==1.1.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import contextlib
import importlib.metadata
import io
import sys
import numpy
from gscrew.geometric_algebra import GeometricAlgebra
from gscrew.screw import Screw

blades = GeometricAlgebra(3).blades
e1, e2, e3 = (blades[name] for name in ("e1", "e2", "e3"))
print("gscrew", importlib.metadata.version("gscrew"))
products = {}
for length in (3, 3000, 300000):
    vector = length * e1
    products[length] = float((vector * vector.inverse()).value[0])
    print(f"a vector of length {length} times its inverse: {products[length]:g}")
quotient = (6 * e1 + 2 * e2) / (3 * e1)
print("(6 e1 + 2 e2) / (3 e1):", quotient.value.tolist())


def moment(screw):
    return numpy.round(screw.moment.value, 9).tolist()


origin, away = 0 * e1, 2 * e1
nothing = 0 * (e1 * e2)
first = Screw(origin, e3, nothing)
second = Screw(away, e2, nothing)
before = moment(second), second.ref_point == away
total = first + second
after = moment(second), second.ref_point == origin
print("the second wrench at its point: moment", before[0], "; after the addition:", after[0], "at the point of the first:", after[1])
third = Screw(away, e2, nothing)
with contextlib.redirect_stdout(io.StringIO()):
    third.show(origin)
print("after show() at the origin:", moment(third))
zero = [0.0] * 8
sys.exit(not (quotient.value.tolist() == zero and before == (zero, True) and after[0] != zero and after[1] and moment(third) == after[0]
              and numpy.allclose([products[length] for length in (3, 3000, 300000)], [0.99999, 0.99, 0], atol=1e-9)))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
