"""Gallery models in all formats: DXF passes the audit, MuJoCo starts closed, Modelica's equations hold.

Every model goes into the formats of other programs, and into tables and pages in turn.
"""

import math
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from tests.gallery_turns import in_turn

import linkwright as lw
from linkwright.core.expressions import parse
from linkwright.errors import LinkwrightError
from linkwright.export.base import FORMATS
from linkwright.export.results import Results

NAMES = lw.gallery_names()
#: Pictures of every model are made in test_drawing_gallery.
PICTURES = ("png", "pdf", "svg")
#: Tables and pages: every model has some of them, in turn; DXF, MuJoCo and Modelica are read back below.
IN_TURN = [name for name in FORMATS if name not in (*PICTURES, "dxf", "mjcf", "modelica")]
NEEDS = {"xlsx": "xlsxwriter", "parquet": "pyarrow", "dxf": "ezdxf", "png": "resvg_py", "pdf": "typst"}


@pytest.fixture(scope="module", params=NAMES)
def results(request: pytest.FixtureRequest) -> Results:
    return Results.of(lw.load(f"gallery:{request.param}"), 24)


@pytest.fixture(scope="module")
def content(results: Results) -> Callable[[str], bytes]:
    """What a format holds, made once for all tests of a model."""
    return cache(lambda form: FORMATS[form].content(results))


def has_cams(results: Results) -> bool:
    """Whether the model has a joint that MuJoCo's and Modelica's texts do not carry."""
    return any(joint.kind == "cam" for joint in results.mechanism.joints.values())


def test_every_model_has_content_in_tables_and_pages(
    results: Results, content: Callable[[str], bytes], request: pytest.FixtureRequest
) -> None:
    turn = NAMES.index(request.node.callspec.params["results"])
    for form in in_turn(IN_TURN, turn, 2):
        if form in NEEDS:
            pytest.importorskip(NEEDS[form])
        assert len(content(form)) > 500, form


@pytest.mark.parametrize("form", ["mjcf", "modelica"])
def test_programs_of_other_makers_get_every_model_without_cams(
    results: Results, content: Callable[[str], bytes], form: str
) -> None:
    if has_cams(results):
        with pytest.raises(LinkwrightError, match="lift of a cam is no sum"):
            content(form)
        return
    assert len(content(form)) > 500


def test_dxf_passes_the_audit(content: Callable[[str], bytes], tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    path = tmp_path / "a.dxf"
    path.write_bytes(content("dxf"))
    audit = ezdxf.readfile(path).audit()
    assert (audit.errors, audit.fixes) == ([], [])


def test_mujoco_starts_closed_at_our_places(results: Results, content: Callable[[str], bytes]) -> None:
    if has_cams(results):
        pytest.skip("a cam is not carried, and said so")
    mujoco = pytest.importorskip("mujoco")
    model = mujoco.MjModel.from_xml_string(content("mjcf").decode())
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    size = max(1.0, float(np.abs(data.site_xpos).max()))
    assert np.abs(data.efc_pos).max(initial=0.0) < 1e-9 * size
    assert np.abs(data.efc_vel).max(initial=0.0) < 1e-9 * max(
        1.0, float(np.abs(data.qvel).max(initial=0.0)) * size
    )
    for index in range(model.nsite):
        name = model.site(index).name
        if not name.startswith("frame."):
            place = results.motion.point(name).position[0]
            assert data.site_xpos[index, :2] == pytest.approx(place, abs=1e-9 * size)


def test_modelica_equations_hold_and_are_as_many_as_unknowns(results: Results) -> None:
    if has_cams(results):
        pytest.skip("a cam is not carried, and said so")
    text = FORMATS["modelica"].content(results, form="positions").decode()
    head, body = text.split("\nequation\n")
    unknowns = re.findall(r"^  Real (\w+)\(", head, re.MULTILINE)
    starts = re.findall(r"^  Real (\w+)\(unit=\"[^\"]*\", start=([^)]*)\)", head, re.MULTILINE)
    parameters = re.findall(r"^  parameter Real (\w+)\([^)]*\) = (\S+)", head, re.MULTILINE)
    equations = re.findall(r"^  (.+) = (.+);$", body, re.MULTILINE)
    free = results.structure.mobility - len(results.mechanism.drivers)
    assert len(equations) == len(unknowns) - free
    values = {name: float(value) for name, value in (*starts, *parameters)}
    values["time"] = float(results.motion.time[0])
    for left, right in equations:
        if "der(" not in right and "if " not in right:
            a, b = (parse(side, list(values)).evaluate(values) for side in (left, right))
            assert math.isclose(a, b, abs_tol=1e-9 * max(1.0, abs(a))), f"{left} = {right}"


def test_modelica_moves_as_the_mechanism_does(results: Results) -> None:
    if has_cams(results):
        pytest.skip("a cam is not carried, and said so")
    rumoca = pytest.importorskip("rumoca")
    text = FORMATS["modelica"].content(results, name="Machine").decode()
    begin, end = (float(re.findall(rf"{word}=([^,]+),", text)[0]) for word in ("StartTime", "StopTime"))
    model = rumoca.Session().loads(text, model="Machine")
    config = rumoca.SimConfig(rtol=1e-9, atol=1e-11)
    result = model.simulate((begin, end), dt=(end - begin) / 90, config=config)
    motion = lw.solve_motion(results.mechanism, times=np.clip(result.time, begin, end))
    for name in results.mechanism.links:
        assert np.asarray(result[f"{name}_phi"]) == pytest.approx(motion.link(name).angle, abs=5e-7)
