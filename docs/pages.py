"""Generated pages of the documentation.

Gallery and reference numbers are generated when the documentation is built, as ``.markdown`` files in ``docs/made``,
which is not part of the repository. The reference of keys and names (``model_file.md``, ``functions.md``,
``codes.md``) is part of the repository, so that it can be read in a clone; ``python docs/pages.py`` updates it.
"""

from __future__ import annotations

import ast
import hashlib
import inspect
import os
import re
import sys
import textwrap
from collections.abc import Iterator, Mapping
from contextlib import suppress
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

import linkwright as lw
from linkwright import gallery
from linkwright.errors import LinkwrightError
from linkwright.fields.reading import form
from linkwright.files.gallery_entries import entry
from linkwright.validation.validate import validate
from linkwright.words import Message
from linkwright.words.message import in_language

sys.path.insert(0, str(Path(__file__).parent))
import codes as coded
from chinese import LOADS, NAMES

ROOT = Path(__file__).parent
MADE = ROOT / "made"
#: Files copied to the built documentation unchanged.
EXTRA = MADE / "extra"
#: Positions of the living pages.
STEPS = 240
PUBLIC = {name: getattr(lw, name) for name in lw.__all__ if not inspect.ismodule(getattr(lw, name))}
TITLES = {"en": "Gallery", "zh": "图库"}
WORDS = {
    "en": {
        "solve": "Try it",
        "file": "The model file",
        "structure": "Structure",
        "source": "Source",
        "living": "The machine, to be played and dragged",
        "drag": "Drag a joint: the browser solves motion, forces and metrics again with the same formulas.",
    },
    "zh": {
        "solve": "运行",
        "file": "模型文件",
        "structure": "结构分析",
        "source": "资料来源",
        "living": "可播放、可拖动的机构",
        "drag": "拖动运动副：运动、力和设计指标由相同的公式在浏览器中重新求解。",
    },
}


def make() -> None:
    """Write the pages of the build; those that are up to date are not touched."""
    pictures()
    living_pages()
    compared, made = validate(), {}
    for language in ("en", "zh"):
        made[f"{language}/gallery/index"] = "\n".join(gallery_index(language))
        for name in gallery.names():
            made[f"{language}/gallery/{name}"] = "\n".join(gallery_page(name, language))
        made[f"{language}/validation_table"] = f"{compared.tables(language, sources=True)[0].markdown(language)}\n"
    pages = {MADE / f"{name}.markdown": text for name, text in made.items()}
    for path in set(MADE.rglob("*.markdown")) - set(pages):
        path.unlink()  # of an earlier build
    write(pages)


@cache
def reference() -> dict[Path, str]:
    """The pages of keys and names that the repository holds."""
    found = {}
    for language in ("en", "zh"):
        found[ROOT / language / "model_file.md"] = model_file(language)
        found[ROOT / language / "functions.md"] = functions(language)
        found[ROOT / language / "codes.md"] = codes(language)
        found[ROOT / language / "gallery.md"] = gallery_by_kinds(language)
    made = {path: "\n".join(lines).rstrip() + "\n" for path, lines in found.items()}
    for language in ("en", "zh"):  # for assistants, who have the package alone
        shipped = Path(lw.__file__).parent / "assistants" / f"glossary.{language}.md"
        made[shipped] = (ROOT / language / "glossary.md").read_text("utf-8")
    return made


def write(pages: Mapping[Path, str]) -> None:
    """Write pages, except those that are up to date: Sphinx builds only what changed."""
    for path, text in pages.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists() or path.read_text("utf-8") != text:
            path.write_text(text, "utf-8")


# gallery ----------------------------------------------------------------------------------------
def pictures() -> None:
    """A drawing of every model; an empty one where it cannot be assembled."""
    folder = MADE / "pictures"
    folder.mkdir(parents=True, exist_ok=True)
    for name in gallery.names():
        path = folder / f"{name}.svg"
        if not path.exists():
            try:
                path.write_text(lw.draw(lw.load(f"gallery:{name}"), size=520).svg, "utf-8")
            except LinkwrightError:
                path.write_text('<svg xmlns="http://www.w3.org/2000/svg" width="10" height="10"/>', "utf-8")


