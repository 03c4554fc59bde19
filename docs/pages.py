"""Pages that are made when the documentation is built: gallery, model files, API, published numbers.

They have the ending ``.markdown``, are no part of the repository, and stand in ``docs/made``.
"""

from __future__ import annotations

import hashlib
import inspect
import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from importlib.resources import files
from pathlib import Path
from typing import Any

import linkwright as lw
from linkwright import gallery
from linkwright.cli.source import gallery_title
from linkwright.errors import LinkwrightError
from linkwright.validation.validate import validate

ROOT = Path(__file__).parent
MADE = ROOT / "made"
#: What is copied into the built documentation as it is.
EXTRA = MADE / "extra"
#: Positions of the living pages.
STEPS = 240
TITLES = {"en": "Gallery", "zh": "图库"}
WORDS = {
    "en": {
        "solve": "Try it",
        "file": "The model file",
        "structure": "Structure",
        "source": "Source",
        "living": "The machine, to be played and dragged",
        "drag": "Drag a joint: the browser solves motion, forces and design numbers again by the same formulas.",
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
    """Writes all of them, those that are up to date left alone."""
    pictures()
    living_pages()
    for language in ("en", "zh"):
        write(f"{language}/gallery/index", "\n".join(gallery_index(language)))
        for name in gallery.names():
            write(f"{language}/gallery/{name}", "\n".join(gallery_page(name, language)))
    write("en/model_file", "\n".join(model_file()))
    write("en/api", "\n".join(api()))
    write("en/validation_table", f"{validate().markdown()}\n")


def write(name: str, text: str) -> None:
    """A page, unless it stands there already: then nothing is built anew."""
    path = MADE / f"{name}.markdown"
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text("utf-8") != text:
        path.write_text(text, "utf-8")


# gallery ----------------------------------------------------------------------------------------
def pictures() -> None:
    """A drawing per model; one that cannot be put together has none."""
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
    """The living page of every model that can be put together; one that is up to date is left alone."""
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
        model = lw.load(f"gallery:{name}")
        title = gallery_title(name, model.name, language)
        yield f":::{{grid-item-card}} {title}\n:link: {name}\n:link-type: doc\n:img-top: ../../pictures/{name}.svg\n"
        yield f"{first_sentence(model.purpose) if language == 'en' else ''}\n:::\n"
    yield "::::\n"
    yield "```{toctree}\n:hidden:\n"
    yield from gallery.names()
    yield "```"


def first_sentence(text: str) -> str:
    """The beginning of a purpose, up to its first semicolon."""
    return escaped(text.partition(";")[0])


def gallery_page(name: str, language: str) -> Iterator[str]:
    """One model: picture, purpose, source, commands, structure, file."""
    model, words = lw.load(f"gallery:{name}"), WORDS[language]
    yield f"# {gallery_title(name, model.name, language)}\n"
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
    """A text in which no sign has a meaning of its own."""
    return re.sub(r"([\\`*_{}\[\]<>#$|])", r"\\\1", text)


# model files ------------------------------------------------------------------------------------
def model_file() -> Iterator[str]:
    """Every section and key of a model file, from its schema."""
    schema = lw.json_schema()
    yield "# Model file reference\n"
    yield (
        "Generated from the schema that `linkwright schema` prints and editors complete from. A quantity is written "
        'with its unit (`"60.5 mm"`) or as an expression of `parameters`; the right column shows the form.\n'
    )
    for name, section in schema["properties"].items():
        yield f"## `{name}`{' (required)' if name in schema.get('required', ()) else ''}\n"
        yield f"{sentence(section)}\n"
        yield from section_body(section)


def sentence(schema: Mapping[str, Any]) -> str:
    """What a key is, in its own words."""
    text = " ".join(str(schema.get("description", "")).replace("``", "`").split())
    return text[:1].upper() + text[1:] + ("" if text.endswith((".", "")[0]) or not text else ".")


def section_body(schema: Mapping[str, Any]) -> Iterator[str]:
    """Tables of a section's keys, one for each kind where there are several."""
    inner = schema.get("additionalProperties")
    if isinstance(inner, Mapping) and ("properties" in inner or "oneOf" in inner):
        schema = inner
    kinds = schema.get("oneOf") or ([schema] if "properties" in schema else [])
    for kind in kinds:
        if len(kinds) > 1:
            yield f"### {kind.get('title') or ', '.join(kind['properties'])}\n"
            if "description" in kind:
                yield f"{sentence(kind)}\n"
        yield "| key | meaning | form |\n|---|---|---|"
        for key, value in kind["properties"].items():
            needed = " (required)" if key in kind.get("required", ()) else ""
            yield f"| `{key}`{needed} | {cell(sentence(value))} | {cell(form(value))} |"
        yield ""


def cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")


def form(schema: Mapping[str, Any]) -> str:
    """How a value is written."""
    if "enum" in schema:
        return ", ".join(f"`{each}`" for each in schema["enum"])
    if "x-dimension" in schema:
        return f"{schema['x-dimension'].replace('_', ' ')}, `{schema['examples'][0]}`" if "examples" in schema else \
            str(schema["x-dimension"])  # fmt: skip
    if "x-reference" in schema:
        return f"name of a {schema['x-reference']}"
    if schema.get("type") == "array" and isinstance(schema.get("items"), Mapping):
        least, most = schema.get("minItems"), schema.get("maxItems")
        count = f"{least} " if least == most and least else ""
        return f"list of {count}({form(schema['items'])})"
    options = schema.get("anyOf") or schema.get("oneOf")
    if options:
        return " or ".join(dict.fromkeys(filter(None, map(form, options))))
    kind = schema.get("type", "")
    return " or ".join(kind) if isinstance(kind, list) else str(kind)


# API --------------------------------------------------------------------------------------------
def api() -> Iterator[str]:
    """Every public name with its signature and docstring."""
    yield "# API reference\n"
    yield "Public names of `linkwright`, generated from their docstrings. Quantities are SI, angles radians.\n"
    for module, names in sorted(lw.PUBLIC.items()):
        for name in names:
            value = getattr(__import__(module, fromlist=[name]), name)
            yield f"## `{name}`\n"
            yield f"```text\n{name}{signature(value)}\n```\n"
            yield f"From `{module}`.\n"
            yield f"{docstring(value)}\n"
            if inspect.isclass(value):
                yield from members(value)


def signature(value: Any) -> str:
    """How it is called, annotations shortened."""
    try:
        found = str(inspect.signature(value))
    except (TypeError, ValueError):
        return ""
    found = re.sub(r"(: |-> )'([^']*)'", r"\1\2", found)
    found = re.sub(r"\b(?:[a-z_]\w*\.)+([A-Z]\w*)", r"\1", found)
    return found if len(found) < 90 else found.replace("(", "(\n    ", 1).replace(", ", ",\n    ")


def docstring(value: Any) -> str:
    """A docstring as Markdown: headings of its parts bold, arguments as a list."""
    text = inspect.getdoc(value) or ""
    lines: list[str] = []
    for line in text.replace("``", "`").splitlines():
        head = re.fullmatch(r"(Args|Returns|Raises|Attributes|Examples?):", line)
        item = re.match(r"    (\*{0,2}\w[\w, *]*): (.*)", line)
        if head:
            lines += ["", f"**{head[1]}**", ""]
        elif item:
            lines.append(f"- `{item[1]}`: {plain(item[2])}")
        elif line.startswith("    "):
            lines.append(("  " if lines and lines[-1].startswith(("-", "  ")) else "") + plain(line.strip()))
        else:
            lines.append(plain(line))
    return "\n".join(lines)


def plain(line: str) -> str:
    """Signs outside of code without a meaning of their own."""
    parts = line.split("`")
    return "`".join(re.sub(r"([*<>$\[\]|#])", r"\\\1", p) if i % 2 == 0 else p for i, p in enumerate(parts))


def members(value: type) -> Iterator[str]:
    """Methods and properties that are documented, one line each."""
    rows = []
    for name, member in vars(value).items():
        if name.startswith("_") or not inspect.getdoc(member) or isinstance(member, type):
            continue
        if not (callable(member) or isinstance(member, property) or hasattr(member, "func")):
            continue
        call = signature(member).split(" ->")[0] if inspect.isfunction(member) else ""
        short = re.sub(r"\s+", " ", call.replace("self, ", "").replace("(self)", "()"))
        text = (inspect.getdoc(member) or "").replace("``", "`").split("\n\n")[0].replace("\n", " ")
        rows.append(f"- `{name}{short}`: {plain(text)}")
    if rows:
        yield "\n".join(rows) + "\n"


if __name__ == "__main__":
    make()
