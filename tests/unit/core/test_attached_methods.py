"""Methods that the package's face attaches: each is declared once, and its code takes what the declaration says."""

import ast
import importlib
import inspect
from collections.abc import Iterator

import pytest
from tests.contract.sources import MODULES, ROOT

import linkwright as lw
from linkwright.core.attached import ATTACHED
from linkwright.core.entry_points import loaded


def declared() -> Iterator[tuple[str, str]]:
    """``Class.method`` and module of everything that is decorated with ``attached``."""
    for module in MODULES:
        text = (ROOT / module).read_text(encoding="utf-8")
        if "@attached" not in text:
            continue
        name = "linkwright." + ".".join(module.with_suffix("").parts)
        for owner in ast.walk(ast.parse(text)):
            for each in owner.body if isinstance(owner, ast.ClassDef) else ():
                marks = getattr(each, "decorator_list", ())
                if any(isinstance(mark, ast.Name) and mark.id == "attached" for mark in marks):
                    yield f"{owner.name}.{each.name}", name  # type: ignore[attr-defined]


DECLARED = sorted(declared())


def test_each_is_attached_and_nothing_else() -> None:
    assert [name for name, _ in DECLARED] == sorted(ATTACHED)


@pytest.mark.parametrize(("name", "module"), DECLARED)
def test_the_code_takes_what_is_declared(name: str, module: str) -> None:
    owner, method = name.split(".")
    code = loaded(ATTACHED[name])
    found = inspect.getattr_static(getattr(importlib.import_module(module), owner), method)
    taken = inspect.signature(getattr(found, "fget", None) or getattr(found, "func", found)).parameters.values()
    own, empty = inspect.signature(code), inspect.Parameter.empty
    assert own.bind(
        *(each.name for each in taken if each.kind is each.POSITIONAL_OR_KEYWORD),
        **{each.name: each.name for each in taken if each.kind is each.KEYWORD_ONLY},
    )
    defaults = [(each.default, own.parameters[each.name].default) for each in taken if each.name in own.parameters]
    assert all(first == second for first, second in defaults if second is not empty)


def test_attached_methods_work() -> None:
    machine = lw.load("gallery:crank_rocker")
    assert machine.structure() == lw.structure(machine)
    assert str(machine._repr_svg_()).startswith("<svg")
