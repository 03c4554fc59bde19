"""Texts of living pages by the keys under which the page asks for them."""

from __future__ import annotations

from linkwright.words import _, pgettext

#: What the page says, and of a position's outcome what it finds itself.
TEXTS = {
    "page.title": _("{name}: living page"),
    "page.play": _("Play"),
    "page.pause": _("Pause"),
    "page.speed": _("Playing speed"),
    "page.position": _("Position"),
    "page.language": _("中文"),
    "page.dimensions": _("Dimensions"),
    "page.loads": _("Loads and masses"),
    "page.driver": _("Drive"),
    "page.numbers": _("Metrics"),
    "page.curves": _("Curves"),
    "page.show": _("Show"),
    "page.paths": _("Paths"),
    "page.names": _("Names"),
    "page.velocities": _("Velocities"),
    "page.accelerations": _("Accelerations"),
    "page.forces": _("Joint forces"),
    "page.centres": _("Mass centres"),
    "page.hodograph": _("Hodograph of {name}"),
    "page.hodographs": _("Hodograph"),
    "page.none": _("none"),
    "page.original": _("original"),
    "page.now": _("now"),
    "page.change": _("change"),
    "page.reset": _("Back to the original"),
    "page.undo": _("Undo"),
    "page.redo": _("Redo"),
    "page.lock": _("Lock {name}"),
    "page.unlock": _("Unlock {name}"),
    "page.keep": _("Keep for comparison"),
    "page.kept": pgettext("page", "Variant {number}"),
    "page.forget": _("Forget {name}"),
    "page.take": _("Take {name}"),
    "page.sweep": _("Paths while {name} varies by 20 % up and down"),
    "page.tolerance": _("Lengths off by up to ±"),
    "page.cloud": _(
        "{built} of {count} machines with such lengths can be built; {paths} is at most {off} off its place."
    ),
    "page.link": _("Copy the link"),
    "page.copied": _("The link with the changed dimensions is in the clipboard."),
    "page.link_shown": _("The link with the changed dimensions is in the address line."),
    "page.download": _("Download the model"),
    "page.studio": _("Open in the studio"),
    "page.studio_copied": _(
        "A link with this model is in the clipboard. It opens in a studio: File, Open a "
        "shared link; or by `linkwright studio LINK`."
    ),
    "page.studio_shown": _(
        "A link with this model is in the address line; copy it. It opens in a studio: File, "
        "Open a shared link; or by `linkwright studio LINK`."
    ),
    "page.link_other": _("This link is of another machine. It opens in a studio: File, Open a shared link."),
    "page.link_broken": _("This link holds no drawing; copy it again, whole."),
    "page.not_written": _("The file gives these in another way, so they are not written into it: {names}."),
    "page.print": _("Print"),
    "page.drawing": _(
        "Drawing of {name}: drag joints, or choose one with the tab key and move it with the arrow keys"
    ),
    "page.joint": _("Joint {name}: {x}, {y}"),
    "page.curve": _("{name} over the input"),
    "page.drag_help": _(
        "Drag a joint or a fixed point: the dimensions of its links follow; locked ones "
        "stay. Arrow keys move a chosen joint, with Shift ten times as far. Space plays."
    ),
    "page.wall": _("Limit at {where}: {sentence}."),
    "page.wall_change": _(
        "Limit: near {where} the group {signature} ({links}) comes to a change point, where "
        "two assemblies meet; this page does not choose between them."
    ),
    "page.wall_length": _("Limit: {name} must stay above zero."),
    "page.transmission_now": _("transmission angle {value} ({name})"),
    "page.not_found_again": _(
        "Forces are shown for the original only: the course of {names} is not found again here."
    ),
    "page.misfit": _("the wheels of {names} do not fit the distance of their centres or of a rack"),
    "page.locking": _("Forces are not shown: with this friction the machine locks, so that no effort moves it."),
    "page.doubtful": _("Forces are not shown: the limit positions between which the loads act are not certain."),
    "page.followed": _(
        "The assembly is tracked from position to position (margin {value}); `linkwright "
        "solve --prove` says whether that is proved."
    ),
    "page.undrawn": _("Not drawn here, but part of all numbers: {names}."),
    "page.made": _(
        "Everything on this page is found by the formulas of Linkwright itself, in your browser; nothing is sent."
    ),
    "page.static": _("This model has one position."),
    "page.compare": _("Comparison"),
    "page.value_of": _("Value of {name}"),
    "page.unlike": _("{name} has no such number."),
    "page.where": _("{name} = {value}"),
    "page.wall_locked": _("Every dimension that could move {name} is locked."),
    "page.wall_still": _("No dimension moves {name} in this direction."),
    "page.sampled_forces": _(
        "Largest forces and torques are those of the {count} positions, not of what lies "
        "between them: loads without a formula are known only there."
    ),
    "page.sampled_all": _("Minimum and maximum are those of the {count} positions, not of what lies between them."),
    "outcome.apart": _("group {signature} ({links}) cannot be assembled: {reason}"),
    "outcome.singular": _(
        "group {signature} ({links}) is at a singular position (dead point or change point), "
        "where its motion is not determined by the driver"
    ),
    "outcome.lost": _(
        "group {signature} ({links}) cannot be tracked to this position: it is out of reach "
        "or beyond a singular position"
    ),
    "outcome.rrr_far": _(
        "the outer pins are {distance} apart, links of {first} and {second} reach {reach}: {missing} missing"
    ),
    "outcome.rrr_near": _(
        "the outer pins are {distance} apart, links of {first} and {second} need at least "
        "{reach}: {missing} too close"
    ),
    "outcome.rrp_far": _(
        "the outer pin is {height} from the path of the slider's pin, the link reaches {length}: {missing} missing"
    ),
    "outcome.rpr_near": _(
        "the outer pins are {distance} apart, the guide holds them {offset} apart across its "
        "direction: {missing} too close"
    ),
    "outcome.rpp_parallel": _("the two slides are parallel (sine of the angle between them {sine})"),
}
