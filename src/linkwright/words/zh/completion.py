"""命令 ``completion``。"""

WORDS = {
    "summary": "命令行补全：bash、zsh、fish",
    "description": "输出供命令行解释器补全命令、选项及其取值、文件和机构库模型的脚本。",
    "shell_help": "命令行解释器",
}
