"""Assembly modes from words or from a drawing, and starting values of groups without closed form."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from linkwright.core.inputs import Input, mode_inputs, turned
from linkwright.core.outputs import row_names
from linkwright.elements import Group
from linkwright.errors import LinkwrightError
from linkwright.formula.program import Program
from linkwright.formula.recently_made import Recent
from linkwright.formula.scalar_backend import ScalarProgram
from linkwright.formula.trace import Scalar
from linkwright.kinematics.groups import counted, dyad_shape, iterated, state_name
from linkwright.kinematics.rotations import geared, turn_state
from linkwright.kinematics.trace import MotionTrace, trace_motion
from linkwright.mechanism.drawing import Drawing
from linkwright.mechanism.mechanism import Mechanism
from linkwright.registry import nearest, offered
from linkwright.topology.analysis import Structure
from linkwright.words import Message, _
from linkwright.words.message import lines

#: Where modes are looked for if the drawn inputs are out of reach: near them, rad or shares of the size.
NEARBY = (0.01, -0.01, 0.03, -0.03, 0.1, -0.1)


class AssemblyError(LinkwrightError):
    """An assembly mode that does not exist, or a group without starting values.

    ``parts``: keys of the model file with what is wrong there.
    """

    parts: tuple[tuple[str, str], ...] = ()


@dataclass(frozen=True)
class Assembly:
    """Signs of the assembly modes by group, chain coordinates of the other groups, what is drawn."""

    modes: dict[str, float]
    states: dict[str, float]
    drawing: Drawing

    @cached_property
    def inputs(self) -> dict[str, float]:
        """The drivers' coordinates in the drawing, at the start of their laws where it does not tell."""
        return {name: self._input(name) for name in self.drawing.mechanism.drivers}

    def _input(self, name: str) -> float:
        drawn = self.drawing.driver(name) if self.drawing else None
        return self.drawing.mechanism.drivers[name].law.own.at(0.0) if drawn is None else drawn


def assemble(mechanism: Mechanism, structure: Structure) -> Assembly:
    """How every group is put together in the drawing, or by the words of the file.

    Raises:
        AssemblyError: a word that the group does not know, a name that is no inner joint, or a group without
            closed form whose points are not drawn.
    """
    if mechanism.path is not None:  # words and drawing are those of the machine that is driven at the point
        mechanism = mechanism.posed
    words = tuple(mechanism.assembly.items())
    modes = dict(_worded.get(structure, words, lambda: _from_words(mechanism, structure)))
    drawing = Drawing(mechanism)
    found = Assembly(modes, _drawn_states(mechanism, structure, drawing), drawing)
    _from_drawing(mechanism, structure, found)
    return found


#: Modes by the words of a file.
_worded: Recent[Structure, dict[str, float]] = Recent(64)


def modal_groups(structure: Structure) -> dict[str, tuple[Group, tuple[str, str]]]:
    """Groups that have two assembly modes, with the words for them."""
    return _modal.get(structure, None, lambda: _modal_groups(structure))


_modal: Recent[Structure, dict[str, tuple[Group, tuple[str, str]]]] = Recent(64)


def _modal_groups(structure: Structure) -> dict[str, tuple[Group, tuple[str, str]]]:
    found = {}
    for group in structure.groups:
        shape = dyad_shape(group)
        if shape is not None and shape[0].words[0]:
            found[group.name] = (group, shape[0].words)
    return found


def _from_words(mechanism: Mechanism, structure: Structure) -> dict[str, float]:
    groups = modal_groups(structure)
    modes: dict[str, float] = {}
    problems: dict[str, str] = {}
    of_joint: dict[str, tuple[Group, tuple[str, str]]] = {}
    for entry in groups.values():
        for connection in entry[0].inner_joints:
            of_joint.setdefault(connection.joint, entry)
    for joint, word in mechanism.assembly.items():
        if joint not in of_joint:
            problems[joint] = _no_such_joint(joint, groups, iterated(structure))
            continue
        group, words = of_joint[joint]
        if word not in words:
            offer = nearest(word, list(words))
            hint = _("write {first} or {second}", first=words[0], second=words[1])
            problems[joint] = _(
                "assembly.{joint}: {word!r} is not an assembly mode of the {signature} group ({links}); {hint}",
                code="motion.no_mode",
                joint=joint,
                word=word,
                signature=group.signature,
                links=tuple(group.links),
                hint=_('did you mean "{offer}"?', offer=offer) if offer else hint,
            )
            continue
        modes[group.name] = 1.0 if word == words[0] else -1.0
    if problems:
        error = AssemblyError(lines(list(problems.values())))
        error.parts = tuple((f"assembly.{joint}", problem) for joint, problem in problems.items())
        raise error
    return modes


