"""命令 ``solve``。"""

WORDS = {
    "summary": "一个循环内的运动、运动副反力与平衡力",
    "description": """\
求解机构的一个循环，或给定输入、给定时刻的位置，并输出表格：
输入、各构件的角度、角速度、角加速度，以及平衡力矩（力）。
表下列出各运动副的最大反力和结果的校核。
角度以度计（--si：弧度），逆时针为正。""",
    "examples": """\
linkwright solve gallery:jaw_crusher_sixbar
linkwright solve crusher.yaml --at 0..90deg:10        输入每隔 10°
linkwright solve crusher.yaml --at "0 deg, 30 deg" --points C jaw.D
linkwright solve crusher.yaml --columns "jaw.*" "O5 on jaw"
linkwright solve crusher.yaml --steps 360 --output crusher.csv
linkwright solve gallery:excavator --times "0..8 s:0.5" --json""",
    "where_title": "位置",
    "what_title": "结果",
    "form_title": "形式",
    "steps_help": "循环等分的步数（默认 24）",
    "at_help": '第一个驱动的输入，按所写顺序："0 deg, 30 deg"、0..-360deg:15（起..止:步长）、极限位置 '
    '"rocker min, rocker max" 或 limits；多个驱动："NAME=…; NAME=…"',
    "times_help": '时刻，按所写顺序："0 s, 0.1 s"、"0..2 s:0.1"、极限位置 limits 或 "boom max"',
    "columns_help": '按名称选列："jaw.*"、"C.velocity.x"、"O5 on jaw"；--json 显示全部名称',
    "points_help": "点的位置、速度与加速度：C、jaw.D",
    "forces_help": "运动副反力与平衡力（模型有质量或载荷时默认计算）",
    "static_help": "不计惯性力",
    "mark_help": "到不了的位置留空并说明原因，而不是拒绝求解",
    "prove_help": "证明每一步都保持装配模式（无封闭解的杆组）",
    "si_help": "角度用弧度",
    "output_help": "把全部列以国际单位写入 FILE.csv 或 FILE.json",
    "structure": "自由度 {mobility}：{chain}",
    "input": "输入",
    "driver": "驱动",
    "quantity.time": "时间",
    "quantity.angle": "角度",
    "quantity.angular_velocity": "角速度",
    "quantity.angular_acceleration": "角加速度",
    "quantity.displacement": "位移",
    "quantity.velocity": "速度",
    "quantity.acceleration": "加速度",
    "quantity.direction": "方向角",
    "quantity.couple": "力偶",
    "quantity.effort": "平衡力",
    "quantity.torque": "力矩",
    "quantity.force": "力",
    "joint_forces": "各运动副的反力",
    "largest_of_cycle": "整个循环中各运动副的最大反力（包括各位置之间）",
    "largest_forces": "各运动副的最大反力（共 {count} 个位置）",
    "effort": "{name}：{value} {unit}",
    "joint": "运动副",
    "on": "受力构件",
    "force_there": "反力 N",
    "at_input": "输入",
    "at": "（输入 {place}）",
    "effort_range": "{name}：由 {low} {unit}{low_at}到 {high} {unit}{high_at}",
    "effort_mean": "，平均 {mean} {unit}",
    "power_check": "校核：由反力与由全部功率求得的驱动功率最多相差 {residual} W（最大功率 {size} W）",
    "balance_check": "校核：各构件受力平衡，误差不超过 {residual} N（最大反力 {size} N）",
    "first_turn": "表中为 {turns} 圈中的第一圈；--steps N 显示全部各圈的 N 步，"
    "--at 720deg..1080deg:15deg 显示其他圈",
    "left_out": '因宽度未列出：{names}。用 --columns "{one}.*" 查看；--output FILE.csv 写出全部 {total} 列。',
    "note": "提示：{text}",
    "not_reached": "到不了的位置：{of} 个中的 {count} 个",
    "empty_value": "“{text}”的逗号之间有空缺",
    "range_step": "“{text}”没有步长；应写作 起..止:步长，如 0..90deg:10",
    "step_away": "“{text}”的步长背离终点；请改变步长的正负号",
    "step_key": "“{name}”不是按步长列出位置的键；{hint}",
    "step_keys": "按步长列出位置须给出 from 以及 step、to、count 中的两个："
    "{{from: 0 deg, step: -15 deg, to: -360 deg}}",
    "step_from_limit": "从“{text}”开始时，应给出一个极限位置以及 step 与 count："
    "{{from: jaw max, step: 15 deg, count: 24}}",
    "no_limits": "“{name}”中与机架相连的构件都不往复运动，limits 没有对应的位置；请写出往复的输出："
    "“coupler limits”、“C.x max”",
    "bad_count": "“{text}”不是位置数；请给出 2 至 {most}",
    "range_long": "“{text}”超过 {most} 步；请加大步长",
    "too_many": "--steps 为 {steps}；最多 {most}",
    "no_driver": "没有驱动“{name}”",
    "no_input": "模型没有驱动，因此没有可给定的输入",
    "uneven": "--at：各驱动的值个数不同（{counts}）；应个数相同，或只给一个",
    "no_column": "没有名为“{pattern}”的列；有以下对象的列：{owners}",
}
