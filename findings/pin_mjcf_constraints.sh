#!/usr/bin/env bash
# pin 4.1.0: of two functions that read the constraints of an MJCF file, the newer one leaves out welds, and both leave out couplings.
#
# buildModelAndConstraintsFromMJCF is documented to return the model "as well as a constraint list if some are present in the MJCF
# file". It returns connects only. A loop closed by a weld is open in its list, which is empty, without an error or a warning;
# buildModelAndLegacyConstraintsFromMJCF gives the same weld as a contact of six rows. A weld with torquescale="0", which holds a
# point and no angle in MuJoCo, is six rows there as well. A joint equality (gears, a mimic) is in neither list.
# So a mechanism of one freedom is simulated with three, and a ball joint as a rigid joint, by whoever trusts the list.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pin==4.1.0 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/chain.xml" <<'MJCF'
<mujoco model="chain">
  <worldbody>
    <body name="a">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <joint name="j1" axis="0 0 1"/>
      <body name="b" pos="1 0 0">
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
        <joint name="j2" axis="0 0 1"/>
        <body name="c" pos="1 0 0">
          <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
          <joint name="j3" axis="0 0 1"/>
        </body>
      </body>
    </body>
  </worldbody>
  <equality>EQUALITY</equality>
</mujoco>
MJCF
cat > "$folder/try.py" <<'PYTHON'
import sys
import mujoco
import pinocchio

cases = {
    "connect": ('<connect body1="a" body2="c" anchor="1 0 0"/>', 1, ["CONTACT_3D"]),
    "weld": ('<weld body1="a" body2="c"/>', 0, ["CONTACT_6D"]),
    "weld of a point": ('<weld body1="a" body2="c" torquescale="0"/>', 0, ["CONTACT_6D"]),
    "coupling": ('<joint joint1="j2" joint2="j1" polycoef="0 -1 0 0 0"/>', 0, []),
}
text = open(sys.argv[1] + "/chain.xml").read()
right = True
for name, (equality, many, kinds) in cases.items():
    path = f"{sys.argv[1]}/{name.replace(' ', '_')}.xml"
    open(path, "w").write(text.replace("EQUALITY", equality))
    equalities = mujoco.MjModel.from_xml_path(path).neq
    found = len(pinocchio.buildModelAndConstraintsFromMJCF(path)[1])
    legacy = [str(c.type).split(".")[-1] for c in pinocchio.buildModelAndLegacyConstraintsFromMJCF(path)[1]]
    print(f"{name}: MuJoCo {equalities}, buildModelAndConstraintsFromMJCF {found}, the legacy function {legacy}")
    right &= (equalities, found, legacy) == (1, many, kinds)
print("versions:", mujoco.__version__, pinocchio.__version__)
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
