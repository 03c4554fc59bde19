"""The file of a living page: model, kernels, words and front end in one text, which notebooks show and files keep."""

from __future__ import annotations

import base64
import hashlib
import json
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from html import escape
from importlib.resources import files
from pathlib import Path

import numpy as np

from linkwright.core.arguments import STEPS, require
from linkwright.core.data import Plain
from linkwright.core.inputs import mode_inputs
from linkwright.core.outputs import row_name
from linkwright.files.model_file import read_text
from linkwright.files.write import Document, dump
from linkwright.filesystem import atomic_write
from linkwright.formula.wasm import wasm_module
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.placement import placements
from linkwright.kinematics.solve import solve_motion
from linkwright.mechanism.mechanism import Mechanism
from linkwright.page.glyphs import RackWay, Wheels, contact_shape, glyphs, undrawn
from linkwright.page.inputs import dimensions, drawn, packed, positions
from linkwright.page.programs import SIZES, PagePrograms
from linkwright.page.quantities import numbers, point_keys, signals, usual_curves
from linkwright.page.texts import TEXTS
from linkwright.plotting.drawing.machine import DrawnMechanism, fitted
from linkwright.words import LANGUAGES, _
from linkwright.words.message import in_language

_TAGS = {"zh": "zh-CN"}


def solved(machine: Mechanism | Document, steps: int) -> tuple[Motion, str | None]:
    """The motion of a machine over its cycle, and the text of its file where there is one."""
    require(machine, Mechanism, Document)
    mechanism, text = (machine, None) if isinstance(machine, Mechanism) else (machine.mechanism, machine.text)
    return solve_motion(mechanism, steps=steps), text


def page(models: Sequence[tuple[Motion, str | None]], language: str = "en") -> str:
    """The text of a page with machines side by side, each with its motion and the text of its file."""
    name = ", ".join(dict.fromkeys(in_language(motion.mechanism.name, language) for motion, _unused in models))
    title = _("{name}: living page", name=name).translate(language)
    return document(page_data(models, language), title, language)


def page_data(models: Sequence[tuple[Motion, str | None]], language: str) -> Plain:
    """What a page is made of as plain data."""
    words = {each: {key: text.translate(each) for key, text in TEXTS.items()} for each in LANGUAGES}
    return {"language": language, "words": words, "models": [_model(*each) for each in models]}


def _model(motion: Motion, text: str | None) -> Plain:
    text = dump(motion.mechanism) if text is None else text
    programs = PagePrograms(motion)
    values = programs.values()
    known = signals(programs)
    machine = _machine(motion)
    document = Document(text, "model", read_text)
    changeable = dimensions(document, set(values))
    return {
        **_texts(motion.mechanism, text),
        "module": base64.b64encode(wasm_module(programs.main)).decode(),
        "program": programs.main.names,
        "values": values,
        "tables": {name: table.numbers.tolist() for name, table in programs.tables.items()},
        "sizes": SIZES,
        "dimensions": [each.data() for each in changeable],
        "drawing": drawn(document, motion),
        "positions": positions(motion, programs.arrays(), mode_inputs(programs.solver.assembly.modes)),
        "fields": {name: packed(row) for name, row in programs.fields().items()},
        "starts": programs.starts,
        "held": programs.held,
        "phases": programs.phases,
        "angles": programs.angles,
        "friction": programs.friction(),
        "bends": programs.bends,
        "groups": _groups(programs),
        "signals": list(known.values()),
        "numbers": numbers(programs, known),
        "curves": usual_curves(programs, known),
        "points": point_keys(programs),
        "glyphs": glyphs(machine, int(np.argmax(motion.ok))),
        "undrawn": undrawn(machine),
        "masses": [name for name, link in motion.mechanism.links.items() if link.mass],
    }


def _texts(mechanism: Mechanism, text: str) -> Plain:
    """Name, purpose and source in every language; the text of the file."""
    texts_of_model = {"name": mechanism.name, "purpose": mechanism.purpose, "source": mechanism.source}
    translated = {
        key: {each: in_language(given, each) for each in LANGUAGES} for key, given in texts_of_model.items()
    }
    return {**translated, "text": text}


def _machine(motion: Motion) -> DrawnMechanism:
    placed = placements(motion)
    return DrawnMechanism(motion, placed, fitted(motion, placed))


