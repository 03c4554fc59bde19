"""自由度与原动件数不符。"""

WORDS = {
    "has": "“{name}”的自由度为 {mobility}，有{drivers}",
    "free": "{has}；构件 {links} 的运动不能确定；请给出{more}（driver: {{turn: …, about: …, speed: …}}），"
    "或增加构件间的联接",
    "free_idle": "{has}；构件 {links} 的运动不能确定，也不影响其他构件：这是局部自由度（如滚子绕自身销轴的转动）；"
    "请去掉这样的构件（凸轮的滚子由 touch: roller 给出），或给出{more}（driver: {{turn: …, about: …, speed: …}}）",
    "islands": "{has}；文件中有 {count} 个只有机架相同的机构：{parts}；构件 {links} 的运动不能确定；"
    "请给出{more}（driver: {{turn: …, about: …, speed: …}}），或增加构件间的联接",
    "cannot_be_driven": "“{name}”按格吕布勒公式自由度为 {mobility}，不能驱动，却给出了{drivers}",
    "cannot_be_driven_by_several": "“{name}”按格吕布勒公式自由度为 {mobility}，不能驱动，却给出了{drivers}",
    "blocked": "{why}；{pairs} 的各轮互相卡死：沿“{carrier}”上的这一回路传动比之积不为 1，"
    "各轮都不能转动；请去掉“{pair}”，或改变轮的大小",
    "blocked_pairs": "{why}；{pairs} 互相卡死：它们对转角与位移的要求只有静止时才能同时满足；"
    "请去掉“{pair}”，或改变尺寸",
    "blocked_by_lift": "{why}；{pairs} 互相卡死：它们带动同一些构件，{cams} 按凸轮升程带动，其速比在一转中变化，"
    "其余的则按别的规律带动；请让其余的各带动自己的构件（例如在自己轴上单独转动的小齿轮），或去掉“{pair}”",
    "driver": "原动件“{name}”",
    "the_driver": "原动件",
    "excess": "{why}；构件 {links} 受到重复约束（{extra} 等）；请去掉一个原动件、"
    "一个多余的构件或一个多余的移动副",
    "drivers_0": " 0 个原动件",
    "drivers_1": "一个原动件",
    "drivers_2": "两个原动件",
    "drivers_3": "三个原动件",
    "drivers_many": " {count} 个原动件",
    "more_0": "另外零个原动件",
    "more_1": "另外一个原动件",
    "more_2": "另外两个原动件",
    "more_3": "另外三个原动件",
    "more_many": "另外 {count} 个原动件",
}
