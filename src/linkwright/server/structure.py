"""The structure of a drawing in words, as far as it is known: also of one that is not finished."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from linkwright.analysis.grashof import FourBar, four_bars
from linkwright.core.data import Plain
from linkwright.drivers.base import Driver
from linkwright.drivers.constant_speed import ConstantSpeed
from linkwright.elements import Group
from linkwright.errors import LinkwrightError, speaker
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node
from linkwright.files.compose import compose
from linkwright.joints.base import JOINTS
from linkwright.mechanism.mechanism import Mechanism
from linkwright.server.entries import points_of, section, texts, word
from linkwright.topology import Structure, structure
from linkwright.topology.analysis import numeral
from linkwright.units import number
from linkwright.words import Message, _
from linkwright.words.message import in_language

#: Linkages of one freedom by the number of their moving links.
BARS = {5: _("Six-bar"), 7: _("Eight-bar"), 9: _("Ten-bar")}


@dataclass
class Counted:
    """What a text draws, counted: moving bodies (links that are welded together are one), pairs between them."""

    links: list[str] = field(default_factory=list)
    pairs: list[tuple[str, str, str]] = field(default_factory=list)
    welds: int = 0
    points: int = 0

    @property
    def numbers(self) -> dict[str, int]:
        """Moving links and pairs by kind."""
        found = {"links": len(self.links)}
        for kind, _a, _b in self.pairs:
            found[kind] = found.get(kind, 0) + 1
        return found

    @property
    def mobility(self) -> int:
        """3n − 2p_L − p_H, welds taken for what they hold."""
        taken = sum(3 - JOINTS[kind].freedoms for kind, _a, _b in self.pairs)
        return 3 * len(self.links) - taken

    def count(self, kind: str) -> int:
        """Pairs of a kind of movement: turn, slide, or higher ones."""
        return sum(_sort(each) == kind for each, _a, _b in self.pairs)

    @property
    def loops(self) -> int:
        """Independent loops of bodies and pairs, those through several parts together."""
        bodies = {"frame", *self.links}
        root = {each: each for each in bodies}

        def top(body: str) -> str:
            while root[body] != body:
                body = root[body]
            return body

        found = 0
        for _kind, a, b in self.pairs:
            if top(a) == top(b):
                found += 1
            else:
                root[top(a)] = top(b)
        return found


def _sort(kind: str) -> str:
    joint = JOINTS[kind]
    return "higher" if joint.higher else "turn" if joint.coordinate == "turn" else "slide"


def counted(root: Node) -> Counted:
    """The count of a text's tree, whatever else it lacks."""
    links = {name: points_of(link) for name, link in section(root, "links") or ()}
    fixed = [name for name, _unused in section(root, "frame", "points") or ()]
    joints = [(name, joint) for name, joint in section(root, "joints") or () if isinstance(joint, MappingNode)]
    merged = _welded(links, [joint for _unused, joint in joints])
    found = Counted(list(dict.fromkeys(each for each in map(merged.__getitem__, links) if each != "frame")))
    found.points = len({*fixed, *(point for points in links.values() for point in points)})
    for point in dict.fromkeys([*fixed, *(point for points in links.values() for point in points)]):
        own = dict.fromkeys(merged[link] for link, points in links.items() if point in points)
        bodies = list(dict.fromkeys([*(["frame"] if point in fixed else []), *own]))
        found.pairs += [("revolute", bodies[0], body) for body in bodies[1:]]
    for _unused, joint in joints:
        kind, ends = word(joint, "kind"), _ends(joint, links)
        if kind in JOINTS and JOINTS[kind].freedoms and kind != "revolute" and len(ends) > 1:
            a, b = (merged.get(each, each) for each in ends[:2])
            if a != b:
                found.pairs.append((kind, a, b))
    return found


def _ends(joint: MappingNode, links: Mapping[str, object]) -> list[str]:
    """The links that an explicit joint joins, by whatever keys it names them."""
    known = {"frame", *links}
    found: list[str] = []
    for key, value in joint:
        named = word(joint, key)
        if named in known and key not in ("at", "through", "kind", "name"):
            found.append(named)
        elif key == "links":
            found += [each for each in texts(value) if each in known]
    return list(dict.fromkeys(found)) if len(set(found)) > 1 else found


def _welded(links: Mapping[str, object], joints: list[MappingNode]) -> dict[str, str]:
    """The body of every link: the first one of those that are welded together."""
    body = {"frame": "frame", **{name: name for name in links}}
    for joint in joints:
        kind, ends = word(joint, "kind"), _ends(joint, links)
        if kind in JOINTS and JOINTS[kind].freedoms == 0 and len(ends) == 2:
            a, b = sorted((body[each] for each in ends), key=lambda each: each != "frame")
            body = {name: a if each == b else each for name, each in body.items()}
    return body


