"""The tasks and their demands."""

from __future__ import annotations

from collections.abc import Mapping

from linkwright.synthesis.free_curve.generate import free_curve
from linkwright.synthesis.function_generation.generate import function_generation
from linkwright.synthesis.motion_generation.generate import motion_generation
from linkwright.synthesis.path_generation.exact import exact_path_generation
from linkwright.synthesis.path_generation.generate import path_generation
from linkwright.synthesis.requirements.crank_rocker import crank_rocker, quick_return
from linkwright.synthesis.requirements.drag_link import drag_link
from linkwright.synthesis.requirements.dwell import dwell
from linkwright.synthesis.requirements.slider_crank import (
    slider_crank_from_quick_return,
    slider_crank_from_ratios,
    slider_crank_from_transmission,
)
from linkwright.synthesis.requirements.straight_line import straight_line
from linkwright.synthesis.requirements.toggle import toggle
from linkwright.synthesis.result import Synthesis, refuse
from linkwright.synthesis.tasks import Task


def slider_crank(
    stroke: float,
    *,
    rod_ratio: float | None = None,
    offset_ratio: float | None = None,
    quick_return_ratio: float | None = None,
    offset: float | None = None,
    transmission_angle: float | None = None,
) -> Synthesis:
    """The slider-crank of a stroke (m) and one further demand: see ``requirements/slider_crank.py``.

    Raises SynthesisError where the demands are none of those sets, or contradict each other.
    """
    further = {
        "rod_ratio": rod_ratio,
        "offset_ratio": offset_ratio,
        "quick_return_ratio": quick_return_ratio,
        "offset": offset,
        "transmission_angle": transmission_angle,
    }
    given = {name for name, value in further.items() if value is not None}
    if rod_ratio is not None and given <= {"rod_ratio", "offset_ratio"}:
        return slider_crank_from_ratios(stroke, rod_ratio, offset_ratio or 0.0)
    if quick_return_ratio is not None and offset is not None and len(given) == 2:
        return slider_crank_from_quick_return(stroke, quick_return_ratio, offset)
    if transmission_angle is not None and given <= {"transmission_angle", "offset"}:
        return slider_crank_from_transmission(stroke, transmission_angle, offset or 0.0)
    raise refuse("slider_crank.demands", given=tuple(sorted(given)) or "stroke")


TASKS: Mapping[str, Task] = {
    "slider_crank": Task(
        slider_crank,
        {
            "stroke": "length",
            "rod_ratio": "number",
            "offset_ratio": "number",
            "quick_return_ratio": "number",
            "offset": "length",
            "transmission_angle": "angle",
        },
    ),
    "crank_rocker": Task(
        crank_rocker,
        {
            "swing_angle": "angle",
            "quick_return_ratio": "number",
            "frame": "length",
            "link_ratio": "number",
            "count": "count",
        },
    ),
    "quick_return": Task(
        quick_return, {"quick_return_ratio": "number", "frame": "length", "stroke": "length", "rod": "length"}
    ),
    "drag_link": Task(drag_link, {"quick_return_ratio": "number", "frame": "length", "link_ratio": "number"}),
    "toggle": Task(toggle, {"force_ratio": "number", "distance": "length", "stroke": "length"}),
    "dwell": Task(
        dwell, {"crank_angle": "angle", "swing_angle": "angle", "frame": "length", "seed": "count"}
    ),
    "straight_line": Task(straight_line, {"length": "length", "deviation": "length", "kind": "word"}),
    "function": Task(
        function_generation,
        {
            "inputs": "angles",
            "outputs": "angles",
            "places": "lengths",
            "linkage": "word",
            "input_zero": "angle",
            "output_zero": "angle",
            "scale_free": "flag",
            "frame": "length",
            "gear_ratio": "number",
            "turning": "flag",
            "transmission_angle": "angle",
            "least_squares": "flag",
            "equation_error": "flag",
            "count": "count",
            "seed": "count",
        },
    ),
    "motion": Task(
        motion_generation,
        {
            "poses": "poses",
            "within": "window",
            "fixed_pivots": "points",
            "moving_pivots": "points",
            "pivot_line": "window",
            "link_ratio": "number",
            "count": "count",
        },
    ),
    "path": Task(
        path_generation,
        {
            "points": "points",
            "angles": "angles",
            "phase": "flag",
            "pivot": "point",
            "direction": "angle",
            "bound": "length",
            "transmission_angle": "angle",
            "turning": "flag",
            "count": "count",
            "seed": "count",
        },
    ),
    "exact_path": Task(exact_path_generation, {"points": "points", "count": "count", "seed": "count"}),
    "free_curve": Task(
        free_curve,
        {
            "points": "points",
            "file": "file",
            "file_unit": "length",
            "closed": "flag",
            "joints": "count",
            "transmission_angle": "angle",
            "size": "number",
            "error": "number",
            "seconds": "number",
            "count": "count",
            "seed": "count",
        },
    ),
}
