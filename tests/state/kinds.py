"""What needs no mechanism: calculations, gears, laws of motion, syntheses, comparisons, references."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping

import numpy as np
from tests.state.rows import Entries, attempt, columns, curve, leaves

import linkwright as lw
from linkwright import gallery, parts

POSES = [(0, 0, 0), (0.04, 0.015, 0.35), (0.07, 0.045, 0.96), (0.08, 0.09, 1.66), (0.07, 0.13, 2.1)]
PATH = [(0.020, 0.010), (0.01766, 0.015142), (0.011736, 0.017878), (0.005, 0.016928), (0.0006, 0.012736)]
RING = [*PATH, (0.001, 0.006), (0.006, 0.002), (0.014, 0.003), (0.018, 0.006)]
INPUTS, OUTPUTS = [0.0, 0.25, 0.5, 0.75, 1.0], [0.0, 0.3, 0.55, 0.72, 0.85]
#: Demands by task; free curves are left out, since a clock ends their search.
DEMANDS: Mapping[str, tuple[str, Mapping[str, object]]] = {
    "slider crank": ("slider_crank", {"stroke": 0.3, "rod_ratio": 3.5, "offset_ratio": 0.2}),
    "crank rocker": ("crank_rocker", {"swing_angle": 0.7, "quick_return_ratio": 1.2, "frame": 0.3}),
    "quick return": ("quick_return", {"quick_return_ratio": 1.5, "frame": 0.43, "stroke": 0.42, "rod": 0.17}),
    "drag link": ("drag_link", {"quick_return_ratio": 1.5, "frame": 0.1}),
    "toggle": ("toggle", {"force_ratio": 5.0, "distance": 0.01, "stroke": 0.05}),
    "dwell": ("dwell", {"crank_angle": math.radians(60), "swing_angle": math.radians(25)}),
    "straight line": ("straight_line", {"length": 0.1}),
    "function of three pairs": ("function", {"inputs": INPUTS[:3], "outputs": OUTPUTS[:3]}),
    "function of five pairs": ("function", {"inputs": INPUTS, "outputs": OUTPUTS}),
    "function of a slider-crank": (
        "function",
        {"inputs": INPUTS[:3], "places": [0.0, 0.02, 0.05], "linkage": "slider_crank"},
    ),
    "two poses": ("motion", {"poses": POSES[:2]}),
    "three poses": ("motion", {"poses": POSES[:3]}),
    "four poses": ("motion", {"poses": POSES[:4]}),
    "five poses": ("motion", {"poses": POSES}),
    "path": ("path", {"points": PATH}),
    "timed path": ("path", {"points": RING, "angles": [0.698 * k for k in range(9)]}),
    "exact path": ("exact_path", {"points": PATH}),
}
#: Pairs of gears: teeth, module and further numbers.
GEARS: tuple[tuple[tuple[int, int], float, Mapping[str, object]], ...] = (
    ((20, 40), 0.002, {}),
    ((12, 30), 0.003, {"profile_shift": (0.4, -0.1)}),
    ((17, 17), 0.001, {"pressure_angle": math.radians(25), "profile_shift": (0.2, 0.2)}),
    ((20, 60), 0.002, {"internal": True}),
    ((18, 45), 0.0025, {"internal": True, "profile_shift": (0.3, 0.5)}),
    ((8, 9), 0.002, {}),
)
OF_GEARS = (
    "pitch_diameter base_diameter tip_diameter root_diameter form_diameter thickness least_profile_shift undercut"
)
OF_PAIRS = (
    "centre_distance working_pressure_angle backlash ratio path_of_contact contact_ratio tip_clearances tip_overlap"
)
ENDS = ("rest", "velocity", "turn", "motion")


def calculation(name: str) -> Entries:
    """The result of a file of the gallery: numbers, curves, worked steps."""
    problem = parts.load(f"gallery:{name}")
    found = problem.solve()
    yield from leaves(found.data())
    yield from columns(found.columns())


def cam(name: str) -> Entries:
    """What a cam offers beside its table."""
    found = parts.load(f"gallery:{name}").solve()
    for number in range(len(found.cam.walls)):
        yield f"profile/{number}", "m", curve(found.profile(60, number))
    for each in ("pressure_angle_rise", "pressure_angle_fall", "smallest_radius", "hollow_radius", "least_growth"):
        yield each, "", getattr(found, each)
    yield "pitch curve", "m", curve(found.pitch_curve(60))
    yield "cutter path", "m", curve(found.cutter_path(points=60))
    yield from attempt("residual", lambda: [("", "m", curve(found.residual_vibration(np.array([3.0, 9.0]))))])


def gears(number: str) -> Entries:
    """Every number of a pair, and its outlines."""
    teeth, module, options = GEARS[int(number)]
    pair = lw.gear_pair(teeth, module, **options)
    for each in OF_PAIRS.split():
        yield from attempt(each, lambda each=each: leaves(getattr(pair, each)))
    for wheel, angle in (("pinion", 0.1), ("wheel", 0.2)):
        gear = getattr(pair, wheel)
        for each in OF_GEARS.split():
            yield from attempt(f"{wheel}/{each}", lambda gear=gear, each=each: leaves(getattr(gear, each)))
        yield f"{wheel}/outline", "m", curve(gear.turned(angle, 12))
    yield "wheel angle", "", pair.wheel_angle(0.3)
    yield "rack", "m", curve(lw.Rack(3, module).outline())


def laws(ends: str) -> Entries:
    """The laws of motion that fit two ends: curves, peaks, smoothness."""
    u = np.linspace(0.0, 1.0, 41)
    for law in lw.laws_for(*ends.split(" to ")):
        name = f"{law.name}{'' if law.portion is None else law.portion}{' backwards' if law.backwards else ''}"
        if law.any_ends:
            yield name, "", "any ends"
            continue
        own = law.law
        for derivative, values in enumerate(own.curves(u)):
            yield f"{name}/{derivative}", "", curve(values)
        yield f"{name}/peaks", "", [own.peaks.velocity, own.peaks.acceleration, own.peaks.jerk]
        yield f"{name}/smoothness", "", own.smoothness


def programs(name: str) -> Entries:
    """Motion programs: segments joined by laws, and the smoothest one through points."""
    x = np.linspace(0.0, 2 * math.pi, 60, endpoint=False)
    found = PROGRAMS[name]()
    for derivative, values in enumerate(found.curves(x)):
        yield str(derivative), "", curve(values)


def dwells() -> lw.MotionProgram:
    return lw.MotionProgram(
        (
            lw.Segment(2.0, rise=0.02, law="cycloidal"),
            lw.Segment(1.0),
            lw.Segment(2.0, to=0.0, law="poly_3_4_5"),
            lw.Segment(2 * math.pi - 5.0),
        )
    )


def smoothest() -> lw.FoundProgram:
    return lw.FoundProgram(((0.5, 0.0), (2.0, 0.01), (4.0, 0.004)), (lw.Window(2.5, 3.0, 0.008, 0.012),))


PROGRAMS: Mapping[str, Callable[[], object]] = {"dwells": dwells, "smoothest": smoothest}


def synthesis(name: str) -> Entries:
    """Candidates of a task; where there is none, the nearest."""
    task, demands = DEMANDS[name] if name in DEMANDS else (gallery.file(name), {})
    try:
        found = lw.synthesize(task, **demands)
    except lw.SynthesisError as error:
        yield "refused", "", error.code
        if error.nearest is None:
            return
        found = error.nearest
    yield from leaves(found.data())
    if found.candidates:
        best = found.best
        yield from attempt("cognates", lambda: leaves(lw.cognates(best.linkage).data()))
        yield from attempt("loads", lambda: leaves(best.loads(2.0, steps=36)))


COMPARED = (
    ("jaw_crusher_sixbar", "jaw_crusher_fourbar"),
    ("slider_crank_inline", "slider_crank_offset"),
    ("shaper_quick_return", "whitworth"),
)


def comparison(name: str) -> Entries:
    """Alternatives beside each other."""
    yield from leaves(lw.compare([f"gallery:{each}" for each in name.split(" and ")]).data())


def references(_: str) -> Entries:
    """Published numbers, and ours."""
    for row in lw.validate().data():
        yield f"{row['case']}/{row['place']}/{row['what']}", "", row["ours"]
        yield f"{row['case']}/{row['place']}/{row['what']}/ok", "", row["ok"]


def findings(name: str) -> Entries:
    """What is remarked about a file of the gallery as it is."""
    check = lw.check
    yield "", "", [f"{each.severity} {each.code} {each.key}" for each in check(f"gallery:{name}")]


#: Parts with their subjects.
PARTS: Mapping[str, tuple[Callable[[str], Entries], Callable[[], tuple[str, ...]]]] = {
    "calculations": (calculation, gallery.calculations),
    "cams": (cam, lambda: tuple(name for name in gallery.calculations() if name.startswith("cam_"))),
    "gears": (gears, lambda: tuple(map(str, range(len(GEARS))))),
    "laws": (laws, lambda: tuple(f"{a} to {b}" for a, b in itertools.product(ENDS, repeat=2))),
    "programs": (programs, lambda: tuple(PROGRAMS)),
    "synthesis": (synthesis, lambda: (*DEMANDS, *gallery.tasks())),
    "comparisons": (comparison, lambda: tuple(" and ".join(each) for each in COMPARED)),
    "references": (references, lambda: ("published",)),
    "files": (findings, lambda: (*gallery.names(), *gallery.calculations(), *gallery.tasks())),
}
