"""Function generation: linkages whose output follows given pairs of input and output."""

from __future__ import annotations

import cmath
import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arguments import real
from linkwright.core.arrays import Complexes, Floats
from linkwright.synthesis.candidates import assess_four_bars, four_bar_candidate
from linkwright.synthesis.function_generation.exact import Freudenstein, families, freudenstein, harmonics
from linkwright.synthesis.function_generation.fit import (
    DISTINCT,
    FINE,
    FunctionDemand,
    FunctionDerivation,
    Quality,
    fitted,
    generator_candidate,
    unmet_quality,
)
from linkwright.synthesis.function_generation.generators import KINDS, GearedFiveBar, TurningFourBar
from linkwright.synthesis.names import (
    DEFECTS,
    FUNCTION_NONE,
    NOT_POSITIVE,
    NOT_WITH,
    ONLY_WITH,
    TOO_ROUNDED,
    TYPE_NAMES,
)
from linkwright.synthesis.requirements.slider_crank import multiple, positive
from linkwright.synthesis.result import (
    Candidate,
    Synthesis,
    SynthesisError,
    allowed_transmission,
    different,
    merit,
    ranked,
    require_integers,
)
from linkwright.words import _


def function_generation(
    inputs: ArrayLike,
    outputs: ArrayLike = (),
    *,
    places: ArrayLike | None = None,
    linkage: str = "four_bar",
    input_zero: float | None = None,
    output_zero: float | None = None,
    scale_free: bool = False,
    frame: float | None = None,
    gear_ratio: float | None = None,
    turning: bool = False,
    transmission_angle: float = 0.0,
    least_squares: bool = False,
    equation_error: bool = False,
    rounding: float | None = None,
    count: int = 6,
    seed: int = 0,
) -> Synthesis:
    """Linkages whose output follows the pairs (input, output).

    Args:
        inputs: angles of the input link (n,), rad.
        outputs: angles of the output link, rad; with a ``slider_crank`` places of the slider, m.
        places: the outputs of a ``slider_crank``, m, instead of ``outputs``; for files, where units are checked.
        linkage: ``four_bar``, ``slider_crank``, ``watt``, ``stephenson`` (six-bars) or ``geared_five_bar``, whose
            output is the turn of the link that its input crank carries.
        input_zero, output_zero: angle (rad; place in m of a slider) of the frame's line O1→O2 (of the slider's zero)
            to the zero of inputs and outputs; None: free.
        scale_free: the output may be scaled; errors are then in units of the demanded output.
        frame: length of O1 O2, m; not given: 1 m (not of a slider-crank, whose size follows from its travel).
        gear_ratio: turns of the geared crank per turn of the input; not given: -1 (a geared five-bar's only).
        turning: the input must turn fully.
        transmission_angle: the smallest that is allowed, rad: over the full turn of an input that turns fully, else
            between the first and the last pair.
        least_squares: a four-bar of least squares even where 3 to 5 pairs can be met exactly.
        equation_error: the four-bar of least squares in Freudenstein's equation, for given zero angles: linear, as
            textbooks do it; its structural error is larger than that of the others.
        rounding: the lengths of a four-bar are multiples of this length, m; its error is then that of the rounded
            lengths.
        count, seed: candidates wanted; seed of the random starts.

    Returns:
        Candidates. A four-bar for 3 pairs (Freudenstein), 4, or 5 with free zero angles: exact, all solutions; else
        least squares, globally from many starts. ``error``: root mean square of the structural error at the pairs,
        rad or m; ``worst``: the largest.

    Raises:
        SynthesisError: pairs that do not fit; no real exact solution, none that moves, or none that turns or has
            the transmission angle (``nearest``: the one of least squares, the one with defects, or the one with the
            largest transmission angle).
    """
    _applicable(linkage, outputs, places, frame, gear_ratio, equation_error, rounding)
    x, y = (_values(each) for each in (inputs, outputs if places is None else places))
    frame = 1.0 if frame is None else frame
    _check(x, y, linkage, frame)
    require_integers(count=count)
    require_integers(minimum=0, seed=seed)
    allowed_transmission(transmission_angle)
    quality = Quality(turning, transmission_angle)
    demand = FunctionDemand(x, y, input_zero, output_zero, scale_free)
    free = (input_zero is None) + (output_zero is None)
    fitting = linkage != "four_bar" or least_squares or equation_error
    _distinct(x, y, fitting or len(x) > 5)
    exact = len(x) == 3 or (len(x) == 4 and free) or (len(x) == 5 and free == 2)
    if equation_error:
        found = _by_equation(demand, quality, frame)
    elif linkage == "four_bar" and exact and not scale_free and not least_squares:
        found = _exact(demand, quality, frame, count, seed)
    else:
        generator = KINDS[linkage]()
        if turning and linkage == "four_bar":
            generator = TurningFourBar(transmission_angle)
        if linkage == "geared_five_bar" and gear_ratio is not None:
            generator = GearedFiveBar(gear_ratio)
        found = fitted(generator, demand, quality, frame, count, seed)
    return found if rounding is None else _rounded(found, demand, quality, rounding)


