"""Several threads, several processes, and Ctrl-C."""

import multiprocessing
import os
import signal
import threading
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest

import sinew
from conftest import tearing


def hash_after(name, seconds=1.0):
    sim = sinew.open(name)
    sim.run_until(seconds)
    return sim.hash()


def test_simulations_in_threads_have_the_same_bits():
    names = ["ragdoll", "rope", "chains", "bridge"] * 3
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(hash_after, names)) == [hash_after(name) for name in names]


def test_one_simulation_in_many_threads_steps_one_at_a_time():
    """Steps never mix: so many in all, in whatever order, give the state of so many in one thread."""
    sim, alone = sinew.open("ragdoll"), sinew.open("ragdoll")
    threads = [threading.Thread(target=lambda: [sim.step() for _ in range(25)]) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    alone.step(200)
    assert sim.steps == 200 and sim.hash() == alone.hash()


def test_reading_editing_and_closing_beside_steps_is_safe():
    sim = sinew.open(tearing)
    failures, kept = [], []

    def work(number):
        random = np.random.default_rng(number)
        try:
            for _ in range(60):
                choice = random.integers(6)
                if choice == 0:
                    sim.step()
                elif choice == 1:
                    kept.append(sim.positions)
                elif choice == 2:
                    sim.add_particle(random.normal(size=2))
                elif choice == 3:
                    sim.report(), sim.names, sim.tensions
                elif choice == 4:
                    sim.draw(32, 24)
                elif number == 0 and len(kept) > 100:
                    sim.close()
        except sinew.ClosedError:
            pass
        except Exception as problem:
            failures.append(problem)

    with ThreadPoolExecutor(6) as pool:
        list(pool.map(work, range(6)))
    assert not failures
    assert all(np.isfinite(view).all() for view in kept)


def test_steps_let_other_threads_run():
    """A thread that counts goes on while a big cloth steps."""
    cloth = sinew.open("cloth3d")
    counted, done = [0], threading.Event()

    def count():
        while not done.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    start = time.monotonic()
    while time.monotonic() - start < 0.5:
        cloth.step(20)
    done.set()
    thread.join()
    assert counted[0] > 20


def test_ctrl_c_ends_long_runs_between_two_steps():
    sim = sinew.open("ragdoll")
    timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        sim.run_until(1e6)
    timer.join()
    steps = sim.steps
    assert steps > 0
    other = sinew.open("ragdoll")
    other.step(steps)
    assert other.hash() == sim.hash()


@pytest.mark.parametrize("start", ["fork", "spawn"])
def test_processes_have_the_same_bits(start):
    hash_after("cloth3d", 0.1)  # the parent has started the threads of large worlds
    names = ["ragdoll", "cloth3d"]
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(start)) as pool:
        assert list(pool.map(hash_after, names, [0.2, 0.2])) == [hash_after(name, 0.2) for name in names]


def test_run_until_takes_as_many_steps_as_in_parts():
    one, many = sinew.open("ragdoll"), sinew.open("ragdoll")
    one.run_until(1.37)
    for part in np.linspace(0, 1.37, 7):
        many.run_until(part)
    assert one.steps == many.steps == round(1.37 * one.rate)
    one.run_until(0.5)
    assert one.steps == many.steps
    for wrong in (float("nan"), float("inf")):
        with pytest.raises(ValueError):
            one.run_until(wrong)
    with pytest.raises(ValueError):
        one.step(-1)
    one.step(0)
    assert one.steps == many.steps


def test_too_many_simulations_are_refused():
    kept = []
    with pytest.raises(MemoryError, match=r"too many open simulations: a process has 4096 at most; close\(\)"):
        for _ in range(5000):
            kept.append(sinew.open({"sinew": 1}))
    kept.clear()
    sinew.open({"sinew": 1})
