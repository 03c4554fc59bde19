"""命令 ``schema``。"""

WORDS = {
    "summary": "模型与计算文件的 JSON Schema，供编辑器使用",
    "description": "输出模型与计算文件的 JSON Schema（2020-12 版），由模型本身生成。\n编辑器据此补全键名并标出错误："
    "在模型文件的第一行写\n# yaml-language-server: $schema=./linkwright.schema.json",
    "output_help": "写入文件",
}
