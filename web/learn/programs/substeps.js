const effort = 4;                // {effort}
const sticks = 24, length = 10, weight = 10;
const left = rope(170), right = rope(470);

function step(dt) {
    move(left, dt, effort);                  // {left}
    for (let i = 0; i < effort; ++i)
        move(right, dt / effort, 1);         // {right}
}

function move(points, dt, passes) {
    const kept = 0.995 ** (60 * dt);         // {air}
    for (const p of points.slice(1)) {
        const speedX = kept * (p.x - p.oldX), speedY = kept * (p.y - p.oldY);
        [p.oldX, p.oldY] = [p.x, p.y];
        p.x += speedX;
        p.y += speedY + 900 * dt * dt;
    }
    const hand = held([...left.slice(1), ...right.slice(1)]);
    if (hand) [hand.x, hand.y] = [pointer.x, pointer.y];
    for (let pass = 0; pass < passes; ++pass)
        for (let i = 0; i < sticks; ++i) mend(points[i], points[i + 1]);
}

function mend(a, b) {
    const x = b.x - a.x, y = b.y - a.y, now = Math.hypot(x, y);
    const part = (now - length) / now / (a.mobility + b.mobility);
    a.x += x * part * a.mobility;  a.y += y * part * a.mobility;
    b.x -= x * part * b.mobility;  b.y -= y * part * b.mobility;
}

function rope(x) {
    return Array.from({length: sticks + 1}, (_, i) => {
        const p = {x: x + 3 * i, y: 24 + 9.5 * i};
        return {...p, oldX: p.x, oldY: p.y, mobility: i === 0 ? 0 : i === sticks ? 1 / weight : 1};
    });
}

const worst = (points) => Math.max(...points.slice(1).map((p, i) =>
    Math.hypot(p.x - points[i].x, p.y - points[i].y) / length - 1));

function draw() {
    show("effort", effort);
    for (const [points, name, color, word] of [[left, "left", "#c77d0a", "{passes}"], [right, "right", "#1f8a8a", "{substeps}"]]) {
        path(points, 7, color);
        disc(points[0], 5, "#8b8474");
        disc(points[sticks], 20, "#5b6478");
        write(`${effort} ${word}`, {x: points[0].x, y: 388}, color);
        show(name, worst(points));
    }
}
