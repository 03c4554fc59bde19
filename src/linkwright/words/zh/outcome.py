"""各位置的求解情况。"""

WORDS = {
    "assembled": "可装配",
    "barred": "从第一个位置到此位置的途中有到不了的位置",
    "between": "两个位置之间的通路被阻断",
    "lost": "{signature} 杆组（{links}）不能连续运动到此位置：超出可达范围，或须越过奇异位置",
    "stopped": "{signature} 杆组（{links}）不能连续运动到此位置：途中在 {where} 处到达奇异位置",
    "singular": "{signature} 杆组（{links}）处于奇异位置（死点或变点），原动件在此不能确定其运动",
    "coinciding": "{signature} 杆组（{links}）的两个外副重合，杆组可绕其自由转动",
    "misfit": "“{joint}”的尺寸不合：{reason}",
    "apart": "{signature} 杆组（{links}）无法装配：{reason}",
    "rrr_far": "两外副相距 {distance}，长 {first} 与 {second} 的构件最多可达 {reach}：差 {missing}",
    "rrr_near": "两外副相距 {distance}，长 {first} 与 {second} 的构件至少需要 {reach}：近了 {missing}",
    "rrp_far": "外转动副到滑块销轴轨迹的距离为 {height}，构件只可达 {length}：差 {missing}",
    "rpr_near": "两外副相距 {distance}，导路要求两者在垂直于导路方向上相距 {offset}：近了 {missing}",
    "rpp_parallel": "两移动方向平行（夹角的正弦为 {sine}）",
    "prp_parallel": "两导路平行（夹角的正弦为 {sine}）",
}
