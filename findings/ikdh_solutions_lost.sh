#!/usr/bin/env bash
# ikdh 1.2.0: of an arm whose last three axes are parallel, a sixth of the poses are not answered in full, and a tenth not at all.
#
# IKDH is to find all solutions of general six revolute arms. The angles that a pose was made of, with its own forward_kin, must be
# among them. With the last three axes parallel 10 of 60 random poses come back without these angles, six of them with an
# empty list, which a program takes for out of reach. What is returned is right, to 1e-8. A general arm loses none of 60, one with
# its first three axes parallel one.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check ikdh==1.2.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import math
import sys
import ikdh
import numpy

right = math.pi / 2


def examine(name, twist, a, d):
    table = ikdh.DHTable(a, d, twist, [0] * 6)
    solver = ikdh.Solver(table)
    numbers = numpy.random.default_rng(2)
    lost, empty, counts, worst = 0, 0, set(), 0.0
    for _ in range(60):
        q = numbers.uniform(-170, 170, 6)
        pose = ikdh.forward_kin(table, q)
        solutions = [numpy.array(each) for each in solver.solve(pose)]
        lost += not any(numpy.abs((each - q + 180) % 360 - 180).max() < 0.05 for each in solutions)
        empty += not solutions
        counts.add(len(solutions))
        worst = max([worst] + [ikdh.fk_error(ikdh.forward_kin(table, each), pose) for each in solutions])
    print(f"{name}: {lost} of 60 poses lost, {empty} of them empty; counts {sorted(counts)}; worst error {worst:.0e}")
    return lost, empty, worst


d = [0.3, 0.1, 0.12, 0.1, 0.1, 0.2]
general = examine("general", [1.1, 0.7, 1.3, -0.9, 1.2, 0.4], [0.1, 0.4, 0.2, 0.15, 0.1, 0.05], [0.3, 0.1, 0.12, 0.4, 0.1, 0.2])
base = examine("first three parallel", [0, 0, right, -right, right, 0], [0.3, 0.4, 0.2, 0.3, 0.1, 0], [0.3, 0.1, 0.12, 0.4, 0.1, 0.2])
end = examine("last three parallel", [right, right, right, 0, 0, 0], [0.1, 0.2, 0.3, 0.3, 0.3, 0], d)
sys.exit(not (general[0] == 0 and base[0] <= 2 and end[0] >= 5 and end[1] >= 2 and max(general[2], base[2], end[2]) < 1e-12))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
