"""命令 ``check``。"""

WORDS = {
    "summary": "找出模型文件中的全部问题",
    "description": """\
读取模型文件，一次报告全部问题，每条都给出位置（文件:行:列）、原因和改法。
读取无误的文件随后作结构分析并转过一个循环，
因此不能运动、或到不了某个位置的机构也会被发现。""",
    "examples": """\
linkwright check crusher.yaml
linkwright check *.yaml --strict      警告按错误处理
linkwright check crusher.yaml --json  供编辑器或脚本使用的结果""",
    "files_help": "模型文件，或 gallery:NAME",
    "strict_help": "警告按错误处理",
    "fine": "{name}：没有错误（{links} 个活动构件，自由度 {mobility}）",
    "fine_kind": "{name}：正确（类型 {kind}）",
    "faulty": "{name}：错误 {count} 处",
    "never_increasing": "载荷从不作用：{output} 在循环内从不增大",
    "never_decreasing": "载荷从不作用：{output} 在循环内从不减小",
    "never_do": "请改用沿该方向运动的输出，或改写 direction",
    "no_pin_radius": "转动副给了摩擦系数而没有销轴半径，无法求力",
    "add_pin_radius": "请加上 pin_radius，如 pin_radius: 20 mm",
    "rubs": "摩擦系数 {friction:g} 比干橡胶还大",
    "rubs_do": "常见为 0.01 至 0.6；请核对",
    "assumed": "{signature} 杆组（{links}）有两种装配模式，assembly 与 drawing 均未指明：取“{first}”；"
    "请写 assembly: {{{joint}: {first}}} 或 {{{joint}: {second}}}",
    "singular": "杆组（{links}）始终接近奇异位置（封闭方程的行列式最大为 {best}，限值 {limit}）："
    "其运动几乎不能确定，力会变得很大",
    "singular_do": "请改变其构件的长度或连接位置",
}
