r"""Proof that a motion keeps its assembly: for every step whether one continuous branch leads over it.

Links that guides or welds join share a rotation, links that a driver turns one rotation and its angle; higher pairs
make some rotations and slides sums of others. So every closed loop is, as complex numbers,

    F = Σ_c e^{iθ_c} (a_c + Σ_{j on c} b_j s_j) = 0,      θ_c = φ_c + (turns of drivers),

with as many rotations φ and slides s as real equations. A part of a step has roots y₀, y₁ and exact rates at its
ends. p: the cubic through both; x_m: the middle, A = (∂F/∂z)⁻¹ at p(x_m), N = A d(∂F/∂z)/dx there, A(x) =
(I - (x - x_m) N) A. With

    b ≥ |A(x) F(p(x))|,      M(ρ) ≥ |I - A(x) J(u)|      for all x of the part and all |u - p(x)| ≤ ρ

(componentwise), the part is proved if one positive vector ρ satisfies b + M(ρ) ρ ≤ ρ: u ↦ u - A(x) F(u) contracts
the box around p(x) into itself, so it holds just one root for every x, and one continuous branch joins y₀ and y₁
(Krawczyk 1969; Neumaier, Interval Methods for Systems of Equations, ch. 5). Rounding is bounded as ``_ends`` says.
"""

from __future__ import annotations

import cmath
from dataclasses import dataclass

import numpy as np

from linkwright.core.arguments import require
from linkwright.core.arrays import Complexes, Flags, Floats
from linkwright.core.linear_sums import LinearSums
from linkwright.elements import Connection, TreeJoint
from linkwright.errors import LinkwrightError
from linkwright.joints.base import Joint, LackingError
from linkwright.joints.lower_pair import RigidJoint, SlidingJoint, TurningJoint
from linkwright.kinematics.groups import upstream
from linkwright.kinematics.motion import Motion
from linkwright.words import _

#: ``turn`` of a link, ``slide`` of a guide, ``drive`` of a driver.
Key = tuple[str, str]
#: Coefficients of a place, by rotation and slide (-1: of no slide).
Terms = dict[tuple[int, int], complex]
#: A link: number of its rotation, angle of its x axis beyond it, and one of its points with its place.
_Body = tuple[int, float, complex, Terms]

#: Longest and shortest part of a step, rad or share of the size, and attempts after which a step is abandoned.
LONGEST, FLOOR, PATIENCE = 0.5, 1e-7, 2000
#: Contraction at which parts aim, and from which on none is tried; relative rounding; coordinates that are the same.
WANTED, LARGEST, ROUNDING, SAME = 0.5, 0.95, 4e-16, 1e-9


_NO_PROOF = _(
    "nothing can be proved of a motion with the joint {joint!r}: proofs know pins, "
    "guides, welds, and pairs of wheels, racks, belts and chains",
    code="proof.kind",
)


@dataclass(frozen=True)
class Proof:
    """Which steps of a motion are proved to keep its assembly while the drivers move in a straight line.

    ``proved`` (steps,); ``margin`` (steps,) of the inequality behind it, 0 where it fails; ``separation``
    (positions,): no other assembly lies nearer, rad or share of the mechanism's size, NaN where the motion is not
    solved.
    """

    proved: Flags
    margin: Floats
    separation: Floats

    def explain(self, language: str = "en") -> str:
        """The proof in a sentence."""
        count, total = int(self.proved.sum()), len(self.proved)
        first = int(np.argmin([*self.proved, False])) + 1
        values = {"count": count, "total": total, "first": first, "margin": f"{self.margin.min(initial=1.0):.2g}"}
        sentence = (
            _("the assembly is proved not to change in all {total} steps (smallest margin {margin})")
            if count == total
            else _(
                "the assembly is proved not to change in {count} of {total} steps; the first one "
                "without proof is step {first}"
            )
        )
        return sentence.format(**values).translate(language)


