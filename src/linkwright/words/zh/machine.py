"""命令 ``machine``。"""

WORDS = {
    "summary": "稳定运转所需的电动机与飞轮，以及由此得到的转速",
    "description": """\
求机器稳定运转所需的数据：平均力矩与电动机功率、最大盈亏功、
满足速度不均匀系数的飞轮（按近似公式和精确值），以及一个循环内的真实转速。
也可以不给机构，而给出力矩图的各块面积，或以 theta 的表达式给出力矩。""",
    "examples": """\
linkwright machine gallery:jaw_crusher_sixbar --fluctuation 0.03
linkwright machine crusher.yaml --fluctuation 0.03 --ratio 5 --efficiency 0.9 --margin 1.2
linkwright machine crusher.yaml --rim density=7200kg/m³,width=0.15,thickness=0.1
linkwright machine --areas "+295, -685, +40, -340, +960, -270" --scale "5 N·m/mm, 1 deg/mm" \\
    --speed 1800rpm --mass 36kg --gyration 150mm
linkwright machine --torque "20000 + 9500*sin(2*theta) - 5700*cos(2*theta)" \\
    --speed 180rpm --fluctuation 0.01
linkwright machine --torque "5000 + 600*sin(2*theta)" --load "5000 + 500*sin(theta)" \\
    --speed 150rpm --mass 500kg --gyration 0.4m""",
    "file_help": "模型文件，或 gallery:名称；使用 --areas 或 --torque 时不写",
    "what_title": "电动机与飞轮",
    "curves_title": "以力矩图代替机构",
    "form_title": "形式",
    "fluctuation_help": "要求的速度不均匀系数（对机构，未给出时为 0.02）",
    "ratio_help": "飞轮轴与曲柄的转速比（默认 1）",
    "efficiency_help": "电动机到曲柄的总效率，不超过 1（默认 1）",
    "margin_help": "电动机功率的裕量系数，不小于 1（默认 1）",
    "disk_help": "圆盘飞轮的尺寸：density=7850kg/m³,width=0.1（宽度与直径之比）",
    "rim_help": "轮缘飞轮的尺寸：density=…,width=0.1,thickness=0.1（与外径之比）",
    "areas_help": '力矩曲线与平均线之间的各块面积，mm²，依次写出："+295, -685, …"；需要 --scale',
    "torque_help": '驱动力矩（N·m），theta 以 rad 计："5000 + 600*sin(2*theta)"',
    "scale_help": '力矩图的比例尺："5 N·m/mm, 1 deg/mm"',
    "load_help": "阻力矩（N·m），theta 的表达式（默认：常数，等于 --torque 的平均值）",
    "period_help": "一个循环的转角（默认 360deg；四冲程发动机 720deg）",
    "speed_help": "轴的平均转速：180rpm",
    "inertia_help": '轴上已有的转动惯量："0.81 kg·m²"',
    "mass_help": "已有飞轮的质量，与 --gyration 同用：36kg",
    "gyration_help": "已有飞轮的回转半径：150mm",
    "steps_help": "一个循环内的位置数（默认 360）；其间的极值精确求取",
    "output_help": "以国际单位制把循环内的曲线写入 .csv 或 .json 文件",
    "speed": "平均转速",
    "mean_torque": "平均力矩",
    "mean_power": "平均功率",
    "motor_power": "电动机功率（计入效率和裕量）",
    "energy_fluctuation": "最大盈亏功",
    "energy_lowest_at": "最慢处的输入位置（近似）",
    "energy_lowest": "  能量最低，转速最慢处（近似）",
    "energy_highest_at": "最快处的输入位置（近似）",
    "energy_highest": "  能量最高，转速最快处（近似）",
    "inertia_smallest": "最小等效转动惯量",
    "inertia_largest": "最大等效转动惯量",
    "inertia": "已有的转动惯量",
    "required_fluctuation": "要求的速度不均匀系数",
    "flywheel": "按近似公式的飞轮",
    "formula_fluctuation": "按近似公式的速度不均匀系数",
    "reached_fluctuation": "  实际达到的速度不均匀系数",
    "slowest": "  最慢",
    "fastest": "  最快",
    "exact_flywheel": "恰好满足要求的飞轮（精确）",
    "shaft_flywheel": "  折算到飞轮轴上",
    "acceleration_smallest": "最大角减速度",
    "acceleration_largest": "最大角加速度",
    "disk_diameter": "圆盘直径",
    "rim_diameter": "轮缘外径",
    "width": "  宽度",
    "thickness": "  厚度",
    "mass": "  质量",
    "rim_speed": "  圆周速度（铸铁约不超过 30 m/s）",
    "after_area": "第 {number} 块面积之后",
    "at_begin": "起点",
    "areas_title": "{count} 块面积的力矩图",
    "torque_title": "T = {torque}，阻力矩：{load}",
    "its_mean": "其平均值",
    "none_needed": "不需要飞轮：机器自身的转动惯量已使转速足够均匀。",
    "nothing_given": "请给出模型文件，或用 --areas 或 --torque 给出力矩图；见 linkwright machine --help",
    "not_with_file": "{option} 描述力矩图，不能与模型文件同时使用",
    "output_needs_file": "--output 写出机构的循环曲线；请给出模型文件",
    "needs_speed": "设计飞轮或求速度不均匀系数需要平均转速；请加上 --speed，例如 --speed 180rpm",
    "shape_needs_fluctuation": "确定飞轮尺寸需要速度不均匀系数；请加上 --fluctuation，例如 --fluctuation 0.01",
    "no_scale": '--areas 需要力矩图的比例尺：--scale "5 N·m/mm, 1 deg/mm"',
    "bad_scale": '--scale：“{text}”没有给出两个比例尺；请写出每 mm 的力矩和转角（大于零），例如 "5 N·m/mm, 1 '
    'deg/mm"',
    "bad_area": '--areas：“{text}”不是面积；请给出以逗号分隔的 mm² 数值，例如 "+295, -685, +390"',
    "no_number": "{option}：“{text}”不是数；请用小数点书写，不带单位，例如 0.9",
    "not_above_zero": '{option} 为 "{text}"；请给出大于零的值',
    "not_finite": "{option}：{text} 在循环内不处处有限；请检查除法和开方",
    "mass_and_gyration": "--mass 与 --gyration 须同时给出；或改用 --inertia",
    "bad_shape": "{option}：“{text}”无法识别；请写作 键=值，可用的键：{keys}",
    "no_mean_torque": "--torque 在一个循环内的平均值为 {mean}，不做功，无法选电动机或设计飞轮；"
    "请给出平均值为正的驱动力矩",
}
