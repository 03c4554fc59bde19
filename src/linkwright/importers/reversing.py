"""Drivers that turn round at the ends of their range, as in programs that drive to and fro by themselves."""

from __future__ import annotations

from linkwright.errors import LinkwrightError
from linkwright.files.model_file import read_text
from linkwright.importers.layout import Layout, Remarks
from linkwright.importers.model_text import model_text
from linkwright.kinematics.input_range import input_range
from linkwright.words import _


def turn_round(layout: Layout, remarks: Remarks) -> None:
    """Lets the only driver, of constant speed, go to and fro, with a remark, where it cannot turn through."""
    if len(layout.drives) != 1 or layout.cycle is not None or layout.drives[0].speed is None:
        return
    try:
        mechanism, _unused = read_text(model_text(layout), "model")
        free = mechanism is not None and input_range(mechanism)
    except LinkwrightError:
        layout.cycle = "rock" if layout.drives[0].slide else None  # which says why it has no range
        return
    if not free or (free.low is None and free.high is None):
        return
    layout.cycle = "rock"
    message = _("the driver reaches the end of its range and goes to and fro there, gently, with the same mean speed")
    remedy = _("give cycle another value where it shall run on, or stop earlier")
    remarks.remark("note", message, remedy, "import.to_and_fro")
