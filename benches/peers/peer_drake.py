"""Drake: a tree in a MultibodyPlant; the joints that close loops as rows of relative velocity, or as constraints."""

import time
from importlib.metadata import version

import numpy as np
from pydrake.math import RigidTransform, RotationMatrix
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import (
    BallRpyJoint, FixedOffsetFrame, JacobianWrtVariable, PrismaticJoint, RevoluteJoint, ScrewJoint, SpatialInertia,
    UnitInertia,
)

from mechanism import Unsupported

VERSION = version("drake")


def transform(pose):
    return RigidTransform(RotationMatrix(pose[:3, :3]), pose[:3, 3])


def plant_of(mechanism, time_step=0.0):
    """The tree of a mechanism, not finalized, with its bodies by name; between the freedoms of a joint stand bodies of
    no shape."""
    plant = MultibodyPlant(time_step)
    plant.mutable_gravity_field().set_gravity_vector([0, 0, 0])
    inertia = SpatialInertia(1.0, [0, 0, 0], UnitInertia(1, 1, 1))
    small = SpatialInertia(0.1, [0, 0, 0], UnitInertia(1, 1, 1))
    bodies = {mechanism.ground: plant.world_body()}
    poses = {mechanism.ground: np.eye(4)}
    for j, link in mechanism.tree():
        reverse = link == j.a
        sign = -1.0 if reverse else 1.0
        rows = j.chain()[::-1] if reverse else j.chain()
        before = j.b if reverse else j.a
        point = (mechanism.links[j.a] @ j.in_a)[:3, 3] if j.kind == "point_on_plane" else j.point
        for i, (kind, u) in enumerate(rows):
            last = i == len(rows) - 1
            name = link if last else f"{j.name}.{i}"
            bodies[name] = plant.AddRigidBody(name, inertia if last else small)
            poses[name] = mechanism.links[link]
            joint_frame = np.eye(4)
            joint_frame[:3, 3] = point
            f, m = (
                plant.AddFrame(FixedOffsetFrame(
                    f"{j.name}.{i}.{side}", bodies[l].body_frame(), transform(np.linalg.inv(poses[l]) @ joint_frame)))
                for side, l in (("F", before), ("M", name))
            )
            called = j.name if len(rows) == 1 else f"{j.name}.{i}"
            if kind == "turn":
                plant.AddJoint(RevoluteJoint(called, f, m, sign * u))
            elif kind == "slide":
                plant.AddJoint(PrismaticJoint(called, f, m, sign * u))
            elif kind == "screw":
                plant.AddJoint(ScrewJoint(called, f, m, sign * u, j.lead, 0.0))
            else:
                plant.AddJoint(BallRpyJoint(called, f, m))
            before = name
    return plant, bodies


def count(mechanism):
    """Seconds to build, seconds to count, degrees of freedom: velocities less the rank of what the chords forbid."""
    t0 = time.perf_counter()
    plant, bodies = plant_of(mechanism)
    plant.Finalize()
    context = plant.CreateDefaultContext()
    t1 = time.perf_counter()
    rows = []
    world = plant.world_frame()
    for j in mechanism.chords():
        a, b = bodies[j.a], bodies[j.b]
        origin = plant.EvalBodyPoseInWorld(context, b).inverse().translation()
        jacobian = plant.CalcJacobianSpatialVelocity(
            context, JacobianWrtVariable.kV, b.body_frame(), origin, a.body_frame(), world)
        free = j.freedom_screws()
        full = np.linalg.svd(free, full_matrices=True)[0]
        rows.append(full[:, free.shape[1]:].T @ jacobian)
    rank = int(np.linalg.matrix_rank(np.vstack(rows))) if rows else 0
    t2 = time.perf_counter()
    return t1 - t0, t2 - t1, plant.num_velocities() - rank


SERVO = 1000.0


def driven_plant(mechanism, crank, time_step, second_point=1.0):
    plant, bodies = plant_of(mechanism, time_step)
    joint = plant.GetJointByName(crank)
    ends = []
    for j in mechanism.chords():
        for point in (j.point, j.point + second_point * j.axis):
            inside = [(np.linalg.inv(mechanism.links[l]) @ np.r_[point, 1])[:3] for l in (j.a, j.b)]
            ends.append((bodies[j.a], inside[0], bodies[j.b], inside[1]))
    return plant, bodies, joint, ends


