"""Words of synthesis in the dock: tasks, demands, candidates."""

from __future__ import annotations

from linkwright.words import Message, _, pgettext

SYNTHESIS: dict[str, Message] = {
    "dock.task.curve": pgettext("task", "Target curve"),
    "dock.task_help.curve": _(
        "Draw a curve with Target curve [U], or click its points. Linkages whose coupler point follows "
        "it are sought at once."
    ),
    "dock.task.slider_crank": pgettext("task", "Slider-crank by its stroke"),
    "dock.task_help.slider_crank": _(
        "Give the stroke and one more: the rod ratio, or the time ratio with the offset, or the "
        "smallest transmission angle."
    ),
    "dock.task.crank_rocker": pgettext("task", "Crank-rocker by swing and time ratio"),
    "dock.task_help.crank_rocker": _(
        "Give the swing of the rocker, the time ratio K and the length of the frame or of the rocker."
    ),
    "dock.task.quick_return": pgettext("task", "Quick return with a slotted lever"),
    "dock.task_help.quick_return": _(
        "Give the time ratio K and the distance of the pivots; with a stroke a ram is driven."
    ),
    "dock.task.drag_link": pgettext("task", "Drag link by its time ratio"),
    "dock.task_help.drag_link": _("Give the time ratio K and the length of the frame."),
    "dock.task.toggle": pgettext("task", "Toggle by its force ratio"),
    "dock.task_help.toggle": _(
        "Give how many times the force is to grow, at which distance before the dead point, and the stroke."
    ),
    "dock.task.dwell": pgettext("task", "Six-bar whose output rests"),
    "dock.task_help.dwell": _("Give over which crank angle the output rests, and how far it swings else."),
    "dock.task.straight_line": pgettext("task", "Straight-line linkage"),
    "dock.task_help.straight_line": _("Give the length of the line, and how far the point may be off it."),
    "dock.task.function": pgettext("task", "Output as a function of the input"),
    "dock.task_help.function": _("Give angles of the input and those of the output that belong to them, in order."),
    "dock.task.motion": pgettext("task", "Plate through given poses"),
    "dock.task_help.motion": _(
        "Give the poses of a plate: click a place on the sheet and drag in its direction. Two to five "
        "poses are met exactly."
    ),
    "dock.task.path": pgettext("task", "Coupler point past given points"),
    "dock.task_help.path": _(
        "Give the points in the order in which they are passed; click them on the sheet. A four-bar of "
        "least error is sought."
    ),
    "dock.task.exact_path": pgettext("task", "Coupler point exactly through points"),
    "dock.task_help.exact_path": _("Give three to nine points; click them on the sheet."),
    "dock.task.free_curve": pgettext("task", "Any curve, up to twelve bars"),
    "dock.task_help.free_curve": _(
        "Give corners of the curve; click them on the sheet. The search takes 15 seconds."
    ),
    "dock.demand.stroke": pgettext("demand", "Stroke"),
    "dock.demand.rod_ratio": pgettext("demand", "Rod over crank"),
    "dock.demand.offset_ratio": pgettext("demand", "Offset over crank"),
    "dock.demand.quick_return_ratio": pgettext("demand", "Time ratio K"),
    "dock.demand.offset": pgettext("demand", "Offset"),
    "dock.demand.transmission_angle": pgettext("demand", "Transmission angle at least"),
    "dock.demand.rounding": pgettext("demand", "Round lengths to"),
    "dock.demand.swing_angle": pgettext("demand", "Swing"),
    "dock.demand.frame": pgettext("demand", "Length of the frame"),
    "dock.demand.rocker": pgettext("demand", "Length of the rocker"),
    "dock.demand.link_ratio": pgettext("demand", "Longest over shortest link at most"),
    "dock.demand.count": pgettext("demand", "Number of candidates"),
    "dock.demand.rod": pgettext("demand", "Length of the rod"),
    "dock.demand.force_ratio": pgettext("demand", "Force ratio"),
    "dock.demand.distance": pgettext("demand", "Distance before the dead point"),
    "dock.demand.crank_angle": pgettext("demand", "Crank angle of the rest"),
    "dock.demand.length": pgettext("demand", "Length of the line"),
    "dock.demand.deviation": pgettext("demand", "Off by at most"),
    "dock.demand.kind": pgettext("demand", "Linkage"),
    "dock.demand.inputs": pgettext("demand", "Input angles"),
    "dock.demand.outputs": pgettext("demand", "Output angles"),
    "dock.demand.places": pgettext("demand", "Output places"),
    "dock.demand.linkage": pgettext("demand", "Linkage"),
    "dock.demand.input_zero": pgettext("demand", "Zero of the input"),
    "dock.demand.output_zero": pgettext("demand", "Zero of the output"),
    "dock.demand.scale_free": pgettext("demand", "Output to any scale"),
    "dock.demand.gear_ratio": pgettext("demand", "Gear ratio"),
    "dock.demand.turning": pgettext("demand", "The input turns through"),
    "dock.demand.least_squares": pgettext("demand", "Least squares"),
    "dock.demand.equation_error": pgettext("demand", "By Freudenstein's equation"),
    "dock.demand.poses": pgettext("demand", "Poses"),
    "dock.demand.within": pgettext("demand", "Pivots within the box"),
    "dock.demand.fixed_pivots": pgettext("demand", "Given fixed pivots"),
    "dock.demand.moving_pivots": pgettext("demand", "Given moving pivots"),
    "dock.demand.pivot_line": pgettext("demand", "Fixed pivots between"),
    "dock.demand.points": pgettext("demand", "Points"),
    "dock.demand.angles": pgettext("demand", "Crank angles of the points"),
    "dock.demand.phase": pgettext("demand", "Crank angles from any zero"),
    "dock.demand.pivot": pgettext("demand", "Pivot of the crank"),
    "dock.demand.direction": pgettext("demand", "Direction of the frame"),
    "dock.demand.bound": pgettext("demand", "Largest length"),
    "dock.demand.closed": pgettext("demand", "Closed curve"),
    "dock.demand.joints": pgettext("demand", "Joints at most"),
    "dock.demand.size": pgettext("demand", "Size over the curve's at most"),
    "dock.demand.error": pgettext("demand", "Error that is good enough"),
    "dock.no_tasks": _("The tasks could not be read."),
    "dock.task": pgettext("dock", "Task"),
    "dock.more_demands": pgettext("dock", "If wanted"),
    "dock.find_linkages": pgettext("dock", "Find linkages"),
    "dock.on_sheet": _("Click on the sheet"),
    "dock.on_sheet_end": _("Done on the sheet"),
    "dock.row_add": pgettext("dock", "Add a row"),
    "dock.row_remove": _("Remove row {number}"),
    "dock.coordinate": _("{name}, row {number}: {axis}"),
    "dock.angle": pgettext("dock", "angle"),
    "dock.list_hint": _("numbers with commas"),
    "dock.free": pgettext("dock", "any"),
    "dock.searching": pgettext("dock", "Searching"),
    "dock.stop": pgettext("dock", "Stop"),
    "dock.tried": _("{done} of at most {most} tried"),
    "dock.percent": _("{percent} % of the time"),
    "dock.no_candidates": _("Candidates appear here: point at one to see it on the sheet, click to take it."),
    "dock.off": pgettext("dock", "{error} off"),
    "dock.exact": pgettext("dock", "exact"),
    "dock.least_angle": _("μ ≥ {angle}"),
    "dock.take_candidate": _("Take candidate {number}: {type}, {error}"),
    "dock.bars": pgettext("dock", "{count} bars"),
    "dock.search_again": pgettext("dock", "Search again"),
    "dock.draw_target": pgettext("dock", "Draw a target curve"),
}
