"""Everything that is wrong with a file, at once: the same for programs, the command ``check`` and the studio."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, cast

from linkwright.actuators.cylinder import Cylinder
from linkwright.core.arguments import STEPS
from linkwright.core.attached import SECTIONS
from linkwright.core.entry_points import loaded
from linkwright.errors import Finding, LinkwrightError, ModelError, Severity
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node, Scalar, below, located
from linkwright.fields.reading import Place
from linkwright.files.model_file import declared_kind, is_task, read_root, read_tree
from linkwright.files.read_model import HEADER, TASK_KEYS
from linkwright.files.reader import Reader
from linkwright.files.source import read_source
from linkwright.words import Message, _
from linkwright.words.message import code_of

if TYPE_CHECKING:
    from pathlib import Path

    from linkwright.applied_loads.base import Load
    from linkwright.applied_loads.phases import Phase
    from linkwright.designs.expect.expectations import Expectations
    from linkwright.elements import Group
    from linkwright.kinematics.motion import Motion
    from linkwright.mechanism.mechanism import Mechanism
    from linkwright.topology.analysis import Structure

#: Positions of the cycle that are tried.
TRIED = 72
#: What reads the sections for a mechanism.
READERS = {
    "sheet": "linkwright.sheets.settings:check",
    "course": "linkwright.course.task:task",
    "optimize": "linkwright.designs.optimise.problem:problem",
    "expect": "linkwright.designs.expect.section:expected",
}
#: What evaluates the section ``expect`` of a mechanism.
EXPECTATIONS = "linkwright.designs.expect.expectations:expectations"
NO_MECHANISM = _("expectations are those of a mechanism, which the file has not; leave --expect out")
#: Finding about a load whose output never moves in a direction.
NEVER = {
    "increasing": _("the load never acts: {output} does not increase anywhere in the cycle"),
    "decreasing": _("the load never acts: {output} does not decrease anywhere in the cycle"),
}
#: A coefficient of friction that no pair of materials has.
RUBS = 2.0


@dataclass(frozen=True)
class Checked:
    """What there is to say about a file; ``fact``: its structure, or its kind, in short, where it has one;
    ``expectations``: those that were asked for."""

    findings: Sequence[Finding]
    fact: Mapping[str, object] = field(default_factory=dict)
    expectations: Expectations | None = None

    @property
    def errors(self) -> int:
        """How many errors the file has."""
        return sum(each.severity == "error" for each in self.findings)

    def summary(self, name: str) -> Message:
        """How many errors the file of this name has, or what it is."""
        if self.errors:
            return _("{name}: errors: {count}", name=name, count=self.errors)
        if "kind" in self.fact:
            return _("{name}: fine (kind {kind})", name=name, kind=self.fact["kind"])
        links, mobility = self.fact["links"], self.fact["mobility"]
        fine = _(
            "{name}: fine ({links} moving links, mobility {mobility})", name=name, links=links, mobility=mobility
        )
        if self.expectations is None and self.fact.get("expect"):
            return _(
                "{summary}; its {count} expectations are not evaluated: add --expect",
                summary=fine,
                count=self.fact["expect"],
            )
        return fine

    def data(self) -> dict[str, Any]:
        """Plain data."""
        found = {"ok": not self.errors, **self.fact, "findings": [each.data() for each in self.findings]}
        return (
            found
            if self.expectations is None
            else {**found, "expectations": self.expectations.data()["expectations"]}
        )


def check(source: str | Path, *, expect: bool = False) -> list[Finding]:
    """All findings about a file, errors, warnings and notes; never raises for bad content.

    A machine is turned once, and the sections that only some commands read are read; calculations and tasks of
    synthesis are checked as well. ``expect``: whether the section ``expect`` is evaluated, too; each expectation that
    does not hold is an error (:func:`linkwright.expectations` gives the table).
    """
    return list(checked(source, expect=expect).findings)


def checked(source: str | Path, *, expect: bool = False) -> Checked:
    """The findings about a file, and what it holds in short."""
    try:
        text, place = read_source(source)
    except ModelError as error:
        return Checked(error.findings)
    return checked_text(text, place, os.path.dirname(source), str(source), expect=expect)


def checked_text(text: str, place: str, folder: str = "", source: str = "", *, expect: bool = False) -> Checked:
    """The same for a text; findings name ``place`` as the file, and ``source`` where they concern all of it.

    Files that it names lie in ``folder``.
    """
    root, faults = read_root(text, place)
    if (kind := declared_kind(root)) is not None:
        from linkwright.parts.file import HEADING, read_calculation

        _unused, found = read_calculation(root, faults, place, folder)
        found = _with_sections(found, root, HEADING, place, folder)
        return Checked([*found, *_no_mechanism(source or place, expect)], {"kind": kind})
    if is_task(root):
        reader, task = Reader(place), below(root, "synthesis", "task")
        reader.table(cast(Node, root), Place("", ""), {key: HEADER[key] for key in TASK_KEYS})
        found = _with_sections([*faults, *reader.findings], root, TASK_KEYS, place, folder)
        kind = f"synthesis, {task.text if isinstance(task, Scalar) else ''}"
        return Checked([*found, *_no_mechanism(source or place, expect)], {"kind": kind})
    mechanism, found = read_tree(root, faults, place)
    found = _with_sections(found, root, HEADER, place, folder)
    if mechanism is None:
        return Checked(found)
    rests = any(each.code == "no-motion" for each in found)
    own, fact = _of_machine(mechanism, folder, rests=rests)
    new = _placed(own, found, source or place, root, place)
    found = [*found, *(new if fact else (replace(each, key="") for each in new))]
    table, more = _expected(mechanism) if expect else (None, [])
    return Checked([*found, *_placed(more, found, source or place, root, place)], fact, table)


def _no_mechanism(where: str, expect: bool) -> list[Finding]:
    """A note where expectations are asked for of what is no mechanism."""
    return [Finding("note", where, "", NO_MECHANISM, code="no-expectations")] if expect else []


def _expected(mechanism: Mechanism) -> tuple[Expectations | None, list[Finding]]:
    """The expectations of a machine, and an error for each that does not hold, or that names what there is not."""
    try:
        table: Expectations = loaded(EXPECTATIONS)(mechanism)
    except ModelError as error:
        return None, list(error.findings)
    return table, table.findings()


def _with_sections(
    found: list[Finding], root: Node | None, keys: Iterable[str], place: str, folder: str
) -> list[Finding]:
    """The findings, and what is wrong with the sections that only some commands read, whatever else is wrong."""
    reader = Reader(place)
    for key in keys:
        if key in SECTIONS and (node := below(root, key)) is not None:
            loaded(SECTIONS[key]).read(reader, node, Place(key, key), {})
    report = below(root, "report")
    more = _of_report(reader.free(report), None, folder) if isinstance(report, MappingNode) else []
    found = [*found, *(each for each in reader.findings if each not in found)]
    return [*found, *_placed(more, found, place, root, place)]


def _placed(
    more: Iterable[Finding], reported: Collection[Finding], source: str, root: Node | None, place: str
) -> list[Finding]:
    """Findings that are not reported yet, with line and column of their key in the text."""
    known = {(each.key, each.message) for each in reported}
    new = (each for each in more if (each.key, each.message) not in known)
    return [located(replace(each, where=each.where or source), root, place) for each in new]


def _of_machine(mechanism: Mechanism, folder: str, *, rests: bool) -> tuple[list[Finding], dict[str, object]]:
    """What only structure, motion and loads show to be wrong, and the structure in short; ``rests``: what an output
    never does in a load's phase is reported already."""
    from linkwright.kinematics.assembly import AssemblyError
    from linkwright.kinematics.passing import plainly_passed
    from linkwright.kinematics.structure_with_rank import analysed
    from linkwright.plausibility.constant import of_outputs
    from linkwright.plausibility.drawing import of_drawing, of_near_points
    from linkwright.plausibility.moving import of_laws, of_structure

    try:
        built = analysed(mechanism)
        if not all(driver.law.prescribed for driver in mechanism.drivers.values()):
            shown = [*of_structure(mechanism, built), *of_near_points(mechanism)]
            return [*_of_free(mechanism, folder), *shown], _facts(mechanism, built)
        swings = _swings(mechanism)
        plain = plainly_passed(
            mechanism, built, TRIED, [output for each in swings.values() for output in each.outputs]
        )
        turned, notes = _turned(mechanism) if plain is None else ([], [])
    except LinkwrightError as error:
        parts = (isinstance(error, AssemblyError) and error.parts) or (("", error.sentence),)
        faults = [Finding("error", "", key, message, code=code_of(message)) for key, message in parts]
        return [*faults, *of_near_points(mechanism)], {}
    sure = plain or [False] * len(swings)
    unsure = [
        load
        for (load, phase), each in zip(swings.items(), sure, strict=True)
        if not rests and (phase.in_part or not each)
    ]
    varying = [load for load, each in mechanism.loads.items() if _varies(each)]
    found = [
        *turned,
        *(_of_loads(mechanism, unsure, varying) if (unsure or varying) and not turned else ()),
        *(_of_cams(mechanism) if mechanism.higher else ()),
        *_of_friction(mechanism),
        *(() if turned else _of_strokes(mechanism, None)),
        *_of_settings(mechanism, folder, moves=not turned),
        *of_structure(mechanism, built),
        *of_laws(mechanism),
        *of_drawing(mechanism, built),
        *of_near_points(mechanism),
        *(() if turned else of_outputs(mechanism, built)),
        *notes,
        *_assumed(mechanism, built),
    ]
    return found, _facts(mechanism, built)


