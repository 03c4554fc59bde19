"""The tasks and their demands."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from inspect import signature

from linkwright.synthesis.free_curve.generate import free_curve
from linkwright.synthesis.function_generation.generate import function_generation
from linkwright.synthesis.motion_generation.generate import motion_generation
from linkwright.synthesis.path_generation.exact import exact_path_generation
from linkwright.synthesis.path_generation.generate import path_generation
from linkwright.synthesis.requirements.crank_rocker import crank_rocker, quick_return
from linkwright.synthesis.requirements.drag_link import drag_link
from linkwright.synthesis.requirements.dwell import dwell
from linkwright.synthesis.requirements.slider_crank import (
    rounded_slider_crank,
    slider_crank_from_quick_return,
    slider_crank_from_ratios,
    slider_crank_from_transmission,
)
from linkwright.synthesis.requirements.straight_line import straight_line
from linkwright.synthesis.requirements.toggle import toggle
from linkwright.synthesis.result import Synthesis, SynthesisError
from linkwright.words import _

#: The form of each demand, the same in all tasks.
FORMS: Mapping[str, str] = {
    name: form
    for form, names in {
        "length": "stroke offset frame rocker rod distance length deviation bound file_unit rounding",
        "angle": "swing_angle crank_angle transmission_angle input_zero output_zero direction",
        "number": "rod_ratio offset_ratio quick_return_ratio link_ratio force_ratio gear_ratio size error seconds",
        "count": "count seed joints",
        "flag": "scale_free turning least_squares equation_error phase closed",
        "word": "kind linkage",
        "file": "file",
        "point": "pivot",
        "points": "points fixed_pivots moving_pivots",
        "window": "within pivot_line",
        "poses": "poses",
        "angles": "angles inputs outputs",
        "lengths": "places",
    }.items()
    for name in names.split()
}


@dataclass(frozen=True)
class Task:
    """``run`` takes the demands as keywords, and some tasks a ``progress``, which is none."""

    run: Callable[..., Synthesis]

    @property
    def demands(self) -> Mapping[str, str]:
        """The demands with their forms."""
        return {name: FORMS[name] for name in signature(self.run).parameters if name != "progress"}

    @property
    def needed(self) -> tuple[str, ...]:
        """The demands that must be given: those without a default."""
        parameters = signature(self.run).parameters
        return tuple(name for name, each in parameters.items() if each.default is each.empty)


def slider_crank(
    stroke: float,
    *,
    rod_ratio: float | None = None,
    offset_ratio: float | None = None,
    quick_return_ratio: float | None = None,
    offset: float | None = None,
    transmission_angle: float | None = None,
    rounding: float | None = None,
) -> Synthesis:
    """The slider-crank of a stroke (m) and one further demand: see ``requirements/slider_crank.py``.

    ``rounding``: its lengths are multiples of this length (m).

    Raises SynthesisError where the demands are none of those sets, or contradict each other.
    """
    further = {
        "rod_ratio": rod_ratio,
        "offset_ratio": offset_ratio,
        "quick_return_ratio": quick_return_ratio,
        "offset": offset,
        "transmission_angle": transmission_angle,
    }
    chosen = {name for name, value in further.items() if value is not None}
    if rod_ratio is not None and chosen <= {"rod_ratio", "offset_ratio"}:
        found = slider_crank_from_ratios(stroke, rod_ratio, offset_ratio or 0.0)
    elif quick_return_ratio is not None and offset is not None and len(chosen) == 2:
        found = slider_crank_from_quick_return(stroke, quick_return_ratio, offset)
    elif transmission_angle is not None and chosen <= {"transmission_angle", "offset"}:
        found = slider_crank_from_transmission(stroke, transmission_angle, offset or 0.0)
    else:
        raise SynthesisError(
            _(
                "a slider-crank needs stroke and one of: rod_ratio (and offset_ratio); "
                "quick_return_ratio and offset; transmission_angle (and offset); given: {value}",
                code="synthesize.slider_crank.demands",
                value=tuple(sorted(chosen)) or "stroke",
            )
        )
    return found if rounding is None else rounded_slider_crank(found, rounding)


TASKS: Mapping[str, Task] = {
    "slider_crank": Task(slider_crank),
    "crank_rocker": Task(crank_rocker),
    "quick_return": Task(quick_return),
    "drag_link": Task(drag_link),
    "toggle": Task(toggle),
    "dwell": Task(dwell),
    "straight_line": Task(straight_line),
    "function": Task(function_generation),
    "motion": Task(motion_generation),
    "path": Task(path_generation),
    "exact_path": Task(exact_path_generation),
    "free_curve": Task(free_curve),
}