# words ----------------------------------------------------------------------------------------------
def structure_of(text: str, mechanism: Mechanism | None, language: str, loose: Sequence[str] = ()) -> Plain:
    """The structure of a text: mobility, what it is in one line, the count, class and groups where they are known.

    ``loose``: links that the text has not, as nothing determines their motion yet.
    """
    root, _unused = compose(text.removeprefix("\ufeff"))
    own = counted(root) if root is not None else Counted()
    solved = None if mechanism is None else _structure(mechanism)
    mobility = own.mobility if solved is None else solved.mobility
    said = headline(own, mechanism, mobility)
    if loose:
        said = _("{headline}; still loose: {links}", headline=said, links=tuple(loose))
    return {
        "mobility": mobility,
        "headline": in_language(said, language),
        "formula": formula(own, mobility),
        "class": in_language(_class(solved, language), language) if solved else "",
        "groups": [] if solved is None else [_group(each, language) for each in solved.groups],
    }


def _structure(mechanism: Mechanism) -> Structure | None:
    """The groups; of a machine without driver those of one that is driven at a link pinned to the frame."""
    for each in (mechanism, *_driven(mechanism)):
        try:
            return structure(each)
        except LinkwrightError:
            continue
    return None


def _driven(mechanism: Mechanism) -> Iterator[Mechanism]:
    if mechanism.drivers:
        return
    for name, pin in mechanism.pins.items():
        link = next((each for each in pin.links if each != "frame"), None)
        if "frame" in pin.links and link is not None:
            driver = Driver("driver", name, link, "frame", ConstantSpeed(1.0))
            yield replace(mechanism, drivers={"driver": driver})


def headline(own: Counted, mechanism: Mechanism | None, mobility: int) -> Message:
    """What the drawing is now, in a line."""
    if not own.links:
        return _("Empty sheet") if not own.points else _("Points without links")
    freedoms = _("1 degree of freedom") if mobility == 1 else _("{count} degrees of freedom", count=_signed(mobility))
    kind = _kind(own, mobility)
    loops = four_bars(mechanism) if mechanism is not None and len(own.links) == 3 else ()
    if len(loops) == 1 and own.count("turn") == 4 and mobility == 1:
        return _("{kind}, {freedoms}; {grashof}", kind=kind, freedoms=freedoms, grashof=_grashof(loops[0]))
    return _("{kind}, {freedoms}", kind=kind, freedoms=freedoms)


def _kind(own: Counted, mobility: int) -> Message:
    turning, sliding, higher, links = own.count("turn"), own.count("slide"), own.count("higher"), len(own.links)
    if not own.loops:
        return _("Open chain") if own.pairs else _("Free link")
    if mobility <= 0:
        return _("Rigid structure") if mobility == 0 else _("Overdetermined structure")
    if higher:
        kinds = {kind for kind, _a, _b in own.pairs if _sort(kind) == "higher"}
        if kinds == {"cam"}:
            return _("Cam mechanism")
        return _("Gear train") if turning == links and not sliding else _("Geared linkage")
    if own.loops == 1 and links == 3 and mobility == 1:
        return {0: _("Four-bar"), 1: _("Slider-crank"), 2: _("Double slider")}.get(sliding, _("Four-link chain"))
    if own.loops == 1 and links == 4 and mobility == 2 and not sliding:
        return _("Five-bar")
    if mobility == 1 and links in BARS:
        return BARS[links]
    return _("Linkage of {count} links", count=links + 1)


def _grashof(loop: FourBar) -> Message:
    """Which link can turn through, with the sums of Grashof's condition."""
    s, p, q, longest = (_mm(each) for each in sorted(loop.lengths.values()))
    values = {"s": s, "l": longest, "p": p, "q": q, "link": loop.shortest}
    return _GRASHOF[loop.type].format(**values)


_GRASHOF = {
    "crank_rocker": _("the {link} can turn through: {s} + {l} < {p} + {q} mm"),
    "double_crank": _("both links on the frame can turn through: {s} + {l} < {p} + {q} mm"),
    "double_rocker": _("only the {link} can turn through: {s} + {l} < {p} + {q} mm"),
    "change_point": _("it has change points: {s} + {l} = {p} + {q} mm"),
    "triple_rocker": _("no link can turn through: {s} + {l} > {p} + {q} mm"),
}


def _mm(length: float) -> str:
    return number(round(1e3 * length, 1), 4)


def formula(own: Counted, mobility: int) -> str:
    """The count with its numbers: 3·n − 2·p_L − p_H."""
    n, lower, higher = len(own.links), own.count("turn") + own.count("slide"), own.count("higher")
    text = f"3·n − 2·p_L − p_H = 3·{n} − 2·{lower} − {higher} = {_signed(own.mobility)}"
    if mobility == own.mobility:
        return text
    return f"{text}; {_signed(own.mobility)} + {mobility - own.mobility} = {_signed(mobility)}"


def _signed(value: int) -> str:
    return str(value).replace("-", "−")


def _class(found: Structure, language: str) -> Message:
    return _("class {level}", level=numeral(found.mechanism_class, speaker(language)))


def _group(group: Group, language: str) -> Plain:
    joints = [each.joint for each in (*group.outer_joints, *group.inner_joints)]
    return {
        "name": group.name,
        "signature": group.signature,
        "class": numeral(group.assur_class, speaker(language)),
        "links": list(group.links),
        "joints": list(dict.fromkeys(joints)),
    }
