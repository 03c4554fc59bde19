"""Every machine of the gallery has sizes: from its forces, or by rule with the reason."""

import pytest

import linkwright as lw
from linkwright.sizing.size_links import size_links
from linkwright.sizing.sizes import sizes_of

#: Sizes by rule, from forces, given in part; all others in the long run.
FEW = ("crank_rocker", "toggle_press", "plate_linkage")
MACHINES = [pytest.param(each, marks=() if each in FEW else pytest.mark.long) for each in lw.gallery_names()]


@pytest.mark.parametrize("name", MACHINES)
def test_machine_has_sizes(name: str) -> None:
    machine = lw.load(f"gallery:{name}")
    sizes = sizes_of(machine)
    links = {"frame", *machine.links}
    assert set(sizes.width) == links == set(sizes.thickness)
    assert set(sizes.pin_radius) == set(machine.pins)
    assert all(size > 0.0 for found in (sizes.width, sizes.pin_radius, sizes.thickness) for size in found.values())
    assert sizes.notes or machine.construction is not None


@pytest.mark.parametrize("name", ["toggle_press", "press_course"])
def test_largest_forces_are_those_of_the_metric(name: str) -> None:
    """Another way to the same: extremes of the formulas of the cycle, between the jumps of the loads."""
    machine = lw.load(f"gallery:{name}")
    peaks = {each.subject: each.value for each in lw.metrics(lw.solve_forces(machine), ["peak_reaction"])}
    for pin, size in size_links(machine, steps=60).pins.items():
        for each in size.load.links:
            wanted = peaks.get(pin, peaks.get(f"{pin} on {each.link}"))
            assert each.force == pytest.approx(wanted, rel=1e-6)
