"""Rules of the Roblox article (box, ragdoll, cloth), from its text: pixels, frames, y down.

A point: v = (x - x_prev + force) * 0.99, with gravity (0, 0.1) among the forces; x_prev = x; x += v.
A segment: each end that is not stiff takes half of the error along the segment.
The canvas: a point beyond an edge is put on it, and x_prev is set so that 0.8 of its speed points inward.
Loops: the article's first version runs points once and segments six times, the printed one points six times and
segments once, a reader's repair both six times. Walls come once a frame, last.
"""
import math

GRAVITY, FRICTION, BOUNCE = 0.1, 0.99, 0.8


class Point:
    def __init__(self, x, y, stiff=False, kick=(0.0, 0.0)):
        self.x, self.y = float(x), float(y)
        self.old_x, self.old_y = self.x - kick[0], self.y - kick[1]
        self.force = [0.0, 0.0]
        self.stiff = stiff

    def simulate(self):
        if self.stiff:
            return
        self.force[1] += GRAVITY
        vx = (self.x - self.old_x + self.force[0]) * FRICTION
        vy = (self.y - self.old_y + self.force[1]) * FRICTION
        self.old_x, self.old_y = self.x, self.y
        self.x += vx
        self.y += vy
        self.force = [0.0, 0.0]

    def keep_in(self, width, height, outward=False):
        """`outward`: the signs of the article, wrong at the top and on the right."""
        vx, vy = self.x - self.old_x, self.y - self.old_y
        wrong = -1.0 if outward else 1.0
        if self.y > height:
            self.y = float(height)
            self.old_y = self.y + vy * BOUNCE
        elif self.y < 0:
            self.y = 0.0
            self.old_y = self.y + wrong * vy * BOUNCE
        if self.x < 0:
            self.x = 0.0
            self.old_x = self.x + vx * BOUNCE
        elif self.x > width:
            self.x = float(width)
            self.old_x = self.x + wrong * vx * BOUNCE


class Segment:
    def __init__(self, a, b):
        self.a, self.b = a, b
        self.length = math.hypot(b.x - a.x, b.y - a.y)

    def simulate(self):
        a, b = self.a, self.b
        dx, dy = b.x - a.x, b.y - a.y
        now = math.hypot(dx, dy)
        share = (self.length - now) / now / 2
        if not a.stiff:
            a.x -= dx * share
            a.y -= dy * share
        if not b.stiff:
            b.x += dx * share
            b.y += dy * share


class World:
    def __init__(self, points, segments, size=None, loop="segments", outward=False):
        self.points = points  # by name
        self.segments = [Segment(points[a], points[b]) for a, b in segments]
        self.size, self.loop, self.outward = size, loop, outward

    def frame(self):
        if self.loop == "both":
            for _ in range(6):
                self.move()
                self.sweep()
        else:
            for _ in range(6 if self.loop == "points" else 1):
                self.move()
            for _ in range(6 if self.loop == "segments" else 1):
                self.sweep()
        if self.size:
            for point in self.points.values():
                point.keep_in(*self.size, outward=self.outward)

    def move(self):
        for point in self.points.values():
            point.simulate()

    def sweep(self):
        for segment in self.segments:
            segment.simulate()

    def places(self):
        return {name: (point.x, point.y) for name, point in self.points.items()}


CANVAS = (640, 480)


def box(**how):
    points = {
        "box/top_left": Point(300, 300), "box/top_right": Point(350, 300),
        "box/bottom_left": Point(300, 350), "box/bottom_right": Point(350, 350),
    }
    edges = [("top_left", "bottom_left"), ("top_left", "top_right"), ("top_right", "bottom_right"),
             ("bottom_left", "bottom_right"), ("top_left", "bottom_right")]
    return World(points, [("box/" + a, "box/" + b) for a, b in edges], CANVAS, **how)


def thrown(world, vx, vy):
    for point in world.points.values():
        point.old_x -= vx
        point.old_y -= vy
    return world


# The rig of the place file: fifteen points and twenty-one segments, about the middle between the shoulders.
JOINTS = {
    "left_shoulder": (-10, 0), "right_shoulder": (10, 0), "left_hip": (-10, 40), "right_hip": (10, 40), "center": (0, 0),
    "head_left": (-10, -30), "head_right": (10, -30), "left_elbow": (-45, 5), "right_elbow": (45, 5),
    "left_hand": (-70, 20), "right_hand": (70, 20), "left_knee": (-25, 80), "right_knee": (25, 80),
    "left_foot": (-20, 130), "right_foot": (20, 130),
}
BONES = """left_shoulder right_shoulder, left_hip right_hip, left_shoulder left_hip, right_shoulder right_hip,
head_left head_right, left_shoulder head_left, right_shoulder head_right, left_shoulder left_elbow, left_elbow left_hand,
right_shoulder right_elbow, right_elbow right_hand, left_hip left_knee, left_knee left_foot, right_hip right_knee,
right_knee right_foot, left_shoulder right_hip, right_shoulder left_hip, right_shoulder head_left,
left_shoulder head_right, left_hip left_foot, right_hip right_foot"""


def ragdoll(**how):
    points = {"bob/" + name: Point(320 + x, 200 + y) for name, (x, y) in JOINTS.items()}
    points["bob/left_shoulder"].old_y += 20  # the kick: 20 px a frame upwards
    bones = [("bob/" + a, "bob/" + b) for a, b in (bone.split() for bone in BONES.split(","))]
    return World(points, bones, CANVAS, **how)


class Cloth(World):
    """Ten by seven points 50 px apart, the top row stiff; each frame one point is pushed by a whole number."""

    def __init__(self, random_push, **how):
        self.grid = [(column, row) for row in range(7) for column in range(10)]
        points = {self.name(*at): Point(280 + 50 * (at[0] - 4.5), 50 + 50 * at[1], stiff=at[1] == 0) for at in self.grid}
        across = [(self.name(c, r), self.name(c + 1, r)) for c, r in self.grid if c < 9]
        down = [(self.name(c, r), self.name(c, r + 1)) for c, r in self.grid if r < 6]
        segments = across + down
        super().__init__(points, segments, **how)
        self.random_push, self.frames = random_push, 0

    @staticmethod
    def name(column, row):
        corners = {(0, 0): "top_left", (9, 0): "top_right", (0, 6): "bottom_left", (9, 6): "bottom_right"}
        return "cloth/" + corners.get((column, row), f"particle_{column}_{row}")

    def frame(self):
        number, push = self.random_push(self.frames, len(self.grid))
        self.points[self.name(*self.grid[number])].force[0] += push
        self.frames += 1
        super().frame()
