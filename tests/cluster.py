"""``python -m tests.cluster``: two workers against one; sweeps, searches and studies survive kill -9 at random times.

Every sweep and every search that was disturbed must end with the same bytes as one that was not; a free curve, whose
search a clock ends, with as small an error, and with the same bytes when it is shown again.
"""

from __future__ import annotations

import argparse
import json
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
#: A front whose designs go side by side, and teeth, which go one by one and by the cluster where one is named.
FRONT = [
    "gallery:jaw_crusher_sixbar",
    "--vary",
    *(f"{name}={text}" for name, text in VARY.items()),
    "--minimize",
    "peak_input_torque",
    "flywheel",
    "--evaluations",
    "120000",
]
TEETH = """\
format: 1
name: Pair
parameters: {small: 20, large: 40}
frame: {points: {O: [0 mm, 0 mm], Q: [(small + large)*1 mm, 0 mm]}}
links:
  pinion: {points: {O: [0 mm, 0 mm], P: [16 mm, 0 mm]}, mass: 1 kg, inertia: 0.0002 kg·m², mass_centre: [0 mm, 0 mm]}
  wheel: {points: {Q: [0 mm, 0 mm], W: [34 mm, 0 mm]}, mass: 4 kg, inertia: 0.0032 kg·m², mass_centre: [9 mm, 0 mm]}
joints:
  mesh: {kind: gear, links: [pinion, wheel], teeth: [small, large], module: 2 mm}
driver: {turn: pinion, about: O, speed: 600 rpm}
gravity: [0, -9.81 m/s²]
loads: {work: {kind: torque, on: wheel, magnitude: 40 N·m}}
optimize:
  vary: {small: {whole: 17..60}, large: {whole: 30..90}}
  minimize: [peak_input_torque, a + b]
  define: {a: small, b: large}
  evaluations: 600
"""
#: A curve, the search for which a clock ends, and the error of a linkage that this time is enough for.
CURVE = ["synthesize", "free_curve", "points=[[9, 0], [9, 17], [0, 6], [13, 6]]", "unit=mm", "seconds=12"]
ENOUGH = 0.01
POINTS = "points=[[20, 10], [17.7, 15.1], [11.7, 17.9], [5, 16.9], [0.6, 12.7], [1, 6], [6, 2], [14, 3], [18, 6]]"
#: Work whose finished parts are kept.
LONG = {
    "study": [
        "study",
        "gallery:jaw_crusher_sixbar",
        "--vary",
        *(f"{name}={text}" for name, text in VARY.items()),
        "--sampling",
        "sobol",
        "--samples",
        "30000",
        "--output",
        "designs.csv",
    ],
    "tolerance run": ["tolerance", "gallery:pressed_pins", "--output", "curves.csv"],
    "path": ["synthesize", "path", POINTS, "unit=mm", "turning=false"],
    "nine points": ["synthesize", "exact_path", POINTS, "unit=mm"],
}
OPTIONS = {"threads_per_worker": 1, "dashboard_address": None, "processes": True}


def contents(folder: Path) -> dict[str, bytes]:
    """The parts of a folder."""
    return {path.name: path.read_bytes() for path in sorted(folder.glob("part-*.parquet"))}


def swept(folder: Path, samples: int, client: object = None, part: int = 4096) -> float:
    """Seconds of a sweep."""
    begin = time.perf_counter()
    crusher = lw.load("gallery:jaw_crusher_sixbar")
    lw.sweep_parts(
        crusher, VARY, folder, outputs=NUMBERS, sampling="sobol", samples=samples, part=part, client=client, threads=1
    )
    return time.perf_counter() - begin


def speed(base: Path, samples: int) -> None:
    """Two workers against one, which share the cores with the scheduler: four times the designs in larger parts."""
    seconds, samples, part = [], 4 * samples, 16384
    for workers in (1, 2):
        with distributed.LocalCluster(n_workers=workers, **OPTIONS) as cluster, distributed.Client(cluster) as client:
            swept(base / f"warm {workers}", part * 2 * workers, client, part)
            seconds.append(swept(base / f"{workers} workers", samples, client, part))
    one, two = seconds
    print(f"{samples} designs: one worker {one:.2f} s, two {two:.2f} s, ratio {one / two:.2f}", flush=True)


def worker_dies(base: Path, samples: int, wanted: dict[str, bytes], rounds: int) -> None:
    """A worker is killed at a random moment."""
    for number in range(rounds):
        with distributed.LocalCluster(n_workers=2, **OPTIONS) as cluster, distributed.Client(cluster) as client:
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
        words += [
            "--numbers",
            *NUMBERS,
            "--folder",
            str(folder),
            "--sampling",
            "sobol",
            "--samples",
            str(samples),
            "--part",
            "4096",
        ]
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


