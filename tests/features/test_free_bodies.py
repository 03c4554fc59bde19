"""Free-body diagrams: what is drawn of each link is in balance, to its scale, and nothing that acts is left out."""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import combinations
from xml.etree import ElementTree

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.refusals import refused

import linkwright as lw

SVG = "{http://www.w3.org/2000/svg}"
#: Printed millimetres of a unit of the picture.
MILLIMETRE = 0.25
LOADED = """
format: 1
name: everything on a slider-crank
frame: {points: {O: [0 m, 0 m], S: [-0.1 m, 0.2 m]}}
links:
  crank: {points: [O, A], length: 0.1 m, mass: 2 kg, inertia: 0.01 kg·m²}
  rod: {points: [A, B], length: 0.3 m, mass: 1 kg, inertia: 0.02 kg·m²}
  slider: {points: [B], mass: 3 kg}
joints:
  O: {kind: revolute, friction: 0.1, pin_radius: 20 mm}
  guide: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: slider, at: B, friction: 0.2}
driver: {turn: crank, about: O, speed: 20 rad/s, start: 50 deg}
gravity: [0, -9.81 m/s²]
loads:
  push: {kind: force, on: slider, at: B, components: [-500 N, -100 N]}
  turn: {kind: torque, on: rod, magnitude: 12 N·m}
  pull: {kind: spring, between: [frame.S, rod.A], stiffness: 900 N/m, free_length: 0.1 m}
  dash: {kind: damper, between: [frame.S, rod.A], damping: 40 N·s/m}
  twist: {kind: torsion_spring, links: [crank, rod], stiffness: 5 N·m/rad, free_angle: 10 deg}
  drag: {kind: torsion_damper, links: [crank, rod], damping: 0.3 N·m·s/rad}
  gas: {kind: pressure, joint: guide, bore: 80 mm, magnitude: 3 bar, pushes: backward}
"""


@dataclass
class Drawn:
    """One link as it is drawn: scales (m and N per mm), arrows as feet and points in units of the paper, which of
    them are dashed, rows of its table."""

    link: str
    lengths: float
    newtons: float
    arrows: dict[str, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)
    dashed: set[str] = field(default_factory=set)
    rows: dict[str, list[float]] = field(default_factory=dict)


def drawn(source: lw.Motion | lw.Forces, **options: object) -> list[Drawn]:
    """The links of a picture."""
    svg = lw.plot(source, "free_bodies", title="", **options).svg()  # type: ignore[arg-type]
    root = ElementTree.fromstring(svg)
    found = []
    for cell in root.iter(f"{SVG}g"):
        bodies = [each for each in cell if each.get("data-link")]
        if bodies:
            found.append(_read(cell, bodies[0]))
    return every(found)


def _read(cell: ElementTree.Element, body: ElementTree.Element) -> Drawn:
    texts = [each for each in cell if each.tag == f"{SVG}text"]
    scales = re.findall(r"= ([\d.]+) (k|M|m|µ)?(?:N|mm)/mm", "".join(texts[1].itertext()))
    factors = {"": 1.0, "k": 1e3, "M": 1e6, "m": 1e-3, "µ": 1e-6}
    lengths = float(scales[0][0]) * 1e-3
    newtons = float(scales[1][0]) * factors[scales[1][1]] if len(scales) > 1 else math.nan
    read = Drawn(str(body.get("data-link")), lengths, newtons)
    for each in body.iter(f"{SVG}g"):
        name = each.get("data-action")
        lines = [p.get("d", "") for p in each.iter(f"{SVG}path")]
        if name and len(_places(lines[0])) == 2:
            read.arrows[name] = (_places(lines[0])[0], _places(lines[1])[0])
            if each.get("class") == "lw-short":
                read.dashed.add(name)
    kilo = any("kN" in "".join(each.itertext()) for each in texts[2:])
    rows: dict[float, list[tuple[float, str]]] = {}
    for each in texts[2:]:
        place = (float(each.get("x", "0")), "".join(each.itertext()).replace("−", "-"))
        rows.setdefault(float(each.get("y", "0")), []).append(place)
    for row in rows.values():
        (_, name), *cells = sorted(row)
        if cells and all(re.fullmatch(r"-?[\d.]+", text) for _, text in cells):
            values = [float(text) for _, text in cells]
            read.rows[name] = [v * (1e3 if kilo and len(values) > 1 and k < 3 else 1.0) for k, v in enumerate(values)]
    return read


