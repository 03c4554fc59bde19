"""``linkwright check``: everything that is wrong with model files, at once."""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from linkwright import gallery
from linkwright.cli.parser import Options
from linkwright.cli.session import Session
from linkwright.errors import NO_FILE, Finding, LinkwrightError, ModelError
from linkwright.words.sentence import Sentence, code_of

if TYPE_CHECKING:
    from linkwright.elements.topology import Group
    from linkwright.kinematics.motion import Motion
    from linkwright.loads.base import Load
    from linkwright.loads.phases import Phase
    from linkwright.mechanism.mechanism import Mechanism
    from linkwright.structure.analysis import Structure

#: Positions of the cycle that are tried.
TRIED = 72
#: Positions of the cycle that other commands solve unless asked for others; they may lie on change points.
ASKED = 360
#: A coefficient of friction that no pair of materials has.
RUBS = 2.0


def arguments(option: Options) -> None:
    option("files", "FILE", nargs="+")
    option.flag("--strict")


def run(options: argparse.Namespace, session: Session) -> int:
    """Reads, analyses and turns each model once; 1 if any has an error, 2 if a file is not there."""
    results = [(name, *findings_of(name)) for name in options.files]
    if session.json:
        _show_data(results, session)
    else:
        for name, found, fact in results:
            _show(name, found, fact, session)
    everything = [finding for _, found, _ in results for finding in found]
    if any(finding.code in NO_FILE for finding in everything):
        return 2
    grave = {"error", "warning"} if options.strict else {"error"}
    return int(any(finding.severity in grave for finding in everything))


def findings_of(name: str) -> tuple[list[Finding], dict[str, object]]:
    """What there is to say about a model file, and its structure in short where it has one."""
    from linkwright.fields.nodes import below, located
    from linkwright.files.model_file import declared_kind, read_root, read_tree
    from linkwright.files.source import GALLERY, read_source
    from linkwright.kinematics.assembly import AssemblyError
    from linkwright.kinematics.passing_proof import plainly_passed
    from linkwright.kinematics.structure_with_rank import analysed

    try:
        if name.startswith(GALLERY) and name.removeprefix(GALLERY) in gallery.calculations():
            return _of_calculation(name)
        text, place = read_source(name)
        root, faults = read_root(text, place)
        if declared_kind(root) is not None:
            return _of_calculation(name)
        task = _task(text, place)
        if task is not None:
            return task[0], {"kind": f"synthesis, {task[1]}"}
        mechanism, found = read_tree(root, faults, place)
    except ModelError as error:
        return list(error.findings), {}
    if mechanism is None:
        return found, {}
    try:
        built = analysed(mechanism)
        fact: dict[str, object] = {
            "links": len(mechanism.links),
            "mobility": built.mobility,
            "class": built.mechanism_class,
        }
        swings = _swings(mechanism)
        plain = plainly_passed(
            mechanism, built, TRIED, [output for each in swings.values() for output in each.outputs]
        )
        turned, notes = _turned(name, mechanism) if plain is None else ([], [])
    except LinkwrightError as error:
        parts = (isinstance(error, AssemblyError) and error.parts) or (("", error.sentence),)
        barred = (Finding("error", name, key, said, code=code_of(said)) for key, said in parts)
        return [*found, *(replace(located(each, root, place), key="") for each in barred)], {}
    sure = plain or [False] * len(swings)
    unsure = [
        load for (load, phase), each in zip(swings.items(), sure, strict=True) if phase.in_part or not each
    ]
    unsure = [load for load in unsure if all(each.code != "no-motion" for each in found)]
    varying = [load for load, each in mechanism.loads.items() if _varies(each)]
    idle = _of_loads(name, mechanism, unsure, varying) if (unsure or varying) and not turned else []
    notes += _assumed(name, mechanism, built)
    mended = [
        *turned,
        *idle,
        *(_of_cams(name, mechanism) if mechanism.higher else ()),
        *_of_friction(name, mechanism),
        *_of_settings(name, mechanism, moves=not turned),
        *notes,
    ]
    if (section := below(root, "synthesis")) is not None:
        from linkwright.synthesis.tasks import check_section

        found = [*found, *check_section(section, place)[0]]
    return [*found, *(located(each, root, place) for each in mended)], fact