def poses_of(plant, context, bodies, seen):
    for link, body in bodies.items():
        at = plant.EvalBodyPoseInWorld(context, body)
        seen.setdefault(link, []).append((at.rotation().matrix(), at.translation()))


def arrays(seen):
    return tuple({l: np.array([row[i] for row in rows]) for l, rows in seen.items()} for i in (0, 1))


def turn(mechanism, crank, rates, setting):
    """One turn of the crank at 1 rad/s: a function that runs it, and one that looks at every pose.

    `setting`: `steps` per turn and `model`, `discrete` (time steps, the hinge closed by two ball constraints, a velocity
    servo within the actuator) or `inverse` (a pose sought for every angle of the crank, from the one before).
    """
    return (simulated if setting["model"] == "discrete" else sought)(mechanism, crank, rates, setting)


def simulated(mechanism, crank, rates, setting):
    from pydrake.multibody.plant import DiscreteContactApproximation
    from pydrake.multibody.tree import PdControllerGains
    from pydrake.systems.analysis import Simulator

    step = 2 * np.pi / setting["steps"]
    plant, bodies, joint, ends = driven_plant(mechanism, crank, step)
    plant.set_discrete_contact_approximation(DiscreteContactApproximation.kSap)
    for end in ends:
        plant.AddBallConstraint(*end)
    actuator = plant.AddJointActuator("motor", joint)
    actuator.set_controller_gains(PdControllerGains(p=0.0, d=SERVO))
    plant.Finalize()

    def start():
        simulator = Simulator(plant)
        context = simulator.get_mutable_context()
        plant.get_desired_state_input_port(actuator.model_instance()).FixValue(context, [0.0, 1.0])
        velocities = np.zeros(plant.num_velocities())
        for j in mechanism.joints:
            if not j.closes:
                velocities[plant.GetJointByName(j.name).velocity_start()] = (rates[j.b][0] - rates[j.a][0]) @ j.axis
        plant.SetVelocities(context, velocities)
        simulator.Initialize()
        return simulator, context

    def run():
        simulator, context = start()
        t0 = time.perf_counter()
        simulator.AdvanceTo(2 * np.pi)
        return time.perf_counter() - t0, 0

    def look():
        simulator, context = start()
        seen = {}
        for i in range(setting["steps"]):
            simulator.AdvanceTo((i + 1) * step)
            poses_of(plant, context, bodies, seen)
        return arrays(seen)

    return run, look


def sought(mechanism, crank, rates, setting):
    from pydrake.multibody.inverse_kinematics import InverseKinematics
    from pydrake.solvers import SnoptSolver, SolverOptions

    plant, bodies, joint, ends = driven_plant(mechanism, crank, 0.0)
    plant.Finalize()
    context = plant.CreateDefaultContext()
    solver, options = SnoptSolver(), SolverOptions()
    options.SetOption(solver.solver_id(), "Major feasibility tolerance", setting["tolerance"])
    at = joint.position_start()

    def solve(seen):
        """Poses that the solver does not call a success are taken too; how many is what this returns."""
        unsure = 0
        problem = InverseKinematics(plant, context, with_joint_limits=False)
        for a, in_a, b, in_b in ends:
            problem.AddPositionConstraint(b.body_frame(), in_b, a.body_frame(), in_a, in_a)
        program, q = problem.prog(), problem.q()
        angle = program.AddBoundingBoxConstraint(0, 0, q[at])
        guess = np.zeros(plant.num_positions())
        before = guess
        for i in range(setting["steps"]):
            value = np.array([2 * np.pi * (i + 1) / setting["steps"]])
            angle.evaluator().set_bounds(value, value)
            result = solver.Solve(program, 2 * guess - before if i else guess, options)
            unsure += not result.is_success()
            before, guess = guess, result.GetSolution(q)
            if seen is not None:
                plant.SetPositions(context, guess)
                poses_of(plant, context, bodies, seen)
        return unsure

    def run():
        t0 = time.perf_counter()
        unsure = solve(None)
        return time.perf_counter() - t0, unsure

    def look():
        seen = {}
        solve(seen)
        return arrays(seen)

    return run, look


def turn_settings():
    return [{"steps": n, "model": "discrete"} for n in (250, 1000, 4000, 16000)] + [
        {"steps": n, "model": "inverse", "tolerance": t} for t in (1e-6, 1e-9, 1e-12) for n in (12, 60, 240)
    ]
