"""Names of tools, their steps and refusals."""

from __future__ import annotations

from linkwright.words import Message, _, pgettext

#: Every tool by its name in the source; its key is in the front end.
NAMES: dict[str, Message] = {
    "tool.move": pgettext("tool", "Move"),
    "tool.pivot": pgettext("tool", "Pivot"),
    "tool.link": _("Link"),
    "tool.plate": pgettext("tool", "Plate"),
    "tool.slider": _("Slider"),
    "tool.slot": _("Slot"),
    "tool.weld": _("Weld"),
    "tool.gears": _("Gears"),
    "tool.rack": _("Rack"),
    "tool.cam": pgettext("tool", "Cam"),
    "tool.drive": _("Drive"),
    "tool.force": pgettext("tool", "Force"),
    "tool.torque": pgettext("tool", "Torque"),
    "tool.spring": pgettext("tool", "Spring"),
    "tool.mass": pgettext("tool", "Mass"),
    "tool.dimension": pgettext("tool", "Dimension"),
    "tool.target": _("Target curve"),
    "tool.photo": _("Photo"),
    "tool.erase": _("Erase"),
}

#: What the next step of the tools is that draw points, links and pairs; keys stand in brackets.
DRAWING: dict[str, Message] = {
    "hint.pivot": _("Click where the frame holds the machine; a joint that you click is fixed, a pivot is freed"),
    "hint.link.first": _("Click where the link begins: a joint, a link or a free place"),
    "hint.link.next": _("Click the next joint or type its length. [Shift] keeps the angle, [Esc] ends the chain"),
    "hint.link.tap": _("Tap the next joint, or type its length; tap the last joint again to end"),
    "hint.plate.tap": _("Tap the next joint, or type its distances from {last} and {first}; {first} closes it"),
    "hint.plate.first": _("Click three or more joints of the plate, one after the other"),
    "hint.plate.second": _("Click the second joint or type the length of the side"),
    "hint.plate.next": _(
        "Click the next joint, or type how far it is from {last} and {first}. [Enter] or {first} closes the plate"
    ),
    "hint.plate.add": _("Click where {link} gets another point. [Esc] begins a new plate"),
    "hint.slider.point": _("Click the point of a link that slides"),
    "hint.slider.way": _("Click where the guide of {first} leads, or the link that it lies in. [Alt] any direction"),
    "hint.slot.link": _("Click the slotted link"),
    "hint.slot.point": _("Click the point that slides in {first}"),
    "hint.weld": _("Click a joint: its links become one; click it again and they turn about it"),
    "hint.gears.first": _("Click the first of two links that turn on the frame or on one arm"),
    "hint.gears.second": _("Click the link that meshes with {first}"),
    "hint.gears.teeth": _(
        "Type the numbers of teeth, or click where the wheels meet; beyond a pivot one is inside the other"
    ),
    "hint.rack.pinion": _("Click the link with a pivot that is the pinion"),
    "hint.rack.rack": _("Click the slider that {first} drives as a rack"),
    "hint.cam.cam": _("Click the link with a pivot that is the cam"),
    "hint.cam.follower": _("Click the point that follows {first}: of a slider, or of a link with a pivot"),
    "hint.cam.lift": _("Type the lift of {second}, or click how far it goes"),
    "hint.dimension.first": _("Click a link, two points or two links"),
    "hint.dimension.second": _("Click the second point"),
    "hint.dimension.place": _("Click where the dimension stands, then type its value"),
    "hint.dimension.value": _("Type its value. [Enter] sets it, a click lets it go"),
}

#: What values in hand are called.
VALUES: dict[str, Message] = {
    "value.length": pgettext("value", "Length"),
    "value.angle": pgettext("value", "Angle"),
    "value.x": pgettext("value", "x"),
    "value.y": pgettext("value", "y"),
    "value.to": _("To {point}"),
    "value.teeth": _("Teeth"),
    "value.lift": pgettext("value", "Lift"),
}

#: Why a click or a typed value is refused.
REFUSALS: dict[str, Message] = {
    "refuse.length": _("“{text}” is not a length above zero; type it as 140, 4 in or 0.12 m"),
    "refuse.angle": _("“{text}” is not an angle; type it as 35 or 0.6 rad"),
    "refuse.teeth": _("“{text}” are not two numbers of teeth; type them as 20 : 40"),
    "refuse.link_there": _("{link} joins {a} and {b} already; set its length with Dimension N"),
    "refuse.plate_few": _("A plate needs three joints; use Link L for two"),
    "refuse.plate_twice": _(
        "{point} is a corner of this plate already; click another joint, or its first one to close it"
    ),
    "refuse.plate_sides": _("Sides of these lengths do not meet; type longer ones"),
    "refuse.plate_own": _("{point} is a point of {link} already"),
    "refuse.slider_point": _("Slider needs a point of a link; draw one with Link L"),
    "refuse.slider_loose": _("{point} belongs to no link; draw one to it with Link L"),
    "refuse.slider_pivot": _("The frame holds {point}; free it with Pivot P, or click a point that moves"),
    "refuse.slider_there": _("{point} slides already; change its guide in the inspector"),
    "refuse.slot_link": _("Slot needs a link first; click the one with the slot"),
    "refuse.slot_short": _("{link} has one point; a slot needs a link with two"),
    "refuse.slot_point": _("Click the point that slides in {link}"),
    "refuse.slot_own": _("{point} is a point of {link} itself; click a point of another link"),
    "refuse.weld_joint": _("Weld needs a joint; click one"),
    "refuse.weld_single": _("Nothing is joined at {point}; Weld needs a joint of two links"),
    "refuse.gears_link": _("Click a link with a pivot; set one with Pivot P"),
    "refuse.gears_twice": _("A wheel does not mesh with itself; click another link"),
    "refuse.gears_pivot": _("{link} turns about nothing; set a pivot with Pivot P"),
    "refuse.gears_apart": _(
        "{first} and {link} do not turn on one link; give both a pivot with Pivot P, or pin both to one arm"
    ),
    "refuse.gears_same": _("Both wheels turn about the same pivot, where they cannot mesh"),
    "refuse.gears_inside": _("The wheel inside has fewer teeth than the ring; type them so, as 20 : 60"),
    "refuse.rack_link": _("Rack needs a link with a pivot as pinion; set one with Pivot P"),
    "refuse.rack_twice": _("The pinion cannot be its own rack; click a slider"),
    "refuse.rack_pivot": _("{link} has no pivot to turn about; set one with Pivot P"),
    "refuse.rack_slider": _("{link} does not slide on the frame; make it with Slider S"),
    "refuse.rack_none": _("Click a link that slides; make one with Slider S"),
    "refuse.cam_link": _("Cam needs a link with a pivot; set one with Pivot P"),
    "refuse.cam_twice": _("A cam does not move itself; click another link"),
    "refuse.cam_pivot": _("{link} has no pivot to turn about; set one with Pivot P"),
    "refuse.cam_point": _("Click the point that follows {link}"),
    "refuse.cam_own": _("{point} is a point of the cam; click one of the link that it moves"),
    "refuse.cam_follower": _(
        "{point} cannot follow a cam: its link neither slides nor turns on the frame; use Slider S or Pivot P"
    ),
    "refuse.cam_lift": _("Type the lift of {point}, or click farther from the cam"),
    "refuse.dimension_first": _("Click a link or a point to measure"),
    "refuse.dimension_second": _("Click a second point; the dimension runs between the two"),
}

TOOLS: dict[str, Message] = NAMES | DRAWING | VALUES | REFUSALS
