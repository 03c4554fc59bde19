"""Random machines with process loads of all kinds that pass their whole cycle, the same text for the same seed.

Dyads of all kinds, groups without closed form, wheels, belts, racks and cams, with several drivers and laws in some;
the loads are drawn anew: phases by the input, between limits, on parts of strokes, while something moves; ramps,
tables, expressions; springs, dampers, pressures, and friction in some.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count
from typing import Any

import numpy as np
import yaml
from tests.reference import joint_cells
from tests.reference.geared_loops import looped_case
from tests.reference.geared_mechanisms import geared_case
from tests.reference.general_case import general_case

import linkwright as lw

TRIES = 12


@dataclass(frozen=True)
class LoadedMachine:
    """``kinds``: what its loads are."""

    seed: int
    text: str
    mechanism: lw.Mechanism
    kinds: tuple[str, ...]


def loaded_machines(seed: int) -> Iterator[LoadedMachine]:
    """One after the other without end."""
    for number in count(seed * 1_000_000):
        found = loaded_machine(number)
        if found is not None:
            yield found


def loaded_machine(number: int) -> LoadedMachine | None:
    """The machine of a number; None where it does not pass its whole cycle, or no loads are found for it."""
    rng = np.random.default_rng([number, 39])
    draft = _Draft(rng, yaml.safe_load(_bare(rng, number)))
    try:
        if not _passes(draft.text()):
            return None
        draft.motion = lw.solve_motion(lw.loads(draft.text()), steps=72)
    except lw.LinkwrightError:
        return None
    if rng.random() < 0.2:
        draft.rub()
    for _ in range(int(rng.integers(1, 4))):
        draft.load()
    try:
        mechanism = lw.loads(draft.text())
        lw.solve_forces(mechanism, steps=180)
    except lw.LinkwrightError:
        return None
    return LoadedMachine(number, draft.text(), mechanism, tuple(draft.kinds)) if draft.kinds else None


def _bare(rng: np.random.Generator, number: int) -> str:
    """A random machine of one of the families, its own loads to be left out."""
    draw = rng.random()
    if draw < 0.45:
        group = str(rng.choice(list(joint_cells.GROUPS)))
        return joint_cells.cell(group, str(rng.choice(list(joint_cells.JOINTS))), number).text
    if draw < 0.75:
        return general_case(number).text
    return (looped_case if number % 2 else geared_case)(number).text


def _passes(text: str) -> bool:
    return bool(lw.solve_motion(lw.loads(text), steps=360, failures="mark").complete)


class _Draft:
    """A model file as plain data, to which loads are added one by one, each kept where the machine takes it."""

    def __init__(self, rng: np.random.Generator, data: dict[str, Any]) -> None:
        self.rng, self.data = rng, data
        self.kinds: list[str] = []
        self.motion: lw.Motion | None = None
        data.pop("loads", None)

    def text(self) -> str:
        return yaml.safe_dump(self.data, allow_unicode=True, sort_keys=False, width=10_000)

    def number(self, low: float, high: float) -> float:
        return float(round(self.rng.uniform(low, high), 3))

    def pick(self, among: Any) -> Any:
        options = list(among)
        return options[int(self.rng.integers(len(options)))]

    @property
    def guides(self) -> list[str]:
        joints = self.data.get("joints") or {}
        return [name for name, each in joints.items() if each.get("kind") == "prismatic"]

    @property
    def turning(self) -> bool:
        return "turn" in self.driver

    @property
    def driver(self) -> dict[str, Any]:
        several = self.data.get("drivers")
        return dict(next(iter(several.values())) if several else self.data["driver"])

    def points(self, link: str) -> list[str]:
        each = self.data["frame"] if link == "frame" else self.data["links"][link]
        return [*each["points"], *each.get("also", {})]

    def rub(self) -> None:
        """Friction in some pins and guides, where the machine takes it."""
        joints = self.data.setdefault("joints", {})
        pins = [name for name in self.points("frame") if name not in joints]
        pins = [name for name in pins if any(name in self.points(link) for link in self.data["links"])]
        before = {name: dict(each) for name, each in joints.items()}
        for name in pins[:2]:
            joints[name] = {"kind": "revolute", "pin_radius": "15 mm", "friction": self.number(0.02, 0.12)}
        for name in self.guides[:1]:
            joints[name]["friction"] = self.number(0.02, 0.1)
        if self._holds():
            self.kinds.append("friction")
        else:
            self.data["joints"] = before

    def load(self) -> None:
        """One more load of some kind."""
        loads = self.data.setdefault("loads", {})
        for _ in range(TRIES):
            kind, entry = self._drawn()
            loads[f"load{len(loads)}"] = entry
            if self._holds():
                self.kinds.append(kind)
                return
            loads.popitem()

    def _holds(self) -> bool:
        try:
            lw.solve_forces(lw.loads(self.text()), steps=36)
        except lw.LinkwrightError:
            return False
        return True

    def _drawn(self) -> tuple[str, dict[str, Any]]:
        makers = [self._spring, self._damper, self._torsion, *[self._sized] * 7]
        return self.pick(makers)()  # type: ignore[no-any-return]

    def _spring(self) -> tuple[str, dict[str, Any]]:
        entry = {"kind": "spring", **self._ends(), "stiffness": f"{self.number(50, 900)} N/m"}
        return "spring", {**entry, "free_length": f"{self.number(0.1, 0.5)} m"}

    def _damper(self) -> tuple[str, dict[str, Any]]:
        return "damper", {"kind": "damper", **self._ends(), "damping": f"{self.number(1, 60)} N·s/m"}

    def _torsion(self) -> tuple[str, dict[str, Any]]:
        a, b = self.rng.permutation(["frame", *self.data["links"]])[:2].tolist()
        if self.rng.random() < 0.5:
            size = {"kind": "torsion_damper", "damping": f"{self.number(0.1, 9)} N·m·s/rad"}
        else:
            size = {"kind": "torsion_spring", "stiffness": f"{self.number(1, 50)} N·m/rad"}
        return size["kind"], {**size, "links": [a, b]}

    def _ends(self) -> dict[str, Any]:
        """Two points that stay apart."""
        assert self.motion is not None
        for _ in range(30):
            a, b = self.rng.permutation(["frame", *self.data["links"]])[:2].tolist()
            ends = [f"{link}.{self.pick(self.points(link))}" for link in (a, b)]
            p, q = (self.motion.point(end).position for end in ends)
            if np.hypot(*(p - q).T).min() > 0.1:
                break
        return {"between": ends}

    def _sized(self) -> tuple[str, dict[str, Any]]:
        """A force, torque or pressure of some size in some phase."""
        phase_kind, phase = self._phase()
        kind = self.pick(["force", "force", "torque", *(["pressure"] if self.guides else [])])
        unit, most = {"force": ("N", 300.0), "torque": ("N·m", 60.0), "pressure": ("kPa", 90.0)}[kind]
        size_kind, size = self._size(unit, most, phase_kind)
        on = self.pick(self.data["links"])
        entry: dict[str, Any] = {"kind": kind, **size, **({"phase": phase} if phase else {})}
        if kind == "pressure":
            entry |= {"joint": self.pick(self.guides), "area": "0.002 m²"}
        elif kind == "torque":
            entry |= {"on": on} | ({"opposes": "velocity"} if self.rng.random() < 0.15 else {})
        else:
            entry |= {"on": on, "at": self.pick(self.points(on)), **self._direction()}
        return f"{kind} {size_kind} {phase_kind}", entry

    def _direction(self) -> dict[str, Any]:
        draw = self.rng.random()
        if draw < 0.15:
            return {"opposes": "velocity"}
        word = "direction" if draw < 0.6 else "in_link"
        return {word: f"{self.number(-180, 180)} deg"}

    def _output(self) -> str:
        links = [name for name in self.data["links"] if self.rng.random() < 0.8] or [*self.data["links"]]
        point = self.pick(self.points(self.pick(links)))
        return str(self.pick([*links, *self.guides * 3, f"{point}.x", f"{point}.y"]))

    def _size(self, unit: str, most: float, phase: str) -> tuple[str, dict[str, Any]]:
        size, other = self.number(0.1 * most, most), self.number(-most, most)
        draw = self.rng.random()
        if draw < 0.3 and phase not in ("always", "moving"):
            return "ramp", {"ramp": [f"{size} {unit}", f"{other} {unit}"]}
        if draw < 0.45:
            across = "input" if self.turning else "1 rad*sin(3*t/(1 s))"
            return "expression", {"magnitude": f"{size} {unit} + {other} {unit}*cos({across})"}
        if draw < 0.65 and self.turning:
            way = self.pick(["linear", "cubic"])
            y = [f"{each} {unit}" for each in (size, other, self.number(-most, most), size)]
            x = ["0 deg", "100 deg", "210 deg", "360 deg"]
            return f"{way} table", {"table": {"over": "input", "x": x, "y": y, "interpolation": way}}
        return "constant", {"magnitude": f"{size} {unit}"}

    def _phase(self) -> tuple[str, dict[str, Any]]:
        draw = self.rng.random()
        if draw < 0.15:
            return "always", {}
        if draw < 0.4 and self.turning:
            low = self.number(-180, 180)
            return "input", {"input": [f"{low} deg", f"{low + self.number(20, 300)} deg"]}
        if draw < 0.55:
            return "moving", {"moving": self._output(), "direction": self.pick(["increasing", "decreasing"])}
        ends = self.pick([("max", "min"), ("min", "max")])
        phase: dict[str, Any] = {"of": self._output(), "from": ends[0], "to": ends[1]}
        if draw < 0.75:
            return "between limits", phase
        part = str(self.pick(["free", "first", "last"]))
        share: Any = self.number(0.05, 0.45)
        if part == "free" and self.rng.random() < 0.3:
            share = [share, self.number(0.05, 0.4)]
        return f"{part} of stroke", {**phase, part: share}
