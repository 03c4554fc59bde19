"""Examples of findings and of their mends: parts of one model, wrong and right."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from linkwright.words import Message, pgettext

#: A whole model that is right; its parts are what mends change.
EXAMPLE = """\
format: 1
name: four-bar
frame:
  points: {O1: [0 mm, 0 mm], O2: [400 mm, 0 mm]}
links:
  crank: {points: [O1, A], length: 100 mm}
  coupler: {points: [A, B], length: 350 mm, also: {P: [150 mm, 100 mm]}}
  rocker: {points: [O2, B], length: 250 mm, mass: 2 kg, inertia: 0.01 kg·m², mass_centre: [125 mm, 0 mm]}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 60 rpm}
loads:
  work: {kind: torque, on: rocker, magnitude: -20 N·m}
"""
CRANK = "  crank: {points: [O1, A], length: 100 mm}"
COUPLER = "  coupler: {points: [A, B], length: 350 mm, also: {P: [150 mm, 100 mm]}}"
ROCKER = "  rocker: {points: [O2, B], length: 250 mm, mass: 2 kg, inertia: 0.01 kg·m², mass_centre: [125 mm, 0 mm]}"
POINTS = "  points: {O1: [0 mm, 0 mm], O2: [400 mm, 0 mm]}"
DRIVER = "driver: {turn: crank, about: O1, speed: 60 rpm}"
ASSEMBLY = "assembly: {B: left}"
LOAD = "  work: {kind: torque, on: rocker, magnitude: -20 N·m}"
OPTIMIZE = "optimize: {vary: {coupler.length: 340..360 mm}, minimize: peak_input_torque}"


@dataclass(frozen=True)
class Mend:
    """Lines of a model that have a finding, and the same without it; ``meaning`` of a code without one."""

    wrong: str
    right: str
    meaning: Message | None = None


def with_lines(lines: str) -> str:
    """The example with lines of a mend: in place of the line with the same key, else behind all others."""
    key = lines.partition(":")[0]
    shown = EXAMPLE.splitlines()
    places = [number for number, line in enumerate(shown) if line.partition(":")[0] == key]
    return "\n".join([*shown[: places[0]], lines, *shown[places[0] + 1 :]] if places else [*shown, lines]) + "\n"


#: By the code of the finding.
MENDS: Mapping[str, Mend] = {
    "missing-unit": Mend("  crank: {points: [O1, A], length: 100}", CRANK),
    "unknown-key": Mend("  crank: {points: [O1, A], lenght: 100 mm}", CRANK),
    "missing-key": Mend("driver: {turn: crank, speed: 60 rpm}", DRIVER),
    "decimal-comma": Mend(
        '  crank: {points: [O1, A], length: "100,5 mm"}', "  crank: {points: [O1, A], length: 100.5 mm}"
    ),
    "unknown-unit": Mend("  crank: {points: [O1, A], length: 100 milli}", CRANK),
    "wrong-dimension": Mend("  crank: {points: [O1, A], length: 100 kg}", CRANK),
    "expression": Mend(
        "  crank: {points: [O1, A], length: 2*(50 mm}", "  crank: {points: [O1, A], length: 2*(50 mm)}"
    ),
    "unknown-name": Mend("driver: {turn: krank, about: O1, speed: 60 rpm}", DRIVER),
    "reference": Mend("driver: {turn: crank, about: B, speed: 60 rpm}", DRIVER),
    "near-name": Mend("  rocker: {points: [O2, b], length: 250 mm}", "  rocker: {points: [O2, B], length: 250 mm}"),
    "name": Mend("  crank one: {points: [O1, A], length: 100 mm}", CRANK),
    "unknown-word": Mend("assembly: {B: up}", ASSEMBLY),
    "assembly": Mend("assembly: {}", ASSEMBLY),
    "type": Mend("driver: crank", DRIVER),
    "count": Mend("  points: {O1: [0 mm], O2: [400 mm, 0 mm]}", POINTS),
    "range": Mend("  crank: {points: [O1, A], length: -100 mm}", CRANK),
    "geometry": Mend("  crank: {points: [O1, A], length: 100 mm, lengths: [100 mm, 50 mm]}", CRANK),
    "duplicate-key": Mend(f"{CRANK}\n{CRANK}", CRANK),
    "unused": Mend(f"{ROCKER}\n  spare: {{points: [X, Y], length: 50 mm}}", ROCKER),
    "no-inertia": Mend("  rocker: {points: [O2, B], length: 250 mm, mass: 2 kg}", ROCKER),
    "choice": Mend("  work: {kind: torque, on: rocker, magnitude: -20 N·m, table: {}}", LOAD),
    "circle": Mend("parameters: {b: 3*a, a: 2*b}", "parameters: {b: 30 mm, a: 2*b}"),
    "tab": Mend("driver:\n\tturn: crank", DRIVER),
    "syntax": Mend("driver: {turn: crank, about: O1, speed: 60 rpm", DRIVER),
    "version": Mend("format: 2", "format: 1"),
    "not-met": Mend("expect: {transmission_angle: at least 89 deg}", "expect: {transmission_angle: at least 30 deg}"),
    "nothing-varies": Mend("optimize: {minimize: peak_input_torque}", OPTIMIZE),
    "no-goal": Mend("optimize: {vary: {coupler.length: 340..360 mm}}", OPTIMIZE),
    "demand": Mend(
        f"{OPTIMIZE[:-1]}, keep: {{transmission_angle: big}}}}",
        f"{OPTIMIZE[:-1]}, keep: {{transmission_angle: at least 30 deg}}}}",
    ),
    "falling-demand": Mend(
        f"{OPTIMIZE[:-1]}, keep: {{transmission_angle: 60..30 deg}}}}",
        f"{OPTIMIZE[:-1]}, keep: {{transmission_angle: 30..60 deg}}}}",
    ),
    "wrong-picture": Mend(
        'report: {text: {task: "![gear](gaer.png)"}}', "report: {text: {task: The rocker lifts a lid.}}"
    ),
    "no-section": Mend("report: {sections: [task, strucure]}", "report: {sections: [task, structure]}"),
    "unlikely": Mend(
        "joints: {B: {kind: revolute, pin_radius: 10 mm, friction: 10}}",
        "joints: {B: {kind: revolute, pin_radius: 10 mm, friction: 0.1}}",
    ),
    "mirrored": Mend(
        "drawing: {A: [100 mm, 0 mm], B: [333 mm, -240 mm]}", "drawing: {A: [100 mm, 0 mm], B: [333 mm, 240 mm]}"
    ),
    "drawing-off": Mend(
        "drawing: {A: [100 mm, 0 mm], B: [700 mm, 240 mm]}", "drawing: {A: [100 mm, 0 mm], B: [333 mm, 240 mm]}"
    ),
    "constant": Mend("outputs: {gap: O2.x - 0.1 m}", "outputs: {gap: B.x - 0.1 m}"),
    "never-moves": Mend(
        "driver: {turn: crank, about: O1, position: 30 deg}\ncycle: {duration: 1 s}",
        "driver: {turn: crank, about: O1, position: 30 deg + 1 rad/s * t}\ncycle: {duration: 1 s}",
    ),
    "motion.refused_told": Mend(
        "  crank: {points: [O1, A], length: 200 mm}",
        CRANK,
        pgettext(
            "finding code",
            "The driver cannot pass its whole cycle: at the named input a group of links does not reach, or is "
            "stretched. Change lengths until the driven link can turn fully (Grashof: shortest and longest link "
            "together less than the other two), choose the other assembly, or bound the input with cycle: rock.",
        ),
    ),
    "motion.refused": Mend(
        "  points: {O1: [0 mm, 0 mm], O2: [0 mm, 0 mm]}",
        POINTS,
        pgettext(
            "finding code",
            "The machine cannot be put together at the named input, or nowhere: lengths do not reach each other.",
        ),
    ),
    "motion.not_inner": Mend(
        "assembly: {A: left}",
        ASSEMBLY,
        pgettext(
            "finding code", "Assembly words belong to the inner joint of a dyad, the joint between its own two links."
        ),
    ),
    "motion.no_mode": Mend(
        "assembly: {B: forward}",
        ASSEMBLY,
        pgettext(
            "finding code",
            "This dyad has other words: left or right between three pins, forward or backward where a slide is.",
        ),
    ),
    "mobility.free": Mend(
        "  coupler: {points: [A, C], length: 200 mm}\n  second: {points: [C, B], length: 200 mm}",
        COUPLER,
        pgettext(
            "finding code", "More degrees of freedom than drivers: give a driver for each, or join the links further."
        ),
    ),
    "mobility.free_idle": Mend(
        f"{ROCKER}\n  spare: {{points: [B, Y], length: 50 mm}}",
        ROCKER,
        pgettext("finding code", "A link hangs on one pin and nothing says how it turns: leave it out, or join it."),
    ),
    "mobility.excess": Mend(
        f"{ROCKER}\n  strut: {{points: [O1, B], length: 300 mm}}",
        ROCKER,
        pgettext(
            "finding code",
            "Fewer degrees of freedom than drivers: a link, guide or driver too many locks the machine; remove it.",
        ),
    ),
}
