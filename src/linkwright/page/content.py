"""The file of a living page: model, kernels, words and front end in one text, and the quantities that it can plot."""

from __future__ import annotations

import base64
import hashlib
import json
import re
import string
import zlib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from html import escape
from importlib.resources import files
from pathlib import Path

import numpy as np

from linkwright.analysis.outputs import mechanism_outputs
from linkwright.core.arguments import STEPS, require
from linkwright.core.arrays import Floats
from linkwright.core.data import Plain
from linkwright.core.inputs import mode_inputs
from linkwright.core.outputs import KINDS, Output, row_name, row_names
from linkwright.files.model_file import read_text
from linkwright.files.write import Document, dump
from linkwright.filesystem import atomic_write
from linkwright.formula.wasm import wasm_module
from linkwright.kinematics.motion import Motion
from linkwright.kinematics.names import canonical
from linkwright.kinematics.placement import placements
from linkwright.kinematics.solve import solve_motion
from linkwright.kinetostatics.forces import reaction_pairs
from linkwright.mechanism.mechanism import Mechanism
from linkwright.page.glyphs import RackWay, Wheels, contact_shape, glyphs, undrawn
from linkwright.page.inputs import dimensions, drawn, packed, positions
from linkwright.page.programs import SIZES, PagePrograms
from linkwright.page.texts import TEXTS
from linkwright.plotting.drawing.machine import DrawnMechanism, fitted
from linkwright.words import LANGUAGES, Message, _
from linkwright.words.message import in_language

_TAGS = {"zh": "zh-CN"}
#: Four bytes in five characters that follow each other; none of them opens a tag.
_DIGITS = bytes.maketrans(
    (string.digits + string.ascii_uppercase + string.ascii_lowercase + "!#$%&()*+-;<=>?@^_`{|}~").encode(),
    bytes(range(40, 125)).replace(b"<", b"!"),
)
#: Before what is unlike in the content of a page.
_PARTS = re.compile(r'(?=,"(?:script|data|models)":)')


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


def page_data(models: Sequence[tuple[Motion, str | Document | None]], language: str) -> Plain:
    """What a page is made of as plain data; a document in place of a text has the mechanism already."""
    words = {each: {key: text.translate(each) for key, text in TEXTS.items()} for each in LANGUAGES}
    return {"language": language, "words": words, "models": [_model(*each) for each in models]}


