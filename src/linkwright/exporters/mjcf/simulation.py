"""One cycle of an exported model, run by MuJoCo itself."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.progress import current_progress
from linkwright.errors import RequestError
from linkwright.exporters.export import package
from linkwright.exporters.mjcf.bodies import Chains, Pose, Poses, exact_poses
from linkwright.exporters.mjcf.couplings import gap
from linkwright.exporters.mjcf.drives import controls
from linkwright.exporters.mjcf.loops import cut_name
from linkwright.exporters.results import seconds
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.solve import solve_motion
from linkwright.words import _

#: Positions of a cycle at which a simulation is compared with the exact motion, at most.
COMPARED = 1000


@dataclass(frozen=True)
class Worst:
    """The largest of some distances, m: of what (``name``), and at which value of the input, rad or m."""

    distance: float
    name: str
    at: float


@dataclass(frozen=True)
class MujocoCycle:
    """A cycle of ``steps`` time steps of ``timestep`` s: the largest gap of every cut joint, and the largest
    distance of a point (LINK.POINT) from where :func:`linkwright.solve_motion` has it."""

    steps: int
    timestep: float
    gaps: Mapping[str, Worst]
    off: Worst

    @property
    def gap(self) -> Worst:
        """The largest gap; of no joint where nothing is cut."""
        return max(self.gaps.values(), key=lambda each: each.distance, default=Worst(0.0, "", 0.0))


def one_cycle(content: bytes, chains: Chains) -> MujocoCycle:
    """Runs an exported model for the duration of its motion, with the controls that its drivers' laws demand.

    Raises LinkwrightError where MuJoCo is not installed, nothing drives the machine, or its motion is not complete.
    """
    mechanism, motion = chains.mechanism, chains.motion
    if not mechanism.drivers:
        raise RequestError(
            _(
                "nothing drives {name!r}, so there is no cycle to be simulated",
                code="export.nothing_driven",
                name=mechanism.name,
            )
        )
    if not motion.complete:
        raise motion.refusal()
    mujoco = package("mujoco", _("simulations in MuJoCo"))
    model: Any = mujoco.MjModel.from_xml_string(content.decode())
    data: Any = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    step = float(model.opt.timestep)
    steps = max(1, round(seconds(motion) / step))
    start = float(motion.time[chains.index])
    times = np.linspace(start, start + steps * step, steps + 1)
    if not motion.positions.closed:
        times = np.minimum(times, motion.time.max())
    signals = controls(mechanism, times)
    every = max(1, steps // COMPARED)
    places, values, progress = [], [], current_progress()
    for number in range(steps + 1):
        if number % every == 0:
            if progress is not None:
                progress(number, steps)
            mujoco.mj_kinematics(model, data)
            places.append(np.concatenate([data.xpos[:, :2], data.xmat[:, [0, 3]]], axis=1))
            values.append(np.array(data.qpos))
        data.ctrl[:] = signals[number]
        mujoco.mj_step(model, data)
    bodies = [model.body(index).name for index in range(model.nbody)]
    poses = _poses(bodies, np.array(places))
    names = [model.joint(index).name for index in range(model.njnt)]
    coordinates = dict(zip(names, np.array(values).T, strict=True))
    return _compared(chains, steps, step, poses, coordinates, times[::every])


def _poses(bodies: list[str], places: Floats) -> Poses:
    """Places of bodies (n, bodies, x y cos sin) by name."""
    found = {
        name: Pose(places[:, k, 0] + 1j * places[:, k, 1], places[:, k, 2] + 1j * places[:, k, 3])
        for k, name in enumerate(bodies)
    }
    return {**found, "frame": found["world"]}


def _compared(
    chains: Chains, steps: int, step: float, poses: Poses, values: Mapping[str, Floats], times: Floats
) -> MujocoCycle:
    """Gaps of the cut joints, and distances from the exact motion at the times."""
    exact = solve_motion(chains.mechanism, times=times, failures="mark")
    right = exact_poses(exact)
    gaps = {cut_name(cut): _worst(gap(chains, cut, poses, values), cut.joint, exact) for cut in chains.cuts}
    off = [
        _worst(np.abs(poses[name].of(place) - right[name].of(place)), f"{name}.{point}", exact)
        for name, link in chains.mechanism.links.items()
        for point, place in link.points.items()
    ]
    return MujocoCycle(steps, step, gaps, max(off, key=lambda each: each.distance))


def _worst(distances: Floats, name: str, exact: Motion) -> Worst:
    """The largest distance at a position that is reached; infinite where the simulation has no numbers."""
    found = np.where(exact.ok, np.where(np.isfinite(distances), distances, np.inf), 0.0)
    worst = int(found.argmax())
    return Worst(float(found[worst]), name, float(exact.input[worst]))
