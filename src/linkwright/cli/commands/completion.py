"""``linkwright completion``: the script with which a shell completes commands, options and models."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.options import Options, argument
from linkwright.cli.session import Session
from linkwright.words import _

SHELLS = ("bash", "zsh", "fish")


@command(
    _("shell completion: bash, zsh, fish"),
    _(
        """\
Prints the script with which a shell completes commands, options, their choices,
files and the models of the gallery."""
    ),
    """\
linkwright completion bash >> ~/.bashrc
linkwright completion zsh > ~/.zfunc/_linkwright
linkwright completion fish > ~/.config/fish/completions/linkwright.fish""",
)
@argument("shell", "|".join(SHELLS), choices=SHELLS, help=_("the shell"))
def run(options: Options, session: Session) -> int:
    """Prints the script."""
    from click.shell_completion import get_completion_class

    from linkwright.cli.program import COMPLETE, PROGRAM

    shell = get_completion_class(options.shell)
    assert shell is not None
    script = shell(PROGRAM, {}, "linkwright", COMPLETE).source()
    if options.shell == "bash":
        script = f"COMP_WORDBREAKS=${{COMP_WORDBREAKS//:}}\n{script}"  # gallery:NAME is one word
    session.show_as_is(script.rstrip())
    return 0
