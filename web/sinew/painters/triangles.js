// Triangulation of simple polygons, points as x, y, x, y...

function turn(points, a, b, c) {
    const [ax, ay, bx, by] = [points[2 * a], points[2 * a + 1], points[2 * b], points[2 * b + 1]];
    return (bx - ax) * (points[2 * c + 1] - by) - (by - ay) * (points[2 * c] - bx);
}

/** Positive if the outline turns from x towards y. */
export function signedArea(points) {
    const [x, y] = points;
    let twice = 0;
    for (let i = 2; i + 3 < points.length; i += 2)
        twice += (points[i] - x) * (points[i + 3] - y) - (points[i + 1] - y) * (points[i + 2] - x);
    return twice / 2;
}

function isConvex(points) {
    const count = points.length / 2;
    let left = false, right = false, reversals = 0; // of x; more than two in a star
    for (let i = 0; i < count; ++i) {
        const [b, c] = [(i + 1) % count, (i + 2) % count];
        const corner = turn(points, i, b, c);
        left ||= corner > 0;
        right ||= corner < 0;
        if (points[2 * b] - points[2 * i] > 0 !== points[2 * c] - points[2 * b] > 0) ++reversals;
    }
    return !(left && right) && reversals <= 2;
}

/** Cuts off ears; calls triangle(a, b, c) with indices of corners. A crossed outline is filled approximately. */
export function triangulate(points, triangle) {
    const count = points.length / 2;
    if (count === 3 || isConvex(points)) {
        for (let i = 1; i + 1 < count; ++i) triangle(0, i, i + 1);
        return;
    }
    const side = signedArea(points) < 0 ? -1 : 1;
    const rest = Array.from({ length: count }, (_, i) => i);
    for (let at = 0, failed = 0; rest.length > 3; ) {
        at %= rest.length;
        if (failed === rest.length || isEar(points, rest, at, side)) { // without an ear, any corner is cut off
            triangle(rest.at(at - 1), rest[at], rest[(at + 1) % rest.length]);
            rest.splice(at, 1);
            failed = 0;
        } else {
            ++at, ++failed;
        }
    }
    triangle(rest[0], rest[1], rest[2]);
}

function isEar(points, rest, at, side) {
    const [a, b, c] = [rest.at(at - 1), rest[at], rest[(at + 1) % rest.length]];
    if (turn(points, a, b, c) * side <= 0) return false;
    return rest.every((p) => {
        const isCorner = p === a || p === b || p === c;
        return isCorner || !(inside(points, a, b, p, side) && inside(points, b, c, p, side) && inside(points, c, a, p, side));
    });
}

function inside(points, a, b, p, side) {
    const [ax, ay] = [points[2 * a], points[2 * a + 1]];
    const cross = (points[2 * b] - ax) * (points[2 * p + 1] - ay) - (points[2 * b + 1] - ay) * (points[2 * p] - ax);
    return cross * side >= 0;
}