def prove(motion: Motion) -> Proof:
    """Which steps of a motion provably keep its assembly, and by what margin.

    Groups without closed form are tracked by a rule that has never been observed to fail, yet is no proof; modes of
    dyads need none. Steps lead from each position to the next, in a closed cycle from the last to the first as well.

    >>> import linkwright as lw
    >>> proof = lw.prove(lw.solve_motion(lw.load("gallery:triad"), steps=36))
    >>> proof.explain()
    'the assembly is proved not to change in all 36 steps (smallest margin 0.5)'

    Raises:
        LinkwrightError: a joint is of a kind of which nothing can be proved here, such as a cam.
    """
    require(motion, Motion)
    positions, ok = motion.positions, motion.ok
    count = motion.steps if positions.closed and not positions.repeated else motion.steps - 1
    passable = (ok & np.roll(ok, -1))[:count]
    passable[[k for k in motion.breaks if k < count]] = False
    if motion.tracked is None:
        return Proof(passable, passable.astype(float), np.where(ok, np.inf, np.nan))
    loops = _Loops(motion)
    y = loops.coordinates_of(motion)
    again = (each.law.at(float(positions.around[-1])) for each in motion.mechanism.drivers.values())
    y = np.concatenate([y, [[*y[0, : loops.n], *again]]])
    margin = np.array([_walked(loops, y[k], y[k + 1]) if passable[k] else 0.0 for k in range(count)])
    return Proof(margin > 0.0, margin, np.array([loops.distance_to_others(row) for row in y[:-1]]))


