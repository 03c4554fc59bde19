"""命令 ``variants``。"""

WORDS = {
    "summary": "课程用的变式题：题单、答案、PrairieLearn、Moodle、QTI",
    "description": """\
在限定范围内改变模型的尺寸，写出每个变式的题单、答案（附常见错误所得的数），
以及 PrairieLearn、Moodle、QTI 的题目。每个变式都能走完循环，传动性能不低于原题，
难度相同。模型的 course 一节说明改变什么、求什么、在哪个位置；没有时各长度改变 8 %。""",
    "count_help": "个数（默认 30）",
    "seed_help": "随机数种子（默认 0）：种子相同则变式相同",
    "to_help": "输出内容：sheets、key、prairielearn、moodle、qti（默认全部）",
    "output_help": "文件夹（默认为模型名称加 -variants），应当尚不存在",
    "working": "变式",
    "folder_exists": "{path}：文件夹已存在；请用 --output 另取名称，或用 --force 替换其中的文件",
    "written": "已写出 {count} 个变式，每个 {questions} 问：{path}",
    "difficulty": "难度：最小传动角 {low}° 至 {high}°；同一问的答案大小最多相差 {ratio} 倍",
    "spread": "难度：同一问的答案大小最多相差 {ratio} 倍",
}
