"""Gears of machines mesh when these are put together: no overlap, and contact."""

import numpy as np
import pytest
import shapely
from tests import store

import linkwright as lw
from linkwright.fabrication.teeth import toothed
from linkwright.kinematics.placement import placements

#: Chords between the points of flanks are nearer to them than this, m.
CHORDS = 2e-6


def outlines(mechanism: lw.Mechanism, index: int) -> dict[str, shapely.Polygon]:
    """Outlines of the gears of a machine in the frame's axes, by their links."""
    placed = placements(lw.solve_motion(mechanism, steps=36))
    found = {}
    for each in toothed(mechanism):
        at = placed[each.link]
        ring = complex(*at.origin[index]) + complex(*at.direction[index]) * each.corners
        found[each.link] = shapely.Polygon([(z.real, z.imag) for z in ring])
    return found


@pytest.mark.parametrize("name", ["external_gear_pair", "internal_gear_pair", "planetary_two_inputs"])
@pytest.mark.parametrize("index", [0, 7])
def test_meshing_gears_touch_without_overlap(name: str, index: int) -> None:
    machine = store.machine(name)
    gears = outlines(machine, index)
    pairs = [joint for joint in machine.joints.values() if joint.links[0] in gears and joint.links[1] in gears]
    pairs = [joint for joint in pairs if type(joint).__name__ == "GearPair"]
    assert pairs
    for joint in pairs:
        one, other = (gears[link] for link in joint.links)
        if joint.transmission > 0:
            wheel, ring = sorted((one, other), key=lambda each: each.area)
            overlap = wheel.difference(ring)
        else:
            overlap = one.intersection(other)
        assert overlap.buffer(-CHORDS).area == 0.0
        assert one.exterior.distance(other.exterior) < CHORDS


def test_a_tooth_of_the_first_gear_is_on_its_x_axis() -> None:
    first = toothed(store.machine("external_gear_pair"))[0]
    local = first.corners - first.centre
    tips = local[np.abs(np.abs(local) - 0.5 * first.gear.tip_diameter) < 1e-9]
    assert np.abs(np.angle(tips)).min() < 1e-9
