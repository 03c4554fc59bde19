"""命令 ``program``。"""

WORDS = {
    "summary": "约束下的最小化或最大化：线性、整数、非线性",
    "description": """\
求解小文件中的优化问题：带界限的变量（连续、整数或从列表中选取），
要最小化或最大化的表达式，以及命名的约束。说明哪些约束起作用、
每放宽一个单位值多少；无解时指出哪些约束互相矛盾。""",
    "examples": """\
linkwright program gallery:production_mix
linkwright program gallery:lightest_spring --worked
linkwright program gallery:gear_pair --json""",
    "optimum": "最优解",
    "minimum": "最小值",
    "maximum": "最大值",
    "constraints": "约束",
    "active": "起作用",
    "slack": "余量 {slack}",
    "at_lower": "在下界",
    "at_upper": "在上界",
    "linear": "线性规划（单纯形法）：全局最优。",
    "integer": "混合整数线性规划（分支切割法）：全局最优。",
    "nonlinear": "非线性规划（序列二次规划）：{starts} 个起点中有 {agreed} 个到达此最优点；"
    "它是所找到的最好的局部最优。",
    "enumerated": "试过离散值的全部 {count} 种组合：全局最优。",
    "branched": "混合非线性规划（在局部最优上分支定界）：所找到的最好结果。",
    "price": "{name} 的右端每增加 1 {unit}，目标改变 {price}。",
    "step_1": "优化问题",
    "step_2": "最优解",
    "step_3": "最优点处的约束",
    "kkt": "KKT 条件（已归一化）：",
    "whole_numbers": "变量的整数或可选值",
    "no_variables": "没有变量",
    "no_variables_remedy": "请写 variables: {{x: {{from: 0, to: 10}}}}",
    "one_objective": "minimize 与 maximize 必须且只能有一个",
    "one_objective_remedy": "请写 minimize: 3*x + 2*y",
    "bounds": "下界 {low} 大于上界 {high}",
    "bounds_remedy": "请交换",
    "infeasible": "无解：以下条件不能同时成立：{set}",
    "infeasible_remedy": "请放宽其中之一；对这一组任意放宽一个即可",
    "not_found": "没有找到满足全部约束的点；从任何起点以下条件都不能同时成立：{set}",
    "not_found_remedy": "请放宽其中之一，或给出接近可行点的 start",
    "unbounded": "无界：目标沿 {variables} 无限改善",
    "unbounded_remedy": "请给这些变量界限，或加一个限制它们的约束",
    "no_constraint": "“{text}”不是约束",
    "no_constraint_remedy": "请写 左边 <= 右边、左边 >= 右边 或 左边 = 右边",
    "sides_differ": "左边是{left}，右边是{right}",
    "sides_differ_remedy": "请比较同一种量",
}
