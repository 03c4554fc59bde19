"""命令 ``gallery``。"""

WORDS = {
    "summary": "随 Linkwright 提供的机构：列出、显示、复制",
    "description": """\
随 Linkwright 提供的机构，从单个Ⅱ级杆组到挖掘机臂。
每个文件写明用途、来源和应得的数值。
凡命令需要模型文件之处，都可以写 gallery:NAME。""",
    "examples": """\
linkwright gallery list
linkwright gallery list crusher                  名称含“crusher”的机构
linkwright gallery show slider_crank_inline
linkwright gallery copy jaw_crusher_sixbar .     复制一份供自己修改""",
    "action_help": "要做什么（默认 list）",
    "name_help": "机构名称；用于 list 时为名称的一部分",
    "folder_help": "复制到的文件夹（默认当前文件夹）",
    "hint": "linkwright gallery show NAME 显示文件；linkwright solve gallery:NAME 求解。",
    "tasks": "综合任务（linkwright synthesize gallery:名称）：",
    "calculations": "机械零件计算（linkwright beam、statics、vibration……）：",
    "which": "gallery {action}：请给出机构名称；linkwright gallery list 列出全部",
    "unknown": "机构库中没有“{name}”",
}
