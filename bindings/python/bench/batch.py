"""Worlds of a batch beside single ones: python3 bindings/python/bench/batch.py [--worlds 64] [--steps 200] [--turns 15]

Ways: a loop that takes all steps of a world taken the next world's; a loop that takes one step of each world in turn; a batch on all
cores, a call a step; a batch, all steps in one call. Columns: worlds stepped a second; share of the sum of the cores, each taken as
fast as the first loop; processor time of a world's step, least and median of the turns, which sees less of other programs. Then the
memory of a world; and the time of a batch's step beside that of its worlds: Python, and the gathering of arrays.
"""

import argparse
import statistics
import time

import sinew
from sinew._core import hardware_threads

rope = {"sinew": 1, "world": {"gravity": [0, -9.81]},
        "figures": [{"prefab": "rope", "name": "rope", "length": 2, "segments": 20, "weight": 5, "angle": 30}]}
tiny = {"sinew": 1, "figures": [{"name": "one", "particles": {"a": {"at": [0, 0]}}}]}


def timed(work):
    """Seconds of the clock, and of the processor in all threads."""
    start, processor = time.perf_counter(), time.process_time()
    work()
    return time.perf_counter() - start, time.process_time() - processor


def memory():
    """Resident memory of the process, bytes."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * 4096


def ways(scene, options):
    """Function of each way by its name; each has worlds of its own."""
    one, turn = ([sinew.open(scene) for _ in range(options.worlds)] for _ in range(2))
    calls, call = (sinew.batch(scene, options.worlds) for _ in range(2))
    return {"loop": lambda: [sim.step(options.steps) for sim in one],
            "in turns": lambda: [sim.step() for _ in range(options.steps) for sim in turn],
            "batch": lambda: [calls.step() for _ in range(options.steps)],
            "batch, one call": lambda: call.step(options.steps)}


def measure(name, scene, options):
    taken = []
    kept = []
    for _ in range(3):  # what the program and its threads allocate once is of the first
        kept.append(sinew.batch(scene, options.worlds))
        kept[-1].step()
        taken.append(memory())
    print(f"{options.worlds} x {name}, {(taken[2] - taken[1]) / options.worlds / 1024:.0f} KiB a world")
    kept.clear()
    works = ways(scene, options)
    turns = [{way: timed(work) for way, work in works.items()} for _ in range(options.turns)]
    steps = options.worlds * options.steps
    alone = statistics.median(turn["loop"][0] for turn in turns)
    for way in works:
        clock = statistics.median(turn[way][0] for turn in turns)
        processor = [1e6 * turn[way][1] / steps for turn in turns]
        print(f"{way:16} {steps / clock:10,.0f}/s {alone / clock / hardware_threads():6.2f} {min(processor):8.1f} "
              f"{statistics.median(processor):8.1f} us", flush=True)


def overhead(options):
    worlds, single = sinew.batch(tiny, 1), sinew.open(tiny)
    count = options.steps * 50
    batch = min(timed(lambda: [worlds.step() for _ in range(count)])[1] for _ in range(options.turns)) / count
    steps = min(timed(lambda: single.step(count))[1] for _ in range(options.turns)) / count
    print(f"a batch's step beside its worlds': {1e6 * (batch - steps):.2f} us")


def main(arguments=None):
    parser = argparse.ArgumentParser()
    for name, usual in (("worlds", 64), ("steps", 200), ("turns", 15)):
        parser.add_argument(f"--{name}", type=int, default=usual)
    options = parser.parse_args(arguments)
    for name, scene in (("rope", rope), ("ragdoll", "ragdoll")):
        measure(name, scene, options)
    overhead(options)


if __name__ == "__main__":
    main()
