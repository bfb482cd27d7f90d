// The words that a lesson's program may use, and the loop that calls its step and draw: text that goes before the program, in a
// worker or in a test. The picture is 640 wide and 400 high, y down.
(() => {
    const trails = new Map(), longestTrail = 96, reachOfHand = 70;
    let commands = [], live = {}, reading = "", held = null, wasDown = false;
    const at = (point) => [Number(point.x), Number(point.y)];
    const words = {
        pointer: { x: 320, y: 200, isDown: false },
        /** A disc at a point. */
        disc: (point, radius, color = "") => void commands.push(["disc", ...at(point), radius, color]),
        /** A line from a point to another. */
        line: (a, b, width = 3, color = "") => void commands.push(["path", [...at(a), ...at(b)], width, color]),
        /** A line through a list of points. */
        path: (points, width = 3, color = "") => void commands.push(["path", points.flatMap(at), width, color]),
        /** An arrow that begins at a point and goes dx to the right and dy down. */
        arrow: (point, dx, dy, color = "") => void commands.push(["arrow", ...at(point), dx, dy, color]),
        /** A square of a table. */
        square: (point, size, color = "") => void commands.push(["square", ...at(point), size, color]),
        /** A text, its middle at a point. */
        write: (text, point, color = "") => void commands.push(["text", String(text), ...at(point), color]),
        /** Where a point has been lately. */
        trail(point, color = "") {
            const places = trails.get(point) ?? trails.set(point, []).get(point);
            places.push(...at(point));
            if (places.length > 2 * longestTrail) places.splice(0, places.length - 2 * longestTrail);
            commands.push(["trail", [...places], 3, color]);
        },
        /** A curve of numbers between low and high, in a frame of a width and height at a point. */
        graph(numbers, low, high, point, width, height, color = "", label = "") {
            commands.push(["graph", Array.from(numbers, Number), low, high, ...at(point), width, height, color, label]);
        },
        /** That of these points which the pointer holds, or null. */
        held(points) {
            const { pointer } = words;
            if (pointer.isDown && !wasDown) {
                const far = (point) => Math.hypot(point.x - pointer.x, point.y - pointer.y);
                const nearest = points.reduce((best, point) => (far(point) < far(best) ? point : best));
                held = far(nearest) < reachOfHand ? nearest : null;
            }
            if (!pointer.isDown) held = null;
            wasDown = pointer.isDown;
            return points.includes(held) ? held : null;
        },
        /** Keeps a point inside the room: bounce() of the first lesson, on four walls. */
        walls(point, rebound = 0.5) {
            for (const [now, old, low, high] of [["x", "oldX", 16, 624], ["y", "oldY", 16, 384]]) {
                const inside = Math.min(Math.max(point[now], low), high);
                if (inside === point[now]) continue;
                point[old] = inside + rebound * (point[now] - point[old]);
                point[now] = inside;
            }
        },
        /** A number with a name, for the line below the figure and the text. */
        show(name, value) { live[name] = value; },
        /** The line below the figure. */
        say(text) { reading = String(text); },
    };
    /** Takes so many steps and draws: what there is to paint. */
    const frame = (program, steps) => {
        commands = [];
        live = {};
        for (let i = 0; i < steps; ++i) program.step?.(1 / 60);
        program.draw?.();
        return { commands, live, reading };
    };
    Object.assign(self, words);
    self.lessonFrame = frame;
    self.lessonPointer = words.pointer;
})();
