"""What the package says of one model file, judged by an independently followed branch of the same mechanism.

Every position is asked for marked. A position that the branch reaches must be given, with the branch's
positions, velocities, accelerations, reactions and driver efforts; one that lies beyond a limit must not be.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from tests.reference.adapted_loads import reference_loads
from tests.reference.adapter import driver_values, link_points, reference_system, starting_position
from tests.reference.agreement import Comparison, forces_comparison, motion_comparison
from tests.reference.branch import Branch, Follower, Law
from tests.reference.laws import kinks
from tests.reference.multibody import Array, Motion, Multibody, Unreachable

TOLERANCE = 1e-11
ROUNDING = 300 * np.finfo(float).eps  # times the square of the condition number
COARSEST = 1e-5
SELF_CHECK = 1e-12  # of the package's own forces and speeds, up to which its own checks are rounding
EXCUSED = 1e-4  # nearness to a singular position, at which it may be refused as singular
JUMP = 1e-5  # of the mechanism's size: an error of a position that is no rounding

AGREES, LIMIT, UNSURE = "agrees", "agrees up to a limit", "reference is not sure"
GOOD = (AGREES, LIMIT)


@dataclass
class Verdict:
    """`kind` sorts it for the summary; `lines` say what is wrong; `notes` counts what became of positions."""

    kind: str
    lines: list[str] = field(default_factory=list)
    positions: int = 0
    notes: dict[str, int] = field(default_factory=dict)

    @property
    def good(self) -> bool:
        return self.kind in GOOD


@dataclass
class Expected:
    """Poses at all positions (NaN where the branch does not come), and how sure their absence is."""

    q: Array
    forward: int
    folds: bool


def judge(text: str, steps: int) -> Verdict:
    """The verdict on the model `text`, its cycle solved in `steps`."""
    import linkwright as lw

    try:
        mechanism = lw.loads(text)
    except lw.LinkwrightError as error:
        return Verdict("not read", [str(error)])
    except Exception as error:
        return Verdict("crash", [f"reading: {error!r}"])
    try:
        motion = lw.solve_motion(mechanism, steps=steps, failures="mark")
    except lw.LinkwrightError as error:
        return Verdict("not solved", [f"{type(error).__name__}: {error}"])
    except Exception as error:
        return Verdict("crash", [f"motion: {error!r}"])
    verdict = _judged_motion(mechanism, motion, care=1.0)
    if verdict.kind not in (*GOOD, UNSURE):
        careful = _judged_motion(mechanism, motion, care=5.0)
        return careful if careful.kind != verdict.kind or careful.good else verdict
    return verdict


def _judged_motion(mechanism: Any, motion: Any, care: float) -> Verdict:
    system = reference_system(mechanism)
    expected = _expected(mechanism, system, motion.time, care)
    reached = np.isfinite(expected.q[:, 0, 0])
    if not reached.any():
        silent = motion.ok & _unsaid(motion)
        if not silent.any():
            return Verdict(LIMIT, [], len(reached))
        if not silent[0] or not _without_a_way(mechanism, system, motion, care):
            lines = [f"{silent.sum()} given, but the drawn branch does not reach the first position"]
            return Verdict("beyond a limit", lines)
        expected = _expected(mechanism, system, motion.time, care, _poses(system, mechanism, motion, 0))
        reached = np.isfinite(expected.q[:, 0, 0])
    reference = _rates(mechanism, system, expected.q, motion.time)
    nearness, condition = _nearness(reference, reached)
    verdict = Verdict(AGREES if reached.all() else LIMIT, [], len(reached))
    verdict.notes = _counted(motion.outcomes)
    forward = np.arange(len(reached)) < expected.forward
    refused = np.flatnonzero(forward & ~motion.ok & ~(nearness < EXCUSED))
    beyond = np.flatnonzero(~reached & motion.ok & _unsaid(motion))
    if not expected.folds and (len(refused) or len(beyond)):
        return Verdict(UNSURE, [f"the branch ends after {expected.forward} positions without a fold"])
    if len(refused):
        said = motion.outcomes[int(refused[0])].sentence
        verdict.lines.append(f"{len(refused)} refused, the first is {refused[0]} of {len(reached)}: {said}")
        verdict.kind = "refused"
    if len(beyond):
        verdict.lines.append(f"{len(beyond)} given beyond the branch's end, the first is {beyond[0]}")
        verdict.kind = "beyond a limit"
    both = reached & motion.ok
    _compare_motion(mechanism, motion, reference, both, condition, verdict)
    if verdict.good:
        _compare_forces(mechanism, motion, reference, both & forward, condition, verdict)
    return verdict


def _unsaid(motion: Any) -> Array:
    """Positions before which no failed position and no note warns that the way is interrupted, (n,)."""
    silent: Array = (np.cumsum(~motion.ok) == 0) & (not motion.notes)
    return silent


def _counted(outcomes: Iterable[Any]) -> dict[str, int]:
    kinds = [outcome.kind for outcome in outcomes]
    return {kind: kinds.count(kind) for kind in dict.fromkeys(kinds)}


# the branch ----------------------------------------------------------------------------------------------
def _expected(mechanism: Any, system: Multibody, time: Array, care: float, first: Array | None = None) -> Expected:
    """The branch through the drawing, or through the poses `first` of the first position, at all times."""
    poses = np.full((len(time), system.count, 3), np.nan)
    begin, end = float(time[0]), float(time[-1])
    whole = _period(mechanism) or max(end - begin, 1e-3)
    if first is None:
        first = _first_position(mechanism, system, begin, care)
    if first is None:
        return Expected(poses, 0, True)
    law, breaks = _law(mechanism, whole), sorted(t for d in mechanism.drivers.values() for t in kinks(d.law))
    forward = _along(system, law, first, time, breaks, whole, care)
    u = driver_values(mechanism, time)[0]
    for k, q in enumerate(forward.q):
        poses[k] = system.assemble(q, u[k])
    folds = len(forward.q) == len(time) or forward.ends_in_a_fold()
    shift = _closure(mechanism, begin, whole)
    if len(forward.q) < len(time) and shift is not None:
        earlier = time[::-1][: len(time) - len(forward.q)] - whole

        def before(t: float) -> tuple[Array, Array, Array]:
            u, ud, udd = law(t + whole)
            return u - shift, ud, udd

        breaks = [t - whole for t in breaks]
        back = _along(system, before, first, np.concatenate([time[:1], earlier]), breaks, whole, care)
        for k, q in enumerate(back.q[1:]):
            poses[len(time) - 1 - k] = system.assemble(q, u[len(time) - 1 - k] - shift)
    return Expected(poses, len(forward.q), folds)


def _first_position(
    mechanism: Any, system: Multibody, begin: float, care: float, links: Collection[str] | None = None
) -> Array | None:
    """The position at the cycle's beginning, on the straight way from the drawn driver coordinates.

    A single turning driver goes the shorter way or, where the branch ends on it, the other way round. With `links`
    only these are followed, which must not hang on others.
    """
    goal = driver_values(mechanism, np.array([begin]))[0][0]
    q, u0 = starting_position(mechanism, system, goal)
    if links is not None:
        system, q = system.part(links), q[system.places(links)]
    if np.abs(goal - u0).max(initial=0.0) < 1e-14:
        return q
    turning = np.array([mechanism.joints[d.joint].kind == "revolute" for d in mechanism.drivers.values()])
    ways = [goal - u0]
    if turning.sum() == 1:
        ways.append(ways[0] - np.where(turning, 2 * np.pi * np.sign(ways[0]), 0.0))
    for way in ways:
        branch = Follower(system, _straight(u0, way), care).follow(q, 0.0, [1.0], 1.0)
        if branch.q:
            return branch.q[0]
    return None


def _without_a_way(mechanism: Any, system: Multibody, motion: Any, care: float) -> bool:
    """Whether the first position is the drawing's assembly although no regular way of all links joins them.

    A dyad has its mode by the drawing, whatever lies between; a larger group must be reached on the way, with the
    links that it hangs on, and the whole determinant has the sign that it has in the drawing.
    """
    q, u = _poses(system, mechanism, motion, 0), driver_values(mechanism, motion.time[:1])[0][0]
    if np.abs(system.residual(q, u)).max() > JUMP:
        return False
    drawn, _ = starting_position(mechanism, system, u)
    if len({float(np.linalg.slogdet(system.jacobian(at)[:, 3:])[0]) for at in (q, drawn)}) > 1:
        return False
    links = _below_larger_groups(mechanism, motion.structure.groups)
    if not links:
        return True
    found = _first_position(mechanism, system, float(motion.time[0]), care, links)
    if found is None:
        return False
    gap = found - q[system.places(links)]
    gap[:, 2] = np.angle(np.exp(1j * gap[:, 2]))
    return bool(np.abs(gap).max() < JUMP)


def _below_larger_groups(mechanism: Any, groups: Sequence[Any]) -> set[str]:
    """Links of the groups without closed form and all links that these hang on."""
    needed = {link for group in groups if len(group.unknowns) > 2 for link in group.links}
    for group in reversed(groups):
        own = set(group.links)
        if own & needed:
            joints = [joint.joined for joint in mechanism.joints.values() if own & {*joint.joined}]
            earlier = {link for g in groups[: groups.index(group)] for link in g.links}
            needed |= own | {link for joined in joints for link in joined if link in earlier}
    return needed


def _poses(system: Multibody, mechanism: Any, motion: Any, k: int) -> Array:
    """The package's poses of all bodies at position k, the frame first, (bodies, 3)."""
    found = [_pose(mechanism, motion, body.name)[k] for body in system.bodies]
    return np.concatenate([np.zeros((1, 3)), found])


