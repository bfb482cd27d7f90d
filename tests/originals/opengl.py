"""Rules of the OpenGL article, from its text: x_next = 2 x - x_prev + a dt^2; then the bounding box, which clamps; then
the distances, without a square root: d = b - a, s = r.r / (d.d + r.r) - 1/2, a -= s d, b += s d, with r as it was at
the start. A dragged point is where the mouse is: one more constraint.
"""
LOW, HIGH = 50.0, 450.0


class World:
    def __init__(self, points, previous, sticks, acceleration):
        """`points` and `previous` by name; `acceleration` times the square of the time step."""
        self.now = {name: list(place) for name, place in points.items()}
        self.before = {name: list(place) for name, place in previous.items()}
        self.sticks = [(a, b, self.square(points[a], points[b])) for a, b in sticks]
        self.acceleration = acceleration

    @staticmethod
    def square(a, b):
        return (b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2

    def frame(self):
        for name, now in self.now.items():
            before = self.before[name]
            moved = [2 * now[i] - before[i] + self.acceleration[i] for i in (0, 1)]
            self.before[name], self.now[name] = now, moved
        for now in self.now.values():
            for i in (0, 1):
                now[i] = min(max(now[i], LOW), HIGH)
        for first, second, rest in self.sticks:
            a, b = self.now[first], self.now[second]
            share = rest / (self.square(a, b) + rest) - 0.5
            for i, d in ((0, b[0] - a[0]), (1, b[1] - a[1])):
                a[i] -= share * d
                b[i] += share * d

    def places(self):
        return {name: tuple(place) for name, place in self.now.items()}


# The article leaves the dimensions to the reader: these are the scene's, in pixels of a man of 160.
JOINTS = {
    "head": (0, -18), "neck": (0, 0), "hips": (0, 45), "left_elbow": (-25, 18), "left_hand": (-42, 42),
    "right_elbow": (25, 18), "right_hand": (42, 42), "left_knee": (-14, 87), "left_foot": (-20, 130),
    "right_knee": (14, 87), "right_foot": (20, 130),
}
STICKS = """neck head, neck hips, neck left_elbow, left_elbow left_hand, neck right_elbow, right_elbow right_hand,
hips left_knee, left_knee left_foot, hips right_knee, right_knee right_foot,
hips head, hips left_elbow, hips right_elbow, neck left_knee, neck right_knee"""


def stick_figure(at, height, gravity, kicks):
    """y is up; `gravity` in pixels a second squared, `kicks` in pixels a second, 60 frames a second."""
    scale = height / 160
    points = {"man/" + name: (at[0] + scale * x, at[1] - scale * y) for name, (x, y) in JOINTS.items()}
    previous = dict(points)
    for name, (vx, vy) in kicks.items():
        x, y = points["man/" + name]
        previous["man/" + name] = (x - vx / 60, y - vy / 60)
    sticks = [("man/" + a, "man/" + b) for a, b in (stick.split() for stick in STICKS.split(","))]
    return World(points, previous, sticks, (0.0, gravity / 3600))
