"""Rules of the GameMaker demo: pixels, frames, y down, a room of 1024 by 768.

Each frame the author sets five roots on a body that bobs (x only: x_prev stays); replaces the acceleration of the hand
by 0.05 of its way to the mouse less 0.1 of its speed, and that of the head by (0.005, 0.08) of its way to the place
above the root less 0.05 of its speed. Then every point, the roots too, is integrated, x += x - x_prev + a; from then on
its acceleration is gravity (0, 0.5), so that the first frame has none. Then three passes over the links: each end takes
0.3 of the error. Nothing is damped. (Every 64 frames hands and feet get random accelerations: left out.)
"""
import math

MIDDLE = (512.0, 384.0)
ROOTS = {"root": (0, 0), "right_shoulder": (24, 3), "left_shoulder": (-24, 3), "right_hip": (21, 46), "left_hip": (-21, 46)}
FREE = {
    "right_elbow": (64, 3), "right_hand": (104, 3), "left_elbow": (-88, 3), "left_hand": (-152, 3),
    "right_knee": (21, 110), "right_foot": (21, 174), "left_knee": (-21, 110), "left_foot": (-21, 174), "head": (0, -24),
}
LINKS = """right_shoulder right_elbow, right_elbow right_hand, left_shoulder left_elbow, left_elbow left_hand,
right_hip right_knee, right_knee right_foot, left_hip left_knee, left_knee left_foot,
head root, head left_shoulder, head right_shoulder"""


class Humanoid:
    def __init__(self):
        places = {**ROOTS, **FREE}
        self.x = {name: [MIDDLE[0] + dx, MIDDLE[1] + dy] for name, (dx, dy) in places.items()}
        self.before = {name: list(place) for name, place in self.x.items()}
        self.acceleration = {name: [0.0, 0.0] for name in places}
        self.links = [(a, b, math.dist(self.x[a], self.x[b])) for a, b in (link.split() for link in LINKS.split(","))]
        self.time = 0

    def steer(self, name, goal, gain, damping):
        for i in (0, 1):
            speed = self.x[name][i] - self.before[name][i]
            self.acceleration[name][i] = gain[i] * (goal[i] - self.x[name][i]) - damping * speed

    def frame(self, mouse):
        self.time += 1
        body = (MIDDLE[0] + math.sin(math.radians(3 * self.time)) * 42, MIDDLE[1] + math.sin(math.radians(6 * self.time)) * 24)
        for name, (dx, dy) in ROOTS.items():
            self.x[name] = [body[0] + dx, body[1] + dy]
        self.steer("right_hand", mouse, (0.05, 0.05), 0.1)
        self.steer("head", (body[0], body[1] - 24), (0.005, 0.08), 0.05)
        for name, x in self.x.items():
            before = self.before[name]
            self.x[name] = [2 * x[i] - before[i] + self.acceleration[name][i] for i in (0, 1)]
            self.before[name] = x
            self.acceleration[name] = [0.0, 0.5]
        for _ in range(3):
            for first, second, length in self.links:
                self.pull(self.x[first], self.x[second], length)

    @staticmethod
    def pull(a, b, length):
        now = math.dist(a, b)
        if now > 0:
            for i in (0, 1):
                way = (a[i] - b[i]) * (length - now) / now * 0.3
                a[i], b[i] = a[i] + way, b[i] - way

    def places(self):
        return {"man/" + name: tuple(place) for name, place in self.x.items()}
