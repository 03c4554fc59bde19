"""The metric and the joint of CONTRIBUTING work as they are printed."""

import re
import subprocess
import sys
from pathlib import Path
from textwrap import dedent

ROOT = Path(__file__).parents[2]
FENCE = re.compile(r"^ *```(\w+)\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)


def blocks(language: str) -> list[str]:
    text = (ROOT / "CONTRIBUTING.md").read_text("utf-8")
    return [dedent(body) for kind, body in FENCE.findall(text) if kind == language]


def run(program: str, folder: Path) -> None:
    """In a process of its own, since it adds elements to the package."""
    script = folder / "added.py"
    script.write_text(program, encoding="utf-8")
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_the_metric_is_found_and_its_test_passes(tmp_path: Path) -> None:
    metric, test = blocks("py")[:2]
    run(metric + test.split('"""', 2)[2] + "\n\ntest_the_torque_of_a_yoke_is_a_sine()\n", tmp_path)


def test_the_joint_holds_the_pin_in_its_slot(tmp_path: Path) -> None:
    joint, model = blocks("py")[2], blocks("yaml")[0]
    check = f"""
import numpy as np
import linkwright as lw

motion = lw.solve_motion(lw.loads({model!r}), steps=24)
pin, pivot, angle = motion.point("A").position, (0.0, -0.3), motion.link("lever").angle
np.testing.assert_allclose(np.arctan2(*(pin - pivot).T[::-1]), angle, atol=1e-12)
assert np.abs(lw.solve_forces(motion).power_residual).max() < 1e-12
"""
    run(joint + check, tmp_path)


def test_the_joint_is_added_to_the_kinds_of_the_contract_tests() -> None:
    (line,) = [body for body in blocks("py") if body.lstrip().startswith('"slot"')]
    assert "KINDS: Mapping[str, str] = {" in (ROOT / "tests/contract/joints_of_every_kind.py").read_text("utf-8")
    assert line.strip().endswith(",")
