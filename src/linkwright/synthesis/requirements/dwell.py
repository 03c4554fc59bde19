"""Six-bars whose output rests: a dyad hung on the stretch of a coupler curve that is nearly a circular arc.

While the coupler point P of a crank-rocker runs along an arc of radius ρ, a link P Q of that length leaves its other
end Q where it is: the arc's centre. The output O3 Q then swings by the demanded angle while P passes the rest of its
curve. From an atlas of crank-rockers the arcs over the demanded crank angle are found by the algebraic fit of a
circle (|P|² = 2 Re(P c*) + k, linear in c and k); O3 is taken from a fan of directions and lengths.
Source: Norton, Design of Machinery, sec. 3.9; Kåsa 1976, IEEE Trans. Instrum. Meas. 25 (circle fit).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from linkwright.core.arrays import Complexes, Floats
from linkwright.core.quantity import number
from linkwright.synthesis.function_generation.generators import Stephenson
from linkwright.synthesis.linkage import Linkage
from linkwright.synthesis.path_generation.crank_family import CrankFamily, couplers
from linkwright.synthesis.requirements.slider_crank import positive
from linkwright.synthesis.result import Candidate, Derivation, Synthesis, SynthesisError
from linkwright.words import _

#: Crank-rockers tried, positions of a turn, arcs selected; positions of the turn of a candidate.
ATLAS, SAMPLES, ARCS, FINE = 4000, 72, 40, 3600
MOST_REST, MOST_SWING = np.pi, 2.6
#: Fan of the output's pivot: directions, and arm lengths in units of the arc's radius.
DIRECTIONS, ARMS = 36, np.geomspace(0.2, 3.0, 14)
MIN_TRANSMISSION = np.radians(30)
#: Positions that are shown of a rest.
SHOWN = 9


@dataclass(frozen=True, eq=False)
class Arcs:
    """The best arcs: lengths b, c, d (3, N) with a crank of 1, place of P on the coupler and its path over one turn
    (N, SAMPLES) from the crank angle ``start`` (rad) at which the arc begins, its centre and radius.
    """

    shape: Floats
    arm: Complexes
    p: Complexes
    start: Floats
    centre: Complexes
    radius: Floats

    @property
    def d(self) -> Floats:
        """Frames."""
        return np.asarray(self.shape[2])


@dataclass(frozen=True)
class Fan:
    """The output's pivot: its arm's length, direction from the arc's centre (rad), and the output's swing (rad)."""

    arm: float
    direction: float
    travel: float


@dataclass(frozen=True, eq=False)
class DwellDerivation(Derivation):
    """Demands (rad, m); the crank angles (SHOWN,), rad, of the positions that are shown of the rest; centre and
    radius of the arc, m; four-bars tried and arcs selected."""

    crank_angle: float
    swing_angle: float
    frame: float
    crank: Floats
    centre: complex
    radius: float
    tried: int
    arcs: int


def dwell(crank_angle: float, swing_angle: float, *, frame: float = 1.0, seed: int = 0) -> Synthesis:
    """Six-bars whose output rests over a crank angle (rad) and swings by ``swing_angle`` (rad) else.

    ``frame``: length of the four-bar's frame, m. ``error``: the output's maximum deviation during the rest, rad.

    Raises:
        SynthesisError: angles out of range, or no movable six-bar in the atlas; ``nearest``: within the range, or
            with the nearest swing.
    """
    positive(crank_angle=crank_angle, swing_angle=swing_angle, frame=frame)
    degrees = {"swing": number(swing_angle, "angle", 4), "crank": number(crank_angle, "angle", 4)}
    possible = min(crank_angle, MOST_REST), min(swing_angle, MOST_SWING)
    if possible != (crank_angle, swing_angle):
        try:
            nearest: Synthesis | None = dwell(*possible, frame=frame, seed=seed)
        except SynthesisError as error:
            nearest = error.nearest
        raise SynthesisError(
            _(
                "the rest can last up to 180 deg of the crank, and the swing be up to 149 deg, and "
                "{crank} deg and {swing} deg are demanded (the nearest solution is shown)",
                code="synthesize.dwell.range",
                **degrees,
            ),
            nearest,
        )
    arcs = _arcs(crank_angle, np.random.default_rng(seed))
    fans = [_fan(arcs, i, swing_angle) for i in range(len(arcs.d))]
    made = [_output(arcs, i, fans[i], crank_angle, swing_angle, frame) for i in range(len(fans))]
    found = [each for each in made if each is not None]
    if not found:
        raise _none(arcs, fans, crank_angle, swing_angle, frame, degrees)
    found.sort(key=lambda each: each[0].error)
    candidates = tuple(each for each, _ in found[:4])
    return Synthesis("dwell", candidates, "rest", counts={"arcs": ARCS}, derivation=found[0][1])


def _none(
    arcs: Arcs, fans: list[Fan], crank_angle: float, swing: float, frame: float, degrees: dict[str, str]
) -> SynthesisError:
    """The refusal with the output whose swing comes nearest."""
    for i in sorted(range(len(fans)), key=lambda i: abs(fans[i].travel - swing)):
        if np.isfinite(fans[i].travel):
            found = _output(arcs, i, fans[i], crank_angle, fans[i].travel, frame)
            if found is not None:
                near = number(fans[i].travel, "angle", 4)
                nearest = Synthesis("dwell", (found[0],), "rest", derivation=found[1])
                return SynthesisError(
                    _(
                        "no output was found that swings {swing} deg and rests for {crank} deg of the crank with "
                        "a transmission angle above 30 deg; the nearest solution swings {near} deg: ask for a "
                        "shorter rest or that swing",
                        code="synthesize.dwell.none",
                        near=near,
                        **degrees,
                    ),
                    nearest,
                )
    return SynthesisError(
        _(
            "no stretch of a coupler curve was found that is nearly an arc over {crank} deg of the "
            "crank (swing {swing} deg); ask for a shorter rest",
            code="synthesize.dwell.no_arc",
            **degrees,
        )
    )


def _arcs(crank_angle: float, rng: np.random.Generator) -> Arcs:
    window = max(4, round(crank_angle / (2 * np.pi) * SAMPLES) + 1)
    family, free = CrankFamily.random(rng, ATLAS, MIN_TRANSMISSION)
    shape = family.lengths(free)
    keep = ~family.double & (shape.max(0) < 6)
    shape = shape[:, keep]
    theta = np.arange(SAMPLES) * 2 * np.pi / SAMPLES
    a, u = couplers(theta, shape)
    arm = shape[0] * rng.uniform(0.2, 2.0, len(shape[0])) * np.exp(1j * rng.uniform(-np.pi, np.pi, len(shape[0])))
    p = a + arm[:, None] * u
    index = (np.arange(SAMPLES)[:, None] + np.arange(window)) % SAMPLES
    centre, radius, off = fit_circles(p[:, index])
    extent = np.abs(p - p.mean(1, keepdims=True)).max(1, keepdims=True)
    usable = (radius < 3 * extent) & (radius > 0.3 * extent)
    score = np.where(usable, off / extent, np.inf)
    start = score.argmin(1)
    rows = np.argsort(score[np.arange(len(p)), start])[:ARCS]
    first = start[rows]
    paths = np.stack([np.roll(p[row], -k) for row, k in zip(rows, first, strict=True)])
    return Arcs(shape[:, rows], arm[rows], paths, theta[first], centre[rows, first], radius[rows, first])


def fit_circles(p: Complexes) -> tuple[Complexes, Floats, Floats]:
    """Centres, radii and maximum deviations of circles fitted to points (..., n)."""
    middle = p.mean(-1, keepdims=True)
    z = p - middle
    columns = np.stack([2 * z.real, 2 * z.imag, np.ones_like(z.real)], -1)
    normal = columns.swapaxes(-1, -2) @ columns
    right = columns.swapaxes(-1, -2) @ (np.abs(z) ** 2)[..., None]
    lift = 1e-12 * np.einsum("...ii->...", normal)[..., None, None] * np.eye(3)
    x = np.linalg.solve(normal + lift, right)[..., 0]
    c = x[..., 0] + 1j * x[..., 1]
    radius = np.sqrt(np.maximum(x[..., 2] + np.abs(c) ** 2, 0))
    off = np.abs(np.abs(z - c[..., None]) - radius[..., None]).max(-1)
    return c + middle[..., 0], radius, off


def _fan(arcs: Arcs, i: int, swing: float) -> Fan:
    """The pivot of a fan about one arc's centre whose output swings most nearly as demanded."""
    p, centre, rod = arcs.p[i], arcs.centre[i], arcs.radius[i]
    arms, directions = np.meshgrid(ARMS * rod, np.arange(DIRECTIONS) * 2 * np.pi / DIRECTIONS)
    arm, pivot = arms.ravel(), (centre + arms * np.exp(1j * directions)).ravel()
    angle, sine = _follow(p, pivot, arm, rod, centre)
    travel = np.ptp(angle, axis=1)
    good = np.isfinite(travel) & (np.abs(sine).min(1) > np.sin(MIN_TRANSMISSION))
    best = int(np.where(good, np.abs(travel - swing), np.inf).argmin())
    return Fan(float(arm[best]), float(directions.ravel()[best]), float(travel[best]) if good[best] else np.inf)


