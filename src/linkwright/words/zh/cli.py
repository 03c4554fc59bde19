"""所有命令共用的文字。"""

WORDS = {
    "tagline": "Linkwright：平面机构的分析与设计。",
    "start": """\
Linkwright 读取描述平面机构的简短文本文件，回答设计者的问题：
它能否运动，各点走到哪里，各运动副承受多大的力。

可以先试三条命令：

  linkwright gallery list                      随 Linkwright 提供的机构
  linkwright structure gallery:shaper_quick_return
                                               自由度与杆组
  linkwright solve gallery:jaw_crusher_sixbar  运动、受力与平衡力矩

每条命令都可以用自己的模型文件代替 gallery:NAME。
全部命令：linkwright --help""",
    "usage": "用法：",
    "usage_line": "linkwright 命令 [选项]",
    "commands": "命令",
    "arguments": "参数",
    "options": "选项",
    "examples": "示例",
    "common": "各命令通用的选项",
    "exit_title": "退出码",
    "exit_codes": """\
0    完成，没有问题
1    模型有错误，或某个位置无法到达
2    命令本身有误：选项、名称或文件不存在
130  被中断""",
    "more": "linkwright 命令 --help 说明该命令并给出示例。",
    "help_help": "显示本帮助",
    "version_help": "显示所用各部分的版本",
    "lang_help": "输出语言：en 或 zh（默认取 LINKWRIGHT_LANG，否则 en）",
    "json_help": "输出供程序使用的数据（JSON，国际单位）",
    "debug_help": "显示意外错误在程序中的出处",
    "force_help": "覆盖已存在的文件",
    "file_help": "模型文件，或 gallery:NAME",
    "error": "错误",
    "headed": "{head}：{sentence}",
    "about": "{name}：{cause}",
    "unknown_command": "没有命令“{name}”",
    "unknown_option": "没有选项“{name}”",
    "write_option": "请写 {name} {word}",
    "unknown_argument": "此处不应有参数“{name}”",
    "missing": "缺少 {names}",
    "needs_value": "{name} 需要一个值",
    "bad_choice": "{name} 不能是“{value}”；可选：{choices}",
    "bad_whole": "{name} 应为整数，而不是“{value}”",
    "not_together": "{name} 不能与 {other} 同时使用",
    "bad_language": "没有语言“{name}”；请选 en 或 zh",
    "output_lost": "无法写出结果（{reason}）",
    "interrupted": "已中断",
    "unexpected": "不应出现的错误（{kind}：{message}）；请连同命令和模型文件一起报告；--debug 显示出处",
    "out_of_memory": "内存不足；请减少步数",
    "written": "已写入：{path}",
    "bad_suffix": "“{path}”：文件类型由扩展名决定，可用 {endings}",
    "version": "linkwright {version}\nPython {python},numpy {numpy}",
    "llvmlite_there": "llvmlite {version}：大量方案的扫描经编译执行",
    "llvmlite_missing": "未安装 llvmlite：功能齐全，但大量方案的扫描较慢（pip install llvmlite）",
    "not_installed": "未安装",
    "time_left": "约剩 {time}",
    "severity.error": "错误",
    "severity.warning": "警告",
    "severity.note": "提示",
    "see_help_of": "参见 {command} --help",
    "takes_no_value": "{name} 不带值",
    "bad_number": "{name} 应为数，而不是“{value}”",
}
