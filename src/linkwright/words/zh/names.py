"""不存在的名称及可能的意思。"""

WORDS = {
    "twice": "{noun}“{name}”注册了两次；请换一个名称",
    "did_you_mean": "是不是“{offer}”？",
    "there_is": "已有 {names}",
    "there_is_none": "一个也没有",
    "no_such": "没有{noun}“{name}”；{hint}",
}
