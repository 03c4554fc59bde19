"""A cam that keeps an output of its machine constant in a zone of the cycle: a bed in step with its cylinder."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arguments import require
from linkwright.core.arrays import Floats
from linkwright.core.outputs import NAMED, PLACES, Output
from linkwright.core.quantity import SHOWN, shown
from linkwright.core.table import Amount, Table, Tabular
from linkwright.errors import RequestError
from linkwright.joints.cam import CamJoint
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import output_meant
from linkwright.kinematics.solve import solve_motion
from linkwright.laws.polynomial import from_conditions, powers
from linkwright.laws.traced import LiftCurve
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import offered
from linkwright.words import _

#: Positions of the cycle; corrections of the lift; minimum change of the output per lift that counts.
_STEPS, _CORRECTIONS, _NO_EFFECT = 1440, 6, 1e-6
#: A trial lift: share of the machine's size of a follower that slides; rad of one that swings.
_TRIAL = 1e-3


_NOT_ONE_TURN = _(
    "the cam has to turn once in a closed cycle that is passed completely with its follower at rest",
    code="cams.compensation_cycle",
)


@dataclass(frozen=True)
class CompensatingCam(Tabular):
    """A machine whose cam keeps an output constant in a zone.

    ``mechanism``: with the lifts found; ``joint``: its cam; ``output``: what is constant; ``zone``: values of the
    first driver's coordinate (rad or m) between which it is; ``angles`` (k,) rad and ``lifts`` (k,) m or rad of the
    cam; ``before``, ``after``: by how much the output varies in the zone with the follower at rest and with the cam,
    SI.
    """

    mechanism: Mechanism
    joint: str
    output: Output
    zone: tuple[float, float]
    angles: Floats
    lifts: Floats
    before: float
    after: float

    @property
    def lift_dimension(self) -> str:
        """``length`` of a follower that is guided, ``angle`` of one that swings."""
        joint: Any = self.mechanism.joints[self.joint]
        return "angle" if joint.side else "length"

    def tables(self, language: str = "en") -> tuple[Table, ...]:
        """What is held constant where, and how well."""
        output, kind = str(self.output), self.output.dimension
        first, last = (shown(each, self.mechanism.across) for each in self.zone)
        title = _(
            "{output} is constant by {joint} while the input goes from {first} to {last}",
            output=output,
            joint=self.joint,
            first=first,
            last=last,
        )
        rows = (
            (_("{output} varies in it, follower at rest, by", output=output), Amount(self.before, kind)),
            (_("with the cam by"), Amount(self.after, kind)),
            (_("total lift"), Amount(float(np.ptp(self.lifts)), self.lift_dimension)),
        )
        return (Table(rows=rows, title=title),)

    def data(self) -> dict[str, Any]:
        """Plain data, SI."""
        return {
            "joint": self.joint,
            "output": str(self.output),
            "zone": list(self.zone),
            "before": self.before,
            "after": self.after,
            "angles": self.angles.tolist(),
            "lifts": self.lifts.tolist(),
        }

    def columns(self) -> dict[str, Floats]:
        """The table of the lift as files give it: angles in degrees, lifts in mm or degrees."""
        unit, factor = SHOWN[self.lift_dimension]
        return {"angle [°]": np.degrees(self.angles), f"lift [{unit}]": factor * self.lifts}


def compensating_cam(
    machine: Mechanism,
    output: str,
    *,
    joint: str = "",
    zone: tuple[float, float] | None = None,
    span: float | None = None,
    steps: int = _STEPS,
) -> CompensatingCam:
    """The cam that makes an output constant while the machine goes through a zone.

    The output's values with the follower at rest give the lift that would keep it constant, by its change with the
    lift; where that is not the same for every lift, the lift is corrected by Newton's method. Outside the zone the
    follower returns smoothly, see :func:`compensating_lift`.

    Args:
        machine: with a cam joint; its lift so far does not matter.
        output: what is to be constant: an output that the model names, a coordinate, an angle, a displacement.
        joint: the cam; may be left out where there is one only.
        zone: values of the first driver's coordinate, rad or m, where the zone begins and ends.
        span: instead of it how long the zone is: the one in which the output varies least with the follower at rest.
        steps: positions of the cycle.

    Raises:
        LinkwrightError: no such output or cam, no zone, a zone that is too long, a cycle that is not passed or in
            which the cam does not turn once, an output that the lift does not change.
    """
    require(machine, Mechanism)
    cam, meant = _cam(machine, joint), output_meant(machine, output)
    if meant.kind not in (*PLACES, *NAMED) or meant.is_point:
        raise RequestError(
            _(
                '"{name}" cannot be held constant; give an output that the model names, a point\'s '
                "coordinate, an angle or a displacement",
                code="cams.compensated_output",
                name=output,
            )
        )
    return _Search(machine, cam, meant, steps).found(zone, span)


def _cam(machine: Mechanism, name: str) -> CamJoint:
    cams = {each.name: each for each in machine.joints.values() if isinstance(each, CamJoint)}
    if not cams:
        raise RequestError(
            _(
                '"{machine}" has no cam; give a follower a joint of kind cam',
                code="cams.no_cam_joint",
                machine=machine.name,
            )
        )
    if name not in cams and (name or len(cams) > 1):
        raise RequestError(
            _('which cam? "{name}" is none{hint}', code="cams.which_cam_joint", name=name, hint=offered(name, cams))
        )
    return cams[name] if name else next(iter(cams.values()))


class _Search:
    """The lift of one cam; arrays over the positions of two turns of the cam, its angles increasing."""

    def __init__(self, machine: Mechanism, cam: CamJoint, output: Output, steps: int) -> None:
        self.machine, self.cam, self.output, self.steps = machine, cam, output, steps
        slides = (each.joined for each in machine.joints.values() if each.coordinate == "slide")
        guided = any(cam.follower in joined for joined in slides)
        self.trial = _TRIAL * machine.size if guided else _TRIAL
        still = self._motion(LiftCurve(np.array([0.0, math.tau]), np.array([[0.0]])))
        if not still.positions.closed or not still.ok.all():
            raise RequestError(_NOT_ONE_TURN)
        turned = self._turned(still)
        turns = round(float(turned[-1] - turned[0]) / math.tau)
        if abs(turns) != 1:
            raise RequestError(_NOT_ONE_TURN)
        self.backwards = turns < 0
        self.angles = self._twice(turned, math.tau * turns)
        self.input, self.values = self._of(still)
        moved = self._motion(LiftCurve(np.array([0.0, math.tau]), np.array([[self.trial]])))
        self.slope = (self._of(moved)[1] - self.values) / self.trial

    def found(self, zone: tuple[float, float] | None, span: float | None) -> CompensatingCam:
        """The cam for a zone, or for the best one that is so long."""
        if (zone is None) == (span is None):
            raise RequestError(
                _("give either a zone, two values of the input, or how long it is to be", code="cams.zone_or_span")
            )
        first, last = self._between(zone) if zone is not None else self._quietest(abs(span or 0.0))
        inside = slice(first, last + 1)
        before = float(np.ptp(self.values[inside]))
        if float(np.abs(self.slope[inside]).min()) <= _NO_EFFECT:
            raise RequestError(
                _(
                    'the lift of "{joint}" does not change "{output}" in the zone',
                    code="cams.compensation_no_effect",
                    output=str(self.output),
                    joint=self.cam.name,
                )
            )
        ends = (float(self.input[first]), float(self.input[last])) if zone is None else self._in_order(zone)
        turns, values = self._angles_at(ends, first, last), self.values
        wanted, best = -values / self.slope, None
        for _unused in range(_CORRECTIONS):
            lifts = compensating_lift(
                self.angles, wanted, turns, beyond=min(BEYOND, 0.1 * (math.tau - turns[1] + turns[0]))
            )
            made = self._with(LiftCurve.through(*map(_tuple, lifts)), *lifts)
            values = self._of(solve_motion(made, steps=self.steps))[1]
            after = float(np.ptp(values[inside]))
            if best is not None and after >= 0.5 * best.after:
                break
            best = CompensatingCam(made, self.cam.name, self.output, ends, *lifts, before, after)
            wanted = wanted - (values - values[inside].mean()) / self.slope
        assert best is not None
        return best

    def _in_order(self, zone: tuple[float, float]) -> tuple[float, float]:
        """The ends of a zone in the order in which the cam's angle grows."""
        low, high = sorted(zone)
        return (low, high) if self.input[-1] > self.input[0] else (high, low)

    def _angles_at(self, ends: tuple[float, float], first: int, last: int) -> tuple[float, float]:
        """The cam's angles at the ends of a zone, between its outermost positions and their neighbours."""
        sign = 1.0 if self.input[-1] > self.input[0] else -1.0
        low, high = max(first - 1, 0), min(last + 2, len(self.input))
        found = np.interp([sign * each for each in ends], sign * self.input[low:high], self.angles[low:high])
        return float(found[0]), float(found[1])

    def _between(self, zone: tuple[float, float]) -> tuple[int, int]:
        """The positions at the ends of a zone of inputs, the first of both turns."""
        if not all(map(math.isfinite, zone)):
            raise RequestError(
                _("give either a zone, two values of the input, or how long it is to be", code="cams.zone_or_span")
            )
        low, high = sorted(zone)
        inside = np.flatnonzero((self.input >= low - 1e-9) & (self.input <= high + 1e-9))
        if len(inside) < 3 or self.angles[inside[-1]] - self.angles[inside[0]] > 0.95 * math.tau:
            raise RequestError(BEYOND_ANGLES)
        return int(inside[0]), int(inside[-1])

    def _quietest(self, span: float) -> tuple[int, int]:
        """The ends of the interval of the input, of this length, in which the output varies least."""
        half, step = self.steps, abs(float(self.input[1] - self.input[0]))
        count = round(span / step)
        if not 2 <= count < 0.95 * half:
            raise RequestError(BEYOND_ANGLES)
        ranges = [float(np.ptp(self.values[k : k + count + 1])) for k in range(half)]
        first = int(np.argmin(ranges))
        return first, first + count

    def _motion(self, curve: LiftCurve) -> Motion:
        return solve_motion(self._with(curve, (), ()), steps=self.steps, failures="mark")

    def _with(self, curve: LiftCurve, angles: object, lifts: object) -> Mechanism:
        """The machine with another lift."""
        cam = replace(self.cam, curve=curve.text, program=None, angles=_tuple(angles), lifts=_tuple(lifts))
        return replace(self.machine, joints={**self.machine.joints, cam.name: cam})

    def _turned(self, motion: Motion) -> Floats:
        """The cam's angle on its carrier from where the lift begins, in the sense of the lift, rad."""
        turned = motion.link(self.cam.cam).angle - motion.link(self.cam.carrier).angle
        return np.asarray(self.cam.sense * (turned - self.cam.phase))

    def _of(self, motion: Motion) -> tuple[Floats, Floats]:
        """The input and the output of a motion over two turns."""
        values, q = motion.read(self.output), motion.input
        period = motion.positions.period or 0.0
        end = solve_motion(motion.mechanism, times=[float(motion.time[0]) + period])
        gain = float(end.read(self.output)[0] - values[0]) if self.output.kind in NAMED else 0.0
        if self.output.kind == "angle":
            gain = math.tau * round((values[-1] - values[0]) / math.tau)
        return self._twice(q, float(end.input[0] - q[0])), self._twice(values, gain)

    def _twice(self, values: Floats, gain: float) -> Floats:
        """Values of two turns, by increasing angles of the cam."""
        twice = np.concatenate([values, values + gain])
        return twice[::-1] if self.backwards else twice


