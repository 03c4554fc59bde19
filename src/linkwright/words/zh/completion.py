"""命令 ``completion``。"""

WORDS = {
    "summary": "命令行补全：bash、zsh、fish",
    "description": "输出供命令行解释器补全命令、选项及其取值、文件和机构库模型的脚本。",
    "examples": "linkwright completion bash >> ~/.bashrc\nlinkwright completion zsh > "
    "~/.zfunc/_linkwright\nlinkwright completion fish > ~/.config/fish/completions/linkwright.fish",
    "shell_help": "命令行解释器",
}
