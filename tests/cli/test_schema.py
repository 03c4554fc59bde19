"""The schema command: models, tasks and calculations, with an identity; it knows the whole gallery's keys."""

import copy
import json
import re
from pathlib import Path
from typing import Any

import pytest
import yaml
from tests.cli.commands import is_refused, shown
from tests.every import every

import linkwright as lw
from linkwright import gallery
from linkwright.cli import main


class Loader(yaml.SafeLoader):
    """YAML 1.2, as editors read it: on, off, yes and no are texts."""


Loader.yaml_implicit_resolvers = {
    first: [(tag, word) for tag, word in found if first in "tTfF" or not tag.endswith(":bool")]
    for first, found in yaml.SafeLoader.yaml_implicit_resolvers.items()
}


@pytest.fixture(scope="module")
def printed() -> dict[str, Any]:
    return dict(json.loads(shown("schema")))


def test_the_schema_is_printed_and_written(printed: dict[str, Any], tmp_path: Path) -> None:
    model = json.loads(json.dumps(lw.json_schema()))
    assert printed["else"]["else"]["properties"] == model["properties"]
    assert printed["$id"] == "urn:linkwright:file:1"
    assert printed["$schema"].endswith("2020-12/schema")
    path = tmp_path / "linkwright.schema.json"
    assert main(["schema", "--output", str(path)]) == 0
    assert json.loads(path.read_text(encoding="utf-8")) == printed
    is_refused(["schema", "--output", str(path)], "file.exists", path=path, remedy="--force")
    assert main(["schema", "--output", str(path), "--force"]) == 0


def test_parts_of_strokes_are_in_the_schema() -> None:
    phases = [
        form
        for load in lw.json_schema()["properties"]["loads"]["additionalProperties"]["oneOf"]
        if "phase" in load["properties"]
        for form in load["properties"]["phase"]["oneOf"]
    ]
    swings = [form["properties"] for form in phases if "of" in form["properties"]]
    assert all({"first", "last", "free"} <= set(form) for form in every(swings))


def faults(value: Any, shape: dict[str, Any], place: str = "") -> list[str]:
    """What a schema says against a value; only the words of JSON Schema that are used here."""
    found = [f"{place}: {key}" for key in shape.get("required", ()) if isinstance(value, dict) and key not in value]
    if "const" in shape and value != shape["const"]:
        found.append(f"{place}: not {shape['const']}")
    if "enum" in shape and value not in shape["enum"]:
        found.append(f"{place}: none of {shape['enum']}")
    for each in shape.get("allOf", ()):
        found += faults(value, each, place)
    if "if" in shape:
        holds = not faults(value, shape["if"], place)
        found += faults(value, shape.get("then" if holds else "else", {}), place)
    if "not" in shape and not faults(value, shape["not"], place):
        found.append(f"{place}: not wanted")
    for word in ("oneOf", "anyOf"):
        if word in shape and all(faults(value, each, place) for each in shape[word]):
            found.append(f"{place}: fits no form")
    kinds = {"object": dict, "array": list, "string": str, "number": (int, float), "integer": int, "boolean": bool}
    wanted = shape.get("type", [])
    wanted = [wanted] if isinstance(wanted, str) else wanted
    if any(each in kinds for each in wanted) and not any(
        isinstance(value, kinds[each]) for each in wanted if each in kinds
    ):
        found.append(f"{place}: no {wanted}")
    if isinstance(value, dict):
        known, names = shape.get("properties", {}), shape.get("propertyNames", {})
        found += [each for key in value for each in faults(key, {"enum": names.get("enum", [key])}, place)]
        more = shape.get("additionalProperties", True)
        for key, each in value.items():
            if key in known:
                found += faults(each, known[key], f"{place}.{key}")
            elif more is False:
                found.append(f"{place}: unknown {key}")
            elif isinstance(more, dict):
                found += faults(each, more, f"{place}.{key}")
    if isinstance(value, list) and isinstance(shape.get("items"), dict):
        for number, each in enumerate(value):
            found += faults(each, shape["items"], f"{place}.{number}")
    return found


