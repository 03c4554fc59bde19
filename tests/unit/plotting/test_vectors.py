"""Values of legends: round, and with the prefix that fits; fonts that cannot write Chinese."""

import pytest
from tests import store
from tests.refusals import refused

import linkwright as lw
from linkwright.errors import RequestError
from linkwright.plotting.drawing.vectors import round_length, with_unit


@pytest.mark.parametrize(
    ("value", "unit", "text"), [(2e4, "N", "20 kN"), (5.0, "N", "5 N"), (1e6, "N", "1 MN"), (0.5, "m/s", "0.5 m/s")]
)
def test_legend_values(value: float, unit: str, text: str) -> None:
    assert with_unit(value, unit) == text


@pytest.mark.parametrize("largest", [3.7, 85e3, 0.0123])
def test_legend_value_is_round_and_fits(largest: float) -> None:
    scale = 120.0 / largest
    value = round_length(scale)
    assert f"{value:.6e}"[0] in "125" and f"{value:.6e}"[1:8] == ".000000"
    assert largest / 5.001 <= value <= largest / 2 * 1.000001


def test_chinese_needs_a_font(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("resvg_py")
    monkeypatch.setattr("linkwright.pictures.fonts.installed_chinese", lambda: ())
    drawing = lw.draw(store.motion("jaw_crusher_sixbar", 72), velocities=("B",), language="zh")
    with refused("picture.no_chinese_font", RequestError):
        drawing.png()
