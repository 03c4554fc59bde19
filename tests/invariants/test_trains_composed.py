"""Trains of wheels that mesh in a random tree, their pairs written in any order and either way round: every ratio is
the product along the way, a pair more is passive where it fits and blocks where it does not."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from tests.refusals import refused

import linkwright as lw

#: Wheels of a train.
WHEELS = 6


class Train:
    """Speeds (of the first wheel's) and the wheel by which each is driven."""

    def __init__(self, seed: int) -> None:
        self.random = np.random.default_rng(seed)
        self.speed, self.driven = [1.0], [0]
        self.pairs: list[tuple[str, int, int, float]] = []
        for k in range(1, WHEELS):
            by = int(self.random.integers(k))
            ratio = float(self.random.choice([-1.5, -0.5, -0.4, 0.25, 3.0, -2.0]))
            self.driven.append(by)
            self.speed.append(self.speed[by] * ratio)
            self.mesh(f"mesh{k}", by, k, ratio)
        self.random.shuffle(self.pairs)  # type: ignore[arg-type]

    def mesh(self, name: str, a: int, b: int, ratio: float) -> None:
        turned = self.random.random() < 0.5
        self.pairs.append((name, b, a, 1.0 / ratio) if turned else (name, a, b, ratio))

    def text(self) -> str:
        places = ", ".join(f"P{k}: [{0.5 * k} m, {0.2 * k * k} m]" for k in range(WHEELS))
        wheels = "\n".join(f"  w{k}: {{points: {{P{k}: [0 m, 0 m], Q{k}: [0.1 m, 0 m]}}}}" for k in range(WHEELS))
        rows = "\n".join(
            f"  {name}: {{kind: gear, links: [w{a}, w{b}], ratio: {ratio!r}}}" for name, a, b, ratio in self.pairs
        )
        return (
            f"format: 1\nframe: {{points: {{{places}}}}}\nlinks:\n{wheels}\njoints:\n{rows}\n"
            "driver: {turn: w0, about: P0, speed: 2 rad/s}\n"
        )

    def way(self, wheel: int) -> Iterator[int]:
        """The wheels from one to the first."""
        while wheel:
            yield wheel
            wheel = self.driven[wheel]


def apart(train: Train) -> tuple[int, int]:
    """Two wheels that do not mesh with each other."""
    return next(
        (a, b)
        for a in range(WHEELS)
        for b in range(WHEELS - 1, a, -1)
        if train.driven[b] != a and abs(train.speed[b] / train.speed[a] - 1.0) > 1e-3
    )


@pytest.mark.parametrize("seed", range(12))
def test_ratios_are_products_along_the_train(seed: int) -> None:
    train = Train(seed)
    mechanism = lw.loads(train.text())
    found = lw.structure(mechanism)
    assert (found.mobility, found.grubler, found.passive) == (1, 1, ())
    (row,) = found.trains
    assert set(row.pairs) == {name for name, *_ in train.pairs} and row.blocked == ()
    first = row.ratios["w0"]
    assert {name: each / first for name, each in row.ratios.items()} == pytest.approx(
        {f"w{k}": speed for k, speed in enumerate(train.speed)}, rel=1e-12
    )
    motion = lw.solve_motion(mechanism, times=[0.0, 0.7])
    for k, speed in enumerate(train.speed):
        link = motion.link(f"w{k}")
        assert link.angular_velocity == pytest.approx(np.full(2, 2.0 * speed), rel=1e-12)
        assert np.diff(link.angle) == pytest.approx([1.4 * speed], abs=1e-12)


@pytest.mark.parametrize("seed", range(6))
def test_a_pair_more_that_fits_is_passive(seed: int) -> None:
    train = Train(seed)
    a, b = apart(train)
    train.mesh("more", a, b, train.speed[b] / train.speed[a])
    found = lw.structure(lw.loads(train.text()))
    assert (found.mobility, found.grubler, len(found.passive)) == (1, 0, 1)
    assert found.trains[0].blocked == () and len(found.trains[0].pairs) == WHEELS


@pytest.mark.parametrize("seed", range(6))
def test_a_pair_more_that_does_not_fit_blocks_and_the_loop_is_named(seed: int) -> None:
    train = Train(seed)
    a, b = apart(train)
    train.mesh("more", a, b, 0.77 * train.speed[b] / train.speed[a])
    with refused("mobility.blocked", lw.StructureError) as blocked:
        lw.structure(lw.loads(train.text()))
    loop = {f"mesh{k}" for k in set(train.way(a)) ^ set(train.way(b))} | {"more"}
    assert set(blocked.value.values["pairs"]) == {f"'{name}'" for name in loop}


ON_AN_ARM = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links:
  arm: {points: {O: [0 m, 0 m], C: [0.4 m, 0.3 m]}}
  sun: {points: {O: [0 m, 0 m], S: [0.05 m, 0 m]}}
  planet: {points: {C: [0 m, 0 m], P: [0.02 m, 0 m]}}
joints: {pair: {kind: KIND, links: LINKS, SIZES, carrier: arm}}
drivers:
  turning: {turn: arm, about: O, speed: 3 rad/s, start: 20 deg}
  held: {turn: sun, about: O, position: "0.3 rad - 2 rad*(t/(1 s))^2"}
cycle: {duration: 1 s}
"""


@pytest.mark.parametrize("swapped", [False, True])
@pytest.mark.parametrize(
    ("kind", "sizes", "ratio"),
    [
        ("belt", ("radii: [50 mm, 20 mm]", "radii: [20 mm, 50 mm]"), 2.5),
        ("belt", ("radii: [50 mm, 20 mm], run: crossed", "radii: [20 mm, 50 mm], run: crossed"), -2.5),
        ("chain", ("teeth: [36, 18], pitch: 12.7 mm", "teeth: [18, 36], pitch: 12.7 mm"), 2.0),
        ("gear", ("teeth: [20, 40]", "teeth: [40, 20]"), -0.5),
        ("gear", ("ratio: 0.25", "ratio: 4"), 0.25),
    ],
)
def test_a_pair_on_a_turning_arm_follows_willis(
    kind: str, sizes: tuple[str, str], ratio: float, swapped: bool
) -> None:
    """ω_p - ω_k = i (ω_s - ω_k), of angles and accelerations too."""
    links = "[planet, sun]" if swapped else "[sun, planet]"
    text = ON_AN_ARM.replace("KIND", kind).replace("SIZES", sizes[swapped]).replace("LINKS", links)
    motion = lw.solve_motion(lw.loads(text), steps=8)
    time = motion.time
    sun, arm, planet = (motion.link(name) for name in ("sun", "arm", "planet"))
    assert planet.angular_velocity == pytest.approx(3.0 + ratio * (-4.0 * time - 3.0), abs=1e-11)
    assert planet.angular_acceleration == pytest.approx(np.full(len(time), -4.0 * ratio), abs=1e-10)
    turned = [each.angle - each.angle[0] for each in (sun, arm, planet)]
    assert turned[2] == pytest.approx(turned[1] + ratio * (turned[0] - turned[1]), abs=1e-11)
    assert turned[0] == pytest.approx(-2.0 * time**2, abs=1e-12)
