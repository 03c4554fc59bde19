"""命令 ``validate``。"""

WORDS = {
    "columns": "| 案例 | 资料来源 | 数值个数 | 原资料所印 | 相符 | 最大差（末位） |",
    "summary": "参考数值与本程序结果的对照：出处、给出的位数、差值",
    "description": """\
把程序所带的全部参考数值与自己求得的结果逐个比较，精确到所给的位数。
数值或由原资料（课程设计报告、教科书、手册、认证数据）印出，
或由原资料给出的条件推导（手算、封闭解、独立求解）。
原资料有误之处，给出正确的数值与原因。""",
    "case_help": "只比较名称或出处中含有此文字的算例",
    "every_help": "逐个列出每个数",
    "working": "比较",
    "case": "算例",
    "numbers": "数据",
    "from_source": "原资料所印",
    "agree": "一致",
    "worst": "最大差值（末位单位）",
    "count": "{cases} 个算例的 {all} 个数据中，{agree} 个在给出的位数内一致。"
    "其中 {printed} 个由原资料印出，印错的有 {errata} 个；其余由原资料给出的条件推导。",
    "printed": "所印 {number}",
    "derived": "推导值 {number}",
    "trouble": "{case}：{what}：未能求得：{sentence}",
    "erratum": "{case}：{what}：{given} 有误，正确值为 {right}（本程序 {ours}）：{why}",
    "agrees": "{case}：{what}：{given}，本程序 {ours}（相差 {digits} 个末位单位）",
    "differs": "{case}：{what}：不一致：{given}，本程序 {ours}（相差 {digits} 个末位单位）",
    "why_arc_cosine": "该角由反余弦求得，不可能为负",
    "why_follows": "由摇杆的错误角度算出",
    "no_case": '没有名称或出处中含有 "{text}" 的算例',
}
