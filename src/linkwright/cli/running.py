"""One call of ``run``: the machine's run as the options say, or those of many designs, shown and written."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from linkwright.cli.errors import NOT_TOGETHER, UsageError
from linkwright.cli.files import atomic_write, read_model, write_result
from linkwright.cli.options import Options
from linkwright.cli.pictures import names
from linkwright.cli.positions import duration, one_input, one_speed
from linkwright.cli.session import Session, progress, styled_lines
from linkwright.cli.solve_text import course_lines
from linkwright.cli.solving import FINE, Solved
from linkwright.dynamics.run import run
from linkwright.dynamics.run_text import STEPS, RunText
from linkwright.errors import Finding
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _
from linkwright.words.message import in_language


def conditions(mechanism: Mechanism, options: Options) -> dict[str, Any]:
    """How it begins and ends, as ``run`` takes it; raises UsageError."""
    speed = one_speed(options.speed, mechanism)
    if options.from_rest:
        speed = dict.fromkeys(mechanism.drivers, 0.0)
    return {
        "duration": duration(options.for_time, "--for"),
        "turns": options.turns,
        "until": options.until,
        "at_most": duration(options.at_most, "--at-most"),
        "at": one_input(options.at, mechanism),
        "speed": speed,
    }


def run_alone(options: Options, session: Session) -> int:
    """Runs one machine; 1 where it did not come to its end."""
    mechanism, findings = read_model(options.file, session)
    settings = conditions(mechanism, options)
    if options.prescribed is not None:
        settings["prescribed"] = names(options.prescribed)
    if options.tolerance is not None:
        settings["tolerance"] = options.tolerance
    with progress(session, _("running")) as report:
        found = run(mechanism, method="implicit" if options.stiff else "explicit", progress=report, **settings)
    text = RunText(found, options.steps or STEPS)
    write_result(text, options, session)
    _draw(text, options, session)
    _animate(text, options, session)
    if session.json:
        session.show_data({"ok": found.note is None, **text.data()})
    else:
        session.show_tables(text)
        if options.output is None:
            session.show(*_course(text, findings, options, session))
        session.show_written(options.output, options.plot, options.animate, spaced=True)
    return int(found.note is not None)


def run_many(options: Options, session: Session) -> int:
    """Runs many designs side by side; 1 where some do not run to their end."""
    from linkwright.designs.ranges import grid
    from linkwright.designs.runs_of_designs import run_designs
    from linkwright.designs.varied_dimensions import varied_ranges

    for name in ("prescribed", "stiff", "columns", "points", "steps"):
        if getattr(options, name):
            raise UsageError(NOT_TOGETHER.format(name="--vary", other=f"--{name}"))
    mechanism, _findings = read_model(options.file, session)
    settings = conditions(mechanism, options)
    if options.tolerance is not None:
        settings["tolerance"] = options.tolerance
    columns = grid(varied_ranges(mechanism, options.vary, sampled=False))
    with progress(session, _("designs")) as report:
        found = run_designs(mechanism, columns, progress=report, **settings)
    write_result(found, options, session)
    session.show_result(found, options.output)
    return int(not found.ok.all())


def _course(text: RunText, findings: list[Finding], options: Options, session: Session) -> list[Any]:
    """The course over time, what went wrong with the reading of the model, and notes."""
    share = -(-FINE // text.steps)
    forces = text.run.joint_forces(text.steps * share)
    solved = Solved(forces.motion, forces, np.arange(0, forces.steps, share), tuple(findings))
    lines: list[Any] = ["", *course_lines(solved, options, session)]
    notes = [session.translate(_("Note: {text}", text=in_language(each, session.language))) for each in solved.notes]
    for paragraph in (styled_lines(notes), [session.finding(each) for each in findings]):
        lines += ["", *paragraph] if paragraph else []
    return lines


def _draw(text: RunText, options: Options, session: Session) -> None:
    """Curves over time."""
    if options.plot is None:
        return
    from linkwright.plotting.diagrams.base import plot

    diagram = plot(text.run, options.kind, of=options.of, language=session.language)
    path = Path(options.plot)
    atomic_write(path, diagram.content(path.suffix.lower()), force=options.force)


def _animate(text: RunText, options: Options, session: Session) -> None:
    """A moving drawing in true time."""
    if options.animate is None:
        return
    from linkwright.plotting.animation import animate

    moving = animate(text.run, paths=names(options.paths), language=session.language)
    with progress(session, _("drawing")) as report:
        moving.save(options.animate, progress=report, force=options.force)
