"""Motion under forces over a time: from event to event, with an energy balance as the residual."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

import numpy as np

from linkwright.core.arguments import require
from linkwright.core.arrays import Floats
from linkwright.core.progress import Progress, current_progress
from linkwright.dynamics.conditions import End, conditions_of
from linkwright.dynamics.equation import EquationOfMotion
from linkwright.dynamics.impacts import Impacts
from linkwright.dynamics.integration import AT_ONCE, Method, Piece, Stepper, StepTooSmall, Watched
from linkwright.dynamics.result import Happening, Run
from linkwright.dynamics.settling import freedoms_held, go_by_gaps, settle, settle_anew
from linkwright.dynamics.singular import SingularPositions, Stretch
from linkwright.dynamics.system import ZERO, Holding, System
from linkwright.errors import LinkwrightError
from linkwright.kinematics.positions import coordinate_text
from linkwright.mechanism.mechanism import Mechanism
from linkwright.mechanism.run_conditions import RunConditions, Until
from linkwright.words import Message, _
from linkwright.words.message import together

#: Below this share of the largest inertia there is none; how far around a start that is looked for, rad or size.
MASSLESS, ABOUT = 1e-6, 0.1
#: Below this share of the machine's size a stop is touched, not behind, where a run begins.
BEHIND = 1e-7
#: A gap that is rounding, as share of the largest one seen.
NO_GAP = 1e-12
#: Times this near, as share of the time or s, are one.
SAME_TIME = 1e-9
#: Change of the speed from turn to turn below which a run is steady, as share of the speed.
STEADY = 1e-8


def run(
    mechanism: Mechanism,
    *,
    duration: float | None = None,
    turns: float | None = None,
    until: Until | None = None,
    at_most: float | None = None,
    at: float | Mapping[str, float] | None = None,
    speed: float | Mapping[str, float] | None = None,
    prescribed: Iterable[str] | None = None,
    tolerance: float = 1e-10,
    method: Method = "explicit",
    progress: Progress | None = None,
) -> Run:
    """Motion of a machine under its loads and actuators: drivers' coordinates are free, their laws do not hold.

    Arguments go before the file's section ``run``.

    Args:
        mechanism: what runs.
        duration: time of the run, s (default: 1 s).
        turns: ends after so many turns of the first driver, either way.
        until: ``steady``: ends where a turn is as the one before; ``rest``: where nothing moves any more.
        at_most: longest time with ``turns`` or ``until``, s (default: 600 s).
        at: coordinates where it begins, rad or m, of the first driver or by name; those of the drawing by default.
        speed: rates with which it begins, rad/s or m/s; rest by default.
        prescribed: drivers whose laws hold, whatever forces that takes.
        tolerance: relative error of a step.
        method: ``explicit`` (DOP853), or ``implicit`` (Radau) for stiff springs and motors.

    Returns:
        The run; its residual is the work of all forces less the kinetic energy.

    Raises:
        LinkwrightError: no coordinate is free, nothing has inertia, a position that the machine cannot reach, steps
            that become too small.
        StructureError, AssemblyError: as :func:`linkwright.solve_motion`.

    Example:
        >>> import linkwright as lw
        >>> found = lw.run(lw.load("gallery:crank_rocker"), duration=0.1)
        >>> found.end
        0.1
    """
    require(mechanism, Mechanism)
    conditions = conditions_of(mechanism, duration, turns, until, at_most, at, speed, prescribed)
    return _Course(mechanism, conditions, tolerance, method, progress or current_progress()).go()


class _Course:
    """One run."""

    def __init__(
        self,
        mechanism: Mechanism,
        conditions: RunConditions,
        tolerance: float,
        method: Method,
        progress: Progress | None,
    ) -> None:
        self.mechanism, self.conditions, self.progress = mechanism, conditions, progress
        self.first = EquationOfMotion(mechanism, prescribed=conditions.prescribed)
        if not self.first.free:
            raise LinkwrightError(
                _(
                    "all drivers of {name!r} are prescribed, so nothing is left that forces could move; leave one "
                    "out of prescribed",
                    code="dynamics.nothing_free",
                    name=mechanism.name,
                )
            )
        self.positions, self.t = SingularPositions(self.first), 0.0
        self.system, self.y = self._start()
        self.end = End.of(conditions)
        self.begin = self.system.drivers(self.t, self.y)[self.first.free[0]][0]
        self.heaviest = self._inertia_about()
        self.impacts = Impacts()
        self.lost = 0.0
        self.at_once = 0
        self.pieces: list[Piece] = []
        self.happened: list[Happening] = []
        self.sections: list[Floats] = []
        self.residual, self.largest = 0.0, 0.0
        self.tolerance = tolerance
        self.stepper = Stepper(tolerance, self._absolute(), method, self._ends)

    @property
    def equation(self) -> EquationOfMotion:
        """The equation of motion by which it goes now."""
        return self.system.equation

    # the start ------------------------------------------------------------------------------------------
    def _start(self) -> tuple[System, Floats]:
        first, laws = self.first, self.mechanism.drivers
        q, w = first.start.copy(), np.zeros(len(first.names))
        for k, name in enumerate(first.names):
            if name in first.free:
                q[k], w[k] = self.conditions.at.get(name, q[k]), self.conditions.speed.get(name, 0.0)
            else:
                q[k], w[k] = (float(each[0]) for each in laws[name].law.coordinate(np.zeros(1))[:2])
        stretch, q, w = self.positions.first(q, w)
        return System(stretch), self._state(stretch, q, w, 0.0)

    @staticmethod
    def _state(stretch: Stretch, q: Floats, w: Floats, work: float) -> Floats:
        equation = stretch.description.equation
        own = [equation.names.index(name) for name in equation.free]
        return np.array([*q[own], *w[own], work])

    def _absolute(self) -> Floats:
        """Absolute errors of a step, from what forces do in the first radian, or the size of the machine."""
        n, system, out = len(self.equation.free), self.system, self._outputs()
        if out[system.place["outcome"]] != 0.0 or not np.isfinite(out[: n + 1]).all():
            self._refuse_start(out)
        ways = [1.0 if self.equation.rotary[name] else self.mechanism.size for name in self.equation.free]
        w = np.abs(self.y[n : 2 * n])
        rates = np.maximum(w, np.sqrt(np.abs(out[:n]) * ways))
        rates = np.where(rates > 0.0, rates, 1.0)
        energy = 0.5 * float(rates @ np.abs(system.mass(out)) @ rates)
        return self.tolerance * np.array([*ways, *rates, energy or 1.0])

    def _inertia_about(self) -> Floats:
        """The largest inertia of each free coordinate, (free,) kg·m² or kg, here and a little to both sides."""
        system, found, carried = self.system, np.zeros(len(self.equation.free)), self.system.carried
        for k, name in enumerate(self.equation.free):
            unit = ABOUT * (1.0 if self.equation.rotary[name] else self.mechanism.size)
            for side in (-unit, unit, 0.0):
                y = self.y.copy()
                y[k] += side
                inertia = np.diag(system.mass(system.evaluate(system.full, self.t, y)))
                found = np.fmax(found, inertia)
                system.set_inputs(carried)
        return found

    def _refuse_start(self, out: Floats) -> None:
        where = self._where(self.y)
        if out[self.system.place["outcome"]] != 0.0:
            raise LinkwrightError(
                _(
                    "{name!r} cannot be put together where the run begins, at {where}; begin at another position",
                    code="dynamics.start_out_of_reach",
                    name=self.mechanism.name,
                    where=where,
                )
            )
        self._refuse_without_inertia()

    def _refuse_without_inertia(self) -> None:
        raise LinkwrightError(
            _(
                "nothing with a mass moves with the input of {name!r} at {where}, so forces give it no acceleration; "
                "give its links masses and moments of inertia, or begin at another position",
                code="dynamics.no_inertia",
                name=self.mechanism.name,
                where=self._where(self.y),
            )
        )

    def _where(self, y: Floats) -> str:
        """The free drivers' coordinates in words."""
        found, rotary = self.system.drivers(self.t, y), self.first.rotary
        return together([coordinate_text(name, found[name][0], rotary[name]) for name in self.first.free])

    # the ends -------------------------------------------------------------------------------------------
    def _ends(self, t: float, y: Floats) -> Floats:
        """Positive until the turns are made, or the next full turn is complete."""
        if self.end.turns is not None:
            return np.array([2.0 * math.pi * self.end.turns - self._turned_by(t, y)])
        if self.end.until == "steady":
            return np.array([2.0 * math.pi * (len(self.sections) + 1) - self._turned_by(t, y)])
        return np.empty(0)

    def _turned_by(self, t: float, y: Floats) -> float:
        """How far the first free driver has turned, either way."""
        name = self.first.free[0]
        own = float(y[0]) if self.equation.free[0] == name else self.system.drivers(t, y)[name][0]
        return abs(own - self.begin)

    def _section(self) -> bool:
        """Whether the turn that ends here is as the one before."""
        found = self.system.drivers(self.t, self.y)
        self.sections.append(np.array([found[name][1] for name in self.first.free]))
        if len(self.sections) < 2:
            return False
        last, before = self.sections[-1], self.sections[-2]
        return bool(np.abs(last - before).max() <= STEADY * np.abs(last).max())

    def _resting(self) -> bool:
        """Whether all is held, and nothing is going to switch with the time."""
        system, n = self.system, len(self.equation.free)
        if not system.holding.constrained or self.y[n : 2 * n].any() or freedoms_held(system, self.t, self.y) < n:
            return False
        return not any(self._pending(k) for k in range(len(system.surfaces)))

    def _pending(self, index: int) -> bool:
        """Whether a surface goes by the time alone and is still ahead."""
        system = self.system
        if system.surfaces[index].by_rate:
            return False
        return bool(system.holding.sides[index] * system.gap_rates(self._outputs())[index] < 0.0)

    # the way --------------------------------------------------------------------------------------------
    def go(self) -> Run:
        """The run; what was found stays where it is interrupted."""
        note: Message | None = None
        try:
            self._first_holding()
            going = not self._rests()
            while going and self.t < self.end.time:
                going = self._piece()
        except KeyboardInterrupt:
            note = _("interrupted at {time:.6g} s", code="dynamics.interrupted", time=self.t)
        if self.end.until == "steady" and self.happened and self.happened[-1].kind == "rest":
            note = _(
                "it comes to rest at {where} instead of running steadily: forces hold it there",
                code="dynamics.stalls",
                where=self._where(self.y),
            )
        elif self.end.until and self.t >= self.end.time:
            note = _(
                "not {state} after {time:.6g} s; give at_most a longer time",
                code="dynamics.not_until",
                state=_("steady") if self.end.until == "steady" else _("at rest"),
                time=self.t,
            )
        return Run(
            self.mechanism, self.first, tuple(self.pieces), tuple(self.happened), self.residual, self.largest, note
        )

    def _first_holding(self) -> None:
        self.y = settle_anew(self.system, self.t, self.y, self._touching())
        self.kinetic = self._kinetic()

    def _kinetic(self) -> float:
        system = self.system
        return float(system.evaluate(system.full, self.t, self.y)[system.place["kinetic"]])

    def _outputs(self) -> Floats:
        """All outputs of the system now."""
        return self.system.outputs(self.t, self.y)

    def _touching(self) -> list[int]:
        """Stops that are touched and neither left nor run into; raises LinkwrightError where one is behind."""
        system, out, found = self.system, self._outputs(), []
        gaps, rates = system.at_stops("stop", out), system.at_stops("stop_rate", out)
        for number, (name, gap, rate) in enumerate(zip(system.stops, gaps, rates, strict=True)):
            if gap < -BEHIND * self.mechanism.size:
                raise LinkwrightError(
                    _(
                        "{name!r} begins beyond its stop {stop}, at {where}; begin on the other side of it, or "
                        "move it",
                        code="dynamics.beyond_stop",
                        name=self.mechanism.name,
                        stop=name,
                        where=self._where(self.y),
                    )
                )
            if gap <= ZERO * self.mechanism.size and rate <= 0.0:
                found.append(number)
        return found

    def _piece(self) -> bool:
        """One piece, and what happens at its end; whether the run goes on."""
        happens: list[Watched] = []
        begin, since = len(self.pieces), self.t
        try:
            for piece, t, y, now in self.stepper.piece(self.system, self.t, self.y, self.end.time):
                self.pieces[begin:] = [piece]
                self.t, self.y, happens = t, y, now
                self._balance()
                if self.progress is not None:
                    self.progress(int(1e6 * min(t / self.end.time, 1.0)), 1_000_000)
        except StepTooSmall:
            self._refuse_here()
        if not happens:
            return False
        self._repeated(since)
        return self._happen(happens)

    def _repeated(self, before: float) -> None:
        """Refuses what happens again and again at one time, that of the event ``before``, s."""
        self.at_once = self.at_once + 1 if self.t <= before + 1e-14 * max(1.0, self.t) else 0
        if self.at_once > AT_ONCE:
            raise LinkwrightError(
                _(
                    "forces switch to and fro without end at {time:.6g} s, at {where}; something pushes across the "
                    "place where it changes its sign",
                    code="dynamics.chatter",
                    time=self.t,
                    where=self._where(self.y),
                )
            )

    def _refuse_here(self) -> None:
        system, size = self.system, np.sqrt(np.where(self.heaviest > 0.0, self.heaviest, 1.0))
        mass = system.mass(system.evaluate(system.full, self.t, self.y)) / (size * size[:, None])
        if np.isfinite(mass).all() and np.linalg.eigvalsh(mass)[0] < MASSLESS:
            self._refuse_without_inertia()
        raise LinkwrightError(
            _(
                "the motion cannot go on after {time:.6g} s, at {where}: the machine comes to where it cannot be put "
                "together, or its steps become too small",
                code="dynamics.no_further",
                time=self.t,
                where=self._where(self.y),
            )
        )

    def _balance(self) -> None:
        """The energy that is missing, and the largest rates."""
        n = len(self.equation.free)
        self.system.pace = np.maximum(self.system.pace, np.abs(self.y[n : 2 * n]))
        kinetic = self._kinetic()
        self.heaviest = np.maximum(self.heaviest, np.diag(self.system.mass(self.system.full.out)))
        self.system.follow()
        self.pieces[-1].carried.append(self.system.carried)
        work = self.y[-1]
        self.largest = max(self.largest, kinetic, abs(float(work)))
        self.residual = max(self.residual, abs(kinetic - self.kinetic + self.lost - float(work)))

    # events ---------------------------------------------------------------------------------------------
    def _happen(self, happens: list[Watched]) -> bool:
        system = self.system
        touch, standing = list(system.holding.touch), system.holding.copy()
        kinds = {each.kind for each in happens}
        for each in happens:
            if each.kind == "end" and not self._turned():
                return False
        if "stop" in kinds:
            touch = self._impact([each.number for each in happens if each.kind == "stop"], touch)
        self._cross([each.number for each in happens if each.kind == "surface"])
        slips = {}
        for each in happens:
            if each.kind == "leave":
                left = system.holding.touch[each.number]
                self._note("leave", system.stops[left])
                touch.remove(left)
            if each.kind == "slip":
                index, _sign = system.holding.stick[each.number][0]
                slips[index] = -1 if each.sense > 0.0 else 1
        self.y = settle(system, self.t, self.y, touch, slips, self._no_gap)
        for kind, now, then in (("sticks", system.holding, standing), ("slips", standing, system.holding)):
            names = dict.fromkeys(owner for owner in self._owners(now) if owner not in self._owners(then))
            if names:
                self._note(kind, ", ".join(names))
        if "singular" in kinds:
            self._go_over()
        return not self._rests()

    def _rests(self) -> bool:
        """Whether a run that waits for that has come to rest."""
        if not self.end.until or not self._resting():
            return False
        if not self.pieces and self.system.holding.stick:
            self._note("sticks", ", ".join(dict.fromkeys(self._owners(self.system.holding))))
        self._note("rest", "")
        self.pieces.append(Piece.resting(self.system, self.t, self.y))
        return True

    def _go_over(self) -> None:
        """Goes on beyond a singular position: in another description, or with formulas bridged."""
        system = self.system
        stretch, q, w = self.positions.next(system.now(), *system.coordinates(self.t, self.y))
        if stretch.description.equation is system.equation and stretch.point is system.stretch.point:
            system.stretch = stretch
            return
        if stretch.point is not None:
            self._note("change_point", "")
        elif stretch.description.names != system.equation.names:
            self._note("dead_point", "")
        touch = system.holding.touch
        self.system, self.y = System(stretch), self._state(stretch, q, w, self.y[-1])
        n = len(self.equation.free)
        self.system.pace = np.abs(self.y[n : 2 * n])
        self.heaviest = self._inertia_about()
        self.stepper.absolute = self._absolute()
        self.y = settle_anew(self.system, self.t, self.y, touch, self._no_gap)

    def _owners(self, holding: Holding) -> list[str]:
        """Whose friction holds."""
        surfaces = self.system.surfaces
        return [owner for group in holding.stick for index, _sign in group for owner in surfaces[index].owners]

    def _turned(self) -> bool:
        """What happens at the end of a turn; whether the run goes on."""
        if self.end.turns is not None:
            self._note("turns", "")
            return False
        if self._section():
            self._note("steady", "")
            return False
        return True

    def _switched_now(self, owner: str) -> bool:
        """Whether that a load or an actuator switches here is noted already: several comparisons may go over at the
        same place, one after the other but for rounding."""
        last = next((each for each in reversed(self.happened) if (each.kind, each.name) == ("switch", owner)), None)
        return last is not None and self.t - last.time <= SAME_TIME * max(1.0, self.t)

    def _note(self, kind: str, name: str, value: float = 0.0) -> None:
        found = self.system.drivers(self.t, self.y)
        coordinates = tuple(found[each][0] for each in self.first.free)
        self.happened.append(Happening(self.t, kind, name, value, coordinates))

    def _cross(self, crossed: list[int]) -> None:
        """Lets surfaces go over: those by rates that are zero exactly to zero, of which forces tell the rest, the
        others to their other side."""
        system, n, out = self.system, len(self.equation.free), self._outputs()
        zero, holding = system.zero(out, self.y), system.holding.copy()
        switched: dict[str, None] = {}
        for index in crossed:
            if index not in zero:
                holding.sides[index] *= -1.0
                if not system.surfaces[index].by_rate:
                    switched.update(dict.fromkeys(system.surfaces[index].owners))
        system.hold(holding)
        for owner in switched:
            if not self._switched_now(owner):
                self._note("switch", owner)
        if n == 1 and any(k in zero for k in crossed) and abs(self.y[n]) <= ZERO * system.pace[0]:
            self.y[n] = 0.0
            self._note("reversal", "")
        small = np.abs(system.gaps(out)) <= self._no_gap
        near = [k for k, each in enumerate(system.surfaces) if not each.by_rate and k not in crossed and small[k]]
        go_by_gaps(system, self.t, self.y, near)

    @property
    def _no_gap(self) -> Floats:
        """Gaps (surfaces,) that are zero but for rounding."""
        seen = self.stepper.seen
        return NO_GAP * np.array([seen.get(("surface", k), 0.0) for k in range(len(self.system.surfaces))])

    def _impact(self, hit: list[int], touch: list[int]) -> list[int]:
        """Impacts at stops; the stops that are touched then."""
        system = self.system
        before = self._kinetic()
        self.y, held, impulses = self.impacts.at(system, self.t, self.y, hit, touch)
        for number, impulse in impulses:
            self._note("impact", system.stops[number], impulse)
        self.lost += before - self._kinetic()
        go_by_gaps(system, self.t, self.y, (k for k, each in enumerate(system.surfaces) if each.by_rate))
        return held
