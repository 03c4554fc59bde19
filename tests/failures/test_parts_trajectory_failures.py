"""Throws and conveyors that cannot be calculated say why."""

import pytest

import linkwright as lw
from linkwright import parts

BALL, LOAD = "format: 1\nkind: trajectory\n", "format: 1\nkind: throw\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (BALL + "speed: 3 m/s\n", "the throw has no start"),
        (BALL + "speed: 3 m/s\nangle: 3 deg\nquadratic: 1 kg/m\n", "drag acts on a mass"),
        (
            BALL + "speed: 3 m/s\nangle: 3 deg\nmass: 1 kg\ndrag_coefficient: 0.4\n",
            "neither complete nor unique",
        ),
        (
            BALL + "speed: 3 m/s\nangle: 3 deg\nmass: 1 kg\nlinear: 1 N·s/m\nquadratic: 1 kg/m\n",
            "two kinds of drag",
        ),
        (BALL + "mechanism: gallery:crank_rocker\npoint: coupler.P\n", "needs point and at"),
        (BALL + "mechanism: gallery:crank_rocker\npoint: coupler.Q\nat: 3 deg\n", "cannot be solved"),
        (LOAD + "mechanism: gallery:swing_conveyor\nlink: trough\nfriction: 0.3\n", 'no link "trough"'),
        (
            LOAD + "mechanism: gallery:swing_conveyor\nlink: rocker\nfriction: 0.3\n",
            "the trough rocker turns",
        ),
        (
            LOAD + "mechanism: gallery:slider_crank_inline\nlink: piston\nfriction: 0.3\n",
            "no gravity presses",
        ),
        (
            LOAD + "mechanism: gallery:swing_conveyor\nlink: slider\nfriction: 0.3\nsliding_friction: 0.4\n",
            "larger than at rest",
        ),
    ],
)
def test_refusals(text: str, words: str) -> None:
    with pytest.raises(lw.ModelError) as error:
        parts.loads(text, "t.yaml").solve()
    assert words in str(error.value) and error.value.say("zh") != str(error.value)
