const first = 0.25;              // {first}
const length = 130;
const a = {x: 120, y: 200}, b = {x: 520, y: 200};

function step() {
    const hand = held([a, b]);
    if (hand) [hand.x, hand.y] = [pointer.x, pointer.y];
    mend(a, b, 0.04);                        // {slowly}
}

function mend(a, b, share) {
    const x = b.x - a.x, y = b.y - a.y;
    const now = Math.hypot(x, y);
    const part = (now - length) / now * share;
    a.x += x * part * first;                 // {itsShare}
    a.y += y * part * first;
    b.x -= x * part * (1 - first);           // {rest}
    b.y -= y * part * (1 - first);
}

function draw() {
    line(a, b, 9, "#3f6fb5");
    disc(a, 17, "#e4572e");
    disc(b, 17, "#e9a820");
    show("red", a.x - 120);
    show("yellow", 520 - b.x);
    show("length", Math.hypot(b.x - a.x, b.y - a.y));
}
