"""Words of the dock: time line, curves, sweep, synthesis, optimisation, comparison."""

from __future__ import annotations

from linkwright.words import Message, _, pgettext

DOCK: dict[str, Message] = {
    "dock": pgettext("dock", "Time line and curves"),
    "dock.curves": _("Curves"),
    "dock.sweep": pgettext("dock", "Sweep"),
    "dock.synthesis": pgettext("dock", "Synthesis"),
    "dock.optimise": pgettext("dock", "Optimise"),
    "dock.compare": pgettext("dock", "Compare"),
    "dock.solving": pgettext("dock", "Solving"),
    "dock.undriven": _("Nothing is driven yet. Choose {tool} and click the crank."),
    "dock.drive": _("Drive"),
    "dock.cycle": pgettext("dock", "How the input goes"),
    "dock.turn": pgettext("dock", "Turn"),
    "dock.turn_help": _("The input turns through, or goes from its first position to its last."),
    "dock.rock": pgettext("dock", "Rock"),
    "dock.rock_help": _("The input goes to and fro between the limits of the machine."),
    "dock.cycle_of": _("a cycle of {time}"),
    "dock.speed_of": _("{speed} of {own}"),
    "dock.loop": _("Play again and again"),
    "dock.input": _("Input {name}: type a value to go there"),
    "dock.no_input": _("{text} is no position of the input; write it as 90° or 40 mm."),
    "dock.not_reached": _("The input is never at {text}."),
    "dock.acts": _("{name} acts"),
    "dock.max": _("{name} max"),
    "dock.min": _("{name} min"),
    "dock.possible": _("can be assembled"),
    "dock.possible_between": _("The machine can be assembled at: {ranges}"),
}
