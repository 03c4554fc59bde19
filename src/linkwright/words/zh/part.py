"""机械零件计算命令的共同用语。"""

WORDS = {
    "file_help": "写有 kind: … 的文件，或 gallery:名称",
    "worked_help": "逐步显示计算过程",
    "digits_help": "数值的有效位数（3 到 15；默认 6）",
    "plot_help": "把图画到 .svg、.pdf 或 .png 文件",
    "output_help": "把曲线写入 .csv 文件，或把全部数值写入 .json 文件",
    "other_command": "该文件的类型是 {kind}；请使用：linkwright {command} {file}",
    "no_curves": "{path}：该结果没有曲线可写；请使用 .json 后缀",
    "no_whole": "“{text}”不是不小于 {least} 的整数",
    "no_whole_remedy": "请只写数字",
    "no_values": "缺少键“values”",
    "no_values_remedy": "请加上：values: [20.1, 19.9]",
    "kinds_differ": "各值的量纲不同：{first}与{second}",
    "kinds_differ_remedy": "请给同一种量",
    "mechanism_file": "{name}：{message}",
    "no_kind": "文件没有说明计算什么",
    "no_kind_remedy": "请加 kind:（{known} 之一）",
    "known": "已知：{known}",
    "nearest": "是不是“{offer}”？（已知：{known}）",
}
