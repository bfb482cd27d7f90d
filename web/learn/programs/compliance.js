let compliance = 0.05;           // {compliance}
const gravity = 980, substeps = 8;
const top = {x: 220, y: 20, mobility: 0}, nail = {x: 420, y: 20, mobility: 0};
const soft = {x: 220, y: 140, oldX: 220, oldY: 140, mobility: 1 / 2};  // {kilograms}
const hard = {x: 420, y: 140, oldX: 420, oldY: 140, mobility: 1 / 2};

function step(dt) {
    for (let i = 0; i < substeps; ++i) {
        const h = dt / substeps;
        for (const point of [soft, hard]) fall(point, h);
        const hand = held([soft, hard]);
        if (hand) [hand.x, hand.y] = [pointer.x, pointer.y];
        spring(top, soft, 120, compliance / (h * h));
        spring(nail, hard, 120, 0);
    }
}

function spring(a, b, length, softness) {
    const x = b.x - a.x, y = b.y - a.y, now = Math.hypot(x, y);
    const part = (now - length) / now / (a.mobility + b.mobility + softness);  // {one}
    a.x += x * part * a.mobility;  a.y += y * part * a.mobility;
    b.x -= x * part * b.mobility;  b.y -= y * part * b.mobility;
}

function fall(point, h) {
    const kept = Math.exp(-0.7 * h);         // {air}
    const speedX = kept * (point.x - point.oldX), speedY = kept * (point.y - point.oldY);
    [point.oldX, point.oldY] = [point.x, point.y];
    point.x += speedX;
    point.y += speedY + gravity * h * h;
}

function draw() {
    line(top, soft, 6, "#1f8a8a");
    line(nail, hard, 6, "#8b8474");
    disc(soft, 24, "#e4572e");
    disc(hard, 24, "#5b6478");
    line({x: 120, y: 140 + 1960 * compliance}, {x: 320, y: 140 + 1960 * compliance}, 1.5, "#e9a820");  // {promised}
    show("hangs", soft.y - 140);
    show("promised", 2 * gravity * compliance);
}
