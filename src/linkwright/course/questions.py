"""Variants as files: sheets, answer key, questions for PrairieLearn, Moodle and QTI."""

from __future__ import annotations

import base64
import io
import json
import re
import uuid
import zipfile
from collections.abc import Callable, Sequence
from functools import partial
from xml.sax.saxutils import escape, quoteattr

from linkwright.core.quantity import shown
from linkwright.core.table import csv_rows
from linkwright.course.mistakes import RPM, passed
from linkwright.course.task import Question
from linkwright.course.variants import Variant, Variants
from linkwright.drivers.base import Law
from linkwright.errors import RequestError, speaker
from linkwright.files.write import to_data
from linkwright.plotting.drawing.draw import draw
from linkwright.plotting.drawing.machine import DIAGONAL
from linkwright.words import Translate, _

#: Width of the pictures of questions, pixels.
PICTURE = 640
#: Maximum and minimum height of a sheet's drawing, of it with the rows of the tables, and of a row, mm; its share of
#: the width.
TALLEST, LOWEST, ROOM, ROW, SHARE = 110.0, 30.0, 196.0, 5.0, 0.8
Files = dict[str, bytes]
#: Axes and signs of answers.
CONVENTION = _(
    "x to the right, y up; angles and moments counter-clockwise positive; angles of a link's x axis in degrees."
)


def files_of(found: Variants, forms: Sequence[str] = (), language: str = "en") -> Files:
    """The files of the forms asked for; all where none is named."""
    chosen = tuple(forms) or tuple(FORMS)
    for form in chosen:
        if form not in FORMS:
            raise RequestError(
                _(
                    'there is no form "{name}"; the forms are {forms}',
                    code="course.no_form",
                    name=form,
                    forms=tuple(FORMS),
                )
            )
    files: Files = {}
    for form in chosen:
        files |= FORMS[form](found, language)
    return files


# what every form says ---------------------------------------------------------------------------
def drawing(found: Variants, each: Variant, language: str, diagonal: float = DIAGONAL) -> str:
    """The machine of a variant as SVG, without numbers that would give answers away."""
    key = each.number, language, diagonal
    if key not in found.drawings:
        motion, index = passed(each.mechanism, found.task.at)
        drawn = draw(motion, position=index, centres=True, language=language, diagonal=diagonal)
        found.drawings[key] = drawn.svg
    return found.drawings[key]


def data_rows(found: Variants, each: Variant, translate: Translate) -> list[tuple[str, str]]:
    """What a variant gives: every dimension of links and frame, loads, input and its rate."""
    from linkwright.reports.sections.task import element_data, kind_of

    model, rows = each.mechanism, []
    for name, (x, y) in model.frame.points.items():
        rows.append((name, f"({1e3 * x:.6g}; {1e3 * y:.6g}) mm"))
    for name, value in model.dimensions().items():
        owner, _unused, key = name.partition(".")
        if owner not in model.links or (key in ("mass", "inertia") and not value):
            continue
        rows.append((name, _quantity(key, value)))
    for driver in model.drivers.values():
        rows.append((f"{driver.link} ({driver.joint})", _speed(driver.law)))
    data = to_data(model)
    for name, data_text in [*data.get("joints", {}).items(), *data.get("loads", {}).items()]:
        rows.append(
            (name, translate(_("; ")).join([kind_of(data_text, translate), element_data(data_text, translate)]))
        )
    if any(model.gravity):
        rows.append(("g", f"({model.gravity[0]:g}; {model.gravity[1]:g}) m/s²"))
    return rows


def _speed(law: Law) -> str:
    """A constant speed as machines state it."""
    speed = law.constant_speed
    assert speed is not None
    return f"{speed / RPM:.6g} rpm" if law.rotary else shown(speed, "velocity")


def _quantity(key: str, value: float) -> str:
    last = key.rpartition(".")[2]
    if last == "mass":
        return shown(value, "mass")
    if last == "inertia":
        return shown(value, "inertia")
    return shown(value, "angle") if last == "angle" else shown(value, "length")