def living_pages() -> None:
    """The living page of every model that can be assembled, unless it is up to date."""
    folder = EXTRA / "living"
    folder.mkdir(parents=True, exist_ok=True)
    front_end = (files("linkwright") / "page" / "built" / "sources.sha256").read_text("utf-8")
    for name in gallery.names():
        document, path = lw.read_document(f"gallery:{name}"), folder / f"{name}.html"
        made_of = hashlib.sha256(f"{lw.__version__}{front_end}{document.text}".encode()).hexdigest()
        mark = f"<!-- {made_of} -->\n"
        if path.exists() and path.read_text("utf-8").endswith(mark):
            continue
        with suppress(LinkwrightError):
            path.write_text(lw.living_page(document, steps=STEPS).html + mark, "utf-8")


def gallery_index(language: str) -> Iterator[str]:
    """Cards with pictures."""
    yield f"# {TITLES[language]}\n"
    yield "::::{grid} 1 2 3 3\n:gutter: 3\n"
    for name in gallery.names():
        model = entry(name)
        title = in_language(model["title"], language)
        yield f":::{{grid-item-card}} {title}\n:link: {name}\n:link-type: doc\n:img-top: ../../pictures/{name}.svg\n"
        yield f"{first_sentence(in_language(model['purpose'], language))}\n:::\n"
    yield "::::\n"
    yield "```{toctree}\n:hidden:\n"
    yield from gallery.names()
    yield "```"


def first_sentence(text: str) -> str:
    """The beginning of a purpose, up to its first semicolon."""
    return escaped(re.split("[;；]", text)[0])


def gallery_by_kinds(language: str) -> Iterator[str]:
    """The existing page, with the purposes of the models updated in its tables."""
    for line in (ROOT / language / "gallery.md").read_text("utf-8").splitlines():
        if row := re.fullmatch(r"\| `(\w+)` \| .+ \| (.+?) \|", line):
            purpose = in_language(entry(row[1])["purpose"], language)
            line = f"| `{row[1]}` | {purpose} | {row[2]} |"
        yield line


def gallery_page(name: str, language: str) -> Iterator[str]:
    """One model: picture, purpose, source, commands, structure, file."""
    model, words = lw.load(f"gallery:{name}").translate(language), WORDS[language]
    yield f"# {model.name}\n"
    yield f"{escaped(model.purpose)}\n"
    if (EXTRA / "living" / f"{name}.html").exists():
        yield f'```{{raw}} html\n<iframe class="living" src="../../../living/{name}.html#lang={language}"'
        yield f'  loading="lazy" sandbox="allow-scripts allow-downloads" title="{words["living"]}"></iframe>\n```\n'
        yield f"{words['drag']}\n"
    else:
        yield f"![{name}](../../pictures/{name}.svg)\n"
    yield f"**{words['source']}**: {escaped(model.source)}\n"
    yield f"## {words['solve']}\n"
    kind = "solve" if model.drivers else "structure"
    option = "" if language == "en" else " --lang zh"
    yield f"```\nlinkwright {kind} gallery:{name}{option}\nlinkwright report gallery:{name}{option}\n```\n"
    yield f"## {words['structure']}\n\n```text\n{lw.structure(model).text(language)}\n```\n"
    yield f"## {words['file']}\n\n```yaml\n{gallery.file(name).read_text('utf-8')}```"


def escaped(text: str) -> str:
    """Text with Markdown's special characters escaped."""
    return re.sub(r"([\\`*_{}\[\]<>#$|])", r"\\\1", text)


# model files ------------------------------------------------------------------------------------
FILE_WORDS = {
    "en": {
        "title": "Model file reference",
        "intro": "Generated from the schema that `linkwright schema` prints and editors complete from. A quantity is "
        'written with its unit (`"60.5 mm"`) or as an expression of `parameters`; the right column shows the form.',
        "head": "| key | meaning | form |",
        "required": " (required)",
        "see": "Its keys: [{0}]({0}).",
    },
    "zh": {
        "title": "模型文件参考",
        "intro": "由 `linkwright schema` 输出、编辑器据以补全的 schema 生成。"
        '量要写单位（`"60.5 mm"`），或写成 `parameters` 的表达式；右栏为写法。',
        "head": "| 键 | 含义 | 写法 |",
        "required": "（必须）",
        "see": "各键见 [{0}]({0})。",
    },
}
#: Pages that describe sections of which the schema lists the keys only.
SECTIONS = {
    "expected": "gallery",
    "synthesis": "how-to/synthesis",
    "report": "how-to/report",
    "sheet": "how-to/sheets",
    "course": "how-to/course",
    "optimize": "how-to/optimisation",
    "expect": "how-to/expectations",
}