def _straight(begin: Array, way: Array) -> Law:
    return lambda s: (begin + s * way, way, np.zeros_like(way))


def _along(
    system: Multibody,
    law: Law,
    q: Array,
    times: Sequence[float] | Array,
    breaks: Sequence[float],
    whole: float,
    care: float,
) -> Branch:
    """The branch at `times` (monotonic), piece by piece between the laws' kinks."""
    found = Branch([], float(times[0]), 1.0)
    way = 1.0 if times[-1] >= times[0] else -1.0
    inside = sorted(
        (t for t in breaks if 0 < way * (t - times[0]) < way * (times[-1] - times[0])), key=lambda t: way * t
    )
    begin = float(times[0])
    for end in [*inside, float(times[-1])]:
        asked = [float(t) for t in times if way * begin <= way * t <= way * end and (t != begin or not found.q)]
        goals = asked if asked and asked[-1] == end else [*asked, end]
        part = Follower(system, _within(law, begin, end, whole), care).follow(q, begin, goals, whole)
        found = Branch(found.q + part.q[: len(asked)], part.end, part.nearness, found.steps + part.steps)
        if len(part.q) < len(goals):
            break
        begin, q = end, part.q[-1]
    return found


def _within(law: Law, begin: float, end: float, whole: float) -> Law:
    """The law with the slopes that it has between two kinks, at them too."""
    low, high = min(begin, end) + 1e-12 * whole, max(begin, end) - 1e-12 * whole
    return lambda t: law(min(max(t, low), high)) if low < high else law(t)