def _output(
    arcs: Arcs, i: int, fan: Fan, crank_angle: float, swing: float, frame: float
) -> tuple[Candidate, DwellDerivation] | None:
    """The output of one arc with the demanded swing; None where there is none near the fan's."""
    if not abs(fan.travel - swing) <= 0.25 * swing:
        return None
    theta = arcs.start[i] + np.arange(FINE) * 2 * np.pi / FINE
    a, u = couplers(theta, arcs.shape[:, i : i + 1])
    p, centre, rod = (a + arcs.arm[i] * u)[0], arcs.centre[i], arcs.radius[i]
    arm = _refined(p, centre, rod, fan, swing)
    pivot = centre + arm * np.exp(1j * fan.direction)
    angle, _ = _follow(p, np.array([pivot]), np.array([arm]), rod, centre)
    if not np.isfinite(angle).all() or abs(np.ptp(angle) - swing) > 1e-6:
        return None
    sine = _minimum_sine(arcs, i, complex(pivot), arm)
    if sine < np.sin(MIN_TRANSMISSION) * (1 - 1e-6):
        return None
    rest = angle[0, : round(crank_angle / (2 * np.pi) * FINE) + 1]
    made = _candidate(arcs, i, complex(pivot), angle[0], sine, float(np.ptp(rest) / 2), frame)
    at = np.linspace(0, len(rest) - 1, SHOWN).round().astype(int)
    scale = frame / arcs.d[i]
    end = pivot + arm * np.exp(1j * rest[at])
    shown = replace(
        made, positions={"P": p[at] * scale, "Q": end * scale}, deviations=rest[at] - 0.5 * (rest.min() + rest.max())
    )
    derivation = DwellDerivation(
        crank_angle, swing, frame, theta[at], complex(centre * scale), float(rod * scale), ATLAS, ARCS
    )
    return shown, derivation


