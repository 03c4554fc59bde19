"""对模型文件的意见。"""

WORDS = {
    "plain_stroke_part": "行程的一部分",
    "no_stroke_part": "“{text}”不是行程的一部分",
    "give_stroke_part": "请给出 0 到 1 之间的比例，或一段行程，如“{example}”",
    "several_parts": "给出了行程的几个部分：{words}",
    "keep_one": "请只保留一个",
}