def _facts(mechanism: Mechanism, built: Structure) -> dict[str, object]:
    """The structure in short."""
    found: dict[str, object] = {
        "links": len(mechanism.links),
        "mobility": built.mobility,
        "class": built.mechanism_class,
    }
    return {**found, "expect": len(mechanism.expect)} if mechanism.expect else found


def _of_free(mechanism: Mechanism, folder: str) -> list[Finding]:
    """The findings about a machine with a driver that has no law: it is put together where it begins, not turned."""
    from linkwright.kinematics.solve import solve_motion

    motion = solve_motion(mechanism, times=[0.0])
    settings = _of_settings(mechanism, folder, moves=False)
    return [*_of_friction(mechanism), *_of_strokes(mechanism, motion), *settings]


def _of_strokes(mechanism: Mechanism, motion: Motion | None) -> Iterator[Finding]:
    """Cylinders that would have to be shorter or longer than their stroke lets them in a motion, by default the
    cycle."""
    cylinders = [each for each in mechanism.actuators.values() if isinstance(each, Cylinder) and each.stroke]
    if not cylinders:
        return
    import numpy as np

    from linkwright.core.quantity import shown
    from linkwright.kinematics.solve import try_motion

    moved = try_motion(mechanism, TRIED) if motion is None else motion
    for each in cylinders:
        shortest, longest = each.stroke or (0.0, 0.0)
        if each.between is not None:
            a, b = (moved.point(str(end)).position for end in each.between)
            length = np.hypot(*(b - a).T)
        else:
            length = moved.joint(str(each.along)).displacement
        low, high = float(np.nanmin(length)), float(np.nanmax(length))
        slack = 1e-9 * mechanism.size
        if low < shortest - slack or high > longest + slack:
            message = _(
                "the cylinder would go from {low} to {high}, and its stroke is {shortest} to {longest}",
                code="actuators.beyond_stroke",
                low=shown(low, "length"),
                high=shown(high, "length"),
                shortest=shown(shortest, "length"),
                longest=shown(longest, "length"),
            )
            remedy = _("choose a longer cylinder, or other points for its ends")
            yield Finding("warning", "", f"actuators.{each.name}.stroke", message, remedy, "range")


