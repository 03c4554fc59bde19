"""Gallery models in all formats, read back: tables have the numbers of the motion, DXF its pins, MuJoCo starts closed
where the motion does, Modelica's equations hold and move as it does.

One model goes into every format; the whole gallery goes into the formats of other programs, and into tables and pages
in turn.
"""

import csv
import io
import json
import math
import re
from collections.abc import Callable, Mapping
from html import unescape
from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.refusals import refused
from tests.share import in_turn

import linkwright as lw
from linkwright import gallery

NAMES = store.names()
ONE = "jaw_crusher_sixbar"
STEPS = 24
Columns = Mapping[str, np.ndarray]


def has_cam(name: str) -> bool:
    """MuJoCo's and Modelica's texts do not carry a cam."""
    return re.search(r"\bkind: cam\b", gallery.content(name).decode()) is not None


CAMS = [name for name in NAMES if has_cam(name)]
CAMLESS = [name for name in NAMES if name not in CAMS]


def result(name: str) -> lw.Motion | lw.Forces:
    """The forces where there are any, as an export of the machine itself has them."""
    machine = store.machine(name)
    loaded = machine.loads or any(link.mass for link in machine.links.values())
    return store.forces(name, STEPS) if loaded else store.motion(name, STEPS)


def exported(model: str, ending: str, folder: Path, **options: object) -> bytes:
    return lw.export(result(model), folder / f"{model}{ending}", **options).read_bytes()


def read_csv(content: bytes) -> Columns:
    rows = list(csv.DictReader(io.StringIO(content.decode("utf-8-sig"))))
    return {name: np.array([float(row[name] or "nan") for row in rows]) for name in rows[0]}


def read_json(content: bytes) -> Columns:
    tables = json.loads(content)["tables"]
    return {
        name: np.array(column["values"], dtype=float) for table in tables.values() for name, column in table.items()
    }


def read_parquet(content: bytes) -> Columns:
    parquet = pytest.importorskip("pyarrow.parquet")
    table = parquet.read_table(io.BytesIO(content))
    return {name: table[name].to_numpy() for name in table.column_names}


TABLES: Mapping[str, Callable[[bytes], Columns]] = {".csv": read_csv, ".json": read_json, ".parquet": read_parquet}


def holds_the_numbers(name: str, ending: str, folder: Path) -> None:
    """Every column of the result, to the last digit."""
    found, columns = TABLES[ending](exported(name, ending, folder)), result(name).columns()
    assert columns and set(columns) <= set(found)
    for heading, values in columns.items():
        np.testing.assert_array_equal(found[heading], np.asarray(values, dtype=float), err_msg=heading)


def holds_the_sheets(name: str, folder: Path) -> None:
    """Columns stand in sheets under headings in words: each one's numbers are those of a column there."""
    pytest.importorskip("xlsxwriter")
    openpyxl = pytest.importorskip("openpyxl")
    book = openpyxl.load_workbook(io.BytesIO(exported(name, ".xlsx", folder)))
    shown = [
        np.array([np.nan if cell.value is None else cell.value for cell in column[1:]], dtype=float)
        for sheet in book
        for column in sheet.iter_cols()
        if all(isinstance(cell.value, int | float | None) for cell in column[1:])
    ]
    for heading, values in every(result(name).columns().items()):
        size = 1e-12 * float(np.abs(np.nan_to_num(values)).max(initial=0.0))
        alike = (
            len(each) == len(values) and np.allclose(each, values, 1e-12, size, equal_nan=True) for each in shown
        )
        assert any(alike), heading


def holds_the_page(name: str, folder: Path) -> None:
    """The page is named for the model, and its data are the larger the more there is."""
    page = exported(name, ".html", folder).decode()
    (title,) = re.findall("<title>(.*?)</title>", page)
    assert unescape(title).startswith(store.machine(name).name)
    (packed,) = re.findall(r'id="packed">([^<]*)<', page)
    assert len(packed) > 1000


def holds_the_pins(name: str, folder: Path) -> None:
    """DXF passes the audit, and has a circle on every pin where the motion has it, mm."""
    ezdxf = pytest.importorskip("ezdxf")
    drawn = ezdxf.readfile(lw.export(result(name), folder / "a.dxf"))
    audit = drawn.audit()
    assert (audit.errors, audit.fixes) == ([], [])
    circles = np.array([tuple(each.dxf.center)[:2] for each in drawn.modelspace().query("CIRCLE")])
    machine = store.machine(name)
    pins = [joint for joint in machine.joints.values() if joint.kind == "revolute"]
    for pin in pins:
        place = 1e3 * pin_place(name, pin.joined[1], pin.name)
        assert np.hypot(*(circles - place).T).min() < 1e-6 * max(1.0, np.abs(circles).max()), pin.name


def pin_place(name: str, link: str, pin: str) -> np.ndarray:
    machine, motion = store.machine(name), store.motion(name, STEPS)
    if pin in machine.frame.points and "frame" in machine.joints[pin].joined:
        return np.array(machine.frame.points[pin])
    return motion.point(f"{link}.{pin}").position[0]


def starts_closed(name: str, folder: Path) -> None:
    """MuJoCo's start: no joint open or drifting, and all points where the motion has them."""
    mujoco = pytest.importorskip("mujoco")
    model = mujoco.MjModel.from_xml_string(exported(name, ".xml", folder).decode())
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    size = max(1.0, float(np.abs(data.site_xpos).max()))
    assert np.abs(data.efc_pos).max(initial=0.0) < 1e-9 * size
    fastest = float(np.abs(data.qvel).max(initial=0.0))
    assert np.abs(data.efc_vel).max(initial=0.0) < 1e-9 * max(1.0, fastest * size)
    sites = {model.site(index).name: data.site_xpos[index, :2] for index in range(model.nsite)}
    moving = {site: place for site, place in sites.items() if not site.startswith("frame.")}
    for site, place in every(moving.items(), least=bool(store.machine(name).links)):
        wanted = store.motion(name, STEPS).point(site).position[0]
        assert place == pytest.approx(wanted, abs=1e-9 * size), site


