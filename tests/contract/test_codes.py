"""Every finding and every error has a code that says what is the matter, and the documentation names it."""

import ast
import importlib.util
import re
from pathlib import Path

import pytest
from tests.every import every
from tests.words import provoking

import linkwright as lw

ROOT = Path(lw.__file__).parent
DOCS = Path(__file__).resolve().parents[2] / "docs"
specification = importlib.util.spec_from_file_location("codes", DOCS / "codes.py")
assert specification is not None and specification.loader is not None
codes = importlib.util.module_from_spec(specification)
specification.loader.exec_module(codes)

#: Names of sections, which say where and not what.
SECTIONS = {"", "report", "course", "optimize", "synthesis", "motion"}
#: What makes a text of one language of a sentence.
SAID = {"translate", "str", "format", "speaker", "join"}


def named(node: ast.AST) -> str:
    return getattr(node, "id", getattr(node, "attr", ""))


def uncoded(node: ast.AST) -> bool:
    """Whether a call makes a finding without a code, or an error of a text that has none."""
    if not isinstance(node, ast.Call):
        return False
    if named(node.func) == "Finding":
        given = [*node.args[5:6], *(each.value for each in node.keywords if each.arg == "code")]
        return not given or any(isinstance(each, ast.Constant) and each.value in SECTIONS for each in given)
    return named(node.func) in codes.classes() and bool(node.args) and textual(node.args[0])


def textual(node: ast.AST) -> bool:
    """Whether an error's message is a text, or a sentence without a code of its own or of its cause."""
    match node:
        case ast.Constant() | ast.JoinedStr():
            return True
        case ast.IfExp(body=one, orelse=other):
            return textual(one) or textual(other)
        case ast.Call(func=ast.Attribute(value=message, attr="format")):
            return textual(message)
        case ast.Call(func=ast.Name(id="_" | "pgettext" | "ngettext"), keywords=given):
            return not {"code", "cause"} & {each.arg for each in given}
        case ast.Call(func=function):
            return named(function) in SAID or isinstance(function, ast.Call)
    return False


@pytest.mark.parametrize(
    ("text", "lacks"),
    [
        ('Finding("error", "", "links", message)', True),
        ('Finding("error", "", "links", message, remedy, "")', True),
        ('Finding("error", "", "report.date", message, code="report")', True),
        ('Finding("error", "", "links", message, remedy, error.code)', False),
        ('RequestError("nothing is asked")', True),
        ('RequestError("study.no_such_key")', True),
        ('RequestError(f"{name} is none")', True),
        ('RequestError(_("nothing is asked"))', True),
        ('RequestError((_("one", code="a.b") if x else _("other")).format(x=1))', True),
        ('RequestError(_("nothing is asked", code="study.nothing"))', False),
        ('UsageError(translate("cli.bad_language", name=name))', True),
        ('UsageError(speaker(language)("cli.bad_language"))', True),
        ('UsageError(_("{name}: {cause}", name="--at", cause=error))', False),
        ('raise ValueError("the rows have other lengths")', False),
    ],
)
def test_the_walk_finds_what_has_no_code(text: str, lacks: bool) -> None:
    assert any(map(uncoded, ast.walk(ast.parse(text)))) == lacks


def test_no_finding_and_no_error_is_without_a_code() -> None:
    assert [f"{path}:{node.lineno}" for path, node in codes.nodes() if uncoded(node)] == []


def test_what_is_noted_by_a_reader_has_a_code() -> None:
    """``reader.error(node, place, message, remedy, code)`` and ``reader.finding(node, place, key, code)``."""
    calls = [
        (path, node, 5 if node.func.attr == "error" else 4)
        for path, node in codes.nodes()
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Attribute)
        and len(node.args) > 1
        and node.func.attr in ("error", "finding")
        and re.search("reader|^self$", ast.unparse(node.func.value))
    ]
    for path, node, needed in every(calls, least=80):
        starred = any(isinstance(each, ast.Starred) for each in node.args)
        code = node.args[-1] if starred else node.args[needed - 1] if len(node.args) >= needed else None
        assert code is not None, f"{path}:{node.lineno}"
        assert not isinstance(code, ast.Constant) or code.value not in SECTIONS, f"{path}:{node.lineno}"


def test_what_is_provoked_has_a_documented_code() -> None:
    """Of the corpus of wording: findings by their codes, errors by those or by their areas."""
    documented = set(re.findall(r"^\| `([\w.-]+)` \|", (DOCS / "en/codes.md").read_text("utf-8"), re.M))
    for found in every(provoking.findings(), least=500):
        assert found.code in documented, str(found)
    calls = [call for _, each in provoking.by_heading(provoking.CORPUS / "calls.txt") for call in each]
    for call in every(calls, least=200):
        area, _, word = provoking.raised(call).code.rpartition(".")
        assert (area.partition(".")[0] or word) in documented, call


def test_every_code_of_a_finding_is_explained() -> None:
    assert codes.of_findings() == set(codes.MEANINGS)


def test_a_code_is_a_word() -> None:
    for code in every([*codes.of_findings(), *codes.of_calculations()], least=200):
        assert re.fullmatch(r"[a-z]+([-_][a-z]+)*", code)


def test_an_error_about_another_has_the_code_of_that_one() -> None:
    with pytest.raises(lw.LinkwrightError) as caught:
        lw.study(lw.load("gallery:crank_rocker"), {"crank.length": "0.9 kg"}, metrics=["travel"], steps=4)
    assert caught.value.code == "study.wrong_unit" and caught.value.values["unit"] == "kg"
