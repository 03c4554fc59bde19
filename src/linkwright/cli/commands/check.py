"""``linkwright check``: everything that is wrong with model files, at once."""

from __future__ import annotations

from linkwright.cli.command import command
from linkwright.cli.options import Options, argument, flag
from linkwright.cli.session import Session, bold
from linkwright.errors import NO_FILE
from linkwright.words import _


@command(
    _("find everything that is wrong with a model file"),
    _(
        """\
Reads model files and reports every finding at once, each with its place
(file:line:column), the cause and what to do about it. A file that reads well is
then analysed and turned through its cycle, so that a mechanism that cannot
move, or cannot reach a position, is found as well. --expect also evaluates what
the section "expect" of the file says must hold, and prints each expectation with
what was found and the verdict; one that fails is an error."""
    ),
    _(
        """\
linkwright check crusher.yaml
linkwright check *.yaml --strict      warnings count as errors
linkwright check press.yaml --expect  what must hold, and what does not
linkwright check crusher.yaml --json  findings for an editor or a script"""
    ),
)
@argument("files", "FILE", help=_("model files, or gallery:NAME"), nargs=-1, required=True, model=True)
@flag("--strict", help=_("warnings count as errors"))
@flag("--expect", help=_("evaluate the section expect: what must hold, with what was found"))
def run(options: Options, session: Session) -> int:
    """Reads, analyses and turns each model once; 1 if any has an error, 2 if a file is not there."""
    from linkwright.file_check import checked

    results = [(name, checked(name, expect=options.expect)) for name in options.files]
    if session.json:
        files = [{"file": name, **found.data()} for name, found in results]
        session.show_data({"ok": all(entry["ok"] for entry in files), "files": files})
    else:
        for name, found in results:
            if found.expectations is not None and len(found.expectations):
                session.show_tables(found.expectations)
                session.show("")
            summary = session.translate(found.summary(name))
            session.show(*map(session.finding, found.findings), bold(summary) if found.errors else summary)
    everything = [finding for _unused, found in results for finding in found.findings]
    if any(finding.code in NO_FILE for finding in everything):
        return 2
    grave = {"error", "warning"} if options.strict else {"error"}
    return int(any(finding.severity in grave for finding in everything))