def model_file(language: str = "en") -> Iterator[str]:
    """Every section and key of a model file, from its schema."""
    schema, words = lw.json_schema(), FILE_WORDS[language]
    yield f"# {words['title']}\n\n{words['intro']}\n"
    for name, section in schema["properties"].items():
        yield f"## `{name}`{words['required'] if name in schema.get('required', ()) else ''}\n"
        yield f"{sentence(section, language)}\n"
        if name in SECTIONS:
            yield f"{words['see'].format(f'{SECTIONS[name]}.md')}\n"
        yield from section_body(section, language)


def sentence(schema: Mapping[str, Any], language: str) -> str:
    """The description of a key as a sentence."""
    found = in_language(schema.get("description", ""), language)
    text = " ".join((LOADS.get(found, found) if language == "zh" else found).replace("``", "`").split())
    stop = "。" if language == "zh" else "."
    return text[:1].upper() + text[1:] + (stop if text and not text.endswith((".", "。")) else "")


def section_body(schema: Mapping[str, Any], language: str) -> Iterator[str]:
    """Tables of a section's keys, one for each kind."""
    words = FILE_WORDS[language]
    inner = schema.get("additionalProperties")
    if isinstance(inner, Mapping) and ("properties" in inner or "oneOf" in inner):
        schema = inner
    kinds = [each for each in schema.get("oneOf", [schema]) if "properties" in each]
    for kind in kinds:
        if len(kinds) > 1:
            yield f"### {kind.get('title') or ', '.join(kind['properties'])}\n"
            if "description" in kind:
                yield f"{sentence(kind, language)}\n"
        yield f"{words['head']}\n|---|---|---|"
        for key, value in kind["properties"].items():
            needed = words["required"] if key in kind.get("required", ()) else ""
            meaning, written = cell(sentence(value, language)), cell(form(value).translate(language))
            yield f"| `{key}`{needed} | {meaning} | {written} |"
        yield ""


def cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")


def plain(line: str) -> str:
    """Markdown's special characters escaped outside of code."""
    parts = line.split("`")
    return "`".join(re.sub(r"([*<>$\[\]|#])", r"\\\1", p) if i % 2 == 0 else p for i, p in enumerate(parts))


# functions --------------------------------------------------------------------------------------
FUNCTION_WORDS = {
    "en": (
        "Functions and examples of them",
        "Every public name of `linkwright`, with the pages whose examples use it; all examples are run by the tests.",
        "| name | description | examples |",
    ),
    "zh": (
        "函数一览",
        "`linkwright` 的全部公开名称，以及用到它的示例页；所有示例都由测试运行。名称链接到英文的 API 说明。",
        "| 名称 | 是什么 | 示例 |",
    ),
}
FENCE = re.compile(r"^ *```python[^\n]*\n(.*?)^ *```", re.MULTILINE | re.DOTALL)


def functions(language: str) -> Iterator[str]:
    """Public names with the pages that have a runnable example of them."""
    title, intro, head = FUNCTION_WORDS[language]
    yield f"# {title}\n\n{intro}\n\n{head}\n|---|---|---|"
    shown, sections = names_shown(language), api_sections()
    english = {} if language == "en" else names_shown("en")
    for name in sorted(PUBLIC, key=str.lower):
        text = NAMES.get(name, "") if language == "zh" else plain(first_line(getattr(lw, name)))
        pages = (shown.get(name) or english[name])[:3]
        links = ", ".join(
            f"[{heading(each)}]({Path(os.path.relpath(each, ROOT / language)).as_posix()})" for each in pages
        )
        where = "api.md" if language == "en" else "../en/api.md"
        yield f"| [`{name}`]({where}#{sections[name]}) | {cell(text)} | {links} |"


def api_sections() -> dict[str, str]:
    """Public names, with the anchor of the section of ``api.md`` that documents them."""
    found, anchor = {}, ""
    for line in (ROOT / "en/api.md").read_text("utf-8").splitlines():
        if line.startswith("## "):
            anchor = re.sub("[^a-z-]", "", line[3:].lower().replace(" ", "-"))
        if directive := re.fullmatch(r"\.\. auto(?:function|class|exception):: (\w+)", line):
            found[directive[1]] = anchor
    return found


def first_line(value: Any) -> str:
    """The first sentence of a docstring."""
    return (inspect.getdoc(value) or "").partition("\n\n")[0].replace("``", "`").replace("\n", " ")


