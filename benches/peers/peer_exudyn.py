"""exudyn: rigid bodies with Euler parameters, joints as constraints between their markers."""

import time

import exudyn as exu
import exudyn.utilities as eu
import numpy as np

from mechanism import Unsupported, frame_along, rates_of_one_turn

VERSION = exu.__version__

# Which of x y z, rotations about x y z of the joint's frame are constrained. Frame: z along `axis`.
CONSTRAINED = {
    "fixed": [1, 1, 1, 1, 1, 1],
    "revolute": [1, 1, 1, 1, 1, 0],
    "prismatic": [1, 1, 0, 1, 1, 1],
    "cylindrical": [1, 1, 0, 1, 1, 0],
    "planar": [0, 0, 1, 1, 1, 0],
    "spherical": [1, 1, 1, 0, 0, 0],
    "universal": [1, 1, 1, 0, 0, 1],
    "line_on_plane": [1, 0, 0, 0, 0, 1],
    "point_on_plane": [0, 0, 1, 0, 0, 0],
}


def build(mechanism, rates=None, relaxed=None, centre=np.zeros(3), gravity=np.zeros(3)):
    """The system, assembled; `rates` are twists of the links at the start, `relaxed` maps joints to other flags. Links have 1 kg at a
    place of their frame and 1 kg m² about it."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    centre = np.asarray(centre, float)
    # About the frame's origin, as Exudyn wants it.
    about = (1 + centre @ centre) * np.eye(3) - np.outer(centre, centre)
    inertia = eu.RigidBodyInertia(mass=1, inertiaTensor=about, com=centre)
    bodies = {}
    for name, at in mechanism.links.items():
        if name == mechanism.ground:
            bodies[name] = mbs.CreateGround(referencePosition=at[:3, 3], referenceRotationMatrix=at[:3, :3])
            continue
        w, v = rates[name] if rates else (np.zeros(3), np.zeros(3))
        bodies[name] = mbs.CreateRigidBody(
            inertia=inertia, referencePosition=at[:3, 3], referenceRotationMatrix=at[:3, :3],
            initialVelocity=v, initialAngularVelocity=w, gravity=list(gravity),
        )
    for j in mechanism.joints:
        if j.kind == "floating":
            continue
        if j.kind not in CONSTRAINED:
            raise Unsupported(f"no joint of type {j.kind}")
        flags = (relaxed or {}).get(j.name, CONSTRAINED[j.kind])
        if j.kind == "universal" and abs(j.axis @ j.axis2) > 1e-12:
            raise Unsupported("universal joint with axes that are not perpendicular")
        # The marker that defines the axes of translation is the first.
        first, second = (j.b, j.a) if j.kind in ("line_on_plane", "point_on_plane") else (j.a, j.b)
        markers = []
        for link in (first, second):
            at = mechanism.links[link]
            local = np.eye(4)
            local[:3, :3] = at[:3, :3].T @ axes_of(j)
            local[:3, 3] = at[:3, :3].T @ (j.point - at[:3, 3])
            if j.kind in ("line_on_plane", "point_on_plane"):
                inside = j.in_a if link == j.a else j.in_b
                local[:3, 3] = inside[:3, 3]
            markers.append(mbs.AddMarker(eu.MarkerBodyRigid(bodyNumber=bodies[link], localHT=local)))
        mbs.AddObject(eu.ObjectJointGeneric(markerNumbers=markers, constrainedAxes=flags))
    mbs.Assemble()
    return container, mbs, bodies


def axes_of(j):
    """The frame of a joint: the one rotation that is constrained, about z, holds x of one marker and y of the other
    perpendicular."""
    if j.kind == "universal":
        return np.column_stack([j.axis, j.axis2, np.cross(j.axis, j.axis2)])
    if j.kind == "line_on_plane":
        return np.column_stack([j.axis2, j.axis, np.cross(j.axis2, j.axis)])
    if j.kind == "point_on_plane":
        return frame_along(j.axis2)
    return frame_along(j.axis) if j.axis is not None else np.eye(3)


def quiet():
    settings = exu.SimulationSettings()
    settings.staticSolver.verboseMode = 0
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    return settings


def count(mechanism):
    """Seconds to build, seconds to count, degrees of freedom."""
    t0 = time.perf_counter()
    container, mbs, _ = build(mechanism)
    t1 = time.perf_counter()
    answer = mbs.ComputeSystemDegreeOfFreedom(simulationSettings=quiet())
    t2 = time.perf_counter()
    return t1 - t0, t2 - t1, int(answer["degreeOfFreedom"])


SERVO = 1000.0


def flat(mechanism, rates):
    """The same mechanism of hinges about z in the plane: three coordinates a link, two constraints a joint."""
    container = exu.SystemContainer()
    mbs = container.AddSystem()
    bodies = {}
    for name, at in mechanism.links.items():
        if name == mechanism.ground:
            bodies[name] = mbs.AddObject(eu.ObjectGround(referencePosition=at[:3, 3]))
            continue
        if abs(at[:3, :3] - np.eye(3)).max() > 1e-12:
            raise Unsupported("links turned at home")
        w, v = rates[name]
        node = mbs.AddNode(eu.NodeRigidBody2D(referenceCoordinates=[*at[:2, 3], 0], initialVelocities=[v[0], v[1], w[2]]))
        bodies[name] = mbs.AddObject(eu.ObjectRigidBody2D(physicsMass=1, physicsInertia=1, nodeNumber=node))
    for j in mechanism.joints:
        if j.kind != "revolute" or abs(j.axis - [0, 0, 1]).max() > 1e-12:
            raise Unsupported("joints that are not hinges about z")
        markers = []
        for link, inside in ((j.a, j.in_a), (j.b, j.in_b)):
            markers.append(mbs.AddMarker(eu.MarkerBodyRigid(bodyNumber=bodies[link], localPosition=inside[:3, 3])))
        mbs.AddObject(eu.ObjectJointRevolute2D(markerNumbers=markers))
    return container, mbs, bodies


def turn(mechanism, crank, rates, setting):
    """One turn of the crank at 1 rad/s by a velocity servo: a function that runs it, and one that looks at every pose.

    `setting`: `steps` per turn, `model` (`spatial`, `relaxed`, `planar`), `index` 2 or 3, `tolerance` of Newton's method.
    """
    steps = setting["steps"]
    driven = next(j for j in mechanism.joints if j.name == crank)
    closing = mechanism.chords()[0]

    def system(sensors):
        if setting["model"] == "planar":
            container, mbs, bodies = flat(mechanism, rates)
        else:
            relaxed = {closing.name: setting["flags"]} if setting["model"] == "relaxed" else None
            container, mbs, bodies = build(mechanism, rates, relaxed)
        markers = []
        for link in (driven.a, driven.b):
            local = np.eye(4)
            local[:3, :3] = mechanism.links[link][:3, :3].T @ frame_along(driven.axis)
            local[:3, 3] = (np.linalg.inv(mechanism.links[link]) @ np.r_[driven.point, 1])[:3]
            markers.append(mbs.AddMarker(eu.MarkerBodyRigid(bodyNumber=bodies[link], localHT=local)))
        mbs.AddObject(eu.TorsionalSpringDamper(markerNumbers=markers, stiffness=0, damping=SERVO, velocityOffset=1.0))
        watched = {}
        if sensors:
            for link, body in bodies.items():
                if link != mechanism.ground:
                    watched[link] = [
                        mbs.AddSensor(eu.SensorBody(bodyNumber=body, storeInternal=True, outputVariableType=v))
                        for v in (exu.OutputVariableType.Position, exu.OutputVariableType.RotationMatrix)
                    ]
        mbs.Assemble()
        settings = quiet()
        time_ = settings.timeIntegration
        time_.endTime, time_.numberOfSteps = 2 * np.pi, steps
        time_.adaptiveStep = False
        time_.generalizedAlpha.spectralRadius = 0.7
        time_.generalizedAlpha.useIndex2Constraints = time_.generalizedAlpha.useNewmark = setting["index"] == 2
        time_.newton.useModifiedNewton = setting["newton"] == "modified"
        time_.newton.relativeTolerance, time_.newton.absoluteTolerance = setting["tolerance"], setting["tolerance"] * 1e-2
        settings.solution.sensors.writePeriod = 2 * np.pi / steps / 2
        if setting["model"] == "spatial":
            settings.linearSolver.solverType = exu.LinearSolverType.EigenDense
            settings.linearSolver.ignoreSingularJacobian = True
        return container, mbs, bodies, settings, watched

    def run():
        container, mbs, bodies, settings, _ = system(False)
        t0 = time.perf_counter()
        mbs.SolveDynamic(settings)
        seconds = time.perf_counter() - t0
        return seconds, 0

    def look():
        container, mbs, bodies, settings, watched = system(True)
        mbs.SolveDynamic(settings)
        rotations, positions = {}, {}
        for link, (p, r) in watched.items():
            positions[link] = mbs.GetSensorStoredData(p)[:, 1:4]
            rotations[link] = mbs.GetSensorStoredData(r)[:, 1:10].reshape(-1, 3, 3)
        n = len(positions[link])
        at = mechanism.links[mechanism.ground]
        positions[mechanism.ground] = np.tile(at[:3, 3], (n, 1))
        rotations[mechanism.ground] = np.tile(at[:3, :3], (n, 1, 1))
        return rotations, positions

    return run, look


def turn_settings():
    rows = [("planar", 3, "full"), ("planar", 3, "modified"), ("planar", 2, "full"), ("relaxed", 3, "full"),
            ("relaxed", 3, "modified"), ("relaxed", 2, "modified"), ("spatial", 3, "full")]
    return [
        {"steps": n, "model": model, "index": index, "newton": newton, "tolerance": 1e-8}
        for model, index, newton in rows
        for n in (12, 24, 60, 240, 1000, 4000)
    ]
