"""Outputs that are constant over the cycle, and what goes by them: named outputs, expectations, objectives, stops,
springs and dampers."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from linkwright.core.outputs import KINDS, Output
from linkwright.core.quantity import shown
from linkwright.errors import Finding, LinkwrightError, RequestError
from linkwright.fields.references import LinkPoint
from linkwright.files.check_mechanism import links_that_slide
from linkwright.kinematics.names import find_point, output_meant
from linkwright.mechanism.mechanism import Mechanism
from linkwright.plausibility.moving import RESTING, resting_links
from linkwright.topology.analysis import Structure
from linkwright.words import _

#: Positions of the cycle at which named outputs are looked at.
LOOKS = 24


@dataclass(frozen=True)
class Still:
    """What a machine's structure leaves at rest: its ``links``, and those that ``slide`` and never turn."""

    mechanism: Mechanism
    links: Collection[str]
    slide: Collection[str]

    @classmethod
    def of(cls, mechanism: Mechanism, structure: Structure) -> Still:
        """That of a machine with its structure."""
        links = {"frame", *mechanism.grounded, *resting_links(mechanism, structure)}
        return cls(mechanism, links, links | links_that_slide(mechanism))

    def __contains__(self, output: Output) -> bool:
        """Whether an output can never change."""
        of, owner = KINDS[output.kind].of, output.owner
        if of == "point" and output.kind != "distance":
            return self.holds(*find_point(self.mechanism, owner.replace(".@centre", "")))
        if output.kind == "distance":
            return bool(
                common_link(self.mechanism, *(find_point(self.mechanism, each) for each in (owner, output.on)))
            )
        if of == "link":
            return owner in self.slide if owner in self.mechanism.links else False
        if of == "guide":
            return set(self.mechanism.joints[owner].joined) <= set(self.links)
        return False

    def holds(self, link: str, point: str) -> bool:
        """Whether a point rests: on a link at rest, or on a pin with one."""
        return bool(set(self.links) & {link, *self.mechanism.pin_links(point)})


def common_link(mechanism: Mechanism, first: tuple[str, str], second: tuple[str, str]) -> str:
    """A link that carries both points, as pins or its own; empty for none."""
    owners = [
        {link, *(mechanism.pin_links(point) if link in mechanism.pin_links(point) else ())}
        for link, point in (first, second)
    ]
    return next((link for link in ("frame", *mechanism.links) if all(link in each for each in owners)), "")


def of_outputs(mechanism: Mechanism, structure: Structure) -> Iterator[Finding]:
    """Findings about outputs that never change, wherever the file names them."""
    if mechanism.loads:
        yield from _of_ends(mechanism)
    if not (mechanism.outputs or mechanism.stops or mechanism.expect or mechanism.optimize) or not mechanism.drivers:
        return
    still = Still.of(mechanism, structure)
    named = set[str]()
    for finding in _of_named(mechanism):
        named.add(finding.key.partition(".")[2])
        yield finding
    for name, stop in mechanism.stops.items():
        if stop.of in still:
            yield _warning(f"stops.{name}.of", str(stop.of))
    for key, text in _texts(mechanism):
        with suppress(LinkwrightError):
            output = _summed(mechanism, text)
            if output is not None and (output in still or output.owner in named):
                yield _warning(key, text)


def _warning(key: str, text: str) -> Finding:
    message = _("{text} never changes: what it is of does not move, whatever the dimensions", text=text)
    return Finding("warning", "", key, message, _("name an output that moves"), "constant")


def _of_ends(mechanism: Mechanism) -> Iterator[Finding]:
    """Springs, dampers and the like between two points whose distance is fixed, as one link carries both."""
    for name, load in mechanism.loads.items():
        ends: Any = getattr(load, "between", None)
        if not ends or not all(isinstance(each, LinkPoint) for each in ends):
            continue
        link = common_link(mechanism, *((each.link, each.point) for each in ends))
        if link:
            message = _(
                "the distance of {a} and {b} never changes: the link {link} carries both, so the load does no work",
                a=str(ends[0]),
                b=str(ends[1]),
                link=link,
            )
            yield Finding(
                "warning",
                "",
                f"loads.{name}.between",
                message,
                _("name points that move against each other"),
                "constant",
            )


def _of_named(mechanism: Mechanism) -> Iterator[Finding]:
    """Outputs that the file names whose value is the same over the cycle."""
    if not mechanism.outputs:
        return
    import numpy as np

    from linkwright.kinematics.solve import try_motion

    try:
        motion = try_motion(mechanism, LOOKS)
    except LinkwrightError:  # told where the machine is turned
        return
    for name, each in mechanism.outputs.items():
        values = motion.read(each.outputs[0])
        values = values[np.isfinite(values)]
        if len(values) < 2:
            continue
        size = mechanism.size if each.dimension == "length" else max(1.0, float(np.abs(values).max()))
        if np.ptp(values) <= RESTING * size:
            message = _(
                "the output {name} does not change over the cycle: it stays {value}",
                name=name,
                value=shown(float(values[0]), each.dimension),
            )
            yield Finding(
                "note", "", f"outputs.{name}", message, _("check its formula, if it should change"), "constant"
            )


def _texts(mechanism: Mechanism) -> Iterator[tuple[str, str]]:
    """What expectations, objectives and demands are on, by their keys."""
    for name, entry in mechanism.expect.items():
        yield f"expect.{name}", str(entry.get("of", name) if isinstance(entry, Mapping) else name)
    for key in ("minimize", "maximize"):
        goals = mechanism.optimize.get(key) or ()
        for text in [goals] if isinstance(goals, str) else goals if isinstance(goals, Iterable) else ():
            yield f"optimize.{key}", str(text)
    keep = mechanism.optimize.get("keep")
    for name in keep if isinstance(keep, Mapping) else ():
        yield f"optimize.keep.{name}", str(name)


def _summed(mechanism: Mechanism, text: str) -> Output | None:
    """The output that a text means alone, or sums up; None for metrics, dimensions and expressions."""
    from linkwright.analysis.by_name import is_metric, is_summary, wanted

    if text in mechanism.dimensions() or is_metric(text):
        return None
    try:
        return output_meant(mechanism, wanted([text])[0].output if is_summary(text) else text)
    except RequestError:
        return None
