"""MuJoCo: a tree of bodies, loops closed by equality constraints."""

import time

import mujoco
import numpy as np

from mechanism import Unsupported, frame_along

VERSION = mujoco.__version__


def quaternion(rotation):
    answer = np.zeros(4)
    mujoco.mju_mat2Quat(answer, np.ascontiguousarray(rotation).reshape(9))
    return answer


def specification(mechanism, second_point=1.0):
    """The model; hinges are closed by two `connect` at points of their axis `second_point` apart, balls by one, all
    else by a helper body on the joint that is welded to the other link."""
    spec = mujoco.MjSpec()
    spec.option.gravity = [0, 0, 0]
    bodies = {mechanism.ground: (spec.worldbody, np.eye(4))}

    def add_body(parent, name, at, mass=1.0):
        above, above_at = bodies[parent]
        offset = np.linalg.inv(above_at) @ at
        body = above.add_body(
            name=name, pos=offset[:3, 3], quat=quaternion(offset[:3, :3]), mass=mass, inertia=[mass] * 3,
            ipos=[0, 0, 0], explicitinertial=True,
        )
        bodies[name] = (body, at)
        return body

    def add_joints(body, at, j, reverse):
        rows = j.chain()[::-1] if reverse else j.chain()
        sign = -1.0 if reverse else 1.0
        inside = (np.linalg.inv(at) @ np.r_[j.point, 1])[:3]
        if j.kind == "point_on_plane":
            inside = (np.linalg.inv(at) @ (mechanism.links[j.a] @ j.in_a)[:, 3])[:3]
        for i, (kind, u) in enumerate(rows):
            name = f"{j.name}.{i}" if len(rows) > 1 else j.name
            if kind == "ball":
                body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_BALL, pos=inside)
                continue
            axis = sign * (at[:3, :3].T @ u)
            if kind in ("turn", "slide"):
                type_ = mujoco.mjtJoint.mjJNT_HINGE if kind == "turn" else mujoco.mjtJoint.mjJNT_SLIDE
                body.add_joint(name=name, type=type_, axis=axis, pos=inside)
            else:
                body.add_joint(name=name + ".slide", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
                body.add_joint(name=name + ".turn", type=mujoco.mjtJoint.mjJNT_HINGE, axis=axis, pos=inside)
                data = np.zeros(mujoco.mjNEQDATA)
                data[1] = j.lead / (2 * np.pi)
                spec.add_equality(type=mujoco.mjtEq.mjEQ_JOINT, objtype=mujoco.mjtObj.mjOBJ_JOINT,
                                  name1=name + ".slide", name2=name + ".turn", data=data)

    for j, link in mechanism.tree():
        at = mechanism.links[link]
        body = add_body(j.a if link == j.b else j.b, link, at)
        add_joints(body, at, j, reverse=link == j.a)

    def equality(kind, a, b, point=None):
        data = np.zeros(mujoco.mjNEQDATA)
        name = lambda l: "world" if l == mechanism.ground else l
        if point is not None:
            at = bodies[a][1]
            data[:3] = (np.linalg.inv(at) @ np.r_[point, 1])[:3]
        else:
            data[10:] = 1.0
        spec.add_equality(type=kind, objtype=mujoco.mjtObj.mjOBJ_BODY, name1=name(a), name2=name(b), data=data)

    for j in mechanism.chords():
        if j.kind == "spherical":
            equality(mujoco.mjtEq.mjEQ_CONNECT, j.a, j.b, j.point)
        elif j.kind == "revolute":
            equality(mujoco.mjtEq.mjEQ_CONNECT, j.a, j.b, j.point)
            equality(mujoco.mjtEq.mjEQ_CONNECT, j.a, j.b, j.point + second_point * j.axis)
        else:
            helper = f"{j.name}.half"
            at = mechanism.links[j.b]
            add_joints(add_body(j.a, helper, at, mass=0.1), at, j, reverse=False)
            equality(mujoco.mjtEq.mjEQ_WELD, helper, j.b)
    return spec


def count(mechanism):
    """Seconds to build, seconds to count, degrees of freedom: velocities less the rank of the equality rows."""
    t0 = time.perf_counter()
    spec = specification(mechanism)
    spec.option.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    model = spec.compile()
    data = mujoco.MjData(model)
    t1 = time.perf_counter()
    mujoco.mj_forward(model, data)
    rows = data.efc_J.reshape(-1, model.nv)[: data.ne]
    freedom = model.nv - (int(np.linalg.matrix_rank(rows)) if len(rows) else 0)
    t2 = time.perf_counter()
    return t1 - t0, t2 - t1, freedom


SERVO = 1000.0


def turn(mechanism, crank, rates, setting):
    """One turn of the crank at 1 rad/s by a velocity servo: a function that runs it, and one that looks at every pose.

    `setting`: steps per turn, `integrator`, `solref` (time constant in steps, or `default`), `closing`.
    """
    spec = specification(mechanism)
    step = 2 * np.pi / setting["steps"]
    spec.option.timestep = step
    spec.option.integrator = getattr(mujoco.mjtIntegrator, "mjINT_" + setting["integrator"].upper())
    spec.option.iterations = 100
    spec.option.tolerance = 1e-12 if setting["solref"] != "default" else 1e-8
    if setting["solref"] != "default":
        for e in spec.equalities:
            e.solref = [setting["solref"] * step, 1.0]
            e.solimp = [0.9999, 0.9999, 0.001, 0.5, 2]
    motor = spec.add_actuator(name="motor", target=crank, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    motor.gainprm[0] = SERVO
    motor.biastype = mujoco.mjtBias.mjBIAS_AFFINE
    motor.biasprm[2] = -SERVO
    model = spec.compile()

    def start():
        data = mujoco.MjData(model)
        for j in mechanism.joints:
            if not j.closes:
                data.qvel[model.joint(j.name).dofadr[0]] = (rates[j.b][0] - rates[j.a][0]) @ j.axis
        data.ctrl[0] = 1.0
        return data

    def run():
        data = start()
        t0 = time.perf_counter()
        mujoco.mj_step(model, data, setting["steps"])
        seconds = time.perf_counter() - t0
        return seconds, 0

    def look():
        data = start()
        poses = []
        for _ in range(setting["steps"]):
            mujoco.mj_step(model, data)
            mujoco.mj_kinematics(model, data)
            poses.append((data.xpos.copy(), data.xmat.copy()))
        at, turned = np.array([p for p, _ in poses]), np.array([r for _, r in poses])
        positions, rotations = {}, {}
        for link in mechanism.links:
            i = 0 if link == mechanism.ground else model.body(link).id
            positions[link], rotations[link] = at[:, i], turned[:, i].reshape(-1, 3, 3)
        return rotations, positions

    return run, look


def turn_settings():
    return [
        {"steps": n, "integrator": integrator, "solref": solref}
        for integrator, solref in (("implicitfast", "default"), ("implicitfast", 2.0), ("discrete", 2.0), ("rk4", 2.0))
        for n in (250, 500, 1000, 4000, 16000, 64000)
    ]