def _places(data: str) -> np.ndarray:
    return np.array([(float(x), float(y)) for x, y in re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", data)])


def vectors(body: Drawn) -> Iterator[tuple[str, np.ndarray, np.ndarray]]:
    """Names, feet (m) and forces (N) of the arrows, read off with the scales; y up."""
    for name, (foot, point) in body.arrows.items():
        yield (name, foot * (1, -1) * MILLIMETRE * body.lengths, (point - foot) * (1, -1) * MILLIMETRE * body.newtons)


def require_balance(body: Drawn) -> None:
    """The numbers of a link's table add up to nothing, and so do the arrows, with the moments of their lines."""
    forces = {name: row for name, row in body.rows.items() if len(row) == 4}
    couples = [row[0] for row in body.rows.values() if len(row) == 1]
    largest = max((row[2] for row in forces.values()), default=0.0)
    for axis in (0, 1):
        assert sum(row[axis] for row in forces.values()) == pytest.approx(0.0, abs=2e-4 * largest)
    for fx, fy, size, angle in forces.values():
        assert size == pytest.approx(math.hypot(fx, fy), abs=2e-4 * largest)
        if size > 0.01 * largest:
            assert math.cos(math.radians(angle) - math.atan2(fy, fx)) == pytest.approx(1.0, abs=1e-4)
    if body.dashed:
        return
    seen = list(vectors(body))
    assert len(seen) == len(forces)
    total = np.sum([np.zeros(2), *(force for _, _, force in seen)], axis=0)
    assert np.abs(total).max() <= 0.01 * largest
    moments = [foot[0] * force[1] - foot[1] * force[0] for _, foot, force in seen]
    reach = max((float(np.hypot(*foot)) for _, foot, _ in seen), default=0.0)
    assert sum(moments) + sum(couples) == pytest.approx(0.0, abs=0.01 * reach * largest + 1e-4)


@pytest.mark.parametrize("name", ["jaw_crusher_sixbar", "rack_and_rocker", "planetary_two_inputs", "truss"])
def test_what_is_drawn_is_in_balance(name: str) -> None:
    for body in every(drawn(store.motion(name, 24)), least=3):
        require_balance(body)


@pytest.mark.rotating
@pytest.mark.parametrize("name", store.names())
def test_every_machine_is_in_balance(name: str) -> None:
    machine = store.machine(name)
    motion = lw.solve_motion(machine, steps=24, failures="mark")
    if not machine.has_loads:
        with refused("picture.no_forces"):
            lw.plot(motion, "free_bodies")
        return
    bodies = drawn(motion)
    for body in bodies:
        require_balance(body)
    for language in ("en", "zh"):
        require_apart(lw.plot(motion, "free_bodies", language=language).svg())


def test_joint_forces_are_those_of_the_analysis() -> None:
    found = {body.link: body for body in drawn(store.motion("jaw_crusher_sixbar"), at=math.radians(150))}
    forces = lw.solve_forces(lw.solve_motion(store.machine("jaw_crusher_sixbar"), at=[math.radians(150)]))
    for link, symbol, joint in (("toggle", "F_B,4", "B"), ("jaw", "F_05", "O5"), ("crank", "F_21", "A")):
        expected = forces.reaction(joint, on=link)[0]
        read = {name: force for name, _, force in vectors(found[link])}
        size = float(np.hypot(*expected))
        assert np.abs(read[symbol] - expected).max() < 0.01 * size
        assert found[link].rows[symbol.replace("_", "")][:2] == pytest.approx(expected, abs=1e-4 * size)


def test_every_load_is_drawn_on_every_link_on_which_it_acts() -> None:
    machine = lw.loads(LOADED)
    found = {body.link: body for body in drawn(lw.solve_motion(machine, steps=12))}
    for body in found.values():
        require_balance(body)
    on_rod, on_crank, on_slider = (set(found[link].rows) for link in ("rod", "crank", "slider"))
    assert {"turn", "pull", "dash", "twist", "drag"} <= on_rod
    assert {"twist", "drag", "Mf,O", "Md"} <= on_crank
    assert {"push", "gas", "Ff,guide", "G3", "FI3"} <= on_slider


def test_a_load_between_links_acts_on_both_against_each_other() -> None:
    found = {body.link: body for body in drawn(lw.solve_motion(lw.loads(LOADED), steps=12))}
    assert found["rod"].rows["twist"][0] == pytest.approx(-found["crank"].rows["twist"][0], rel=1e-3)


@pytest.mark.parametrize("name", ["swing_conveyor", "shaper_quick_return", "gear_differential"])
def test_scales_are_round(name: str) -> None:
    for body in drawn(store.motion(name, 24)):
        for scale in (body.lengths, body.newtons):
            digits = scale / 10.0 ** math.floor(math.log10(scale) + 1e-9)
            assert min(abs(digits - each) for each in (1.0, 2.0, 2.5, 4.0, 5.0, 10.0)) < 1e-6


def test_static_leaves_the_inertia_out_and_named_links_come_alone() -> None:
    (body,) = drawn(store.motion("jaw_crusher_sixbar", 24), of=["jaw"], static=True)
    assert body.link == "jaw"
    assert not any("I" in name for name in body.rows)
    assert "G5" in body.rows


def require_apart(svg: str) -> None:
    """No symbol of an arrow lies over another one of the same link."""
    root = ElementTree.fromstring(svg)
    for body in every(each for each in root.iter(f"{SVG}g") if each.get("data-link")):
        texts = [each for each in body.iter(f"{SVG}text") if "name" in each.get("class", "")]
        boxes = []
        for each in texts:
            size, low = (float(each.get("font-size", "0")), "".join(t.text or "" for t in each.iter(f"{SVG}tspan")))
            x, y = float(each.get("x", "0")), float(each.get("y", "0"))
            half = 0.25 * size * (len("".join(each.itertext())) - 0.3 * len(low))
            boxes.append((x - half, y - 0.7 * size, x + half, y))
        for a, b in combinations(boxes, 2):
            assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1], (body.get("data-link"), a, b)


def test_what_is_no_link_is_refused() -> None:
    with refused("names.no_such"):
        lw.plot(store.motion("swing_conveyor", 24), "free_bodies", of=["anvil"])
    with refused("picture.one_free_bodies"):
        lw.plot([store.machine("truss"), store.machine("swing_conveyor")], "free_bodies")
