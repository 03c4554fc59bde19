"""关于载荷的说明。"""

WORDS = {
    "part_first": "前段",
    "part_last": "末段",
    "part_free": "两端空程",
    "part_too_long": "所取的行程部分过长（{part} {amounts}）：输出“{output}”的行程为 {stroke}；请减小",
    "table_range": "驱动的表格覆盖 {first:g} s 到 {last:g} s，而运动需要 {begin:g} s 到 {end:g} s；"
    "请缩短循环或补全表格",
    "no_kind": "载荷没有写类型 kind",
    "write_kind": "请写 kind：{kinds} 之一",
    "gravity_is_key": "重力是模型的一个键，与 loads 并列：gravity: [0, -9.81 m/s²]",
    "friction_is_key": "摩擦写在 joints 中的转动副和移动副上：friction: 0.1，转动副还要 pin_radius: 5 mm",
    "both_given": "同时给出了 {given}",
    "keep_one_of": "请只保留 {words} 之一",
    "none_given": "没有给出 {words} 中的任何一个",
    "give_one": "请恰好给出其中一个",
    "ramp_without_phase": "ramp 沿阶段 phase 变化，而没有给出阶段",
    "add_phase": "请加上 phase: {{input: [从, 到]}} 或其他形式",
    "same_link": "两点都在构件“{link}”上，载荷不起作用",
    "name_two_links": "请给出两个构件上的点",
    "no_ray": "loads.{name}：构件 {on} 上的点 {p} 与 {q} 重合，射线 {p}→{q} 没有方向；请给出两个不重合的点",
    "unknown_in_magnitude": "载荷大小中有未知名称“{name}”；{hint}",
    "formula_fails": "{message}（{where}）；请修改表达式，或用阶段排除该位置",
    "formula_not_finite": "“{text}”{where}不是有限值；请修改表达式",
    "formula_divides": "“{text}”在输入 {place} 附近除以零；请修改表达式，或用阶段排除该位置",
    "phase_to_and_fro": "阶段由 {start} 降到 {end}，而输入来回转动；请先写较小的角度",
    "phase_too_long": "由 {start} 到 {end} 的阶段超过输入的一整圈；请改用随时间的表格",
    "limit_at": "输入 {input} 处为{kind}",
    "no_such_swing": "输出“{output}”在循环内没有由{start}到{end}的行程（{places}）；请让循环包含两者，或交换 "
    "from 与 to",
    "never_reverses": "输出“{output}”在循环内从不反向，因而没有极限位置；请改选来回摆动的输出，"
    "或用输入规定阶段：{{input: [a, b]}}",
    "ramp_without_length": "“{output}”的两个极限位置处输入相同，沿输入的 ramp 没有长度；请改用沿 {output} "
    "的表格",
    "only_position": "在唯一的位置",
    "at_input": "在输入 {input} 处",
    "stretch": "{low} 到 {high}",
    "table_too_short": "{over} 的表格由 {first} 到 {last}，没有覆盖循环所需的范围：缺 {ranges}；请补充各行，"
    "或用阶段限制载荷",
    "same_links": "力矩的作用构件与受反作用的构件同为“{link}”",
    "name_other_link": "请另选一个构件",
    "of_load": "loads.{name}：{cause}",
    "max": "最大值",
    "min": "最小值",
}
