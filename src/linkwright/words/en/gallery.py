"""The command ``gallery``."""

WORDS = {
    "summary": "machines and calculations that come with Linkwright: list, show, copy",
    "description": """\
Machines that come with Linkwright, from single dyads to an excavator arm. Each
file states its purpose, its source and expected numbers. gallery:NAME stands for
such a file wherever a command takes a model file.""",
    "examples": """\
linkwright gallery list
linkwright gallery list crusher                  names that contain "crusher"
linkwright gallery show slider_crank_inline
linkwright gallery copy jaw_crusher_sixbar .     a file of your own to change""",
    "action_help": "what to do (default: list)",
    "name_help": "name of a model; for list: a part of names",
    "folder_help": "folder for the copy (default: the current one)",
    "hint": "linkwright gallery show NAME prints a file; linkwright solve gallery:NAME solves it.",
    "tasks": "Tasks of synthesis (linkwright synthesize gallery:NAME):",
    "calculations": "Calculations of machine parts (linkwright beam, statics, vibration, …):",
    "which": "gallery {action}: which one? give a name; linkwright gallery list shows all",
    "unknown": 'the gallery has no model "{name}"',
}
