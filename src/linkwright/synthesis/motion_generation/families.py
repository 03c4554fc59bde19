"""Dyads that pass two, three, four, five or more poses: finite sets, and evenly sampled families.

Four poses: the circle-point curve is where the three bisectors of a point's positions meet in one point,

    det [Re q_j, Im q_j, Re(q_j* z) + |q_j|²/2] = 0,  q_j the displacement to pose j:

a cubic in z, cut by horizontal and vertical lines. One of its points runs on a straight line: the second
intersection of two circles through the pole P₀₁. Three poses: any point has its circle; those on a circle through
the pole run on straight lines. Two poses: any point, and any centre on the bisector of its two positions.
Source: Bottema and Roth 1979, Theoretical Kinematics, ch. 8; McCarthy and Soh 2011, Geometric Design of Linkages.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from linkwright.core.arrays import Complexes, Flags, Floats, Integers
from linkwright.synthesis.least_squares import minimise
from linkwright.synthesis.motion_generation.burmester import (
    FAR,
    Dyads,
    centres,
    circles,
    five_poses,
    join,
    moved,
    relative_poses,
    sliders,
)
from linkwright.synthesis.names import POINTS
from linkwright.synthesis.path_generation.generate import complex_points
from linkwright.synthesis.result import SynthesisError
from linkwright.words import _

LINES, GRID, SPREAD = 60, 18, 9
SUBSETS, FIT_STEPS = 60, 60
#: Dyads of a family that are paired.
MOST_DYADS = 360
#: Body points of the parallelograms for poses that do not turn.
AROUND: Complexes = np.array([0, 1, 1j, -1, -1j, 1 + 1j], complex)


@dataclass(frozen=True)
class Window:
    """A rectangle of the frame in which pivots may lie: corners, m."""

    low: complex
    high: complex

    def holds(self, z: Complexes) -> Flags:
        """Which places lie inside."""
        across = (z.real >= self.low.real) & (z.real <= self.high.real)
        return np.asarray(across & (z.imag >= self.low.imag) & (z.imag <= self.high.imag))


def usual_window(p: Complexes) -> Window:
    """Three times the extent of the poses' places about their middle."""
    middle = complex(np.mean([p.real.min(), p.real.max()]), np.mean([p.imag.min(), p.imag.max()]))
    half = 1.5 * max(float(np.ptp(p.real)), float(np.ptp(p.imag)), 1e-9)
    return Window(middle - half * (1 + 1j), middle + half * (1 + 1j))


def dyads(p: Complexes, phi: Floats, window: Window) -> Dyads:
    """Dyads of n poses (n,): all of them for five, a sample of those within the window for fewer."""
    d, e = relative_poses(p, phi)
    if len(p) == 5:
        return _five(p, phi)
    if len(p) == 4:
        found = join(
            circles(circle_points(d, e, _shifted(window, p)), p, d, e), sliders(_slider_of_four(d, e), p, d, e)
        )
    elif len(p) == 3:
        found = join(circles(_grid(window, p), p, d, e), sliders(_sliders_of_three(d, e), p, d, e))
    else:
        found = _two(p, d, e, window)
    return found[np.flatnonzero(held(found, window))]


def held(found: Dyads, window: Window) -> Flags:
    """Which dyads have their pivots within the window: the fixed one, and the moving one at the first pose."""
    return np.asarray(window.holds(found.positions[:, 0]) & (found.slides | window.holds(found.centre)))


def _five(p: Complexes, phi: Floats) -> Dyads:
    z, c, real, slides = (each[0] for each in five_poses(p[None], phi[None]))
    d, e = relative_poses(p, phi)
    pins, guides = z[real & ~slides], z[real & slides]
    found = circles(pins, p, d, e)
    exact = Dyads(found.point, found.positions, p[0] + c[real & ~slides], found.direction)
    return join(exact, sliders(guides, p, d, e)) if len(guides) else exact