def heading(page: Path) -> str:
    """The title of a page."""
    return page.read_text("utf-8").partition("\n")[0].removeprefix("# ")


@cache
def names_shown(language: str) -> dict[str, list[Path]]:
    """Pages of a language by the names of ``linkwright`` that their Python examples use; how-tos first."""
    found: dict[str, list[Path]] = {}
    for page in sorted((ROOT / language).rglob("*.md"), key=lambda each: ("how-to" not in each.parts, each)):
        for body in FENCE.findall(page.read_text("utf-8")):
            for node in ast.walk(ast.parse(textwrap.dedent(body))):
                for name in used(node):
                    if page not in found.setdefault(name, []):
                        found[name].append(page)
    return found


def used(node: ast.AST) -> list[str]:
    """Names of the package that one node of a program takes from it."""
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "lw":
        return [node.attr]
    if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("linkwright"):
        return [each.name for each in node.names]
    return []


# codes ------------------------------------------------------------------------------------------
CODE_WORDS = {
    "en": {
        "title": "Codes of findings and errors",
        "intro": """\
Every finding and every error has a **code**, a short word for programs: `Finding.code`, `LinkwrightError.code`, and
`"code"` in what `linkwright check --json` and every refused command with `--json` print. `values` holds, by name, the
values in the message: numbers, names, units. The wording of a message may change with any version, and there are
several languages; a code does not change, and neither does its meaning. So programs should compare codes and
read values:""",
        "files": "Findings about files",
        "code": "| code | meaning |\n|---|---|",
        "calculations": "Findings about calculations and motion programs",
        "sentence": "| code | message |\n|---|---|",
        "errors": "Errors",
        "parts": """\
The code of an error is `AREA.WORD`; an error that wraps another one (`--at: …`) has the code of that one, and a
`ModelError` the code of its first error. Invalid quantities (`QuantityError`) have the codes of findings.
The areas:""",
        "areas": "| area | about | examples |\n|---|---|---|",
    },
    "zh": {
        "title": "检查结果与错误的代码",
        "intro": """\
每条检查结果和每个错误都有一个**代码**，即供程序使用的短词：`Finding.code`、`LinkwrightError.code`，
以及 `linkwright check --json` 和带 `--json` 的命令被拒绝时输出的 `"code"`。
`values` 按名称给出句子所涉及的内容：数、名称、单位。句子的措辞可以随版本改变，语言也不止一种；
代码则不变，也不改变含义。因此程序应比较代码、读取 `values`：""",
        "files": "关于文件的检查结果",
        "code": "| 代码 | 问题 |\n|---|---|",
        "calculations": "关于计算和运动规律的检查结果",
        "sentence": "| 代码 | 句子 |\n|---|---|",
        "errors": "错误",
        "parts": """\
错误的代码是“领域.词”；转述另一错误的错误（`--at：…`）用后者的代码，`ModelError` 用其第一个错误的代码。
不是物理量的文本（`QuantityError`）用检查结果的代码。部分领域：""",
        "areas": "| 领域 | 关于 | 例如 |\n|---|---|---|",
    },
}
CODE_EXAMPLE = """\
```python
import linkwright as lw

try:
    lw.solve_motion(lw.load("gallery:crank_rocker"), steps=0)
except lw.LinkwrightError as error:
    print(error.code, error.values["value"])
# given_instead.no_whole_from 0
```
"""


def codes(language: str) -> Iterator[str]:
    """The codes of findings with what they mean, and those of errors by area."""
    words = CODE_WORDS[language]
    yield f"# {words['title']}\n\n{words['intro']}\n\n{CODE_EXAMPLE}"
    yield f"## {words['files']}\n\n{words['code']}"
    for code in sorted(coded.of_findings()):
        yield f"| `{code}` | {coded.MEANINGS[code].translate(language)} |"
    yield f"\n## {words['calculations']}\n\n{words['sentence']}"
    for code, text in sorted(coded.of_calculations().items()):
        yield f"| `{code}` | {cell(plain(re.sub('{.*?}', '…', Message(text).translate(language))))} |"
    yield f"\n## {words['errors']}\n\n{words['parts']}\n\n{words['areas']}"
    for area, some in coded.of_errors().items():
        if not some:  # of notes alone
            continue
        shown = ", ".join(f"`{each}`" for each in some[:3])
        yield f"| `{area}` | {coded.AREAS[area].translate(language)} | {shown} |"


if __name__ == "__main__":
    write(reference())