@pytest.mark.parametrize("name", gallery.calculations())
def test_the_schema_fits_every_calculation_of_the_gallery_and_no_misspelt_one(
    name: str, printed: dict[str, Any]
) -> None:
    content, shape = yaml.load(gallery.content(name), Loader), printed
    assert faults(content, shape) == []
    key = next(key for key in content if key not in ("format", "kind", "parameters"))
    assert faults({**content, f"{key}x": content[key]}, shape) != []
    assert faults({**content, "kind": "bem"}, shape) != []


def shown_files() -> list[str]:
    """Every machine and task of the gallery, and every whole file that the documentation prints."""
    pages = sorted((Path(__file__).parents[2] / "docs").glob("*/**/*.md"))
    blocks = [each for page in pages for each in re.findall(r"```yaml\n(.*?)```", page.read_text("utf-8"), re.S)]
    held = [gallery.content(name).decode() for name in (*gallery.names(), *gallery.tasks())]
    return [*held, *(each for each in blocks if each.startswith("format: 1\n"))]


def test_the_schema_fits_every_file_that_is_shown(printed: dict[str, Any]) -> None:
    for text in every(shown_files(), least=90):
        assert faults(yaml.load(text, Loader), printed) == [], text[:200]


#: Sections with a value that is right, and where a key in it is misspelt.
SECTIONS: list[tuple[str, dict[str, Any], tuple[str, ...]]] = [
    ("course", {"at": "60 deg", "vary": {"a.length": ["1 m", "2 m"], "b.length": "8 %"}, "ask": ["b"]}, ()),
    ("optimize", {"vary": {"a.length": "1..2 m"}, "minimize": ["x", "y"], "keep": {"x": "at most 3 m"}}, ()),
    ("optimize", {"vary": {"a.length": {"values": ["1 m", "2 m"]}}}, ("vary", "a.length")),
    ("optimize", {"keep": {"x": {"at_least": "3 m"}}}, ("keep", "x")),
    ("optimize", {"define": {"p": {"point": "b.P", "target": [["1 m", "2 m"]]}, "T": "x"}}, ("define", "p")),
    ("report", {"title": "x", "positions": ["0 deg", "limits"], "fluctuation": 0.03}, ()),
    ("report", {"positions": {"from": "0 deg", "step": "15 deg", "count": 3}}, ("positions",)),
    ("report", {"cover": {"school": "x"}}, ("cover",)),
    ("report", {"zh": {"title": "x"}}, ("zh",)),
    ("sheet", {"size": "A2", "panels": {"mechanism": {"scale": 2}}}, ("panels", "mechanism")),
    ("synthesis", {"task": "toggle", "force_ratio": 30, "distance": "250 mm", "stroke": "140 mm"}, ()),
]


@pytest.mark.parametrize(("section", "value", "place"), SECTIONS)
def test_the_schema_knows_the_keys_of_every_section(
    section: str, value: dict[str, Any], place: tuple[str, ...]
) -> None:
    shape = json.loads(json.dumps(lw.json_schema()))["properties"][section]
    assert faults(value, shape) == []
    wrong = copy.deepcopy(value)
    inner = wrong
    for key in place:
        inner = inner[key]
    inner["nokey"] = 1
    assert faults(wrong, shape) != []


def test_a_file_with_a_task_alone_is_known(printed: dict[str, Any]) -> None:
    shape = printed
    demands = {"task": "toggle", "force_ratio": 30, "distance": "250 mm", "stroke": "140 mm"}
    task = {"format": 1, "synthesis": demands}
    assert faults(task, shape) == [] and faults({**task, "sythesis": {}}, shape) != []
    assert faults({"format": 1, "synthesis": {"task": "toggle"}}, shape) != []
    assert faults({"format": 1}, shape) != []


def test_a_name_is_a_text_or_one_in_each_language() -> None:
    shape = json.loads(json.dumps(lw.json_schema()))["properties"]["name"]
    assert faults("Press", shape) == faults({"en": "Press", "zh": "压力机"}, shape) == []
    assert faults({"fr": "Presse"}, shape) != [] and faults(["Press"], shape) != []
