"""Positions, velocities and accelerations of driven links and of the five dyads."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from linkwright.core.arguments import one_of
from linkwright.core.arrays import Flags, Floats
from linkwright.dyads.cell import Cell, cell
from linkwright.dyads.values import Line, Slide, State, line_inputs, numbers, point_inputs
from linkwright.errors import RequestError
from linkwright.kinematics.motion import Outcome, PositionError
from linkwright.words import _

#: What becomes of positions in which a dyad cannot be assembled.
UNREACHABLE = ("refuse", "mark")


@dataclass(frozen=True, eq=False)
class DyadMotion:
    """The motion of a dyad: everything inside it, arrays of the shape that its inputs have together.

    ``first``, ``second``: its two links, each as a :class:`Line`. A link on an outer pin begins there; its
    line goes to the inner pin (RRR, RRP) or has the direction of the inner guide (RPR, RPP). A link on an outer guide
    has the guide's direction and begins at the inner joint.
    ``inner``: the inner pin; RPR and RPP: the point of the second link that slides on the inner guide.
    ``slides``: of the prismatic joints, in the order of the signature. ``ok``: where the dyad is assembled; elsewhere
    everything is NaN (only with ``unreachable="mark"``).
    """

    signature: str
    first: Line
    second: Line
    inner: State
    slides: tuple[Slide, ...]
    ok: Flags
    inputs: Mapping[str, Floats]

    @property
    def slide(self) -> Slide:
        """The displacement of the first prismatic joint; raises RequestError for RRR, which has none."""
        if not self.slides:
            raise RequestError(
                _(
                    "the {signature} dyad has no prismatic joint, hence no slide",
                    code="dyads.no_slide",
                    signature=self.signature,
                )
            )
        return self.slides[0]

    def __repr__(self) -> str:
        return f"DyadMotion({self.signature}: {np.size(self.ok)} position(s))"


def bar(
    base: Any, angle: ArrayLike, angular_velocity: ArrayLike = 0.0, angular_acceleration: ArrayLike = 0.0
) -> Line:
    """A bar that turns about a known point (bark): its points are those of the line.

    Args:
        base: the pin, a :class:`State`, a point of a solved motion, or (x, y) where it is at rest, m.
        angle: direction of the bar, rad, counter-clockwise from the frame's x axis.
        angular_velocity, angular_acceleration: rad/s and rad/s², absolute.

    Returns:
        The bar as a line that begins at the pin; ``point(0.2)`` is the point 0.2 m along it, ``point(0.2, 0.1)``
        lies 0.1 m to the left of that.

    Raises:
        RequestError: something is no number or no point.
    """
    return _checked(Line(base, angle, angular_velocity, angular_acceleration))


def slider(
    guide: Line,
    displacement: ArrayLike,
    velocity: ArrayLike = 0.0,
    acceleration: ArrayLike = 0.0,
    offset: ArrayLike = 0.0,
) -> Line:
    """A block that is driven along a known guide.

    Args:
        guide: the guide, which may move.
        displacement, velocity, acceleration: of the block along the guide from its origin, m, m/s, m/s².
        offset: normal distance of the block's point from the guide, m, left of its direction positive.

    Returns:
        The block as a line in the guide's direction that begins at the block's point.

    Raises:
        RequestError: something is no number or no line.
    """
    inputs = _named("base_1", line_inputs("guide", guide)) | {
        "slide": numbers("displacement", displacement),
        "rate": numbers("velocity", velocity),
        "second": numbers("acceleration", acceleration),
        "outer_1.offset": numbers("offset", offset),
    }
    found = run(cell("slider").kinematics, inputs)
    angle = np.broadcast_to(np.asarray(guide.angle, dtype=np.float64), np.shape(found["first.x"]))
    return Line(_state(found, "first"), angle, found["first.omega"], found["first.alpha"])


def rrr(
    first: Any, second: Any, lengths: tuple[ArrayLike, ArrayLike], mode: str = "left", *, unreachable: str = "refuse"
) -> DyadMotion:
    """The RRR dyad (rrrk): two links between two known pins.

    Args:
        first, second: the outer pins, each a :class:`State`, a point of a solved motion, or (x, y) at rest.
        lengths: of the first and the second link, from outer to inner pin, m.
        mode: on which side of the ray from the first to the second pin the inner pin lies, ``left`` or ``right``.
        unreachable: ``refuse`` positions in which it cannot be assembled, or ``mark`` them with NaN.

    Raises:
        PositionError: it cannot be assembled, or is singular; the sentence says in which position and by how much.
        RequestError: something is no number or point, or the mode is not one of its words.
    """
    l1, l2 = (_length("lengths", each) for each in _two("lengths", lengths))
    inputs = _pin("base_1", "first", first) | _pin("base_2", "second", second)
    return _solved("RRR", inputs | {"first.B.x": l1, "second.B.x": l2}, mode, unreachable)


def rrp(
    pin: Any,
    guide: Line,
    length: ArrayLike,
    offset: ArrayLike = 0.0,
    mode: str = "forward",
    *,
    unreachable: str = "refuse",
) -> DyadMotion:
    """The RRP dyad (rrpk): a link on a known pin, and a block on a known guide, which may move.

    Args:
        pin: the outer pin, as for :func:`rrr`.
        guide: the guide as a :class:`Line`; the slide counts from its origin.
        length: of the first link, from the outer to the inner pin, m.
        offset: normal distance of the inner pin from the guide, m, left of its direction positive.
        mode: ``forward`` or ``backward``: whether the inner pin lies ahead of or behind the foot of the perpendicular
            from the outer pin, along the guide.
        unreachable: as for :func:`rrr`.

    Raises:
        PositionError, RequestError: as for :func:`rrr`.
    """
    sizes = {"first.B.x": _length("length", numbers("length", length)), "outer_2.offset": numbers("offset", offset)}
    inputs = _pin("base_1", "pin", pin) | _guide("base_2", "guide", guide)
    return _solved("RRP", inputs | sizes, mode, unreachable)


def rpr(
    first: Any,
    second: Any,
    offsets: tuple[ArrayLike, ArrayLike] = (0.0, 0.0),
    mode: str = "forward",
    *,
    unreachable: str = "refuse",
) -> DyadMotion:
    """The RPR dyad (rprk): a guide on a link about the first pin, and a block on a link about the second.

    Args:
        first, second: the outer pins, as for :func:`rrr`; the first link carries the guide.
        offsets: normal distances, m, left of the guide's direction positive: of the guide from the first pin, and of
            the second pin from the guide.
        mode: ``forward`` or ``backward``: whether the second pin lies ahead of or behind the first along the
            guide.
        unreachable: as for :func:`rrr`.

    Raises:
        PositionError, RequestError: as for :func:`rrr`.
    """
    h1, h2 = _two("offsets", offsets)
    inputs = _pin("base_1", "first", first) | _pin("base_2", "second", second)
    return _solved("RPR", inputs | {"inner.offset": h1, "second.B.y": -h2}, mode, unreachable)


def prp(
    first: Line, second: Line, offsets: tuple[ArrayLike, ArrayLike] = (0.0, 0.0), *, unreachable: str = "refuse"
) -> DyadMotion:
    """The PRP dyad (prpk): two blocks on known guides, and a pin between them. It has one assembly mode.

    Args:
        first, second: the guides, each a :class:`Line`; the slides count from their origins.
        offsets: normal distances of the inner pin from the two guides, m, left of their directions positive.
        unreachable: as for :func:`rrr`.

    Raises:
        PositionError: the guides are parallel.
        RequestError: something is no number or no line.
    """
    h1, h2 = _two("offsets", offsets)
    inputs = _guide("base_1", "first", first) | _guide("base_2", "second", second)
    return _solved("PRP", inputs | {"outer_1.offset": h1, "outer_2.offset": h2}, "", unreachable)


def rpp(
    pin: Any,
    guide: Line,
    angle: ArrayLike,
    offsets: tuple[ArrayLike, ArrayLike] = (0.0, 0.0),
    *,
    unreachable: str = "refuse",
) -> DyadMotion:
    """The RPP dyad (rppk): a block on a known guide carries a second guide, on which a link on a known pin slides.

    The first link is the block, the second the link on the pin. It has one assembly mode.

    Args:
        pin: the outer pin, as for :func:`rrr`.
        guide: the outer guide, a :class:`Line`.
        angle: δ, direction of the inner guide against the outer one, rad, counter-clockwise; it is constant.
        offsets: normal distances, m, left positive: of the block's point, through which the inner guide goes, from
            the outer guide, and of the outer pin from the inner guide.
        unreachable: as for :func:`rrr`.

    Raises:
        PositionError: the two guides are parallel.
        RequestError: something is no number, point or line.
    """
    h1, h2 = _two("offsets", offsets)
    inputs = _guide("base_1", "guide", guide) | _pin("base_2", "pin", pin)
    sizes = {"inner.direction": numbers("angle", angle), "outer_1.offset": h1, "inner.offset": h2}
    return _solved("RPP", inputs | sizes, "", unreachable)


# what the functions share ---------------------------------------------------------------------
def _checked(line: Line) -> Line:
    line_inputs("base", line)
    return line


def _two(name: str, value: Any) -> tuple[Floats, Floats]:
    try:
        one, two = value
    except (TypeError, ValueError):
        raise RequestError(
            _(
                "{name}: expected two values, one for each, got {value}",
                code="dyads.no_two",
                name=name,
                value=repr(value)[:60],
            )
        ) from None
    return numbers(name, one), numbers(name, two)


def _length(name: str, value: Floats) -> Floats:
    """Lengths, which are positive; raises RequestError for others."""
    if not np.all(value > 0.0):
        raise RequestError(
            _(
                "{name}: a link's length must be positive, got {value} m",
                code="dyads.no_length",
                name=name,
                value=f"{float(np.min(value)):g}",
            )
        )
    return value


def _named(base: str, inputs: Mapping[str, Floats]) -> dict[str, Floats]:
    return {f"{base}.{name}": value for name, value in inputs.items()}


def _pin(base: str, name: str, value: Any) -> dict[str, Floats]:
    return _named(base, point_inputs(name, value))


def _guide(base: str, name: str, value: Any) -> dict[str, Floats]:
    return _named(base, line_inputs(name, value))


def run(program: Any, inputs: Mapping[str, Floats]) -> dict[str, Floats]:
    """Outputs of a program by name, in the shape that its inputs have together; raises RequestError for inputs that
    have none."""
    try:
        shape = np.broadcast_shapes(*(np.shape(each) for each in inputs.values()))
    except ValueError:
        shapes = sorted({str(np.shape(each)) for each in inputs.values() if np.ndim(each)})
        raise RequestError(
            _(
                "the inputs have different numbers of positions, which do not fit each other: {shapes}",
                code="dyads.no_shape",
                shapes=tuple(shapes),
            )
        ) from None
    flat = {name: np.broadcast_to(each, shape).reshape(-1) for name, each in inputs.items()}
    rows = program.run((), flat, length=int(np.prod(shape)))
    names = (name for name, _unused in program.program.outputs)
    return {name: row.reshape(shape) for name, row in zip(names, rows, strict=True)}


def _solved(signature: str, inputs: dict[str, Floats], mode: str, unreachable: str) -> DyadMotion:
    one_of("unreachable", unreachable, UNREACHABLE)
    own = cell(signature)
    words = own.dyad.words
    if words[0]:
        one_of("mode", mode, words)
        inputs["mode"] = np.asarray(1.0 if mode == words[0] else -1.0)
    found = run(own.kinematics, inputs)
    ok = found["valid"] == 1.0
    if not ok.all():
        if unreachable == "refuse":
            raise _refused(own, found, ok)
        found = {name: np.where(ok, each, np.nan) for name, each in found.items()}
    first, second = _line(found, "first"), _line(found, "second")
    slides = tuple(Slide(*(found[f"{joint}.{rate}"] for rate in ("s", "vs", "as"))) for joint in own.mechanism.guides)
    inner = _inner(signature, first, second, inputs)
    return DyadMotion(signature, first, second, inner, slides, ok, inputs)


def _inner(signature: str, first: Line, second: Line, inputs: Mapping[str, Floats]) -> State:
    """The inner pin, or the point of the second link that slides on the inner guide."""
    if signature in ("RRR", "RRP"):
        return first.point(inputs["first.B.x"])
    if signature == "PRP":
        return State(*(getattr(first.origin, part) for part in ("position", "velocity", "acceleration")))
    return second.point(0.0, inputs["second.B.y"] if signature == "RPR" else -inputs["inner.offset"])


def _state(found: Mapping[str, Floats], link: str) -> State:
    parts = (np.stack([found[f"{link}.{rate}{c}"] for c in "xy"], axis=-1) for rate in ("", "v", "a"))
    return State(*parts)


def _line(found: Mapping[str, Floats], link: str) -> Line:
    """A link; its angle lies in (-π, π]."""
    angle = np.arctan2(found[f"{link}.sin"], found[f"{link}.cos"])
    return Line(_state(found, link), angle, found[f"{link}.omega"], found[f"{link}.alpha"])


def _refused(own: Cell, found: Mapping[str, Floats], ok: Flags) -> PositionError:
    """What is the matter in the first position that fails, and how many do."""
    failed = np.flatnonzero(~ok.reshape(-1))
    at = int(failed[0])
    facts = {name.removeprefix("why:"): float(row.reshape(-1)[at]) for name, row in found.items() if ":" in name}
    numbers_known = np.isfinite(list(facts.values())).all()
    reached = bool(found["reached"].reshape(-1)[at]) and own.dyad.words[0] != ""
    if not numbers_known:
        reason: str = _("its inputs are not finite numbers there", code="dyads.not_finite")
    elif reached:
        reason = _(
            "it is at a singular position (its two assembly modes meet), where its motion is not determined",
            code="dyads.singular",
        )
    else:
        reason = own.dyad.explain(facts)
    message = (
        _(
            "the {signature} dyad cannot be assembled in position {index} ({count} of {of} positions): {reason}",
            code="dyads.apart",
        )
        if ok.ndim
        else _("the {signature} dyad cannot be assembled: {reason}", code="dyads.apart_alone")
    )
    index = at if ok.ndim < 2 else tuple(int(i) for i in np.unravel_index(at, ok.shape))
    sentence = message.format(signature=own.name, index=str(index), reason=reason, count=len(failed), of=ok.size)
    outcome = Outcome(False, sentence, own.name, "singular" if reached else "apart")
    return PositionError(sentence, tuple(int(i) for i in failed), outcome)