def _law(mechanism: Any, whole: float) -> Law:
    def law(t: float) -> tuple[Array, Array, Array]:
        u, ud, udd = driver_values(mechanism, np.array([t]))
        return u[0], ud[0], udd[0]

    return law


def _period(mechanism: Any) -> float | None:
    if mechanism.cycle is not None and mechanism.cycle.duration is not None:
        return float(mechanism.cycle.duration)
    law = next(iter(mechanism.drivers.values())).law
    if mechanism.cycle is None and getattr(law, "speed", 0.0):
        return float(2 * np.pi / abs(law.speed))
    return None


def _closure(mechanism: Any, begin: float, whole: float) -> Array | None:
    """Whole turns by which the drivers' coordinates differ after the cycle; None where it does not close."""
    u = driver_values(mechanism, np.array([begin, begin + whole]))[0]
    gap = u[1] - u[0]
    turning = [mechanism.joints[d.joint].kind == "revolute" for d in mechanism.drivers.values()]
    turns = np.where(turning, 2 * np.pi * np.round(gap / (2 * np.pi)), 0.0)
    return turns if np.abs(gap - turns).max(initial=0.0) < 1e-9 else None


# comparison ----------------------------------------------------------------------------------------------
def _rates(mechanism: Any, system: Multibody, q: Array, time: Array) -> Motion:
    """The reference's motion at all positions, NaN where the branch does not come."""
    reached = np.isfinite(q[:, 0, 0])
    u, ud, udd = (row[reached] for row in driver_values(mechanism, time))
    part = system.rates(q[reached], u, ud, udd)
    full = []
    for values in (part.q, part.qd, part.qdd, part.jac):
        whole = np.full((len(time), *values.shape[1:]), np.nan)
        whole[reached] = values
        full.append(whole)
    return Motion(system, *full)


