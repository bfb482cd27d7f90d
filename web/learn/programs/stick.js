const length = 130;              // {length}
const a = {x: 170, y: 200, oldX: 166, oldY: 210};
const b = {x: 170, y: 200 + length, oldX: 171, oldY: 206 + length};
let push = {x: 0, y: 0};

function step(dt) {
    for (const point of [a, b]) fall(point, dt);
    const hand = held([a, b]);
    if (hand) [hand.x, hand.y] = [pointer.x, pointer.y];
    mend();
    walls(a);
    walls(b);
}

function fall(point, dt) {                   // {fall}
    const speedX = point.x - point.oldX, speedY = point.y - point.oldY;
    [point.oldX, point.oldY] = [point.x, point.y];
    point.x += speedX;
    point.y += speedY + 700 * dt * dt;
}

function mend() {
    const x = b.x - a.x, y = b.y - a.y;      // {between}
    const now = Math.hypot(x, y);
    const error = now - length;
    push = {x: x * error / now / 2, y: y * error / now / 2};
    a.x += push.x;  a.y += push.y;           // {half}
    b.x -= push.x;  b.y -= push.y;           // {other}
    show("error", error);
}

function draw() {
    line(a, b, 11, "#3f6fb5");
    disc(a, 12, "#e4572e");
    disc(b, 12, "#e9a820");
    arrow(a, 200 * push.x, 200 * push.y, "#e4572e");   // {enlarged}
    arrow(b, -200 * push.x, -200 * push.y, "#e9a820");
    show("stretch", Math.hypot(b.x - a.x, b.y - a.y) / length - 1);
}
