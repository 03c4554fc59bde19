"""Masses that follow from shapes: by hand, in changed machines, in sweeps and gradients, in what is minimised."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from tests.refusals import findings, refused, said

import linkwright as lw
from linkwright.designs.optimise.dimensions import HeldDimensions
from linkwright.designs.varied_dimensions import changed_text
from linkwright.mechanism.construction import MATERIALS
from linkwright.mechanism.mass_from_shape import ENDS

MACHINE = """
format: 1
name: four-bar
parameters: {w: 40 mm}
frame: {points: {O1: [0 m, 0 m], O2: [400 mm, 0 m]}}
links:
  crank: {points: [O1, A], length: 100 mm, CRANK}
  coupler: {points: [A, B], length: 350 mm, also: {P: [150 mm, 100 mm]}, COUPLER}
  rocker: {points: [O2, B], length: 300 mm, mass: from shape, shape: {width: 3/4*w, thickness: 8 mm}}
joints: {A: {kind: revolute, pin_radius: 8 mm}}
driver: {turn: crank, about: O1, speed: 10 rad/s}
assembly: {B: left}
gravity: [0, -9.81 m/s²]
construction: {MADE}
"""
MADE = "width: w, thickness: 6 mm, pin_radius: 6 mm"
FROM = "mass: from shape"


def text(crank: str = FROM, coupler: str = f"{FROM}, shape: {{material: brass}}", made: str = MADE) -> str:
    return MACHINE.replace("CRANK", crank).replace("COUPLER", coupler).replace("MADE", made)


def test_a_bar_by_hand() -> None:
    """A rectangle 100 x 40, two half discs of radius 20, holes of radius 6 and 8 at its ends."""
    link = lw.loads(text()).links["crank"]
    surface, r, length = MATERIALS["steel"].density * 0.006, 0.02, 0.1
    holes = [math.pi * 0.006**2, math.pi * 0.008**2]
    area = length * 2 * r + math.pi * r**2 - sum(holes)
    centre = ((length * 2 * r + math.pi * r**2) * 0.5 * length - holes[1] * length) / area
    about_middle = (
        2 * r * length * (length**2 + 4 * r**2) / 12
        + math.pi * r**4 / 2
        + math.pi * r**2 * length**2 / 4
        + 4 / 3 * r**3 * length
        - sum(hole * (rho**2 / 2 + length**2 / 4) for hole, rho in zip(holes, (0.006, 0.008), strict=True))
    )
    assert link.mass == pytest.approx(surface * area, rel=1e-12)
    assert link.centre == pytest.approx((centre, 0.0), rel=1e-12)
    assert link.inertia == pytest.approx(surface * (about_middle - area * (centre - 0.5 * length) ** 2), rel=1e-12)


def test_discs_and_outlines_by_hand() -> None:
    disc = lw.loads(text(crank=f"{FROM}, shape: {{radius: 120 mm, material: pom}}")).links["crank"]
    holes = math.pi * (0.006**2 + 0.008**2)
    assert disc.mass == pytest.approx(1410 * 0.006 * (math.pi * 0.12**2 - holes), rel=1e-12)
    square = "[[-20 mm, -30 mm], [130 mm, -30 mm], [130 mm, 30 mm], [-20 mm, 30 mm]]"
    plate = lw.loads(text(crank=f"{FROM}, shape: {{outline: {square}}}")).links["crank"]
    assert plate.mass == pytest.approx(7850 * 0.006 * (0.15 * 0.06 - holes), rel=1e-12)


def test_it_is_written_as_it_was_read() -> None:
    machine = lw.loads(text())
    again = lw.loads(lw.dump(machine))
    assert lw.dump(machine).count("mass: from shape") == 3
    assert "inertia" not in lw.dump(machine) and "mass_centre" not in lw.dump(machine)
    assert again.links == machine.links


def test_the_mass_follows_and_stays_where_it_is_set() -> None:
    machine = lw.loads(text())
    wide = machine.with_dimensions({"w": 0.05, "crank.length": 0.12, "A.pin_radius": 0.01})
    changed = {"w: 40": "w: 50", "length: 100": "length: 120", "radius: 8": "radius: 10"}
    model = text()
    for old, new in changed.items():
        model = model.replace(old, new)
    read = lw.loads(model)
    for name, link in read.links.items():
        assert wide.links[name].mass == pytest.approx(link.mass, rel=1e-12)
        assert wide.links[name].inertia == pytest.approx(link.inertia, rel=1e-12)
        assert wide.dimension(f"{name}.mass") == wide.links[name].mass
    heavy = wide.with_dimensions({"crank.mass": 2.0})
    assert not heavy.links["crank"].mass_from_shape
    assert heavy.with_dimensions({"w": 0.06}).links["crank"].mass == 2.0
    assert heavy.with_dimensions({"w": 0.06}).links["coupler"].mass > wide.links["coupler"].mass


VARIED = {
    "crank.length": (0.09, 0.1),
    "coupler.P.x": (-0.1, 0.15, 0.4),
    "coupler.P.y": (-0.1, 0.0, 0.06, 0.1),
    "w": (0.03, 0.04),
    "A.pin_radius": (0.004, 0.012),
    "construction.pin_radius": (0.004, 0.01),
    "construction.thickness": (0.006, 0.01),
    "rocker.shape.thickness": (0.004, 0.01),
    "construction.material.density": (2700.0, 7850.0),
    "coupler.shape.material.density": (2700.0, 8470.0),
}


@pytest.mark.parametrize("address", VARIED)
def test_masses_that_vary_are_those_of_changed_machines(address: str) -> None:
    """As traced values with their slopes, against machines changed one by one."""
    machine, values = lw.loads(text()), np.array(VARIED[address])
    names = [f"{link}{end}" for link in machine.links for end in ENDS]
    held = HeldDimensions(machine, [address], names)
    found = held.values({address: values})
    slopes = held.slopes({address: values}, (address,))
    for k, value in enumerate(values):
        alone, up, down = (machine.with_dimensions({address: value * (1.0 + h)}) for h in (0.0, 1e-6, -1e-6))
        for name in names:
            size = abs(alone.dimension(name)) + 1e-9
            assert found[name][k] == pytest.approx(alone.dimension(name), rel=1e-11, abs=1e-11 * size)
            if value:
                slope = (up.dimension(name) - down.dimension(name)) / (2e-6 * value)
                assert slopes[name][k, 0] == pytest.approx(slope, rel=1e-5, abs=1e-7 * size / abs(value))


def test_a_sweep_has_the_forces_of_changed_machines() -> None:
    machine, widths = lw.loads(text()), [0.03, 0.05]
    swept = lw.sweep(machine, {"w": widths}, outputs=["driver.effort max"], steps=12)["driver.effort max"]
    for width, found in zip(widths, swept, strict=True):
        forces = lw.solve_forces(machine.with_dimensions({"w": width}), steps=12)
        assert found == pytest.approx(forces.driver_effort("driver").max(), rel=1e-11)
    assert swept[1] > 1.2 * swept[0]


@pytest.mark.rotating
def test_a_mass_is_minimised() -> None:
    """The sum of two masses grows with width and length, so that the narrowest and shortest is best."""
    task = """
