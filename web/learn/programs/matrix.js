const shape = 0;                 // {shape}
const sticks = [
    () => line_(18),
    () => [...line_(17), [17, 0]],
    () => net(4),
][shape]();

function line_(n) {              // {row}
    return Array.from({length: n}, (_, i) => [i, i + 1]);
}

function net(n) {                // {net}
    const all = [];
    for (let y = 0; y < n; ++y) for (let x = 0; x < n; ++x) {
        if (x + 1 < n) all.push([y * n + x, y * n + x + 1]);
        if (y + 1 < n) all.push([y * n + x, y * n + n + x]);
    }
    return all;
}

const touches = (i, j) => sticks[i].some((point) => sticks[j].includes(point));   // {touches}
const table = sticks.map((_, i) => sticks.map((_, j) => (touches(i, j) ? "full" : "")));
let done = 0, filled = 0, work = 0, time = 0;

function step(dt) {
    time += dt;
    if (time < 0.3 || done === sticks.length) return;
    time = 0.18;
    eliminate(done++);
}

function eliminate(k) {                      // {eliminate}
    const others = sticks.map((_, i) => i).filter((i) => i > k && table[k][i]);
    for (const i of others) for (const j of others) {
        ++work;
        if (table[i][j]) continue;
        table[i][j] = "filled";              // {fill}
        ++filled;
    }
}

function draw() {
    const size = Math.min(340 / sticks.length, 20), left = 320 - size * sticks.length / 2;
    table.forEach((row, i) => row.forEach((entry, j) => {
        const color = !entry ? "#8b847430" : i < done || j < done ? "#8b8474" : entry === "filled" ? "#e4572e" : "#3f6fb5";
        square({x: left + size * (j + 0.5), y: 24 + size * (i + 0.5)}, size - 1.5, color);
    }));
    show("filled", filled / 2 + table.filter((row, i) => row[i] === "filled").length / 2);
    show("work", work);
}
