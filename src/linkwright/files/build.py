"""Building a mechanism in code: the sections of a model file as short calls, with the same checks."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from linkwright.core.arguments import one_or_more
from linkwright.errors import ModelError, RequestError
from linkwright.fields.nodes import node_of
from linkwright.files.read_model import read_model
from linkwright.mechanism.mechanism import Mechanism
from linkwright.words import _

Value = float | str
Pair = tuple[Value, Value] | list[Value]
Wording = str | Mapping[str, str]


class Model:
    """A model under construction; numbers are SI values, texts are as in a file (``"60 mm"``).

    >>> model = Model("four-bar")
    >>> model.frame(O1=(0, 0), O2=(4, 0))
    >>> model.link("crank", ["O1", "A"], length=1)
    >>> model.link("coupler", ["A", "B"], length=3.5, also={"P": (1.5, 1)})
    >>> model.link("rocker", ["O2", "B"], length=3)
    >>> model.drive("crank", about="O1", speed=10)
    >>> mechanism = model.build()
    """

    def __init__(self, name: Wording, *, purpose: Wording = "", source: Wording = "") -> None:
        """Each a text, or one in each language: ``{"en": "Press", "zh": "压力机"}``."""
        self._data: dict[str, Any] = {"format": 1, "name": name}
        self._data |= {key: text for key, text in (("purpose", purpose), ("source", source)) if text}

    def _section(self, section: str, name: str, value: Any) -> None:
        entries = self._data.setdefault(section, {})
        if name in entries:
            raise RequestError(
                _(
                    '{section}: "{name}" is there already; choose another name',
                    code="model.there_already",
                    section=section,
                    name=name,
                )
            )
        entries[name] = value

    def parameters(self, **values: Value) -> None:
        """Named quantities that texts may use; a number is dimensionless."""
        for name, value in values.items():
            self._section("parameters", name, value)

    def frame(self, **points: Pair) -> None:
        """Points of the frame, (x, y) in m."""
        self._data.setdefault("frame", {"points": {}})["points"].update(points)

    def frame_shape(self, shape: str | Mapping[str, Any]) -> None:
        """The shape of the frame's plate: a word, or the keys of a file."""
        self._data.setdefault("frame", {"points": {}})["shape"] = shape

    def construction(self, **keys: Any) -> None:
        """How the machine is made, by the keys of a file: ``width``, ``thickness``, ``pin_radius`` (m), ``material``
        (a name, or density, strength and modulus), ``layers`` by plate, …"""
        self._data["construction"] = _present(**keys)

    def link(
        self,
        name: str,
        points: Iterable[str] | Mapping[str, Pair],
        *,
        length: Value | None = None,
        lengths: Pair | None = None,
        angle: Value | None = None,
        also: Mapping[str, Pair] | None = None,
        mass: Value | None = None,
        inertia: Value | None = None,
        mass_centre: Pair | str | None = None,
        colour: str | None = None,
        shape: str | Mapping[str, Any] | None = None,
    ) -> None:
        """A moving link; the keys are those of a file: m, rad, kg, kg·m². ``mass``: also ``"from shape"``;
        ``mass_centre``: (x, y) or a point; ``colour``: a name or #rrggbb; ``shape``: a word or a table."""
        listed = points if isinstance(points, Mapping) else one_or_more(points)
        sizes = _present(length=length, lengths=lengths, angle=angle, also=also)
        masses = _present(mass=mass, inertia=inertia, mass_centre=mass_centre, colour=colour, shape=shape)
        self._section("links", name, {"points": listed, **sizes, **masses})

    def joint(self, name: str, kind: str, **fields: Any) -> None:
        """A joint of a registered kind, by the keys of a file: m, rad, kg. The pins at shared points are implied; one
        of them is named for its radius or its friction."""
        self._section("joints", name, {"kind": kind, **_present(**fields)})

    def drive(
        self, link: str, *, about: str, relative_to: str | None = None, name: str = "driver", **law: Any
    ) -> None:
        """Turn a link about a pin by a law, by its keys in a file: constant ``speed`` (rad/s) from ``start`` (rad),
        an expression ``position``, a ``table``; by none where a :meth:`path` moves it."""
        keys = _present(relative_to=relative_to, **law)
        self._section("drivers", name, {"turn": link, "about": about, **keys})

    def slide(self, joint: str, *, name: str = "driver", **law: Any) -> None:
        """Drive a prismatic joint by a law, by its keys in a file: constant ``speed`` (m/s) from ``start`` (m),
        an expression ``position``, a ``table``."""
        self._section("drivers", name, {"slide": joint, **_present(**law)})

    def stretch(
        self,
        *between: str,
        stroke: Pair | None = None,
        barrel: Mapping[str, Any] | None = None,
        rod: Mapping[str, Any] | None = None,
        name: str = "driver",
        **law: Any,
    ) -> None:
        """Drive the distance of two points by a law, as a cylinder does: ``("frame.U", "boom.K", speed=0.02,
        start=0.6)``; ``stroke``: shortest and longest (m); ``barrel``, ``rod``: ``mass``, ``inertia``,
        ``mass_centre`` of its parts."""
        keys = _present(stroke=stroke, barrel=barrel, rod=rod, **law)
        self._section("drivers", name, {"between": list(between), **keys})

    def path(
        self, point: str, along: Iterable[Pair | Mapping[str, Any]], *, smooth: bool = False, **law: Any
    ) -> None:
        """The path of a point, which the two drivers without a law follow: points (m) and arcs
        ``{"about": (x, y), "turn": angle}`` (rad), counter-clockwise; ``speed`` (m/s), ``over`` (s) or another law of
        the distance along it."""
        steps = [dict(each) if isinstance(each, Mapping) else list(each) for each in along]
        self._data["path"] = {"point": point, "along": steps, **({"smooth": True} if smooth else {}), **law}

    def assemble(self, **modes: str) -> None:
        """Assembly modes: joint name = left, right, forward or backward."""
        for joint, mode in modes.items():
            self._section("assembly", joint, mode)

    def drawing(self, **points: Pair) -> None:
        """Coordinates (m) of the assembled drawing in frame axes."""
        for point, place in points.items():
            self._section("drawing", point, place)

    def gravity(self, x: Value, y: Value) -> None:
        """Gravity in m/s², in frame axes."""
        self._data["gravity"] = [x, y]

    def cycle(self, **values: Value) -> None:
        """One of ``duration`` (s), ``turns``, or ``start`` and ``end`` of the first driver's coordinate."""
        keys = {"start": "from", "end": "to"}
        self._data["cycle"] = {keys.get(key, key): value for key, value in values.items()}

    def load(self, name: str, kind: str, **fields: Any) -> None:
        """A load of a registered kind, by the keys of a file (``from_`` is written for ``from``)."""
        keys = {key.rstrip("_"): value for key, value in fields.items()}
        self._section("loads", name, {"kind": kind, **keys})

    def actuator(self, name: str, kind: str, **fields: Any) -> None:
        """A motor, cylinder, brake or flywheel of a kind, by its keys in a file (``from_`` for ``from``)."""
        keys = {key.rstrip("_"): value for key, value in fields.items()}
        self._section("actuators", name, {"kind": kind, **keys})

    def stop(self, name: str, of: str, at: Value, side: str, *, restitution: Value | None = None) -> None:
        """An end stop: the output does not go ``below``, or ``above``, a value (rad or m)."""
        self._section("stops", name, {"of": of, "at": at, "side": side, **_present(restitution=restitution)})

    def run(self, **conditions: Any) -> None:
        """How a run under forces begins and ends, by the keys of a file (``for_`` for ``for``)."""
        self._data["run"] = {key.rstrip("_"): value for key, value in conditions.items()}

    def outputs(self, **formulas: str) -> None:
        """Outputs with names of their own, by formulas of places and rates: ``gap="guide - 0.18 m*wheel"``."""
        for name, formula in formulas.items():
            self._section("outputs", name, formula)

    def build(self) -> Mechanism:
        """The checked mechanism. Raises ModelError with all findings."""
        mechanism, findings = read_model(node_of(self._data), "", si=True)
        if mechanism is None:
            raise ModelError(findings)
        return mechanism


def _present(**values: Any) -> dict[str, Any]:
    return {key: value for key, value in values.items() if value is not None}