def _no_such_joint(
    joint: str, groups: dict[str, tuple[Group, tuple[str, str]]], open_groups: Iterable[Group]
) -> Message:
    for group in open_groups:
        if any(connection.joint == joint for connection in group.inner_joints):
            drawn = _to_draw(group)
            return _(
                "assembly.{joint}: as the machine is driven now, this is a joint of the group "
                "({links}), which has no closed form and so takes no word; remove it and give the "
                "coordinates of the group's points in a drawing of the assembled mechanism: drawing: "
                "{{{drawn}}}",
                code="motion.word_in_open",
                joint=joint,
                links=tuple(group.links),
                drawn=drawn,
            )
    inner = [c.joint for group, _unused in groups.values() for c in group.inner_joints]
    hint = offered(joint, inner, _("inner joints are: {names}"))
    return _(
        "assembly.{joint}: this is not the inner joint of a group with two assembly modes; {hint}",
        code="motion.not_inner",
        joint=joint,
        hint=hint,
    )


def _to_draw(group: Group) -> str:
    return ", ".join(f"{joint}: [x, y]" for joint in dict.fromkeys(c.joint for c in group.inner_joints))


def _drawn_states(mechanism: Mechanism, structure: Structure, drawing: Drawing) -> dict[str, float]:
    """Chain coordinates of the groups without closed form."""
    states: dict[str, float] = {}
    for group in iterated(structure):
        if not drawing and any(step.turns for step in group.unknowns):
            raise AssemblyError(
                _(
                    "the group ({links}) of class {level} has no closed form; give the coordinates of "
                    "its points in a drawing of the assembled mechanism: drawing: {{{drawn}}}",
                    code="motion.needs_drawing",
                    links=tuple(group.links),
                    level=group.assur_class,
                    drawn=_to_draw(group),
                )
            )
        for step in group.unknowns:
            name = state_name(step)
            joint = mechanism.joints[step.joint]
            if step.slides:
                states[f"{name}.s"] = drawing.slide(joint) or 0.0  # type: ignore[arg-type]
            elif geared(group):
                states[f"{name}.angle"] = drawing.angle(step.child) or 0.0
            else:
                angle = drawing.angle(step.child) or 0.0
                states[f"{name}.x"], states[f"{name}.y"] = math.cos(angle), math.sin(angle)
    for link in counted(structure, mechanism):
        states[turn_state(link)] = drawing.angle(link) or 0.0
    return states


def _from_drawing(mechanism: Mechanism, structure: Structure, assembly: Assembly) -> None:
    """Of both modes of a group, the one that comes closer to the drawing; without a drawing the first."""
    modes, drawing = assembly.modes, assembly.drawing
    open_groups = [group for name, (group, _unused) in modal_groups(structure).items() if name not in modes]
    modes |= {group.name: 1.0 for group in open_groups}
    if not drawing or not open_groups:
        return
    probe = _Probe(trace_motion(mechanism, structure, rates=False, iterations=8), open_groups, drawing)
    for group in open_groups:
        for inputs in _nearby(mechanism, assembly.inputs) if probe.goals[group.name] else ():
            distances = {
                sign: probe.distance(group, {**modes, group.name: sign}, assembly.states, inputs)
                for sign in (1.0, -1.0)
            }
            if min(distances.values()) < math.inf:
                closer = distances[-1.0] < distances[1.0] * (1.0 - 1e-9) - probe.rounding(group)
                modes[group.name] = -1.0 if closer else 1.0
                break


@dataclass(frozen=True)
class DrawnGap:
    """How far the drawn points of a group are, at most, from where it is put together, m: in the mode that is
    ``taken``, and in the ``other`` one; infinite where it cannot be put together so, or has no other."""

    group: Group
    taken: float
    other: float


