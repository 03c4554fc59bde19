"""关于受力与平衡的说明。"""

WORDS = {
    "say_link": "运动副“{joint}”连接 {links}；请指明作用在哪个构件上：on={first!r}",
    "not_touching": "运动副“{joint}”不在构件“{link}”上；它连接 {links}",
    "one_sum": "有多个驱动时，由功率只能求得总和，而不是单个驱动的平衡力矩（力）",
    "no_driver": "“{name}”没有驱动，因而没有平衡力矩",
    "share": "平衡比例为 {share:g}；请给出 0（不平衡）到 1（完全平衡）之间的数",
    "weight_no_radius": "没有给出构件“{link}”上配重的半径；请补上，或给出一个共用的半径",
    "weight_radius": "构件“{link}”上配重的半径为 {distance:g} m；请给出正值",
    "not_balanced": "“{name}”既不是四杆机构也不是曲柄滑块机构；公式配重只用于这两种，其他机构请在 study "
    "中改变质量和质心",
    "no_pin_shared": "构件“{a}”与“{b}”没有公共转动副，因此“{name}”不是四杆机构或曲柄滑块机构",
    "needs_pin_radius": "joints.{name}：计算摩擦需要销轴半径；请加上 pin_radius，如 pin_radius: 20 mm",
    "passive": "虚约束高副 {names} 与其旁各副如何分担载荷属静不定问题：虚约束按不受力计",
    "indeterminate": "移动副“{name}”的反力偶是静不定的，因为其他移动副也阻止同一转动：取为零，"
    "全部由那些移动副的力偶承受",
    "self_locking": "“{name}”在{where} 附近因摩擦自锁：运动副“{joint}”中的摩擦在迭代中无限增大，"
    "任何平衡力矩（力）都不能使其运动；请减小摩擦系数或销轴半径，或改善该处的传动角",
    "unbalanced": "“{name}”的受力结果在{where} 未通过自校核：构件“{link}”在运动副“{joint}”处不平衡，相差 {gap}，"
    "而此处最大的力为 {size}。{check_failed}",
    "results_unbalanced": "“{name}”的受力结果在{where} 未通过自校核：由反力、载荷与惯性力合计，有构件不平衡，"
    "相差 {gap}，而此处最大的力为 {size}。{check_failed}",
    "powers_differ": "“{name}”的受力结果在{where} 未通过自校核：驱动功率与其余各力的功率相差 {gap}，"
    "而按此处力与速度的大小，功率可达 {size}。{check_failed}",
    "check_failed": "若紧邻奇异位置，结果可能已无有效数字，请改取离开该处的位置；否则是程序的错误，结果不可使用，"
    "请连同模型文件一并反馈",
    "contact_lost": "{kind} {name} 只能受压，在{places} 却需要拉力（{where} 处最大，为 {most}）；"
    "请用弹簧或载荷把两构件压紧",
    "contact_lost_cam": "凸轮 {name} 在{places} 不能保持与从动件接触：需要拉力（{where} 处最大，为 {most}）；"
    "请用弹簧或载荷压紧，或采用槽凸轮",
    "contact_lost_belt": "带 {name} 在{places} 太松：所传的力大于初拉力的两倍，松边须受压；请加大初拉力，或不写初拉力"
    "（此时松边不受力）",
    "from_to": "输入 {first} 至 {last}",
    "friction_apart": "导路的反力是两侧相压的法向力；沿导路的摩擦力为其 μ 倍，另计：{names}",
}
