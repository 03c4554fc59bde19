"""Words of drives, loads and masses on the sheet, of target curve and photo, first steps and what is shown."""

from __future__ import annotations

from linkwright.words import Message, _, pgettext

_HINTS: dict[str, Message] = {
    "hint.drive": _("Click a link with a pivot to turn it, or a slider to move it; click again to let it go"),
    "hint.force": _("Drag from the point that the force acts on. Its length is its size"),
    "hint.force_size": _("Drag to where the arrow begins, or type size and direction. [Alt] any direction"),
    "hint.torque": _("Press on a link and drag around it"),
    "hint.torque_size": _("Drag around the link, or type the size"),
    "hint.spring": _("Click the first end: a point, a place on a link, or a free place on the frame"),
    "hint.spring_second": _("Click the second end, or type the numbers first"),
    "hint.twist": _("Click the joint of two links, or one link after the other"),
    "hint.twist_second": _("Click the other link"),
    "hint.mass": _("Click a link, then type its mass"),
    "hint.mass_value": _("Type the mass; the moment of inertia follows. [Enter] sets it"),
    "hint.mass_centre": _("Click a link for its mass, or drag a mass centre"),
    "hint.target": _("Draw the curve that a point should follow, or click its points"),
    "hint.target_more": _("Click the next point; the first one closes the curve, [Enter] ends it"),
    "hint.photo": _("Choose a picture, or drop one on the sheet"),
    "hint.photo_first": _("Click one of two places whose distance you know; a drag moves the picture"),
    "hint.photo_second": _("Click the second place"),
    "hint.photo_length": _("Type how far apart they are. [Enter] sets it"),
}

_VALUES: dict[str, Message] = {
    "value.size": pgettext("value", "Size"),
    "value.direction": pgettext("value", "Direction"),
    "value.stiffness": pgettext("value", "Stiffness"),
    "value.twist": pgettext("value", "Stiffness"),
    "value.free_length": _("Free length"),
    "value.preload": pgettext("value", "Preload"),
    "value.damping": pgettext("value", "Damping"),
    "value.mass": pgettext("value", "Mass"),
    "value.speed": pgettext("value", "Speed"),
    "aim.guide": _("Along the guide"),
    "aim.link": _("Along the link"),
    "aim.horizontal": pgettext("direction", "Horizontal"),
    "aim.vertical": pgettext("direction", "Vertical"),
    "aim.left": _("Counter-clockwise"),
    "aim.right": pgettext("direction", "Clockwise"),
}

_REFUSALS: dict[str, Message] = {
    "refuse.no_links": _("There is no link yet; draw one with Link L"),
    "refuse.no_grip": _("A force acts on a link; press on one of its points, or on the link"),
    "refuse.torque_link": _("A torque acts on a link; press on one"),
    "refuse.spring_frame": _("Both ends are on the frame, where nothing moves; click a point of a link"),
    "refuse.spring_link": _("Both ends are on {name}, where nothing changes; click a point of another link"),
    "refuse.twist_links": _("A torsion spring acts between two links; click the joint of two"),
    "refuse.mass_link": _("A mass belongs to a link; click one"),
    "refuse.drive": _("Drive needs a link with a pivot; set one with Pivot P"),
    "refuse.drive_link": _("{name} has no pivot to turn about and no guide; set one with Pivot P or Slider S"),
    "refuse.target": _("A curve needs three points or more; click further ones, or draw it in one go"),
    "refuse.photo": _("This file is no picture that the browser can show"),
    "refuse.photo_length": _("Type how far apart the two places are, as 140 or 4 in"),
    "refuse.force": _("“{text}” is not a force; type it as 250, 1.2 kN or 40 lbf"),
    "refuse.torque": _("“{text}” is not a torque; type it as 12 or 300 N·mm"),
    "refuse.stiffness": _("“{text}” is not a stiffness; type it as 2 or 400 N/m"),
    "refuse.twist": _("“{text}” is not a torsional stiffness; type it as 5 or 5 N·m/rad"),
    "refuse.damping": _("“{text}” is not a damping; type it as 200 or 0.2 N·s/mm"),
    "refuse.mass": _("“{text}” is not a mass; type it as 1.5 or 300 g"),
    "refuse.rate": _("“{text}” is not a speed of turning other than zero; type it as 60 or 6.28 rad/s"),
    "refuse.velocity": _("“{text}” is not a speed other than zero; type it as 100 or 0.1 m/s"),
    "refuse.number": _("“{text}” is not a number"),
}

_SHOWN: dict[str, Message] = {
    "mu.low": _("below 40°"),
    "mu.locks": _("nearly locked"),
    "show": _("Shown on the sheet"),
    "show.velocities": pgettext("shown", "Velocities"),
    "show.accelerations": pgettext("shown", "Accelerations"),
    "show.forces": _("Joint forces"),
    "show.loads": _("Loads"),
    "show.transmission": _("Transmission angles"),
    "show.paths": pgettext("shown", "Paths"),
    "show.limits": pgettext("shown", "Limits"),
    "show.centres": pgettext("shown", "Centres"),
    "show.names": pgettext("shown", "Names"),
    "show.dimensions": _("Dimensions"),
    "show.reach": pgettext("shown", "Reach"),
    "show.outlines": pgettext("shown", "Outlines"),
    "show.grid": _("Grid"),
    "scale": _("Scales of the arrows"),
    "scale.velocity": _("velocity {value}"),
    "scale.acceleration": _("acceleration {value}"),
    "scale.force": _("force {value}"),
    "scale.load": _("load {value}"),
}

_FIRST: dict[str, Message] = {
    "first": _("Draw a machine in four steps"),
    "first.pivot": _("where the frame holds it"),
    "first.link": _("from joint to joint"),
    "first.drive": _("the link that turns"),
    "first.run": _("Run"),
    "first.space": pgettext("key", "Space"),
    "first.moves": _("it moves, curves below"),
    "first.or": _("or begin with"),
    "first.crank_rocker": _("Four-bar"),
    "first.slider_crank_offset": _("Slider-crank"),
    "first.toggle_press": _("Toggle press"),
    "first.theo_jansen_leg": _("Jansen leg"),
    "first.shaper_quick_return": _("Quick-return shaper"),
    "first.gallery": _("Gallery ({count})"),
    "first.curve": _("Follow a curve"),
    "first.photo": _("Trace a photo"),
    "first.close": _("Back to the sheet"),
}

LOADS: dict[str, Message] = _HINTS | _VALUES | _REFUSALS | _SHOWN | _FIRST