def position_text(found: Variants, translate: Translate) -> str:
    """The position asked for, in words."""
    driver = next(iter(found.task.mechanism.drivers.values()))
    turning = found.task.mechanism.joints[driver.joint].coordinate == "turn"
    place = shown(found.task.at, "angle") if turning else shown(found.task.at, "length")
    return translate(_("Position: {link} at {input}.", input=place, link=driver.link))


def slug(name: str) -> str:
    """A name for files: letters, digits, hyphens."""
    return re.sub(r"[^A-Za-z0-9]+", "-", name).strip("-").lower() or "mechanism"


def mark(question: Question) -> str:
    """A question's name as identifiers allow it."""
    return re.sub(r"\W+", "_", question.name, flags=re.ASCII).strip("_")


def braceless(text: str) -> str:
    """A text or quoted attribute of a page on which braces mean something to the platform."""
    return text.replace("{", "&#123;").replace("}", "&#125;")


# sheets and key ---------------------------------------------------------------------------------
def sheets(found: Variants, language: str) -> Files:
    """One page per variant: drawing, data, numbers asked for."""
    from linkwright.reports.document import Block, Document, Figure, Heading, Paragraph, Source, Table, literal
    from linkwright.reports.pictures import font_scaling
    from linkwright.reports.typst_pages import compiled

    translate = speaker(language)
    document = Document(translate(_("Exercise: {name}", name=found.name)), translate, language, contents=False)
    for each in found.variants:
        page: list[Block] = [] if each.number == 1 else [Source("#pagebreak()")]
        page.append(Heading(translate(_("Variant {number}", number=each.number)), number=False))
        page.append(Paragraph(translate(_("Name: ……………………………………  Number: ………………………"))))
        page.append(Paragraph(literal(position_text(found, translate)) + " " + translate(CONVENTION)))
        rows = tuple((literal(a), literal(b)) for a, b in data_rows(found, each, translate))
        left = ROOM - ROW * (len(rows) + len(found.task.questions))
        tallest = min(max(left, LOWEST), TALLEST)
        shown = font_scaling(partial(drawing, found, each, language), SHARE, tallest)
        page.append(Figure(literal(found.name), ((shown, SHARE),), tallest=tallest))
        page.append(Table(translate(_("Given")), (translate(_("name")), translate(_("value"))), rows, "<<"))
        asked = tuple((literal(q.text(language)), "…" * 14, q.unit) for q in found.task.questions)
        page.append(
            Table(
                translate(_("Wanted")),
                (translate(_("name")), translate(_("answer")), translate(_("unit"))),
                asked,
                "<<<",
            )
        )
        document.blocks += page
    return {"sheets.pdf": compiled(document, "pdf")}


def key(found: Variants, language: str) -> Files:
    """The answer key: JSON for ``grade``, CSV to read, and an empty sheet of answers to fill in."""
    names = [f"{q.name} [{q.unit}]" for q in found.task.questions]
    right = [["variant", *found.task.ranges, *names]]
    right += [[str(v.number), *(f"{x:.6g}" for x in (*v.dimensions.values(), *v.answers))] for v in found.variants]
    empty = [["student", "variant", *(q.name for q in found.task.questions)]]
    return {
        "key.json": found.key_text().encode(),
        "key.csv": csv_rows(right).encode(),
        "answers.csv": csv_rows(empty).encode(),
    }


