"""What studies and comparisons print, cell by cell, against values of a four-bar by the cosine rule."""

from __future__ import annotations

import re

import numpy as np
import pytest
from tests import store
from tests.refusals import refused

import linkwright as lw
from linkwright.words import in_language

NAME = "Crank-rocker four-bar with a coupler point"
CRANK, FRAME = 1.0, 4.0


def swing(coupler: float, rocker: float) -> float:
    """Between the positions in which crank and coupler are in line, deg."""
    ends = [np.arccos((rocker**2 + FRAME**2 - (coupler + s * CRANK) ** 2) / (2 * rocker * FRAME)) for s in (1, -1)]
    return float(np.degrees(ends[0] - ends[1]))


def transmission(coupler: float, rocker: float) -> float:
    """The smaller one of those in which the crank lies along the frame, deg."""
    cosines = [(coupler**2 + rocker**2 - (FRAME + s * CRANK) ** 2) / (2 * coupler * rocker) for s in (1, -1)]
    angles = np.degrees(np.arccos(cosines))
    return float(np.minimum(angles, 180 - angles).min())


def turns(coupler: float, rocker: float) -> bool:
    return coupler + rocker > FRAME + CRANK and abs(coupler - rocker) < FRAME - CRANK


@pytest.fixture(scope="module")
def study() -> lw.Study:
    machine = store.machine("crank_rocker")
    ranges = {"coupler.length": "1200..3600 mm:7", "rocker.length": "2.4, 2.6 m"}
    return lw.study(machine, ranges, metrics=["travel", "transmission_angle", "B.velocity max"], steps=72)


def cells(line: str) -> list[str]:
    return re.split(r"\s{2,}", line.strip())


@pytest.mark.parametrize("rows", [2, 5, 14, 40])
def test_the_table_of_a_study(study: lw.Study, rows: int) -> None:
    """Designs in their order, evenly chosen, the first and the last among them; a dash where one cannot move."""
    text = study.text(rows=rows).split("\n\n")
    lines = text[1].splitlines()
    designs = [(b, c) for b in np.linspace(1.2, 3.6, 7) for c in (2.4, 2.6)]
    shown = {2: [0, 13], 5: [0, 3, 6, 10, 13]}.get(rows, list(range(14)))
    assert re.findall(r"\d+", text[0].removeprefix(NAME)) == ["14", str(sum(turns(*each) for each in designs))]
    assert cells(lines[0])[1:3] == ["coupler.length", "rocker.length"]
    assert [cell.split()[-1] for cell in cells(lines[0])[3:]] == ["[°]", "[°]", "[m/s]"]
    for line, k in zip(lines[1:], shown, strict=False):
        number, coupler, rocker, travel, angle, speed = cells(line)
        b, c = designs[k]
        assert (number, coupler, rocker) == (str(k), f"{1000 * b:g} mm", f"{c} m")
        if turns(b, c):
            assert float(travel) == pytest.approx(swing(b, c), rel=2e-5)
            assert float(angle) == pytest.approx(transmission(b, c), rel=2e-5)
            assert float(speed) == pytest.approx(study["B.velocity max"][k], rel=1e-4)
        else:
            assert (travel, angle, speed) == ("—", "—", "—")
    assert len({len(line) for line in lines[: len(shown) + 1]}) == 1
    assert len(lines) == len(shown) + 1
    assert (re.findall(r"\d+", text[2]) == [str(rows), "14"]) == (rows < 14)


def test_the_best_designs_and_what_failed(study: lw.Study) -> None:
    best, failed = study.text().split("\n\n")[2:]
    designs = [(b, c) for b in np.linspace(1.2, 3.6, 7) for c in (2.4, 2.6)]
    angles = [transmission(*each) if turns(*each) else 0.0 for each in designs]
    k = int(np.argmax(angles))
    _, line = best.splitlines()
    assert f": {angles[k]:.5g}° " in line
    assert f"coupler.length = {1000 * designs[k][0]:g} mm, rocker.length = {designs[k][1]} m" in line
    _, reach, singular = failed.splitlines()
    assert reach.startswith("7 ") and singular.startswith("1 ")
    assert all("(coupler, rocker)" in line for line in (reach, singular))
    _, reach, singular = study.text("zh").split("\n\n")[3].splitlines()
    assert reach.startswith("7 ") and singular.startswith("1 ")
    assert all("（coupler、rocker）" in line for line in (reach, singular))
    assert study.best("transmission_angle") == k == study.data()["best"]["transmission_angle"]
    found = [(each["kind"], each["count"], each["designs"]) for each in study.data()["failures"]]
    assert found == [("unreachable", 7, [0, 1, 2, 3, 4, 5, 6]), ("singular", 1, [7])]


