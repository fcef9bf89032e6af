"""Mechanisms that swing from rest under gravity, in kutzbach, MuJoCo and Exudyn: CPU time for a simulated second at equal error.

    python benches/peers/swing.py --kutzbach target/release/kutzbach [--only four-bar] [--stages 100]

Every link has 1 kg at one place of its frame and 1 kg m² about it, in both. The error is that of where links are after the swing, in
lengths of the mechanism: kutzbach's as it tells it itself (runs in halved steps), MuJoCo's against its own run in the
shortest step with RK4, which the kinetic energies of both tools at the end confirm to be the same motion. Loops are as stiff in
MuJoCo as its integrator bears (a time constant of two steps). Exudyn holds all joints by constraints (index 3, generalized alpha
without damping, dense matrices as planar loops repeat constraints), so that it is asked for small mechanisms only; its error is that
against its own run in a quarter of its shortest step. CPU time of the process, steps alone.
"""

import argparse
import json
import re
import resource
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

from mechanism import read, scissor_lift, write_urdf

ROOT = Path(__file__).resolve().parent.parent.parent
GRAVITY = [0.0, -9.81, 0.0]
CENTRE = [0.5, 0.3, 0.0]
INERTIAL = (f'<inertial><origin xyz="{" ".join(map(str, CENTRE))}"/><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>')
STEPS = {"Euler": (250, 1000, 4000), "RK4": (125, 250, 500, 1000, 2000), "implicit": (250, 1000, 4000)}


def heavy(text, ground):
    """The file with masses, gravity and no other scene."""
    text = re.sub(r"<scene>.*?</scene>", "", text, flags=re.S)
    text = re.sub(r'<link name="([^"]+)"\s*/>',
                  lambda m: m[0] if m[1] == ground else f'<link name="{m[1]}">{INERTIAL}</link>', text)
    scene = f'<scene><gravity xyz="{" ".join(map(str, GRAVITY))}"/></scene>'
    return text.replace("</robot>", scene + "</robot>")


def ours(program, file, duration, wanted):
    """One answer of `simulate --accuracy`, and the CPU time of the run it used."""
    row = [program, "simulate", file, "--budget", "0", "--duration", str(duration), "--format", "json"]
    scene = json.loads(subprocess.run([*row, "--accuracy", str(wanted)], capture_output=True, text=True).stdout)["scene"]
    used = scene["trajectory"]["rows"][scene["trajectory"]["used"]]
    step = used["time_step"]

    # Runs of two lengths: what they differ by is the run alone.
    def cpu(length):
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        again = [program, "simulate", file, "--budget", "0", "--duration", str(length), "--time-step", str(step),
                 "--integrator", "runge-kutta", "--format", "json"]
        subprocess.run(again, capture_output=True, check=True)
        return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before

    short, long = (min(cpu(length) for _ in range(3)) for length in (duration, 3 * duration))
    # The estimate runs the step and its half: three times one run.
    return {"error": used["error"]["worst"], "kinetic": scene["kinetic_energy"], "step": step,
            "cpu": (long - short) / (2 * duration) / 3}


def theirs(mechanism, duration, integrator, per_second):
    import mujoco
    from peer_mujoco import specification

    spec = specification(mechanism)
    spec.option.gravity = GRAVITY
    step = 1.0 / per_second
    spec.option.timestep = step
    spec.option.integrator = getattr(mujoco.mjtIntegrator, "mjINT_" + integrator.upper())
    spec.option.iterations = 100
    spec.option.tolerance = 1e-12
    for body in spec.bodies[1:]:
        body.ipos = CENTRE
    for e in spec.equalities:
        e.solref = [2.0 * step, 1.0]
        e.solimp = [0.9999, 0.9999, 0.001, 0.5, 2]
    model = spec.compile()
    data = mujoco.MjData(model)
    begun = time.process_time()
    mujoco.mj_step(model, data, round(duration * per_second))
    seconds = time.process_time() - begun
    mujoco.mj_forward(model, data)
    mujoco.mj_energyVel(model, data)
    return seconds / duration, data.xpos.copy(), float(data.energy[1])


