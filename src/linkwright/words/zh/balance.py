"""命令 ``balance``。"""

WORDS = {
    "summary": "四杆机构或曲柄滑块机构的平衡配重及其效果",
    "description": """\
为四杆机构或曲柄滑块机构设计配重，完全或部分平衡振动力，
并给出加配重前后振动力、振动力矩和平衡力矩的峰值。--output 写出平衡后的模型。""",
    "radius_help": '配重到所在转动副的距离：一个值（80mm）或按构件给出（"crank=80 mm, rod=40 mm"）',
    "share_help": "平衡的比例，0 到 1（默认 1：振动力为零）",
    "steps_help": "比较时一个循环内的位置数（默认 360）",
    "output_help": "把平衡后的模型写入 .yaml 文件",
    "bad_share": "--share：“{text}”不是比例；请给出 0（不平衡）到 1（完全平衡）之间的数",
    "bad_radius": "--radius：“{text}”不是半径；请给出大于零的长度，例如 80mm",
    "no_link": '--radius：没有构件 "{link}"',
    "none": "不需要配重：各构件没有质量，或质心已在所需位置。",
    "column.link": "配重所在构件",
    "column.mass": "质量 kg",
    "column.peak": "峰值",
    "column.unit": "单位",
    "column.without": "无配重",
    "column.with": "有配重",
    "column.share": "剩余",
    "shaking_force": "振动力",
    "shaking_moment": "对原点的振动力矩",
    "input_torque": "平衡力矩",
}