def _rounded(found: Synthesis, demand: FunctionDemand, quality: Quality, rounding: float) -> Synthesis:
    """The four-bars of a result with lengths that are multiples of one (m), those that are still sound.

    Raises SynthesisError where the first one is not; ``nearest``: without rounding.
    """
    positive(rounding=rounding)
    made = [(each, _of_multiples(each, found, demand, rounding)) for each in found]
    good = [
        one for each, one in made if one is not None and set(one.defects) <= set(each.defects) and quality.of(one)[0]
    ]
    if not good or good[0] is not made[0][1]:
        raise SynthesisError(TOO_ROUNDED.format(value=f"{1e3 * rounding:g}"), found)
    derivation = found.derivation
    if isinstance(derivation, FunctionDerivation):
        derivation = replace(derivation, unrounded=_sides(found.best))
    return replace(found, candidates=tuple(good), derivation=derivation)


def _sides(each: Candidate) -> tuple[float, float, float, float]:
    """Lengths a, b, c, d of a four-bar, m."""
    o1, a, b, o2 = (each.linkage.points[name] for name in ("O1", "A", "B", "O2"))
    return abs(a - o1), abs(b - a), abs(b - o2), abs(o2 - o1)


def _of_multiples(each: Candidate, found: Synthesis, demand: FunctionDemand, rounding: float) -> Candidate | None:
    """A four-bar with rounded lengths and the same zero angles; None where a length vanishes or it does not close."""
    a, b, c, frame = (multiple(length, rounding) for length in _sides(each))
    if not min(a, b, c, frame) > 0:
        return None
    output = each.values.get("output_zero [rad]", demand.output_zero)
    if getattr(found.derivation, "method", "") == "equation":
        output = -each.values["output_constant"]
    zero = each.values["input_zero [rad]"]
    x = np.array([[math.log(a / frame), math.log(b / frame), math.log(c / frame), zero]])
    o2, pin, joint = (each.linkage.points[name] for name in ("O2", "A", "B"))
    side = np.sign(((o2 - pin).conjugate() * (joint - pin)).imag)
    rounded = replace(demand, input_zero=zero, output_zero=output)
    return generator_candidate(KINDS["four_bar"](), rounded, x, np.array([[side]]), frame)


def _applicable(
    linkage: str,
    outputs: ArrayLike,
    places: ArrayLike | None,
    frame: float | None,
    gear_ratio: float | None,
    equation_error: bool,
    rounding: float | None,
) -> None:
    """Raises SynthesisError for a demand that the kind of linkage does not have."""
    slider = linkage == "slider_crank"
    if places is not None and np.size(outputs):
        raise SynthesisError(NOT_WITH.format(demand="places", other='"outputs"'))
    for demand, present, needs in (
        ("gear_ratio", gear_ratio is not None and linkage != "geared_five_bar", "geared_five_bar"),
        ("equation_error", equation_error and linkage != "four_bar", "four_bar"),
        ("rounding", rounding is not None and linkage != "four_bar", "four_bar"),
        ("places", places is not None and not slider, "slider_crank"),
    ):
        if present:
            raise SynthesisError(ONLY_WITH.format(demand=demand, needs=f"linkage: {needs}"))
    if frame is not None and slider:
        raise SynthesisError(NOT_WITH.format(demand="frame", other='"linkage: slider_crank"'))


def _values(values: ArrayLike) -> Floats:
    """Values as an array; of what are no numbers one that is no list of values."""
    try:
        return np.asarray(values, float)
    except (TypeError, ValueError):
        return np.array(math.nan)


