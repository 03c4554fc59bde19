"""Synonyms for names of machine parts and quantities, so that a wrong name finds the right one by its meaning."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache

#: Synonyms in machine design, a line each: English, Chinese and the usual symbols.
SYNONYMS = """
ram rammer slider block piston plunger punch carriage crosshead 滑块 活塞
crank crankshaft handle eccentric 曲柄
rocker lever arm beam oscillator 摇杆 摆杆
coupler rod conrod connecting pitman 连杆
frame ground base bed chassis fixed support 机架 机座
guide guideway slideway rail slot track prismatic sliding slide 导路 导轨 滑道 滑槽 移动副
cylinder hydraulic_cylinder jack 液压缸 气缸
pin hinge pivot revolute bearing turning 转动副 回转副 铰链 铰接 铰 销 销轴
output driven follower 输出 从动件
input driver driving drive motor actuator 输入 驱动 原动件 电机 电动机 马达
brake clutch 制动器 制动 刹车
stop endstop buffer bumper end_stop 挡块 限位 限位块 止挡
run simulation simulate dynamics 仿真 运行 动力学
link member bar body element 构件 杆件
joint pair 运动副
length size span long l 长度 杆长
angle orientation direction rotation 角度 转角
offset eccentricity 偏距
torque moment couple 力矩 转矩 扭矩
force load thrust 力 载荷
reaction support_force constraint_force 反力
mass weight m 质量 重量
gravity 重力
inertia gyration j i 转动惯量 惯量
speed velocity rate rpm n omega ω 速度 转速 角速度
acceleration 加速度
displacement position place location 位移 位置
stroke travel lift 行程
swing_angle swing amplitude 摆角
quick_return_ratio time_ratio k 行程速比系数 急回系数
time duration period 时间 周期
peak max maximum largest 最大 峰值
least min minimum smallest 最小
mean average 平均
spring elastic gas_spring gas_strut air_spring 弹簧 气弹簧
stiffness spring_rate spring_constant 刚度 弹簧刚度
free_length l0 natural_length rest_length 原长 自由长度
damper dashpot 阻尼器
damping c 阻尼 阻尼系数
friction rubbing 摩擦
power 功率
energy work 能量 功
flywheel 飞轮
transmission 传动
path curve trajectory locus 轨迹 曲线
point 点
centre center centroid 质心 中心
cam 凸轮 凸轮副
program motion_program lifts lift_table 运动规律 升程表
knife knife_edge pointed edge 尖顶 尖底
roller 滚子
flat flat_faced 平底
rolling friction_wheel 摩擦轮 滚动副
belt pulley 带 皮带 带传动
chain sprocket 链 链条 链传动
rack 齿条 齿条副
weld welded rigid 焊接 刚接 固定副
pressure gas hydraulic pneumatic 压力 气压 液压
constant_acceleration parabolic parabola 等加速等减速 等加等减 抛物线
simple_harmonic harmonic cosine cosinus shm 余弦加速度 简谐
cycloidal cycloid sine sinus sinusoidal 正弦加速度 摆线
constant_velocity uniform 等速
modified_trapezoidal 修正梯形 改进梯形
modified_sine 修正正弦 改进正弦
polynomial_345 五次多项式
gear wheel pinion spur 齿轮 齿轮副
mesh internal external engagement 啮合 内啮合
jaw plate 颚板 动颚
kind type sort 类型 种类
name title 名称 题目
magnitude amount 大小
parameters constants variables 参数 变量
teeth z 齿数
module 模数
assembly 装配 装配模式
drawing 装配图
cycle 循环 工作循环
toggle knee 肘板 肘杆
"""

#: What a thing goes with, where nothing means just that thing: a slider runs in a guide, which is a joint; a cylinder
#: guides its rod and presses on it; other quantities with the same letter.
RELATED = {
    "cylinder": "guide pressure",
    "ram": "guide",
    "frame": "weld",
    "guide": "joint",
    "pin": "joint",
    "gear": "joint",
    "cam": "joint",
    "belt": "joint",
    "weld": "joint",
    "spring": "force",
    "force": "preload",
    "damper": "force",
    "torque": "force",
    "pressure": "force",
    "joint": "link",
    "quick_return_ratio": "stiffness",
    "crank": "link",
    "rocker": "link",
    "coupler": "link",
}


@cache
def _concepts() -> dict[str, str]:
    return {word: line.split()[0] for line in SYNONYMS.strip().splitlines() for word in line.split()}


@cache
def meaning(name: str) -> frozenset[str]:
    """Meaning of a name: its words, each as the first of its :data:`SYNONYMS`, unordered; a letter means
    something alone."""
    known = _concepts()
    letters_only = re.sub(r"\W", "", name).casefold()
    if letters_only in known:
        return frozenset((known[letters_only],))
    words = re.findall(r"[a-z]+|[\u4e00-\u9fff]+", re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).casefold())
    letters = frozenset(word for word in words if len(word) == 1 and word.isascii())
    return letters | {
        known.get(word, known.get(word.removesuffix("s"), word)) for word in words if word not in letters
    }


def nearest_in_meaning(name: str, candidates: Iterable[str]) -> tuple[str, float]:
    """The candidate that shares most words with a name, by their meaning, and the share of all words that it is;
    where none shares any, one for what the name goes with."""
    meanings, named = meaning(name), {each: meaning(each) for each in candidates}
    while meanings:
        shares = {each: len(meanings & other) / len(meanings | other) for each, other in named.items() if other}
        best = max(shares, key=shares.__getitem__, default="")
        if best and shares[best]:
            return best, shares[best]
        meanings = frozenset(each for word in meanings if word in RELATED for each in RELATED[word].split())
    return "", 0.0
