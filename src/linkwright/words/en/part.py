"""What the commands for machine parts have in common."""

WORDS = {
    "file_help": "file with kind: …, or gallery:NAME",
    "worked_help": "show the way to the numbers, step by step",
    "plot_help": "draw the diagram in a .svg, .pdf or .png file",
    "output_help": "write curves to a .csv file or all numbers to a .json file",
    "other_command": "the file is of kind {kind}; call: linkwright {command} {file}",
    "no_curves": "{path}: this result has no curves to write; choose an ending .json",
}