def undisturbed(words: list[str], folder: Path) -> tuple[bytes, float]:
    """What work printed and wrote, and how many seconds it took."""
    begin = time.perf_counter()
    return stopped(words, folder, 0, 0.0)[0], time.perf_counter() - begin


def stopped(words: list[str], folder: Path, most_kills: int, longest: float) -> tuple[bytes, int]:
    """What work that has a state printed and wrote, and how often it was killed at a random moment, after at most
    ``longest`` seconds, and started again."""
    folder.mkdir(exist_ok=True)
    words = [sys.executable, "-m", "linkwright", *words, "--json", "--state", "work.state", "--force"]
    kills, begin = 0, time.perf_counter()
    while True:
        with (folder / "printed").open("wb") as printed:
            run = subprocess.Popen(words, stdout=printed, cwd=folder)
            try:
                wait = random.uniform(longest / 6, longest) if kills < most_kills else None
                assert run.wait(timeout=wait) == 0
                break
            except subprocess.TimeoutExpired:
                run.send_signal(signal.SIGKILL)
                run.wait()
                kills += 1
    print(f"  {time.perf_counter() - begin:.1f} s", flush=True)
    files = [each for each in sorted(folder.iterdir()) if not each.name.startswith("work.state")]
    return b"".join(each.read_bytes() for each in files), kills


def work_dies(base: Path, rounds: int) -> None:
    """Work whose parts are kept is killed and started again, studies and tolerance runs on a cluster too."""
    with distributed.LocalCluster(n_workers=2, **OPTIONS) as cluster:
        away = ["--cluster", cluster.scheduler_address]
        for name, words in LONG.items():
            wanted, longest = undisturbed(words, base / name)
            for number in range(rounds):
                for where, more in (("here", []), ("a cluster", away))[: 2 - (words[0] == "synthesize")]:
                    folder = base / f"{name} on {where} {number}"
                    found, kills = stopped([*words, *more], folder, 2, longest)
                    told = "equal to the bit" if found == wanted else "DIFFERENT"
                    print(f"{name} on {where} killed {kills} times: {told}", flush=True)
                    assert found == wanted


def search_dies(base: Path, rounds: int) -> None:
    """Searches of designs side by side, and of designs one by one on a cluster, are killed and started again."""
    model = base / "teeth.yaml"
    model.write_text(TEETH)
    with distributed.LocalCluster(n_workers=2, **OPTIONS) as cluster:
        away = ["--cluster", cluster.scheduler_address]
        for name, words, more in (("front", FRONT, []), ("pair of gears", [str(model)], away)):
            words = ["optimize", *words, "--output", "better.yaml"]
            wanted, longest = undisturbed(words, base / name)
            for number in range(rounds):
                found, kills = stopped([*words, *more], base / f"{name} {number}", 2, longest)
                told = "equal to the bit" if found == wanted else "DIFFERENT"
                print(f"search of a {name} killed {kills} times: {told}", flush=True)
                assert found == wanted


def curve_dies(base: Path, rounds: int) -> None:
    """The search for a free curve is killed and started again, and a worker of its cluster is killed."""
    for number in range(rounds):
        for where in ("here", "cluster"):
            folder, more = base / f"curve {where} {number}", list[str]()
            with distributed.LocalCluster(n_workers=2, **OPTIONS) as cluster:
                if where == "cluster":
                    more = ["--cluster", cluster.scheduler_address]
                    pid = random.choice(list(cluster.workers.values())).pid
                    threading.Timer(random.uniform(4.0, 12.0), os.kill, (pid, signal.SIGKILL)).start()
                found, kills = stopped([*CURVE, *more], folder, 2, 12.0)
            again, _ = stopped(CURVE, folder, 0, 12.0)  # the time is over: what is kept is shown
            best = json.loads(found)["candidates"][0]["error"]
            told = "equal to the bit" if again == found else "DIFFERENT"
            print(f"free curve on {where} killed {kills} times: error {best:.4f}, shown again {told}", flush=True)
            assert again == found and best < ENOUGH


def main() -> int:
    """Runs all six."""
    parser = argparse.ArgumentParser(prog="python -m tests.cluster", description=__doc__)
    parser.add_argument("--samples", type=int, default=200_000)
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument("--searches", action="store_true", help="searches alone")
    parser.add_argument("--work", action="store_true", help="studies and tolerance runs alone")
    parser.add_argument("--speed", action="store_true", help="two workers against one alone")
    options = parser.parse_args()
    base = Path(tempfile.mkdtemp(prefix="linkwright-cluster-"))
    try:
        if options.speed:
            speed(base, options.samples)
            return 0
        if not options.searches:
            work_dies(base, options.rounds)
        if options.work:
            return 0
        search_dies(base, options.rounds)
        curve_dies(base, options.rounds)
        if options.searches:
            return 0
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