class _Loops:
    """The equations of K loops in coordinates y = (n unknowns, d drivers), n = 2K; lengths in m, angles in rad.

    ``turning`` (C, n + d), ``sliding`` (S, n + d): rotations θ and slides of y; ``owner`` (S,): rotations on which
    slides lie; ``scale`` (n,), ``unit`` (d,): of every coordinate, 1 rad or the mechanism's size.
    """

    def __init__(self, motion: Motion) -> None:
        self.mechanism = motion.mechanism
        self.bodies: dict[str, _Body] = {"frame": (0, 0.0, 0j, {})}
        self.unknowns: list[Key] = []
        self.rotations: list[dict[Key, float]] = [{}]
        self.slides: list[tuple[Key, int]] = []
        self.loops: list[Terms] = []
        self.sums: LinearSums[Key] = LinearSums()
        groups, joints = upstream(motion.structure, self.mechanism), self.mechanism.joints
        for joint in (joints[each.joint] for group in groups for each in group.joints):
            if not (joint.higher or isinstance(joint, TurningJoint | SlidingJoint | RigidJoint)):
                raise LinkwrightError(_NO_PROOF.format(joint=joint.name))
        for step in (step for group in groups for step in group.tree):
            self._hang(joints[step.joint], step)
        cuts = [(joints[cut.joint], cut) for group in groups for cut in group.cuts]
        for joint, cut in (each for each in cuts if not each[0].higher):
            self._close(joint, cut)
        for joint in (each for each, _unused in cuts if each.higher):
            self._add_sum(joint)
        self.unknowns = [key for key in self.unknowns if key not in self.sums.solved]
        self._matrices()

    def _hang(self, joint: Joint, step: TreeJoint) -> None:
        """The child of a chain's joint on its parent."""
        place = self.place(step.parent, joint.point_on(step.parent))
        rotation, offset, *_unused = self.bodies[step.parent]
        if isinstance(joint, SlidingJoint):
            key = ("slide", joint.name) if step.driver is None else ("drive", step.driver)
            place = self._slid(place, key, joint, step.parent)
        turns = self.rotations[rotation]
        if not step.turns:
            offset += joint.turn_of(step.child, self.mechanism)
        elif step.driver is None:
            self.unknowns.append(("turn", step.child))
            turns, offset = {("turn", step.child): 1.0}, 0.0
        else:
            sign = 1.0 if step.child == self.mechanism.drivers[step.driver].link else -1.0
            turns = {**turns, ("drive", step.driver): sign}
        self.rotations += [] if turns in self.rotations else [turns]
        rotation = self.rotations.index(turns)
        anchor = complex(*self.mechanism.link(step.child).points[joint.point_on(step.child)])
        self.bodies[step.child] = rotation, offset, anchor, place

    def _close(self, joint: Joint, cut: Connection) -> None:
        """The loop that a cut joint closes: two places that coincide."""
        start, end = (self.place(link, joint.point_on(link)) for link in (cut.a, cut.b))
        if isinstance(joint, SlidingJoint):
            start = self._slid(start, ("slide", joint.name), joint, cut.a)
        self.loops.append({key: start.get(key, 0j) - end.get(key, 0j) for key in {**start, **end}})

    def _slid(self, place: Terms, key: Key, joint: SlidingJoint, link: str) -> Terms:
        """A place after a displacement along a guide as one of its links has it, and the offset across it."""
        sign, along = (1.0, joint.direction) if link == joint.guide else (-1.0, joint.block_angle)
        rotation, offset, *_unused = self.bodies[link]
        way = sign * cmath.exp(1j * (offset + along))
        self.unknowns += [key] if key[0] == "slide" else []
        self.slides.append((key, rotation))
        across = place.get((rotation, -1), 0j) + 1j * way * joint.offset
        return {**place, (rotation, len(self.slides) - 1): way, (rotation, -1): across}

    def _add_sum(self, joint: Joint) -> None:
        """The row of a higher pair, from which one unknown follows: one that no loop holds if there is one."""
        try:
            turns, slides, rest = joint.sums(self.mechanism)
        except LackingError:
            raise LinkwrightError(_NO_PROOF.format(joint=joint.name)) from None
        driven = {each.joint: name for name, each in self.mechanism.drivers.items()}
        terms = {("drive", driven[k]) if k in driven else ("slide", k): f for k, f in slides.items()}
        for link, factor in turns.items():
            rotation, offset, *_unused = self.bodies[link]
            rest += factor * offset
            for key, share in self.rotations[rotation].items():
                terms[key] = terms.get(key, 0.0) + factor * share
        held = {key for loop in self.loops for c, _unused in loop for key in self.rotations[c]}
        held |= {self.slides[j][0] for loop in self.loops for _unused, j in loop if j >= 0}
        self.sums.add(terms, rest, lambda key: -np.inf if key[0] == "drive" else float(key not in held))

    def place(self, link: str, point: str) -> Terms:
        """Where a point of a link is."""
        rotation, offset, anchor, place = self.bodies[link]
        arm = cmath.exp(1j * offset) * (complex(*self.mechanism.link(link).points[point]) - anchor)
        return {**place, (rotation, -1): place.get((rotation, -1), 0j) + arm}

    def _matrices(self) -> None:
        keys = [*self.unknowns, *(("drive", name) for name in self.mechanism.drivers)]
        self.n, C, S, K = len(self.unknowns), len(self.rotations), len(self.slides), len(self.loops)
        self.C, self.K, self.owner = (C, K, np.array([rotation for _unused, rotation in self.slides], dtype=int))
        rows, rests = np.zeros((C + S, len(keys))), np.zeros(C + S)
        for k, terms in enumerate([*self.rotations, *({key: 1.0} for key, _unused in self.slides)]):
            found, rests[k] = self.sums.reduced(terms)
            for key, factor in found.items():
                rows[k, keys.index(key)] += factor
        self.coordinates, self.turning, self.sliding = rows, rows[:C], rows[C:]
        self.a, self.b = np.zeros((C, K), complex), np.zeros((S, K), complex)
        for k, loop in enumerate(self.loops):
            for (c, j), value in loop.items():
                turned = value * cmath.exp(1j * rests[c])
                self.a[c, k] += turned if j < 0 else turned * rests[C + j]
                if j >= 0:
                    self.b[j, k] += turned
        self.own, size = np.eye(C)[self.owner], self.mechanism.size
        self.turns = np.array([kind == "turn" for kind, _unused in self.unknowns], dtype=bool)
        self.scale = np.where(self.turns, 1.0, size)
        self.unit = np.where([each.law.rotary for each in self.mechanism.drivers.values()], 1.0, size)

    def coordinates_of(self, motion: Motion) -> Floats:
        """y (positions, n + d) of a motion."""
        assert motion.tracked is not None
        known = motion.tracked.tracker.named(motion.tracked.coordinates)
        rows = [known[key] if key in known else motion.joint(key[1]).displacement for key in self.unknowns]
        return np.stack([*rows, *motion.inputs.values()], axis=1)

    def turned(self, y: Floats) -> tuple[Complexes, Complexes, Complexes]:
        """Unit vectors (C,), arms (C, K), turned directions of slides (S, K) at y (n + d,)."""
        unit: Complexes = np.exp(1j * (self.turning @ y))
        arms: Complexes = np.asarray(self.a + self.own.T @ ((self.sliding @ y)[:, None] * self.b), complex)
        return unit, arms, unit[self.owner, None] * self.b

    def slopes(self, at: tuple[Complexes, Complexes, Complexes]) -> Floats:
        """∂F/∂y, (2K, n + d): real parts above imaginary parts."""
        return _real(self.coordinates.T @ np.concatenate([1j * at[0][:, None] * at[1], at[2]])).T

    def root(self, y: Floats) -> Floats:
        """The root near y with the same drivers. Raises LinAlgError where Newton's method finds none."""
        y = y.copy()
        for _unused in range(8):
            at = self.turned(y)
            step = np.linalg.solve(self.slopes(at)[:, : self.n], _real(at[0] @ at[1]))
            y[: self.n] -= step
            if np.abs(step / self.scale).max(initial=0.0) < SAME:
                return y
        raise np.linalg.LinAlgError

    def rate(self, y: Floats, drive: Floats) -> Floats:
        """y′ (n + d,) along a straight way of the drivers (d,)."""
        slopes = self.slopes(self.turned(y))
        return np.concatenate([-np.linalg.solve(slopes[:, : self.n], slopes[:, self.n :] @ drive), drive])

    def rows(self, inverse: Floats) -> Complexes:
        """Rows r with A v = Re(r v) of complex v."""
        return np.asarray(inverse[:, : self.K] - 1j * inverse[:, self.K :])

    def columns(self, of_rotations: Floats, of_slides: Floats) -> Floats:
        """Bounds by rotation and slide (n, C), (n, S) as columns of the unknowns."""
        turning, sliding = np.abs(self.turning[:, : self.n]), np.abs(self.sliding[:, : self.n])
        return np.asarray(of_rotations @ turning + of_slides @ sliding)

    def tilt(self, reach: Floats, slid: Floats, tube: Floats) -> Floats:
        """Bound of |A (J(u) - J(y))| for |u - y| ≤ ``tube`` (n,)."""
        turn, slide = np.split(np.abs(self.coordinates[:, : self.n]) @ tube, [self.C])
        return self.columns(reach * turn + (slid * slide) @ self.own, slid * turn[self.owner])

    def distance_to_others(self, y: Floats) -> float:
        """Lower bound of how far any other assembly lies from the root y with the same drivers, rad or share of the
        size: with another root v, 0 = A (F(v) - F(y)) gives |v - y| ≤ ½ T(|v - y|) |v - y|."""
        unit, arms, slides = self.turned(y)
        row = self.rows(np.asarray(np.linalg.inv(self.slopes((unit, arms, slides))[:, : self.n])))
        tilt = self.tilt(np.abs(row @ (unit[:, None] * arms).T), np.abs(row @ slides.T), self.scale)
        with np.errstate(divide="ignore"):
            return float(2.0 * (self.scale / (tilt @ self.scale)).min(initial=np.inf))


