#!/usr/bin/env bash
# pymoca 0.12.0: Modelica translated to SymPy has lost its parentheses: a spring's k * (x - rest) / (2 * m) becomes k * x - rest / 2 * m.
#
# pymoca translates Modelica for computer algebra systems: CasADi, SymPy, XML. The parser builds the right tree, and the flattened model and the
# CasADi backend have it. The SymPy backend writes each operation as its left side, its sign and its right side, without parentheses,
# and Python reads the text by its own precedence. A mass of 2 at rest at the end of a spring of length 1 is not accelerated in the model and
# by -4 in the translation; the stiffness is four times as high. The class that is generated can be solved, linearised and simulated, and says nothing.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pymoca==0.12.0 sympy==1.14.0 scipy==1.17.1 jinja2==3.1.6 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import pymoca.backends.sympy.generator
import pymoca.parser
import sympy

MODEL = """
model Spring
  parameter Real k = 3;
  parameter Real rest = 1;
  parameter Real m = 2;
  Real x(start = 1);
  Real v(start = 0);
equation
  der(x) = v;
  der(v) = -k * (x - rest) / (2 * m);
end Spring;
"""
tree = pymoca.parser.parse(MODEL)
text = pymoca.backends.sympy.generator.generate(tree, "Spring")
line = next(line.strip() for line in text.splitlines() if line.strip().startswith("(v).diff"))
names = {}
exec(text, names)
model = names["Spring"]()
k, rest, m = model.p
x, v = model.x
right = -k * (x - rest) / (2 * m)
print("pymoca", importlib.metadata.version("pymoca"))
print("written:", line)
found = []
for place in (1, 1.5, 2):
    values = {k: 3, rest: 1, m: 2, x: place, v: 0}
    found.append((float(model.f[1].subs(values)), float(right.subs(values))))
    print(f"at x = {place} the translation is accelerated by {found[-1][0]:g}, the model by {found[-1][1]:g}")
slope = sympy.diff(model.f[1], x).subs({k: 3, m: 2}), sympy.diff(right, x).subs({k: 3, m: 2})
print("change per length:", *slope)
sys.exit(not (found == [(-4, 0), (-5.5, -0.375), (-7, -0.75)] and slope == (-3, sympy.Rational(-3, 4)) and "(x - rest)" not in line))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
