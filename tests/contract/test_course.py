"""Course mode: variants that hold what is promised, keys, questions of learning platforms, grading."""

import io
import json
import math
import random
import zipfile
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import pytest
from tests.course_mistakes import TASKS, outcome, sheet
from tests.course_sheets import FOUR_BAR, Pen
from tests.every import every
from tests.refusals import refused

import linkwright as lw
from linkwright.cli import main

QTI = "{http://www.imsglobal.org/xsd/imsqti_v2p1}"


@pytest.fixture(scope="module")
def found() -> lw.Variants:
    return lw.variants(lw.loads(FOUR_BAR), 4, seed=3)


@pytest.fixture(scope="module")
def keys(found: lw.Variants) -> dict[str, dict]:
    return {"four_bar": found.key(), "lever": lw.variants(lw.loads(TASKS["lever"]), 4, seed=3).key()}


@pytest.mark.parametrize("name", sorted(TASKS))
def test_right_answers_are_those_of_an_arithmetic_of_its_own(name: str, keys: dict[str, dict]) -> None:
    key = keys[name]
    for variant in every(key["variants"]):
        own = sheet(name, variant, Pen())
        assert variant["answers"] == pytest.approx([own[q["name"]] for q in key["questions"]], rel=1e-9)


def test_sixty_sheets_with_mistakes_of_their_own_arithmetic(keys: dict[str, dict]) -> None:
    rng = random.Random(2)
    for _ in range(60):
        name = rng.choice(sorted(TASKS))
        slip, named = outcome(keys[name], name, rng)
        assert named == slip


def test_variants_are_sound_and_as_hard_as_the_model(found: lw.Variants) -> None:
    model = lw.metrics(lw.solve_motion(found.task.mechanism, steps=90), ["transmission_angle"])
    least = min(row.value for row in model)
    shown = {frozenset(m["mistake"] for m in v["mistakes"]) for v in found.key()["variants"]}
    assert len(shown) == 1
    for each in found.variants:
        motion = lw.solve_motion(each.mechanism, steps=90)
        assert motion.ok.all()
        table = lw.metrics(motion, ["transmission_angle"])
        assert min(row.value for row in table) >= min(least, math.radians(40)) - math.radians(5)
        for name, (low, high) in every(found.task.ranges.items()):
            assert low * 0.995 <= each.dimensions[name] <= high * 1.005
    assert len({tuple(each.dimensions.values()) for each in found.variants}) == 4


def test_the_same_seed_gives_the_same_variants(found: lw.Variants) -> None:
    again = lw.variants(lw.loads(FOUR_BAR), 4, seed=3)
    assert again.key() == found.key()
    assert lw.variants(lw.loads(FOUR_BAR), 1, seed=4).key()["variants"] != found.key()["variants"][:1]


def test_questions_of_the_platforms(found: lw.Variants) -> None:
    pytest.importorskip("typst")
    files = found.files()
    assert files["sheets.pdf"].startswith(b"%PDF")
    folder = next(name for name in files if name.endswith("info.json")).removesuffix("info.json")
    info = json.loads(files[f"{folder}info.json"])
    assert set(info) >= {"uuid", "type", "title", "topic"} and info["type"] == "v3"
    page = files[f"{folder}question.html"].decode()
    given: dict[str, dict] = {"params": {}, "correct_answers": {}}
    space: dict[str, object] = {"__file__": "server.py"}
    program = (
        files[f"{folder}server.py"].decode().replace("json.loads((Path(__file__).parent", "(lambda t: t)((VARIANTS")
    )
    space["VARIANTS"] = _Beside(json.loads(files[f"{folder}variants.json"]))
    exec(program, space)
    space["generate"](given)  # type: ignore[operator]
    assert all(f'answers-name="{name}"' in page for name in every(given["correct_answers"]))
    bank = ElementTree.fromstring(files["moodle.xml"])
    assert [q.get("type") for q in bank] == ["category", *["cloze"] * 4]
    package = zipfile.ZipFile(io.BytesIO(files["qti.zip"]))
    item = ElementTree.fromstring(package.read("variant-1.xml"))
    declared = {e.get("identifier") for e in item.iter(f"{QTI}responseDeclaration")}
    asked = {e.get("responseIdentifier") for e in item.iter(f"{QTI}textEntryInteraction")}
    assert declared == asked and len(asked) == len(found.task.questions)
    right = [float(e.text or "") for e in item.iterfind(f"{QTI}responseDeclaration/{QTI}correctResponse/{QTI}value")]
    assert right == pytest.approx(found.variants[0].answers, rel=1e-7)


class _Beside:
    """A folder of one file whose text is data already."""

    def __init__(self, data: object) -> None:
        self.data = data

    def __truediv__(self, _: str) -> "_Beside":
        return self

    def read_text(self, _: str) -> object:
        return self.data


@pytest.mark.parametrize(("separator", "encoding"), [(",", "utf-8-sig"), (";", "utf-8"), ("\t", "utf-8")])
def test_sheets_saved_by_spreadsheets_are_read(
    found: lw.Variants, tmp_path: Path, separator: str, encoding: str
) -> None:
    key = found.key()
    comma = separator != ","
    rows = [["student", "variant", *(q["name"] for q in key["questions"]), "remark"]]
    for each in key["variants"]:
        answers = [f"{a:.6g}".replace(".", "," if comma else ".") for a in each["answers"]]
        rows.append([f"学生 {each['number']}", str(each["number"]), *answers])
    path = tmp_path / "answers.csv"
    path.write_text("\r\n".join(separator.join(row) for row in rows), encoding=encoding)
    grades = lw.grade(key, path)
    assert [each.score for each in grades] == [1.0] * len(key["variants"])
    assert grades[0].student == "学生 1"


