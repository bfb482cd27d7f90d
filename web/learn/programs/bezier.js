const forearm = 150;             // {forearm}
const shoulder = {x: 250, y: 70};
const elbow = {x: 390, y: 120, oldX: 390, oldY: 120};
const hand = {x: 390 + 0.6 * forearm, y: 120 + 0.8 * forearm};
[hand.oldX, hand.oldY] = [hand.x, hand.y];

function curve(t) {                          // {curve}
    const upper = mix(shoulder, elbow, t);   // {upper}
    const lower = mix(elbow, hand, t);       // {lower}
    return mix(upper, lower, t);             // {between}
}

function mix(a, b, t) {
    return {x: a.x + (b.x - a.x) * t, y: a.y + (b.y - a.y) * t};
}

function draw() {
    const sleeve = [];
    for (let i = 0; i <= 16; ++i) sleeve.push(curve(i / 16));
    path(sleeve, 44, "#3f6fb5");
    path([shoulder, elbow, hand], 2);
    const t = 0.5 - 0.5 * Math.cos(time);    // {runs}
    const [upper, lower] = [mix(shoulder, elbow, t), mix(elbow, hand, t)];
    line(upper, lower, 2, "#e9a820");
    for (const point of [upper, lower, curve(t)]) disc(point, 6, "#e9a820");
    for (const [point, color] of [[shoulder, "#5b6478"], [elbow, "#e4572e"], [hand, "#f2b58c"]]) disc(point, 11, color);
    const middle = curve(0.5);
    show("gap", Math.hypot(middle.x - elbow.x, middle.y - elbow.y));
    show("t", t);
}

let time = 0;
function step(dt) {
    time += dt;
    for (const point of [elbow, hand]) {
        const speedX = 0.99 * (point.x - point.oldX), speedY = 0.99 * (point.y - point.oldY);
        [point.oldX, point.oldY] = [point.x, point.y];
        point.x += speedX;
        point.y += speedY + 700 * dt * dt;
    }
    const grip = held([elbow, hand]);
    if (grip) [grip.x, grip.y] = [pointer.x, pointer.y];
    for (let pass = 0; pass < 20; ++pass) {
        mend(shoulder, elbow, 149, 0);
        mend(elbow, hand, forearm, 0.5);
    }
}

function mend(a, b, length, share) {         // {share}
    const x = b.x - a.x, y = b.y - a.y, now = Math.hypot(x, y), part = (now - length) / now;
    a.x += x * part * share;        a.y += y * part * share;
    b.x -= x * part * (1 - share);  b.y -= y * part * (1 - share);
}
