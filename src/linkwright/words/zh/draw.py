"""命令 ``draw``，以及与 ``animate`` 共用的词句。"""

WORDS = {
    "summary": "机构运动简图（SVG、PNG 或 PDF）",
    "description": """\
用标准符号绘制机构运动简图：起始位置，或给定输入、给定时刻的位置；
可叠加极限位置、点的轨迹、速度、加速度、力和尺寸线。""",
    "where_title": "位置",
    "what_title": "内容",
    "form_title": "文件",
    "steps_help": "循环等分的步数（默认 {steps}）",
    "at_help": '按第一个驱动的输入绘制："30 deg"；多个驱动："NAME=…; NAME=…"',
    "time_help": '按时刻绘制："0.5 s"',
    "overlay_help": "叠加的位置：limits（最后一个输出的极限位置）、limits:jaw（某构件或导路的极限位置）、"
    "faded:8（循环内的若干位置）",
    "paths_help": "循环内点的轨迹：C,jaw.D",
    "velocities_help": "这些点的速度；不写名称则为全部",
    "accelerations_help": "这些点的加速度；不写名称则为全部",
    "forces_help": "载荷和这些运动副的反力（B：作用在最后一个构件上；rocker.B：作用在该构件上）；"
    "不写名称则为全部",
    "static_help": "不计惯性力",
    "centres_help": "标出质心",
    "dimensions_help": "构件（pitman、frame）的长度和角度，或两点间距离（O1:O3）；不写名称则标注全部构件",
    "labels_help": "点和构件的名称（默认 all）",
    "inputs_help": "驱动处的箭头",
    "output_help": "写入 FILE.svg、FILE.png 或 FILE.pdf",
    "width_help": "宽度，像素（SVG 和 PDF：长边）",
    "fonts_help": "优先于系统字体使用的字体文件，或其所在文件夹",
    "one_position": "{option}：“{text}”不止一个值；请只给一个",
    "not_reached": "提示：{of} 个位置中有 {count} 个到不了，已略去；第一个：{sentence}",
}
