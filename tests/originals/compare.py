#!/usr/bin/env python3
"""Classic mode beside the tutorials' rules, frame by frame: the command's traces against the scripts of this folder.

    SINEW=build/bin/sinew tests/originals/compare.py            every tutorial; exit code 1 where one differs
    tests/originals/compare.py --frames                         writes frames.csv: the first frames by these scripts
    tests/originals/compare.py --check                      whether frames.csv is what these scripts say

No point may be more than 1e-6 px away in any frame.
"""
import csv
import math
import os
import subprocess
import sys
import tempfile

import flash
import gamemaker
import godot
import opengl
import roblox

HERE = os.path.dirname(os.path.abspath(__file__))
SCENES = os.path.join(HERE, "..", "..", "scenes")
ALLOWED = 1e-6  # px


# --- the command's side ----------------------------------------------------------------------------------------------

def write_pointer(path, samples):
    with open(path, "w", encoding="utf-8") as file:
        for time, (x, y), button in samples:
            file.write(f"{time!r}, {x!r}, {y!r}, {button}\n")


def trace(scene, frames, overrides=(), pointer=None):
    """Positions by name, a dictionary for the start and for each frame."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "trace.csv")
        command = [os.environ.get("SINEW", os.path.join(HERE, "..", "..", "build", "bin", "sinew")), "run", os.path.join(SCENES, scene + ".json"), "mode=classic",
                   "--seconds", repr(frames / 60), "--trace", path, *overrides]
        if pointer:
            write_pointer(os.path.join(folder, "pointer.csv"), pointer)
            command += ["--pointer", os.path.join(folder, "pointer.csv")]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        found = []
        with open(path, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                if not found or row["time"] != found[-1][0]:
                    found.append((row["time"], {}))
                found[-1][1][row["name"]] = (float(row["x"]), float(row["y"]))
        return [places for _, places in found]


# --- the tutorials' side: the start and each frame ---------------------------------------------------------------------

def played(world, frames, step=lambda world, frame: world.frame()):
    history = [world.places()]
    for frame in range(1, frames + 1):
        step(world, frame)
        history.append(world.places())
    return history


def flash_mouse(frame):
    """A mouse that rests where the points begin, and then goes round, now slowly, now fast."""
    if frame <= 5:
        return flash.START
    turn = 0.05 * (frame - 5) + 0.6 * math.sin(0.07 * frame)
    return (240 + 130 * math.sin(turn), 165 + 90 * math.sin(1.7 * turn))


def mix(x):
    """splitmix64's finaliser: the scene's random numbers."""
    mask = (1 << 64) - 1
    x = (x + 0x9E3779B97F4A7C15) & mask
    x = ((x ^ (x >> 30)) * 0xBF58476D1CE4E5B9) & mask
    x = ((x ^ (x >> 27)) * 0x94D049BB133111EB) & mask
    return x ^ (x >> 31)


def whole(low, high, seed, stream, n):
    bits = mix(mix(mix(seed) ^ stream) ^ n)
    return low + ((bits >> 32) * (high - low + 1) >> 32)


def random_push(frame, points):
    seed = 1 ^ mix(0)
    return whole(0, points - 1, seed, 2, frame), whole(-2, 6, seed, 0, frame)


# --- the rows --------------------------------------------------------------------------------------------------------

class Row:
    """A scene with overrides, played with a mouse or without, and where a tutorial's rules have its points."""

    def __init__(self, name, scene, history, overrides=(), mouse=None):
        self.name, self.scene, self.history, self.overrides = name, scene, history, list(overrides)
        self.mouse = [(frame, mouse(frame), 0) for frame in range(1, len(history))] if mouse else None

    def trace(self):
        return trace(self.scene, len(self.history) - 1, self.overrides, self.mouse)


def roblox_rows():
    printed = ["solver.rules.points_only_passes=true"]
    repaired = ["solver.rules.moves_each_pass=true"]
    for scene, make, frames in (("box", roblox.box, 200), ("ragdoll", roblox.ragdoll, 240)):
        yield Row(scene, scene, played(make(), frames))
        yield Row(scene + ", the loop as printed", scene, played(make(loop="points"), 10), printed)
        tame = 200 if scene == "box" else 60  # then rounding grows tenfold every eight frames: fifteen points are chaotic
        yield Row(scene + ", a reader's repair", scene, played(make(loop="both"), tame), repaired)
    thrown = ["figures.box.velocity=[9,-16]"]  # against the right wall and the top
    yield Row("box, thrown at the walls", "box", played(roblox.thrown(roblox.box(), 9, -16), 200), thrown)
    yield Row("box, walls as printed", "box", played(roblox.thrown(roblox.box(outward=True), 9, -16), 200),
              thrown + ["solver.rules.outward_bounce=true"])
    yield Row("cloth_wind", "cloth_wind", played(roblox.Cloth(random_push), 300))


def opengl_rows():
    make = lambda: opengl.stick_figure((250, 330), 210, -250, {"head": (150, 0)})
    yield Row("stick_figure", "stick_figure", played(make(), 150))
    yield Row("stick_figure, nobody grabs", "stick_figure", played(make(), 200), ["events=[]"])