def _check(x: Floats, y: Floats, linkage: str, frame: float) -> None:
    if linkage not in KINDS:
        raise SynthesisError(
            _(
                'there is no function generator "{linkage}"; known: {known}',
                code="synthesize.function.linkage",
                linkage=linkage,
                known=tuple(KINDS),
            )
        )
    if x.ndim != 1 or x.shape != y.shape or not np.isfinite(np.concatenate([x, y])).all():
        raise SynthesisError(
            _(
                "inputs and outputs must be lists of the same number of finite values; given: {inputs} and {outputs}",
                code="synthesize.function.values",
                inputs=x.size,
                outputs=y.size,
            )
        )
    if len(x) < 3:
        raise SynthesisError(
            _(
                "{count} pairs of values are too few for a function; give 3 or more",
                code="synthesize.function.few",
                count=len(x),
            )
        )
    if not 0 < real("frame", frame, finite=False) < math.inf:
        raise SynthesisError(NOT_POSITIVE.format(name="frame", value=f"{frame:g}"))


def _distinct(x: Floats, y: Floats, fitting: bool) -> None:
    """Raises SynthesisError for outputs that stand still, and for pairs of the same input.

    What is ``fitting`` may hold a pair twice, but not one input with two outputs.
    """
    if np.ptp(y) <= 1e-12 * max(1e-300, float(np.abs(y).max())):
        raise SynthesisError(
            _(
                "all outputs are equal: no linkage of this kind rests while its input moves; the "
                "task dwell has one that rests for a part of the turn",
                code="synthesize.function.constant",
            )
        )
    same = np.triu(np.abs(np.exp(1j * x[:, None]) - np.exp(1j * x)) < 1e-9, 1)
    distance = np.where(same, np.abs(y[:, None] - y), -1.0)
    full = np.abs(distance - 2 * np.pi) < 1e-9
    distance = np.where(full, 0.0, distance)
    i, j = np.unravel_index(int(distance.argmax()), distance.shape)
    if not fitting and 0 <= distance[i, j] <= 1e-9:
        raise SynthesisError(
            _(
                "pairs {first} and {second} are the same; leave one out",
                code="synthesize.function.same",
                first=int(i) + 1,
                second=int(j) + 1,
            )
        )
    if distance[i, j] > 1e-9:
        raise SynthesisError(
            _(
                "pairs {first} and {second} have the same input, and their outputs differ by {difference}, "
                "half of which every linkage is off at one of them; leave one out",
                code="synthesize.function.repeated",
                first=int(i) + 1,
                second=int(j) + 1,
                difference=f"{distance[i, j]:.4g}",
            )
        )


def _exact(demand: FunctionDemand, quality: Quality, frame: float, count: int, seed: int) -> Synthesis:
    zeros, lengths, equation = families(demand.inputs, demand.outputs, (demand.input_zero, demand.output_zero))
    usable = np.isfinite(lengths).all(1) & (np.abs(lengths) > 1e-3).all(1) & (np.abs(lengths) < 1e3).all(1)
    zeros, lengths = zeros[usable], lengths[usable]
    equation = None if equation is None else equation[usable]
    target = np.stack([demand.inputs, demand.outputs])
    if not len(zeros):
        nearest = fitted(KINDS["four_bar"](), demand, Quality(), frame, count, seed)
        error = f"{nearest.best.error:.4g}"
        raise SynthesisError(
            _(
                "no real {linkage} has the given zero angles and meets all {count} positions exactly; "
                "the nearest solution has a maximum error of {error}",
                code="synthesize.function.exact",
                linkage=TYPE_NAMES["four_bar"],
                count=len(demand.inputs),
                error=error,
            ),
            nearest,
        )
    pin: Complexes = lengths[:, :1] * np.exp(1j * (demand.inputs + zeros[:, :1]))
    joint = 1 + lengths[:, 2:] * np.exp(1j * (demand.outputs + zeros[:, 1:]))
    one: Complexes = np.ones(len(pin), complex)
    facts = assess_four_bars(0 * one, pin * frame, joint * frame, frame * one)
    merits = merit(facts.transmission, facts.ratio, facts.longest, 0.0)
    met = quality.met(facts.turns, facts.transmission)
    good = bool((met & facts.sound).any())
    worth = merits if good else quality.reached(facts.turns, facts.transmission)
    order = np.lexsort((-worth, ~facts.sound))
    order = (order[met[order]] if good else order)[: 40 * count]
    made = []
    against = lengths[:, [0, 2]] < 0.0  # a negative length: the link points the other way
    links = np.where(against, (zeros + math.pi) % (2 * math.pi), zeros)
    for i in order:
        values = {"input_zero [rad]": float(links[i, 0]), "output_zero [rad]": float(links[i, 1])}
        each = four_bar_candidate(
            0j, pin[i] * frame, joint[i] * frame, complex(frame), facts, int(i), 0.0, values=values
        )
        off = np.angle((joint[i] - 1) * np.exp(-1j * (demand.outputs + links[i, 1])))
        curve = _four_bar_curve(demand, pin[i], joint[i], float(zeros[i, 1]))
        made.append(replace(each, curve=curve, deviations=off))
    derivation = _way_of(demand, zeros[order[0]], equation[order[0]] if equation is not None else None, frame)
    counts = {"solutions": len(zeros), "sound": int(facts.sound.sum())}
    chosen = different(tuple(made), DISTINCT * frame)[:count]
    result = Synthesis("function", chosen, "angle", target, counts, derivation=derivation)
    if made[0].defects:
        why = tuple(DEFECTS[name] for name in made[0].defects)
        raise SynthesisError(
            _(
                "every {linkage} that meets the positions exactly has defects; the best one has: {why}",
                code="synthesize.function.no_movable",
                linkage=TYPE_NAMES["four_bar"],
                why=why,
            ),
            result,
        )
    if not good:
        raise unmet_quality(quality, result, "four_bar", "exact")
    return result