def _assumed(mechanism: Mechanism, structure: Structure) -> list[Finding]:
    """Notes on dyads whose assembly neither a word nor a drawing says."""
    from linkwright.kinematics.assembly import modal_groups

    if mechanism.path is not None:
        from linkwright.kinematics.following import as_put_together

        mechanism = as_put_together(mechanism)
        structure = mechanism.structure()
    found = []
    for group, words in modal_groups(structure).values():
        inner = [each.joint for each in group.inner_joints]
        if not any(joint in mechanism.assembly for joint in inner) and not _drawn(mechanism, group):
            values = {"signature": group.signature, "links": tuple(group.links), "joint": inner[0]}
            message = _(
                "group {signature} ({links}) has two assemblies, and neither assembly nor drawing "
                'says which: "{first}" is taken; write assembly: {{{joint}: {first}}} or {{{joint}: '
                "{second}}}"
            ).format(**values, first=words[0], second=words[1])
            found.append(Finding("note", "", "", message, code="assembly"))
    return found


def _drawn(mechanism: Mechanism, group: Group) -> bool:
    """Whether the drawing has a point of a group other than those of its outer joints."""
    outer = {each.joint for each in group.outer_joints}
    return any(
        point not in outer and not mechanism.drawing.keys().isdisjoint((point, f"{link}.{point}"))
        for link in group.links
        for point in mechanism.links[link].points
    )


def _of_cams(mechanism: Mechanism) -> list[Finding]:
    """Cams whose profile could not be made: their follower would cut away what it should touch."""
    from linkwright.cams.cam import cam_of

    found: list[Finding] = []
    for joint in mechanism.joints.values():
        try:
            faults = cam_of(mechanism, joint.name).findings()
        except TypeError:  # no cam
            continue
        for each in faults:
            key = f"joints.{joint.name}.{each.key.split('.')[-1]}"
            found.append(replace(each, severity="warning", key=key))
    return found


def _turned(mechanism: Mechanism) -> tuple[list[Finding], list[Finding]]:
    """What there is to say about a cycle: where it cannot be passed, and notes."""
    from linkwright.kinematics.solve import try_motion

    motion = try_motion(mechanism, TRIED)
    if motion.complete and motion.notes:
        motion = try_motion(mechanism, STEPS)  # of other commands; they may lie on change points
    notes = [Finding("note", "", "", note, code=code_of(note)) for note in motion.notes if motion.ok.any()]
    if motion.complete:
        return [], [*_hardly_determined(motion), *notes]
    barred = motion.refusal()
    severity: Severity = "note" if mechanism.expect.get("cycle") == "incomplete" else "error"
    return [Finding(severity, "", "", barred.sentence, code=barred.code)], notes


