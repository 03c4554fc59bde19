"""Words on kinematic drawings and animations."""

WORDS = {
    "force": "运动副反力",
    "load": "载荷",
    "velocity": "速度",
    "acceleration": "加速度",
    "title": "{name} 机构运动简图",
    "animation": "{name} 机构动画",
}