def test_studies_and_sweeps_as_tables_of_notebooks(study: lw.Study) -> None:
    pytest.importorskip("pandas")
    frame = study.to_dataframe()
    assert list(frame.columns) == [
        "coupler.length",
        "rocker.length",
        "travel [rad]",
        "transmission_angle [rad]",
        "B.velocity max [m/s]",
    ]
    assert frame["coupler.length"].to_numpy() == pytest.approx(np.repeat(np.linspace(1.2, 3.6, 7), 2))
    heads, *lines = study.csv().splitlines()
    assert heads == ",".join(frame.columns) and len(lines) == 14
    assert lines[0] == "1.2,2.4,,," and float(lines[-1].split(",")[2]) == study["travel"][-1]
    assert repr(study).startswith(f"Study('{NAME}': 14 ") and "coupler.length" in repr(study)
    machine = study.mechanism
    columns = {"coupler.length": [1.2, 3.4, 3.6]}
    whole, part = (
        lw.sweep(machine, columns, outputs=["B.velocity max", "rocker.angle argmax"], steps=24, partial=partial)
        for partial in (False, True)
    )
    assert whole.assembled.tolist() == [9, 24, 24] and whole.ok.tolist() == [False, True, True]
    assert np.isnan(whole["B.velocity max"]).tolist() == [True, False, False]
    assert np.isfinite(part["B.velocity max"]).all()
    assert part["B.velocity max"][1:].tolist() == whole["B.velocity max"][1:].tolist()
    speed, place = whole.summaries
    assert (whole.dimension(speed), whole.dimension(place)) == ("velocity", "angle")
    table = whole.to_dataframe()
    assert list(table.columns) == ["coupler.length", "assembled", "B.velocity max", "rocker.angle argmax"]
    assert re.search(r"\b3\b.*\b2\b", repr(whole)) and whole._repr_html_().count("<tr>") == 4
    with refused("study.not_asked", summary="B.velocity"):
        whole["B.velocity"]


def fourbar(name: str, coupler: float) -> lw.Mechanism:
    text = store.text("crank_rocker").replace(NAME, name)
    return lw.loads(text).with_dimensions({"coupler.length": coupler})


def test_a_number_of_outputs_is_that_of_the_shared_one_unless_another_is_asked_for() -> None:
    """The coupler's point is faster than the rocker turns, but the rocker is what is compared."""
    machines = [fourbar("a", 3.0), fourbar("b", 3.4)]
    names = ["peak_acceleration", "peak_acceleration rocker", "peak_acceleration coupler.P"]
    found = lw.compare(machines, metrics=names, output="rocker", steps=72)
    for k, machine in enumerate(machines):
        alone = lw.metrics(lw.solve_motion(machine, steps=72), "peak_acceleration")
        values = [alone.value("peak_acceleration", subject) for subject in ("rocker", "rocker", "coupler.P")]
        assert [found.value(name, k) for name in names] == pytest.approx(values)
        assert values[2] > values[1]


