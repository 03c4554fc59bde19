"""Parameters of a file that are products: one where they are used."""

import math

import pytest
from tests.refusals import findings, said

from linkwright import loads


@pytest.mark.parametrize(
    ("parameters", "speed", "torque"),
    [
        ("{P: 3 kW, n: 90 rpm, M: P/n}", "n", "M"),
        ("{v: 3 m/s, r: 0.5 m, w: v/r, c: 20 N·m·s/rad}", "w", "c*w"),
        ("{f: 2 Hz, w: 2*pi*f, k: 30 N·m/rad}", "w", "k*(1 rad)"),
    ],
)
def test_a_parameter_that_is_a_product_is_one_where_it_is_used(parameters: str, speed: str, torque: str) -> None:
    text = (
        f"format: 1\nparameters: {parameters}\nframe: {{points: {{O: [0 m, 0 m]}}}}\n"
        "links: {drum: {points: [O, K], length: 80 mm, mass: 3 kg, inertia: 0.02 kg·m²}}\n"
        f"driver: {{turn: drum, about: O, speed: {speed}}}\n"
        f"loads: {{brake: {{kind: torque, on: drum, opposes: velocity, magnitude: {torque}}}}}\n"
    )
    size = loads(text).dimensions()
    wanted = {"n": (3 * math.pi, 1000 / math.pi), "w": (6.0, 120.0) if "v" in parameters else (4 * math.pi, 30.0)}[
        speed
    ]
    assert (size["driver.speed"], size["loads.brake.magnitude"]) == pytest.approx(wanted, rel=1e-14)
    cycles = text.replace(f"speed: {speed}", "speed: q").replace("parameters: {", "parameters: {q: 2 Hz, ")
    said(findings(cycles), "ambiguous", "driver.speed", text="q")
