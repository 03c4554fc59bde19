"""The command ``check``."""

WORDS = {
    "summary": "find everything that is wrong with a model file",
    "description": """\
Reads model files and reports every finding at once, each with its place
(file:line:column), the cause and what to do about it. A file that reads well is
then analysed and turned through its cycle, so that a mechanism that cannot
move, or cannot reach a position, is found as well.""",
    "examples": """\
linkwright check crusher.yaml
linkwright check *.yaml --strict      warnings count as errors
linkwright check crusher.yaml --json  findings for an editor or a script""",
    "files_help": "model files, or gallery:NAME",
    "strict_help": "warnings count as errors",
    "fine": "{name}: fine ({links} moving links, mobility {mobility})",
    "fine_kind": "{name}: fine (kind {kind})",
    "faulty": "{name}: errors: {count}",
    "never_increasing": "the load never acts: {output} does not increase anywhere in the cycle",
    "never_decreasing": "the load never acts: {output} does not decrease anywhere in the cycle",
    "never_do": "name an output that moves that way, or the other direction",
    "no_pin_radius": "the pin has friction, but no radius, so its forces cannot be found",
    "add_pin_radius": "add pin_radius, such as pin_radius: 20 mm",
    "rubs": "a coefficient of friction of {friction:g} is more than dry rubber has",
    "rubs_do": "usual are 0.01 to 0.6; check it",
    "assumed": "group {signature} ({links}) has two assemblies, and neither assembly nor drawing says which: "
    '"{first}" is taken; write assembly: {{{joint}: {first}}} or {{{joint}: {second}}}',
    "singular": "group ({links}) is close to a singular position all the time (determinant of its closure at most "
    "{best}, limit {limit}): its motion is hardly determined, and forces grow very large",
    "singular_do": "change the lengths of its links or where they are joined",
}
