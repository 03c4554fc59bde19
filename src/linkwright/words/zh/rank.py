"""由雅可比矩阵的秩求自由度。"""

WORDS = {
    "confirmed": "雅可比矩阵的秩证实了按格吕布勒公式计算的自由度 {count}",
    "confirmed_drawn": "图示位置雅可比矩阵的秩证实了按格吕布勒公式计算的自由度 {count}",
    "differs": "按格吕布勒公式自由度为 {count}，而由雅可比矩阵的秩得 {mobility}：{reason}",
    "differs_drawn": "按格吕布勒公式自由度为 {count}，而由图示位置雅可比矩阵的秩得 {mobility}：{reason}",
    "differs_assembled": "按格吕布勒公式自由度为 {count}，而由各运动副闭合位置雅可比矩阵的秩得 {mobility}：{reason}",
    "special": "这是特殊位置，此处各运动副的约束方程线性相关（{redundant}）；机构一离开该位置，"
    "多出的自由度即消失",
    "link": "在此特殊几何条件下构件 {links} 是多余的；请将其去掉",
    "links": "在此特殊几何条件下构件 {links} 是多余的；请将它们去掉",
    "joint": "在此特殊几何条件下运动副 {joints} 的约束与其他运动副重复；请将其去掉",
    "joints": "在此特殊几何条件下运动副 {joints} 的约束与其他运动副重复；请将它们去掉",
    "guide": "移动副 {guides} 所在的回路中，构件的转动已受约束（{redundant}）",
    "guides": "移动副 {guides} 所在的回路中，构件的转动已受约束（{redundant}）",
    "passive": "由于特殊的尺寸，有虚约束（{redundant}）：其他运动副已有同样的约束",
    "gaping": "按格吕布勒公式自由度为 {count}；各构件在图示位置附近装配不起来：至少留有 {gap} 的间隙，"
    "因此不能说其中有多余的构件",
    "place": "{joint} 处的位置约束",
    "rotation": "{joint} 处的转动约束",
    "rolling": "{joint} 处的滚动约束",
    "wheels": "高副 {pairs} 的约束与其他约束重复（{redundant}）",
    "named": "“{name}”",
    "besides": "{cause}。{sentence}",
    "singular": "在循环的起点，{outcome}，与自由度的计算结果无关",
}
