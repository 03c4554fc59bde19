"""OpenLinkage: projects of the free designer, of the four-bar and of the six-bar leg (JSON).

After the types of open-linkage's free-mechanism.ts, four-bar.ts and six-bar.ts (August 2026).
"""

from __future__ import annotations

from pathlib import Path

from linkwright.importers.foreign import READERS, Answers, ForeignFormat, ForeignText
from linkwright.importers.json_tree import Json, key_in, parse_json
from linkwright.importers.layout import Layout, Remarks
from linkwright.importers.open_linkage.designer import read_designer
from linkwright.importers.open_linkage.parametric import read_four_bar, read_leg
from linkwright.words import _


def _recognises(source: ForeignText) -> bool:
    return key_in(source.text, "mechanismType") or key_in(source.text, "joints[]", "bars[]")


def _read(source: ForeignText, answers: Answers, remarks: Remarks) -> Layout | None:
    root = parse_json(source.text, remarks)
    if root is None:
        return None
    root = root.get("editableProject") or root  # a project on its way from the leg to the designer
    kind = root.text("mechanismType")
    if kind == "four-bar":
        layout = read_four_bar(root, answers)
    elif kind == "six-bar-leg":
        layout = read_leg(root, answers)
    elif not kind:
        layout = read_designer(root, answers)
    else:
        _no_reader(root, kind)
        return None
    if layout is not None:
        layout.name = layout.name or Path(source.name).stem if source.folder else layout.name
        layout.source = f"OpenLinkage, {source.name}" if source.folder else "OpenLinkage"
    return layout


def _no_reader(root: Json, kind: str) -> None:
    message = _('projects of the kind "{kind}" are not read', kind=kind)
    remedy = _("open it in the free designer of OpenLinkage and export it from there")
    (root.get("mechanismType") or root).remark("error", message, remedy, "import.kind")


READERS.register("open_linkage")(ForeignFormat(_("OpenLinkage"), (".json",), _recognises, _read))