def test_rows_that_cannot_be_graded_are_told_and_the_others_graded(found: lw.Variants) -> None:
    key = found.key()
    names = [q["name"] for q in key["questions"]]
    good = {"variant": "1", **dict.fromkeys(names, "1")}
    bad = [{**good, "variant": "99"}, good, {**good, names[0]: "twelve"}, {**good, names[1]: "1.234,5"}]
    grades = lw.grade(key, bad)
    told = [(each.fault.code, each.fault.values["line"], each.fault.values["text"]) for each in grades if each.fault]
    assert told == [
        ("course.no_variant", 2, "99"),
        ("course.no_answer", 4, "twelve"),
        ("course.no_answer", 5, "1.234,5"),
    ]
    assert [math.isnan(each.score) for each in grades] == [True, False, True, True]


def test_open_answers_commas_and_right_angles_over_full_turns(found: lw.Variants) -> None:
    key = found.key()
    names = [q["name"] for q in key["questions"]]
    right = dict(zip(names, map(str, key["variants"][1]["answers"]), strict=True))
    angle = names[0]
    turned = {**right, angle: str(float(right[angle]) + 360).replace(".", ","), names[-1]: ""}
    (grade,) = lw.grade(key, [{"student": "A", "variant": "2", **turned}])
    assert grade.right == (*[True] * (len(names) - 1), None) and not grade.mistakes


def test_sheets_that_cannot_be_graded(found: lw.Variants) -> None:
    key = found.key()
    with refused("course.no_column", name=key["questions"][0]["name"]):
        lw.grade(key, [{"variant": "1"}])


@pytest.mark.parametrize(
    ("course", "key", "code", "values"),
    [
        ({"varry": {}}, "varry", "unknown-key", {"key_": "varry", "offer": "vary"}),
        (
            {"vary": {"crank.lenght": "8 %"}},
            "vary.crank.lenght",
            "model.no_dimension",
            {"address": "crank.lenght", "offer": "crank.length"},
        ),
        ({"vary": {"crank.length": "much"}}, "vary.crank.length", "bad-range", {"text": "much"}),
        ({"ask": ["rocker.angel"]}, "ask.0", "no-number", {"name": "rocker.angel", "offer": "rocker.angle"}),
        ({"tolerance": "3"}, "tolerance", "bad-tolerance", {"text": "3"}),
    ],
)
def test_tasks_that_make_no_sense(course: dict, key: str, code: str, values: dict[str, object]) -> None:
    with refused(code, lw.ModelError, **values) as caught:
        lw.variants(replace(lw.loads(FOUR_BAR), course=course), 1)
    assert [each.key for each in caught.value.findings] == [f"course.{key}"]


def test_a_task_without_a_variant_that_turns() -> None:
    course = {"vary": {"crank.length": ["0.5 m", "0.6 m"]}}
    with refused("course.too_few", found=0, count=1, tried=60, times=60, vary=("crank.length",)):
        lw.variants(replace(lw.loads(FOUR_BAR), course=course), 1)


def test_the_commands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(tmp_path)
    Path("bar.yaml").write_text(FOUR_BAR, encoding="utf-8")
    assert main(["variants", "bar.yaml", "--count", "2", "--to", "key", "moodle"]) == 0
    assert main(["variants", "bar.yaml", "--count", "2"]) == 2  # the folder is there
    key = json.loads(Path("bar-variants/key.json").read_text("utf-8"))
    names = [q["name"] for q in key["questions"]]
    wrong = next(m for m in key["variants"][0]["mistakes"] if m["mistake"] == "rpm_for_radians")
    rows = [
        ["student", "variant", *names],
        ["Li", "1", *map(str, wrong["answers"])],
        ["Wu", "2", *map(str, key["variants"][1]["answers"])],
    ]
    Path("answers.csv").write_text("\n".join(",".join(row) for row in rows), encoding="utf-8")
    capsys.readouterr()
    for language in ("en", "zh"):
        assert main(["grade", "bar-variants/key.json", "answers.csv", "--lang", language]) == 0
        li, wu = (line for line in capsys.readouterr().out.splitlines() if line.startswith(("Li", "Wu")))
        assert "(q')" in li and "100 %" in wu
    assert main(["grade", "bar-variants/key.json", "answers.csv", "--json"]) == 0
    li, wu = json.loads(capsys.readouterr().out)["sheets"]
    assert (li["mistakes"], all(wu["right"])) == (["rpm_for_radians"], True)
    assert main(["grade", "answers.csv", "answers.csv"]) == 2
    assert all(path.stat().st_size for path in every(Path("bar-variants").iterdir(), least=2))


def test_variants_are_equally_hard_by_a_measure_that_is_said() -> None:
    """No transmission angle far below the model's, no answer of another order of size than in another variant."""
    made = lw.variants("gallery:jaw_crusher_fourbar", 3, seed=7)
    hard = made.difficulty
    assert hard.transmission_angle is not None
    for each in every(made.variants):
        own = [
            row.value
            for row in lw.metrics(lw.solve_motion(each.mechanism, steps=90))
            if row.metric == "transmission_angle"
        ]
        assert hard.transmission_angle[0] - 1e-9 <= min(own) <= hard.transmission_angle[1] + 1e-9
    assert 1.0 <= hard.ratio < 16.0
