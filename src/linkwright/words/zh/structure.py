"""命令 ``structure``。"""

WORDS = {
    "summary": "自由度与按求解顺序排列的杆组",
    "description": """\
输出机构的结构分析：构件数与运动副数，按格吕布勒公式计算的自由度，
特殊几何条件对它的影响，以及按求解顺序排列的杆组及其级别与阶数。""",
    "examples": """\
linkwright structure gallery:shaper_quick_return
linkwright structure crusher.yaml --program       逐行显示计算内容
linkwright structure crusher.yaml --json""",
    "program_help": "输出运动计算的直线程序及其运算次数",
    "forces_help": "输出连同运动副反力的程序（含 --program）",
    "operation": "运算",
    "per_design": "每个方案",
    "per_position": "每个位置",
    "total": "合计",
    "rank": "{sentence}。",
}
