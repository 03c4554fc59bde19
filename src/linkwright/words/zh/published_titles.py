"""公开发表的算例的题目。"""

WORDS = {
    "crusher_kinematics": "颚式破碎机，六杆，运动",
    "crusher_forces": "颚式破碎机，六杆，按报告程序中载荷的力",
    "crusher_fourbar": "颚式破碎机，四杆，第一行",
    "conveyor": "摆动式输送机，外极限位置",
    "press_metrics": "平台印刷机的偏置曲柄滑块",
    "press_synthesis": "由行程、连杆比与偏距比求印刷机的曲柄滑块",
    "shifted_gears": "变位齿轮副，m 3，z 12 与 24",
    "ring_and_pinion": "内齿轮副，m 3，z 16 与 24",
    "involute": "渐开线函数",
    "turning_moment": "六块面积的力矩图",
    "engine_mean": "发动机与平均力矩",
    "engine_varying": "发动机与变化的载荷",
    "two_bars": "两根重杆的平衡",
    "bracket": "墙上托架",
    "wyndor": "Wyndor 玻璃厂的生产配比",
    "five_points": "五个定时点，给定相位、铰点与转向",
    "eighteen_points": "十八个定时点",
    "peak_factors": "运动规律的特征值",
    "norris": "数据集 Norris 的回归",
}
