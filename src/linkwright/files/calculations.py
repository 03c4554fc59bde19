"""Kinds of files that hold no machine, and the commands that take them."""

from __future__ import annotations

from linkwright.fields.nodes import Node, Scalar
from linkwright.files.node_reader import PlainReader
from linkwright.registry import listed
from linkwright.words import _

#: The kinds of files that each command takes, and the command of each kind.
TAKES = {
    "beam": ("beam", "link_bending"),
    "statics": ("forces", "rigid_body", "belt", "wedge", "rotor"),
    "cam": ("cam",),
    "vibration": ("vibration", "follower", "mounts"),
    "statistics": ("statistics",),
    "program": ("program",),
    "tolerance": ("tolerance",),
    "trajectory": ("trajectory", "throw"),
}
COMMANDS = {kind: command for command, kinds in TAKES.items() for kind in kinds}


def refuse_kind(reader: PlainReader, node: Scalar) -> None:
    """The finding about a file of a kind where another one is needed, with the command that takes it."""
    kind = node.text
    if kind in COMMANDS:
        reader.finding(
            node,
            "kind",
            _("this is a calculation of the kind {kind}, and no machine"),
            "kind",
            _("linkwright {command} calculates it"),
            kind=kind,
            command=COMMANDS[kind],
        )
    else:
        reader.finding(
            node,
            "kind",
            _('the kind "{kind}" is not known'),
            "kind",
            _("{hint}; the model of a machine has no kind"),
            kind=kind,
            hint=listed(kind, COMMANDS, "one_of"),
        )


def refuse_task(reader: PlainReader, task: Node) -> None:
    """The finding about a file with a task of synthesis where a machine or a calculation is needed."""
    reader.finding(
        task,
        "synthesis",
        _("the file holds a task of synthesis and no machine"),
        "kind",
        _("linkwright synthesize finds machines for it"),
    )
