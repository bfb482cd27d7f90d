const stiffness = 12;            // {passes}
const points = {head: [0, -112], leftShoulder: [-24, -76], rightShoulder: [24, -76], leftElbow: [-62, -66], rightElbow: [62, -66],
    leftHand: [-98, -78], rightHand: [98, -78], leftHip: [-15, 0], rightHip: [15, 0],
    leftKnee: [-20, 52], rightKnee: [20, 52], leftFoot: [-24, 104], rightFoot: [24, 104]};
for (const [name, [x, y]] of Object.entries(points))
    points[name] = {x: 320 + x, y: 190 + y, oldX: 318 + x + y / 30, oldY: 194 + y};       // {turning}

const bones = ["leftShoulder rightShoulder", "leftHip rightHip", "leftShoulder leftHip", "rightShoulder rightHip",
    "leftShoulder leftElbow", "leftElbow leftHand", "rightShoulder rightElbow", "rightElbow rightHand",
    "leftHip leftKnee", "leftKnee leftFoot", "rightHip rightKnee", "rightKnee rightFoot"];
const hidden = ["leftShoulder rightHip", "rightShoulder leftHip", "head leftShoulder", "head rightShoulder", "head leftHip", "head rightHip"]; // {hidden}
const limits = [["leftKnee", "rightKnee", 22], ["leftHand", "leftShoulder", 34], ["rightHand", "rightShoulder", 34],
    ["leftFoot", "leftHip", 62], ["rightFoot", "rightHip", 62], ["leftKnee", "leftShoulder", 74], ["rightKnee", "rightShoulder", 74]];

const rules = [...bones, ...hidden].map((pair) => pair.split(" ").map((name) => points[name])).map(([a, b]) => ({a, b, low: far(a, b), high: far(a, b)}))
    .concat(limits.map(([a, b, low]) => ({a: points[a], b: points[b], low, high: Infinity})));  // {atLeast}

function far(a, b) { return Math.hypot(b.x - a.x, b.y - a.y); }

function step(dt) {
    const all = Object.values(points);
    for (const p of all) {                   // {one}
        const speedX = 0.999 * (p.x - p.oldX), speedY = 0.999 * (p.y - p.oldY);
        [p.oldX, p.oldY] = [p.x, p.y];
        p.x += speedX;
        p.y += speedY + 900 * dt * dt;
    }
    const hand = held(all);                  // {two}
    if (hand) [hand.x, hand.y] = [pointer.x, pointer.y];
    for (let pass = 0; pass < stiffness; ++pass) {
        for (const rule of rules) mend(rule);  // {seven}
        for (const p of all) walls(p, 0.3);
    }
}

function mend({a, b, low, high}) {
    const now = far(a, b), wanted = Math.min(Math.max(now, low), high);
    if (now === wanted || now === 0) return;
    const share = (now - wanted) / now / 2, x = b.x - a.x, y = b.y - a.y;
    a.x += x * share;  a.y += y * share;
    b.x -= x * share;  b.y -= y * share;
}

function draw() {
    for (const bone of bones) {
        const [a, b] = bone.split(" ");
        line(points[a], points[b], 13, /Knee|Foot/.test(b) || /Hip/.test(a) ? "#3f6fb5" : "#e4572e");
    }
    for (const name of ["leftHand", "rightHand", "leftFoot", "rightFoot"]) disc(points[name], 9, "#f2b58c");
    disc(points.head, 24, "#f2b58c");
    show("points", Object.keys(points).length);
    show("stretch", Math.max(...rules.slice(0, bones.length).map(({a, b, low}) => far(a, b) / low - 1)));
}
