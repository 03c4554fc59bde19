"""Balanced mechanisms: the shaking force is zero by the law of the centre of mass, whatever the formula."""

import numpy as np
import pytest
from tests.every import every
from tests.refusals import refused
from tests.store import machine

import linkwright as lw

FOURBAR = """
format: 1
name: four-bar with mass centres off its lines
frame: {points: {O1: [0 m, 0 m], O2: [0.4 m, 0.05 m]}}
links:
  crank: {points: [O1, A], length: 0.1 m, mass: 1 kg, inertia: 0.002 kg·m², mass_centre: [0.03 m, 0.01 m]}
  coupler: {points: [A, B], length: 0.35 m, mass: 2.5 kg, inertia: 0.02 kg·m², mass_centre: [0.2 m, 0.06 m]}
  rocker: {points: [O2, B], length: 0.25 m, mass: 1.7 kg, inertia: 0.01 kg·m², mass_centre: [0.1 m, -0.02 m]}
driver: {turn: crank, about: O1, speed: 25 rad/s}
"""

SLIDER = """
format: 1
name: slider-crank
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 0.05 m, mass: 1 kg, inertia: 0.002 kg·m²}
  rod: {points: [A, B], length: 0.2 m, mass: 0.8 kg, inertia: 0.004 kg·m², mass_centre: [0.06 m, 0 m]}
  piston: {points: [B], mass: 0.9 kg}
joints: {guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: piston, at: B}}
driver: {turn: crank, about: O, speed: 100 rad/s}
"""


#: The same with the crank in axes of which neither pin is the origin.
ASIDE = SLIDER.replace(
    "crank: {points: [O, A], length: 0.05 m,",
    "crank: {points: {O: [0.3 m, 0.1 m], A: [0.34 m, 0.13 m]}, mass_centre: [0.32 m, 0.12 m],",
)


@pytest.mark.parametrize("text", [FOURBAR, SLIDER, ASIDE])
def test_full_balance_leaves_no_shaking_force(text: str) -> None:
    found = lw.balance(lw.loads(text), radius=0.08)
    before = np.abs(found.before.shaking_force).max()
    assert before > 10
    assert np.abs(found.after.shaking_force).max() < 1e-12 * before
    title, *lines = found.text().splitlines()
    assert found.mechanism.name in title
    rows = [line.split() for line in lines]
    for weight in found.counterweights:
        mass, place = f"{weight.mass:.6g}", f"{1e3 * weight.place[0]:.6g}"
        assert [row for row in rows if row[:2] == [weight.link, mass] and place in row]
    scale = max(map(max, found.effect().values()))
    for peaks in found.effect().values():
        shown = {"0" if peak < 1e-12 * scale else f"{peak:.6g}" for peak in peaks}
        assert [row for row in rows if shown <= set(row)]


def test_partial_balance_of_a_slider_crank_lowers_the_peak_and_raises_the_cross_force() -> None:
    found = lw.balance(lw.loads(SLIDER), radius=0.05, share=0.5)
    before, after = found.before.shaking_force, found.after.shaking_force
    assert np.hypot(*after.T).max() < 0.7 * np.hypot(*before.T).max()
    rotating = 1.0 * 0.025 + 0.8 * (1 - 0.06 / 0.2) * 0.05
    reciprocating = (0.9 + 0.8 * 0.3) * 0.05
    assert np.abs(after[:, 1]).max() == pytest.approx(0.5 * reciprocating * 100**2, rel=1e-9)
    assert np.abs(before[:, 1]).max() == pytest.approx(rotating * 100**2, rel=1e-9)


def test_other_mechanisms_are_refused() -> None:
    with refused("forces.not_balanced"):
        lw.balance(machine("jaw_crusher_sixbar"), radius=0.1)
    whitworth = FOURBAR.replace("coupler: {points: [A, B], length: 0.35 m,", "coupler: {points: [A],").replace(
        "rocker: {points: [O2, B], length: 0.25 m,", "rocker: {points: [O2],"
    )
    slot = "joints: {slot: {kind: prismatic, guide: rocker, through: O2, direction: 0 deg, block: coupler, at: A}}"
    with refused("forces.no_pin_shared", a="rocker", b="coupler"):
        lw.balance(lw.loads(whitworth + slot), radius=0.1)
    for share in (-0.1, 1.1):
        with refused("forces.share", share=share):
            lw.balance(lw.loads(FOURBAR), radius=0.1, share=share)
    with refused("forces.weight_no_radius", link="rocker"):
        lw.balance(lw.loads(FOURBAR), radius={"crank": 0.1})
    for radius in (0.0, -0.1):
        with refused("forces.weight_radius", link="crank", distance=radius):
            lw.balance(lw.loads(FOURBAR), radius=radius)


@pytest.mark.parametrize("share", [0.0, 0.4])
def test_a_part_of_a_four_bar_s_balance_leaves_the_rest(share: float) -> None:
    """Counterweights move the centre of mass in proportion: what shakes is (1 - share) of what shook, everywhere."""
    found = lw.balance(lw.loads(FOURBAR), radius={"crank": 0.05, "rocker": 0.12}, share=share, steps=24)
    before, after = found.before.shaking_force, found.after.shaking_force
    assert len(before) == 24
    assert after == pytest.approx((1 - share) * before, abs=1e-9 * np.abs(before).max())
    assert len(found.counterweights) == (2 if share else 0)
    for weight, radius in zip(found.counterweights, (0.05, 0.12) if share else (), strict=True):
        assert np.hypot(*weight.place) == pytest.approx(radius)


def test_a_counterweight_adds_its_own_inertia_about_its_pin() -> None:
    """J + m d² of a link about its pin on the frame grows by m r² of the weight; so does the kinetic energy."""
    plain = lw.loads(FOURBAR)
    found = lw.balance(plain, radius=0.08)
    for weight in every(found.counterweights, least=2):
        old, new = (machine.links[weight.link] for machine in (plain, found.mechanism))
        assert new.mass == pytest.approx(old.mass + weight.mass)
        about = [each.inertia + each.mass * (each.centre[0] ** 2 + each.centre[1] ** 2) for each in (old, new)]
        assert about[1] - about[0] == pytest.approx(weight.mass * 0.08**2)
        moments = [each.mass * np.array(each.centre) for each in (old, new)]
        assert moments[1] - moments[0] == pytest.approx(weight.mass * np.array(weight.place))