def drawn_gaps(mechanism: Mechanism, structure: Structure) -> list[DrawnGap]:
    """How well the drawing shows the machine that is put together, by group; raises as :func:`assemble`."""
    if mechanism.path is not None:
        mechanism = mechanism.posed
    assembly = assemble(mechanism, structure)
    if not assembly.drawing:
        return []
    groups = [group for group in structure.groups if group.unknowns]
    modal = modal_groups(structure)
    probe = _Probe(trace_motion(mechanism, structure, rates=False, iterations=8), groups, assembly.drawing)
    found = []
    for group in groups:
        goals = probe.goals[group.name]
        own = assembly.modes.get(group.name, 1.0)
        for inputs in _nearby(mechanism, assembly.inputs) if goals else ():
            distances = [
                probe.farthest(group, {**assembly.modes, group.name: sign}, assembly.states, inputs)
                for sign in ((own, -own) if group.name in modal else (own,))
            ]
            if min(distances) < math.inf:
                found.append(DrawnGap(group, distances[0], (*distances, math.inf)[1]))
                break
    return found


def _nearby(mechanism: Mechanism, inputs: Mapping[str, float]) -> Iterator[Mapping[str, float]]:
    """The drivers' coordinates in the drawing, then some near them, where these are out of reach."""
    yield inputs
    for share in NEARBY:
        for name, q in inputs.items():
            unit = 1.0 if mechanism.drivers[name].law.rotary else mechanism.size
            yield {**inputs, name: q + share * unit}


class _Probe:
    """Distances between the drawn points of groups and where a choice of modes puts them.

    ``goals``: of every group the names of its points' coordinates with what is drawn, m.
    """

    def __init__(self, motion: MotionTrace, groups: Iterable[Group], drawing: Drawing) -> None:
        self.motion = motion
        self.goals: dict[str, dict[str, float]] = {}
        outputs: dict[str, Scalar] = {}
        for group in groups:
            goals = self.goals[group.name] = {}
            for link in group.links:
                for point, local in motion.mechanism.links[link].points.items():
                    drawn = drawing.drawn(link, point)
                    if drawn is not None and local is not None:
                        place = motion.poses[link].point(motion.dimensions.point(link, point))
                        names = row_names("position", f"{link}.{point}")
                        outputs |= zip(names, (place.x, place.y), strict=True)
                        goals |= zip(names, drawn, strict=True)
        self.program = Program.of(motion.trace, outputs)
        self.places = {name: k for k, name in enumerate(self.program.output_names)}
        self.steps = ScalarProgram(self.program)

    def rounding(self, group: Group) -> float:
        """What is no difference of squared distances, m²."""
        return 1e-20 * sum(coordinate * coordinate for coordinate in self.goals[group.name].values())

    def distance(
        self, group: Group, modes: dict[str, float], states: dict[str, float], inputs: Mapping[str, float]
    ) -> float:
        """The squared distance of a group's points, m²."""
        gap = sum(off * off for off in self.offsets(group, modes, states, inputs))
        return gap if gap == gap else math.inf

    def farthest(
        self, group: Group, modes: dict[str, float], states: dict[str, float], inputs: Mapping[str, float]
    ) -> float:
        """The largest distance of a point of a group from where it is drawn, m; infinite where it is out of reach."""
        offsets = self.offsets(group, modes, states, inputs)
        gap = max(map(math.hypot, offsets[::2], offsets[1::2])) if sum(offsets) == sum(offsets) else math.nan
        return gap if gap == gap else math.inf

    def offsets(
        self, group: Group, modes: dict[str, float], states: dict[str, float], inputs: Mapping[str, float]
    ) -> list[float]:
        """By how much the coordinates of a group's points differ from those that are drawn, m."""
        values = self._values(modes, inputs)
        outputs = self.steps.step(
            [values[name] for name in self.program.parameters],
            [values[name] for name in self.program.positions],
            [states[name] for name in self.program.fields],
        )
        return [outputs[self.places[name]] - goal for name, goal in self.goals[group.name].items()]

    def _values(self, modes: dict[str, float], inputs: Mapping[str, float]) -> dict[str, float]:
        values = dict(self.motion.mechanism.dimensions())
        values |= mode_inputs(modes)
        for name, q in inputs.items():
            values |= {**turned(name, q, math.cos, math.sin), Input("slide", name).name: q}
        return values
