"""What the studio asks of Python: models solved, findings at their lines, changes, searches."""

from __future__ import annotations

import base64
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import replace

from linkwright.core.data import Plain
from linkwright.errors import Finding, LinkwrightError, ModelError, with_remedy
from linkwright.file_check import checked_text
from linkwright.files.model_file import read_text
from linkwright.files.source import read_source
from linkwright.files.write import Document
from linkwright.server.agreement import agree, unmet
from linkwright.server.background import Background
from linkwright.server.draft import Draft
from linkwright.server.edits import edited
from linkwright.server.files import Files
from linkwright.server.folder import listing
from linkwright.server.handing_out import handed_out
from linkwright.server.loose import moving_part
from linkwright.server.moved import gap_data, moved
from linkwright.server.outline import outline
from linkwright.server.picture import completed, weighed
from linkwright.server.request import length_unit, mapping, mappings, number, numbers, text
from linkwright.server.sketching import sketched
from linkwright.server.structure import structure_of
from linkwright.server.unfinished import in_earnest, unfinished
from linkwright.words import LANGUAGES, _, pgettext
from linkwright.words.message import in_language

NEW = "format: 1\nname: {name}\n"


class Work:
    """The answers to the page's requests, by name; each takes and gives plain data."""

    def __init__(self, files: Files) -> None:
        self.files = files
        self.background = Background()
        self._solving = threading.Lock()
        self._foreseen: tuple[str, str, str, Plain] | None = None
        self.answers: Mapping[str, Callable[[Plain], Plain]] = {
            "folder": lambda asked: listing(files, language_of(asked)),
            "thumbnail": self._thumbnail,
            "rename": lambda a: files.rename(text(a, "name"), text(a, "to"), text(a, "version")),
            "discard": lambda a: files.discard(text(a, "name")),
            "open": self._open,
            "read": lambda a: {"text": self._read(a)},
            "import": lambda a: imported(text(a, "name"), text(a, "text"), language_of(a)),
            "keep": lambda a: files.keep(
                text(a, "name"), text(a, "text"), text(a, "window"), int(number(a, "serial"))
            ),
            "state": lambda a: files.state(text(a, "name"), text(a, "window")),
            "save": lambda a: files.save(text(a, "name"), text(a, "text"), text(a, "version"), text(a, "draft")),
            "disk": lambda a: files.disk(text(a, "name")),
            "solve": lambda a: self._solve(text(a, "text"), language_of(a), self._folder(text(a, "name", ""))),
            "edit": self._edit,
            "curve": self._curve,
            "optimize": self._optimize,
            "goals": self._goals,
            "tasks": self._tasks,
            "synthesis": self._synthesis,
            "metrics": self._metrics,
            "room": self._room,
            "side_view": self._side_view,
            "actuators": self._actuators,
            "run": self._run,
            "candidates": lambda a: self.background.state(),
            "enough": lambda a: self.background.end(),
            "take": self._take,
            "set": lambda a: {"text": _changed(text(a, "text"), numbers(a, "values"))},
        }

    def _open(self, asked: Plain) -> Plain:
        """A file; without a name what was drawn last and never saved, or with ``fresh`` a new one."""
        window, language = text(asked, "window", ""), language_of(asked)
        new = new_text(language)
        if asked.get("gallery"):
            found = self._read(asked)
            return {**self.files.open(self.files.fresh(text(asked, "gallery"), window)), "text": found}
        if asked.get("name"):
            opened = self.files.open(text(asked, "name"))
            return opened if opened["version"] or opened["recovered"] else {**opened, "text": new}
        unsaved = [] if asked.get("fresh") else self.files.unsaved()
        if unsaved:
            return self.files.open(unsaved[0])
        numbered = bool(asked.get("numbered"))
        stem = drawing_stem(language) if numbered else "machine"
        return {
            **self.files.open(self.files.fresh(f"{stem} " if numbered else stem, window, numbered=numbered)),
            "text": new,
        }

    def _edit(self, asked: Plain) -> Plain:
        """The text after actions of drawing, one step: what the user should know, new names, what can be drawn."""
        done = edited(text(asked, "text"), mappings(asked, "actions"))
        return {**done._asdict(), "notes": [in_language(each, language_of(asked)) for each in done.notes]}

    def _read(self, asked: Plain) -> str:
        """The text of a file, or of one of the gallery."""
        if asked.get("gallery"):
            return read_source(f"gallery:{text(asked, 'gallery')}")[0]
        return str(self.files.open(text(asked, "name"))["text"])

    def _thumbnail(self, asked: Plain) -> Plain:
        """A small drawing of a file, or of a machine of the gallery."""
        from linkwright.server.thumbnail import thumbnail

        return {"strokes": list(thumbnail(self._read(asked)))}

    def foresee(self, name: str, language: str) -> None:
        """Begins to solve a file that a window will ask for first: the browser is opened meanwhile."""
        with suppress(LinkwrightError, OSError):
            found = str(self.files.open(name)["text"])
            self._solving.acquire()
            asked = found, language, self._folder(name)
            threading.Thread(target=self._prepare, args=asked, daemon=True).start()

    def _folder(self, name: str) -> str:
        """Where files lie that a file of this name names."""
        return str(self.files.path(name).parent if name else self.files.folder)

    def _prepare(self, text: str, language: str, folder: str) -> None:
        try:
            self._foreseen = (text, language, folder, solved(text, language, folder))
        finally:
            self._solving.release()

    def _solve(self, text: str, language: str, folder: str) -> Plain:
        """The model of a text; what is being solved already is waited for, and used once."""
        with self._solving:
            foreseen, self._foreseen = self._foreseen, None
            if foreseen is not None and foreseen[:3] == (text, language, folder):
                return foreseen[3]
            return solved(text, language, folder)

    def _curve(self, asked: Plain) -> Plain:
        """Begins the search for linkages through a curve that was drawn."""
        from linkwright.server.search import linkages

        work = linkages(asked.get("points"), bool(asked.get("closed")), length_unit(asked))
        return self.background.begin("curve", work, language_of(asked))

    def _optimize(self, asked: Plain) -> Plain:
        """Begins the optimisation that the text's section asks."""
        from linkwright.server.search import optimised

        return self.background.begin("optimum", optimised(text(asked, "text")), language_of(asked))

    def _tasks(self, asked: Plain) -> Plain:
        """The tasks of synthesis as forms."""
        from linkwright.server.synthesis import task_forms

        return {"tasks": task_forms(language_of(asked))}

    def _synthesis(self, asked: Plain) -> Plain:
        """Begins the search for linkages that meet the demands of a task."""
        from linkwright.server.synthesis import designed

        work = designed(text(asked, "task"), mapping(asked, "demands"), length_unit(asked))
        return self.background.begin("synthesis", work, language_of(asked))

    def _goals(self, asked: Plain) -> Plain:
        """What an optimisation of a text's model can minimize or limit."""
        from linkwright.server.search import goals

        return {"goals": goals(text(asked, "text"), language_of(asked))}

    def _metrics(self, asked: Plain) -> Plain:
        """All metrics of a text's model."""
        from linkwright.server.metrics import metric_rows

        return {"metrics": metric_rows(text(asked, "text"), language_of(asked))}

    def _room(self, asked: Plain) -> Plain:
        """What the parts of a text's machine take up."""
        from linkwright.server.room_taken import room_taken

        return room_taken(text(asked, "text"), language_of(asked), layered=bool(asked.get("layered", True)))

    def _side_view(self, asked: Plain) -> Plain:
        """The section through the pins of a text's machine."""
        from linkwright.server.room_taken import side_view

        return side_view(text(asked, "text"), language_of(asked))

    def _actuators(self, asked: Plain) -> Plain:
        """What acts in motion under forces, as forms."""
        from linkwright.server.run_forms import forms

        return forms(language_of(asked))

    def _run(self, asked: Plain) -> Plain:
        """Begins the run of a text's model under its actuators and loads."""
        from linkwright.server.running import started

        return self.background.begin("run", started(text(asked, "text")), language_of(asked))

    def _take(self, asked: Plain) -> Plain:
        """A report, an export, an exercise of a text: its bytes in base64."""
        folder = self._folder(text(asked, "name", ""))
        found = handed_out(text(asked, "text"), text(asked, "ending"), language_of(asked), folder, asked)
        return {"content": base64.b64encode(found).decode()}


