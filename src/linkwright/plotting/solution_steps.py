"""What a machine's solution consists of, step by step: driver, groups in solving order, forces in reverse."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.drivers.base import LABELS
from linkwright.elements import Group
from linkwright.groups.base import DYADS
from linkwright.joints.cam import CamJoint
from linkwright.kinematics.groups import complete_form, dyad_shape, in_one_step
from linkwright.kinematics.motion import Motion
from linkwright.kinetostatics.forces import link_numbers
from linkwright.mechanism.mechanism import Mechanism
from linkwright.mechanism.wheels_and_cams import wheel_sizes
from linkwright.words import Translate, _, translate
from linkwright.words.message import link_label

Shape = Literal["terminator", "data", "preparation", "process", "call", "decision"]
#: Places to which decisions jump.
LOOP, NEXT, FORCES = "loop", "next", "forces"
#: Names that one line lists.
LONGEST = 12
#: Positions that are listed.
FEW = 8


@dataclass(frozen=True)
class Node:
    """One symbol of the chart: its ``lines``, and above them the name of the subprogram that it calls.

    ``name``: what a decision's ``jump`` goes to; ``down`` and ``across``: words at the exits of a decision, the
    first leads to the next symbol; ``aside``: the text of a separate symbol before the jump.
    """

    shape: Shape
    lines: tuple[str, ...]
    call: str = ""
    name: str = ""
    jump: str = ""
    down: str = ""
    across: str = ""
    aside: str = ""


@dataclass(frozen=True)
class Loop:
    """The positions that the chart steps through: values (n,) of the first driver's coordinate (rad or m), or of the
    time (s)."""

    symbol: str
    values: Floats
    unit: str
    factor: float

    @staticmethod
    def over(motion: Motion, rows: Sequence[int]) -> Loop:
        """Over positions of a motion: over the input of one driver of constant speed, else over the time."""
        mechanism, chosen = motion.mechanism, list(rows)
        if len(mechanism.drivers) > 1 or not mechanism.steady:
            return Loop("t", motion.time[chosen], "s", 1.0)
        name = next(iter(mechanism.drivers))
        if motion.positions.rotary[name]:
            return Loop("q", motion.input[chosen], "°", 180.0 / math.pi)
        return Loop("q", motion.input[chosen], "mm", 1e3)

    def text(self, value: float) -> str:
        """A value with its unit, six digits at most."""
        shown = f"{self.factor * value:.6g}".replace("-", "−")
        return f"{shown}{self.unit}" if self.unit == "°" else f"{shown}\u00a0{self.unit}"

    def step(self, period: float) -> float | None:
        """The step between neighbours, differences of ``period`` left out; None where they are not equal."""
        steps = np.diff(self.values)
        if not len(steps):
            return None
        if period:
            usual = float(np.median(steps))  # one of them may be where the cycle begins again
            steps = steps - period * np.round((steps - usual) / period)
        first = float(steps[0])
        return first if np.allclose(steps, first, rtol=1e-6, atol=1e-9) else None


def flow_chart_steps(motion: Motion, rows: Sequence[int], language: str) -> list[Node]:
    """The symbols of the chart in the order in which they are passed, over numbered positions of a motion."""
    return list(_Writer(motion, rows, language).all())


class _Writer:
    def __init__(self, motion: Motion, rows: Sequence[int], language: str) -> None:
        self.motion, self.language = motion, language
        self.mechanism: Mechanism = motion.mechanism
        self.groups = motion.structure.groups
        self.numbers = link_numbers(self.mechanism)
        self.translate: Translate = partial(translate, language=language)
        self.rows = rows
        self.joint_points = set(self.mechanism.joints)

    def all(self) -> Iterator[Node]:
        """All symbols."""
        moves = bool(self.mechanism.drivers)
        yield Node("terminator", (self.translate(_("Begin")),))
        yield self._data()
        if moves:
            yield self._loop()
        for number, group in enumerate(self.groups):
            yield self._motion_of(group, LOOP if not number else "")
        if any(group.unknowns for group in self.groups):
            yield Node(
                "decision",
                (self.translate(_("All groups assembled?")),),
                jump=NEXT if moves else "end",
                down=self.translate(_("yes")),
                across=self.translate(_("no")),
                aside=self.translate(_("Report: position i is not reached") if moves else _("Report: not assembled")),
            )
        yield from self._further()
        if self.mechanism.has_loads:
            yield from self._forces()
        yield self._printed()
        if moves:
            yield from self._stepped()
        yield Node("terminator", (self.translate(_("End")),), name="end")

    # beginning --------------------------------------------------------------------------------
    def _data(self) -> Node:
        mechanism, translate = self.mechanism, self.translate
        count = len(mechanism.links)
        parts = [translate(_("fixed points {points}", points=self._listed(mechanism.frame.points)))]
        parts.append(translate(_("links 1 to {count}", count=count)) if count > 1 else translate(_("link 1")))
        if any(wheel_sizes(joint, mechanism) for joint in mechanism.joints.values()):
            parts.append(translate(_("sizes of the wheels")))
        if any(isinstance(joint, CamJoint) for joint in mechanism.joints.values()):
            parts.append(translate(_("motion programs of the cams")))
        if mechanism.drivers:
            parts.append(
                translate(_("laws of the drivers") if len(mechanism.drivers) > 1 else _("law of the driver"))
            )
        if any(dyad_shape(group) for group in self.groups):
            parts.append(translate(_("assembly modes")))
        if mechanism.has_loads:
            parts.append(translate(_("masses and loads")))
        return Node("data", (translate(_("Data: {parts}", parts=translate(_("; ")).join(parts))),))

    def _loop(self) -> Node:
        loop, translate = self._over, self.translate
        step, count = self._step, len(loop.values)
        first = loop.text(float(loop.values[0]))
        line = (
            translate(_("{symbol} = {values}", symbol=loop.symbol, values=translate(_(", ")).join(self._values())))
            if step is None
            else translate(
                _("{symbol} = {first}; Δ{symbol} = {step}", symbol=loop.symbol, first=first, step=loop.text(step))
            )
        )
        return Node("preparation", (translate(_("i = 1; N = {count}", count=count)), line, self._meaning()))

    def _values(self) -> list[str]:
        """The positions, of many the first ones and the last."""
        loop = self._over
        shown = [loop.text(float(value)) for value in loop.values]
        return shown if len(shown) <= FEW else [*shown[: FEW - 2], "…", shown[-1]]

    def _meaning(self) -> str:
        if self._over.symbol == "t":
            return self.translate(_("t: time"))
        driver = next(iter(self.mechanism.drivers.values()))
        return self.translate(
            _(
                "{symbol}: coordinate of {driver}",
                symbol=self._over.symbol,
                driver=link_label(driver.link, self.language),
            )
        )

    @property
    def _over(self) -> Loop:
        return Loop.over(self.motion, self.rows)

    @property
    def _step(self) -> float | None:
        loop = self._over
        if loop.symbol == "t":
            period = self.motion.positions.period or 0.0
        else:
            period = 2.0 * math.pi if loop.unit == "°" else 0.0
        return loop.step(period)

    # motion -----------------------------------------------------------------------------------
    def _motion_of(self, group: Group, name: str) -> Node:
        if not group.unknowns and group.drivers:
            return self._driven(group, name)
        outer, inner = ([c.joint for c in part] for part in (group.outer_joints, group.inner_joints))
        lines = [self._heading(group)]
        lines += self._driven_within(group)
        key = _("from {outer} to {inner}") if inner else _("on {outer}")
        lines.append(self.translate(key.format(outer=self._listed(outer), inner=self._listed(inner))))
        call = self._call(group, "k")
        if not call:
            lines += self._closure(group)
        return Node("call" if call else "process", tuple(lines), call, name)

    def _driven(self, group: Group, name: str) -> Node:
        """A driven link: a bar about its pin, or a slide along its guide."""
        translate, (first, *_unused) = self.translate, group.tree
        lines = []
        for step in group.tree:
            if step.driver is None:
                continue
            key = (
                _("driven link {link} turns about {joint}")
                if step.turns
                else _("driven link {link} slides along {joint}")
            )
            lines.append(translate(key.format(link=self._numbered([step.child]), joint=step.joint)))
            lines.append(self._law(step.driver))
        found = [each for each in self._points_of(group.links) if each not in {s.joint for s in group.tree}]
        if found:
            lines.append(translate(_("finds {points}", points=self._listed(found))))
        call = "bark" if first.turns and len(group.links) == 1 else ""
        return Node("call" if call else "process", tuple(lines), call, name)

    def _law(self, driver: str) -> str:
        law = self.mechanism.drivers[driver].law
        if law.constant_speed is not None:
            unit = "rad/s" if law.rotary else "m/s"
            speed = f"{law.constant_speed:.6g}\u00a0{unit}".replace("-", "−")
            return self.translate(_("constant speed {speed}", speed=speed))
        return self.translate(_("coordinate and rates at t: {law}", law=LABELS.get(law.key, law.key)))

    def _driven_within(self, group: Group) -> list[str]:
        """Drivers inside a group that is closed by other joints."""
        if not group.drivers:
            return []
        joints = [self.mechanism.drivers[each].joint for each in group.drivers]
        laws = self.translate(_(", ")).join(dict.fromkeys(map(self._law, group.drivers)))
        return [self.translate(_("driven along {joints}: {laws}", joints=self._listed(joints), laws=laws))]

    def _closure(self, group: Group) -> Iterator[str]:
        """How a group that is no dyad is closed."""
        translate, joints = self.translate, self._listed([cut.joint for cut in group.cuts])
        cams = [c.joint for c in group.cuts if isinstance(self.mechanism.joints[c.joint], CamJoint)]
        if cams:
            yield translate(_("lift and its derivatives from the profile of {cams}", cams=self._listed(cams)))
        if complete_form(group) is not None or dyad_shape(group) is not None:
            yield translate(_("closure in closed form"))
            return
        if in_one_step(group):
            yield translate(_("positions and rates: linear closure of {joints}", joints=joints))
            return
        yield translate(
            (
                _("positions: Newton's method on the closure of {joints}, from position i − 1")
                if self.mechanism.drivers
                else _("positions: Newton's method on the closure of {joints}")
            ).format(joints=joints)
        )
        if self.mechanism.drivers:
            yield translate(_("velocities, accelerations: linear equations"))

    def _call(self, group: Group, ending: str) -> str:
        """The teaching texts' name of what solves a dyad; empty for others, and for one driven inside."""
        shape = dyad_shape(group)
        known = shape is not None and not group.drivers and len(group.links) == 2
        return f"{group.signature.lower()}{ending}" if known and group.signature in DYADS else ""

    def _further(self) -> Iterator[Node]:
        """Points that no joint has, and mass centres."""
        mechanism = self.mechanism
        at_guides = {point for joint in mechanism.guides.values() for point in (joint.at, joint.through)}
        held = self.joint_points | at_guides | set(mechanism.frame.points)
        parts = [
            f"{point}\u00a0({self.numbers[name]})"
            for name, link in mechanism.links.items()
            for point in link.points
            if point not in held
        ]
        heavy = [
            str(self.numbers[name])
            for name, link in mechanism.links.items()
            if link.mass and not any(math.dist(link.centre, at) < 1e-12 for at in link.points.values())
        ]
        if heavy:
            key = _("mass centres of links {links}") if len(heavy) > 1 else _("mass centre of link {links}")
            parts.append(self.translate(key.format(links=self._listed(heavy))))
        if parts:
            yield Node(
                "call",
                (
                    self.translate(
                        _("Further points by link angle and base point: {points}", points=self._listed(parts))
                    ),
                ),
                "bark",
            )

    # forces -----------------------------------------------------------------------------------
    def _forces(self) -> Iterator[Node]:
        translate, mechanism = self.translate, self.mechanism
        parts = [translate(_("weights"))] if any(mechanism.gravity) and self._heavy else []
        if self._heavy and mechanism.drivers:
            parts.append(translate(_("inertia forces −m·a and couples −J·α")))
        if mechanism.loads:
            key = _("loads {names}") if len(mechanism.loads) > 1 else _("load {names}")
            parts.append(translate(key.format(names=self._listed(mechanism.loads))))
        rubbing = self._rubbing()
        if rubbing:
            parts.append(translate(_("friction of {joints}", joints=self._listed(rubbing))))
        yield Node("process", (translate(_("Known forces: {parts}", parts=translate(_("; ")).join(parts))),))
        for number, group in enumerate(reversed(self.groups)):
            yield self._forces_of(group, FORCES if not number and rubbing else "")
        if rubbing:
            yield Node(
                "decision",
                (translate(_("Friction settled?")),),
                jump=FORCES,
                down=translate(_("yes")),
                across=translate(_("no")),
            )
        yield Node(
            "process",
            (
                translate(
                    _("Check: power of the drivers = power of all forces")
                    if mechanism.drivers
                    else _("Check: balance of every link")
                ),
            ),
        )

    @property
    def _heavy(self) -> bool:
        return any(link.mass or link.inertia for link in self.mechanism.links.values())

    def _rubbing(self) -> list[str]:
        """Joints whose friction is found with their forces."""
        joints = self.mechanism.joints.items()
        return [name for name, joint in joints if joint.friction_arm]

    def _forces_of(self, group: Group, name: str) -> Node:
        translate, mechanism = self.translate, self.mechanism
        joints = dict.fromkeys(c.joint for c in (*group.inner_joints, *group.outer_joints))
        alone = not group.unknowns and bool(group.drivers)
        heading = (
            translate(_("driven link {link}", link=self._numbered(group.links))) if alone else self._heading(group)
        )
        lines = [heading, translate(_("forces at {joints}", joints=self._listed(joints)))]
        for driver in group.drivers:
            turns = mechanism.joints[mechanism.drivers[driver].joint].coordinate == "turn"
            letter = "M" if turns else "F"
            symbol = f"{letter}_d" if len(mechanism.drivers) == 1 else f"{letter}_d,{driver}"
            lines.append(
                translate(
                    (_("balancing torque {symbol}") if turns else _("driving force {symbol}")).format(symbol=symbol)
                )
            )
        call = self._call(group, "f")
        if alone and len(group.links) == 1:
            call = "barf"
        if not call:
            lines.insert(1, translate(_("balance of the links")))
        return Node("call" if call else "process", tuple(lines), call, name)

    # end --------------------------------------------------------------------------------------
    def _printed(self) -> Node:
        translate, mechanism = self.translate, self.mechanism
        parts = [self._over.symbol] if mechanism.drivers else []
        parts.append(translate(_("angles, points and their rates") if mechanism.drivers else _("angles and points")))
        if mechanism.has_loads:
            parts.append(translate(_("joint forces")))
            parts += dict.fromkeys("M_d" if turns else "F_d" for turns in self._efforts())
        key = _("Print position i: {parts}") if mechanism.drivers else _("Print: {parts}")
        return Node("data", (translate(key.format(parts=translate(_("; ")).join(parts))),))

    def _efforts(self) -> list[bool]:
        joints = self.mechanism.joints
        return [joints[each.joint].coordinate == "turn" for each in self.mechanism.drivers.values()]

    def _stepped(self) -> Iterator[Node]:
        translate, symbol = self.translate, self._over.symbol
        key = _("i = i + 1; next {symbol}") if self._step is None else _("i = i + 1; {symbol} = {symbol} + Δ{symbol}")
        yield Node("process", (translate(key.format(symbol=symbol)),), name=NEXT)
        yield Node(
            "decision", (translate(_("i > N?")),), jump=LOOP, down=translate(_("yes")), across=translate(_("no"))
        )
        yield Node("data", (translate(_("Peak values, limit positions, diagrams")),))

    # names ------------------------------------------------------------------------------------
    def _heading(self, group: Group) -> str:
        key = _("{signature}: links {links}") if len(group.links) > 1 else _("{signature}: link {links}")
        return self.translate(key.format(signature=group.signature, links=self._numbered(group.links)))

    def _numbered(self, links: Sequence[str]) -> str:
        return self.translate(_(", ")).join(
            f"{self.numbers[name]} {link_label(name, self.language)}" for name in links
        )

    def _points_of(self, links: Sequence[str]) -> list[str]:
        """Joints on links, each once, those of the frame left out."""
        points = [point for name in links for point in self.mechanism.links[name].points]
        held = self.mechanism.frame.points
        return [point for point in dict.fromkeys(points) if point in self.joint_points and point not in held]

    def _listed(self, names: Iterable[str]) -> str:
        """Names in a row, long rows by their ends."""
        shown = list(dict.fromkeys(map(str, names)))
        if len(shown) > LONGEST:
            shown = [*shown[: LONGEST - 2], "…", shown[-1]]
        return self.translate(_(", ")).join(shown)
