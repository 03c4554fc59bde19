"""关于载荷的说明。"""

WORDS = {
    "part_first": "前段",
    "part_last": "末段",
    "part_free": "两端空程",
    "part_too_long": "所取的行程部分过长（{part} {amounts}）：输出“{output}”的行程为 {stroke}；请减小",
    "no_slope_of_part": "loads.{name}：对行程某一部分上的斜坡载荷没有导数；请改用 study 改变尺寸",
}
