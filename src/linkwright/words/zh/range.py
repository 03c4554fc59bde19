"""驱动可达的范围。"""

WORDS = {
    "full_turn": "构件 {link} 可整周转动",
    "full_slide": "构件 {link} 可一直移动，没有尽头",
    "turn": "构件 {link} 可{way}转动；{ends}",
    "slide": "构件 {link} 可{way}移动；{ends}",
    "low": "由 {low} 起",
    "high": "至 {high} 止",
    "low_high": "在 {low} 到 {high} 之间",
    "others_still": "其余原动件停在起始位置时，{told}",
    "both_ends": "在两端{group}{how}",
    "at": "在 {place} 处{group}{how}",
    "group": " {signature} 杆组（{links}）",
    "no_driver": "“{name}”没有驱动",
    "not_assembled": "“{name}”在驱动“{driver}”的坐标 {place} 附近处处无法装配，因而没有运动范围；请检查尺寸",
    "singular": "处于奇异位置",
    "stretched": "拉直共线",
    "folded": "重叠共线",
    "perpendicular": "的构件与导路垂直",
    "closest": "的两外副相距为导路偏距所允许的最小值",
    "parallel": "的两导路平行",
    "change": "处于变点，无封闭解的杆组不能跟踪通过",
}