def _minimum_sine(arcs: Arcs, i: int, pivot: complex, arm: float) -> float:
    """Minimum sine of both dyads' angles over the turn, proved; 0 where the six-bar does not turn."""
    b, c, d = arcs.shape[:, i]
    place, away = arcs.arm[i] / d, pivot / d
    lengths = np.log([1 / d, b / d, c / d])
    x = np.array(
        [*lengths, 0.0, place.real, place.imag, away.real, away.imag, *np.log([arcs.radius[i] / d, arm / d])]
    )
    return min(Stephenson().sines(x[None], np.ones((1, 2)), 0.0, 2 * np.pi))


def _follow(p: Complexes, pivot: Complexes, arm: Floats, rod: float, centre: complex) -> tuple[Floats, Floats]:
    """Angle of the output over the turn (K, n), unwrapped, and the sine of its transmission angle; or NaN."""
    away = p - pivot[:, None]
    square = np.abs(away) ** 2
    cosine = (square + arm[:, None] ** 2 - rod**2) / (2 * arm[:, None] * np.sqrt(square))
    side = np.sign(((p[0] - pivot).conj() * (centre - pivot)).imag)[:, None]
    with np.errstate(invalid="ignore"):
        angle = np.angle(away) + side * np.arccos(cosine)
        inner = np.arccos((rod**2 + arm[:, None] ** 2 - square) / (2 * rod * arm[:, None]))
    return np.unwrap(angle, axis=1), np.sin(inner)


def _refined(p: Complexes, centre: complex, rod: float, fan: Fan, swing: float) -> float:
    """The arm length at which the swing is the demanded one, by the secant rule."""
    before, arm = 1.02 * fan.arm, fan.arm

    def excess(length: float) -> float:
        pivot = np.array([centre + length * np.exp(1j * fan.direction)])
        return float(np.ptp(_follow(p, pivot, np.array([length]), rod, centre)[0])) - swing

    low, high = excess(before), excess(arm)
    for _unused in range(30):
        if not np.isfinite(low + high) or high == low or abs(high) < 1e-12:
            break
        before, arm = arm, arm - high * (arm - before) / (high - low)
        low, high = high, excess(arm)
    return arm


def _candidate(
    arcs: Arcs, i: int, pivot: complex, angle: Floats, sine: float, error: float, frame: float
) -> Candidate:
    scale = frame / arcs.d[i]
    a, u = (complex(each[0, 0]) for each in couplers(arcs.start[i : i + 1], arcs.shape[:, i : i + 1]))
    b, p = a + arcs.shape[0, i] * u, a + arcs.arm[i] * u
    end = pivot + abs(pivot - arcs.centre[i]) * np.exp(1j * angle[0])
    points = {"O1": 0j, "O2": complex(arcs.d[i]), "O3": pivot, "A": a, "B": b, "P": p, "Q": end}
    linkage = Linkage(
        "stephenson",
        {name: complex(place * scale) for name, place in points.items()},
        ("O1", "O2", "O3"),
        {
            "crank": ("O1", "A"),
            "coupler": ("A", "B", "P"),
            "rocker": ("O2", "B"),
            "link": ("P", "Q"),
            "output": ("O3", "Q"),
        },
        ("crank", "O1"),
    )
    lengths = np.array(list(linkage.lengths().values()))
    turn = np.linspace(0, 2 * np.pi, len(angle), endpoint=False)
    values = {"swing_angle [rad]": float(np.ptp(angle)), "radius [m]": float(arcs.radius[i] * scale)}
    return Candidate(
        linkage,
        error,
        "stephenson",
        (),
        True,
        float(np.arcsin(min(sine, 1))),
        float(lengths.max() / lengths.min()),
        worst=error,
        curve=np.stack([turn, angle]),
        values=values,
    )
