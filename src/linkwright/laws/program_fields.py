"""Laws and programs in files."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from linkwright.errors import LinkwrightError, ModelError, RequestError
from linkwright.fields.base import Field, Quantities, Quantity, Schema, Word, table_schema
from linkwright.fields.nodes import Mapping as MappingNode
from linkwright.fields.nodes import Node
from linkwright.fields.reading import Place, Reader
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.laws.base import MotionLaw
    from linkwright.laws.program import MotionProgram, Segment

#: Dimension of lift, velocity and acceleration, by what the lift is and over what.
RATES = {
    ("length", "angle"): ("length_per_angle", "length_per_angle_squared"),
    ("angle", "angle"): ("dimensionless", "per_angle"),
    ("length", "time"): ("velocity", "acceleration"),
    ("angle", "time"): ("angular_velocity", "angular_acceleration"),
}
_ALTERED: Mapping[str, Field] = {
    "crossover": Quantity("dimensionless", above=0.0, doc="where a symmetric law turns; default 1/2"),
    "portion": Quantities("dimensionless", count=2, doc="the part of the law from u to u"),
    "backwards": Word(("true", "false"), doc="its ends change places"),
}


@dataclass(frozen=True)
class LawField(Field):
    """A motion law: its name, or a table with ``kind`` and the law's own keys."""

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        from linkwright.laws.base import MOTION_LAWS

        if not isinstance(node, MappingNode):
            return self._named(reader, node, place)
        kind_node = node.get("kind")
        if kind_node is None:
            known = ", ".join(MOTION_LAWS)
            remedy = _("add kind: one of {known}", known=known)
            reader.error(node, place.child("kind"), _("the law does not say its kind"), remedy, "missing-key")
            return None
        kind = reader.word(kind_node, place.child("kind"), tuple(MOTION_LAWS))
        if kind is None:
            return None
        fields: Mapping[str, Field] = {"kind": Word(tuple(MOTION_LAWS)), **MOTION_LAWS[kind].fields, **_ALTERED}
        before = reader.error_count
        values = reader.table(node, place, fields)
        if values is None or reader.error_count > before:
            return None
        return self._built(reader, node, place, {k: v for k, v in values.items() if v is not None})

    def _named(self, reader: Reader, node: Node, place: Place) -> MotionLaw | str | None:
        from linkwright.laws.base import MOTION_LAWS

        name = reader.word(node, place, tuple(MOTION_LAWS))
        if name is None:
            return None
        needed = [key for key, each in MOTION_LAWS[name].fields.items() if each.required]
        if needed:
            message = _("the law {law} needs {names}", law=name, names=tuple(needed))
            remedy = _("write law: {{kind: {law}, {first}: …}}", law=name, first=needed[0])
            reader.error(node, place, message, remedy, "missing-key")
            return None
        return name

    def _built(self, reader: Reader, node: Node, place: Place, values: dict[str, Any]) -> Any:
        from linkwright.laws.base import MOTION_LAWS, Ends
        from linkwright.laws.fitting import altered

        kind = MOTION_LAWS[values.pop("kind")]
        changes = [values.pop("crossover", None), values.pop("portion", None), values.pop("backwards", "") == "true"]
        if not any(changes) and kind.meeting(Ends(), 1.0) is not None:
            return kind.key
        try:
            return altered(kind(**values), changes[0], changes[1], changes[2])
        except LinkwrightError as error:
            reader.error(node, place, error.sentence, "", error.code)
            return None

    def written(self, value: Any) -> Any:
        from linkwright.laws.base import MOTION_LAWS, Ends
        from linkwright.laws.derived_laws import Backwards, Portion, Shifted

        if isinstance(value, str):
            return value
        found: dict[str, Any] = {}
        if isinstance(value, Backwards):
            found, value = {"backwards": "true"}, value.law
        if isinstance(value, Portion):
            found, value = {"portion": [value.start, value.end], **found}, value.law
        if isinstance(value, Shifted):
            found, value = {"crossover": value.crossover, **found}, value.law
        fields = MOTION_LAWS[value.key].fields if value.key in MOTION_LAWS else None
        if fields is None or value.meeting(Ends(), 1.0) is not None:
            raise RequestError(
                _(
                    "the law {law} has values that no file can hold; give its name and the "
                    "velocities of the segments",
                    code="laws.not_written",
                    law=value.key,
                )
            )
        own = {
            key: each.written(getattr(value, key))
            for key, each in fields.items()
            if getattr(value, key) not in (None, ())
        }
        return {"kind": value.key, **own, **found} if own or found else value.key

    def shape(self) -> Schema:
        from linkwright.laws.base import MOTION_LAWS

        return {"anyOf": [{"enum": list(MOTION_LAWS)}, {"type": "object", "required": ["kind"]}]}