def _assumed(name: str, mechanism: Mechanism, structure: Structure) -> list[Finding]:
    """Notes on dyads whose assembly neither a word nor a drawing says."""
    from linkwright.kinematics.assembly import modal_groups

    found = []
    for group, words in modal_groups(structure).values():
        inner = [each.joint for each in group.inner_joints]
        if not any(joint in mechanism.assembly for joint in inner) and not _drawn(mechanism, group):
            told = {"signature": group.signature, "links": tuple(group.links), "joint": inner[0]}
            message = Sentence("check.assumed", **told, first=words[0], second=words[1])
            found.append(Finding("note", name, "", message, code="assembly"))
    return found


def _drawn(mechanism: Mechanism, group: Group) -> bool:
    """Whether the drawing has a point of a group beside those by which it hangs."""
    outer = {each.joint for each in group.outer_joints}
    return any(
        point not in outer and not mechanism.drawing.keys().isdisjoint((point, f"{link}.{point}"))
        for link in group.links
        for point in mechanism.links[link].points
    )


def _of_cams(name: str, mechanism: Mechanism) -> list[Finding]:
    """Cams whose profile could not be made: their follower would cut away what it should touch."""
    from linkwright.cams.joint import cam_of

    found: list[Finding] = []
    for joint in mechanism.joints.values():
        try:
            faults = cam_of(mechanism, joint.name).findings()
        except TypeError:  # no cam
            continue
        for each in faults:
            key = f"joints.{joint.name}.{each.key.split('.')[-1]}"
            found.append(replace(each, severity="warning", where=name, key=key))
    return found


def _of_calculation(name: str) -> tuple[list[Finding], dict[str, object]]:
    from linkwright.parts.file import check, kind_of, load

    found = check(name)
    if all(each.severity != "error" for each in found):
        try:
            _report(name, load(name).report, None)
        except ModelError as error:
            found += [replace(each, where=name) for each in error.findings]
    return found, {"kind": kind_of(name)}


def _task(text: str, name: str) -> tuple[list[Finding], str] | None:
    """Findings about a text that holds a task of synthesis and no model, and the task; None for every other text."""
    if "synthesis" not in text:
        return None
    from linkwright.synthesis.tasks import check_text

    return check_text(text, name)


def _turned(name: str, mechanism: Mechanism) -> tuple[list[Finding], list[Finding]]:
    """What there is to say about a cycle: where it cannot be passed, and notes."""
    from linkwright.kinematics.solve import try_motion

    motion = try_motion(mechanism, TRIED)
    if motion.whole and motion.notes:
        motion = try_motion(mechanism, ASKED)
    notes = [Finding("note", name, "", note, code=code_of(note)) for note in motion.notes if motion.ok.any()]
    if motion.whole:
        return [], [*_hardly_determined(name, motion), *notes]
    barred = motion.refusal()
    return [Finding("error", name, "", barred.sentence, code=barred.code)], notes


def _hardly_determined(name: str, motion: Motion) -> Iterator[Finding]:
    """Groups that are close to a singular position all the time."""
    from linkwright.metrics.analysis import Analysis
    from linkwright.metrics.singularity import Singularity

    if motion.mechanism.drivers:
        for group, best, limit in Singularity.throughout(Analysis.of(motion)):
            said = {"links": group.links, "best": f"{best:.2g}", "limit": f"{limit:.2g}"}
            told, remedy = Sentence("check.singular", **said), Sentence("check.singular_do")
            yield Finding("warning", name, "", told, remedy, "singular")


def _swings(mechanism: Mechanism) -> dict[str, Phase]:
    """Phases of loads by the strokes of an output, or while it moves one way."""
    phases = {load: each.magnitude.phase for load, each in mechanism.loads.items()}
    return {load: phase for load, phase in phases.items() if phase.outputs}


def _varies(load: Load) -> bool:
    """Whether a load's size follows an expression or a table, which may not hold for all positions."""
    return load.magnitude.size.fallible


