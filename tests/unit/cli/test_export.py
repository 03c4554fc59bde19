"""The command ``export`` has every format, and every option of every format."""

import inspect

from linkwright.cli.commands import export as command
from linkwright.cli.commands.export import OPTIONS
from linkwright.cli.session import Session
from linkwright.errors import speaker
from linkwright.exporters.export import FORMATS


def test_the_command_offers_every_format() -> None:
    assert set(command.NAMES) == set(FORMATS)


def test_every_option_of_every_format_is_on_the_command_line() -> None:
    options = {
        name
        for form in FORMATS.values()
        for name, parameter in inspect.signature(form.content).parameters.items()
        if parameter.kind is parameter.KEYWORD_ONLY
    }
    assert len(options) > 5
    assert options - {"text", "model"} <= set(OPTIONS)  # the text and the name are those of the file itself
    asked = ["m.yaml", "--output", "a.dxf", "--curve", "spline", "--no-labels", "--timestep", "0.001"]
    found = command.run.make_context("linkwright export", asked, obj=Session(speaker("en"))).params
    chosen = {"curve": "spline", "labels": False, "dimensions": None, "timestep": 0.001, "degrees": None}
    assert {name: found[name] for name in chosen} == chosen
    assert set(OPTIONS) <= set(found)