def _way_of(demand: FunctionDemand, zeros: Floats, equation: Freudenstein | None, frame: float) -> FunctionDerivation:
    """How an exact four-bar with these zero angles was found."""
    free = (demand.input_zero is None, demand.output_zero is None)
    x, y = demand.inputs, demand.outputs
    method, roots = "freudenstein", None
    if equation is None:
        method = "burmester"
    elif len(x) == 4:
        method = "zero_angle"
        of_output = harmonics(x + zeros[0], y, "output")
        roots = of_output if free[1] else harmonics(x, y + zeros[1], "input")
    return FunctionDerivation(
        method, x, y, (float(zeros[0]), float(zeros[1])), free, frame, equation=equation, harmonics=roots
    )


def _by_equation(demand: FunctionDemand, quality: Quality, frame: float) -> Synthesis:
    """The four-bar of least squares in Freudenstein's equation, its structural error measured."""
    zeros = (demand.input_zero or 0.0, demand.output_zero or 0.0)
    equation = freudenstein(demand.inputs[None] + zeros[0], demand.outputs[None] + zeros[1])[0]
    a, b, c = equation.lengths
    fixed_zeros = replace(demand, input_zero=zeros[0], output_zero=zeros[1] + (np.pi if c < 0 else 0.0))
    if not np.isfinite(a + b + c):
        raise SynthesisError(FUNCTION_NONE.format(linkage=TYPE_NAMES["four_bar"]))
    generator = KINDS["four_bar"]()
    start = zeros[0] + (np.pi if a < 0 else 0.0)
    x = np.array([[math.log(abs(a)), math.log(b), math.log(abs(c)), start]])
    sides = [generator_candidate(generator, fixed_zeros, x, np.array([[side]]), frame) for side in (-1.0, 1.0)]
    chosen = ranked([each for each in sides if each is not None], demand.size)[:1]
    if not chosen:
        raise SynthesisError(FUNCTION_NONE.format(linkage=TYPE_NAMES["four_bar"]))
    derivation = FunctionDerivation(
        "equation", demand.inputs, demand.outputs, zeros, (False, False), frame, equation=equation
    )
    target = np.stack([demand.inputs, demand.outputs])
    result = Synthesis("function", chosen, "angle", target, derivation=derivation)
    if not quality.of(chosen[0])[0]:
        raise unmet_quality(quality, result, "four_bar", "equation")
    return result


def _four_bar_curve(demand: FunctionDemand, pin: Complexes, joint: Complexes, zero: float) -> Floats:
    """Input and output (2, m) between the first and last demanded input, for the picture."""
    crank, coupler, output = abs(pin[0]), abs(joint[0] - pin[0]), abs(joint[0] - 1)
    start = cmath.phase(pin[0]) - demand.inputs[0]
    side = np.sign((np.conj(1 - pin[0]) * (joint[0] - pin[0])).imag)
    x = np.array([[math.log(crank), math.log(coupler), math.log(output), start]])
    fine = np.linspace(demand.inputs.min(), demand.inputs.max(), FINE)
    run = KINDS["four_bar"]().run(x, np.array([[side]]), fine)
    first = int(np.abs(fine - demand.inputs[0]).argmin())
    shift = demand.outputs[0] - run.output[0, first] + _small(run.output[0, first] - zero - demand.outputs[0])
    return np.stack([fine, run.output[0] + shift])


def _small(angle: float) -> float:
    """An angle within half a turn of zero, where it is a rounding of full turns; else half turns are taken out."""
    return (angle + math.pi / 2) % math.pi - math.pi / 2
