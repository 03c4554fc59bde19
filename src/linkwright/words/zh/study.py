"""命令 ``study``。"""

WORDS = {
    "summary": "改变尺寸或参数，观察任意指标的变化",
    "description": """\
按网格或 Sobol 序列改变模型的一个或多个尺寸（pitman.length、frame.O3.x、jaw.mass）
或命名参数，输出每个设计方案的所选指标。不能运动的方案会计数并说明原因。""",
    "examples": """\
linkwright study gallery:jaw_crusher_sixbar --vary "pitman.length=1.2..1.3 m:11"
linkwright study crusher.yaml --vary "pitman.length=1.2..1.3 m:5" "jaw.mass=700, 900 kg" \\
    --metrics peak_input_torque "reaction O5 on jaw max" --output study.csv
linkwright study linkage.yaml --vary "coupler.length=2..4 m" --sampling sobol --samples 256""",
    "vary_help": '变化量："地址=起..止 单位:个数" 或 "地址=值,值 单位"；多个变化量组成网格',
    "metrics_help": "设计指标（见 linkwright.metrics）、travel、flywheel，或加引号的输出统计量"
    '（"driver.effort rms"、"C.velocity max"）',
    "sampling_help": "grid：所有组合（默认）；sobol：在范围内均匀分布的方案",
    "samples_help": "Sobol 序列的方案数（默认 64）",
    "seed_help": "Sobol 序列的种子（默认 0）",
    "of_help": "计算行程的构件或导路（默认：最后求解的一个）",
    "fluctuation_help": "设计飞轮用的速度不均匀系数（默认 0.02）",
    "steps_help": "一个循环内的位置数（默认 360）",
    "rows_help": "表格显示的行数（默认 40）",
    "output_help": "把全部方案写入 .csv 或 .json 文件",
    "plot_help": "把指标随参数的变化画成 .svg、.pdf 或 .png 文件",
    "bad_vary": '--vary：“{text}”没有给出范围；请写作 地址=起..止 单位:个数，例如 "crank.length=20..30 mm:11"',
    "twice": "--vary：{name} 给出了两次；请只给一个范围",
    "counts": "{name}：共 {designs} 个方案，{movable} 个能够运动",
    "number": "编号",
    "left_out": "（显示 {designs} 个方案中的 {shown} 个；用 --output FILE.csv 写出全部）",
    "best": "最优方案",
    "best_of": "{name}：{value}，方案 {number}（{place}）",
    "failed": "不能运动的方案",
    "failed_at": "{count} 个在杆组（{group}）处失败；第一个：{example}",
    "failed_otherwise": "{count} 个因载荷或指标失败；第一个：{example}",
}
