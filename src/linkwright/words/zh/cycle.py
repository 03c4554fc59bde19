"""沿循环的说明：转数、变点、到不了的区段、被跟踪的装配。"""

WORDS = {
    "turns": "循环为驱动“{driver}”转 {turns} 圈：此后各轮才回到起始位置",
    "turns_of_drivers": "循环为驱动“{driver}”转 {turns} 圈：此后各驱动才都回到起始位置",
    "drivers_apart": "各驱动在“{driver}”转 {turns} 圈后才都回到起始位置，因此取其一圈为不封闭的循环；"
    "cycle: {{duration: {duration} s}} 取全部",
    "drivers_never_back": "各驱动在“{driver}”的 {most} 圈内不能同时回到起始位置，因此取其一圈为不封闭的循环",
    "never_back": "各轮或齿条在 {most} 圈内回不到起始位置，因此取原动件一圈为不封闭的循环",
    "change": "杆组（{links}）在 {where} 处为变点：运动平稳地通过",
    "meeting": "杆组（{links}）的两外副在 {where} 处重合，杆组在此可自由转动：运动平稳地通过",
    "end": "杆组（{links}）在 {where} 处为变点：与其相连的无封闭解杆组不能跟踪通过，运动到此为止",
    "pole": "杆组（{links}）的两导路在 {where} 处平行：机构不能通过",
    "gap": "杆组（{links}）在两个位置之间 {where} 附近的一小段内无法装配：机构不能通过",
    "not_back": "一个循环后，无封闭解的杆组处于另一种装配模式：运动不以一个循环为周期",
    "two_cycles": "一个循环后机构处于另一种装配模式：运动每两个循环重复一次",
}
