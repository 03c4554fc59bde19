"""对模型的意见如何组成句子。"""

WORDS = {
    "warning": "警告：{body}",
    "note": "提示：{body}",
    "with_remedy": "{message}；{remedy}",
    "comma": "、",
    "and": "{first}和{last}",
    "semicolon": "；",
}
