"""Drivers of a tree: what the file says, what the user answers, and what is asked."""

from __future__ import annotations

from linkwright.importers.foreign import Answers
from linkwright.importers.layout import Remarks
from linkwright.importers.trees.tree import Motor, Tree
from linkwright.words import _

#: Speed (rad/s or m/s) where nobody says one.
ASSUMED = 1.0


def add_driver(tree: Tree, found: list[Motor], answers: Answers, remarks: Remarks) -> None:
    """The motors of a tree; a named driver is the only one, and a speed is that of all which have none.

    Without a motor the first joint at the world is asked for; without a speed the coordinate runs at 1 rad/s or m/s.
    """
    moving = [each.name for each in tree.joints.values() if each.moves]
    named = [*([] if answers.driver is None else [answers.driver]), *(each.joint for each in found)]
    unknown = [each for each in named if each not in moving]
    if unknown:
        message = _("there is no joint {name} that could be driven", name=unknown[0])
        remedy = _("name one of {names}", names=tuple(moving))
        remarks.remark("error", message, remedy, "import.no_such_driver")
        return
    if answers.driver is not None:
        known = next((each for each in found if each.joint == answers.driver), None)
        found = [known or Motor("driver", answers.driver)]
    if not found:
        message = _("nothing says which joint is driven")
        remedy = _("say which one: --driver NAME, of {names}", names=tuple(moving))
        remarks.remark("warning", message, remedy, "import.no_driver")
    asked = [each for each in found if answers.speed is not None or (each.speed is None and each.table is None)]
    for motor in asked:
        if answers.speed is not None:
            motor.speed, motor.table = answers.speed, None
            continue
        motor.speed = ASSUMED
        slides = tree.joints[motor.joint].slides is not None
        message = _(
            "nothing says how fast {joint} moves; {speed} is taken",
            joint=motor.joint,
            speed="1 m/s" if slides else "1 rad/s",
        )
        line = tree.joints[motor.joint].line
        remarks.remark("note", message, _("say it: --speed RATE"), "import.no_speed", line=line, key=motor.joint)
    tree.motors = found
