"""The files from which a machine is made: a drawing of every plate, the sheets, and the list of parts."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from linkwright.errors import RequestError, require_language
from linkwright.exporters.export import content_of
from linkwright.fabrication.cut_lines import CutLines, cut_lines
from linkwright.fabrication.dxf import dxf_of
from linkwright.fabrication.names import file_names
from linkwright.fabrication.sheets import Sheet, sheets_of
from linkwright.fabrication.solid_files import SOLIDS, solid_files
from linkwright.fabrication.svg import svg_of
from linkwright.filesystem import write_together
from linkwright.registry import offered
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.fabrication.cut_parts import CutParts

FORMS = ("dxf", "svg")
#: Forms in which files may be written: drawings of plates, and solids of all parts.
ALL_FORMS = (*FORMS, *SOLIDS)
_LISTS = ("csv", "xlsx")


def save(
    found: CutParts,
    folder: str | Path,
    forms: Sequence[str] = FORMS,
    language: str = "en",
    *,
    kerf: float | None = None,
    sheet: tuple[float, float] | None = None,
    force: bool = False,
    remedy: str = "force=True",
) -> list[Path]:
    """Writes drawings of all plates, the sheets and the list of parts into a folder, all or none."""
    contents = files_of(found, forms, language, kerf=kerf, sheet=sheet)
    return write_together({Path(folder) / name: each for name, each in contents.items()}, force=force, remedy=remedy)


def files_of(
    found: CutParts,
    forms: Sequence[str] = FORMS,
    language: str = "en",
    *,
    kerf: float | None = None,
    sheet: tuple[float, float] | None = None,
) -> Mapping[str, bytes]:
    """The contents of the files by their names."""
    require_language(language)
    for form in forms:
        if form not in ALL_FORMS:
            hint = offered(form, ALL_FORMS, _("use one of these"))
            raise RequestError(
                _(
                    'parts are written as {forms}, not as "{form}"; {hint}',
                    code="cut.no_form",
                    forms=ALL_FORMS,
                    form=form,
                    hint=hint,
                )
            )
    construction = found.mechanism.construction
    if kerf is None:
        kerf = 0.0 if construction is None else construction.kerf
    plates = [each for each in found.parts if each.sort == "plate"]
    lines = {each.name: cut_lines(each, kerf) for each in plates}
    sheets = sheets_of(found, lines, sheet, kerf)
    names = file_names(lines, taken=(each.name for each in sheets))
    contents: dict[str, bytes] = {}
    for form in forms:
        if form in SOLIDS:
            contents |= solid_files(found, form)
            continue
        contents |= {f"{names[name]}.{form}": _drawn(form, [each], name) for name, each in lines.items()}
        contents |= {f"{each.name}.{form}": _drawn(form, each.lines, each.name, each) for each in sheets}
    for form in _LISTS:
        contents[f"parts.{form}"] = content_of(found, form, language)
    return contents


def _drawn(form: str, lines: Sequence[CutLines], title: str, sheet: Sheet | None = None) -> bytes:
    edge = None if sheet is None else sheet.edge
    return dxf_of(lines, edge) if form == "dxf" else svg_of(lines, title, edge)