@dataclass(frozen=True)
class ProgramField(Field):
    """A list of segments: ``{rise: 10 mm, over: 90 deg, law: cycloidal}``, ``{dwell: 30 deg}``, ``{fall: …}``.

    ``lift``: length or angle, or a function that says so from the values read before; ``across``: angle or time.
    ``closed``: whether the lift comes back.
    """

    lift: str | Callable[[Mapping[str, Any]], str] = "length"
    across: str = "angle"
    closed: bool = field(default=True, kw_only=True)

    def segment_fields(self, lift: str) -> Mapping[str, Field]:
        """Keys of one segment."""
        velocity, acceleration = RATES[lift, self.across]
        return {
            "dwell": Quantity(self.across, above=0.0, doc=_("nothing moves while this passes")),
            "rise": Quantity(lift, doc=_("how far up")),
            "fall": Quantity(lift, doc=_("how far down")),
            "to": Quantity(lift, doc=_("to this lift")),
            "over": Quantity(self.across, above=0.0, doc=_("while this passes")),
            "law": LawField(doc=_("motion law; default polynomial_5")),
            "velocity": Quantity(velocity, doc=_("velocity at its end, where both sides can meet it")),
            "acceleration": Quantity(acceleration, doc=_("acceleration at its end")),
        }

    def read(self, reader: Reader, node: Node, place: Place, siblings: Mapping[str, Any]) -> Any:
        items = reader.items(node, place, None, "[{rise: 10 mm, over: 90 deg}, …]")
        if items is None:
            return None
        lift = self.lift if isinstance(self.lift, str) else self.lift(siblings)
        fields = self.segment_fields(lift)
        before = reader.error_count
        segments = [self._segment(reader, each, place.child(str(k)), fields) for k, each in enumerate(items)]
        if reader.error_count > before:
            return None
        made = tuple(each for each in segments if each is not None)
        return self._program(reader, node, items, place, made, siblings.get("start") or 0.0)

    def _program(
        self, reader: Reader, node: Node, items: list[Node], place: Place, segments: tuple[Segment, ...], start: float
    ) -> MotionProgram | None:
        from linkwright.laws.program import TURN, MotionProgram

        period = TURN if self.across == "angle" else sum(each.over for each in segments)
        try:
            return MotionProgram(segments, start, period=period, closed=self.closed)
        except ModelError as error:
            for each in error.findings:
                number = each.key.split(".")[1:2]
                at = items[int(number[0])] if number else node
                reader.error(at, place.child(number[0]) if number else place, each.message, each.remedy, each.code)
        except LinkwrightError as error:
            reader.error(node, place, error.sentence, "", error.code)
        return None

    def _segment(self, reader: Reader, node: Node, place: Place, fields: Mapping[str, Field]) -> Segment | None:
        from linkwright.laws.program import Segment

        before = reader.error_count
        values = reader.table(node, place, fields)
        if values is None or reader.error_count > before:
            return None
        kinds = [key for key in ("dwell", "rise", "fall", "to") if values.get(key) is not None]
        if len(kinds) != 1:
            reader.error(
                node,
                place,
                _("a segment is one of dwell, rise, fall and to"),
                _("write {{rise: 10 mm, over: 90 deg}} or {{dwell: 90 deg}}"),
                "choice",
            )
            return None
        kind = kinds[0]
        if (kind == "dwell") == (values.get("over") is not None):
            problem, remedy = (
                (_("a dwell says itself how long it is"), _("write {{dwell: 90 deg}} without over"))
                if kind == "dwell"
                else (_("the segment does not say how long it takes"), _("add over: 90 deg"))
            )
            reader.error(node, place, problem, remedy, "missing-key")
            return None
        if kind == "dwell":
            return Segment(values["dwell"])
        rise = values["rise"] if kind == "rise" else -values["fall"] if kind == "fall" else None
        ends = values.get("velocity"), values.get("acceleration")
        return Segment(values["over"], rise, values.get("to"), values.get("law") or "polynomial_5", *ends)

    def written(self, value: MotionProgram) -> Any:
        assert isinstance(self.lift, str)
        fields = self.segment_fields(self.lift)
        return [self._written_segment(each, fields) for each in value.segments]

    def _written_segment(self, segment: Segment, fields: Mapping[str, Field]) -> dict[str, Any]:
        if segment.dwells:
            return {"dwell": fields["dwell"].written(segment.over)}
        kind = "rise" if segment.to is None else "to"
        values = {
            kind: (segment.rise or 0.0) if segment.to is None else segment.to,
            "over": segment.over,
            "law": segment.law,
            "velocity": segment.velocity,
            "acceleration": segment.acceleration,
        }
        return {key: fields[key].written(each) for key, each in values.items() if each is not None}

    def shape(self) -> Schema:
        lift = self.lift if isinstance(self.lift, str) else "length"
        return {"type": "array", "items": table_schema(self.segment_fields(lift))}
