"""Every text of the program is a message: a language more is one catalogue more."""

import ast
import re
import string
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from babel.messages.extract import extract_from_dir
from tests.contract.sources import MODULES
from tests.every import every
from tests.unit.words.catalogued import sentences
from tests.unit.words.pseudo import CLOSE, OPEN, PSEUDO, pseudo, pseudo_locale
from tests.words.printing import commands, printed
from tests.words.provoking import remarks

import linkwright as lw
from linkwright.words import Message, _

ROOT = Path(lw.__file__).parent
KEYWORDS = {"_": None, "pgettext": ((1, "c"), 2), "ngettext": (1, 2)}
#: Words with a blank on either side, which stand outside of all brackets.
ENGLISH = re.compile(r"[a-z]{3,} [a-z]{2,} ")


@cache
def extracted() -> set[str]:
    """The English texts of all messages in the source, with their contexts."""
    found = set()
    for _path, _line, text, _comments, context in extract_from_dir(
        str(ROOT), [("**.py", "python")], keywords=KEYWORDS
    ):
        for each in (text,) if isinstance(text, str) else text:
            found.add(f"{context or ''}|{each}")
    return found


def called() -> Iterator[str]:
    """The English texts of all calls of ``_`` in the source, read by Python's own parser."""
    for module in MODULES:
        for node in ast.walk(ast.parse((ROOT / module).read_text(encoding="utf-8"))):
            match node:
                case ast.Call(func=ast.Name(id="_"), args=[ast.Constant(value=str(text)), *_]):
                    yield f"|{text}"


def outside(text: str) -> str:
    """What no brackets hold."""
    depth, rest = 0, []
    for character in text:
        depth += (character == OPEN) - (character == CLOSE)
        if not depth and character != CLOSE:
            rest.append(character)
    return "".join(rest)


def test_every_message_is_in_the_catalogue_and_no_other() -> None:
    """``pybabel extract`` and ``pybabel update`` as CONTRIBUTING says make it so again."""
    source, known = extracted(), set(sentences("zh"))
    assert len(source) > 3500
    assert sorted(source - known) == []
    assert sorted(known - source) == []


def test_no_message_is_hidden_from_extraction() -> None:
    """In an f-string, or within another message, ``pybabel extract`` does not see one."""
    assert sorted({*called()} - extracted()) == []


@pytest.mark.parametrize("command", ["", *commands()])
def test_help_is_translated_but_for_what_one_writes(command: str, tmp_path: Path) -> None:
    with pseudo_locale():
        text = printed(f"{command} --help".strip(), PSEUDO, tmp_path)
    assert OPEN in text
    written = [line for line in outside(text).splitlines() if ENGLISH.search(line)]
    assert [line for line in written if not re.match(r"\s*(linkwright|--|\[)", line)] == []


def test_findings_and_results_are_translated(tmp_path: Path) -> None:
    with pseudo_locale():
        found = list(remarks(PSEUDO))
        solved = printed("metrics gallery:crank_rocker --names stroke swing_angle", PSEUDO, tmp_path)
    assert [each for each in every(found, least=300) if OPEN not in each] == []
    assert OPEN in solved


def test_a_living_page_is_written_in_any_language() -> None:
    with pseudo_locale():
        page = lw.living_page(lw.load("gallery:crank_rocker"), language=PSEUDO).html
    assert f'<html lang="{PSEUDO}">' in page and OPEN in page


def test_pseudo_texts_keep_their_values() -> None:
    assert pseudo("links reach {reach:.2f}, {name!r}") == f"{OPEN}línks réách {{reach:.2f}}, {{name!r}}{CLOSE}"
    with pseudo_locale():
        assert _("mass {value:.1f}", value=2.0).translate(PSEUDO) == f"{OPEN}máss 2.0{CLOSE}"
        assert _("{a}: {b}", a=_("mass"), b=("x", _("pin"))).translate(PSEUDO).count(OPEN) == 4


def test_messages_are_texts_that_can_be_filled_copied_and_pickled() -> None:
    import copy
    import pickle

    template = _("reach {reach}", code="a.b")
    filled = template.format(reach=_("mass"))
    assert isinstance(filled, Message) and filled == "reach mass" and filled.code == "a.b"
    for again in (pickle.loads(pickle.dumps(filled)), copy.deepcopy(filled)):
        assert again == filled and again.translate("zh") == filled.translate("zh") and again.code == "a.b"
    with pytest.raises(TypeError):
        template.format("x")


def test_no_call_puts_a_message_together() -> None:
    """What is extracted is a text that stands there, neither an f-string nor a name."""
    for path in every(sorted(ROOT.rglob("*.py")), least=400):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in ("_", "pgettext", "ngettext"):
                assert all(isinstance(each, ast.Constant) for each in node.args), f"{path}:{node.lineno}"
                text = node.args[-1].value  # type: ignore[attr-defined]
                fields = {name for _l, name, _s, _c in string.Formatter().parse(text) if name}
                assert all(re.match(r"[a-z_]\w*$", name) or "$" in text for name in fields), text
