"""Rules of the Flash tutorial, from its text: pixels, frames, y down. Points have no inertia. Each frame the first point
is set on the mouse; then each constraint moves both of its ends along the line between them, by their shares of the
error. The angle is -atan2(dx, dy), which is 0 where two points are one.
"""
import math

START = (240.0, 165.0)


class World:
    def __init__(self, names, constraints, distance=100.0):
        self.points = {name: list(START) for name in names}
        self.constraints, self.distance = constraints, distance

    def frame(self, mouse):
        self.points[next(iter(self.points))][:] = mouse
        for first, second, share in self.constraints:
            self.constrain(self.points[first], self.points[second], share)

    def constrain(self, a, b, share):
        dx, dy = a[0] - b[0], a[1] - b[1]
        error = math.sqrt(dx * dx + dy * dy) - self.distance
        angle = -math.atan2(dx, dy)
        for point, part in ((a, share * error), (b, (share - 1) * error)):
            point[0] += part * math.sin(angle)
            point[1] -= part * math.cos(angle)

    def places(self):
        return {name: tuple(place) for name, place in self.points.items()}


def stick():
    return World(["stick/first", "stick/second"], [("stick/first", "stick/second", 0.5)])


def fixed_stick():
    """The first point takes all of the error: the second is the fixed one."""
    return World(["stick/first", "stick/second"], [("stick/first", "stick/second", 1.0)])


def triangle():
    first, second, third = names = ["triangle/first", "triangle/second", "triangle/third"]
    return World(names, [(first, second, 0.5), (second, third, 0.5), (first, third, 0.5)])
