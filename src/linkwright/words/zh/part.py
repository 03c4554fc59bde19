"""机械零件计算命令的共同用语。"""

WORDS = {
    "file_help": "写有 kind: … 的文件,或 gallery:名称",
    "worked_help": "逐步显示计算过程",
    "plot_help": "把图画到 .svg、.pdf 或 .png 文件",
    "output_help": "把曲线写入 .csv 文件,或把全部数值写入 .json 文件",
    "other_command": "该文件的类型是 {kind};请使用:linkwright {command} {file}",
    "no_curves": "{path}:该结果没有曲线可写;请使用 .json 后缀",
}
