"""机器的运转与飞轮。"""

WORDS = {
    "areas_list": "请依图上的次序以数列给出各块面积，mm²",
    "scales": "力矩图的比例尺必须大于零：每 mm 的 N·m 数，每 mm 的 rad 数",
    "areas_sum": "各块面积之和为 {total:g} mm²，不为零：平均线位置有误，或缺少面积",
    "not_between": "“{name}”的位置经过变点或不遵循时间规律，不能在位置之间求值；请先求解没有变点的循环",
    "one_driver": "飞轮与循环内的转速需要一个转动的驱动；“{name}”的驱动类型或个数不同",
    "not_constant": "“{name}”的驱动不是匀速转动；请给出 speed: … 而不是其他规律",
    "not_whole_turns": "“{name}”的循环不是驱动的整圈数；请去掉 cycle，或给出 turns",
    "never_back": "“{name}”的轮或齿条在 {most} 圈内不回到起始位置，因而没有重复的循环；"
    "请使齿数或半径之比为较小整数之比",
    "not_all_reached": "“{name}”不能到达其循环的全部位置，因而不能稳定运转",
    "bad_inertia": "转动惯量为 {inertia:g} kg·m²；请给出大于零的值",
    "bad_ratio": "飞轮轴与曲柄的转速比为零或接近零；请给出别的数",
    "bad_size": "飞轮的{name}为 {value:g}；请给出大于零的值",
    "bad_rim": "轮缘厚度不能为直径的 {thickness_ratio:g}；请给出不大于 0.5（圆盘）的值",
    "bad_coefficient": "速度不均匀系数为 {fluctuation:g}；请给出大于零的值，如 0.02",
    "still_shaft": "飞轮轴的平均转速为零；飞轮需要转动的轴",
    "bad_efficiency": "效率为 {efficiency:g}；请给出大于 0 且不超过 1 的值",
    "bad_margin": "电动机功率的裕量系数为 {margin:g}；请给出不小于 1 的值",
    "no_work": "“{name}”一个循环内的平均力矩为零：不做功，无法选电动机或设计飞轮；"
    "请给机器加上在一个循环内做功的载荷（loads: …）",
    "driven": "载荷推动“{name}”，如同气体推动发动机：由与之相反的恒定力矩吸收其功；"
    "若机器本应由原动机驱动，请检查载荷的方向",
    "needs_flywheel": "电动机功率 {power} 按平均功率选取，须配 {inertia} 的飞轮才够用；"
    "不装飞轮而匀速运转时，电动机功率须为 {peak}。",
    "evened_by_itself": "电动机功率 {power} 按平均功率选取，峰值由机器自身的惯量承担；"
    "要保持匀速，电动机功率须为 {peak}。",
    "bad_speed": "平均转速为 {speed:g} rad/s；请给出大于零的值",
    "no_inertia": "总转动惯量在循环内某处为零；请给出质量或飞轮",
    "no_flywheel": "未能求出使速度不均匀系数恰为 {fluctuation:g} 的飞轮；请改用其他系数",
    "would_stop": "在此平均转速下动能不足以使机器转过一个循环，它会停下；请加飞轮或提高转速",
    "bad_period": "力矩曲线的周期为 {period:g} rad；请给出大于零的角度",
    "bad_table": "力矩表格的力矩与角度须同样多，至少各两个",
    "table_not_finite": "力矩表格中有不是有限的数",
    "table_order": "力矩表格的角度须递增，且在一个周期之内",
    "no_common_period": "周期为 {period:g}° 和 {period2:g}° 的力矩曲线没有共同的循环；请在同一角度上给出两者",
    "speeds_up": "驱动与负载不平衡：一个循环剩余 {total:.6g} J，转速会逐循环上升；"
    "请使两者的平均力矩相等（{mean:.6g} N·m 与 {load:.6g} N·m）",
    "slows_down": "驱动与负载不平衡：一个循环剩余 {total:.6g} J，转速会逐循环下降；"
    "请使两者的平均力矩相等（{mean:.6g} N·m 与 {load:.6g} N·m）",
    "inertia": "转动惯量",
    "density": "密度",
    "width": "宽度",
    "thickness": "厚度",
}
