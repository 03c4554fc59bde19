"""Errors and findings are put into words in the catalogue: no English sentence stands where one is raised."""

import ast
import re
from pathlib import Path

import pytest
from tests import store
from tests.every import every

import linkwright as lw

ROOT = Path(lw.__file__).parent
#: Errors of the program itself, which no user can do anything about.
OF_THE_PROGRAM = {
    "ValueError",
    "TypeError",
    "RuntimeError",
    "NotImplementedError",
    "AssertionError",
    "KeyError",
    "AttributeError",
    "FrozenInstanceError",
}
SENTENCE = re.compile(r"[A-Za-z]{2,} [a-z]{2,}")


def is_english(node: ast.AST) -> bool:
    """Whether an argument is a sentence written in place, plain or with values in it."""
    match node:
        case ast.Constant(value=str(text)):
            return bool(SENTENCE.search(text))
        case ast.JoinedStr(values=parts):
            plain = "".join(part.value for part in parts if isinstance(part, ast.Constant))
            return " " in plain and bool(re.search("[a-z]{3,}", plain))
        case ast.BinOp(left=left, right=right):
            return is_english(left) or is_english(right)
        case ast.IfExp(body=body, orelse=other):
            return is_english(body) or is_english(other)
    return False


def said(tree: ast.AST) -> list[ast.Call]:
    """Calls that raise or note something a user reads."""
    found = []
    for node in ast.walk(tree):
        match node:
            case ast.Raise(exc=ast.Call() as call):
                found.append(call)
            case (
                ast.Call(func=ast.Attribute(attr="error" | "remark"))
                | ast.Call(func=ast.Name(id="Finding" | "Remark"))
            ):
                found.append(node)
    return found


def in_place(source: str) -> list[int]:
    """Lines on which an English sentence stands where an error is raised or a finding noted."""
    return [
        call.lineno
        for call in said(ast.parse(source))
        if getattr(call.func, "id", getattr(call.func, "attr", "")) not in OF_THE_PROGRAM
        and any(map(is_english, call.args))
    ]


def test_the_walk_finds_sentences() -> None:
    assert in_place('raise LinkwrightError(f"the crank {name} does not turn")')
    assert in_place('reader.error(node, place, "the frame does not move", "x")')
    assert in_place('raise UsageError("not at all" if x else f"it has {y} steps")')
    assert not in_place('raise LinkwrightError(Sentence("motion.no_row", shape=shape))')
    assert not in_place('raise ValueError("the rows have other lengths")')


def test_no_english_sentence_stands_where_an_error_is_raised() -> None:
    places = []
    for path in every(sorted(ROOT.rglob("*.py")), least=400):
        places += [f"{path.relative_to(ROOT)}:{line}" for line in in_place(path.read_text(encoding="utf-8"))]
    assert places == []


#: One term for one thing: that of Chinese textbooks of the theory of machines, and what is not written instead.
ONE_TERM = {"平衡力矩": ("输入力矩",), "运动副反力": ("约束反力",), "设计指标": ("设计参数",)}
CHINESE = [*ROOT.glob("locale/zh/*/*.po"), *(Path(__file__).resolve().parents[2] / "docs/zh").rglob("*.md")]


def test_one_chinese_term_for_one_thing() -> None:
    for path in every(CHINESE, least=60):
        text = path.read_text("utf-8")
        assert not [word for words in ONE_TERM.values() for word in words if word in text], path


@pytest.mark.parametrize("model", ["planetary_two_inputs", "chain_drive"])
def test_the_frame_has_its_chinese_word(model: str) -> None:
    """Wherever the program itself lists links: structure, worked solution, legends of pictures, report."""
    machine, forces = store.machine(model), store.forces(model, 12)
    shown = re.sub("<style>.*?</style>|<[^>]*>", " ", lw.draw(forces.motion, forces=forces, language="zh").svg)
    texts = [
        lw.structure(machine).text("zh"),
        lw.worked(forces, language="zh").text(),
        shown,
        lw.report(machine, language="zh", sections=["structure", "method", "gears"]).content(".typ").decode(),
    ]
    for text in texts:
        assert not re.search(r"(?<![\w.])frame(?![\w.(:])", text)
