"""A rigid body on supports, in the plane or in space: reactions, or how it can move."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.quantity import number
from linkwright.core.table import Block, Row
from linkwright.equations.matrix import system
from linkwright.equations.steps import Step
from linkwright.errors import Finding, ModelError, fault
from linkwright.fields.base import FileKeys, Word, file_key, quantity_schema
from linkwright.fields.nodes import Node
from linkwright.fields.nodes import Sequence as SequenceNode
from linkwright.fields.reading import Place, Reader
from linkwright.fields.tables import Listed, Named, Table
from linkwright.parts.base import Problem, Result
from linkwright.parts.statics.forces import COUPLES, DIRECTION, FORCES, Components, Force, ForceField, spatial
from linkwright.words import Message, Translate, _

#: Singular values below this share of the largest count as zero.
ZERO = 1e-10
HELD = ("x", "y", "z", "turn_x", "turn_y", "turn_z")


@dataclass(frozen=True)
class Couple(Components):
    """Three components, or the one about z."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> tuple[float, ...] | None:
        if isinstance(node, SequenceNode):
            return super().read(reader, node, place, siblings)
        value = reader.quantity(node, place, self.dimension)
        return None if value is None else (value,)

    def shape(self) -> dict[str, object]:
        return {"anyOf": [super().shape(), quantity_schema(self.dimension)]}


@dataclass(frozen=True)
class Support:
    """What holds a body ``at`` a point (2 or 3 components, m).

    ``holds``: any of x, y, z, turn_x, turn_y, turn_z; ``along``: the direction of a rod, rope or roller.
    """

    at: tuple[float, ...] = file_key(Components("length", doc="where it holds the body"))
    holds: tuple[str, ...] = file_key(
        Listed(Word(HELD), "[x, y]", doc="what it holds: x, y, z, turn_x, turn_y, turn_z"), ()
    )
    along: tuple[float, ...] = file_key(replace(DIRECTION, doc="direction of a rod, rope or roller"), ())

    def columns(self, scale: float) -> list[tuple[str, Floats]]:
        """Names of its reactions, each with the force and moment (6,) of a unit; moments over ``scale``."""
        found = []
        place = spatial(self.at) / scale
        for word in self.holds:
            axis = np.eye(3)["xyz".index(word[-1])]
            pure = word.startswith("turn")
            wrench = (np.zeros(3), axis) if pure else (axis, np.cross(place, axis))
            found.append((f"M{word[-1]}" if pure else f"F{word}", np.concatenate(wrench)))
        if self.along:
            axis = spatial(self.along) / np.linalg.norm(spatial(self.along))
            found.append(("S", np.concatenate([axis, np.cross(place, axis)])))
        return found


@dataclass(frozen=True)
class BodyLoad(Force):
    """A load on a body: a force, or a ``couple`` (N·m; in the plane one number, counter-clockwise)."""

    couple: tuple[float, ...] = file_key(
        Couple("torque", doc="couple: M, counter-clockwise; [Mx, My, Mz] in space", form="[0 N·m, 0 N·m, 5 N·m]"), ()
    )


LOADS = Named(
    ForceField(Components("force", form="[0 N, -600 N]"), Table.of(BodyLoad)),
    _("load"),
    doc="loads by name: [Fx, Fy], {magnitude: …, direction: […], at: […]}, {couple: 5 N·m}",
)


