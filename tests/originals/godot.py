"""Rules of the Godot chain, from its text: pixels, frames, y down; loops 26 apart under an anchor.

A loop: v = (x - x_prev) * 0.98 * 0.90; x_prev = x; x += v; x.y += 0.6. The links once, from the top down: the child
takes all of the error. A loop that is pressed: x_prev = x; x = mouse. In the tutorial's first version it is then moved
like any other; in the second a loop under the mouse, pressed or not, is not moved, and is corrected all the same.
"""
import math

LENGTH, GRAVITY, KEEP = 26.0, 0.6, 0.98 * 0.90
HALF = 12.0  # of the square in which the mouse is over a loop


class Chain:
    def __init__(self, name, x, y, links):
        self.names = [f"{name}/{'start' if i == 0 else 'end' if i == links else f'particle_{i}'}" for i in range(links + 1)]
        self.x = [[float(x), y + LENGTH * i] for i in range(links + 1)]
        self.before = [list(place) for place in self.x]

    def number(self, name):
        return self.names.index(name)

    def over(self, mouse):
        """The loop under the mouse; the last that was added lies on top."""
        for i in range(len(self.x) - 1, 0, -1):
            if abs(self.x[i][0] - mouse[0]) <= HALF and abs(self.x[i][1] - mouse[1]) <= HALF:
                return i
        return None

    def frame(self, held=None, mouse=None, still=None, first_version=False):
        """`held` is set on the mouse; `still` is not moved."""
        if held is not None:
            self.before[held], self.x[held] = self.x[held], list(mouse)
        for i in range(1, len(self.x)):
            if i == still or (i == held and not first_version):
                continue
            x, before = self.x[i], self.before[i]
            self.before[i] = x
            self.x[i] = [x[0] + (x[0] - before[0]) * KEEP, x[1] + (x[1] - before[1]) * KEEP + GRAVITY]
        for parent, child in zip(self.x, self.x[1:]):
            d = [child[0] - parent[0], child[1] - parent[1]]
            now = math.hypot(*d)
            for k in (0, 1):
                child[k] += d[k] * (LENGTH - now) / now

    def places(self):
        return {name: tuple(place) for name, place in zip(self.names, self.x)}


def chains():
    return {f"chain_{n}": Chain(f"chain_{n}", x, 12, n) for n, x in ((30, 100), (20, 300), (15, 500), (10, 700), (5, 900))}