def _nearness(reference: Motion, reached: Any) -> tuple[Array, Array]:
    """Smallest singular value as a share of the branch's best, and the condition number, per position."""
    nearness, condition = (np.full(len(reached), np.nan) for _ in range(2))
    singular = np.linalg.svd(reference.jac[reached][..., 3:], compute_uv=False)
    nearness[reached] = singular[:, -1] / singular[:, -1].max()
    condition[reached] = singular[:, 0] / singular[:, -1]
    return nearness, condition


def _allowed(condition: Array) -> Array:
    return np.minimum(TOLERANCE + ROUNDING * condition**2, COARSEST)


def _compare_motion(
    mechanism: Any, motion: Any, reference: Motion, where: Any, condition: Array, verdict: Verdict
) -> None:
    if not where.any():
        return
    size = float(np.abs(reference.q[where, :, :2]).max())
    motion.columns()  # evaluates most of what is judged in one program
    poses = np.stack([_pose(mechanism, motion, body.name) for body in reference.system.bodies], 1)
    gap = np.abs(poses[where] - reference.q[where, 1:])
    gap[..., 2] = np.abs(np.angle(np.exp(1j * gap[..., 2])))
    far = np.maximum(gap[..., :2].max(axis=(1, 2)) / size, gap[..., 2].max(axis=1)) > JUMP
    if far.any():
        verdict.kind = "other branch"
        k = int(np.flatnonzero(where)[np.argmax(far)])
        signs = len(set(np.linalg.slogdet(_jacobian(reference.system, poses[where]))[0]))
        verdict.lines.append(f"{far.sum()} of {where.sum()} on another branch, first {k} (signs seen: {signs})")
        return
    with np.errstate(invalid="ignore"):
        found = motion_comparison(mechanism, motion, reference)
    _judge_numbers(found, where, condition, _motion_floors(reference), verdict)


def _pose(mechanism: Any, motion: Any, name: str) -> Array:
    """Place of the origin of the link's axes and its angle, (n, 3), from the package's results."""
    point, local = next(iter(link_points(mechanism, name).items()))
    link = motion.link(name)
    x, y = link.direction.T
    turned = np.stack([x * local[0] - y * local[1], y * local[0] + x * local[1]], -1)
    place = motion.point(f"{name}.{point}").position - turned
    return np.column_stack([place, np.arctan2(y, x)])


def _jacobian(system: Multibody, poses: Array) -> Array:
    frame = np.zeros((len(poses), 1, 3))
    jac: Array = system.jacobian(np.concatenate([frame, poses], axis=1))[..., 3:]
    return jac


def _motion_floors(reference: Motion) -> dict[str, Array]:
    """Scale of each kind at every position, so that what is exactly zero is compared with its kin."""
    size = max(float(np.nanmax(np.abs(reference.q[:, 1:, :2]))), 1e-3)
    rates, seconds = np.abs(reference.qd[:, 1:]), np.abs(reference.qdd[:, 1:])
    speed = np.maximum(rates[..., :2].max(axis=(1, 2)), rates[..., 2].max(axis=1) * size) + 1e-12
    sudden = np.maximum(seconds[..., :2].max(axis=(1, 2)), seconds[..., 2].max(axis=1) * size)
    sudden = np.maximum(sudden, speed**2 / size)
    return {
        "position": np.full(len(speed), size),
        "direction": np.ones(len(speed)),
        "velocity": speed,
        "acceleration": sudden,
        "angular velocity": speed / size,
        "angular acceleration": sudden / size,
    }


def _judge_numbers(
    found: Comparison, where: Any, condition: Array, floors: dict[str, Array], verdict: Verdict
) -> None:
    """Adds a line for each quantity that differs by more than rounding at its position."""
    allowed = _allowed(condition[where])
    for kind, pairs in found.pairs.items():
        columns = [np.abs(expected[where]).reshape(where.sum(), -1).max(axis=1) for _, _, expected in pairs]
        scale = np.maximum(np.max(columns, axis=0), floors[kind][where])
        for what, ours, expected in pairs:
            gap = np.abs(ours[where] - expected[where]).reshape(where.sum(), -1).max(axis=1)
            wrong = ~(gap <= allowed * scale)
            if wrong.any():
                k = int(np.argmax(np.where(np.isfinite(gap), gap / scale, np.inf)))
                verdict.kind = "wrong number"
                verdict.lines.append(
                    f"{kind} of {what}: off by {gap[k]:.3g} of {scale[k]:.3g} at position "
                    f"{np.flatnonzero(where)[k]} (condition {condition[where][k]:.3g})"
                )


