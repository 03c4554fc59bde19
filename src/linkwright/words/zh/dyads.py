"""以函数形式提供的杆组。"""

WORDS = {
    "apart": "{signature} 杆组在第 {index} 号位置无法装配（{of} 个位置中有 {count} 个）：{reason}",
    "apart_alone": "{signature} 杆组无法装配：{reason}",
    "singular": "处于奇异位置（两种装配模式在此重合），其运动不能确定",
    "not_finite": "该处的输入不是有限的数",
    "no_numbers": "{name}：应为一个数或一组数，给出的是 {given}",
    "no_pairs": "{name}：应为坐标 (x, y)，即最后一维长度为 2 的数组，给出的是 {given}",
    "no_two": "{name}：应为两个值，各用于一个构件，给出的是 {given}",
    "no_line": "{name}：应为 lw.dyads.Line（原点、方向角及其变化率），给出的是 {given}",
    "no_shape": "各输入的位置个数不同，不能相配：{shapes}",
    "no_slide": "{signature} 杆组没有移动副，因而没有位移",
    "no_motion": "应为杆组的运动，由 lw.dyads.rrr(…) 等求得，给出的是 {given}",
    "no_body": "{name}：应为 lw.dyads.Body（质量、转动惯量、质心、载荷），给出的是 {given}",
    "no_place": "{name} 构件的一个载荷有力而没有作用点，请给出 `at=`",
}
