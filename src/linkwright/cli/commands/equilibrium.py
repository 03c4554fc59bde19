"""``linkwright equilibrium``: positions in which a machine stays at rest by itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

from linkwright.cli.command import command
from linkwright.cli.errors import UsageError, did_you_mean
from linkwright.cli.options import RESULTS, Options, flag, force, model, option, output
from linkwright.cli.session import Session
from linkwright.words import _

if TYPE_CHECKING:
    from linkwright.mechanism.mechanism import Mechanism

NO_NAME = _(
    '{option}: "{text}" does not say of which driver; write NAME=…, the drivers are {names}',
    code="equilibrium.no_driver_named",
)
NO_FORCE = _(
    '--push: "{text}" is no force on a point; write POINT=FX, FY, such as "B=10 N, -5 N"', code="equilibrium.no_force"
)


@command(
    _("positions at rest, stable or not, natural frequencies"),
    _(
        """\
Finds all positions in which a machine stays at rest by itself under springs, weights,
constant forces and actuators, over a full turn of its input or all that it reaches:
stable or not, with the natural frequency and the damping ratio of small vibrations and
the work that takes it over the next unstable position."""
    ),
    _(
        """\
linkwright equilibrium gallery:lid_on_gas_strut
linkwright equilibrium lamp.yaml --range "-30..80 deg" --worked
linkwright equilibrium lid.yaml --push "H=0 N, -20 N"        how far a force moves it
linkwright equilibrium fivebar.yaml --hold "two=30 deg"      one of two inputs held"""
    ),
)
@model
@option("--range", "RANGE", help=_('where to look: "-30..80 deg"; of several drivers "NAME=0..90 deg"'), several=True)
@option("--hold", "NAME=VALUE", help=_("a driver that holds its coordinate, and where"), several=True)
@option("--push", "POINT=FX,FY", help=_("a force on a point: how far it moves every stable position"), several=True)
@flag("--worked", help=_("what every load contributes at each position, with stiffness and inertia"))
@output(RESULTS, _("write the positions to a .csv or .json file (SI units), or a .xlsx, .md or .html file"))
@force
def run(options: Options, session: Session) -> int:
    """Finds the positions at rest and prints them."""
    from linkwright.cli.files import present, read_model
    from linkwright.dynamics.equilibrium import equilibrium

    mechanism, _findings = read_model(options.file, session)
    pushes = [_push(text) for text in options.push or ()]
    held = _held(options.hold or (), mechanism)
    found = equilibrium(mechanism, ranges=_ranges(options.range or (), mechanism, held), held=held)
    present(found.pushed(pushes), options, session, worked=options.worked)
    return 0


def _named(text: str, mechanism: Mechanism, option: str, known: list[str]) -> tuple[str, str]:
    """Driver and value of ``NAME=VALUE``; of the one there is, the value alone."""
    name, equals, value = (each.strip() for each in text.partition("="))
    if not equals:
        if len(known) != 1:
            raise UsageError(NO_NAME.format(option=option, text=text, names=tuple(mechanism.drivers)))
        return known[0], name
    if name not in mechanism.drivers:
        text = _('there is no driver "{name}"', code="solve.no_driver", name=name)
        raise UsageError(_("{name}: {cause}", name=option, cause=did_you_mean(text, name, mechanism.drivers)))
    return name, value


def _dimension(mechanism: Mechanism, name: str) -> str:
    return "angle" if mechanism.drivers[name].law.rotary else "length"


def _held(texts: tuple[str, ...], mechanism: Mechanism) -> dict[str, float]:
    from linkwright.cli.positions import only, quantities

    found = {}
    for text in texts:
        name, value = _named(text, mechanism, "--hold", [])
        found[name] = only(quantities(value, _dimension(mechanism, name), "--hold"), value, "--hold")
    return found


def _ranges(
    texts: tuple[str, ...], mechanism: Mechanism, held: dict[str, float]
) -> dict[str, tuple[float, float]] | None:
    from linkwright.cli.positions import zone_of
    from linkwright.errors import LinkwrightError, about

    found = {}
    free = [name for name in mechanism.drivers if name not in held]
    for text in texts:
        name, value = _named(text, mechanism, "--range", free)
        with about("--range", UsageError, LinkwrightError):
            found[name] = zone_of(value, _dimension(mechanism, name), "--range")
    return found or None


def _push(text: str) -> tuple[str, tuple[float, float]]:
    from linkwright.cli.positions import quantities

    point, equals, value = (each.strip() for each in text.partition("="))
    forces = quantities(value, "force", "--push") if equals else []
    if len(forces) != 2:
        raise UsageError(NO_FORCE.format(text=text))
    return point, (forces[0], forces[1])