def _compare_forces(
    mechanism: Any, motion: Any, reference: Motion, where: Any, condition: Array, verdict: Verdict
) -> None:
    import linkwright as lw

    if not where.any():
        return
    try:
        forces = lw.solve_forces(motion)
        forces.columns()  # all numbers by one program
    except lw.LinkwrightError as error:
        verdict.kind = "forces refused"
        verdict.lines.append(str(error))
        return
    except Exception as error:
        verdict.kind = "crash"
        verdict.lines.append(f"forces: {error!r}")
        return
    with np.errstate(invalid="ignore", divide="ignore"):
        expected = reference.forces(reference_loads(mechanism, reference, motion.time))
        found = forces_comparison(mechanism, forces, expected)
    size = max(float(np.nanmax(np.abs(reference.q[:, 1:, :2]))), 1e-3)
    sizes = [np.abs(w.force).max(axis=1) + np.abs(w.torque) / size for w in expected.wrenches]
    sizes.append(_inertia_scale(mechanism, reference, size))
    sizes += _damping_scales(mechanism, reference, size)
    largest = np.max(sizes, axis=0) + 1e-6
    _judge_numbers(found, where, condition, {"force": largest, "moment": largest * size}, verdict)
    _judge_checks(mechanism, forces, reference, where, size, verdict)


def _inertia_scale(mechanism: Any, reference: Motion, size: float) -> Array:
    """Largest force that accelerations of this mechanism's scale demand, (n,).

    An acceleration that is zero for one link is known as exactly as those of the others.
    """
    links = mechanism.links.values()
    heaviest = max((max(link.mass, (link.inertia or 0.0) / size**2) for link in links), default=0.0)
    return np.asarray(heaviest * _motion_floors(reference)["acceleration"])


def _damping_scales(mechanism: Any, reference: Motion, size: float) -> list[Array]:
    """Forces of dampers at this mechanism's speeds, each (n,): ends that stay together part by their rounding."""
    speed = _motion_floors(reference)["velocity"]
    arms = {"damper": 1.0, "torsion_damper": size**2}
    return [a.damping * speed / arms[a.kind] for a in mechanism.loads.values() if a.kind in arms]


def _judge_checks(mechanism: Any, forces: Any, reference: Motion, where: Any, size: float, verdict: Verdict) -> None:
    """The package's own checks: beside its own forces and speeds nothing is left but rounding, however near a
    position is to a singular one."""
    own = _own_forces(mechanism, forces, size)[where]
    limits = {"power_residual": own * _motion_floors(reference)["velocity"][where], "balance_residual": own}
    for name, scale in limits.items():
        value = np.abs(getattr(forces, name)[where])
        if not (value <= SELF_CHECK * scale).all():
            verdict.kind = "wrong number"
            verdict.lines.append(f"{name} is {np.nanmax(value / scale):.3g} of its scale")


def _own_forces(mechanism: Any, forces: Any, size: float) -> Array:
    """The largest force of the package's results at every position, (n,) N; moments over the machine's size."""
    found = [np.zeros(forces.steps)]
    for name, joint in mechanism.joints.items():
        for link in joint.joined:
            found.append(np.hypot(*forces.reaction(name, on=link).T))
            found.append(np.abs(forces.couple(name, on=link)) / size)
    for name, driver in mechanism.drivers.items():
        turns = mechanism.joints[driver.joint].kind == "revolute"
        found.append(np.abs(forces.driver_effort(name)) / (size if turns else 1.0))
    return np.asarray(np.max(found, axis=0))


def judged(text: str, steps: int) -> Verdict:
    """As `judge`, with what the reference itself cannot do told apart."""
    try:
        return judge(text, steps)
    except (Unreachable, np.linalg.LinAlgError, NotImplementedError) as error:
        return Verdict(UNSURE, [repr(error)])