def _groups(programs: PagePrograms) -> list[Plain]:
    placed = programs.solver.motion.placed
    return [
        {
            "name": each.name,
            "signature": each.signature,
            "links": list(each.links),
            "facts": list(placed[each.name].facts),
            "wheels": _wheels(programs, each.links),
            "dyad": row_name("quality", each.name) in programs.main.output_names,
        }
        for each in programs.solver.structure.groups
    ]


def _wheels(programs: PagePrograms, links: Sequence[str]) -> list[str]:
    """Pairs of wheels and racks of a group, whose sizes may not fit the distance of their centres or lines."""
    mechanism = programs.mechanism
    return [
        name
        for name, joint in mechanism.joints.items()
        if isinstance(contact_shape(joint, mechanism), Wheels | RackWay) and not set(joint.joined).isdisjoint(links)
    ]


def document(data: Plain, title: str, language: str) -> str:
    """The page's text; its own scripts and styles are the only ones that may run, by their hashes.

    All but the script that unpacks the rest is compressed: the length of a JSON text (4 bytes, little-endian), that
    text, and the modules of the models one after the other.
    """
    style, script = _built("page.css"), _built("page.js")
    modules = [base64.b64decode(each["module"]) for each in data["models"]]
    models = [{**each, "module": len(module)} for each, module in zip(data["models"], modules, strict=True)]
    content = {"style": style, "script": script, "data": {**data, "models": models}}
    text = json.dumps(content, ensure_ascii=False, separators=(",", ":")).encode()
    # Scripts, numbers and modules differ: with little memory they come in blocks with codes of their own.
    packer = zlib.compressobj(9, memLevel=6)
    packed = packer.compress(b"".join([len(text).to_bytes(4, "little"), text, *modules])) + packer.flush()
    # Four bytes in five characters; none of them opens a tag.
    written = base64.b85encode(packed).replace(b"<", b",").decode()
    unpack = _built("unpack.js")
    hashes = " ".join(f"'sha256-{_hash(each)}'" for each in (unpack, script))
    policy = (
        f"default-src 'none'; script-src {hashes} 'wasm-unsafe-eval'; style-src 'sha256-{_hash(style)}'; "
        "img-src data: blob:; base-uri 'none'; form-action 'none'"
    )
    opening = _("Opening … This page needs scripts, and a browser of 2023 or later.").translate(language)
    return (
        f'<!doctype html>\n<html lang="{_TAGS.get(language, language)}">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f'<meta name="color-scheme" content="light dark">\n<title>{escape(title)}</title>\n'
        f'</head>\n<body>\n<div id="page">{escape(opening)}</div>\n'
        f'<script type="text/plain" id="packed">{written}</script>\n'
        f"<script>{unpack}</script>\n</body>\n</html>\n"
    )


@cache
def _built(name: str) -> str:
    """A built file of the front end."""
    return (files("linkwright") / "page" / "built" / name).read_text(encoding="utf-8").strip()


def _hash(text: str) -> str:
    return base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()


@dataclass(frozen=True)
class LivingPage:
    """A living page: ``html`` is the complete file. Notebooks show it in a frame, ``height`` pixels tall."""

    html: str
    height: int = 720

    def save(self, path: str | Path, *, force: bool = False) -> Path:
        """Writes the file atomically.

        Raises LinkwrightError where it cannot be written, and for a file that is there already unless ``force``.
        """
        return atomic_write(path, self.html.encode(), force=force)

    def _repr_html_(self) -> str:
        return (
            f'<iframe srcdoc="{escape(self.html)}" sandbox="allow-scripts allow-downloads" '
            f'style="width:100%;height:{self.height}px;border:0"></iframe>'
        )

    def __repr__(self) -> str:
        return f"LivingPage({len(self.html)} characters)"


def living_page(
    machine: Mechanism | Document, *compared: Mechanism | Document, steps: int = STEPS, language: str = "en"
) -> LivingPage:
    """The living page of a machine, with others for comparison.

    Args:
        machine: a mechanism, or a document, whose text the page gives back with the changed numbers.
        *compared: further ones on the same page.
        steps: positions over the cycle.
        language: ``en`` or ``zh``, in which it opens.

    Raises:
        PositionError: a position of a cycle cannot be reached.
        StructureError, AssemblyError, CycleError: as :func:`linkwright.solve_motion`.
    """
    return LivingPage(page([solved(each, steps) for each in (machine, *compared)], language))
