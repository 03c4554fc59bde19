"""The command ``compensate``."""

WORDS = {
    "summary": "求补偿凸轮，使某输出在一段区间内保持不变，如版台与滚筒同步",
    "description": """\
求机器中凸轮的升程，使输入经过给定区间时某输出保持不变：从动件静止时所剩的差值被精确补偿；
区间以外从动件平滑返回，并有一段停歇。输出可以是模型自定义的输出
（outputs: {lead: bed_guide - 180 mm*cylinder}）、坐标、角度或位移。
--span 寻找该长度内需补偿量最小的区间。""",
    "examples": """\
linkwright compensate gallery:printing_press lead --zone "-882.734..-1449.5665 deg"
linkwright compensate press.yaml lead --span "567 deg" --output press_with_cam.yaml""",
    "of_help": "要保持不变的量：模型的一个输出",
    "joint_help": "凸轮（机器有多个凸轮时须给出）",
    "zone_help": "输入在这两个值之间时保持不变",
    "span_help": "区间的长度（输入），位置由程序寻找",
    "steps_help": "一个循环的位置数（默认 1440）",
    "output_help": "把装上凸轮的模型写入 .yaml 文件，或把升程表写入 .csv 文件",
    "kept": "输入从 {first} 到 {last} 时，{joint} 使 {output} 保持不变",
    "before": "从动件静止时 {output} 在区间内变化",
    "after": "装上凸轮后变化",
    "lift": "总升程",
    "bad_zone": "--zone：“{text}”不是区间；请写出起点与终点，如“90..210 deg”",
}
