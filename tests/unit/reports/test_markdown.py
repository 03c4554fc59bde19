"""Own text of reports: every element of Markdown becomes the block that stands for it; what is wrong is told."""

from pathlib import Path

import pytest
from tests.every import every

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
    plain,
    spans,
)
from linkwright.reports.formula import formula
from linkwright.reports.markdown import TextContext, own_text

pytest.importorskip("markdown_it")
SKETCH = '<svg xmlns="http://www.w3.org/2000/svg" width="96" height="48"><rect width="96" height="48"/></svg>'


def read(text: str, beside: TextContext | None = None) -> tuple[list[Block], list[str]]:
    """Blocks, and codes or sentences of what is wrong."""
    found = list(own_text(text, context=beside))
    return [block for block, _ in found], [each.code or each.sentence for _, faults in found for each in faults]


def one(text: str, beside: TextContext | None = None) -> Block:
    (block,), faults = read(text, beside)
    assert not faults
    return block


def marks(text: str) -> list[tuple[str, str, str, str]]:
    block = one(text, TextContext(sources={"norton": "Norton, Design of Machinery"}))
    assert isinstance(block, Paragraph)
    return [(each.kind, each.text, "+".join(sorted(each.styles)), each.link) for each in spans(block.text)]


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        (
            "a **b *c* d**",
            [
                ("text", "a ", "", ""),
                ("text", "b ", "strong", ""),
                ("text", "c", "emphasis+strong", ""),
                ("text", " d", "strong", ""),
            ],
        ),
        (
            "[a `b`](https://x.org/?a=1&b=2)",
            [("text", "a ", "", "https://x.org/?a=1&b=2"), ("code", "b", "", "https://x.org/?a=1&b=2")],
        ),
        ("~~a~~\\\nb", [("text", "a", "struck", ""), ("break", "\n", "", ""), ("text", "b", "", "")]),
        (r"$\mu$ costs \$5 \*or\* $6", [("formula", r"\mu", "", ""), ("text", " costs $5 *or* $6", "", "")]),
        (
            "[[table 1]] [a](#b) [@norton]",
            [
                ("reference", "table 1", "", ""),
                ("text", " ", "", ""),
                ("text", "a", "", "#b"),
                ("text", " ", "", ""),
                ("source", "Norton, Design of Machinery", "", ""),
            ],
        ),
        ("``**a** ` $b$ [[c]]`` d", [("code", "**a** ` $b$ [[c]]", "", ""), ("text", " d", "", "")]),
        ("<b>&amp; #panic()", [("text", "<b>& #panic()", "", "")]),
        ("曲柄\n摇杆 a\nb", [("text", "曲柄摇杆 a b", "", "")]),
    ],
)
def test_marks_within_a_paragraph(text: str, wanted: list[tuple[str, str, str, str]]) -> None:
    assert marks(text) == wanted


def test_lists_hold_numbers_lists_and_other_blocks() -> None:
    found = one("3. a\n   - b\n   - c\n\n     d\n4. e\n\n   ```py\n   f\n   ```\n")
    assert isinstance(found, Listed) and found.start == 3
    (first, inner), (second, code) = found.items
    assert isinstance(inner, Listed) and inner.start is None
    assert [[plain(each.text) for each in item if isinstance(each, Paragraph)] for item in inner.items] == [
        ["b"],
        ["c", "d"],
    ]
    assert isinstance(first, Paragraph) and isinstance(second, Paragraph) and code == Code("f\n", "py")


def test_headings_begin_at_the_level_below_the_chapter() -> None:
    found, _ = read("## A {#here}\n\n### B\n\n## C\n\n##### D")
    levels = [(each.text, each.level, each.label) for each in found if isinstance(each, Heading)]
    assert levels == [("A", 2, "here"), ("B", 3, ""), ("C", 2, ""), ("D", 4, "")]


@pytest.mark.parametrize("text", ["Table: Speeds {#s}\n\n{}", "{}\n\n: Speeds {#s}", "表：Speeds {#s}\n\n{}"])
def test_tables_have_their_alignment_and_the_caption_beside_them(text: str) -> None:
    table = "| a | b | c |\n|:--|:-:|--:|\n| **1** | `2` | $3$ |\n| x |"
    found = one(text.replace("{}", table))
    assert isinstance(found, Table)
    assert (found.align, found.caption, found.label) == ("<^>", "Speeds", "s")
    assert [plain(cell) for cell in found.head] == ["a", "b", "c"]
    assert [[plain(cell) for cell in row] for row in found.rows] == [["1", "2", "3"], ["x", "", ""]]


def test_a_paragraph_beside_a_table_that_is_no_caption_stays_one() -> None:
    found, _ = read("Before\n\n| a |\n|---|\n| 1 |\n\nbehind: it")
    assert [type(each) for each in found] == [Paragraph, Table, Paragraph]


def test_code_has_its_language_and_caption() -> None:
    assert one("```python Solve *it* {#p}\na = $1$\n\n  b\n```") == Code(
        "a = $1$\n\n  b\n",
        "python",
        one("Solve *it*").text,
        "p",  # type: ignore[union-attr]
    )
    assert one("    indented [[a]]") == Code("indented [[a]]\n")