def _model(motion: Motion, source: str | Document | None) -> Plain:
    text = dump(motion.mechanism) if source is None else source
    document = text if isinstance(text, Document) else Document(text, "model", read_text)
    programs = PagePrograms(motion)
    values = programs.values()
    known = signals(programs)
    machine = _machine(motion)
    changeable = dimensions(document, set(values))
    return {
        **_texts(motion.mechanism, document.text),
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
        key: {each: in_language(versions, each) for each in LANGUAGES} for key, versions in texts_of_model.items()
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
    text = json.dumps(content, ensure_ascii=False, separators=(",", ":"))
    parts = [each.encode() for each in _PARTS.split(text)]
    # Style, script, words, numbers and modules differ: they come in blocks with codes of their own.
    packer = zlib.compressobj(9)
    length = sum(map(len, parts)).to_bytes(4, "little")
    blocks = [
        packer.compress(each) + packer.flush(zlib.Z_BLOCK) for each in (length + parts[0], *parts[1:], *modules)
    ]
    packed = b"".join([*blocks, packer.flush()])
    written = base64.b85encode(packed).translate(_DIGITS).decode()
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


#: Numbers over the cycle that are shown of a signal.
_NUMBERS = {
    "transmission_angle": ("least",),
    "effort": ("largest", "rms"),
    "reaction": ("largest",),
    "shaking_force": ("largest",),
}


_EXTREMES = {
    "least": _("smallest {name}"),
    "largest": _("largest {name}"),
    "rms": _("root mean square of the {name}"),
}


def signals(page: PagePrograms) -> dict[Output, Plain]:
    """Everything that is plotted over the input. ``form``: how the value follows from the ``rows``."""
    outputs = [*_motion(page), *([] if page.forces is None else _forces(page))]
    return {each: _signal(page, each) for each in outputs}


def _signal(page: PagePrograms, output: Output) -> Plain:
    owner, form, key = output.owner, "row", output.row
    rows: tuple[str, ...] = (key,)
    if output.kind == "angle":
        form, key, rows = "angle", f"angle:{owner}", row_names("direction", owner)
    elif KINDS[output.kind].vector:
        form, rows = "size", row_names(output.kind, owner, output.on)
    title = output.sentence(alone=len(page.mechanism.drivers) == 1)
    name = {language: title.translate(language) for language in LANGUAGES}
    return {"id": key, "form": form, "rows": list(rows), "kind": output.dimension, "name": name}


def _translated(message: Message) -> dict[str, str]:
    return {language: message.translate(language) for language in LANGUAGES}


def _motion(page: PagePrograms) -> Iterator[Output]:
    mechanism = page.mechanism
    for name in mechanism.links:
        yield from Output("angle", name).course
    for name in mechanism.guides:
        yield from Output("displacement", name).course
    for key in page.solver.outputs.point_keys():
        yield from (Output("velocity", key), Output("acceleration", key))
    for group in page.dyads:
        yield Output("transmission_angle", group.name)


def _forces(page: PagePrograms) -> Iterator[Output]:
    for name in page.loaded.forces.efforts:
        yield Output("effort", name, slides=page.mechanism.drivers[name].joint in page.mechanism.guides)
    stored = {(joint, link) for joint, link, _ in page.loaded.outputs.reaction_keys()}
    for joint, link in reaction_pairs(page.mechanism):
        if (joint, link) in stored:
            yield Output("reaction", joint, on=link)
    yield Output("shaking_force")


def numbers(page: PagePrograms, known: Mapping[Output, Plain]) -> list[Plain]:
    """Metrics over the full cycle; ``kind``: how one follows from a signal."""
    found = []
    rotating = _one_steady_turn(page)
    for output in mechanism_outputs(page.mechanism) if page.motion.positions.count > 1 else ():
        angle = output.kind == "angle"
        if angle and _turns(page, output.owner):
            continue
        name = _("swing angle of {name}") if angle else _("stroke at {name}")
        found.append(_number("range", known[output], _translated(name.format(name=output.owner))))
        if rotating and _returns_once(page.motion.read(output)):
            found.append(
                _number(
                    "ratio", known[output], _translated(_("quick-return ratio of {name}", name=output.owner)), "ratio"
                )
            )
    for output, signal in known.items():
        found += [_number(kind, signal, _within(kind, signal)) for kind in _NUMBERS.get(output.kind, ())]
    return found


def _number(kind: str, signal: Plain, name: dict[str, str], quantity: str | None = None) -> Plain:
    return {
        "id": f"{kind}:{signal['id']}",
        "kind": kind,
        "signal": signal["id"],
        "quantity": quantity or signal["kind"],
        "name": name,
    }


def _within(word: str, signal: Plain) -> dict[str, str]:
    return {
        language: _EXTREMES[word].format(name=signal["name"][language]).translate(language) for language in LANGUAGES
    }


def _turns(page: PagePrograms, link: str) -> bool:
    """Whether a link turns through over the cycle."""
    angle = page.motion.link(link).angle
    return bool(len(angle) > 2 and page.motion.positions.closed and abs(angle[-1] - angle[0]) > 4.0)


def _returns_once(course: Floats) -> bool:
    """Whether something goes to and fro once in a closed cycle and rests nowhere."""
    steps = np.diff(course, append=course[0])
    signs = np.where(np.abs(steps) <= 1e-9 * np.ptp(course), 0.0, np.sign(steps))
    if ((signs == 0.0) & (np.roll(signs, -1) == 0.0)).any():
        return False
    moving = signs[signs != 0.0]
    return int((moving != np.roll(moving, -1)).sum()) == 2


def _one_steady_turn(page: PagePrograms) -> bool:
    """Whether the only driver turns once, steadily, in a closed cycle."""
    drivers = list(page.mechanism.drivers.values())
    speed = drivers[0].law.constant_speed if len(drivers) == 1 else None
    if speed is None or not page.motion.positions.closed:
        return False
    span = abs(speed) * (page.motion.positions.period or 0.0)
    return page.motion.positions.rotary[drivers[0].name] and abs(span - 6.283185307179586) < 1e-9


def usual_curves(page: PagePrograms, known: Mapping[Output, Plain]) -> list[str]:
    """The curves that a page opens with: motion of an output, effort, largest reaction, transmission angle."""
    wanted = [each for output in mechanism_outputs(page.mechanism)[-1:] for each in output.course]
    for kind, place in (("effort", 0), ("transmission_angle", -1), ("reaction", 0)):
        wanted += [each for each in known if each.kind == kind][place:][:1]
    wanted = [each for each in wanted if each in known]
    return [known[each]["id"] for each in (wanted or known)][:6]


def point_keys(page: PagePrograms) -> list[Plain]:
    """All points with what they are: on the frame or moving, a joint or not."""
    frame = {canonical(page.mechanism, "frame", point) for point in page.mechanism.frame.points}
    keys = [*frame, *(key for key in page.solver.outputs.point_keys() if key not in frame)]
    return [{"key": key, "fixed": key in frame, "moved": moving_dimensions(page, key)} for key in sorted(keys)]


def moving_dimensions(page: PagePrograms, key: str) -> list[str]:
    """Dimensions that place a point on its links, in their order; parameters in place of what follows them."""
    mechanism, found = page.mechanism, dict[str, None]()
    fixed = [f"frame.{point}" for point in mechanism.frame.points if canonical(mechanism, "frame", point) == key]
    if fixed:
        return [each for axis in "xy" for each in _behind(page, f"{fixed[0]}.{axis}")]
    for name, link in mechanism.links.items():
        for number, point in enumerate(link.points):
            if canonical(mechanism, name, point) != key:
                continue
            own = link.geometry_dimensions()
            placed = [a for a in own if a.startswith(f"{name}.{point}.")]
            if link.geometry in ("length", "bent") and number < 2 + (link.geometry == "bent"):
                placed = [a for a in own if ".length" in a or a.endswith(".angle")]
                placed = placed if number != 1 or link.geometry == "length" else placed[:1]
            elif number == 0 and link.geometry == "drawing":
                placed = [a for a in own if a.endswith(".x")][:1]
            found |= dict.fromkeys(placed)
    for joint in mechanism.guides.values():
        if key == canonical(mechanism, joint.block, joint.at):
            found[f"{joint.name}.offset"] = None
    return list(dict.fromkeys(each for address in found for each in _behind(page, address)))


def _behind(page: PagePrograms, address: str) -> list[str]:
    """The dimension itself, or the parameters that its expression takes."""
    expression = page.mechanism.expressions.get(address)
    if expression is None:
        return [address]
    return [each for name in sorted(expression.names) for each in _behind(page, name)]