# PrairieLearn -----------------------------------------------------------------------------------
def prairielearn(found: Variants, language: str) -> Files:
    """A question's folder: information, page, server, pictures; the server picks a variant."""
    translate = speaker(language)
    folder = f"prairielearn/{slug(found.name)}"
    info = {
        "uuid": str(uuid.uuid5(uuid.NAMESPACE_URL, f"linkwright:{found.name}:{found.seed}:{len(found.variants)}")),
        "title": found.name,
        "topic": translate(_("Theory of machines")),
        "tags": ["linkwright", "numeric"],
        "type": "v3",
    }
    tolerance = f"{found.task.tolerance:g}"
    inputs = "\n".join(
        f"<p><pl-number-input answers-name={quoteattr(mark(q))} label={braceless(quoteattr(q.text(language)))} "
        f'suffix={quoteattr(q.unit)} comparison="relabs" rtol="{tolerance}" '
        f'atol="{_slack(found, i):.3g}"></pl-number-input></p>'
        for i, q in enumerate(found.task.questions)
    )
    page = (
        f"<pl-question-panel>\n<p>{braceless(escape(position_text(found, translate)))} "
        f"{escape(translate(CONVENTION))}</p>\n"
        '<pl-figure file-name="{{params.picture}}"></pl-figure>\n'
        f"<table>{{{{#params.rows}}}}<tr><td>{{{{name}}}}</td><td>{{{{value}}}}</td></tr>{{{{/params.rows}}}}</table>\n"
        f"</pl-question-panel>\n{inputs}\n"
    )
    data = [
        {
            "picture": f"variant-{v.number}.svg",
            "rows": [{"name": a, "value": b} for a, b in data_rows(found, v, translate)],
            "answers": {mark(q): a for q, a in zip(found.task.questions, v.answers, strict=True)},
        }
        for v in found.variants
    ]
    pictures = {
        f"{folder}/clientFilesQuestion/variant-{v.number}.svg": drawing(found, v, language).encode()
        for v in found.variants
    }
    return {
        f"{folder}/info.json": json.dumps(info, ensure_ascii=False, indent=2).encode(),
        f"{folder}/question.html": page.encode(),
        f"{folder}/server.py": SERVER.encode(),
        f"{folder}/variants.json": json.dumps(data, ensure_ascii=False).encode(),
        **pictures,
    }


SERVER = '''\
import json
import random
from pathlib import Path


def generate(data):
    """Picks one of the variants next to this file."""
    variants = json.loads((Path(__file__).parent / "variants.json").read_text("utf-8"))
    chosen = random.choice(variants)
    data["params"]["picture"] = chosen["picture"]
    data["params"]["rows"] = chosen["rows"]
    data["correct_answers"].update(chosen["answers"])
'''


def _slack(found: Variants, index: int) -> float:
    """Absolute tolerance of a question: half a degree per hundredth for angles, else next to nothing."""
    if found.task.questions[index].unit == "°":
        return 50.0 * found.task.tolerance
    return 1e-6 * max(abs(each.answers[index]) for each in found.variants)


# Moodle -----------------------------------------------------------------------------------------
def moodle(found: Variants, language: str) -> Files:
    """A question bank: one question with embedded numerical answers per variant, all in one category."""
    translate = speaker(language)
    category = f"$course$/top/{found.name.replace('/', '//')}"
    parts = [
        '<?xml version="1.0" encoding="UTF-8"?>\n<quiz>\n<question type="category"><category>'
        f"<text>{escape(category)}</text></category></question>"
    ]
    for each in found.variants:
        picture = base64.b64encode(drawing(found, each, language).encode()).decode()
        name = f"variant-{each.number}.svg"
        text = (
            f"<p>{braceless(escape(position_text(found, translate)))} {escape(translate(CONVENTION))}</p>"
            f'<p><img src="@@PLUGINFILE@@/{name}" alt={braceless(quoteattr(found.name))} width="{PICTURE}"/></p>'
            f"{braceless(_html_table(data_rows(found, each, translate)))}"
            + "".join(
                f"<p>{braceless(escape(q.text(language)))} = {{1:NUMERICAL:={a:.8g}:{_width(found, i, a):.3g}}} "
                f"{escape(q.unit)}</p>"
                for i, (q, a) in enumerate(zip(found.task.questions, each.answers, strict=True))
            )
        )
        parts.append(
            f'<question type="cloze"><name><text>{escape(found.name)} {each.number:03d}</text></name>'
            f'<questiontext format="html"><text><![CDATA[{text}]]></text>'
            f'<file name="{name}" path="/" encoding="base64">{picture}</file></questiontext>'
            '<generalfeedback format="html"><text></text></generalfeedback><penalty>0.1</penalty>'
            "<hidden>0</hidden></question>"
        )
    return {"moodle.xml": "\n".join([*parts, "</quiz>\n"]).encode()}


def _width(found: Variants, index: int, answer: float) -> float:
    """Absolute width of a right answer."""
    return max(found.task.tolerance * abs(answer), _slack(found, index))