def _tuple(values: object) -> tuple[float, ...]:
    return tuple(map(float, values))  # type: ignore[call-overload]


_TURN = 2 * math.pi
#: Angle by which the lift is carried on beyond its zone before it leaves it, rad; places of a table.
BEYOND, _PLACES = math.radians(8.0), 180


BEYOND_ANGLES = _(
    "the zone with what lies beyond it on both sides is not within the angles, or "
    "nearly a full turn; give a smaller zone",
    code="cams.compensation_zone",
)


def compensating_lift(
    angles: ArrayLike, wanted: ArrayLike, zone: tuple[float, float], *, places: int = _PLACES, beyond: float = BEYOND
) -> tuple[Floats, Floats]:
    """Angles (k,) of a turn of the cam (rad) and lifts (k,) that are as wanted in the zone and return smoothly.

    ``angles`` (n,) rad, increasing, and ``wanted`` (n,) m (or rad): what the follower should do, from a solved
    motion; they must reach ``beyond`` the ``zone`` (from, to) on both sides. Outside, polynomials of order 7 lead to
    a dwell and back with continuous velocity, acceleration and jerk. The smallest lift is zero. Use them as
    ``angles`` and ``lifts`` of a cam in a model file, through which a periodic spline of order 5 goes.

    Raises RequestError.
    """
    from scipy.interpolate import make_interp_spline

    x, y = np.asarray(angles, dtype=float), np.asarray(wanted, dtype=float)
    low, high = zone[0] - beyond, zone[1] + beyond
    if x.ndim != 1 or x.shape != y.shape or len(x) < 12 or not (np.diff(x) > 0).all():
        raise RequestError(
            _(
                "angles and wanted lifts do not fit: give as many of both, twelve or more, the angles increasing",
                code="cams.compensation_points",
            )
        )
    if not low < high < low + 0.95 * _TURN or x[0] > low or x[-1] < high:
        raise RequestError(BEYOND_ANGLES)
    near = slice(max(int(np.searchsorted(x, low)) - 8, 0), int(np.searchsorted(x, high)) + 8)
    spline = make_interp_spline(x[near], y[near], k=7 if len(x[near]) > 16 else 5)
    away = _Return(
        [float(spline(high, nu=k)) for k in range(4)], [float(spline(low, nu=k)) for k in range(4)], high, low + _TURN
    )
    at = low + _TURN * np.arange(places) / places
    lift = np.where(at <= high, spline(np.minimum(at, high)), away(at))
    at = at % _TURN
    order = np.argsort(at)
    return at[order], (lift - lift.min())[order]