@dataclass(frozen=True)
class RigidBody(Problem):
    """A body under forces (N) and couples (N·m), held by supports.

    In files both are ``loads`` by name; ``forces`` and ``couples``, the keys that files had before, are read as well.
    """

    kind: ClassVar[str] = "rigid_body"
    fields = FileKeys(
        {"loads": LOADS, "forces": replace(FORCES, replaced="loads"), "couples": replace(COUPLES, replaced="loads")}
    )
    supports: Mapping[str, Support] = file_key(
        Named(
            Table.of(Support),
            _("support"),
            doc="supports by name: {at: [0 m, 0 m], holds: [x, y]}, or {at: […], direction: [0, 1]}",
        )
    )
    forces: Mapping[str, Force] = field(default_factory=dict)
    couples: Mapping[str, tuple[float, ...]] = field(default_factory=dict)
    name: str = ""
    source: str = ""

    @classmethod
    def of_file(cls, values: Mapping[str, Any], folder: Path) -> RigidBody:
        own = dict(values)
        loads = own.pop("loads", None) or {}
        forces, couples = dict(own.pop("forces", None) or {}), dict(own.pop("couples", None) or {})
        wrong = [
            fault(
                "load_form",
                f"loads.{name}",
                _("the load is both a force and a couple"),
                _("give one of force, magnitude with direction, couple"),
            )
            for name, each in loads.items()
            if isinstance(each, BodyLoad) and each.couple and (each.force or each.size is not None or each.directed)
        ]
        if wrong:
            raise ModelError(wrong)
        for name, each in loads.items():
            if isinstance(each, BodyLoad) and each.couple:
                couples[name] = each.couple if len(each.couple) > 1 else (0.0, 0.0, *each.couple)
            else:
                forces[name] = each
        return cls(**own, forces=forces, couples=couples)

    def _key(self, name: str) -> str:
        """Where the file has a force: among its loads, or under the key that it had before."""
        return f"{'loads' if name in (self.file_values.get('loads') or {}) else 'forces'}.{name}"

    @property
    def planar(self) -> bool:
        """Whether everything lies in the plane z = 0, with couples about z."""
        flat = all(not each.place[2] and not each.vector[2] for each in self.forces.values())
        flat = flat and all(not any(each[:2]) for each in self.couples.values())
        holds = {word for each in self.supports.values() for word in each.holds}
        return (
            flat
            and holds <= {"x", "y", "turn_z"}
            and all(
                not spatial(each.at)[2] and not (each.along and spatial(each.along)[2])
                for each in self.supports.values()
            )
        )

    def findings(self) -> list[Finding]:
        found = [each for name, one in self.forces.items() for each in one.findings(self._key(name))]
        found += [
            fault(
                "unknown_load",
                self._key(name),
                _("the load has no magnitude"),
                _("give magnitude: with a unit; what is sought on a body are its supports"),
            )
            for name, one in self.forces.items()
            if one.unknown and one.directed
        ]
        for name, support in self.supports.items():
            if not support.holds and not support.along:
                found.append(
                    fault(
                        "holds_nothing",
                        f"supports.{name}",
                        _("the support holds nothing"),
                        _("write holds: [x, y], or direction: [0, 1] for a rod, rope or roller"),
                    )
                )
            if support.along and not any(support.along):
                found.append(
                    fault(
                        "no_direction",
                        f"supports.{name}.direction",
                        _("the direction is zero"),
                        _("give a vector of any length, such as [1, 0, 0]"),
                    )
                )
        return found or self._freedoms()

    def _freedoms(self) -> list[Finding]:
        """How the body can move, or which reactions statics alone cannot tell."""
        state = _Balance(self)
        found = []
        for motion in state.free:
            pushed = abs(state.load @ motion) > ZERO * max(float(np.abs(state.load).max()), 1e-300)
            how = describe(motion, state.scale, self.planar)
            remedy = _("add a support against this motion")
            found.append(
                fault(
                    "can_move",
                    "supports",
                    _("the body is not in equilibrium: nothing keeps it from moving; it can {how}"),
                    remedy,
                    how=how,
                )
                if pushed
                else fault(
                    "loose", "supports", _("the body can {how}, though these forces do not start it"), remedy, how=how
                )
            )
        if not found and len(state.names) > state.rank:
            spare = ", ".join(state.names)
            found.append(
                fault(
                    "indeterminate",
                    "supports",
                    _("{unknowns} reactions ({names}) stand against {equations} equations of equilibrium"),
                    _("take supports away, or calculate it as a beam, whose stiffness decides"),
                    unknowns=len(state.names),
                    equations=state.rank,
                    names=spare,
                )
            )
        return found

    def solve(self) -> Reactions:
        """The reactions. Raises ModelError where the body can move or is held more often than statics can tell."""
        self.require()
        return Reactions(self)


class _Balance:
    """Equations of equilibrium: reactions' columns, the load, and the motions that nothing hinders."""

    def __init__(self, body: RigidBody) -> None:
        places = [spatial(s.at) for s in body.supports.values()] + [f.place for f in body.forces.values()]
        self.scale = max([float(np.abs(p).max()) for p in places] + [0.0]) or 1.0
        pairs = [
            (f"{name}.{part}", column)
            for name, support in body.supports.items()
            for part, column in support.columns(self.scale)
        ]
        self.names = [name for name, _unused in pairs]
        rows = [0, 1, 5] if body.planar else list(range(6))
        self.columns = np.array([column for _unused, column in pairs]).T[rows] if pairs else np.zeros((len(rows), 0))
        load = np.zeros(6)
        for each in body.forces.values():
            load += np.concatenate([each.vector, np.cross(each.place, each.vector) / self.scale])
        for couple in body.couples.values():
            load[3:] += spatial(couple) / self.scale
        self.load = load[rows]
        u, s, _unused = np.linalg.svd(self.columns, full_matrices=True)
        self.rank = int((s > ZERO * (s[0] if len(s) else 1.0)).sum())
        self.free = plain_motions(u[:, self.rank :].T)


