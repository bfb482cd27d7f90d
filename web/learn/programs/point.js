let gravity = 700;               // {gravity}
const ball = {x: 70, y: 330, oldX: 66, oldY: 339};

function step(dt) {
    const speedX = ball.x - ball.oldX;       // {speed}
    const speedY = ball.y - ball.oldY;
    ball.oldX = ball.x;                      // {before}
    ball.oldY = ball.y;
    ball.x += speedX;                        // {on}
    ball.y += speedY + gravity * dt * dt;
    bounce("x", "oldX", 16, 624);
    bounce("y", "oldY", 16, 384);
    if (held([ball])) {                      // {hand}
        ball.x = pointer.x;
        ball.y = pointer.y;
    }
}

function bounce(now, old, low, high) {
    const inside = Math.min(Math.max(ball[now], low), high);
    if (inside === ball[now]) return;
    ball[old] = inside + 0.85 * (ball[now] - ball[old]);  // {mirror}
    ball[now] = inside;                      // {back}
}

function draw() {
    trail(ball, "#e4572e");
    disc(ball, 15, "#e4572e");
    arrow(ball, 8 * (ball.x - ball.oldX), 8 * (ball.y - ball.oldY));
    show("speed", 60 * Math.hypot(ball.x - ball.oldX, ball.y - ball.oldY));
    show("height", 384 - ball.y);
}
