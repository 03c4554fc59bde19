"""``linkwright compensate``: a cam that keeps an output constant in a zone of the cycle."""

from __future__ import annotations

import argparse
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from linkwright.cli.errors import UsageError
from linkwright.cli.parser import Options
from linkwright.cli.session import Session
from linkwright.errors import about

if TYPE_CHECKING:
    from linkwright.cams.compensating_cam import CompensatingCam

ENDINGS = (".yaml", ".yml", ".csv")


def arguments(option: Options) -> None:
    option.model()
    option("of", "OUTPUT")
    option("--joint", "NAME", default="")
    zone = option.exclusive()
    zone("--zone", "FROM..TO")
    zone("--span", "WAY")
    option.count("--steps", 1440)
    option("--output", "FILE")
    option.force()


def run(options: argparse.Namespace, session: Session) -> int:
    """Finds the cam, shows what it does, and writes the model with it, or the table of its lift."""
    from linkwright.cams.compensating_cam import compensating_cam
    from linkwright.cli.files import csv_of, refuse_output, write_whole
    from linkwright.cli.source import read_model
    from linkwright.core.expressions import amount
    from linkwright.files.write import dump

    refuse_output(options.output, ENDINGS, force=options.force)
    mechanism, _ = read_model(options.file, session)
    with about("--zone", UsageError):
        zone = None if options.zone is None else _zone(options.zone, mechanism.across)
    with about("--span", UsageError):
        span = None if options.span is None else amount(options.span, mechanism.across)
    found = compensating_cam(
        mechanism, options.of, joint=options.joint, zone=zone, span=span, steps=options.steps
    )
    if options.output is not None:
        path = Path(options.output)
        text = csv_of(_columns(found)) if path.suffix.lower() == ".csv" else dump(found.mechanism)
        write_whole(path, text, force=options.force)
    if session.json:
        session.show_data(_data(found))
        return 0
    session.show("\n".join(_report(found, session)))
    session.show_written(options.output, apart=True)
    return 0


def _zone(text: str, across: str) -> tuple[float, float]:
    """The ends of a zone, rad or m, from ``-880..-1450 deg``; raises QuantityError."""
    from linkwright.core.expressions import amount

    first, dots, last = (each.strip() for each in text.partition(".."))
    if not dots:
        raise UsageError("compensate.bad_zone", text=text)
    unit = re.sub(r"^[-+\d.eE]*", "", last).strip()
    return amount(first if re.search(r"[^-+\d.eE\s]", first) else f"{first} {unit}", across), amount(
        last, across
    )


def _lift_dimension(found: CompensatingCam) -> str:
    """``length`` of a follower that is guided, ``angle`` of one that swings."""
    joint: Any = found.mechanism.joints[found.joint]
    return "angle" if joint.side else "length"


def _columns(found: CompensatingCam) -> dict[str, Any]:
    swings = _lift_dimension(found) == "angle"
    lifts = np.degrees(found.lifts) if swings else 1e3 * found.lifts
    return {"angle [°]": np.degrees(found.angles), f"lift [{'°' if swings else 'mm'}]": lifts}


def _report(found: CompensatingCam, session: Session) -> list[str]:
    """What is kept constant where, and how well."""
    from linkwright.core.quantity import shown

    across, of_lift = found.mechanism.across, _lift_dimension(found)
    first, last = (shown(each, across) for each in found.zone)
    rows = [
        ("before", shown(found.before, found.output.dimension)),
        ("after", shown(found.after, found.output.dimension)),
        ("lift", shown(float(np.ptp(found.lifts)), of_lift)),
    ]
    say = session.say
    output = str(found.output)
    return [
        say("compensate.kept", output=output, joint=found.joint, first=first, last=last),
        *(f"  {say(f'compensate.{key}', output=output)}: {value}" for key, value in rows),
    ]


def _data(found: CompensatingCam) -> dict[str, Any]:
    return {
        "ok": True,
        "joint": found.joint,
        "output": str(found.output),
        "zone": list(found.zone),
        "before": found.before,
        "after": found.after,
        "angles": found.angles.tolist(),
        "lifts": found.lifts.tolist(),
    }