def describe(motion: Floats, scale: float, planar: bool) -> Message:
    """A small motion (velocities, then rotation times the scale) in words."""
    velocity = spatial(motion[:2]) if planar else motion[:3]
    turn = np.array([0.0, 0.0, motion[2]]) if planar else motion[3:]
    size = float(np.linalg.norm(turn))
    if size < 1e-9:
        way = velocity / np.abs(velocity).max()
        return _("slide along {way}", code="statics.slides", way=_vector(way[:2] if planar else way))
    centre = np.cross(turn, velocity) / size**2 * scale
    along = float(turn @ velocity) / size**2 * scale
    if planar:
        return _("turn about the point {place} m", code="statics.turns_plane", place=_vector(centre[:2]))
    axis = turn / np.abs(turn).max()
    values = {"axis": _vector(axis), "place": _vector(centre)}
    if abs(along) < 1e-9 * scale:
        return _("turn about the axis along {axis} through {place} m", code="statics.turns", **values)
    return _("screw along the axis {axis} through {place} m", code="statics.screws", **values)


def _vector(vector: Floats) -> str:
    return f"({', '.join(number(float(c), digits=4) for c in vector)})"


@dataclass(frozen=True, repr=False)
class Reactions(Result):
    """Reactions of a body's supports, N and N·m by name (``A.Fx``); ``S`` is the force along a rod or rope.

    Σ F = 0 and Σ M = 0 (six equations in space, three in the plane) as one linear system.
    """

    body: RigidBody

    @cached_property
    def values(self) -> dict[str, float]:
        """Reactions by name."""
        state = _Balance(self.body)
        found = np.linalg.lstsq(state.columns, -state.load, rcond=None)[0]
        moments = [state.scale if ".M" in name else 1.0 for name in state.names]
        largest = max(float(np.abs(found).max()), 1e-300)
        tidy = np.where(np.abs(found) < 1e-14 * largest, 0.0, found) * moments
        return dict(zip(state.names, tidy.tolist(), strict=True))

    @property
    def matrix(self) -> tuple[Floats, Floats]:
        """A and B of A·X = B, N and N·m: rows are ΣF and, about the origin, ΣM; X are the reactions."""
        state = _Balance(self.body)
        about = [name[1] == "M" for name in _sums(self.body)]
        rows = np.where(about, state.scale, 1.0)
        own = np.where([".M" in name for name in state.names], state.scale, 1.0)
        return state.columns * rows[:, None] / own, -state.load * rows

    def blocks(self, translate: Translate) -> list[Block]:
        rows = [Row(name, value, _dimension(name), name) for name, value in self.values.items()]
        return [Block("reactions", _("Reactions"), rows)]

    def steps(self, translate: Translate) -> list[Step]:
        balance, found = Step("1", translate(_("Equations of equilibrium"))), Step("2", translate(_("Reactions")))
        state = _Balance(self.body)
        names = _sums(self.body)
        for i, name in enumerate(names):
            arm = state.scale if name[1] == "M" else 1.0
            parts = [
                (c * arm / (state.scale if ".M" in n else 1.0), n)
                for c, n in zip(state.columns[i], state.names, strict=True)
                if abs(c) > 1e-12
            ]
            sides = " ".join(
                f"{'+' if c > 0 else '−'} {'' if abs(c) == 1.0 else number(abs(c)) + '·'}{n}" for c, n in parts
            )
            load = state.load[i] * arm
            rest = "" if not load else f" {'+' if load > 0 else '−'} {number(abs(load))}"
            balance.law(f"{name} = {sides.removeprefix('+ ') or '0'}{rest} = 0")
        found.note(translate(_("In matrix form A·X = B:")))
        a, b = self.matrix
        found.items.append(system(a, list(self.values), b, names))
        for name, value in self.values.items():
            found.put(name, "", value, _dimension(name))
        return [balance, found]


def _sums(body: RigidBody) -> tuple[str, ...]:
    """Names of the equations of equilibrium."""
    return ("ΣFx", "ΣFy", "ΣMz") if body.planar else ("ΣFx", "ΣFy", "ΣFz", "ΣMx", "ΣMy", "ΣMz")


def _dimension(name: str) -> str:
    return "torque" if ".M" in name else "force"


def plain_motions(space: Floats) -> list[Floats]:
    """A basis of the rows' space with as many zeros as can be, by elimination from the last column on."""
    rows = space.copy()
    done = 0
    for column in range(rows.shape[1] - 1, -1, -1):
        if done == len(rows):
            break
        pivot = done + int(np.abs(rows[done:, column]).argmax())
        if abs(rows[pivot, column]) < 1e-8:
            continue
        rows[[done, pivot]] = rows[[pivot, done]]
        rows[done] /= rows[done, column]
        for other in range(len(rows)):
            if other != done:
                rows[other] -= rows[other, column] * rows[done]
        done += 1
    return [np.where(np.abs(row) < 1e-9, 0.0, row) for row in rows]
