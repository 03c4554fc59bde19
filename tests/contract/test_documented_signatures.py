"""What the documentation calls exists: keyword arguments of its examples and of docstrings; one rule for files."""

import ast
import inspect
import re
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from types import FunctionType
from typing import Any

import pytest
from tests.every import every
from tests.files.documentation import PAGES, blocks, name
from tests.public import PUBLIC
from tests.refusals import refused

import linkwright as lw
from linkwright import parts

SAVES = ("save", "write", "save_profile", "save_dxf", "export")


def signature(called: Callable[..., Any]) -> inspect.Signature | None:
    try:
        return inspect.signature(called)
    except ValueError:
        return None


def public_callables() -> Iterator[tuple[str, str, Callable[..., Any]]]:
    """The name that calls it, its whole name, and what is called: functions, classes, methods."""
    for each, found in PUBLIC.items():
        if not callable(found):
            continue
        yield each, each, found
        for own in dir(found) if inspect.isclass(found) else ():
            method = inspect.getattr_static(found, own)
            if not own.startswith("_") and isinstance(method, FunctionType | classmethod | staticmethod):
                yield own, f"{each}.{own}", getattr(found, own)


CALLABLES = {whole: (called, found) for called, whole, found in public_callables()}
#: Parameters by the name that calls them; None where anything is taken.
PARAMETERS: dict[str, set[str] | None] = {}
for _called, _found in CALLABLES.values():
    _taken = signature(_found)
    _names = None if _taken is None else set(_taken.parameters)
    if _taken is None or any(each.kind is each.VAR_KEYWORD for each in _taken.parameters.values()):
        _names = None
    _known = PARAMETERS.setdefault(_called, set())
    PARAMETERS[_called] = None if _known is None or _names is None else _known | _names


def documented_arguments(doc: str) -> list[str]:
    """Names under ``Args:``."""
    body = re.search(r"\n\s*Args:\n(.*?)(?:\n\s*\n|\Z)", doc, re.DOTALL)
    if body is None:
        return []
    margin = min(len(line) - len(line.lstrip()) for line in body[1].splitlines() if line.strip())
    heads = re.findall(rf"(?m)^ {{{margin}}}(?! )([\w, *]+):", body[1])
    return [each.strip().lstrip("*") for head in heads for each in head.split(",")]


def test_arguments_of_docstrings_exist() -> None:
    told = {whole: set(documented_arguments(inspect.getdoc(found) or "")) for whole, (_, found) in CALLABLES.items()}
    for whole in every((whole for whole, names in told.items() if names), least=20):
        _, found = CALLABLES[whole]
        taken = signature(found)
        if taken is None or any(each.kind is each.VAR_KEYWORD for each in taken.parameters.values()):
            continue
        known = set(taken.parameters) | set(getattr(found, "__dataclass_fields__", ()))
        assert told[whole] <= known, whole


def keywords_of(page: Path) -> Iterator[tuple[str, str]]:
    """Called name and keyword of every call of the page's Python, and of the comment behind it."""
    for body in blocks(page, "python"):
        lines = body.splitlines()
        for node in ast.walk(ast.parse(body)):
            if not isinstance(node, ast.Call):
                continue
            called = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            yield from ((called, each.arg) for each in node.keywords if each.arg)
            if isinstance(node.func, ast.Attribute):
                comment = lines[(node.end_lineno or 1) - 1][node.end_col_offset or 0 :].partition("#")[2]
                yield from ((called, word) for word in re.findall(r"\b([a-z_]+)=\w", comment))


@pytest.mark.parametrize("page", [each for each in PAGES if blocks(each, "python")], ids=name)
def test_keywords_of_the_examples_exist(page: Path) -> None:
    for called, keyword in keywords_of(page):
        known = PARAMETERS.get(called)
        assert known is None or keyword in known, f"{called}({keyword}=…)"


@cache
def written_by() -> dict[str, Callable[..., Any]]:
    """A call that writes, of every kind of result that can: a function of a folder and ``force``."""
    machine = lw.load("gallery:crank_rocker")
    motion = lw.solve_motion(machine, steps=24)
    found = lw.synthesize("slider_crank", stroke=0.1, rod_ratio=3.5)
    cam, pair = parts.load("gallery:cam_lecture").solve(), lw.gear_pair((12, 24), 3e-3)
    document = lw.read_document("gallery:crank_rocker")
    return {
        "Diagram.save": lambda at, **how: lw.plot(motion).save(at / "a.svg", **how),
        "Drawing.save": lambda at, **how: lw.draw(motion).save(at / "a.svg", **how),
        "Animation.save": lambda at, **how: lw.animate(motion, frames=4).save(at / "a.svg", **how),
        "LivingPage.save": lambda at, **how: lw.living_page(machine, steps=24).save(at / "a.html", **how),
        "Report.save": lambda at, **how: lw.report(machine, sections=["structure"]).save(at / "a.typ", **how),
        "Document.save": lambda at, **how: document.save(at / "a.yaml", **how),
        "Synthesis.write": found.write,
        "CamDesign.save_profile": lambda at, **how: cam.save_profile(at / "a.csv", **how),  # type: ignore[attr-defined]
        "GearPair.save_dxf": lambda at, **how: pair.save_dxf(at / "a.dxf", **how),
        "export": lambda at, **how: lw.export(motion, at / "a.csv", **how),
    }


WRITTEN = (
    "Diagram.save",
    "Drawing.save",
    "Animation.save",
    "LivingPage.save",
    "Report.save",
    "Document.save",
    "Synthesis.write",
    "CamDesign.save_profile",
    "GearPair.save_dxf",
    "export",
)


@pytest.mark.parametrize("what", WRITTEN)
def test_a_file_that_is_there_is_replaced_only_with_force(what: str, tmp_path: Path) -> None:
    write = written_by()[what]
    write(tmp_path)
    (first,) = tmp_path.iterdir()
    kept = b"another file"
    first.write_bytes(kept)
    with refused("file.exists", path=first, remedy="force=True"):
        write(tmp_path)
    assert first.read_bytes() == kept
    write(tmp_path, force=True)
    assert first.read_bytes() != kept


def test_everything_that_writes_has_the_rule() -> None:
    taken = {whole: signature(found) for whole, (called, found) in CALLABLES.items() if called in SAVES}
    writing = {
        whole: each.parameters
        for whole, each in taken.items()
        if each is not None and {"path", "folder", "target"} & set(each.parameters)
    }
    assert {whole.rpartition(".")[2] for whole in writing} == set(SAVES)
    for whole, parameters in writing.items():
        force = parameters.get("force")
        assert force is not None and force.kind is force.KEYWORD_ONLY and force.default is False, whole
