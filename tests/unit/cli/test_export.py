"""The command ``export`` has every format, and every option of every format."""

import inspect

from linkwright.cli.commands import export as command
from linkwright.cli.commands.export import OPTIONS
from linkwright.cli.help import command_parser
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
    parser = command_parser("export", speaker("en"))
    found = parser.read(
        ["m.yaml", "--output", "a.dxf", "--curve", "spline", "--no-labels", "--timestep", "0.001"]
    )
    assert (found.curve, found.labels, found.dimensions, found.timestep) == ("spline", False, None, 0.001)
    assert set(OPTIONS) <= set(vars(found))
