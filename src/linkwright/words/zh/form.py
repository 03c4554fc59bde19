"""模型文件中的键可写的内容。"""

WORDS = {
    "add_key": "请补上 {key_}: {form}",
    "one_of": "{names} 之一",
    "such_as": "{noun}，如 {example}",
    "formula": "{noun}，为 {variables} 的表达式",
    "name_of_link": "构件名",
    "name_of_joint": "运动副名",
    "name_of_point": "点名",
    "name_of_link_point": "点，写作 构件.点",
    "name_of_output": "输出",
    "either": "以下形式之一：{several}",
    "list_of_so_many": "{count} 项的列表，每项为{item}",
    "list_of": "列表，每项为{item}",
    "by_name": "按名称的映射，每项为{item}",
    "keys": "映射，可含键 {names}",
    "whole": "整数",
    "any_quantity": "数或带单位的量",
    "text": "文字",
    "value": "值",
}