def gamemaker_rows():
    def mouse(frame):
        return (640 + 60 * math.sin(0.03 * frame), 360 + 90 * math.cos(0.05 * frame))

    unshaken = 'events=[{"at":0,"set":{"gravity":[0,0]}},{"at":1,"set":{"gravity":[0,0.5]}}]'
    history = played(gamemaker.Humanoid(), 240, lambda world, frame: world.frame(mouse(frame)))
    yield Row("bezier_humanoid, unshaken", "bezier_humanoid", history, [unshaken], mouse)


def flash_rows():
    for scene, make in (("stick", flash.stick), ("fixed_stick", flash.fixed_stick), ("triangle", flash.triangle)):
        yield Row(scene, scene, played(make(), 200, lambda world, frame: world.frame(flash_mouse(frame))), (), flash_mouse)


SWING = ['figures.chain_30.kicks={"end":[12,0]}']


def swinging(chain):
    """Its last loop is thrown to the right: 12 px a frame."""
    chain.before[-1][0] -= 12.0
    return chain


def godot_rows():
    def chain():
        return godot.chains()["chain_30"]

    def carried(frame):
        """The scene's own event: a loop in the middle, from 30 on straight to (300, 400) in 60 frames."""
        share = min((frame - 30) / 60, 1)
        start = (100.0, 12 + 26.0 * 20)
        return [start[i] + ((300, 400)[i] - start[i]) * share for i in (0, 1)] if 30 < frame <= 150 else None

    def drag(**how):
        held = chain().number("chain_30/particle_20")
        return lambda world, frame: world.frame(held if carried(frame) else None, carried(frame), **how)

    def passing(frame):
        return (100 + 30 * math.sin(0.06 * frame), 12.0 + 26 * 12 + 0.3 * frame)

    def hover(world, frame):
        world.frame(still=world.over(passing(frame)))

    yield Row("chains, hanging", "chains", played(chain(), 30))
    yield Row("chains, dragged in the middle", "chains", played(chain(), 200, drag()))
    yield Row("chains, dragged, first version", "chains", played(chain(), 200, drag(first_version=True)),
              ["solver.rules.displaced_hold=true"])
    yield Row("chains, under a mouse", "chains", played(swinging(chain()), 200, hover),
              ["solver.rules.hover_freezes=true", "events=[]"] + SWING, passing)


ROWS = (roblox_rows, opengl_rows, gamemaker_rows, flash_rows, godot_rows)


def all_rows():
    for rows in ROWS:
        yield from rows()


def difference(ours, theirs):
    """The largest, and the frame of the first that is too large."""
    assert len(ours) == len(theirs), f"{len(ours)} frames for {len(theirs)}"
    worst, first = 0.0, None
    for frame, (a, b) in enumerate(zip(ours, theirs)):
        now = max(math.dist(a[name], b[name]) for name in b)
        worst = max(worst, now)
        if not now <= ALLOWED and first is None:
            first = frame
    return worst, first


def compare():
    failed = False
    for row in all_rows():
        worst, first = difference(row.trace(), row.history)
        verdict = "" if first is None else f"  FAILED, from frame {first} on"
        print(f"{row.name:34} {len(row.history) - 1:4} frames  {worst:.1e} px{verdict}", flush=True)
        failed = failed or first is not None
    return failed


# --- the first frames, for tests without this script -------------------------------------------------------------------

FRAMES_FILE = os.path.join(HERE, "frames.csv")
FIRST = 5
GOLDEN = ("box", "box, the loop as printed", "box, a reader's repair", "ragdoll", "ragdoll, the loop as printed", "stick_figure",
          "bezier_humanoid, unshaken", "stick", "fixed_stick", "triangle", "chains, hanging")


def first_frames():
    """scene, overrides, frame, name, x, y; the mouse is a name like those of points."""
    golden = [row for row in all_rows() if row.name in GOLDEN]
    for row in golden:
        for frame, places in enumerate(row.history[:FIRST + 1]):
            mouse = {"mouse": row.mouse[frame - 1][1]} if row.mouse and frame > 0 else {}
            for name, (x, y) in {**mouse, **places}.items():
                yield [row.scene, " ".join(row.overrides), str(frame), name, f"{x:.9f}", f"{y:.9f}"]


def write_frames():
    with open(FRAMES_FILE, "w", newline="", encoding="utf-8") as file:
        csv.writer(file, lineterminator="\n").writerows(first_frames())


def frames_differ():
    """Whether the file is another than these scripts would write, but for the last digit."""
    with open(FRAMES_FILE, newline="", encoding="utf-8") as file:
        kept = list(csv.reader(file))
    fresh = list(first_frames())
    same = len(kept) == len(fresh) and all(
        a[:4] == b[:4] and math.dist([float(x) for x in a[4:]], [float(x) for x in b[4:]]) < 3e-9
        for a, b in zip(kept, fresh))
    if not same:
        print("tests/originals/frames.csv is not what the scripts say: tests/originals/compare.py --frames", file=sys.stderr)
    return not same


def main(words):
    if words == ["--frames"]:
        return write_frames()
    return frames_differ() if words == ["--check"] else compare()


if __name__ == "__main__":
    sys.exit(int(bool(main(sys.argv[1:]))))