def test_the_table_of_a_comparison_marks_the_best_and_says_what_decided() -> None:
    """Three four-bars by two numbers, one of them with three times the weight."""
    lengths = {"short": 2.9, "middle": 3.2, "long": 3.6}
    machines = [fourbar(name, coupler) for name, coupler in lengths.items()]
    names = ["transmission_angle", "travel", "peak_acceleration rocker"]
    found = lw.compare(machines, metrics=names, weights={"transmission_angle": 3.0}, steps=90)
    angles = [transmission(b, 2.5) for b in lengths.values()]
    turned = [swing(b, 2.5) for b in lengths.values()]
    peaks = [found.value("peak_acceleration rocker", k) for k in range(3)]
    head, first, second, third = (cells(line) for line in found.text().split("\n\n")[0].splitlines()[:4])
    assert head[1:] == list(lengths)
    for row, values, better in ((first, angles, max), (second, turned, None), (third, peaks, min)):
        marks = [cell.endswith(" *") for cell in row[1:]]
        assert marks == [better is not None and each == better(values) for each in values]
        if values is not peaks:
            printed = [float(cell.removesuffix(" *").removesuffix("°")) for cell in row[1:]]
            assert printed == pytest.approx(values, rel=2e-5)
    scores = [(3 * a / max(angles) + min(peaks) / p) / 4 for a, p in zip(angles, peaks, strict=True)]
    order = sorted(range(3), key=lambda k: -scores[k])
    assert [rank.index for rank in found.ranking] == order
    assert [rank.place for rank in found.ranking] == [1, 2, 3]
    assert [rank.score for rank in found.ranking] == pytest.approx([scores[k] for k in order])
    ranked = "\n\n".join(found.text().split("\n\n")[1:])
    for place, k in enumerate(order, 1):
        label = list(lengths)[k]
        assert re.search(rf"{place}\W+{label}\b.*\b{100 * scores[k]:.0f}\b", ranked), (place, label)
    verdict = found.evaluation().splitlines()[-3:]
    assert list(lengths)[order[0]] in verdict[0] and f"{100 * scores[order[0]]:.0f}" in verdict[0]
    assert [list(lengths)[k] in line for k, line in zip(order[1:], verdict[1:], strict=True)] == [True, True]
    assert list(found.columns()["middle"]) == [found.value(name, 1) for name in names]
    assert list(lengths)[order[0]] in repr(found)
    frame = found.to_dataframe()
    assert list(frame.columns) == list(lengths)
    assert list(frame.index) == ["transmission_angle [rad]", "travel [rad]", "peak_acceleration rocker [rad/s²]"]
    data = found.data()
    assert [each["weight"] for each in data["metrics"]] == [3.0, 1.0, 1.0]
    assert data["metrics"][0]["best"] == [list(lengths)[int(np.argmax(angles))]]
    assert [each["label"] for each in data["ranking"]] == [list(lengths)[k] for k in order]


def test_a_table_of_one_row_and_notes_in_the_readers_language(study: lw.Study) -> None:
    _, first, left_out, *_ = study.text(rows=1).split("\n\n")
    assert [cells(line)[0] for line in first.splitlines()[1:]] == ["0"]
    assert re.findall(r"\d+", left_out) == ["1", "14"]
    idle = lw.study(
        store.machine("jaw_crusher_fourbar"), {"loads.crushing.ramp.1": [80e3, 0.0]}, metrics=["flywheel"], steps=72
    )
    assert np.isfinite(idle["flywheel"]).tolist() == [True, False]
    name = idle.mechanism.name
    (note,) = idle.notes
    assert idle.text().splitlines()[-1] == f"{note}" and note.startswith(f"{name}: ")
    chinese = idle.text("zh").splitlines()[-1]
    assert chinese.startswith(f"{in_language(name, 'zh')}：") and not re.search("[a-z]{3}", chinese)


def test_designs_barred_between_two_positions_are_said_to_be() -> None:
    """Below a rocker of 0.7 m a gap opens where A comes to 0.2 m of O2; five steps go past it."""
    machine = lw.load("tests/reference/faults/gap_between_samples.yaml")
    found = lw.study(machine, {"rocker.length": [0.69, 0.72, 0.695]}, metrics=["B.velocity max"], steps=5)
    assert found.ok.tolist() == [False, True, False]
    (failure,) = found.failures
    assert (failure.kind, failure.group, failure.designs.tolist()) == ("barred", None, [0, 2])
    for language in ("en", "zh"):
        assert re.search(r"\n2 .*\(coupler, rocker\)|\n2 .*（coupler、rocker）", found.text(language))
    with refused("study.none_passes", count=2) as none:
        lw.study(machine, {"rocker.length": [0.69, 0.695]}, metrics=["B.velocity max"], steps=5)
    assert len(none.value.values["causes"]) == 1


def test_what_is_made_once_says_in_short_what_it_is() -> None:
    """In a notebook a result stands in one line; the crank is half the stroke, the rod four cranks."""
    found = lw.synthesize("slider_crank", stroke=0.4, rod_ratio=4.0, offset_ratio=0.0)
    assert all(told in repr(found.best) for told in ("slider_crank", "crank 0.2", "rod 0.8"))
    assert "slider_crank" in repr(found) and repr(found.best) in repr(found)
    prepared = repr(lw.prepare(found.best.mechanism("press"), vary=["rod.length"], steps=36))
    assert all(told in prepared for told in ("'press'", "rod.length", "36"))
    assert "'kite.yaml'" in repr(lw.read_document("gallery:kite"))