def _html_table(rows: list[tuple[str, str]]) -> str:
    cells = "".join(f"<tr><td>{escape(a)}</td><td>{escape(b)}</td></tr>" for a, b in rows)
    return f"<table><tbody>{cells}</tbody></table>"


# QTI 2.1 ----------------------------------------------------------------------------------------
def qti(found: Variants, language: str) -> Files:
    """A content package of QTI 2.1: one item per variant, numbers compared with a tolerance."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as package:
        names = []
        for each in found.variants:
            name = f"variant-{each.number}"
            names.append(name)
            _put(package, f"{name}.xml", item(found, each, language))
            _put(package, f"images/{name}.svg", drawing(found, each, language))
        _put(package, "imsmanifest.xml", manifest(names))
    return {"qti.zip": stream.getvalue()}


def _put(package: zipfile.ZipFile, name: str, text: str) -> None:
    """An entry without the time of its making, so that the same variants give the same file."""
    package.writestr(zipfile.ZipInfo(name, (2020, 1, 1, 0, 0, 0)), text.encode())


def item(found: Variants, each: Variant, language: str) -> str:
    """One assessment item."""
    translate = speaker(language)
    asked = list(zip(found.task.questions, each.answers, strict=True))
    declared = "".join(
        f'<responseDeclaration identifier="R{i}" cardinality="single" baseType="float"><correctResponse>'
        f"<value>{answer:.8g}</value></correctResponse></responseDeclaration>"
        for i, (_unused, answer) in enumerate(asked)
    )
    lines = "".join(
        f'<p>{escape(q.text(language))} = <textEntryInteraction responseIdentifier="R{i}" expectedLength="12"/> '
        f"{escape(q.unit)}</p>"
        for i, (q, _unused) in enumerate(asked)
    )
    rules = "".join(
        '<responseCondition><responseIf><equal toleranceMode="absolute" '
        f'tolerance="{_width(found, i, answer):.6g} {_width(found, i, answer):.6g}"><variable identifier="R{i}"/>'
        f'<correct identifier="R{i}"/></equal><setOutcomeValue identifier="SCORE"><sum><variable identifier="SCORE"/>'
        f'<baseValue baseType="float">1</baseValue></sum></setOutcomeValue></responseIf></responseCondition>'
        for i, (_unused, answer) in enumerate(asked)
    )
    text = (
        f"<p>{escape(position_text(found, translate))} {escape(translate(CONVENTION))}</p>"
        f'<p><img src="images/variant-{each.number}.svg" alt={quoteattr(found.name)}/></p>'
        f"{_html_table(data_rows(found, each, translate))}{lines}"
    )
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<assessmentItem xmlns="http://www.imsglobal.org/xsd/imsqti_v2p1" '
        'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" '
        'xsi:schemaLocation="http://www.imsglobal.org/xsd/imsqti_v2p1 '
        'http://www.imsglobal.org/xsd/qti/qtiv2p1/imsqti_v2p1.xsd" '
        f'identifier="variant-{each.number}" title={quoteattr(found.name)} adaptive="false" timeDependent="false">'
        f'{declared}<outcomeDeclaration identifier="SCORE" cardinality="single" baseType="float"><defaultValue>'
        f"<value>0</value></defaultValue></outcomeDeclaration><itemBody>{text}</itemBody>"
        f"<responseProcessing>{rules}</responseProcessing></assessmentItem>\n"
    )


def manifest(names: list[str]) -> str:
    """The package's list of contents."""
    resources = "".join(
        f'<resource identifier="{name}" type="imsqti_item_xmlv2p1" href="{name}.xml"><file href="{name}.xml"/>'
        f'<file href="images/{name}.svg"/></resource>'
        for name in names
    )
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<manifest xmlns="http://www.imsglobal.org/xsd/imscp_v1p1" identifier="linkwright-variants">'
        "<metadata><schema>QTIv2.1 Package</schema><schemaversion>1.0.0</schemaversion></metadata>"
        f"<organizations/><resources>{resources}</resources></manifest>\n"
    )


FORMS: dict[str, Callable[[Variants, str], Files]] = {
    "sheets": sheets,
    "key": key,
    "prairielearn": prairielearn,
    "moodle": moodle,
    "qti": qti,
}
