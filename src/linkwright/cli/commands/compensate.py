"""``linkwright compensate``: a cam that keeps an output constant in a zone of the cycle."""

from __future__ import annotations

import argparse
import re
from pathlib import Path

from linkwright.cli.errors import UsageError
from linkwright.cli.parser import Options
from linkwright.cli.session import Session
from linkwright.errors import about
from linkwright.words import _

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
    from linkwright.cli.files import refuse_output, write_whole
    from linkwright.cli.source import read_model
    from linkwright.core.expressions import amount
    from linkwright.core.table import csv_text
    from linkwright.files.write import dump

    refuse_output(options.output, ENDINGS, force=options.force)
    mechanism, _unused = read_model(options.file, session)
    with about("--zone", UsageError):
        zone = None if options.zone is None else _zone(options.zone, mechanism.across)
    with about("--span", UsageError):
        span = None if options.span is None else amount(options.span, mechanism.across)
    found = compensating_cam(
        mechanism, options.of, joint=options.joint, zone=zone, span=span, steps=options.steps
    )
    if options.output is not None:
        path = Path(options.output)
        text = csv_text(found.columns()) if path.suffix.lower() == ".csv" else dump(found.mechanism)
        write_whole(path, text, force=options.force)
    session.show_result(found, options.output)
    return 0


def _zone(text: str, across: str) -> tuple[float, float]:
    """The ends of a zone, rad or m, from ``-880..-1450 deg``; raises QuantityError."""
    from linkwright.core.expressions import amount

    first, dots, last = (each.strip() for each in text.partition(".."))
    if not dots:
        raise UsageError(
            _(
                '--zone: "{text}" is no zone; write where it begins and ends, such as "90..210 deg"',
                code="compensate.bad_zone",
                text=text,
            )
        )
    unit = re.sub(r"^[-+\d.eE]*", "", last).strip()
    return amount(first if re.search(r"[^-+\d.eE\s]", first) else f"{first} {unit}", across), amount(
        last, across
    )