optimize:
  vary: {w: [30 mm, 60 mm], crank.length: [60 mm, 110 mm]}
  minimize: heavy
  define: {m1: crank.mass, m2: rocker.mass}
""".replace("heavy", '"m1 + m2"')
    machine = lw.loads(text() + task)
    best = lw.optimize(machine).best
    assert best.values["w"] == pytest.approx(0.03, abs=1e-6)
    assert best.values["crank.length"] == pytest.approx(0.06, abs=1e-6)


def test_a_bent_bar_is_weighed_but_does_not_vary() -> None:
    machine = lw.loads(text(crank=f"{FROM}, shape: {{through: [O1, [50 mm, 40 mm], A]}}"))
    reach = math.hypot(0.05, 0.04)
    assert machine.links["crank"].mass < 7850 * 0.006 * (2 * reach * 0.04 + math.pi * 0.02**2)
    moved = machine.with_dimensions({"crank.shape.through.1.y": 0.06})
    assert moved.links["crank"].mass > machine.links["crank"].mass
    with refused("shapes.bent_varies", link="crank"):
        lw.sweep(machine, {"crank.length": [0.09, 0.1]}, outputs=["driver.effort max"], steps=12)
    heavy = [0.006, 0.009]
    swept = lw.sweep(machine, {"construction.thickness": heavy}, outputs=["driver.effort max"], steps=12)
    for thickness, found in zip(heavy, swept["driver.effort max"], strict=True):
        own = machine.with_dimensions({"construction.thickness": thickness})
        assert found == pytest.approx(lw.solve_forces(own, steps=12).driver_effort("driver").max(), rel=1e-11)
    assert lw.sweep(machine, {"coupler.P.y": [0.05, 0.1]}, outputs=["driver.effort max"], steps=12) is not None


REFUSED = [
    (text(made="width: w, thickness: 6 mm"), "missing-key", "links.crank.mass"),
    (text(made="width: w, pin_radius: 6 mm"), "missing-key", "links.crank.mass"),
    (text(made="thickness: 6 mm, pin_radius: 6 mm"), "missing-key", "links.crank.mass"),
    (text(crank=f"{FROM}, inertia: 1 kg·m²"), "choice", "links.crank.inertia"),
    (text(crank=f"{FROM}, mass_centre: A"), "choice", "links.crank.mass_centre"),
    (text(crank=f"{FROM}, shape: none"), "choice", "links.crank.mass"),
    (text(crank=f"{FROM}, shape: {{width: 14 mm}}"), "outline", "links.crank.shape"),
    (text(crank="mass: from shapes"), "unknown-word", "links.crank.mass"),
]


@pytest.mark.parametrize(("model", "code", "key"), REFUSED)
def test_every_mistake_has_its_finding(model: str, code: str, key: str) -> None:
    said(findings(model), code, key)


SLIDER = """
format: 1
name: slider-crank
frame: {points: {O: [0 m, 0 m]}}
links:
  crank: {points: [O, A], length: 100 mm, ON_CRANK}
  rod: {points: [A, B], length: 300 mm, ON_ROD}
  slider: {points: [B], ON_SLIDER}
