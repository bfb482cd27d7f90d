// A component for React: <Sinew scene={...} /> plays a scene on a canvas of its own, with the pointer, tools and camera of the player.
import { useEffect, useRef, useState } from "react";
import { createRoot } from "react-dom/client";
import { Canvas2DPainter, load } from "sinew";

const engine = load(); // once for all components

/** @param {{ scene: object, paused?: boolean, width?: number, height?: number, onSteps?: (steps: number) => void }} props */
export function Sinew({ scene, paused = false, width = 640, height = 400, onSteps }) {
    const canvas = useRef(/** @type {HTMLCanvasElement | null} */ (null)), player = useRef(/** @type {import("sinew").Player | null} */ (null));

    useEffect(() => {
        let frame = 0, isGone = false;
        void engine.then((loaded) => {
            const context = canvas.current?.getContext("2d");
            if (isGone || !context) return;
            const playing = (player.current = loaded.play(scene));
            const painter = new Canvas2DPainter(context);
            playing.resize(context.canvas.width, context.canvas.height, devicePixelRatio);
            let last = performance.now();
            frame = requestAnimationFrame(function next(now) {
                playing.advance((now - last) / 1000);
                last = now;
                painter.paint(playing.draw());
                onSteps?.(playing.state().step);
                frame = requestAnimationFrame(next);
            });
        });
        return () => {
            isGone = true;
            cancelAnimationFrame(frame);
            player.current?.dispose();
            player.current = null;
        };
    }, [scene, width, height, onSteps]);
    useEffect(() => void engine.then(() => player.current?.pause(paused)), [paused, scene]);

    /** @param {React.PointerEvent} event */
    const move = ({ nativeEvent: { offsetX, offsetY } }) => player.current?.pointerMove(offsetX * devicePixelRatio, offsetY * devicePixelRatio);
    return (
        <canvas ref={canvas} width={width * devicePixelRatio} height={height * devicePixelRatio} style={{ width, height }}
            onPointerMove={move}
            onPointerDown={(event) => { move(event); player.current?.pointerDown(); }}
            onPointerUp={() => player.current?.pointerUp()} />
    );
}

const scenes = Object.fromEntries(["ragdoll", "cloth", "rope"].map((prefab) => [prefab, {
    sinew: 1,
    view: { size: [640, 400], center: [0, 0], height: 4.2 },
    world: { gravity: [0, -9.81], bounds: { box: [[-3.2, -2], [3.2, 2]], friction: 0.5 } },
    figures: [{ prefab, at: [0, prefab === "ragdoll" ? 0 : 1.5] }],
}]));

function App() {
    const [name, setName] = useState("ragdoll"), [paused, setPaused] = useState(false), [steps, setSteps] = useState(0);
    return (
        <main style={{ fontFamily: "sans-serif", padding: 16 }}>
            {Object.keys(scenes).map((each) => <button key={each} disabled={each === name} onClick={() => setName(each)}>{each}</button>)}
            <label><input type="checkbox" checked={paused} onChange={(event) => setPaused(event.target.checked)} /> paused</label>
            <Sinew scene={scenes[name]} paused={paused} onSteps={setSteps} />
            <output>{steps} steps</output>
        </main>
    );
}
createRoot(/** @type {HTMLElement} */ (document.getElementById("root"))).render(<App />);