def circle_points(d: Complexes, e: Complexes, window: Window, lines: int = LINES) -> Complexes:
    """Points of the circle-point curve of four poses on a net of lines, (K,), in axes at the first pose."""
    xs = np.linspace(window.low.real, window.high.real, lines)
    ys = np.linspace(window.low.imag, window.high.imag, lines)
    middle, half = 0.5 * (window.low + window.high), 0.5 * (window.high - window.low)
    origin = np.concatenate([xs + 1j * middle.imag, middle.real + 1j * ys])
    along = np.concatenate([np.full(lines, 1j * half.imag), np.full(lines, half.real + 0j)])
    return on_lines(d, e, origin, along)


def on_lines(d: Complexes, e: Complexes, origin: Complexes, along: Complexes) -> Complexes:
    """Points of the circle-point curve on the segments origin ± along, (K,)."""
    nodes = np.cos((2 * np.arange(4) + 1) * np.pi / 8)
    values = cubic(origin[:, None] + nodes * along[:, None], d, e)
    coefficients = np.linalg.solve(np.vander(nodes, increasing=True), values.T).T
    lead = coefficients[:, 3]
    usable = np.abs(lead) > 1e-12 * np.abs(coefficients).max(1)
    companion = np.zeros((int(usable.sum()), 3, 3))
    companion[:, [1, 2], [0, 1]] = 1
    companion[:, :, 2] = -coefficients[usable, :3] / lead[usable, None]
    t = np.linalg.eigvals(companion)
    real = (np.abs(t.imag) < 1e-9) & (np.abs(t.real) <= 1)
    return np.asarray((origin[usable, None] + t.real * along[usable, None])[real])


def cubic(z: Complexes, d: Complexes, e: Complexes) -> Floats:
    """The circle-point curve's function at places z of any shape."""
    q = d[1:4] + (e[1:4] - 1) * z[..., None]
    third = (q.conj() * z[..., None]).real + np.abs(q) ** 2 / 2
    return np.asarray(np.linalg.det(np.stack([q.real, q.imag, third], -1)))


#: Powers of x and y in the circle-point curve's function, in the order of its coefficients.
POWERS = ((3, 0), (2, 1), (1, 2), (0, 3), (2, 0), (1, 1), (0, 2), (1, 0), (0, 1), (0, 0))


def cubic_coefficients(d: Complexes, e: Complexes, size: float) -> Floats:
    """Coefficients (10,) of the circle-point curve's function in x/size and y/size by POWERS, the largest of those of
    degree three being 1 in size."""
    x, y = np.array([(i, j) for i in (-1.0, -0.3, 0.4, 1.0) for j in (-1.0, -0.4, 0.3, 1.0)]).T
    values = cubic(size * (x + 1j * y), d, e)
    columns = np.stack([x**i * y**j for i, j in POWERS], 1)
    found = np.linalg.lstsq(columns, values, rcond=None)[0]
    return np.asarray(found / max(float(np.abs(found[:4]).max()), 1e-300))


def inverse_poses(p: Complexes, phi: Floats) -> tuple[Complexes, Floats]:
    """The frame's poses relative to the body: its circle points are the centre points, in axes at pose 0."""
    d, e = relative_poses(p, phi)
    return -d * e.conj(), -(phi - phi[0])


def _slider_circle(d: Complexes, e: Complexes, j: int) -> tuple[complex, float]:
    """Centre and radius of the points whose positions 0, 1 and j lie in a line; it passes the pole P₀₁."""
    curvature = ((e[1].conj() - 1) * (e[j] - 1)).imag
    linear = d[1].conj() * (e[j] - 1) - (e[1] - 1) * d[j].conj()
    with np.errstate(divide="ignore", invalid="ignore"):
        centre = -np.conj(-0.5j * linear) / curvature
        pole = d[1] / (1 - e[1])
    return complex(centre), float(abs(pole - centre))


def _slider_of_four(d: Complexes, e: Complexes) -> Complexes:
    (c2, _), (c3, _) = _slider_circle(d, e, 2), _slider_circle(d, e, 3)
    with np.errstate(divide="ignore", invalid="ignore"):
        pole, axis = d[1] / (1 - e[1]), c3 - c2
        other = c2 + axis * np.conj((pole - c2) / axis)
    return np.array([other]) if np.isfinite(other) else np.empty(0, complex)