joints:
  guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slider, at: B}
assembly: {B: forward}
driver: {turn: crank, about: O, speed: 60 rpm}
construction: {width: 40 mm, thickness: 6 mm, pin_radius: 5 mm}
"""


@pytest.mark.parametrize(
    ("on", "shape", "fits"), [("SLIDER", "", False), ("SLIDER", ", shape: {radius: 30 mm}", True), ("ROD", "", True)]
)
def test_a_block_without_a_shape_is_not_weighed(on: str, shape: str, fits: bool) -> None:
    model = SLIDER.replace(f"ON_{on}", f"mass: from shape{shape}")
    for other in ("CRANK", "ROD", "SLIDER"):
        model = model.replace(f", ON_{other}", "")
    if fits:
        assert lw.loads(model).links[on.lower()].mass > 0.0
    else:
        said(findings(model), "choice", "links.slider.mass", link="slider", joint="guide")


def test_what_is_missing_is_named() -> None:
    found = said(findings(text(made="kerf: 0.1 mm")), "missing-key", "links.crank.mass")
    assert "there is no width, thickness, pin_radius" in str(found)
    assert "construction.thickness" in str(found)


def test_a_changed_text_keeps_masses_from_shapes(tmp_path: Path) -> None:
    path = tmp_path / "machine.yaml"
    path.write_text(text())
    document = lw.read_document(path)
    longer = lw.loads(changed_text(document, {"crank.length": 0.11}))
    assert longer.links["crank"] == document.mechanism.with_dimensions({"crank.length": 0.11}).links["crank"]
    for address in ("crank.mass", "coupler.shape.material.density"):
        with refused("model.no_place", address=address):
            changed_text(document, {address: 1.0})
