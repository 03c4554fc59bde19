"""Function generators of minimum structural error, from many random starts at once.

The structural error is what the output deviates from the demand at each input. A free zero of the output is its best
constant, a free scale its best factor: both by linear regression inside the residual, so that the iteration knows
only the linkage's own numbers.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from linkwright.core.arrays import Complexes, Flags, Floats, Integers
from linkwright.core.progress import Progress, current_progress, part_of
from linkwright.core.quantity import number
from linkwright.synthesis.candidates import TYPES, grashof_types
from linkwright.synthesis.function_generation.exact import Freudenstein
from linkwright.synthesis.function_generation.generators import Generator, Run, TurningFourBar
from linkwright.synthesis.least_squares import minimise, with_differences
from linkwright.synthesis.names import FUNCTION_NONE, TYPE_NAMES
from linkwright.synthesis.result import Candidate, Derivation, Synthesis, SynthesisError, different, ranked
from linkwright.words import _

TRIED, SELECTED, LEFT, STEPS = 12_000, 240, 24, 120
#: Residual per unit of what is missing to assemble a position.
PENALTY = 3.0
#: Inputs of a range at which the demanded transmission angle is held, and by how much more of its sin² is aimed at:
#: the optimum, which yields a little, then has it.
HELD, MARGIN = 48, 1e-3
#: Residual per unit of sin² that is missing: the next one where no optimum has the angle with the one before.
HOLDS = (5.0, 40.0, 300.0)
#: Inputs at which the output is drawn.
FINE = 181
#: Candidates whose points differ less than this share of their size are one.
DISTINCT = 0.01
#: What to do where no linkage is good enough, by how it was found.
HINTS = {
    "exact": _('give "least_squares: true", which allows a small error'),
    "equation": _('leave out "equation_error", which allows other link lengths'),
    "fitted": _("leave more numbers free or change the function"),
}


@dataclass(frozen=True, eq=False)
class FunctionDerivation(Derivation):
    """What a function generator was found by.

    ``method``: ``freudenstein`` (three pairs), ``zero_angle`` (four, one zero angle from a determinant),
    ``burmester`` (five), ``equation`` (least squares in Freudenstein's equation), ``search`` (minimum structural
    error); ``zeros``: zero angles of input and output, rad, the free ones as found; ``free``: which were free;
    ``frame``, m; ``equation``: that of the first candidate; ``harmonics`` (5,) of the determinant; ``kind``: the
    linkage; ``unknowns``, ``starts``, ``optima``: of a search; ``unrounded``: lengths a, b, c, d (m) of the first
    candidate before they were rounded.
    """

    method: str
    inputs: Floats
    outputs: Floats
    zeros: tuple[float, float]
    free: tuple[bool, bool]
    frame: float
    kind: str = "four_bar"
    equation: Freudenstein | None = None
    harmonics: Complexes | None = None
    unknowns: int = 0
    starts: int = 0
    optima: int = 0
    unrounded: tuple[float, float, float, float] | None = None


@dataclass(frozen=True, eq=False)
class FunctionDemand:
    """Inputs (n,) rad and outputs (n,) rad or m.

    ``input_zero``, ``output_zero``: given, or None where free; ``scale``: whether the output may be scaled.
    """

    inputs: Floats
    outputs: Floats
    input_zero: float | None
    output_zero: float | None
    scale: bool = False

    @property
    def size(self) -> float:
        """Range of the outputs."""
        return float(np.ptp(self.outputs)) or 1.0

    def matched(self, output: Floats) -> tuple[Floats, Floats, Floats]:
        """Deviations (K, n) of outputs from the demand in its units, and the constant and factor (K,) taken out.

        demanded ≈ constant + factor · output.
        """
        y = self.outputs
        factor = np.ones(len(output))
        if self.scale:
            mean = output.mean(1, keepdims=True)
            spread = ((output - mean) ** 2).sum(1) + 1e-300
            factor = ((output - mean) * (y - y.mean())).sum(1) / spread
        if self.output_zero is None:
            constant = y.mean() - factor * output.mean(1)
        else:
            turn = np.round((y.mean() + self.output_zero - output.mean(1)) / (2 * np.pi)) * 2 * np.pi
            constant = turn - self.output_zero
        return constant[:, None] + factor[:, None] * output - y, constant, factor


@dataclass(frozen=True)
class Quality:
    """Demands in addition to a small error: an input that turns fully, a smallest transmission angle (rad)."""

    turning: bool = False
    transmission: float = 0.0

    def met(self, turns: Flags, transmission: Floats) -> Flags:
        """Which linkages have it."""
        return np.asarray((turns | (not self.turning)) & (transmission >= self.transmission - 1e-9))

    def reached(self, turns: Flags, transmission: Floats) -> Floats:
        """The transmission angle, less half a turn where the input should turn and does not."""
        return np.asarray(np.where(turns | (not self.turning), transmission, transmission - np.pi))

    def of(self, each: Candidate) -> tuple[bool, float]:
        """Whether a candidate has it, and its ``reached``."""
        facts = np.array([each.turns]), np.array([each.transmission_angle])
        return bool(self.met(*facts)[0]), float(self.reached(*facts)[0])

    def missing(self, generator: Generator, x: Floats, signs: Floats, inputs: Floats) -> Floats:
        """By how much sin² of the angle is too small over the demanded range and, of a linkage that turns, over its
        full turn (K, r); (K, 0) where nothing is demanded, or all have it."""
        if isinstance(generator, TurningFourBar) or not (self.turning or self.transmission):
            return np.empty((len(x), 0))
        aim = min(np.sin(self.transmission) ** 2 + MARGIN, 1.0)
        turn = _square_sines(generator, x, signs, float(inputs.min()), generator.turn())
        lacking = np.maximum(aim - turn, 0.0)
        if self.turning:
            return np.asarray(lacking)
        within = _square_sines(generator, x, signs, float(inputs.min()), float(np.ptp(inputs)))
        turns = turn.min(1, keepdims=True) > 0
        return np.concatenate([np.maximum(aim - within, 0.0), np.where(turns, lacking, 0.0)], 1)


def _square_sines(generator: Generator, x: Floats, signs: Floats, first: float, length: float) -> Floats:
    """sin² of the smallest angle at HELD inputs of a range (K, HELD), at its dips at their bottom; below 0 where the
    linkage is not assembled."""
    run = generator.run(x, signs, first + np.linspace(0.0, length, HELD))
    square = run.sine**2 - run.missing**2 / 4
    before, after = square[:, :-2], square[:, 2:]
    bend, rise = before + after - 2 * square[:, 1:-1], after - before
    dip = np.abs(rise) < 2 * bend
    square[:, 1:-1] -= np.where(dip, rise**2 / np.where(dip, 8 * bend, 1.0), 0.0)
    return np.asarray(square)


def fit(
    generator: Generator,
    demand: FunctionDemand,
    quality: Quality,
    hold: float,
    rng: np.random.Generator,
    progress: Progress | None = None,
) -> tuple[Floats, Floats, Floats]:
    """Free numbers (K, m), signs (K, modes) and sums of squares (K,) of local optima, best first."""
    angle = column_of_zero(generator)
    x = generator.sample(rng, TRIED)
    if demand.input_zero is not None:
        x[:, angle] = demand.input_zero
    signs = rng.choice([-1.0, 1.0], (TRIED, generator.modes))
    scale = 1.0 if generator.output_is_angle else demand.size
    free = np.array([j for j in range(x.shape[1]) if demand.input_zero is None or j != angle])

    def residual_of(values: Floats, chosen: Floats) -> Floats:
        run = generator.run(values, chosen, demand.inputs)
        off = demand.matched(run.output * scale)[0]
        off = off + PENALTY * demand.size * run.missing
        held = quality.missing(generator, values, chosen, demand.inputs)
        return np.concatenate([off, hold * demand.size * held], 1)

    first = residual_of(x, signs)
    best = np.argsort(np.einsum("ki,ki->k", first, first))[:SELECTED]
    x, signs = x[best], signs[best]

    def residual(part: Floats, who: Integers) -> Floats:
        values = x[who].copy()
        values[:, free] = part
        return residual_of(values, signs[who])

    found, f, who = minimise(
        with_differences(residual), x[:, free], steps=STEPS, keep=LEFT, halve=15, progress=progress
    )
    values = x[who].copy()
    values[:, free] = found
    return values, signs[who], f


def column_of_zero(generator: Generator) -> int:
    """Column of the input's zero angle among a generator's numbers."""
    return 4 if generator.name == "geared_five_bar" else 3


def fitted(
    generator: Generator, demand: FunctionDemand, quality: Quality, frame: float, count: int, seed: int
) -> Synthesis:
    """The linkages of minimum structural error that have the quality; raises SynthesisError where none has."""
    scale = frame if generator.output_is_angle else demand.size
    made: list[Candidate] = []
    good: list[Candidate] = []
    rounds = 1 if quality == Quality() else len(HOLDS)
    for k, hold in enumerate(HOLDS[:rounds]):
        tell = part_of(current_progress(), k, rounds)
        x, signs, _ = fit(generator, demand, quality, hold, np.random.default_rng(seed), tell)
        found = [generator_candidate(generator, demand, x[i : i + 1], signs[i : i + 1], scale) for i in range(len(x))]
        made += [each for each in found if each is not None]
        good = [each for each in made if quality.of(each)[0]]
        if good:
            break
    if not made:
        raise SynthesisError(FUNCTION_NONE.format(linkage=TYPE_NAMES[generator.name]))
    extent = 0.0 if generator.output_is_angle else float(np.ptp(demand.outputs))
    order = ranked(good, demand.size, extent) if good else _by_quality(made, quality)
    chosen = different(order, DISTINCT * scale)[:count]
    name = "angle" if generator.output_is_angle else "length"
    target = np.stack([demand.inputs, demand.outputs])
    derivation = _searched(generator, demand, chosen[0], frame, len(made)) if chosen else None
    result = Synthesis("function", chosen, name, target, {"optima": len(made)}, extent=extent, derivation=derivation)
    if not good:
        raise unmet_quality(quality, result, generator.name, "fitted")
    return result


def _searched(
    generator: Generator, demand: FunctionDemand, best: Candidate, frame: float, optima: int
) -> FunctionDerivation:
    """How a linkage of minimum structural error was found."""
    free = (demand.input_zero is None, demand.output_zero is None)
    unknowns = generator.sample(np.random.default_rng(0), 1).shape[1] - (not free[0])
    zeros = best.values["input_zero [rad]"], demand.output_zero or 0.0
    return FunctionDerivation(
        "search",
        demand.inputs,
        demand.outputs,
        zeros,
        free,
        frame,
        generator.name,
        unknowns=unknowns,
        starts=TRIED,
        optima=optima,
    )


def _by_quality(made: list[Candidate], quality: Quality) -> tuple[Candidate, ...]:
    """Those without defects first, then by what they have of the quality."""
    return tuple(sorted(made, key=lambda each: (bool(each.defects), -quality.of(each)[1])))


def generator_candidate(
    generator: Generator, demand: FunctionDemand, x: Floats, signs: Floats, scale: float
) -> Candidate | None:
    """One optimum with its facts over the full range; None where it does not assemble at the pairs."""
    unit = 1.0 if generator.output_is_angle else demand.size
    at = generator.run(x, signs, demand.inputs)
    if at.missing.max() > 0:
        return None
    off, constant, factor = demand.matched(at.output * unit)
    fine = np.linspace(demand.inputs.min(), demand.inputs.max(), FINE)
    between = generator.run(x, signs, fine)
    sine_of_turn = min(generator.sines(x, signs, 0.0, generator.turn()))
    turns = sine_of_turn > 0
    sine = sine_of_turn if turns else min(generator.sines(x, signs, demand.inputs.min(), demand.inputs.max()))
    steps = np.diff(demand.inputs)
    monotone = bool((steps >= 0).all() or (steps <= 0).all())
    defects = (() if sine > 0 else ("circuit",)) + (() if monotone else ("order",))
    points = {name: complex(places[0, 0]) * scale for name, places in at.points.items()}
    linkage = generator.linkage(points, turns)
    if not turns:
        low, high = demand.inputs.min() - demand.inputs[0], demand.inputs.max() - demand.inputs[0]
        linkage = replace(linkage, span=(linkage.start + low, linkage.start + high))
    curve = np.stack([fine, between.output[0] * unit * factor[0] + constant[0]])
    lengths = np.array(list(linkage.lengths().values()))
    zero = float(np.angle(at.points["A"][0, 0]) - demand.inputs[0])
    values = {
        "input_zero [rad]": (zero + math.pi) % (2 * math.pi) - math.pi,
        "output_constant": float(constant[0]),
        "scale": float(factor[0]),
    }
    return Candidate(
        linkage,
        float(np.sqrt((off**2).mean())),
        _type(generator, at),
        defects,
        turns,
        float(np.arcsin(min(sine, 1.0))),
        float(lengths.max() / lengths.min()),
        worst=float(np.abs(off).max()),
        curve=curve,
        values=values,
        positions={name: places[0] * scale for name, places in at.points.items()},
        deviations=off[0],
    )


def _type(generator: Generator, run: Run) -> str:
    if generator.name not in ("four_bar", "slider_crank"):
        return generator.name
    if generator.name == "slider_crank":
        crank, rod = (abs(run.points[b][0, 0] - run.points[a][0, 0]) for a, b in (("O1", "A"), ("A", "B")))
        return "slider_crank" if crank + abs(run.points["B"][0, 0].imag) <= rod else "slider_rocker"
    o1, a, b, o2 = (run.points[name][0, 0] for name in ("O1", "A", "B", "O2"))
    return TYPES[int(grashof_types(np.array([[abs(a - o1)], [abs(b - a)], [abs(b - o2)], [abs(o2 - o1)]]))[0])]


def unmet_quality(quality: Quality, nearest: Synthesis, linkage: str, how: str) -> SynthesisError:
    """The refusal of what no linkage has that was found: an input that turns, or the transmission angle."""
    turned = quality.of(nearest.best)[1] > 0
    rule = (
        _(
            "no {linkage} was found with a smallest transmission angle of {asked} deg; the largest "
            "found is {most} deg (the nearest solution is shown): ask for less, or {hint}",
            code="synthesize.function.transmission",
        )
        if turned
        else _(
            "no {linkage} was found whose input turns fully (the nearest solution is shown); leave "
            '"turning" out, or {hint}',
            code="synthesize.function.no_turn",
        )
    )
    message = rule.format(
        linkage=TYPE_NAMES[linkage],
        asked=number(quality.transmission, "angle", 5),
        most=f"{math.floor(100 * math.degrees(nearest.best.transmission_angle)) / 100:g}",
        hint=HINTS[how],
    )
    return SynthesisError(message, nearest)
