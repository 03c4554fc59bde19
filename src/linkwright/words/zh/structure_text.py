"""机构的结构分析。"""

WORDS = {
    "counts": "活动构件数 n = {links}；低副数 p = {pairs}：转动副 {revolute} 个，移动副 {prismatic} 个",
    "counts_weld": "活动构件数 n = {links}；低副数 p = {pairs}：转动副 {revolute} 个，移动副 {prismatic} 个；"
    "固接 {welds} 处",
    "counts_welds": "活动构件数 n = {links}；低副数 p = {pairs}：转动副 {revolute} 个，移动副 {prismatic} 个；"
    "固接 {welds} 处",
    "mobility": "自由度 F = 3n - 2p = 3·{links} - 2·{pairs} = {mobility}",
    "mobility_welded": "自由度 F = 3n - 2p - 3w = 3·{links} - 2·{pairs} - 3·{welds} = {mobility}",
    "redundant": "移动副 {guides} 所在的回路中，构件的转动已受约束：其转动约束为虚约束，因此自由度为 "
    "{mobility}。",
    "counts_higher": "；高副数 p_H = {higher}：{kinds}",
    "mobility_higher": "自由度 F = 3n - 2p - p_H = 3·{links} - 2·{pairs} - {higher} = {mobility}",
    "mobility_higher_welded": "自由度 F = 3n - 2p - 3w - p_H = 3·{links} - 2·{pairs} - 3·{welds} - {higher} = "
    "{mobility}",
    "redundant_pairs": "高副 {pairs} 的约束与其他副重复，为虚约束，因此自由度为 {mobility}。",
    "train": "轮系 {pairs} 的传动比（反转法，{carrier} 固定）：",
    "stopped": "{carrier} 固定",
    "as_one": "整体转动",
    "at_rest": "自由度为 0 且没有原动件：这是承受载荷的静止结构。",
    "determined": "自由度等于原动件数（{count}）：机构具有确定的运动。",
    "groups": "按求解顺序排列的基本杆组：",
    "driven": "原动件，由 {drivers} 驱动",
    "driven_unnamed": "原动件",
    "class_order": "{level}级组，{order} 阶",
    "class_order_driven": "{level}级组，{order} 阶，内含驱动 {drivers}",
    "class_order_driven_unnamed": "{level}级组，{order} 阶，内含驱动",
    "outer": "外副 {outer}",
    "outer_inner": "外副 {outer}；内副 {inner}",
    "chain": "机构 = 机架 + {chain}",
    "class": "机构级别：{level}级机构。",
    "parts": "模型由 {count} 个只有机架相同的机构组成：{parts}。",
    "and": " 与 ",
    "turned_against": "{driver}：使 {link} 绕 {pin} 相对 {other}（而不是机架）转动。",
    "other_driver": "改选原动件会得到不同的杆组，机构级别也可能改变。",
    "numerals": "Ⅰ Ⅱ Ⅲ Ⅳ Ⅴ Ⅵ Ⅶ Ⅷ Ⅸ Ⅹ",
}
