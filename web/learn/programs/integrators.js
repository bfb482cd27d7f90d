const rate = 20;                 // {rate}
const h = 1 / rate;
const rules = [explicitEuler, symplecticEuler, verlet, velocityVerlet, rungeKutta4];
const colors = ["#d1495b", "#c77d0a", "#2a9d6f", "#3f7fd0", "#9070c8"];
const planets = rules.map(() => ({x: 57, y: 0, vx: 0, vy: 125}));
const energies = rules.map(() => []);

function explicitEuler(p) {
    const [ax, ay] = pull(p.x, p.y);         // {old}
    p.x += h * p.vx;   p.y += h * p.vy;
    p.vx += h * ax;    p.vy += h * ay;
}

function symplecticEuler(p) {
    const [ax, ay] = pull(p.x, p.y);
    p.vx += h * ax;    p.vy += h * ay;       // {swapped}
    p.x += h * p.vx;   p.y += h * p.vy;
}

function verlet(p) {                         // {noSpeed}
    const [ax, ay] = pull(p.x, p.y);
    p.oldX ??= p.x - h * p.vx + h * h * ax / 2;
    p.oldY ??= p.y - h * p.vy + h * h * ay / 2;
    const [x, y] = [2 * p.x - p.oldX + h * h * ax, 2 * p.y - p.oldY + h * h * ay];
    p.vx = (x - p.oldX) / (2 * h);           // {energyOnly}
    p.vy = (y - p.oldY) / (2 * h);
    [p.oldX, p.oldY, p.x, p.y] = [p.x, p.y, x, y];
}

function velocityVerlet(p) {
    let [ax, ay] = pull(p.x, p.y);
    p.vx += h / 2 * ax;  p.vy += h / 2 * ay;
    p.x += h * p.vx;     p.y += h * p.vy;
    [ax, ay] = pull(p.x, p.y);
    p.vx += h / 2 * ax;  p.vy += h / 2 * ay;
}

function rungeKutta4(p) {                    // {four}
    const slope = ([x, y, vx, vy]) => [vx, vy, ...pull(x, y)];
    const go = (s, k, t) => s.map((value, i) => value + t * k[i]);
    const s = [p.x, p.y, p.vx, p.vy];
    const k1 = slope(s), k2 = slope(go(s, k1, h / 2)), k3 = slope(go(s, k2, h / 2)), k4 = slope(go(s, k3, h));
    [p.x, p.y, p.vx, p.vy] = s.map((value, i) => value + h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]));
}

function pull(x, y) {                        // {sun}
    const r = Math.hypot(x, y);
    return [-1100000 * x / r ** 3, -1100000 * y / r ** 3];
}

const energy = (p) => (p.vx ** 2 + p.vy ** 2) / 2 - 1100000 / Math.hypot(p.x, p.y);
const first = energy(planets[0]);

let due = 0;
function step(dt) {
    for (due += dt; due >= h; due -= h) planets.forEach((planet, i) => {
        const before = {...planet};
        rules[i](planet);
        energies[i].push(energy(rules[i] === verlet ? {...before, vx: planet.vx, vy: planet.vy} : planet));
        energies[i].splice(0, energies[i].length - 24 * rate);
    });
}

function draw() {
    planets.forEach((planet, i) => {
        const sun = {x: [107, 320, 533][i % 3], y: i < 3 ? 92 : 290};
        const place = planet.place ??= {};
        [place.x, place.y] = [sun.x + planet.x, sun.y + planet.y];
        disc(sun, 8, "#f2b134");
        trail(place, colors[i]);
        disc(place, 6, colors[i]);
        write(names[i], {x: sun.x, y: sun.y + 84});
        graph(energies[i], -26000, 4000, {x: 445, y: 226}, 180, 150, colors[i], i === 0 ? energyName : "");
        show(rules[i].name, ((energies[i].at(-1) ?? first) - first) / Math.abs(first));
    });
}
const names = ["{explicitEuler}", "{symplecticEuler}", "{verlet}", "{velocityVerlet}", "{rungeKutta4}"], energyName = "{energies}";
