"""A user's own text: Markdown (CommonMark with tables, footnotes and formulas) as blocks, or Typst as it is."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from linkwright.errors import LinkwrightError
from linkwright.filesystem import is_confined
from linkwright.registry import offered
from linkwright.reports.document import (
    Block,
    Code,
    Figure,
    Formula,
    Heading,
    Listed,
    Paragraph,
    Quoted,
    Rule,
    Source,
    Table,
    broken,
    cited,
    linked,
    literal,
    marked,
    unmarked,
)
from linkwright.reports.formula import formula
from linkwright.reports.pictures import picture_of
from linkwright.words import Message, _

if TYPE_CHECKING:
    from markdown_it import MarkdownIt
    from markdown_it.tree import SyntaxTreeNode

#: A caption of a table, ``Table: words {#label}``, and what may stand behind a heading or a picture.
_CAPTION = re.compile(r"(?:Table|表|表格)?\s*[:：]\s*(.*)", re.DOTALL)
_LABEL = re.compile(r"\s*\{#([^\s{}]+)\}\s*$")
_ATTRIBUTES = re.compile(r"\{([^{}]*)\}")
_WIDTH = re.compile(r"width=\"?(\d+(?:\.\d+)?)%\"?")
_ALIGN = {"left": "<", "center": "^", "right": ">"}
_STYLES = {"strong": "strong", "em": "emphasis", "s": "struck"}
#: What is meant as a formula, probably, but has spaces within its dollar signs.
_SPACED = re.compile(r"\$ [^$]+ \$")
_CHINESE = re.compile(r"[\u2e80-\u9fff\uff00-\uffef]")
#: Tallest own picture, mm.
TALLEST = 150.0


@dataclass(frozen=True)
class TextContext:
    """What an own text refers to: the folder of its pictures, and sources by the name by which it cites them."""

    folder: str = ""
    sources: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Fault:
    """What is wrong in an own text: a file or a source that it names (``code``), or what no form can print."""

    sentence: str
    code: str = ""


def own_text(text: str, level: int = 2, context: TextContext | None = None) -> Iterator[tuple[Block, list[Fault]]]:
    """The blocks of a text, each with what is wrong in it; its highest headings are of ``level``.

    After a first line ``typst`` it is Typst. Raises LinkwrightError where no reader of Markdown is installed.
    """
    first, _unused, rest = text.strip().partition("\n")
    if first.strip().lower() == "typst":
        yield _typst(rest)
        return
    nodes = _tree(unmarked(text)).children
    highest = min((int(node.tag[1]) for node in nodes if node.type == "heading"), default=1)
    reader = _Reader(level - highest, context or TextContext())
    for block in reader.blocks(nodes):
        yield block, reader.taken()


def own_words(text: str) -> str:
    """A line of Markdown, such as a source, as marked text."""
    reader = _Reader(1, TextContext())
    return "".join(each for each in reader.inline(_inline(unmarked(text))) if isinstance(each, str))


def _typst(text: str) -> tuple[Block, list[Fault]]:
    """Typst as it is; as text where it does not compile, and where files are bound to a folder: it can read files and
    fetch packages."""
    from linkwright.reports.typst_pages import typst_fault

    if is_confined():
        return Paragraph(literal(text)), [Fault(_("texts in Typst are not set here; write Markdown"))]
    if fault := typst_fault(text):
        return Paragraph(literal(text)), [Fault(_("Typst cannot read this text: {message}", message=fault))]
    return Source(text), []


@lru_cache(maxsize=1)
def _parser() -> MarkdownIt:
    try:
        from markdown_it import MarkdownIt
        from mdit_py_plugins.amsmath import amsmath_plugin
        from mdit_py_plugins.dollarmath import dollarmath_plugin
        from mdit_py_plugins.footnote import footnote_plugin
    except ImportError:
        raise LinkwrightError(
            _(
                "own texts need markdown-it-py and mdit-py-plugins; install them with: pip install "
                '"linkwright[report]"',
                code="report.needs_markdown",
            )
        ) from None
    made = MarkdownIt("commonmark", {"html": False}).enable(["table", "strikethrough"])
    made.use(dollarmath_plugin, allow_space=False, double_inline=True)
    made.use(footnote_plugin).use(amsmath_plugin)
    made.inline.ruler.before("link", "reference", _reference)
    return made


def _reference(state: Any, silent: bool) -> bool:
    """The rule of ``[[label]]`` and ``[@source; @other]``."""
    found = re.compile(r"\[\[([^\[\]\n]+)\]\]|\[(@[^\[\]\n]+)\]").match(state.src, state.pos)
    if found is None:
        return False
    if not silent:
        kind = "reference" if found[1] else "citation"
        state.push(kind, "", 0).content = found[1] or found[2]
    state.pos = found.end()
    return True


def _tree(text: str) -> SyntaxTreeNode:
    from markdown_it.tree import SyntaxTreeNode

    return SyntaxTreeNode(_parser().parse(text))


def _inline(text: str) -> Sequence[SyntaxTreeNode]:
    """The parts of a text of one paragraph."""
    from markdown_it.tree import SyntaxTreeNode

    return SyntaxTreeNode(_parser().parseInline(text)).children[0].children


class _Reader:
    """Turns the tree of a text into blocks and notes what is wrong; ``shift`` of the levels of headings."""

    def __init__(self, shift: int, context: TextContext) -> None:
        self.shift, self.text_context = shift, context
        self.faults: list[Fault] = []

    def taken(self) -> list[Fault]:
        found, self.faults = self.faults, []
        return found

    def wrong(self, sentence: Message, code: str = "") -> None:
        self.faults.append(Fault(sentence, code))

    def blocks(self, nodes: Sequence[SyntaxTreeNode]) -> Iterator[Block]:
        """Blocks of nodes; a paragraph that is the caption of the adjacent table goes there."""
        rest = list(nodes)
        while rest:
            node, behind = rest.pop(0), rest[0] if rest else None
            if behind is not None and behind.type == "table" and (caption := _caption(node)):
                yield self._table(rest.pop(0), caption)
            elif node.type == "table" and behind is not None and (caption := _caption(behind)):
                rest.pop(0)
                yield self._table(node, caption)
            else:
                yield from self._block(node)

    def _block(self, node: SyntaxTreeNode) -> Iterator[Block]:
        match node.type:
            case "heading":
                text, label = _labelled(node.children[0].content)
                yield Heading(self.line(_inline(text)), min(self.shift + int(node.tag[1]), 4), label)
            case "paragraph":
                for part in self.inline(node.children[0].children):
                    if not isinstance(part, str):
                        yield part
                    elif part.strip():
                        yield Paragraph(part.strip())
            case "bullet_list" | "ordered_list":
                start = int(node.attrs.get("start", 1)) if node.type == "ordered_list" else None
                yield Listed(tuple(tuple(self.blocks(item.children)) for item in node.children), start)
            case "blockquote":
                yield Quoted(tuple(self.blocks(node.children)))
            case "fence" | "code_block":
                language, _unused, caption = node.info.strip().partition(" ")
                words, label = _labelled(caption)
                yield Code(node.content, language, self.line(_inline(words)) if words else "", label)
            case "table":
                yield self._table(node, "")
            case "hr":
                yield Rule()
            case "math_block" | "math_block_label" | "amsmath":
                yield self._display(node.content, node.info if node.type == "math_block_label" else "")
            case "footnote_block":
                yield from (part for note in node.children for part in self._note(note))
            case _:
                yield Paragraph(literal(node.content))

    def _note(self, node: SyntaxTreeNode) -> Iterator[Block]:
        """A footnote: its number before its first paragraph."""
        before = marked(str(node.meta["id"] + 1), "raised") + " "
        for block in self.blocks([each for each in node.children if each.type != "footnote_anchor"]):
            yield Paragraph(before + block.text, "footnote") if isinstance(block, Paragraph) else block
            before = ""

    def _display(self, text: str, label: str = "") -> Block:
        found = " ".join(text.split())
        shown = self.formula(found)
        if not shown.startswith("$"):
            return Paragraph(shown)
        return Formula((formula(found),), label, bool(label))

    def _table(self, node: SyntaxTreeNode, caption: str) -> Table:
        rows = [row.children for part in node.children for row in part.children]
        cells = [tuple(self.line(cell.children[0].children) for cell in row) for row in rows]
        align = "".join(
            _ALIGN.get(str(cell.attrs.get("style", "")).removeprefix("text-align:"), "<") for cell in rows[0]
        )
        words, label = _labelled(caption)
        return Table(self.line(_inline(words)) if words else "", cells[0], tuple(cells[1:]), align, label)

    def line(self, nodes: Sequence[SyntaxTreeNode]) -> str:
        """A text where no block can stand; a picture there is reported."""
        found = ""
        for part in self.inline(nodes):
            if isinstance(part, str):
                found += part
            elif isinstance(part, Figure):
                found += part.caption
                self.wrong(
                    _(
                        'the picture "{text}" is in a heading, a table or a link, where no picture can '
                        "stand; give it a paragraph of its own",
                        code="report.picture_in_line",
                        text=part.caption,
                    )
                )
            elif isinstance(part, Formula):
                found += f"${part.sides[0]}$"
        return found

    def inline(self, nodes: Sequence[SyntaxTreeNode]) -> Iterator[str | Block]:
        """Marked texts, and the pictures and formulas of their own between them."""
        text, rest = "", list(nodes)
        while rest:
            node = rest.pop(0)
            block: Block | None = None
            if node.type == "image":
                block = self._picture(node, _attributes(rest))
            elif node.type == "math_inline_double":
                block = self._display(node.content)
            else:
                text += self._part(node, rest, text)
                continue
            if text.strip():
                yield text
            text = ""
            if block is not None:
                yield block
        if text:
            yield text

    def _part(self, node: SyntaxTreeNode, behind: Sequence[SyntaxTreeNode], before: str) -> str:
        match node.type:
            case "text" | "text_special":
                if spaced := _SPACED.search(node.content):
                    self.wrong(
                        _(
                            '"{text}" is printed as it is; a formula has no spaces next to its dollar signs: $x + y$',
                            code="report.spaced_formula",
                            text=spaced[0],
                        )
                    )
                return literal(node.content)
            case "softbreak":
                after = behind[0].content[:1] if behind else ""
                return "" if _CHINESE.match(before[-1:]) and _CHINESE.match(after) else " "
            case "hardbreak":
                return broken()
            case "code_inline":
                return f"`{literal(node.content)}`"
            case "strong" | "em" | "s":
                return marked(self.line(node.children), _STYLES[node.type])
            case "link":
                return linked(self.line(node.children), str(node.attrs["href"]))
            case "math_inline":
                return self.formula(node.content.strip())
            case "footnote_ref":
                return marked(str(node.meta["id"] + 1), "raised")
            case "reference":
                return f"[[{node.content.strip()}]]"
            case "citation":
                return self._cited(node.content)
            case _:
                return literal(node.content)

    def formula(self, text: str) -> str:
        """A formula, as it is written where it cannot be printed."""
        try:
            formula(text)
        except LinkwrightError as error:
            sentence = error.sentence
            self.faults.append(Fault(sentence))
            return literal(f"${text}$")
        return f"${text}$"

    def _cited(self, text: str) -> str:
        """Numbers of sources."""
        found = []
        for name in (each.strip().removeprefix("@") for each in re.split("[;,，；]", text)):
            if name in self.text_context.sources:
                found.append(cited(self.text_context.sources[name]))
            else:
                hint = offered(name, self.text_context.sources)
                self.wrong(
                    _(
                        'no source is named "{name}"; {hint}; own sources stand in the list references',
                        code="report.no_source",
                        name=name,
                        hint=hint,
                    ),
                    "no-source",
                )
                found.append(literal(f"[@{name}]"))
        return ", ".join(found)

    def _picture(self, node: SyntaxTreeNode, attributes: str) -> Block | None:
        name = str(node.attrs["src"])
        words = self.line(node.children) or literal(str(node.attrs.get("title", "")))
        label = next((each[1:] for each in attributes.split() if each.startswith("#")), "")
        try:
            found = picture_of(name, self.text_context.folder)
        except LinkwrightError as error:
            self.faults.append(Fault(error.sentence, "wrong-picture"))
            return Paragraph(words or literal(name))
        asked = _WIDTH.search(attributes)
        share = min(float(asked[1]) / 100.0, 1.0) if asked else found.share
        return Figure(words, ((found.svg, max(share, 0.02)),), label, TALLEST)


def _attributes(rest: list[SyntaxTreeNode]) -> str:
    """The text in braces after a picture; it is removed."""
    if not rest or rest[0].type != "text" or not (found := _ATTRIBUTES.match(rest[0].content)):
        return ""
    token = rest[0].token
    assert token is not None
    token.content = token.content[found.end() :]
    return found[1]


def _labelled(text: str) -> tuple[str, str]:
    """A text without the label in braces at its end, and the label."""
    found = _LABEL.search(text)
    return (text[: found.start()], found[1]) if found else (text, "")


def _caption(node: SyntaxTreeNode) -> str:
    """The caption that a paragraph holds for the adjacent table; empty where it is none."""
    found = _CAPTION.fullmatch(node.children[0].content) if node.type == "paragraph" else None
    return found[1] if found else ""
