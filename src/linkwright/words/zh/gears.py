"""齿轮。"""

WORDS = {
    "out_of_range": "{name} 为 {value}，应在 {low} 到 {high} 之间",
    "whole_teeth": "齿数不能是 {teeth}，应为整数",
    "ring_tip": "内齿轮齿顶圆 {tip:.6g} mm 小于基圆 {base:.6g} mm，或"
    "超出齿根圆，该处没有渐开线齿廓；应增加齿数、加大变位系数或减小齿顶高系数",
    "no_flank": "齿顶圆 {tip:.6g} mm 以内没有渐开线齿廓；应增加齿数、加大变位系数或加大齿顶高系数",
    "pointed": "轮齿在齿顶圆 {tip:.6g} mm 之前已变尖；应减小变位系数或齿顶高系数",
    "pointed_space": "内齿轮齿槽在齿根圆 {root:.6g} mm 之前已变尖；应减小变位系数或齿根高系数",
    "pointed_rack": "齿条的齿在齿顶高 {addendum} 个模数之前已变尖；应减小齿顶高系数",
    "shift_too_large": "变位系数为 {shift} 时，齿条刀具到不了节线以下；应不大于 {most}",
    "differ": "两齿轮的 {name} 不同，不能啮合；应取相同的值",
    "ring_first": "第一个齿轮是内齿轮；应把内齿轮作为第二个",
    "ring_small": "{ring} 齿的内齿轮容不下 {pinion} 齿的齿轮；应增加齿数",
    "no_mesh": "这样的变位系数使齿廓在任何中心距下都不能啮合；应加大变位系数",
    "distance": "中心距 {distance:.9g} mm 超出范围：无侧隙中心距为 {touching:.9g} mm",
    "undercut": "{teeth} 齿的齿轮有根切；变位系数不小于 {least:.4g} 可避免",
    "gap": "重合度为 {ratio:.4g}，小于 1：有的位置没有齿接触",
    "no_clearance": "齿顶伸入齿根 {clearance:.4g} mm：应缩短齿顶或加深齿根",
    "fillet_touched": "相啮合齿轮的齿顶伸到 {teeth} 齿齿轮渐开线以下的过渡曲线",
    "title": "齿轮副 {first} : {second}",
    "pair": "z = {first} : {second}，m = {module} mm，a = {distance} mm，啮合角 {angle}°，重合度 {ratio}",
    "rack_title": "{teeth} 齿齿条",
    "rack": "z = {teeth}，m = {module} mm，p = {pitch} mm，α = {angle}°",
    "tips_overlap": "啮合区之外齿顶相互干涉 {overlap:.4g}°；应加大齿数差",
}
