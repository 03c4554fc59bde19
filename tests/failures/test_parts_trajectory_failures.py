"""Throws and conveyors that cannot be calculated say why."""

import pytest
from tests.refusals import faulty

from linkwright import parts

BALL, LOAD = "format: 1\nkind: trajectory\n", "format: 1\nkind: throw\n"


@pytest.mark.parametrize(
    ("text", "key", "code", "values"),
    [
        (BALL + "speed: 3 m/s\n", "speed", "start", {}),
        (BALL + "speed: 3 m/s\nangle: 3 deg\nquadratic: 1 kg/m\n", "mass", "mass_needed", {}),
        (
            BALL + "speed: 3 m/s\nangle: 3 deg\nmass: 1 kg\ndrag_coefficient: 0.4\n",
            "drag_coefficient",
            "drag_form",
            {},
        ),
        (
            BALL + "speed: 3 m/s\nangle: 3 deg\nmass: 1 kg\nlinear: 1 N·s/m\nquadratic: 1 kg/m\n",
            "linear",
            "one_drag",
            {},
        ),
        (BALL + "mechanism: gallery:crank_rocker\npoint: coupler.P\n", "mechanism", "thrower_form", {}),
        (
            BALL + "mechanism: gallery:crank_rocker\npoint: coupler.Q\nat: 3 deg\n",
            "mechanism",
            "thrower",
            {"link": "coupler", "name": "Q", "names": ("A", "B", "P")},
        ),
        (
            LOAD + "mechanism: gallery:swing_conveyor\nlink: trough\nfriction: 0.3\n",
            "link",
            "no_link",
            {"link": "trough"},
        ),
        (
            LOAD + "mechanism: gallery:swing_conveyor\nlink: rocker\nfriction: 0.3\n",
            "link",
            "turns",
            {"link": "rocker"},
        ),
        (
            LOAD + "mechanism: gallery:slider_crank_inline\nlink: piston\nfriction: 0.3\n",
            "mechanism",
            "no_gravity",
            {},
        ),
        (
            LOAD + "mechanism: gallery:swing_conveyor\nlink: slider\nfriction: 0.3\nsliding_friction: 0.4\n",
            "sliding_friction",
            "friction_order",
            {},
        ),
    ],
)
def test_refusals(text: str, key: str, code: str, values: dict[str, object]) -> None:
    with faulty(code, key, **values):
        parts.loads(text, "t.yaml").solve()
