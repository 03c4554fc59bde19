"""A machine as a small drawing: the strokes of its bars, plates, pins, supports and guides at one position."""

from __future__ import annotations

import math
from collections.abc import Iterable
from contextlib import suppress
from functools import lru_cache

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.errors import LinkwrightError
from linkwright.files.model_file import read_text
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.kinematics.solve import solve_motion

#: Positions over the cycle, and the one that is drawn where none is chosen; pixels.
STEPS, POSITION, SIZE, MARGIN = 24, 4, (132.0, 74.0), 9.0

#: Style and path.
Stroke = tuple[str, str]


@lru_cache(maxsize=256)
def thumbnail(text: str) -> tuple[Stroke, ...]:
    """The strokes of a text's machine; none where it makes no machine that can be placed."""
    with suppress(LinkwrightError):
        mechanism, _unused = read_text(text, "model")
        if mechanism is not None:
            motion = solve_motion(mechanism, steps=STEPS)
            placed = np.flatnonzero(motion.ok)
            if len(placed):
                return tuple(strokes(motion, int(placed[min(POSITION, len(placed) - 1)])))
    return ()


def strokes(motion: Motion, index: int) -> list[Stroke]:
    """A machine at one position, in pixels."""
    drawing = _Drawing(motion, index)
    return drawing.strokes()


class _Drawing:
    def __init__(self, motion: Motion, index: int) -> None:
        self.motion, self.index, self.mechanism = motion, index, motion.mechanism
        links = {name: list(link.points) for name, link in self.mechanism.links.items()}
        self.keys = {
            name: [canonical(self.mechanism, name, point) for point in points] for name, points in links.items()
        }
        self.rails = {}
        for name, joint in self.mechanism.guides.items():
            block = canonical(self.mechanism, joint.block, joint.at)
            self.rails[name] = (joint.guide == "frame", block, self._course(block))
        shown = [self._place(key) for keys in self.keys.values() for key in keys]
        shown += [place for on_frame, _unused, course in self.rails.values() if on_frame for place in course]
        low, high = np.min(shown, axis=0), np.max(shown, axis=0)
        wide, tall = np.maximum(high - low, 1e-9)
        self.scale = min((SIZE[0] - 2 * MARGIN) / wide, (SIZE[1] - 2 * MARGIN) / tall)
        self.origin = np.array(SIZE) / 2 - self.scale * np.array([1, -1]) * (low + high) / 2

    def _course(self, key: str) -> Floats:
        return self.motion.point(key).position

    def _place(self, key: str) -> Floats:
        place: Floats = self._course(key)[self.index]
        return place

    def _paper(self, place: Floats) -> tuple[float, float]:
        x, y = self.origin + self.scale * np.array([1, -1]) * place
        return round(float(x), 1), round(float(y), 1)

    def strokes(self) -> list[Stroke]:
        found = [self._link(keys) for keys in self.keys.values() if len(keys) > 1]
        supports = [self._support(key) for key in self._fixed()]
        blocks = [stroke for each in self.rails.values() for stroke in self._guide(*each)]
        pins = [self._pin(self._paper(self._place(key))) for key in self._pins()]
        return [*supports, *found, *blocks, *pins]

    def _pins(self) -> list[str]:
        keys = [key for keys in self.keys.values() for key in keys]
        return [key for key in dict.fromkeys(keys) if keys.count(key) > 1 or key in self._fixed()]

    def _fixed(self) -> list[str]:
        pins = {canonical(self.mechanism, "frame", point) for point in self.mechanism.frame.points}
        return [key for key in dict.fromkeys(key for keys in self.keys.values() for key in keys) if key in pins]

    def _link(self, keys: list[str]) -> Stroke:
        places = [self._paper(self._place(key)) for key in keys]
        around = _hull(places)
        return ("plate", _path(around, closed=True)) if len(around) > 2 else ("bar", _path(around))

    def _support(self, key: str) -> Stroke:
        x, y = self._paper(self._place(key))
        return "support", f"M{x} {y}L{x - 4} {y + 7}H{x + 4}ZM{x - 6.5} {y + 7}H{x + 6.5}"

    def _guide(self, on_frame: bool, key: str, course: Floats) -> list[Stroke]:
        places = np.array([self._paper(each) for each in course])
        x, y = self._paper(self._place(key))
        way = places[np.argmax(places @ np.array([1.0, 0.3]))] - places[np.argmin(places @ np.array([1.0, 0.3]))]
        if not on_frame:
            return [("block", f"M{x - 4} {y - 3}H{x + 4}V{y + 3}H{x - 4}Z")]
        u = way / np.hypot(*way)
        n = np.array([-u[1], u[0]])
        along = places @ u
        base = np.array([x, y])
        ends = [base + u * (end - base @ u) + 4.5 * n for end in (along.min() - 9, along.max() + 9)]
        corners = [base + a * u + b * n for a, b in ((-6, -3.5), (6, -3.5), (6, 3.5), (-6, 3.5))]
        return [("ground", _path(ends)), ("block", _path(corners, closed=True))]

    @staticmethod
    def _pin(at: tuple[float, float]) -> Stroke:
        x, y = at
        return "pin", f"M{round(x - 2.2, 1)} {y}a2.2 2.2 0 1 0 4.4 0a2.2 2.2 0 1 0 -4.4 0Z"


def _path(places: Iterable[Iterable[float]], *, closed: bool = False) -> str:
    text = "L".join(f"{float(x):.1f} {float(y):.1f}" for x, y in places)
    return f"M{text}{'Z' if closed else ''}"


def _hull(places: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """The convex hull; of places (nearly) on a line its two ends."""
    rows = sorted(set(places))
    far = max(((a, b) for a in rows for b in rows), key=lambda pair: math.dist(*pair))
    (ax, ay), (bx, by) = far
    length = math.dist(*far) or 1.0
    if max(abs((bx - ax) * (y - ay) - (by - ay) * (x - ax)) / length for x, y in rows) < 2:
        return list(far)

    def half(ordered: list[tuple[float, float]]) -> list[tuple[float, float]]:
        chain: list[tuple[float, float]] = []
        for x, y in ordered:
            while len(chain) > 1:
                (px, py), (qx, qy) = chain[-2:]
                if (qx - px) * (y - py) - (qy - py) * (x - px) > 0:
                    break
                chain.pop()
            chain.append((x, y))
        return chain[:-1]

    return [*half(rows), *half(rows[::-1])]