def _of_loads(name: str, mechanism: Mechanism, loads: Sequence[str], varying: Sequence[str]) -> list[Finding]:
    """Loads whose phase the motion does not have: of an output that never reverses, of more than its stroke, while
    an output moves as it never does; and ``varying`` ones that have no value somewhere in the cycle."""
    from linkwright.kinematics.solve import try_motion
    from linkwright.kinetostatics.signals import MotionSignals
    from linkwright.loads.over_cycle import activity, magnitudes
    from linkwright.loads.phases import MovingPhase

    signals, found = MotionSignals(try_motion(mechanism, TRIED)), []
    for load in loads:
        key, each = f"loads.{load}.phase", mechanism.loads[load]
        phase = each.magnitude.phase
        try:
            acts = activity(each, signals).where
        except LinkwrightError as error:
            found.append(Finding("error", name, key, error.sentence, code="no-motion"))
            continue
        if isinstance(phase, MovingPhase) and not (acts & (signals.output(phase.output)[1] != 0.0)).any():
            told, remedy = (
                Sentence(f"check.never_{phase.direction}", output=phase.output),
                Sentence("check.never_do"),
            )
            found.append(Finding("warning", name, key, told, remedy, "no-motion"))
    for load in varying:
        try:
            magnitudes(mechanism.loads[load], signals)
        except LinkwrightError as error:
            found.append(Finding("error", name, f"loads.{load}", error.sentence, code=error.code))
    return found


def _of_friction(name: str, mechanism: Mechanism) -> list[Finding]:
    """Friction of which no force can be found, or so much as no joint has."""
    found: list[Finding] = []
    for joint in mechanism.joints.values():
        key, friction = f"joints.{joint.name}.friction", float(getattr(joint, "friction", 0.0))
        if friction and getattr(joint, "pin_radius", 0.0) is None:
            told, remedy = Sentence("check.no_pin_radius"), Sentence("check.add_pin_radius")
            found.append(Finding("error", name, key, told, remedy, "missing-key"))
        if friction > RUBS:
            told, remedy = Sentence("check.rubs", friction=friction), Sentence("check.rubs_do")
            found.append(Finding("warning", name, key, told, remedy, "unlikely"))
    return found


def _of_settings(name: str, mechanism: Mechanism, *, moves: bool) -> list[Finding]:
    """What is wrong with sections that only some commands read: report, sheet, course and optimize, the last one's
    numbers where the machine ``moves``."""
    found = list[Finding]()
    reading: dict[str, Callable[[Mechanism], None]]
    reading = {
        "report": lambda each: _report(name, each.report, each),
        "sheet": _sheet,
        "course": _course,
        "optimize": partial(_optimize, moves=moves),
    }
    for key, read in reading.items():
        try:
            if getattr(mechanism, key):
                read(mechanism)
        except ModelError as error:
            found += [replace(each, where=name) for each in error.findings]
        except LinkwrightError as error:
            found.append(Finding("error", name, key, error.sentence, code=error.code))
    return found


def _report(name: str, given: Mapping[str, Any], mechanism: Mechanism | None) -> None:
    from linkwright.report.settings import settings

    settings(given, mechanism=mechanism, folder=os.path.dirname(name))


def _sheet(mechanism: Mechanism) -> None:
    from linkwright.sheets.settings import check

    check(mechanism)


def _course(mechanism: Mechanism) -> None:
    from linkwright.course.task import task

    task(mechanism)


def _optimize(mechanism: Mechanism, *, moves: bool) -> None:
    from linkwright.designs.optimise.problem import problem
    from linkwright.designs.optimise.task import Task

    asked = problem(mechanism, mechanism.optimize)
    if moves:
        Task(asked)


def _show(name: str, found: list[Finding], fact: dict[str, object], session: Session) -> None:
    for finding in found:
        session.show(session.finding(finding))
    errors = sum(finding.severity == "error" for finding in found)
    if errors:
        session.show(session.strong(session.say("check.faulty", name=name, count=errors)))
    elif "kind" in fact:
        session.show(session.say("check.fine_kind", name=name, kind=fact["kind"]))
    else:
        session.show(session.say("check.fine", name=name, links=fact["links"], mobility=fact["mobility"]))


def _show_data(results: list[tuple[str, list[Finding], dict[str, object]]], session: Session) -> None:
    from linkwright.cli.data import finding_data

    files = [
        {
            "file": name,
            "ok": all(finding.severity != "error" for finding in found),
            **fact,
            "findings": [finding_data(finding) for finding in found],
        }
        for name, found, fact in results
    ]
    session.show_data({"ok": all(entry["ok"] for entry in files), "files": files})