def test_formulas_of_their_own_are_numbered_where_they_have_a_label() -> None:
    assert one("$$\na =\nb\n$$") == Formula((formula("a = b"),), number=False)
    assert one("$$ a $$ (eq)") == Formula((formula("a"),), "eq")
    found = one(r"\begin{align} a &= b \\ c &= d \end{align}")
    assert isinstance(found, Formula) and not found.number
    assert [type(each) for each in read("so $$a$$ it is")[0]] == [Paragraph, Formula, Paragraph]


def test_quotations_rules_and_footnotes() -> None:
    found, faults = read("> a\n>\n> - b\n\n---\n\nc[^x] d[^y]\n\n[^y]: second\n[^x]: *first*")
    quoted, rule, _, *notes = found
    assert isinstance(quoted, Quoted) and isinstance(quoted.blocks[1], Listed) and rule == Rule() and not faults
    assert [(plain(each.text), each.kind) for each in notes if isinstance(each, Paragraph)] == [
        ("1 first", "footnote"),
        ("2 second", "footnote"),
    ]


def test_pictures_have_a_caption_a_width_and_a_label(tmp_path: Path) -> None:
    from PIL import Image

    Image.new("RGB", (400, 100), "white").save(tmp_path / "photo one.png")
    Image.new("RGB", (40, 1000), "white").save(tmp_path / "b.jpg")
    (tmp_path / "c.svg").write_text(SKETCH, encoding="utf-8")
    beside = TextContext(str(tmp_path))
    found = one("![A *white* one](photo%20one.png){#w width=40%}", beside)
    assert isinstance(found, Figure)
    assert (plain(found.caption), found.label, found.pictures[0][1]) == ("A white one", "w", 0.4)
    blocks, faults = read("words ![b](b.jpg) more ![](c.svg)", beside)
    assert [type(each) for each in blocks] == [Paragraph, Figure, Paragraph, Figure] and not faults
    for each in every(blocks[1::2], least=2):
        assert isinstance(each, Figure) and 0.0 < each.pictures[0][1] <= 1.0


def test_a_photograph_that_lies_on_its_side_is_turned_upright(tmp_path: Path) -> None:
    from PIL import Image

    exif = Image.Exif()
    exif[0x0112] = 6
    Image.new("RGB", (80, 40), "white").save(tmp_path / "a.jpg", exif=exif)
    found = one("![](a.jpg)", TextContext(str(tmp_path)))
    assert (
        isinstance(found, Figure)
        and '<svg xmlns="http://www.w3.org/2000/svg" width="40" height="80"' in (found.pictures[0][0])
    )


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("![a](none.png)", "wrong-picture"),
        ("![a](text.png)", "wrong-picture"),
        ("![a](a.gif)", "wrong-picture"),
        ("![a](bad.svg)", "wrong-picture"),
        ("[@nobody]", "no-source"),
        (r"$\foo$", r"\foo"),
        (r"$$ \foo $$", r"\foo"),
        ("a $ x $ b", "$ x $"),
        ("# ![a](c.svg)", '"a"'),
        ("| ![cell](c.svg) |\n|---|", '"cell"'),
        ("typst\n#panic()", "panicked"),
    ],
)
def test_what_is_wrong_is_told_and_printed_as_it_is_written(text: str, code: str, tmp_path: Path) -> None:
    (tmp_path / "text.png").write_text("no picture", encoding="utf-8")
    (tmp_path / "bad.svg").write_text("<svg><g></svg>", encoding="utf-8")
    (tmp_path / "c.svg").write_text(SKETCH, encoding="utf-8")
    (block,), faults = read(text, TextContext(str(tmp_path)))
    assert len(faults) == 1 and code in faults[0]
    shown = block.rows or block.head if isinstance(block, Table) else getattr(block, "text", "")
    assert plain("".join(shown)) if isinstance(shown, tuple) else plain(shown)


def test_typst_stays_typst() -> None:
    assert one("typst\n#line()") == Source("#line()")


def test_signs_that_mark_texts_here_are_taken_out_of_a_users_text() -> None:
    found = one("a\ue010b\ue014c")
    assert isinstance(found, Paragraph) and plain(found.text) == "abc"


EVERYTHING = """\
- ```
  code first
  ```
- a
  1. b
     - c
- $$ d $$ (in-a-list)

> | a |
> |---|
> | 1 |
>
> Table: In a quotation {#quoted}

```yaml Listing {#listing}
k: [1]
```

1) own number
2) [[in-a-list]], [[quoted]], [[listing]]
"""


def test_numbers_within_lists_and_quotations_are_those_of_all_three_forms() -> None:
    """Word's writer passes the same blocks in the same order as the numbers are counted."""
    pytest.importorskip("typst")
    docx = pytest.importorskip("docx")
    import io
    import re
    from html import unescape

    from linkwright.errors import speaker
    from linkwright.reports.document import Document
    from linkwright.reports.typst_pages import compiled
    from linkwright.reports.word_pages import word

    document = Document("T", speaker("en"), blocks=[Heading("A"), *read(EVERYTHING)[0]])
    wanted = "equation (1.1), Table 1.1, Listing 1.1"
    page = unescape(re.sub("<[^>]*>", "", compiled(document, "html").decode()))
    assert wanted in page
    lines = [each.text for each in docx.Document(io.BytesIO(word(document))).paragraphs]
    assert wanted in lines and "\t(1.1)" in lines
    for caption in ("Table 1.1  In a quotation", "Listing 1.1  Listing"):
        assert caption in lines
