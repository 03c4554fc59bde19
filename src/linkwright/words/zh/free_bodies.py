"""各构件的受力分析图。"""

WORDS = {
    "text": "{figure}给出各构件在 {place} 时的受力图（隔离体），按力分析的次序排列，"
    "作用于构件的全部力和力矩均已画出。运动副反力 F 的下标 12 表示构件 1 对构件 2 的作用力。",
    "text_rest": "{figure}给出各构件的受力图（隔离体），按力分析的次序排列，作用于构件的全部力和力矩均已画出。"
    "运动副反力 F 的下标 12 表示构件 1 对构件 2 的作用力。",
    "caption": "各构件受力分析图",
    "page": "{caption}（{number}/{count}）",
    "title": "{number} {link}",
    "direction": "方向角",
    "sum": "合计",
    "moment_sum": "对质心的力矩之和：{value}",
    "reaction": "F、M：运动副反力、反力偶矩",
    "weight": "G：重力",
    "inertia": "F_I = −m·a、M_I = −J·α：惯性力、惯性力偶矩",
    "friction": "下标 f：摩擦",
    "driver": "下标 d：平衡力（力矩）",
    "load": "载荷用其名称表示",
    "apart": "；",
    "shortened": "虚线箭头按比例不足 {least} mm，画成 {drawn} mm",
    "idle": "此位置不起作用的载荷：{names}。",
    "none": "此位置没有力作用于活动构件",
}
