"""Questions for learning platforms hold the rules of the platforms' descriptions, whatever a machine is called."""

import io
import json
import zipfile
from pathlib import Path

import pytest
from tests.course_mistakes import TASKS
from tests.question_formats import moodle_faults, package_faults, question_faults

import linkwright as lw

LANGUAGES = ("en", "zh")
NAMES = ("Plain", 'R & D <b>"{1:NUMERICAL:=3:0}"</b> ]]> / 四杆 {{params.x}} 🙂')


@pytest.fixture(scope="module", params=[(task, name) for task in TASKS for name in NAMES], ids=str)
def found(request: pytest.FixtureRequest) -> lw.Variants:
    task, name = request.param
    text = TASKS[task].replace("\nname: ", f"\nname: {json.dumps(name, ensure_ascii=False)} # ", 1)
    return lw.variants(lw.loads(text), 2, seed=8)


@pytest.mark.parametrize("language", LANGUAGES)
def test_packages_of_qti_are_sound(found: lw.Variants, language: str) -> None:
    assert package_faults(found.files(["qti"], language)["qti.zip"]) == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_banks_of_moodle_are_sound(found: lw.Variants, language: str) -> None:
    assert moodle_faults(found.files(["moodle"], language)["moodle.xml"]) == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_folders_of_prairielearn_are_sound(found: lw.Variants, language: str, tmp_path: Path) -> None:
    found.save(tmp_path, ["prairielearn"], language)
    (folder,) = (tmp_path / "prairielearn").iterdir()
    given: dict[str, dict] = {"params": {}, "correct_answers": {}}
    space: dict[str, object] = {"__file__": str(folder / "server.py")}
    exec((folder / "server.py").read_text("utf-8"), space)
    space["generate"](given)  # type: ignore[operator]
    files = {each.name: each.read_bytes() for each in folder.iterdir() if each.is_file()}
    assert question_faults(files, set(given["correct_answers"]), set(given["params"])) == []
    assert (folder / "clientFilesQuestion" / given["params"]["picture"]).is_file()


def _changed(package: bytes, name: str, old: str, new: str) -> bytes:
    """A package with one text in one of its files changed."""
    stream = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(package)) as before, zipfile.ZipFile(stream, "w") as after:
        for each in before.namelist():
            text = before.read(each).decode()
            assert each != name or old in text
            after.writestr(each, text.replace(old, new, 1) if each == name else text)
    return stream.getvalue()


@pytest.fixture(scope="module")
def files() -> dict[str, bytes]:
    return lw.variants(lw.loads(TASKS["lever"]), 2, seed=8).files(["qti", "moodle", "prairielearn"])


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "old", "new", "sentence"),
    [
        ("variant-1.xml", ' adaptive="false"', "", "attribute adaptive"),
        ("variant-1.xml", "<itemBody>", "<itemBody>loose", "outside a block"),
        ("variant-1.xml", "<p>", "<span>x</span><p>", "span in the body"),
        ("variant-1.xml", 'responseIdentifier="R0"', 'responseIdentifier="X"', "declared"),
        ("variant-1.xml", 'baseType="float"', 'baseType="pair"', "text entry into a single pair"),
        ("variant-1.xml", 'cardinality="single"', 'cardinality="one"', "cardinality or baseType"),
        ("variant-1.xml", "<correctResponse><value>", "<correctResponse><value>x", "no numbers"),
        ("variant-1.xml", ' tolerance="', ' tolerance="-', "tolerance"),
        ("variant-1.xml", 'toleranceMode="absolute"', 'toleranceMode="about"', "toleranceMode"),
        ("variant-1.xml", '<setOutcomeValue identifier="SCORE">', '<setOutcomeValue identifier="S">', "undeclared"),
        ("variant-1.xml", '<correct identifier="R0"/>', '<correct identifier="R0"/><null/>', "expression"),
        ("variant-1.xml", "<responseProcessing>", '<responseProcessing template="match_correct">', "template"),
        ("variant-1.xml", "images/variant-1.svg", "images/none.svg", "not of the resource"),
        ("variant-1.xml", "<tr><td>", "<tr><p/><td>", "p in tr"),
        ("imsmanifest.xml", "<organizations/>", "", "order of parts"),
        ("imsmanifest.xml", 'href="images/variant-2.svg"', 'href="images/variant-3.svg"', "alone"),
        ("imsmanifest.xml", "<schemaversion>1.0.0", "<schemaversion>3", "schema"),
    ],
)
def test_faults_of_packages_are_found(files: dict[str, bytes], name: str, old: str, new: str, sentence: str) -> None:
    faults = package_faults(_changed(files["qti.zip"], name, old, new))
    assert any(sentence in fault for fault in faults)


@pytest.mark.long
@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("NUMERICAL:=", "NUMERICAL:%50%", "fractions"),
        ("NUMERICAL:=", "NUMERICAL:=x", "embedded answer"),
        ("{1:NUMERICAL", "{1 NUMERICAL", "braces"),
        ('type="cloze"', 'type="essay"', "types"),
        ("<text>$course$/top", "<text>top", "category"),
        ("@@PLUGINFILE@@/variant-1", "@@PLUGINFILE@@/variant-9", "not those shown"),
        ('encoding="base64"', "", "file"),
        ('format="html"', 'format="tex"', "format"),
        ("<penalty>0.1", "<penalty>10", "penalty"),
    ],
)
def test_faults_of_banks_are_found(files: dict[str, bytes], old: str, new: str, sentence: str) -> None:
    text = files["moodle.xml"].decode()
    assert old in text
    assert any(sentence in fault for fault in moodle_faults(text.replace(old, new, 1).encode()))


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "old", "new", "sentence"),
    [
        ("info.json", '"uuid": "', '"uuid": "x', "uuid"),
        ("info.json", '"topic"', '"subject"', "key subject"),
        ("question.html", "</pl-question-panel>", "", "not closed"),
        ("question.html", "answers-name=", "answer=", "pl-number-input with"),
        ("question.html", 'comparison="relabs"', 'comparison="near"', "comparison"),
        ("question.html", "{{params.picture}}", "{{params.drawing}}", "parameter drawing"),
    ],
)
def test_faults_of_folders_are_found(files: dict[str, bytes], name: str, old: str, new: str, sentence: str) -> None:
    folder = {path.rsplit("/", 1)[1]: content for path, content in files.items() if "prairielearn" in path}
    data = json.loads(folder["variants.json"])[0]
    text = folder[name].decode()
    assert old in text
    folder[name] = text.replace(old, new, 1).encode()
    faults = question_faults(folder, set(data["answers"]), {"picture", "rows"})
    assert any(sentence in fault for fault in faults)
