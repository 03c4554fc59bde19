"""The words on drawings, in English and Chinese."""

from __future__ import annotations

from linkwright.errors import LinkwrightError

WORDS: dict[str, dict[str, str]] = {
    "en": {
        "force": "joint forces",
        "load": "loads",
        "velocity": "velocities",
        "acceleration": "accelerations",
        "path": "path of {name}",
        "drawing": "Kinematic drawing of {name}",
        "animation": "Moving drawing of {name}",
    },
    "zh": {
        "force": "运动副反力",
        "load": "载荷",
        "velocity": "速度",
        "acceleration": "加速度",
        "path": "{name} 点的轨迹",
        "drawing": "{name} 机构运动简图",
        "animation": "{name} 机构动画",
    },
}


def words(language: str) -> dict[str, str]:
    """The words of a language, ``en`` or ``zh``; raises LinkwrightError for another."""
    if language not in WORDS:
        raise LinkwrightError(f'there are no words for the language "{language}"; use one of {", ".join(WORDS)}')
    return WORDS[language]
