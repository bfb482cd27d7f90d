"""Worlds of a batch beside a loop of single ones: python3 bindings/python/bench/batch.py [--worlds 64] [--steps 200] [--turns 15]

Columns: worlds stepped a second by a loop over simulations in one thread; by a batch on all cores; the batch's share of the
sum of the cores, each taken as fast as the loop; the loop's processor time as a share of the batch's, which does not see what other
programs take; and the memory of a world. Medians of turns, loop and batch by turns.
The last line is the time of a batch's step beside that of its worlds: what Python and the gathering of arrays cost.
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


def measure(name, scene, options):
    before = memory()
    worlds = sinew.batch(scene, options.worlds)
    worlds.step()
    each = (memory() - before) / options.worlds
    singles = [sinew.open(scene) for _ in range(options.worlds)]

    def loop():
        for sim in singles:
            sim.step(options.steps)

    def batch():
        for _ in range(options.steps):
            worlds.step()

    loops, batches = zip(*((timed(loop), timed(batch)) for _ in range(options.turns)))
    steps = options.worlds * options.steps
    alone, alone_processor = map(statistics.median, zip(*loops))
    together, together_processor = map(statistics.median, zip(*batches))
    share = alone / together / hardware_threads()
    print(f"{options.worlds} x {name:8} {steps / alone:12,.0f}/s {steps / together:12,.0f}/s {share:6.2f} "
          f"{alone_processor / together_processor:6.2f} {each / 1024:8.1f} KiB a world")


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
