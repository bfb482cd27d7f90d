const passes = 4;                // {passes}
const sticks = 24, length = 10, weight = 24;
const rope = [];
for (let i = 0; i <= sticks; ++i) {
    const x = 320 + 8.6 * i, y = 24 + 5 * i;
    rope.push({x, y, oldX: x, oldY: y, mobility: i === 0 ? 0 : i === sticks ? 1 / weight : 1});  // {mobility}
}
let errors = [];

function step(dt) {
    for (const point of rope) if (point.mobility > 0) fall(point, dt);
    const hand = held(rope.slice(1));
    if (hand) [hand.x, hand.y] = [pointer.x, pointer.y];
    errors = [worst()];
    for (let pass = 0; pass < passes; ++pass) {
        for (let i = 0; i < sticks; ++i) mend(rope[i], rope[i + 1]);   // {again}
        errors.push(worst());
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

function worst() {                           // {worst}
    let most = 0;
    for (let i = 0; i < sticks; ++i)
        most = Math.max(most, Math.hypot(rope[i + 1].x - rope[i].x, rope[i + 1].y - rope[i].y) / length - 1);
    return most;
}

function draw() {
    path(rope, 7, "#8a5a32");
    disc(rope[0], 5, "#8b8474");
    disc(rope[sticks], 22, "#5b6478");
    const logarithms = errors.map((error) => Math.log10(Math.max(error, 1e-4)));
    graph(logarithms, -4, 1, {x: 20, y: 30}, 190, 120, "#e4572e", "{graph}");
    [100, 10, 1, 0.1].forEach((percent, i) => write(`${percent} %`, {x: 240, y: 54 + 24 * i}));
    show("stretch", errors.at(-1));
    show("passes", passes);
}