def _hardly_determined(motion: Motion) -> Iterator[Finding]:
    """Groups that are close to a singular position all the time."""
    from linkwright.analysis.analysis import Analysis
    from linkwright.analysis.singularity import Singularity

    if motion.mechanism.drivers:
        for group, best, limit in Singularity.throughout(Analysis.of(motion)):
            values = {"links": group.links, "best": f"{best:.2g}", "limit": f"{limit:.2g}"}
            message, remedy = (
                _(
                    "group ({links}) is close to a singular position all the time (determinant of its "
                    "closure at most {best}, limit {limit}): its motion is hardly determined, and forces "
                    "grow very large"
                ).format(**values),
                _("change the lengths of its links or where they are joined"),
            )
            yield Finding("warning", "", "", message, remedy, "singular")


def _swings(mechanism: Mechanism) -> dict[str, Phase]:
    """Phases of loads by the strokes of an output, or while it moves one way."""
    phases = {load: each.magnitude.phase for load, each in mechanism.loads.items()}
    return {load: phase for load, phase in phases.items() if phase.outputs}


def _varies(load: Load) -> bool:
    """Whether a load's size follows an expression or a table, which may not hold for all positions."""
    return load.magnitude.size.fallible


def _of_loads(mechanism: Mechanism, loads: Sequence[str], varying: Sequence[str]) -> list[Finding]:
    """Loads whose phase the motion does not have: of an output that never reverses, of more than its stroke, while
    an output moves as it never does; and ``varying`` ones that have no value somewhere in the cycle."""
    from linkwright.applied_loads.over_cycle import activity, magnitudes
    from linkwright.applied_loads.phases import MovingPhase
    from linkwright.kinematics.solve import try_motion
    from linkwright.kinetostatics.signals import MotionSignals

    signals, found = MotionSignals(try_motion(mechanism, TRIED)), []
    for load in loads:
        key, each = f"loads.{load}.phase", mechanism.loads[load]
        phase = each.magnitude.phase
        try:
            acts = activity(each, signals).where
        except LinkwrightError as error:
            found.append(Finding("error", "", key, error.sentence, code="no-motion"))
            continue
        if isinstance(phase, MovingPhase) and not (acts & (signals.output(phase.output)[1] != 0.0)).any():
            message, remedy = (
                NEVER[phase.direction].format(output=phase.output),
                _("name an output that moves that way, or the other direction"),
            )
            found.append(Finding("warning", "", key, message, remedy, "no-motion"))
    for load in varying:
        try:
            magnitudes(mechanism.loads[load], signals)
        except LinkwrightError as error:
            found.append(Finding("error", "", f"loads.{load}", error.sentence, code=error.code))
    return found


def _of_friction(mechanism: Mechanism) -> list[Finding]:
    """Friction of which no force can be found, or so much as no joint has."""
    found: list[Finding] = []
    for joint in mechanism.joints.values():
        key, friction = f"joints.{joint.name}.friction", float(getattr(joint, "friction", 0.0))
        if friction and getattr(joint, "pin_radius", 0.0) is None:
            message, remedy = (
                _("the pin has friction, but no radius, so its forces cannot be found"),
                _("add pin_radius, such as pin_radius: 20 mm"),
            )
            found.append(Finding("error", "", key, message, remedy, "missing-key"))
        if friction > RUBS:
            message, remedy = (
                _("a coefficient of friction of {friction:g} is more than dry rubber has", friction=friction),
                _("usual are 0.01 to 0.6; check it"),
            )
            found.append(Finding("warning", "", key, message, remedy, "unlikely"))
    return found


def _of_settings(mechanism: Mechanism, folder: str, *, moves: bool) -> list[Finding]:
    """What is wrong with sections that only some commands read: report, sheet, course and optimize, the last one's
    numbers where the machine ``moves``."""
    found = _of_report(mechanism.report, mechanism, folder)
    for key, target in READERS.items():
        try:
            if getattr(mechanism, key):
                asked = loaded(target)(mechanism)
                if key == "optimize" and moves:
                    loaded("linkwright.designs.optimise.task:Task")(asked)
        except ModelError as error:
            found += error.findings
        except LinkwrightError as error:
            found.append(Finding("error", "", key, error.sentence, code=error.code))
    return found


def _of_report(section: Mapping[str, Any], mechanism: Mechanism | None, folder: str) -> list[Finding]:
    from linkwright.reports.settings import settings

    try:
        settings(section, mechanism=mechanism, folder=folder)
    except ModelError as error:
        return list(error.findings)
    return []
