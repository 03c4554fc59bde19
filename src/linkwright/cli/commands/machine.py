"""``linkwright machine``: motor and flywheel for steady running, of a mechanism or of torque curves."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from linkwright.cli.errors import UsageError
from linkwright.cli.parser import Options
from linkwright.cli.session import Session

if TYPE_CHECKING:
    from linkwright.cli.machine_options import Wanted
    from linkwright.cli.machine_rows import Row
    from linkwright.machine.running import SteadyRunning

ENDINGS = (".csv", ".json")
CURVE_OPTIONS = ("scale", "load", "period", "speed", "inertia", "mass", "gyration")


def arguments(option: Options) -> None:
    option("file", "FILE", nargs="?")
    what = option.group("what_title")
    what("--fluctuation", "δ")
    what("--ratio", "i", default="1")
    what("--efficiency", "η", default="1")
    what("--margin", "NUMBER", default="1")
    shape = what.exclusive()
    for name in ("disk", "rim"):
        shape(f"--{name}", "KEY=VALUE,…", nargs="?", const="")
    curves = option.group("curves_title")
    given = curves.exclusive()
    given("--areas", "MM²,…")
    given("--torque", "EXPRESSION")
    for name in CURVE_OPTIONS:
        curves(f"--{name}", name.upper())
    form = option.group("form_title")
    form.count("--steps", 360)
    form("--output", "FILE")
    form.force()


def run(options: argparse.Namespace, session: Session) -> int:
    """Lays out motor and flywheel and prints them."""
    from linkwright.cli.machine_options import wanted

    _refuse_contradictions(options)
    asked = wanted(options)
    if options.file is not None:
        return _mechanism(options, asked, session)
    if asked.speed is None and (asked.fluctuation is not None or asked.inertia):
        raise UsageError("machine.needs_speed")
    if asked.size is not None and asked.fluctuation is None:
        raise UsageError("machine.shape_needs_fluctuation")
    title, blocks = _curves(options, asked, session)
    _show(title, blocks, [], session)
    return 0


def _refuse_contradictions(options: argparse.Namespace) -> None:
    curves = "--areas" if options.areas is not None else "--torque" if options.torque is not None else None
    if options.file is None and curves is None:
        raise UsageError("machine.nothing_given")
    from_curves = [f"--{name}" for name in CURVE_OPTIONS if getattr(options, name) is not None]
    if options.file is not None and (curves or from_curves):
        raise UsageError("machine.not_with_file", option=curves or from_curves[0])
    if options.file is None and options.output is not None:
        raise UsageError("machine.output_needs_file")
    only = {"--areas": ("load", "period"), "--torque": ("scale",)}
    for name in only.get(curves or "", ()):
        if getattr(options, name) is not None:
            raise UsageError("cli.not_together", name=str(curves), other=f"--{name}")


def _mechanism(options: argparse.Namespace, asked: Wanted, session: Session) -> int:
    from linkwright.cli.files import csv_of, refuse_output, write_table
    from linkwright.cli.machine_rows import of_running
    from linkwright.cli.solve_remarks import closeness
    from linkwright.cli.source import read_model
    from linkwright.kinetostatics.run import solve_forces
    from linkwright.machine.flywheel import FLUCTUATION
    from linkwright.machine.running import steady_running

    refuse_output(options.output, ENDINGS, force=options.force)
    mechanism, _ = read_model(options.file, session)
    forces = solve_forces(mechanism, steps=options.steps)
    running = steady_running(
        forces,
        fluctuation=FLUCTUATION if asked.fluctuation is None else asked.fluctuation,
        ratio=asked.ratio,
        efficiency=asked.efficiency,
        margin=asked.margin,
    )
    columns = _cycle(running) if options.output is not None else {}
    write_table(options.output, lambda: csv_of(columns), lambda: columns, force=options.force)
    warnings = closeness(forces.motion, session.language)
    if running.exact_flywheel == 0:
        warnings.insert(0, session.say("machine.none_needed"))
    warnings[:0] = [each.say(session.language) for each in running.remarks]
    _show(mechanism.name, of_running(running, asked), warnings, session)
    if not session.json:
        session.show_written(options.output, apart=True)
    return 0


def _curves(options: argparse.Namespace, asked: Wanted, session: Session) -> tuple[str, list[list[Row]]]:
    from linkwright.cli.machine_options import areas, curve
    from linkwright.cli.machine_rows import of_areas, of_curves
    from linkwright.machine.energy import fluctuation_from_areas

    say = session.say
    if options.areas is not None:
        given, (torque, angle) = areas(options.areas, options.scale)
        energy = fluctuation_from_areas(given, torque_scale=torque, angle_scale=angle)
        return say("machine.areas_title", count=len(given)), of_areas(energy, asked)
    driver = curve("--torque", options.torque, options.period)
    load = None if options.load is None else curve("--load", options.load, options.period)
    against = say("machine.its_mean") if options.load is None else options.load
    title = say("machine.torque_title", torque=options.torque, load=against)
    return title, of_curves(driver, load, asked, say)


def _cycle(running: SteadyRunning) -> dict[str, Any]:
    """Curves over the cycle, SI: torque, inertia, excess energy, speed with both flywheels."""
    reduced, energy = running.equivalent, running.energy
    return {
        "input [rad]": reduced.start + reduced.direction * energy.angle,
        "equivalent_torque [N·m]": reduced.load(energy.angle),
        "equivalent_inertia [kg·m²]": reduced.inertia_at(energy.angle),
        "excess_energy [J]": energy.energy,
        "speed_with_flywheel [rad/s]": running.speed.at(energy.angle),
        "speed_with_exact_flywheel [rad/s]": running.exact_speed.at(energy.angle),
    }


def _show(title: str, blocks: list[list[Row]], remarks: list[str], session: Session) -> None:
    from linkwright.words.characters import aligned

    say = session.say
    if session.json:
        session.show_data(_data(title, blocks, remarks))
        return
    kept = [block for block in blocks if block]
    lines = aligned([row.cells(say) for block in kept for row in block], "<><>")
    session.show(session.strong(title))
    for block in kept:
        session.show("")
        session.show("\n".join(lines[: len(block)]))
        lines = lines[len(block) :]
    if remarks:
        session.show("\n" + "\n".join(remarks))


def _data(title: str, blocks: list[list[Row]], remarks: list[str]) -> dict[str, Any]:
    """Numbers by name; those of the exact flywheel, which come again, under ``exact_…``."""
    found: dict[str, Any] = {"ok": True, "name": title}
    for row in (row for block in blocks for row in block):
        found[f"exact_{row.key}" if row.key in found else row.key] = row.data()
    return {**found, "remarks": remarks}
