"""Loads as a page takes them: their sizes are formulas of one position, their phases are found over the cycle.

Whether a load acts, how far its phase is passed, and the angles of links that turn are inputs per position of a
page's program, which the page finds once it has the motion.
"""

from __future__ import annotations

from collections.abc import Iterable

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.phases import Always, InputPhase, MovingPhase, SwingPhase
from linkwright.core.json_data import Plain
from linkwright.core.outputs import Output
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import program_names
from linkwright.kinetostatics.load_site import acts_name, middle_name
from linkwright.kinetostatics.signals import MotionSignals
from linkwright.page.positions import known_between


def found_again(load: Load, motion: Motion) -> bool:
    """Whether a page finds it: its size is a formula, and limits that it goes between are those of the positions, not
    of a turn of which these are a part."""
    magnitude = load.magnitude
    if magnitude.limits is None or not magnitude.has_formula:
        return magnitude.has_formula
    return known_between(motion) and (motion.positions.closed or MotionSignals(motion).full_cycle.period is None)


def traced_name(load: Load) -> str:
    """The load as the trace of forces takes it: wholly, or but for its phase."""
    return load.name if isinstance(load.magnitude.phase, Always) else acts_name(load.name)


def phases(loads: Iterable[Load], motion: Motion) -> list[Plain]:
    """The phases, with what they go by: the coordinate of the first driver, or an output by rows of the program."""
    return [
        {"load": load.name, "ramp": load.magnitude.size.ramp, **_phase(load, motion)}
        for load in loads
        if not isinstance(load.magnitude.phase, Always)
    ]


def _phase(load: Load, motion: Motion) -> Plain:
    phase = load.magnitude.phase
    if isinstance(phase, InputPhase):
        return {"kind": "input", "between": interval(load)}
    assert isinstance(phase, MovingPhase | SwingPhase)
    rows, (rate, second) = program_names(motion.mechanism, phase.output)
    part = phase.part if isinstance(phase, SwingPhase) else None
    return {
        "kind": "moving" if isinstance(phase, MovingPhase) else "stroke",
        "rows": list(rows),
        "rate": rate,
        "second": second,
        "moving": moving_name(phase.output),
        "ends": (phase.start, phase.end),
        "part": part and {"word": part.word, "amounts": [[a.value, a.share] for a in part.amounts]},
    }


def interval(load: Load) -> list[str]:
    """Addresses of the coordinates between which a load acts by its input."""
    phase = load.magnitude.phase
    return [f"loads.{load.name}.phase{end}" for end in phase.numbers] if isinstance(phase, InputPhase) else []


def moving_name(output: Output) -> str:
    """Name of the program's output that is the rate of an output, zero at rest."""
    return f"moving {output}"


def angles(loads: Iterable[Load], motion: Motion) -> list[Plain]:
    """The angles that loads take at every position: of link b against a.

    ``near``: where given, a dimension's address, and its value where it is no parameter; the angle begins within half
    a turn of it.
    """
    found: dict[str, Plain] = {}
    for load in loads:
        for (a, b), near in load.magnitude.angles(motion.mechanism).items():
            begin = None if near is None else [f"loads.{load.name}.free_angle", near]
            found[middle_name(a, b)] = {"field": middle_name(a, b), "a": a, "b": b, "near": begin}
    return list(found.values())
