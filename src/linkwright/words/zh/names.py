"""不存在的名称及可能的意思。"""

WORDS = {
    "twice": "{noun}“{name}”注册了两次；请换一个名称",
    "did_you_mean": "是不是“{offer}”？",
    "there_is": "已有 {names}",
    "there_is_none": "一个也没有",
    "no_such": "没有{noun}“{name}”；{hint}",
    "one_of": "请从中选一：{names}",
    "near_one_of": "是不是“{offer}”？（可选：{names}）",
    "all_one_of": "可选：{names}",
    "near_known": "是不是“{offer}”？（已知：{names}）",
    "all_known": "已知：{names}",
    "near_there_is": "是不是“{offer}”？（已有：{names}）",
    "all_there_is": "已有：{names}",
    "nothing_there": "一个也没有",
    "it_has": "它有 {names}",
    "no_such_point": "构件 {link} 上没有点“{name}”；{hint}",
    "no_language": "没有语言“{language}”的文字；请用 {languages} 之一",
}
