"""命令 ``grade``。"""

WORDS = {
    "summary": "批改变式题：哪些数不对，由哪种常见错误引起",
    "description": """\
把 CSV 答卷（列：student、variant 及各问）与 "linkwright variants" 写出的答案比较，
指出错误的数，以及恰好导致这些数的常见错误：把度当作弧度、装配形式取错、漏写括号、
反正切的象限、惯性力偶的正负号、漏掉科氏加速度、质心从另一端量起、把 r/min 当作 rad/s。""",
    "key_help": "变式题的 key.json",
    "answers_help": "答卷的 CSV 文件",
    "output_help": "把成绩写入 .csv 文件",
}
