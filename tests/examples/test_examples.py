"""Scripts and notebooks of ``examples`` run; their numbers agree with closed forms and other sources."""

import ast
import json
import runpy
from collections.abc import Callable
from math import cos, radians
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest

import linkwright as lw

EXAMPLES = Path(__file__).parents[2] / "examples"
#: What a notebook asks a result for.
PICTURES = ("_repr_html_", "_repr_svg_")
Namespace = dict[str, Any]


def run_notebook(path: Path) -> Namespace:
    """Names after all cells, each run as a notebook does: its last expression is shown."""
    names: Namespace = {"__name__": "__main__"}
    for cell in json.loads(path.read_text("utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            assert cell["outputs"] == [] and cell["execution_count"] is None
            body = ast.parse("".join(cell["source"])).body
            last = body.pop() if isinstance(body[-1], ast.Expr) else None
            exec(compile(ast.Module(body, []), path.name, "exec"), names)
            if isinstance(last, ast.Expr):
                shown = eval(compile(ast.Expression(last.value), path.name, "eval"), names)
                assert all(getattr(shown, name)() for name in PICTURES if hasattr(shown, name))
    return names


def crank_rocker(names: Namespace) -> None:
    """Swing, quick return and transmission angle by the law of cosines, which the example prints as well."""
    table = names["table"]
    for metric, by_hand in (
        ("swing_angle", names["swing"]),
        ("quick_return_ratio", names["quick_return"]),
        ("transmission_angle", names["worst"]),
    ):
        assert table.value(metric) == pytest.approx(by_hand, rel=1e-9)


def crusher(names: Namespace) -> None:
    """Torque and pivot force of an independent solution (the gallery's file); the peak is at the limit of the jaw."""
    turned = list(np.degrees(names["motion"].input).round())
    for angle, force, torque in (
        (-45, (-1372.3245, 10669.420), 1547.7604),
        (-180, (-27213.107, 11788.291), -930.43757),
        (-270, (-56138.747, 15682.174), -39.762582),
    ):
        at = turned.index(angle)
        assert names["torque"][at] == pytest.approx(torque, rel=1e-7)
        assert names["pivot"][at] == pytest.approx(np.hypot(*force), rel=1e-7)
    assert np.degrees(names["peak"]) == pytest.approx(-272.43420, abs=1e-5)
    assert "<svg" in Path("crusher.svg").read_text("utf-8")


def worst_angle(crank: float, coupler: float, rocker: float, frame: float) -> float:
    """Smallest transmission angle of a crank-rocker: crank and frame in line."""
    pins = np.array([frame - crank, frame + crank])
    cosine = (coupler**2 + rocker**2 - pins**2) / (2 * coupler * rocker)
    return float(np.arccos(np.abs(cosine)).min())


def million_designs(names: Namespace) -> None:
    """Swing and transmission angle of the optimum by the law of cosines; the frame is 4 m long."""
    crank, coupler, rocker = names["found"].x
    assert worst_angle(crank, coupler, rocker, 4.0) == pytest.approx(radians(40), abs=1e-8)
    reach = np.array([coupler + crank, coupler - crank])
    angles = np.arccos((16 + rocker**2 - reach**2) / (8 * rocker))
    assert names["designs"].ok.all() and len(names["designs"].ok) == 1_000_000
    assert -names["found"].fun == pytest.approx(angles[0] - angles[1], rel=1e-9)
    assert -names["found"].fun >= names["designs"][names["SWING"]][names["best"]]


def path_synthesis(names: Namespace) -> None:
    """The written four-bar, read again, passes every point."""
    machine = lw.load("conveyor_1.yaml")
    curve = lw.solve_motion(machine, steps=20_000).point("P").position
    for point in names["POINTS"]:
        assert np.hypot(*(curve - point).T).min() < 1e-5


def alternatives(names: Namespace) -> None:
    """The four-bar comes first; the page holds both machines."""
    assert names["comparison"].ranking[0].index == 1
    page = Path("crushers.html").read_text("utf-8")
    assert "six-bar" in page and "four-bar" in page and list(names["report"].missing) == []


def cam(names: Namespace) -> None:
    """Velocity coefficients of both laws; the profile in the DXF has the radii of the sizes."""
    assert names["program"].segments[0].law == "polynomial_345"
    motion = names["design"].motion
    assert motion[1].max() == pytest.approx(1.875 * 0.024 / radians(100), rel=1e-9)
    assert motion[1].min() == pytest.approx(-2 * 0.024 / radians(100), rel=1e-4)
    base = names["design"].cam.base_radius
    radii = np.hypot(*names["profile"].T)
    assert radii.min() == pytest.approx(base, rel=1e-9) and radii.max() == pytest.approx(base + 0.024, rel=1e-9)
    assert {each.dxftype() for each in ezdxf.readfile("cam.dxf").modelspace()}


def four_bar(names: Namespace) -> None:
    """The lengths of ``crank_rocker``: limit angles of the rocker by the law of cosines."""
    angles = names["rocker"].angle
    for reach, limit in ((0.220, angles.min()), (0.100, angles.max())):
        inner = (0.18**2 + 0.12**2 - reach**2) / (2 * 0.18 * 0.12)
        assert cos(limit) == pytest.approx(-inner, abs=2e-4)


def study(names: Namespace) -> None:
    """Less torque at the same swing."""
    frame, optimum = names["frame"], names["optimum"]
    assert len(frame) == 7 and frame["swing_angle [rad]"][3] == pytest.approx(1.6718867 - 1.6323814, abs=2e-7)
    better = optimum.mechanism()
    swing = [lw.metrics(lw.solve_motion(each)).value("swing_angle", "jaw") for each in (names["crusher"], better)]
    assert swing[1] == pytest.approx(swing[0], rel=0.0101)
    rms = [lw.metrics(lw.solve_forces(each)).value("rms_input_torque") for each in (names["crusher"], better)]
    assert rms[0] == pytest.approx(names["sensitivity"].value("driver.effort rms"), rel=1e-9)
    assert rms[1] < rms[0] - 3


def geared_press(names: Namespace) -> None:
    """Ratio and stroke of the sizes; the mean power is the work under the table, 1800 J, once a second."""
    assert names["ratio"] == pytest.approx(-1 / 3, rel=1e-12)
    assert names["table"].value("stroke") == pytest.approx(2 * 0.090, rel=1e-9)
    assert names["table"].value("mean_power") == pytest.approx(1800, rel=1e-9)


CHECKS: dict[str, Callable[[Namespace], None]] = {
    f"{check.__name__}.py": check
    for check in (crank_rocker, crusher, million_designs, path_synthesis, alternatives, cam)
} | {f"{check.__name__}.ipynb": check for check in (four_bar, study, geared_press)}


def test_every_example_is_checked() -> None:
    assert {path.name for path in EXAMPLES.iterdir() if path.suffix in (".py", ".ipynb")} == set(CHECKS)


@pytest.mark.parametrize("name", CHECKS)
def test_example_agrees_with_other_sources(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    path = EXAMPLES / name
    CHECKS[name](runpy.run_path(str(path)) if path.suffix == ".py" else run_notebook(path))