def _real(v: Complexes) -> Floats:
    return np.concatenate([v.real, v.imag], axis=-1)


def _walked(loops: _Loops, begin: Floats, end: Floats) -> float:
    """The smallest margin of the parts in which a step is proved; 0 where it is not, or leads elsewhere than to its
    end but for full turns."""
    drive, x, y, smallest = end[loops.n :] - begin[loops.n :], 0.0, begin, 1.0
    pace = max(float(np.abs(drive / loops.unit).max(initial=0.0)), 1e-300)
    h = min(1.0, LONGEST / pace)
    for _unused in range(PATIENCE):
        if x >= 1.0:
            gap = (y - end)[: loops.n] / loops.scale
            gap = np.where(loops.turns, 2.0 * np.sin(gap / 2.0), gap)
            return smallest if np.abs(gap).max(initial=0.0) < SAME else 0.0
        h = min(h, 1.0 - x)
        with np.errstate(all="ignore"):
            try:
                ahead, contraction, margin = _part(loops, y, h, drive)
            except np.linalg.LinAlgError:
                ahead, contraction, margin = y, np.inf, 0.0
        if margin > 0.0:
            x, y, smallest = (1.0 if h >= 1.0 - x else x + h), ahead, min(smallest, margin)
        elif h * pace < FLOOR:
            return 0.0
        share, bounds = (0.8 * np.sqrt(WANTED / max(contraction, 1e-9)), (0.3, 2.0) if margin > 0.0 else (0.1, 0.5))
        h *= float(np.clip(share, *bounds))
    return 0.0


