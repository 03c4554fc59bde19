"""Models that come with Linkwright, and those in the folder."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from linkwright import gallery
from linkwright.assistants.answers import Answer, Answered, NextAction
from linkwright.assistants.tool import Desk
from linkwright.errors import Finding, ModelError
from linkwright.files.gallery_entries import entries as gallery_entries
from linkwright.registry import nearest
from linkwright.words import _
from linkwright.words.message import in_language

#: Models that are listed with their purposes, at most.
WITH_PURPOSE = 30
KINDS: tuple[Literal["mechanism", "calculation", "task"], ...] = ("mechanism", "calculation", "task")


class GalleryEntry(Answered):
    """One file of the gallery."""

    name: str = Field(description="as other tools take it: gallery:NAME")
    kind: Literal["mechanism", "calculation", "task"] = Field(
        description="mechanism: a machine; calculation: of a machine part; task: of synthesis"
    )
    title: str = Field(description="what it is")
    purpose: str = Field(description="what it is for; empty in long lists")


class GalleryAnswer(Answer):
    """Files that a model argument may name."""

    models: list[GalleryEntry] = Field(default_factory=list, description="files of the gallery that fit the words")
    files: list[str] = Field(default_factory=list, description="model files in the server's folder, at most 100")
    text: str = Field(default="", description="text of the model that 'name' asks for")


def search_gallery(
    desk: Desk,
    words: Annotated[
        str,
        Field(
            description=(
                "Words that name, title or purpose must all have, such as 'quick return' or 'gear'. Empty (default):"
                " all models are listed."
            )
        ),
    ] = "",
    name: Annotated[
        str,
        Field(
            description="Name of one model whose whole text is wanted, such as 'crank_rocker'. Empty: only the list."
        ),
    ] = "",
) -> GalleryAnswer:
    """List or search the models that come with Linkwright (four-bars, slider-cranks, gears, crushers, presses,
    robots) and the model files in the folder, or get the text of one.

    Use it to find a machine to begin with, and to see how a model is written. For the rules of the form use
    read_schema; to find dimensions for a task, synthesize_machine.

    Words are compared with names, titles and purposes, all of them must occur. Comes back: names as other tools take
    them with their titles, of 30 models at most with their purposes, the folder's files, or the text that 'name' asks
    for.
    """
    wanted = words.lower().split()
    listed = [
        GalleryEntry(
            name=f"gallery:{each['name']}",
            kind=kind,
            title=in_language(each["title"], desk.language),
            purpose=in_language(each["purpose"], desk.language),
        )
        for kind, found in zip(KINDS, gallery_entries(), strict=True)
        for each in found
        if all(word in _haystack(each) for word in wanted)
    ]
    if len(listed) > WITH_PURPOSE:
        listed = [each.model_copy(update={"purpose": ""}) for each in listed]
    text = _text(name)
    summary = _("the text of {name}", name=name) if text else _("{count} models fit", count=len(listed))
    first = (
        {"model": f"gallery:{name.removeprefix('gallery:')}" if text else listed[0].name} if text or listed else {}
    )
    return GalleryAnswer(
        ok=True,
        summary=in_language(summary, desk.language),
        next=[NextAction(tool="check_model", arguments=first, why="what the model is")],
        models=[] if text else listed,
        files=desk.folder.models(),
        text=text,
    )


def _haystack(entry: dict[str, str]) -> str:
    parts = (f"{each} {in_language(each, 'zh')}" for each in entry.values())
    return " ".join(parts).replace("_", " ").lower()


def _text(name: str) -> str:
    """The text of a file of the gallery, empty where none is asked for; raises ModelError where there is none."""
    if not name:
        return ""
    plain = name.removeprefix("gallery:").removesuffix(".yaml")
    try:
        return gallery.content(plain).decode()
    except KeyError:
        known = (*gallery.names(), *gallery.calculations(), *gallery.tasks())
        near = nearest(plain, known)
        remedy = _('did you mean "{offer}"?', offer=near) if near else _("leave the name out to list all")
        message = _('the gallery has no model "{name}"', code="gallery.unknown", name=plain)
        raise ModelError([Finding("error", "", "name", message, remedy, "gallery.unknown")]) from None
