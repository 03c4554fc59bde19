"""Every gallery file: its standard diagrams, in turn, are drawn or refused with the reason that is right for it."""

from collections.abc import Mapping
from xml.etree import ElementTree

import numpy as np
import pytest
from tests import store
from tests.refusals import refused
from tests.share import in_turn

import linkwright as lw

NAMES = store.names()
ONE = "jaw_crusher_sixbar"
STEPS = 120
#: Kinds that are written as pictures, one of each test in turn; all others are laid out only.
OF_MOTION = ("sva", "angles", "paths")
POLYGONS = ("velocity_polygon", "acceleration_polygon")
OF_FORCES = ("torque", "power", "energy", "speed", "reactions", "hodograph", "shaking", "force_polygon")

AT_REST = {"truss", "two_bars_equilibrium"}
#: Nothing acts on them and no link has a mass.
FORCELESS = {
    "chebyshev_lambda",
    "crank_rocker",
    "fourbar_lecture",
    "pantograph",
    "peaucellier",
    "press_double_crank",
    "slider_crank_offset",
    "theo_jansen_leg",
}
PART_OF_A_TURN = {
    "change_point_fourbar",
    "geneva_wheel",
    "kite",
    "lid_on_gas_strut",
    "parallelogram",
    "peaucellier",
    "tangent_mechanism",
}
#: Driven by a slide, by several drivers.
NOT_ONE_CRANK = {
    "double_slider",
    "dyad_prp",
    "dyad_rrr",
    "excavator",
    "five_bar_robot",
    "gear_differential",
    "pantograph",
    "planetary_two_inputs",
    "robot_arm",
    "wedge",
}
UNEVEN = {"stephenson_sixbar_triad"}
#: Over a cycle their loads take no work: there is no speed that they would fall from.
NO_WORK = {
    "andrews_squeezer",
    "chebyshev_lambda",
    "class_four_group",
    "crank_rocker",
    "dyad_rpp",
    "dyad_rpr",
    "dyad_rrp",
    "fourbar_lecture",
    "fourth_order_group",
    "geared_fivebar",
    "geared_fivebar_double",
    "geared_fivebar_third",
    "press_double_crank",
    "scotch_yoke",
    "shaper_quick_return",
    "slider_crank_inline",
    "slider_crank_offset",
    "stephenson_sixbar",
    "theo_jansen_leg",
    "toggle_press",
    "triad",
    "watt_sixbar",
    "whitworth",
}
_RUNNING = {"running.not_whole_turns": PART_OF_A_TURN, "running.not_constant": UNEVEN}
#: By kind and code the models to which a diagram makes no sense; all others are drawn.
REFUSED: Mapping[str, Mapping[str, set[str]]] = {
    "sva": {"picture.no_input": AT_REST},
    "angles": {"picture.no_input": AT_REST, "picture.none_turns": {"wedge"}},
    "paths": {},
    "velocity_polygon": {"picture.nothing_moves": AT_REST},
    "acceleration_polygon": {"picture.nothing_moves": AT_REST},
    "torque": {"picture.no_input": AT_REST},
    "power": {"picture.no_input": AT_REST},
    "energy": {**_RUNNING, "running.one_driver": NOT_ONE_CRANK | AT_REST},
    "speed": {
        **_RUNNING,
        "running.one_driver": NOT_ONE_CRANK,
        "running.no_work": NO_WORK,
        "picture.no_input": AT_REST,
    },
    "reactions": {"picture.no_input": AT_REST, "picture.no_forces": FORCELESS},
    "hodograph": {"picture.no_input": AT_REST, "picture.no_forces": FORCELESS},
    "shaking": {"picture.no_input": AT_REST, "picture.no_forces": FORCELESS},
    "force_polygon": {"picture.no_forces": FORCELESS},
}


def refusal(kind: str, name: str) -> str | None:
    """The code with which a diagram of a model is refused."""
    return next((code for code, names in REFUSED[kind].items() if name in names), None)


def result(kind: str, name: str) -> lw.Motion | lw.Forces:
    if kind in OF_FORCES:
        return store.forces(name, STEPS)
    return store.motion(name, STEPS)


def place(name: str) -> float:
    """A third of the way: of drivers of constant speed by the input, of others by the time."""
    motion = store.motion(name, STEPS)
    good = np.flatnonzero(motion.ok)
    steady = all(driver.law.key == "speed" for driver in motion.mechanism.drivers.values())
    return float((motion.input if steady else motion.time)[good[len(good) // 3]])


def is_right(kind: str, name: str, written: bool = False) -> None:
    """A diagram is drawn, and written as a picture; or refused with the reason that is right for the model."""
    still = name in AT_REST
    options = {"at": 0.0 if still else place(name)} if kind in POLYGONS else {}
    code = refusal(kind, name)
    if code is not None:
        with refused(code):
            lw.plot(result(kind, name), kind, **options)
        return
    diagram = lw.plot(result(kind, name), kind, **options)
    drawing = isinstance(diagram.figure, lw.Drawing)
    assert drawing or [
        axes for axes in diagram.figure.axes if axes.lines or axes.collections or axes.patches or axes.texts
    ]
    if written or drawing:
        assert len(list(ElementTree.fromstring(diagram.svg()).iter())) > 20


@pytest.mark.parametrize("kind", [*OF_MOTION, *POLYGONS, *OF_FORCES])
def test_every_kind_is_drawn(kind: str) -> None:
    is_right(kind, ONE, written=True)


def test_the_reasons_are_of_models_of_the_gallery() -> None:
    assert {name for codes in REFUSED.values() for names in codes.values() for name in names} <= set(NAMES)


@pytest.mark.rotating
@pytest.mark.parametrize("name", NAMES)
def test_motion_is_drawn(name: str) -> None:
    turn = NAMES.index(name)
    for k, kind in enumerate(in_turn(OF_MOTION, turn, 1)):
        is_right(kind, name, turn % 4 == k)


@pytest.mark.rotating
@pytest.mark.parametrize("name", NAMES)
def test_polygons_are_drawn(name: str) -> None:
    turn = NAMES.index(name)
    for k, kind in enumerate(in_turn(POLYGONS, turn, 1)):
        is_right(kind, name, turn % 5 == k)


@pytest.mark.rotating
@pytest.mark.parametrize("name", NAMES)
def test_forces_are_drawn(name: str) -> None:
    turn = NAMES.index(name)
    for k, kind in enumerate(in_turn(OF_FORCES, turn, 2)):
        is_right(kind, name, turn % 5 == k)