def _part(loops: _Loops, y0: Floats, h: float, drive: Floats) -> tuple[Floats, float, float]:
    """The root behind a part of length h; the contraction; the margin, 0 where it is not proved."""
    n, C, own, owner = loops.n, loops.C, loops.own, loops.owner
    rate0 = loops.rate(y0, drive)
    y1 = loops.root(y0 + h * rate0)
    rate1, mean = loops.rate(y1, drive), (y1 - y0) / h
    firsts = loops.coordinates @ np.stack([rate0, 3.0 * mean - rate0 - rate1, rate1], axis=1)
    v1, v2 = np.abs(firsts).max(axis=1), 2.0 / h * np.abs(np.diff(firsts)).max(axis=1)
    v3 = 2.0 / h**2 * np.abs(firsts @ [1.0, -2.0, 1.0])
    (w, s1), (g, s2), (c, s3) = (np.split(v, [C]) for v in (v1, v2, v3))
    unit, arms, slides = loops.turned(0.5 * (y0 + y1) + h / 8.0 * (rate0 - rate1))
    jacobian = loops.slopes((unit, arms, slides))[:, :n]
    inverse = np.asarray(np.linalg.inv(jacobian), float)
    row = loops.rows(inverse)
    turned, along = row @ (unit[:, None] * arms).T, row @ slides.T
    slid, (theta, s) = np.abs(along), np.split(loops.coordinates @ (1.5 * mean - 0.25 * (rate0 + rate1)), [C])
    reach = np.abs(turned) + (slid * s1 * (h / 2.0)) @ own
    N = (-theta * turned.real - (along.imag * s) @ own) @ loops.turning[:, :n]
    N = N - (theta[owner] * along.imag) @ loops.sliding[:, :n]
    spread, square = np.eye(n) + h / 2.0 * np.abs(N), h * h / 4.0 * np.abs(N @ N)
    e2, e3, e4 = w * w + g, w**3 + 3.0 * w * g + c, w**4 + 6.0 * w * w * g + 3.0 * g * g + 4.0 * w * c
    bend = loops.columns(reach * e2 + (slid * s2) @ own + 2.0 * ((slid * s1) @ own) * w, slid * e2[owner])
    flat = square + spread @ (h * h / 8.0 * bend + np.abs(np.eye(n) - inverse @ jacobian) + 1e-15)
    fourth = reach @ e4 + slid @ (4.0 * s1 * e3[owner] + 6.0 * s2 * e2[owner] + 4.0 * s3 * w[owner])
    off = spread @ (h**4 / 384.0 * fourth + _ends(loops, inverse, h, (y0, rate0), (y1, rate1)) + 1e-15)
    contraction = float(np.abs(np.linalg.eigvals(flat)).max(initial=0.0))
    if not contraction < LARGEST:
        return y1, contraction, 0.0
    tube = 2.0 * np.linalg.solve(np.eye(n) - flat, off)
    held = (off + (flat + spread @ loops.tilt(reach, slid, tube)) @ tube) / tube
    return y1, contraction, max(float((1.0 - held).min(initial=1.0)), 0.0) if (tube > 0.0).all() else 0.0


def _ends(loops: _Loops, inverse: Floats, h: float, *ends: tuple[Floats, Floats]) -> Floats:
    """What rounding and Newton's method leave of F and F′ at the ends, through |A|, (n,)."""
    left, size = np.zeros(loops.n), np.zeros(loops.K)
    for y, rate in ends:
        at = loops.turned(y)
        left += np.abs(inverse @ _real(at[0] @ at[1]))
        left += 4.0 / 27.0 * h * np.abs(inverse @ (loops.slopes(at) @ rate))
        size = np.maximum(size, np.abs(at[1]).sum(axis=0))
    return np.asarray(left + ROUNDING * (np.abs(inverse) @ np.concatenate([size, size])))
