// The same with Jolt's long range attachments: every point to the nearest pinned one, as far as it is along the sticks.
import makeJolt from "jolt-physics/wasm-compat";
import { softBody } from "./jolt.mjs";

export const name = "jolt-physics with attachments";

export async function build(work) {
    const Jolt = await makeJolt(), ways = waysToPins(work);
    return softBody(Jolt, work, (shared) => {
        ways.forEach(({ pin, length }, i) => {
            if (pin >= 0 && pin !== i) shared.mLRAConstraints.push_back(new Jolt.SoftBodySharedSettingsLRA(pin, i, length));
        });
    });
}

/** The nearest pinned point of every point, along sticks (Bellman and Ford). */
function waysToPins({ points, sticks }) {
    const neighbours = points.map(() => []);
    for (const { a, b, length } of sticks) neighbours[a].push([b, length]), neighbours[b].push([a, length]);
    const ways = points.map(({ isPinned }, i) => (isPinned ? { pin: i, length: 0 } : { pin: -1, length: Infinity }));
    let front = points.flatMap(({ isPinned }, i) => (isPinned ? [i] : []));
    while (front.length > 0) {
        const next = new Set();
        for (const i of front)
            for (const [j, length] of neighbours[i])
                if (ways[i].length + length < ways[j].length) ways[j] = { pin: ways[i].pin, length: ways[i].length + length }, next.add(j);
        front = [...next];
    }
    return ways;
}
