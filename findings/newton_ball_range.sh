#!/usr/bin/env bash
# newton 1.8.0: a ball joint turns without limit, whatever range (MJCF) or cone angles (USD) the file gives it.
#
# MJCF's range of a ball joint bounds its angle of rotation, UsdPhysics' coneAngle0Limit and coneAngle1Limit bound the tilt of its axis;
# both readers of Newton take hinges with their limits. Of a ball of 40 degrees both make a joint with limits of
# -1e10 to 1e10 rad on all three axes, without a warning, where they do warn of other things that are lost. A shoulder or a
# ball socket from such a file swings through its housing.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export WARP_CACHE_PATH="$folder/kernels"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check \
  newton==1.8.0 newton-usd-schemas==0.6.0 usd-core==26.8 warp-lang==1.19.0 mujoco==3.17.0 numpy==2.4.6
cat > "$folder/socket.xml" <<'MJCF'
<mujoco model="socket">
  <worldbody>
    <body name="arm">
      <joint name="joint" TYPE range="0 40"/>
      <geom size="0.1"/>
    </body>
  </worldbody>
</mujoco>
MJCF
cat > "$folder/socket.usda" <<'USD'
#usda 1.0
(
    defaultPrim = "socket"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "socket"
{
    def Xform "arm" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
    )
    {
        float physics:mass = 1
    }
    def PhysicsTYPEJoint "joint"
    {
        rel physics:body1 = </socket/arm>
        uniform token physics:axis = "Z"
        LIMITS
    }
}
USD
cat > "$folder/try.py" <<'PYTHON'
import sys
import warnings
import newton
import numpy
import warp

warp.config.quiet = True
folder = sys.argv[1]


def limits(add, file, changes):
    text = open(f"{folder}/{file}").read()
    for old, new in changes.items():
        text = text.replace(old, new)
    open(f"{folder}/now_{file}", "w").write(text)
    builder = newton.ModelBuilder()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        getattr(builder, add)(f"{folder}/now_{file}")
    model = builder.finalize()
    upper = model.joint_limit_upper.numpy()
    told = [str(each.message) for each in caught if "imit" in str(each.message) or "range" in str(each.message)]
    print(add, changes["TYPE"], "upper limits", upper, "warnings", told)
    return upper, told


cones = "float physics:coneAngle0Limit = 40\n        float physics:coneAngle1Limit = 40"
turn = "float physics:lowerLimit = 0\n        float physics:upperLimit = 40"
hinges = [
    limits("add_mjcf", "socket.xml", {"TYPE": 'type="hinge"'}),
    limits("add_usd", "socket.usda", {"TYPE": "Revolute", "LIMITS": turn}),
]
balls = [
    limits("add_mjcf", "socket.xml", {"TYPE": 'type="ball"'}),
    limits("add_usd", "socket.usda", {"TYPE": "Spherical", "LIMITS": cones}),
]
kept = all(numpy.allclose(numpy.degrees(upper), [40], atol=1e-3) for upper, _ in hinges)
lost = all(len(upper) == 3 and min(upper) >= 1e9 and not told for upper, told in balls)
sys.exit(not (kept and lost))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
