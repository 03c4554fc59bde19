"""What all commands share."""

WORDS = {
    "tagline": "Linkwright: analysis and design of planar machines.",
    "start": """\
Linkwright reads a short text file that describes a planar machine, and answers
what its designer asks: can it move, where does it go, what do its joints carry.

Three commands to begin with:

  linkwright gallery list                      machines that come with Linkwright
  linkwright structure gallery:shaper_quick_return
                                               mobility and Assur groups
  linkwright solve gallery:jaw_crusher_sixbar  motion, forces and drive torque

Every command takes your own model file in place of gallery:NAME.
All commands: linkwright --help""",
    "usage": "usage: ",
    "usage_line": "linkwright COMMAND [options]",
    "commands": "commands",
    "arguments": "arguments",
    "options": "options",
    "examples": "examples",
    "common": "options of every command",
    "exit_title": "exit codes",
    "exit_codes": """\
0    done, nothing to complain about
1    an error in the model, or a position that cannot be reached
2    the command itself is wrong: an unknown option, name or file
130  interrupted""",
    "more": "linkwright COMMAND --help explains a command, with examples.",
    "help_help": "show this help",
    "version_help": "print the versions of what is at work",
    "lang_help": "language of what is printed: en or zh (default: LINKWRIGHT_LANG, else en)",
    "json_help": "print data (JSON, SI units) for programs",
    "debug_help": "show where in the program an unexpected error arose",
    "force_help": "replace files that exist",
    "file_help": "model file, or gallery:NAME",
    "error": "error",
    "headed": "{head}: {sentence}",
    "about": "{name}: {cause}",
    "unknown_command": 'there is no command "{name}"',
    "unknown_option": 'there is no option "{name}"',
    "write_option": "write {name} {word}",
    "unknown_argument": 'the argument "{name}" is not expected here',
    "missing": "{names} is missing",
    "needs_value": "{name} needs a value",
    "bad_choice": '{name} cannot be "{value}"; choose from {choices}',
    "bad_whole": '{name} takes a whole number, not "{value}"',
    "not_together": "{name} cannot be used together with {other}",
    "bad_language": 'there is no language "{name}"; choose en or zh',
    "output_lost": "the output cannot be written ({reason})",
    "interrupted": "interrupted",
    "unexpected": "this should not have happened ({kind}: {message}); please report it with the command and "
    "the model file; --debug shows where it arose",
    "out_of_memory": "there is not enough memory for this; ask for fewer steps",
    "written": "written: {path}",
    "bad_suffix": '"{path}": the ending says what is written; end the name in {endings}',
    "version": "linkwright {version}\nPython {python}, numpy {numpy}",
    "llvmlite_there": "llvmlite {version}: sweeps of many designs run compiled",
    "llvmlite_missing": "llvmlite is not installed: everything works, sweeps of many designs are slower "
    "(pip install llvmlite)",
    "not_installed": "not installed",
    "time_left": "about {time} left",
    "severity.error": "error",
    "severity.warning": "warning",
    "severity.note": "note",
    "see_help_of": "see {command} --help",
    "takes_no_value": "{name} takes no value",
    "bad_number": '{name} takes a number, not "{value}"',
}
