"""The command ``completion``."""

WORDS = {
    "summary": "shell completion: bash, zsh, fish",
    "description": "Prints the script with which a shell completes commands, options, their choices,\nfiles "
    "and the models of the gallery.",
    "examples": "linkwright completion bash >> ~/.bashrc\nlinkwright completion zsh > "
    "~/.zfunc/_linkwright\nlinkwright completion fish > ~/.config/fish/completions/linkwright.fish",
    "shell_help": "the shell",
}
