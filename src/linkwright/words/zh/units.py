"""不是物理量的文字。"""

WORDS = {
    "large_exponent": "指数“{digits}”过大",
    "exponents": "单位的指数可取 -9 到 9",
    "unknown": "未知单位“{text}”",
    "space": "“{plain}”的数字中有空格",
    "write_number": "请写“{digits}{rest}”",
    "not_finite": "“{text}”不是有限的数",
    "number_such_as": "请写一个数，如“{example}”",
    "decimal_comma": "“{text}”用了逗号作小数点",
    "point": "请用小数点：“{right}”",
    "not_quantity": "“{text}”不是带单位的量",
    "number_and_unit": "请写数和单位，如“{example}”",
    "no_unit": "“{text}”没有单位",
    "needed": "需要{noun}，如“{right}”",
    "wrong_dimension": "“{text}”是{wrong}，此处需要{noun}",
    "as_in": "请写成如“{example}”",
    "write_unit": "请写单位，如 mm、deg、kg、N、N·m、rpm、kg·m²",
}
