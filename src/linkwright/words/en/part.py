"""What the commands for machine parts have in common."""

WORDS = {
    "file_help": "file with kind: …, or gallery:NAME",
    "worked_help": "show the way to the numbers, step by step",
    "digits_help": "significant digits of the numbers (3 to 15; default: 6)",
    "plot_help": "draw the diagram in a .svg, .pdf or .png file",
    "output_help": "write curves to a .csv file or all numbers to a .json file",
    "other_command": "the file is of kind {kind}; call: linkwright {command} {file}",
    "no_curves": "{path}: this result has no curves to write; choose an ending .json",
    "no_whole": '"{text}" is not a whole number of {least} or more',
    "no_whole_remedy": "write digits only",
    "no_values": 'the key "values" is missing',
    "no_values_remedy": "add it: values: [20.1, 19.9]",
    "kinds_differ": "the values differ in kind: {first} and {second}",
    "kinds_differ_remedy": "give all of one kind",
    "mechanism_file": "{name}: {message}",
    "no_kind": "the file does not say what is calculated",
    "no_kind_remedy": "add kind: (one of {known})",
    "known": "(known: {known})",
    "nearest": 'did you mean "{offer}"? (known: {known})',
}
