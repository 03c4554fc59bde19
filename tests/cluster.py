"""``python -m tests.cluster``: two workers against one; sweeps survive kill -9 of a worker and of the whole run.

Every sweep that was disturbed must end with the same bytes as one that was not.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import distributed

import linkwright as lw

VARY = {"pitman.length": "1.15..1.35 m", "toggle.length": "1.05..1.25 m", "crank.length": "0.08..0.12 m"}
NUMBERS = ["driver.effort rms", "jaw.angle range", "reaction O5 on jaw max"]
OPTIONS = {"threads_per_worker": 1, "dashboard_address": None, "processes": True}


def contents(folder: Path) -> dict[str, bytes]:
    """The parts of a folder."""
    return {path.name: path.read_bytes() for path in sorted(folder.glob("part-*.parquet"))}


def swept(folder: Path, samples: int, client: object = None) -> float:
    """Seconds of a sweep."""
    begin = time.perf_counter()
    crusher = lw.load("gallery:jaw_crusher_sixbar")
    lw.sweep_parts(crusher, VARY, folder, outputs=NUMBERS, sampling="sobol", samples=samples, part=4096,
                   client=client, threads=1)  # fmt: skip
    return time.perf_counter() - begin


def speed(base: Path, samples: int) -> None:
    """Two workers against one."""
    seconds = []
    for workers in (1, 2):
        with (
            distributed.LocalCluster(n_workers=workers, **OPTIONS) as cluster,
            distributed.Client(cluster) as client,
        ):
            swept(base / f"warm {workers}", 4096 * 2 * workers, client)
            seconds.append(swept(base / f"{workers} workers", samples, client))
    one, two = seconds
    print(f"{samples} designs: one worker {one:.2f} s, two {two:.2f} s, ratio {one / two:.2f}", flush=True)


def worker_dies(base: Path, samples: int, wanted: dict[str, bytes], rounds: int) -> None:
    """A worker is killed at a random moment."""
    for number in range(rounds):
        with (
            distributed.LocalCluster(n_workers=2, **OPTIONS) as cluster,
            distributed.Client(cluster) as client,
        ):
            wait = random.uniform(0.1, 2.0)

            def kill(wait: float = wait, cluster: distributed.LocalCluster = cluster) -> None:
                time.sleep(wait)
                os.kill(random.choice(list(cluster.workers.values())).pid, signal.SIGKILL)

            killer = threading.Thread(target=kill)
            killer.start()
            folder = base / f"worker {number}"
            swept(folder, samples, client)
            killer.join()
        same = contents(folder) == wanted
        print(f"worker killed after {wait:.2f} s: {'equal to the bit' if same else 'DIFFERENT'}", flush=True)
        assert same


def run_dies(base: Path, samples: int, wanted: dict[str, bytes], rounds: int) -> None:
    """The whole run is killed at a random moment and started again until it is whole."""
    for number in range(rounds):
        folder, kills = base / f"run {number}", 0
        words = [sys.executable, "-m", "linkwright", "sweep", "gallery:jaw_crusher_sixbar", "--vary"]
        words += [f"{name}={text}" for name, text in VARY.items()]
        words += ["--numbers", *NUMBERS, "--folder", str(folder), "--sampling", "sobol", "--samples", str(samples),
                  "--part", "4096"]  # fmt: skip
        while True:
            run = subprocess.Popen(words, stdout=subprocess.DEVNULL)
            try:
                code = run.wait(timeout=random.uniform(1.0, 4.0) if kills < 2 else None)
                assert code == 0
                break
            except subprocess.TimeoutExpired:
                run.send_signal(signal.SIGKILL)
                run.wait()
                kills += 1
        same = contents(folder) == wanted
        print(f"run killed {kills} times: {'equal to the bit' if same else 'DIFFERENT'}", flush=True)
        assert same


def main() -> int:
    """Runs all three."""
    parser = argparse.ArgumentParser(prog="python -m tests.cluster", description=__doc__)
    parser.add_argument("--samples", type=int, default=200_000)
    parser.add_argument("--rounds", type=int, default=10)
    options = parser.parse_args()
    base = Path(tempfile.mkdtemp(prefix="linkwright-cluster-"))
    try:
        speed(base, options.samples)
        swept(base / "here", options.samples)
        wanted = contents(base / "here")
        worker_dies(base, options.samples, wanted, options.rounds)
        run_dies(base, options.samples, wanted, options.rounds)
    finally:
        shutil.rmtree(base)
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