def _sliders_of_three(d: Complexes, e: Complexes) -> Complexes:
    centre, radius = _slider_circle(d, e, 2)
    if not np.isfinite(radius):
        return np.empty(0, complex)
    return np.asarray(centre + radius * np.exp(2j * np.pi * np.arange(72) / 72))


def _shifted(window: Window, p: Complexes) -> Window:
    return Window(window.low - complex(p[0]), window.high - complex(p[0]))


def _grid(window: Window, p: Complexes) -> Complexes:
    xs = np.linspace(window.low.real, window.high.real, GRID)
    ys = np.linspace(window.low.imag, window.high.imag, GRID)
    return np.asarray((xs[:, None] + 1j * ys).ravel() - p[0])


def _two(p: Complexes, d: Complexes, e: Complexes, window: Window) -> Dyads:
    z = _grid(window, p)[::2].repeat(SPREAD)
    positions = p[0] + z[:, None] + moved(z, d, e)
    chord = positions[:, 1] - positions[:, 0]
    reach = abs(window.high - window.low) / 2
    slide = np.tile(np.linspace(-1, 1, SPREAD), len(z) // SPREAD) * reach
    with np.errstate(divide="ignore", invalid="ignore"):
        centre = positions.mean(1) + 1j * slide * chord / np.abs(chord)
    found = Dyads(z, positions, centre, np.full(len(z), np.nan + 0j))
    lines = sliders(z[::SPREAD], p, d, e)
    return join(found[np.flatnonzero(np.isfinite(centre))], lines)


def fitted(p: Complexes, phi: Floats, rng: np.random.Generator) -> tuple[Dyads, Floats]:
    """Dyads of minimum Σ (|Z_j - C| - R)² over any number of poses, best first, and that sum (K,), m².

    Starts: the Burmester points of many sets of five poses (four of them and the start set's own where there are
    five), real parts of complex ones included.
    """
    d, e = relative_poses(p, phi)
    size = float(np.sqrt(np.mean(np.abs(d) ** 2))) or 1.0
    z, c = _fit_starts(p, phi, rng)
    z = np.clip(z.real, -50 * size, 50 * size) + 1j * np.clip(z.imag, -50 * size, 50 * size)

    def system(x: Floats, who: Integers) -> tuple[Floats, Floats]:
        point, centre = x[:, 0] + 1j * x[:, 1], x[:, 2] + 1j * x[:, 3]
        off = point[:, None] + moved(point, d, e) - centre[:, None]
        distance = np.abs(off) + 1e-300
        unit = off.conj() / distance
        ones = np.ones_like(distance)
        slope = np.stack([(unit * e).real, (unit * 1j * e).real, -unit.real, (unit * -1j).real], 2)
        slope = slope - slope.mean(1, keepdims=True)
        return distance - distance.mean(1, keepdims=True) * ones, slope

    start = np.column_stack([z.real, z.imag, c.real, c.imag])
    x, f, _ = minimise(system, start, steps=FIT_STEPS, keep=len(start))
    point, centre = x[:, 0] + 1j * x[:, 1], x[:, 2] + 1j * x[:, 3]
    distinct = _different(np.column_stack([point, centre]), size)
    distinct = distinct[(np.abs(centre[distinct]) < 100 * size) & np.isfinite(f[distinct])]
    positions = p[0] + point[distinct, None] + moved(point[distinct], d, e)
    empty = np.full(len(distinct), np.nan + 0j)
    return Dyads(point[distinct], positions, centre[distinct] + p[0], empty), f[distinct]


def _fit_starts(p: Complexes, phi: Floats, rng: np.random.Generator) -> tuple[Complexes, Complexes]:
    n = len(p)
    every = (
        list(combinations(range(n), 5))
        if n < 12
        else [sorted(rng.choice(n, 5, replace=False)) for _ in range(SUBSETS)]
    )
    chosen = np.array([every[i] for i in rng.permutation(len(every))[:SUBSETS]])
    z, c, _, slides = five_poses(p[chosen], phi[chosen])
    first = chosen[:, :1]
    turn = np.exp(1j * (phi[first] - phi[0]))
    good = np.isfinite(z) & np.isfinite(c) & ~slides & (np.abs(c) < FAR)
    body = (z / turn) + (p[0] - p[first]) * 0
    return body[good] + 0j, (c + p[first] - p[0])[good]


def _different(x: Complexes, size: float) -> Integers:
    """Rows that differ from every row before them."""
    distinct: list[int] = []
    for i in range(len(x)):
        if all(np.abs(x[i] - x[j]).max() > 1e-5 * size for j in distinct):
            distinct.append(i)
        if len(distinct) == 24:
            break
    return np.array(distinct, dtype=np.int64)


def all_dyads(
    p: Complexes,
    phi: Floats,
    window: Window,
    fixed: Sequence[tuple[float, float]],
    moving: Sequence[tuple[float, float]],
    line: Sequence[Sequence[float]] | None,
) -> tuple[Dyads, Floats]:
    """Dyads and the squared errors of their lengths."""
    if line is not None:
        if len(p) not in (3, 4):
            raise SynthesisError(
                _(
                    "{poses} poses do not fit pivots on a line; give three or four poses",
                    code="synthesize.motion.line",
                    poses=len(p),
                )
            )
        found = _on_line(p, phi, line)
        return found, np.zeros(len(found))
    if fixed or moving:
        if len(p) > 3:
            raise SynthesisError(
                _(
                    "{poses} poses leave no pivot free to be given; give pivots for two or three poses",
                    code="synthesize.motion.pivots",
                    poses=len(p),
                )
            )
        d, e = relative_poses(p, phi)
        pivots = [_with_centre(p, phi, complex(place)) for place in complex_points(fixed)] if fixed else []
        pivots += [complex(place) - p[0] for place in complex_points(moving)] if moving else []
        named = circles(np.array(pivots), p, d, e)
        rest = dyads(p, phi, window) if len(pivots) == 1 else named[:0]
        found = join(named, rest)
        return found, np.zeros(len(found))
    if len(p) > 5:
        return fitted(p, phi, np.random.default_rng(0))
    if len(p) > 3 and np.abs(np.exp(1j * (phi - phi[0])) - 1).max() <= 1e-9:
        found = circles(scale_of(p) * AROUND, p, *relative_poses(p, phi))
        return found, np.zeros(len(found))
    found = dyads(p, phi, window)
    thin = np.unique(np.linspace(0, len(found) - 1, min(len(found), MOST_DYADS)).astype(int))
    found = found[thin] if len(found) else found
    return found, np.zeros(len(found))


def _with_centre(p: Complexes, phi: Floats, centre: complex) -> complex:
    """The body point whose circle about the given centre passes its positions, by inversion."""
    back = (centre - p) * np.exp(-1j * (phi - phi[0]))
    if len(p) == 2:
        return complex(back.mean() + 0.6j * (back[1] - back[0]))
    return complex(centres(back[:1], (back - back[0])[None])[0])


def _on_line(p: Complexes, phi: Floats, ends: Sequence[Sequence[float]]) -> Dyads:
    """Dyads of three or four poses whose fixed pivots lie on the stretch between two places."""
    first, last = two_points(ends)
    middle, half = 0.5 * (first + last) - p[0], 0.5 * (last - first)
    if len(p) == 3:
        pivots = middle + half * np.linspace(-1, 1, 48)
    else:
        d, phi_i = inverse_poses(p, phi)
        pivots = on_lines(d, np.exp(1j * phi_i), np.array([middle]), np.array([half]))
    points = np.array([_with_centre(p, phi, complex(place + p[0])) for place in pivots])
    return circles(points, p, *relative_poses(p, phi)) if len(points) else Dyads(*4 * (np.empty(0, complex),))


def two_points(points: Sequence[Sequence[float]]) -> tuple[complex, complex]:
    """Two given places; raises SynthesisError for another number of them."""
    found = complex_points(points)
    if len(found) != 2:
        raise SynthesisError(POINTS)
    return complex(found[0]), complex(found[1])


def scale_of(p: Complexes) -> float:
    """Largest distance of a place from the middle of all, m."""
    return float(np.abs(p - p.mean()).max())
