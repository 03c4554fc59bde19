"""What names of machine parts and quantities mean, so that a wrong name finds the right one by its meaning."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import cache

#: Words of machine design that stand for the same thing, in English, in Chinese, and as symbols that are usual.
ALIKE = """
ram rammer slider block piston plunger punch carriage crosshead 滑块 活塞
crank crankshaft handle eccentric 曲柄
rocker lever arm beam oscillator 摇杆 摆杆
coupler rod conrod connecting pitman 连杆
frame ground base bed chassis fixed support 机架 机座
guide guideway slideway rail slot track prismatic sliding slide 导路 导轨 移动副
pin hinge pivot revolute bearing turning 转动副 铰链
output driven follower 输出 从动件
input driver driving drive motor actuator 输入 驱动 原动件
link member bar body element 构件 杆件
joint pair 运动副
length size span long 长度 杆长
angle orientation direction rotation 角度 转角
offset eccentricity 偏距
torque moment couple 力矩 转矩 扭矩
force load thrust 力 载荷
reaction support_force constraint_force 反力
mass weight 质量 重量
gravity 重力
inertia gyration 转动惯量 惯量
speed velocity rate rpm 速度 转速
acceleration 加速度
displacement position place location 位移 位置
stroke travel lift 行程
swing_angle swing amplitude 摆角
quick_return_ratio time_ratio k 行程速比系数 急回系数
time duration period 时间 周期
peak max maximum largest 最大 峰值
least min minimum smallest 最小
mean average 平均
spring elastic 弹簧
damper dashpot 阻尼器 阻尼
friction rubbing 摩擦
power 功率
energy work 能量 功
flywheel 飞轮
transmission 传动
path curve trajectory locus 轨迹 曲线
point 点
centre center centroid 质心 中心
cam 凸轮
constant_acceleration parabolic 等加速等减速 等加等减 抛物线
simple_harmonic cosine 余弦加速度 简谐
cycloidal sine 正弦加速度 摆线
constant_velocity 等速
modified_trapezoidal 修正梯形 改进梯形
modified_sine 修正正弦 改进正弦
polynomial_345 五次多项式
gear wheel pinion 齿轮
mesh internal external engagement 啮合 内啮合
jaw plate 颚板 动颚
kind type sort 类型 种类
name title 名称 题目
magnitude amount 大小
parameters constants 参数
teeth 齿数
module 模数
assembly 装配 装配模式
drawing 装配图
cycle 循环 工作循环
toggle knee 肘板 肘杆
"""


@cache
def _concepts() -> dict[str, str]:
    return {word: line.split()[0] for line in ALIKE.strip().splitlines() for word in line.split()}


@cache
def meaning(name: str) -> frozenset[str]:
    """What a name says: its words, each as the first of those that are :data:`ALIKE`, in no order."""
    known = _concepts()
    whole = name.casefold()
    if whole in known:
        return frozenset((known[whole],))
    words = re.findall(r"[a-z]+|[\u4e00-\u9fff]+", re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).casefold())
    return frozenset(known.get(word, known.get(word.removesuffix("s"), word)) for word in words)


def nearest_in_meaning(name: str, candidates: Iterable[str]) -> tuple[str, float]:
    """The candidate that shares most words with a name, by their meaning, and the share of all words that it is."""
    said = meaning(name)
    best, share = "", 0.0
    for each in candidates:
        other = meaning(each)
        common = len(said & other) / (len(said | other) or 1)
        if common > share:
            best, share = each, common
    return best, share
