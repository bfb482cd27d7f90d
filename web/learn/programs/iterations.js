const passes = 4;                // {passes}
const sticks = 24, length = 10, weight = 24;
const own = rope(passes);
const others = [1, 2, 4, 8, 16, 32, 64, 128].map(rope);  // {others}

function rope(passes) {
    const points = [];
    for (let i = 0; i <= sticks; ++i) {
        const x = 410 + 8.6 * i, y = 24 + 5 * i;
        points.push({x, y, oldX: x, oldY: y,
            mobility: i === 0 ? 0 : i === sticks ? 1 / weight : 1});  // {mobility}
    }
    return {points, passes};
}

function step(dt) {
    const hand = held(own.points.slice(1));
    for (const {points, passes} of [own, ...others]) {
        for (const point of points) if (point.mobility > 0) fall(point, dt);
        if (hand && points === own.points)
            [hand.x, hand.y] = [pointer.x, pointer.y];
        for (let pass = 0; pass < passes; ++pass)  // {again}
            for (let i = 0; i < sticks; ++i) mend(points[i], points[i + 1]);
    }
}

function fall(point, dt) {
    const speedX = 0.995 * (point.x - point.oldX), speedY = 0.995 * (point.y - point.oldY);
    [point.oldX, point.oldY] = [point.x, point.y];
    point.x += speedX;
    point.y += speedY + 900 * dt * dt;
}

function mend(a, b) {                        // {mend}
    const x = b.x - a.x, y = b.y - a.y, now = Math.hypot(x, y);
    const part = (now - length) / now / (a.mobility + b.mobility);
    a.x += x * part * a.mobility;  a.y += y * part * a.mobility;
    b.x -= x * part * b.mobility;  b.y -= y * part * b.mobility;
}

function worst({points}) {                   // {worst}
    let most = 0;
    for (let i = 0; i < sticks; ++i)
        most = Math.max(most, Math.hypot(points[i + 1].x - points[i].x, points[i + 1].y - points[i].y) / length - 1);
    return most;
}

const across = (passes) => 30 + 25 * Math.log2(passes);
const down = (error) => 75 - 40 * Math.log10(Math.min(Math.max(error, 0.001), 10));

function draw() {
    for (const {points} of others) path(points, 2, "#8b847470");
    path(own.points, 7, "#8a5a32");
    disc(own.points[0], 5, "#8b8474");
    disc(own.points[sticks], 22, "#5b6478");
    graph(others.map((one) => Math.log10(worst(one))), -3, 1, {x: 30, y: 35}, 175, 160, "#e4572e", "{graph}");
    for (const one of others) disc({x: across(one.passes), y: down(worst(one))}, 3.5, "#e4572e");
    disc({x: across(passes), y: down(worst(own))}, 8, "#8a5a32");  // {yours}
    [100, 10, 1].forEach((percent) => write(`${percent} %`, {x: 236, y: down(percent / 100)}));
    [1, 8, 64].forEach((passes) => write(passes, {x: across(passes), y: 212}));
    show("stretch", worst(own));
    show("passes", passes);
}
