"""关于运动及其位置的说明。"""

WORDS = {
    "no_mode": "assembly.{joint}：“{word}”不是 {signature} 杆组（{links}）的装配模式；{hint}",
    "write_mode": "请写 {first} 或 {second}",
    "inner_joints": "内副有：{names}",
    "not_inner": "assembly.{joint}：这不是有两种装配模式的杆组的内副；{hint}",
    "word_in_open": "assembly.{joint}：在现有驱动下，这是杆组（{links}）的运动副，该杆组没有闭式解，不用装配词；"
    "请去掉它，并在图中给出装配后各点的坐标：drawing: {{{drawn}}}",
    "needs_drawing": "杆组（{links}，{level} 级）没有闭式解；请在图中给出装配后各点的坐标：drawing: "
    "{{{drawn}}}",
    "bad_time": "有一个时刻不是有限的数；请以秒给出时刻",
    "no_inputs": "没有给出输入；请给出某个驱动的坐标，例如 at={{{driver!r}: [0.5]}}",
    "no_input_to_set": "“{name}”没有驱动，因此没有可设的输入；请去掉输入",
    "own_law": "驱动“{name}”按自己的时间规律运动；请按时刻而不是按输入求位置",
    "bad_input": "驱动“{name}”的一个输入不是有限的数",
    "text_for_number": "“{text}”是文字；请给出以国际单位（rad、m、s）计的数：{right}",
    "no_numbers": "{given} 不是输入或时刻；请给出国际单位（rad、m、s）的数，如 0.5 或 [0.0, 0.5]",
    "no_failures": "failures 为 {given!r}；写 'raise' 时到不了的位置会报错，写 'mark' 时只作标记",
    "no_row": "输入或时刻应排成一列，而不是形状为 {shape} 的数组；请给每个位置一个数",
    "at_and_times": "位置既由输入（at）又由时刻（times）给出；请只给其中之一",
    "no_positions": "没有给出位置；请给出至少一个输入或时刻，或不写 at 和 times 以取整个循环",
    "no_natural_end": "“{name}”的循环没有自然的终点，因为驱动“{driver}”不转动；请写 cycle: {{from: …, to: "
    "…}}（驱动的坐标）或 cycle: {{duration: 2 s}}",
    "law_without_end": "“{name}”的循环没有自然的终点，因为驱动“{driver}”按时间规律运动；请写出循环的时间：cycle: "
    "{{duration: 2 s}}",
    "cycle_by_coordinate": "循环以驱动“{name}”的坐标给出，而它不是匀速；请改写 cycle: {{duration: …}}",
    "input": "输入 {parts}",
    "only_position": "唯一的位置",
    "of_positions": "{where}（{steps} 个位置中有 {failed} 个失败）",
    "refused": "“{name}”在{where}处无法求解：{sentence}；{advice}",
    "refused_told": "“{name}”在{where}处无法求解：{sentence}；{told}；{advice}",
    "not_passed": "“{name}”不能走完一个循环：{told}；{advice}",
    "advice": "请修改尺寸、装配模式或输入的范围（cycle: {{from: …, to: …}}），或要求标出失败的位置",
    "no_limits_of_formula": "“{name}”是公式，不求其极限位置；可求其极值（“{name} max”、“{name} min”）",
    "no_output": "没有输出“{text}”；请写构件名（其角度）、点.x、点.y 或移动副名（其位移）；{hint}",
    "no_way_between": "该运动的各位置不按驱动“{name}”的时间规律，因此位置之间没有通路；"
    "请在一个循环或给定时刻的运动中求极限位置",
    "no_input": "“{name}”没有驱动，因而没有输入",
    "no_coordinate": "没有带坐标的运动副“{name}”；{hint}",
    "several_points": "几个构件各有名为“{name}”的点；请指明：{choices}",
    "no_rank": "位置 {index} 没有解，其雅可比矩阵没有秩；请另选位置",
    "needs_pandas": "没有安装 pandas；安装命令：pip install pandas",
    "law_beyond": "驱动 {name!r} 在 {time:g} s 时给出{kind} {value}，超出任何机器可能的数值；"
    "请改变其规律或循环",
    "not_near_drawing": "“{name}”在图示位置附近装配不起来（输入 {inputs}）；请核对图中坐标与长度",
}
