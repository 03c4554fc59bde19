"""Share links of PMKS+: the machine as it lies at the first position that was reached, in one address."""

from __future__ import annotations

import math

from linkwright.applied_loads.base import Load
from linkwright.applied_loads.force import Force
from linkwright.applied_loads.sizes import Constant
from linkwright.drivers.base import Driver
from linkwright.errors import RequestError
from linkwright.exporters.export import FORMATS, Format
from linkwright.exporters.left_out import LeftOut
from linkwright.exporters.pmks_plus.link import ShareForce, ShareJoint, share_address
from linkwright.exporters.pmks_plus.machine import CM, FRAME, ShareParts
from linkwright.exporters.results import Results
from linkwright.joints.lower_pair import TurningJoint
from linkwright.words import _

#: Gravity that PMKS+ has where it is on, m/s².
GRAVITY = (0.0, -9.81)
RPM = math.pi / 30


def pmks_plus_content(results: Results) -> bytes:
    """The address of a machine in PMKS+ (app.pmksplus.com), which opens it; one line of text.

    Links with masses, inertias, centres and colours; pins, welds, blocks on guides of the ground and in slots of
    links, which get ends far enough for the solved motion; the one driver of constant speed, of a pin, a guide or a
    cylinder; constant forces; gravity. Lengths are in cm with all digits, angles in rad.

    Raises LinkwrightError for what PMKS+ does not have: wheels, cams, several drivers, other laws.
    """
    return (share_address(Converter(results).convert().share) + "\n").encode()


def pmks_plus_report(results: Results) -> LeftOut:
    """What the link leaves out or says in another way."""
    return LeftOut(results.mechanism.name, "PMKS+", tuple(Converter(results).convert().notes))


FORMATS.register("pmks_plus")(Format((".pmksplus",), pmks_plus_content, report=pmks_plus_report))


class Converter(ShareParts):
    """Makes the records of a whole machine."""

    def convert(self) -> Converter:
        """Adds all records."""
        driver, speed = self.driver()
        turned = isinstance(self.mechanism.joints[driver.joint], TurningJoint)
        grounded = turned and driver.relative_to == FRAME
        if grounded and driver.joint not in self.mechanism.frame.points:
            raise self.refuse(driver)
        self.add_joints((driver.joint, driver.link) if grounded else None)
        self.add_links()
        for guide in self.guides:
            line, sign = self.add_guide(guide)
            line.sealed = driver.cylinder is not None and guide.name == driver.joint and bool(line.carrier)
            if guide.name == driver.joint:
                self.drive(line, sign * speed * CM, 1)
        if turned:
            self.drive(self.joints[driver.link, driver.joint], speed / RPM, 0)
            if not grounded:
                self.share.clockwise ^= self.order(driver)
        self.loads()
        self.share.decimals[0] = max(round(12.5 * self.size) / 10, 0.1)
        return self

    # -- the driver

    def driver(self) -> tuple[Driver, float]:
        """The one driver, and its speed; raises LinkwrightError where there is none, several, or another law."""
        drivers = list(self.mechanism.drivers.values())
        if not drivers:
            raise RequestError(
                _("the machine has no driver, and PMKS+ shows motion; add one", code="export.pmks_no_driver")
            )
        if len(drivers) != 1:
            raise RequestError(
                _(
                    "PMKS+ drives one joint of a machine, and this one has {count} drivers; leave one of them",
                    code="export.pmks_drivers",
                    count=len(drivers),
                )
            )
        (driver,) = drivers
        speed = driver.law.own.constant_speed
        if not speed:
            raise self.refuse(driver)
        if driver.law.constant_speed is None:
            self.notes.append(
                _("{driver} goes to and fro at constant speed in PMKS+, without gentle ends.", driver=driver.name)
            )
        elif self.mechanism.cycle is not None:
            self.notes.append(_("The cycle is left out: PMKS+ drives on, or to and fro between the limits."))
        return driver, speed

    def refuse(self, driver: Driver) -> RequestError:
        """The error for a driver that PMKS+ does not have."""
        return RequestError(
            _(
                "{driver}: PMKS+ drives a pin or a slide at constant speed, between two links; change the driver",
                code="export.pmks_driver",
                driver=driver.name,
            )
        )

    def drive(self, joint: ShareJoint, speed: float, decimal: int) -> None:
        """A joint that is driven, rpm, or cm/s where ``decimal`` is 1."""
        joint.driven, self.share.clockwise = True, speed < 0
        if decimal:
            self.share.decimals[1] = abs(speed)
        else:
            self.share.integers[0] = abs(speed)

    def order(self, driver: Driver) -> bool:
        """Whether the driven link is the first of the two at the pin, which PMKS+ holds for the other one's base."""
        pin = self.joints[driver.link, driver.joint].id
        at_pin = [each.id for each in self.share.links if each.root and pin in each.joints]
        ends = [self.links[each].id for each in (driver.link, driver.relative_to) if each in self.links]
        if len(at_pin) != 2 or sorted(at_pin) != sorted(ends):
            raise self.refuse(driver)
        return at_pin[0] == ends[0]

    # -- masses and loads

    def loads(self) -> None:
        """Forces that do not change, and gravity; a note about the rest."""
        gravity = tuple(self.mechanism.gravity)
        self.share.gravity = gravity == GRAVITY
        if gravity not in (GRAVITY, (0.0, 0.0)):
            self.notes.append(_("Gravity is left out: in PMKS+ it is 9.81 m/s² downward, or off."))
        left = [name for name, load in self.mechanism.loads.items() if not self.load(load)]
        if left:
            self.notes.append(_("PMKS+ has constant forces on links only; left out: {loads}.", loads=tuple(left)))
        if (
            self.mechanism.actuators
            or self.mechanism.stops
            or any(getattr(each, "friction", 0) for each in self.mechanism.joints.values())
        ):
            self.notes.append(_("Friction, stops and characteristics of motors are left out."))

    def load(self, load: Load) -> bool:
        """A constant force as one of PMKS+; whether it is one."""
        if not isinstance(load, Force) or load.opposes or load.on not in self.links or not load.magnitude.constant:
            return False
        x, y = load.components or (0.0, 0.0)
        size = load.magnitude.size.value if isinstance(load.magnitude.size, Constant) else math.hypot(x, y)
        turned = (load.in_link, load.along, load.normal_to)
        angle = math.atan2(y, x) if load.components else self.angle(load)
        if not size:
            return False
        start = self.place(load.on, load.at)
        reach = math.copysign(0.2 * self.size, size)
        end = (start[0] + reach * math.cos(angle), start[1] + reach * math.sin(angle))
        number = len(self.share.forces) + 1
        follows = any(each is not None for each in turned)
        ends = [each * CM for each in (*start, *end)]
        made = ShareForce(
            f"F{number}", self.links[load.on].id, load.name, ends[0], ends[1], ends[2], ends[3], abs(size), follows
        )
        self.share.forces.append(made)
        return True

    def angle(self, load: Force) -> float:
        """The direction of a force at the position of the link, rad."""
        if load.direction is not None:
            return load.direction
        c, s = self.placed[load.on].direction[self.index]
        axis = math.atan2(s, c)
        if load.in_link is not None:
            return axis + load.in_link
        points = self.mechanism.links[load.on].points
        (x0, y0), (x1, y1) = (points[each] for each in load.normal_to or load.along or ())
        return axis + math.atan2(y1 - y0, x1 - x0) + (math.pi / 2 if load.normal_to else 0.0)