def equations_hold(name: str, folder: Path) -> None:
    """Those of the places: as many as unknowns, and true at the start."""
    text = exported(name, ".mo", folder, form="positions").decode()
    head, body = text.split("\nequation\n")
    unknowns = re.findall(r"^  Real (\w+)\(", head, re.MULTILINE)
    starts = re.findall(r"^  Real (\w+)\(unit=\"[^\"]*\", start=([^)]*)\)", head, re.MULTILINE)
    parameters = re.findall(r"^  parameter Real (\w+)\([^)]*\) = (\S+)", head, re.MULTILINE)
    equations = re.findall(r"^  (.+) = (.+);$", body, re.MULTILINE)
    machine, motion = store.machine(name), store.motion(name, STEPS)
    free = lw.structure(machine).mobility - len(machine.drivers)
    assert len(equations) == len(unknowns) - free
    values = {key: float(value) for key, value in (*starts, *parameters)}
    values["time"] = float(motion.time[0]) if machine.drivers else 0.0
    algebraic = [each for each in equations if "der(" not in each[1] and "if " not in each[1]]
    for left, right in every(algebraic, least=bool(machine.drivers)):
        a, b = (valued(side, values) for side in (left, right))
        assert math.isclose(a, b, abs_tol=1e-9 * max(1.0, abs(a))), f"{left} = {right}"


FUNCTIONS = {
    "abs": abs,
    "max": max,
    "min": min,
    "sign": lambda x: math.copysign(1.0, x) if x else 0.0,
    **{name: getattr(math, name) for name in ("sin", "cos", "tan", "sqrt", "exp", "log", "floor")},
    **{name: getattr(math, name) for name in ("asin", "acos", "atan", "atan2")},
}


def valued(formula: str, values: Mapping[str, float]) -> float:
    return float(eval(formula.replace("^", "**"), {"__builtins__": {}}, {**FUNCTIONS, **values}))


def moves_alike(name: str, folder: Path) -> None:
    """Integrated by a Modelica tool, all links turn as in the motion."""
    rumoca = pytest.importorskip("rumoca")
    text = exported(name, ".mo", folder, name="Machine").decode()
    begin, end = (float(re.findall(rf"{word}=([^,]+),", text)[0]) for word in ("StartTime", "StopTime"))
    model = rumoca.Session().loads(text, model="Machine")
    config = rumoca.SimConfig(rtol=1e-9, atol=1e-11)
    simulated = model.simulate((begin, end), dt=(end - begin) / 90, config=config)
    machine = store.machine(name)
    motion = lw.solve_motion(machine, times=np.clip(simulated.time, begin, end))
    for link in machine.links:
        assert np.asarray(simulated[f"{link}_phi"]) == pytest.approx(motion.link(link).angle, abs=5e-7), link


CHECKS: Mapping[str, Callable[[str, Path], None]] = {
    **{ending: lambda name, folder, ending=ending: holds_the_numbers(name, ending, folder) for ending in TABLES},
    "xlsx": holds_the_sheets,
    "html": holds_the_page,
    "dxf": holds_the_pins,
    "mjcf": starts_closed,
    "modelica": equations_hold,
    "modelica, moved": moves_alike,
}
#: Tables and pages: every model has some of them, in turn.
IN_TURN = [*TABLES, "xlsx", "html"]


@pytest.mark.parametrize("check", CHECKS)
def test_every_format_holds_the_motion(check: str, tmp_path: Path) -> None:
    CHECKS[check](ONE, tmp_path)


@pytest.mark.rotating
@pytest.mark.parametrize("name", NAMES)
def test_tables_and_pages_hold_every_model(name: str, tmp_path: Path) -> None:
    for check in in_turn(IN_TURN, NAMES.index(name), 2):
        CHECKS[check](name, tmp_path)


@pytest.mark.rotating
@pytest.mark.parametrize("name", NAMES)
def test_dxf_has_the_pins_of_every_model(name: str, tmp_path: Path) -> None:
    holds_the_pins(name, tmp_path)


@pytest.mark.rotating
@pytest.mark.parametrize("name", CAMLESS)
def test_mujoco_starts_closed_at_our_places(name: str, tmp_path: Path) -> None:
    starts_closed(name, tmp_path)


@pytest.mark.rotating
@pytest.mark.parametrize("name", CAMLESS)
def test_modelica_equations_hold_and_are_as_many_as_unknowns(name: str, tmp_path: Path) -> None:
    equations_hold(name, tmp_path)


#: rumoca's own check of the instants between steps stops it where the law of this machine's path begins again.
STOPS_RUMOCA = {"five_bar_robot"}


@pytest.mark.rotating
@pytest.mark.parametrize("name", sorted(set(CAMLESS) - STOPS_RUMOCA))
def test_modelica_moves_as_the_mechanism_does(name: str, tmp_path: Path) -> None:
    moves_alike(name, tmp_path)


@pytest.mark.parametrize("ending", [".xml", ".mo"])
@pytest.mark.parametrize("name", CAMS)
def test_a_cam_is_not_carried_and_that_is_said(name: str, ending: str, tmp_path: Path) -> None:
    with refused("joints.cam_sums"):
        exported(name, ending, tmp_path)
