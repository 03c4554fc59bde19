"""Words on kinematic drawings and animations."""

WORDS = {
    "force": "运动副反力",
    "load": "载荷",
    "curve": "{quantity}：{low} … {high}",
    "velocity": "速度",
    "acceleration": "加速度",
    "title": "{name} 机构运动简图",
    "animation": "{name} 机构动画",
    "driver": "平衡力、平衡力矩",
    "reaction": "F₁₂：构件 1 对构件 2 的作用力；{links}",
    "pin": "F 下标为转动副名：该转动副对构件的作用力",
    "nothing_force": "无力可画：构件无质量，也没有载荷（mass: 5 kg，loads: …）",
    "zero_force": "此位置各力均为零",
    "zero_velocity": "此位置各点速度均为零",
    "zero_acceleration": "此位置各点加速度均为零",
    "unmarked": "未画出（未指明作用点或构件）的载荷：{loads}",
}
