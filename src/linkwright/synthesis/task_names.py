"""Names of the tasks, for help that must not import what solves them."""

TASK_NAMES = (
    "slider_crank", "crank_rocker", "quick_return", "drag_link", "toggle", "dwell", "straight_line",
    "function", "motion", "path", "exact_path", "free_curve",
)  # fmt: skip
