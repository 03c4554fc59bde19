"""The study of a mechanism's tolerances and clearances: what is wrong with it, and its result."""

from __future__ import annotations

from linkwright import units
from linkwright.core.dataclass import dataclass
from linkwright.designs.ranges import dimension_of
from linkwright.designs.tolerance.problem import LEAST, Clearance, Tolerance, Tolerances
from linkwright.designs.tolerance.result import Spread
from linkwright.designs.varied_dimensions import misfits
from linkwright.errors import Finding, LinkwrightError, ModelError, RequestError
from linkwright.kinematics.names import output_meant
from linkwright.metrics.base import METRICS
from linkwright.metrics.by_name import is_metric, wanted
from linkwright.parts.base import fault
from linkwright.registry import PROBABLE, nearest


@dataclass(frozen=True)
class ToleranceStudy(Tolerances):
    """Tolerances by address of a dimension (``crank.length``), clearances by pin, and the outputs ``of`` interest.

    ``of``: summaries over the cycle as in sweeps (``rocker.angle range``, ``driver.effort peak``), or design numbers
    (``stroke``, ``peak_reaction A``) where no clearance is pressed; ``curves``: outputs over the cycle;
    ``limits`` by what is asked.
    """

    def findings(self) -> list[Finding]:
        found = (
            [] if self.dimensions or self.clearances else [fault("tolerance.nothing_varies", "dimensions")]
        )
        found += [] if self.of or self.curves else [fault("tolerance.nothing_asked", "of")]
        for address, tolerance in self.dimensions.items():
            found += self._dimension_findings(address, tolerance)
        for pin, clearance in self.clearances.items():
            found += self._clearance_findings(pin, clearance)
        found += self._name_findings()
        found += [
            fault("tolerance.limit_of", f"limits.{name}", name=name)
            for name in self.limits
            if name not in self.of
        ]
        found += [
            fault("part.limits_order", f"limits.{name}")
            for name, limit in self.limits.items()
            if limit.lower >= limit.upper
        ]
        if self.samples < LEAST:
            found.append(fault("tolerance.few_samples", "samples", least=LEAST))
        return found

    def _name_findings(self) -> list[Finding]:
        """What is asked that the machine does not have."""
        asked = [(f"of.{k}", text) for k, text in enumerate(self.of)]
        asked += [(f"curves.{k}", text) for k, text in enumerate(self.curves)]
        found = []
        for key, text in asked:
            number = key.startswith("of")
            if number and is_metric(text):
                continue
            try:
                output_meant(self.mechanism, wanted([text])[0].output if number else text)
            except RequestError as error:
                offer = nearest(text[:100], list(METRICS), PROBABLE) if number else None
                found.append(
                    fault("tolerance.no_number", key, name=text, offer=offer)
                    if offer
                    else Finding("error", "", key, error.sentence, "", "unknown-name")
                )
        return found

    def _dimension_findings(self, address: str, tolerance: Tolerance) -> list[Finding]:
        key, known = f"dimensions.{address}", self.mechanism.dimensions()
        if address not in known:
            return [
                fault("tolerance.no_dimension", key, name=address, nearest=nearest(address, known) or "—")
            ]
        if tolerance.tolerance <= 0:
            return [fault("tolerance.not_above_zero", key)]
        needed = dimension_of(self.mechanism, address)
        if tolerance.dimension not in (None, units.NONE, needed) and needed is not None:
            assert tolerance.dimension is not None
            given, wanted = units.name_of(tolerance.dimension), units.name_of(needed)
            return [fault("tolerance.wrong_kind", key, name=address, given=given, needed=wanted)]
        owner = address.partition(".")[0]
        moved = any(clearance.on == owner for clearance in self.clearances.values())
        link = self.mechanism.links.get(owner)
        if moved and link is not None and self.alias(address) not in self.prepared.dimensions():
            return [fault("tolerance.bent_clearance", key, link=owner)]
        return self._wheel_findings(key, address, tolerance.tolerance)

    def _wheel_findings(self, key: str, address: str, change: float) -> list[Finding]:
        """Pairs of wheels that no longer fit when a dimension changes."""
        return [fault("tolerance.wheels", key, why=why) for why in misfits(self.mechanism, address, change)]

    def _clearance_findings(self, pin: str, clearance: Clearance) -> list[Finding]:
        joint = self.mechanism.pins.get(pin)
        key = f"clearances.{pin}"
        if joint is None:
            return [fault("tolerance.no_pin", key, name=pin, known=tuple(self.mechanism.pins))]
        if clearance.on not in joint.joined:
            return [
                fault(
                    "tolerance.not_on", f"{key}.on", pin=pin, link=clearance.on, known=", ".join(joint.joined)
                )
            ]
        address = f"{clearance.on}.{pin}.x"
        if address not in self.mechanism.dimensions():
            return []
        return self._wheel_findings(key, address, clearance.clearance)

    def solve(self) -> Spread:
        """The spread. Raises ModelError with all findings, also where the mechanism does not pass its cycle."""
        self.require()
        try:
            found = Spread(self)
            found.check()
        except ModelError:
            raise
        except LinkwrightError as error:
            raise ModelError([fault("tolerance.unsolved", "mechanism", why=error.sentence)]) from None
        return found