class _Return:
    """From the derivatives at ``start`` to rest, a dwell, and from rest to those at ``end``: polynomials of order 7.

    Level of the dwell and length of the passages are those with the smallest acceleration.
    """

    def __init__(self, first: list[float], last: list[float], start: float, end: float) -> None:
        self.start, self.end = start, end
        levels = np.linspace(min(first[0], last[0]), max(first[0], last[0]), 5)
        spread = max(float(np.ptp(levels)), abs(first[1]), abs(last[1]))
        levels = np.unique(np.concatenate([levels, levels.mean() + spread * np.linspace(-1.0, 1.0, 21)]))
        best = np.inf
        u = np.linspace(0.0, 1.0, 65)
        for width in np.linspace(0.15, 0.5, 8) * (end - start):
            for level in levels.tolist():
                passages = [_passage(each, level, width, back) for each, back in ((first, False), (last, True))]
                curvature = max(float(np.abs(powers(u, passage)[2]).max()) for passage in passages) / width**2
                if curvature < best:
                    best, self.level, self.width, self.passages = curvature, level, float(width), passages

    def __call__(self, x: Floats) -> Floats:
        """Lift (n,) at angles between start and end, elsewhere the nearest end."""
        left = np.clip((x - self.start) / self.width, 0.0, 1.0)
        right = np.clip((x - self.end) / self.width + 1.0, 0.0, 1.0)
        falls, rises = powers(left, self.passages[0])[0], powers(right, self.passages[1])[0]
        return np.asarray(falls + rises - self.level)


def _passage(ends: list[float], level: float, width: float, back: bool) -> tuple[float, ...]:
    """Coefficients over u from 0 to 1 between the derivatives ``ends`` and rest at a level."""
    moving = [each * width**k for k, each in enumerate(ends)]
    resting = [level, 0.0, 0.0, 0.0]
    return from_conditions(resting, moving) if back else from_conditions(moving, resting)