def drawing_stem(language: str) -> str:
    """What new drawings are called, with a number."""
    return pgettext("studio", "Drawing").translate(language)


def new_text(language: str = "en") -> str:
    """The text of a new file."""
    return NEW.format(name=_("New mechanism").translate(language))


def _changed(text: str, values: Mapping[str, float]) -> str:
    """The text with changed dimensions, SI, and with them what is drawn."""
    from linkwright.designs.varied_dimensions import changed_text

    draft = Draft(changed_text(Document(text, "model", read_text), values))
    agree(draft)
    return draft.text


def solved(text: str, language: str, folder: str = "") -> Plain:
    """The model of a text for the page; what is in its way otherwise; in any case what can be drawn.

    ``folder``: where files lie that the text names.
    """
    mechanism, _ = read_text(text, "model")
    findings, told, part = checked_text(text, "model", folder).findings, False, moving_part(text)
    mechanism = part.document.mechanism if part else mechanism
    found: Plain = {
        "model": None,
        "gap": None,
        "sentence": "",
        "optimize": {},
        "outline": outline(text),
        "structure": structure_of(part.text if part else text, mechanism, language, part.loose if part else ()),
    }
    try:
        draft = Draft(text)
        found["picture"] = {**draft.picture(), "unmet": unmet(draft), "loose": part.loose if part else []}
        if mechanism is not None:
            from linkwright.page.content import page_data
            from linkwright.topology import structure

            found["mobility"] = structure(mechanism).mobility
            found["optimize"] = dict(mechanism.optimize)
            motion, gap, error = moved(mechanism)
            told = motion is not None or gap is not None
            found["gap"] = gap and gap_data(gap, mechanism, language)
            if motion is None:
                assert error is not None
                raise error
            found["picture"] = weighed(completed(found["picture"], motion), motion.mechanism)
            found["model"] = page_data([(motion, part.document if part else text)], language)["models"][0]
    except LinkwrightError as error:
        found["sentence"] = "" if found["gap"] or unfinished(error.code) else error.translate(language)
    if found["model"] is None and "picture" in found:
        found["picture"]["sketched"] = sketched(draft)
    found["findings"] = [_finding(each, language) for each in in_earnest(findings, told=told)]
    return found


def imported(name: str, content: str, language: str) -> Plain:
    """A file or a link of another program as the text of a model, and remarks on what it could not say.

    Raises LinkwrightError where there is no machine in it.
    """
    from linkwright.importers.foreign import ForeignText, read_text_of

    found = read_text_of(ForeignText(content, name))
    if not found.text:
        raise ModelError(found.remarks)
    return {"text": found.text, "notes": [each.translate(language) for each in found.remarks]}


def _finding(found: Finding, language: str) -> Plain:
    place = found.where.split(":")
    return {
        "severity": found.severity,
        "line": int(place[1]) if len(place) > 1 and place[1].isdigit() else 0,
        "key": found.key,
        "code": found.code,
        "sentence": in_language(with_remedy(found.message, found.remedy), language),
    }


def error_text(error: LinkwrightError, language: str) -> str:
    """What is wrong; of a model its findings without the name of a file, which the page's text has not."""
    if isinstance(error, ModelError):
        error = ModelError([replace(each, where="") for each in error.findings])
    return error.translate(language)


def language_of(asked: object) -> str:
    """The language that a request asks for its sentences."""
    found = asked.get("language") if isinstance(asked, dict) else None
    return found if found in LANGUAGES else "en"
