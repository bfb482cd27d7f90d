// The loop of the tutorials (Jakobsen 2001), as a reader would write it: ten substeps, one pass each.
export const name = "plain JS Verlet loop";

export async function build({ points, sticks, gravity, dt, substeps }) {
    const all = points.map(({ x, y, mass, isPinned }) => ({ x, y, oldX: x, oldY: y, w: isPinned ? 0 : 1 / mass }));
    const h = dt / substeps;
    const move = () => {
        for (const p of all) {
            if (p.w === 0) continue;
            const [x, y] = [p.x, p.y];
            p.x += x - p.oldX;
            p.y += y - p.oldY + gravity * h * h;
            p.oldX = x;
            p.oldY = y;
        }
    };
    const satisfy = () => {
        for (const { a, b, length } of sticks) {
            const [p, q] = [all[a], all[b]];
            const w = p.w + q.w;
            if (w === 0) continue;
            const [dx, dy] = [q.x - p.x, q.y - p.y];
            const now = Math.sqrt(dx * dx + dy * dy);
            const share = (now - length) / (now * w);
            p.x += dx * share * p.w, p.y += dy * share * p.w;
            q.x -= dx * share * q.w, q.y -= dy * share * q.w;
        }
    };
    return {
        step() {
            for (let i = 0; i < substeps; ++i) move(), satisfy();
        },
        position: (i) => [all[i].x, all[i].y],
    };
}
