"""The study of a mechanism's tolerances and clearances: what is wrong with it, and its result."""

from __future__ import annotations

from dataclasses import dataclass, fields

from linkwright import units
from linkwright.analysis.base import METRICS
from linkwright.analysis.by_name import is_metric, wanted
from linkwright.designs.ranges import dimension_of
from linkwright.designs.tolerance.problem import MIN_SAMPLES, Clearance, Tolerance, Tolerances
from linkwright.designs.tolerance.result import Spread
from linkwright.designs.varied_dimensions import misfits
from linkwright.errors import Finding, LinkwrightError, ModelError, RequestError, fault
from linkwright.files.write import dump
from linkwright.kinematics.names import output_meant
from linkwright.registry import PROBABLE, nearest
from linkwright.words import _, pgettext


@dataclass(frozen=True)
class ToleranceStudy(Tolerances):
    """Tolerances by address of a dimension (``crank.length``), clearances by pin, and the outputs ``of`` interest.

    ``of``: summaries over the cycle as in sweeps (``rocker.angle range``, ``driver.effort peak``), or metrics
    (``stroke``, ``peak_reaction A``) where no clearance is pressed; ``curves``: outputs over the cycle;
    ``limits`` by what is asked.
    """

    @property
    def inputs(self) -> tuple[object, ...]:
        """Everything that the numbers of the study depend on."""
        names = {each.name for each in fields(self)} - {"source", "mechanism"}
        return dump(self.mechanism), {name: getattr(self, name) for name in sorted(names)}

    def findings(self) -> list[Finding]:
        found = (
            []
            if self.dimensions or self.clearances
            else [
                fault(
                    "nothing_varies",
                    "dimensions",
                    _("nothing varies"),
                    _("write dimensions: {{crank.length: 0.05 mm}}, or clearances"),
                )
            ]
        )
        found += (
            []
            if self.of or self.curves
            else [
                fault("nothing_asked", "of", _("nothing is asked"), _('write of: ["rocker.angle range"], or curves'))
            ]
        )
        for address, tolerance in self.dimensions.items():
            found += self._dimension_findings(address, tolerance)
        for pin, clearance in self.clearances.items():
            found += self._clearance_findings(pin, clearance)
        found += self._name_findings()
        found += [
            fault(
                "limit_of",
                f"limits.{name}",
                _('there is a limit of "{name}", which is not asked'),
                _("name it under of as well"),
                name=name,
            )
            for name in self.limits
            if name not in self.of
        ]
        found += [
            fault(
                "limits_order",
                f"limits.{name}",
                _("the upper limit is not above the lower one"),
                _("give the larger value as upper"),
            )
            for name, limit in self.limits.items()
            if limit.lower >= limit.upper
        ]
        if self.samples < MIN_SAMPLES:
            found.append(
                fault(
                    "few_samples",
                    "samples",
                    _("too few machines to tell a spread"),
                    pgettext("tolerance", "give at least {least}"),
                    least=MIN_SAMPLES,
                )
            )
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
                    fault(
                        "no_number",
                        key,
                        _('there is no output or metric "{name}"'),
                        _('did you mean "{offer}"?'),
                        name=text,
                        offer=offer,
                    )
                    if offer
                    else Finding("error", "", key, error.sentence, "", "unknown-name")
                )
        return found

    def _dimension_findings(self, address: str, tolerance: Tolerance) -> list[Finding]:
        key, known = f"dimensions.{address}", self.mechanism.dimensions()
        if address not in known:
            return [
                fault(
                    "no_dimension",
                    key,
                    _('the mechanism has no dimension "{name}"'),
                    _("the nearest is {nearest}"),
                    name=address,
                    nearest=nearest(address, known) or "—",
                )
            ]
        if tolerance.tolerance <= 0:
            return [
                fault(
                    "not_above_zero",
                    key,
                    _("a tolerance of zero or less"),
                    _("give a tolerance above zero, or leave it out"),
                )
            ]
        needed = dimension_of(self.mechanism, address)
        if tolerance.dimension not in (None, units.NONE, needed) and needed is not None:
            assert tolerance.dimension is not None
            found, wanted = units.name_of(tolerance.dimension), units.name_of(needed)
            return [
                fault(
                    "wrong_kind",
                    key,
                    _("the tolerance of {name} is {given}, where {needed} is needed"),
                    _("write it in the unit of the dimension"),
                    name=address,
                    given=found,
                    needed=wanted,
                )
            ]
        owner = address.partition(".")[0]
        moved = any(clearance.on == owner for clearance in self.clearances.values())
        link = self.mechanism.links.get(owner)
        if moved and link is not None and self.alias(address) not in self.prepared.dimensions():
            return [
                fault(
                    "bent_clearance",
                    key,
                    _("{link} has a hole with clearance and a tolerance that its coordinates do not show"),
                    _("give the clearance on the other link of the pin"),
                    link=owner,
                )
            ]
        return self._wheel_findings(key, address, tolerance.tolerance)

    def _wheel_findings(self, key: str, address: str, change: float) -> list[Finding]:
        """Pairs of wheels that no longer fit when a dimension changes."""
        return [
            fault(
                "wheels",
                key,
                _("{why} as soon as this changes"),
                _("give the pair by its teeth, or by its ratio, alone: such a pair takes any distance"),
                why=why,
            )
            for why in misfits(self.mechanism, address, change)
        ]

    def _clearance_findings(self, pin: str, clearance: Clearance) -> list[Finding]:
        joint = self.mechanism.pins.get(pin)
        key = f"clearances.{pin}"
        if joint is None:
            return [
                fault(
                    "no_pin",
                    key,
                    _('there is no pin "{name}"'),
                    _("one of: {known}"),
                    name=pin,
                    known=tuple(self.mechanism.pins),
                )
            ]
        if clearance.on not in joint.joined:
            return [
                fault(
                    "not_on",
                    f"{key}.on",
                    _("the pin {pin} does not touch {link}"),
                    _("one of: {known}"),
                    pin=pin,
                    link=clearance.on,
                    known=", ".join(joint.joined),
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
            raise ModelError(
                [
                    fault(
                        "unsolved",
                        "mechanism",
                        _("the study cannot be made: {why}"),
                        _("mend the mechanism or the names (linkwright check, linkwright solve)"),
                        why=error.sentence,
                    )
                ]
            ) from None
        return found
