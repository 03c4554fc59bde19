"""The command ``completion``."""

WORDS = {
    "summary": "shell completion: bash, zsh, fish",
    "description": "Prints the script with which a shell completes commands, options, their choices,\nfiles "
    "and the models of the gallery.",
    "shell_help": "the shell",
}
