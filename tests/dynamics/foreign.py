"""Motion under weights by MuJoCo and Exudyn, two multibody codes, against `linkwright.run`.

    python -m tests.dynamics.foreign

Each is asked where it is installed (`pip install mujoco exudyn`, outside the project's environment). Both take equal
steps and miss by their square, so that two step sizes give an extrapolated place. MuJoCo's loops are closed by stiff
springs that follow the step; an open chain it integrates by Runge and Kutta's method of fourth order.

Exit code: 0 every difference within its bound, 1 not.
"""

from __future__ import annotations

import re
import sys
import time
import warnings
from collections.abc import Callable
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from tests.dynamics import models
from tests.reference.multibody import Array

import linkwright as lw

#: Machines with the time of their run, s, and bounds on the places of their points, m, as extrapolated.
CASES = {
    "double pendulum": (models.DOUBLE_PENDULUM, 1.0, {"mujoco": 1e-11, "exudyn": 1e-9}),
    "crank-rocker": (models.CRANK_ROCKER, 1.0, {"mujoco": 1e-9, "exudyn": 2e-8}),
    "five-bar": (models.FIVE_BAR, 0.2, {"mujoco": 1e-10, "exudyn": 1e-9}),
    "triple rocker": (models.TRIPLE_ROCKER, 0.9, {"mujoco": 1e-9, "exudyn": 1e-9}),
}
Places = dict[str, Array]
By = Callable[[lw.Mechanism, float, float], Places]


def by_mujoco(mechanism: lw.Mechanism, end: float, step: float) -> Places:
    """Places of all points at the end, m: the exported model from rest, without its servos."""
    import mujoco

    with TemporaryDirectory() as folder:
        start = lw.solve_motion(mechanism, times=[0.0])
        text = lw.export(start, Path(folder, "a.xml"), timestep=step).read_text("utf-8")
    text = re.sub(r"<actuator>.*</actuator>", "", text, flags=re.DOTALL)
    text = re.sub(r' (armature|act|ctrl)="[^"]*"', "", text).replace('"Euler"', '"RK4"')
    model: Any = mujoco.MjModel.from_xml_string(text)
    data: Any = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    data.qvel[:] = 0.0
    for _ in range(round(end / step)):
        mujoco.mj_step(model, data)
    mujoco.mj_kinematics(model, data)
    names = [model.site(index).name for index in range(model.nsite)]
    return {name: np.array(data.site_xpos[k, :2]) for k, name in enumerate(names) if not name.startswith("frame.")}


def by_exudyn(mechanism: lw.Mechanism, end: float, step: float) -> Places:
    """Places of all points at the end, m: links in redundant coordinates, pins as constraints, trapezoidal rule."""
    import exudyn
    from exudyn import itemInterface as items

    warnings.simplefilter("ignore", DeprecationWarning)
    container = exudyn.SystemContainer()
    system = container.AddSystem()
    start, bodies = (
        lw.run(mechanism, duration=1e-3).motion(times=[0.0]),
        {"frame": system.AddObject(items.ObjectGround())},
    )
    for name, link in mechanism.links.items():
        place, angle = start.link(name).centre.position[0], float(start.link(name).angle[0])
        node = system.AddNode(items.NodeRigidBody2D(referenceCoordinates=[*map(float, place), angle]))
        body = items.ObjectRigidBody2D(nodeNumber=node, physicsMass=link.mass, physicsInertia=link.inertia)
        bodies[name] = system.AddObject(body)
        centre = system.AddMarker(items.MarkerBodyPosition(bodyNumber=bodies[name], localPosition=[0, 0, 0]))
        weight = [link.mass * each for each in (*mechanism.gravity, 0.0)]
        system.AddLoad(items.LoadForceVector(markerNumber=centre, loadVector=weight))
    for name, joint in mechanism.joints.items():
        first, *others = (_marker(system, items, mechanism, bodies, link, name) for link in joint.joined)
        for other in others:
            system.AddObject(items.ObjectJointRevolute2D(markerNumbers=[first, other]))
    system.Assemble()
    settings = exudyn.SimulationSettings()
    integration = settings.timeIntegration
    integration.numberOfSteps, integration.endTime, integration.verboseMode = round(end / step), end, 0
    integration.generalizedAlpha.spectralRadius = 1.0
    integration.generalizedAlpha.useIndex2Constraints = integration.generalizedAlpha.useNewmark = True
    integration.newton.relativeTolerance = 1e-10
    settings.solutionSettings.writeSolutionToFile = False
    system.SolveDynamic(settings)
    return {
        f"{name}.{point}": np.array(
            system.GetObjectOutputBody(
                bodies[name], exudyn.OutputVariableType.Position, [*np.subtract(local, link.centre), 0.0]
            )
        )[:2]
        for name, link in mechanism.links.items()
        for point, local in link.points.items()
    }


def _marker(system: Any, items: Any, mechanism: lw.Mechanism, bodies: dict[str, Any], link: str, point: str) -> Any:
    own = mechanism.link(link)
    local = np.subtract(own.points[point], own.centre if link != "frame" else (0.0, 0.0))
    return system.AddMarker(
        items.MarkerBodyPosition(bodyNumber=bodies[link], localPosition=[*map(float, local), 0.0])
    )


def gaps(text: str, end: float, by: By, step: float) -> tuple[float, float]:
    """Largest distance of a point at the end, m: with the smaller of two steps, and extrapolated."""
    mechanism = lw.loads(text)
    motion = lw.run(mechanism, duration=end, tolerance=1e-12).motion(times=[end])
    coarse, fine = by(mechanism, end, 2 * step), by(mechanism, end, step)
    own = {name: motion.point(name).position[0] for name in fine}
    plain = max(float(np.abs(fine[name] - own[name]).max()) for name in fine)
    better = max(float(np.abs((4 * fine[name] - coarse[name]) / 3 - own[name]).max()) for name in fine)
    return plain, better


def main() -> int:
    worse = False
    for code, by, share in (("mujoco", by_mujoco, 40_000), ("exudyn", by_exudyn, 20_000)):
        if find_spec(code) is None:
            print(f"{code}: not installed")
            continue
        for name, (text, end, bounds) in CASES.items():
            begun = time.perf_counter()
            plain, better = gaps(text, end, by, end / share)
            worse |= not better < bounds[code]
            print(
                f"{code}, {name}, {end} s in {share} steps: {plain:.1e} m, extrapolated {better:.1e} m "
                f"(bound {bounds[code]:.0e}), {time.perf_counter() - begun:.1f} s"
            )
    return int(worse)


if __name__ == "__main__":
    sys.exit(main())
