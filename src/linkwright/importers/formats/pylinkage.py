"""pylinkage: mechanisms, and graphs (assur, hypergraph, hierarchical) with their dimensions beside them (JSON).

After pylinkage 1.3.0: mechanism, assur and hypergraph serialization, dimensions.
"""

from __future__ import annotations

from pathlib import Path

from linkwright.files.source import read_bytes
from linkwright.importers.foreign import READERS, Answers, ForeignFormat, ForeignText
from linkwright.importers.json_tree import Json, key_in, parse_json
from linkwright.importers.layout import Layout, Remarks
from linkwright.importers.pylinkage.joint_graph import read_graph
from linkwright.importers.pylinkage.mechanism import read_mechanism
from linkwright.importers.pylinkage.pin_build import build
from linkwright.words import _

#: Types of joints before there were links in the file.
OLD_TYPES = frozenset({"Static", "Crank", "Revolute", "Fixed", "Prismatic"})
DIALECTS = (
    ("joints", "links"),
    ("nodes", "edges"),
    ("instances", "connections"),
    ("node_positions",),
    ("topologies",),
)


def _recognises(source: ForeignText) -> bool:
    return any(key_in(source.text, *keys) for keys in DIALECTS)


def _read(source: ForeignText, answers: Answers, remarks: Remarks) -> Layout | None:
    root = parse_json(source.text, remarks)
    if root is None or _refused(root):
        return None
    plan = read_mechanism(root) if "joints" in root else read_graph(root, _dimensions(root, source))
    if plan is None or remarks.failed:
        return None
    layout = build(plan, answers)
    if layout is not None:
        named = root.text("name") or (Path(source.name).stem if source.folder else "")
        layout.name, layout.source = named, f"pylinkage, {source.name}" if source.folder else "pylinkage"
    return layout


def _dimensions(root: Json, source: ForeignText) -> Json | None:
    """The dimensions of a graph: in its own file, or in one beside it."""
    if "node_positions" in root:
        return root
    if (found := root.get("dimensions")) is not None:
        return found
    for name in companions(source.name) if source.folder is not None else ():
        assert source.folder is not None
        path = source.folder / name
        if path.is_file():
            text = read_bytes(path).decode("utf-8", errors="replace")
            return parse_json(text, Remarks(name, root.remarks.found))
    return None


def companions(name: str) -> list[str]:
    """Names of the file with the dimensions of a graph."""
    stem = Path(name).stem
    return [f"{stem}.dimensions.json", f"{stem}_dimensions.json"]


def _refused(root: Json) -> bool:
    """Errors about what is no machine: a catalogue, dimensions alone, the dialect before there were links."""
    if (found := root.get("topologies")) is not None:
        message = _("this is a catalogue of structures without sizes")
        found.remark("error", message, _("take one of its graphs, with its dimensions"), "import.no_sizes")
    elif "node_positions" in root and "nodes" not in root and "instances" not in root:
        message = _("these are dimensions without the structure that they belong to")
        remedy = _("read the file of the structure, with this one beside it as NAME.dimensions.json")
        root.remark("error", message, remedy, "import.no_structure")
    elif any(each.text("type") in OLD_TYPES for each in root.each("joints")):
        message = _("the joints are those of an old version of pylinkage, without links")
        remedy = _("convert it with pylinkage, and save it as a mechanism")
        root.remark("error", message, remedy, "import.old_version")
    return root.remarks.failed


READERS.register("pylinkage")(ForeignFormat(_("pylinkage"), (".json",), _recognises, _read))