def in_exudyn(mechanism, duration, per_second):
    """CPU seconds for a simulated second, where the moving links are, and their kinetic energy (J)."""
    import exudyn as exu
    from peer_exudyn import build, quiet

    _, mbs, bodies = build(mechanism, centre=CENTRE, gravity=GRAVITY)
    settings = quiet()
    integration = settings.timeIntegration
    integration.endTime, integration.numberOfSteps = duration, round(duration * per_second)
    integration.generalizedAlpha.spectralRadius = 1.0
    integration.newton.useModifiedNewton = True
    integration.newton.relativeTolerance, integration.newton.absoluteTolerance = 1e-10, 1e-12
    settings.linearSolver.solverType = exu.LinearSolverType.EigenDense
    settings.linearSolver.ignoreSingularJacobian = True
    begun = time.process_time()
    mbs.SolveDynamic(settings)
    seconds = time.process_time() - begun
    moving = [body for name, body in bodies.items() if name != mechanism.ground]
    of = lambda body, what: np.array(mbs.GetObjectOutputBody(body, getattr(exu.OutputVariableType, what), [0, 0, 0]))
    speeds = [np.array(mbs.GetObjectOutputBody(body, exu.OutputVariableType.Velocity, CENTRE)) for body in moving]
    spins = [of(body, "AngularVelocity") for body in moving]
    kinetic = 0.5 * sum(v @ v for v in speeds) + 0.5 * sum(w @ w for w in spins)
    return seconds / duration, np.array([of(body, "Position") for body in moving]), float(kinetic)


def exudyn_rows(mechanism, duration, length):
    """The table of Exudyn, or why there is none."""
    rates = (125, 250, 500, 1000, 2000)
    try:
        _, reference, kinetic = in_exudyn(mechanism, duration, 4 * rates[-1])
    except Exception as failure:  # whatever the peer stumbles over is told, and the others go on
        print(f"  Exudyn: {failure}", flush=True)
        return
    print(f"  Exudyn, reference: kinetic energy {kinetic:.5f} J", flush=True)
    for per_second in rates:
        cpu, places, kinetic = in_exudyn(mechanism, duration, per_second)
        error = np.abs(places - reference).max() / length
        print(f"  Exudyn, {per_second} steps/s: error {error:.1e}, {cpu:.4f} CPU s per second, kinetic energy {kinetic:.5f} J", flush=True)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--kutzbach", required=True)
    arguments.add_argument("--only", nargs="*")
    arguments.add_argument("--stages", type=int, default=100)
    arguments.add_argument("--duration", type=float, default=1.0)
    given = arguments.parse_args()
    subjects = {
        "four-bar": (ROOT / "mechanisms/planar_four_bar.urdf").read_text(),
        "6-UPS": (ROOT / "mechanisms/stewart.urdf").read_text(),
        f"scissor {given.stages}": write_urdf(scissor_lift(given.stages)),
    }
    with tempfile.TemporaryDirectory() as folder:
        for name, text in subjects.items():
            if given.only and name not in given.only:
                continue
            file = Path(folder) / "swing.urdf"
            file.write_text(text)
            mechanism = read(file)
            file.write_text(heavy(text, mechanism.ground))
            print(f"{name}, {given.duration} s from rest")
            for wanted in (1e-3, 1e-4, 1e-6):
                row = ours(given.kutzbach, file, given.duration, wanted)
                print("  kutzbach, wanted {}: error {error:.1e}, {cpu:.4f} CPU s per second, step {step:.2e} s, kinetic energy {kinetic:.5f} J"
                      .format(wanted, **row), flush=True)
            length = np.linalg.norm(theirs(mechanism, 0.001, "RK4", 1000)[1], axis=1).max()
            _, reference, kinetic = theirs(mechanism, given.duration, "RK4", 2 * STEPS["RK4"][-1])
            print(f"  MuJoCo, reference: kinetic energy {kinetic:.5f} J", flush=True)
            for integrator, all_steps in STEPS.items():
                for per_second in all_steps:
                    cpu, places, kinetic = theirs(mechanism, given.duration, integrator, per_second)
                    error = np.abs(places - reference).max() / length
                    print(f"  MuJoCo {integrator}, {per_second} steps/s: error {error:.1e}, {cpu:.4f} CPU s per second, "
                          f"kinetic energy {kinetic:.5f} J", flush=True)
            # Dense matrices: a platform on six legs takes minutes, a lift of 100 stages hours.
            if len(mechanism.links) <= 10:
                exudyn_rows(mechanism, given.duration, length)


if __name__ == "__main__":
    main()
