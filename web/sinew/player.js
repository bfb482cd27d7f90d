import { valueText } from "./engine.js";
import { SinewError, status } from "./errors.js";
import { Handle } from "./handle.js";
import { playerState } from "./layout.js";
import { Picture } from "./picture.js";
import { Simulation } from "./simulation.js";

const buttons = { left: 0, middle: 1, right: 2 };
const phases = { down: 0, move: 1, up: 2 };

function numberOf(table, name) {
    if (!(name in table)) throw new SinewError(status.badArgument, `"${name}" is none of ${Object.keys(table).join(", ")}`);
    return table[name];
}

/** The interactive player of the window: clock, tools, camera, undo, timeline. */
export class Player extends Handle {
    /** Calls a function with texts. */
    say(name, texts, ...given) {
        this.engine.data.within((arena) => this.call(name, ...texts.map((text) => arena.text(text)), ...given));
    }

    get simulation() { return this.pane(0); }
    pane(index) { return new Simulation(this.engine, this.engine.data.uint(this.ask("sinew_player_world", index))); }

    dispose() {
        if (this.isClosed) return;
        this.isClosed = true;
        this.call("sinew_player_close");
    }

    open(scene, options = {}) {
        this.engine.withScene(scene, options, (text, more) => this.call("sinew_player_open", text, more));
    }

    become(scene, options = {}) {
        this.engine.withScene(scene, options, (text, more) => this.call("sinew_player_become", text, more));
    }

    resize(width, height, density = 1) { this.call("sinew_player_resize", width, height, density); }
    /** The first frame of a page may be asked for with a time before now: it counts as none. */
    advance(seconds) { this.call("sinew_player_advance", Math.max(seconds, 0)); }

    draw() {
        const at = this.ask("sinew_player_draw");
        return new Picture(this.engine, at, this.handle, "sinew_player_picture_text", "sinew_player_picture_image");
    }

    // --- input ----------------------------------------------------------------------------------------------------

    pointerMove(x, y) { this.call("sinew_player_pointer", x, y); }
    pointerDown(button = "left") { this.call("sinew_player_press", numberOf(buttons, button)); }
    pointerUp(button = "left") { this.call("sinew_player_release", numberOf(buttons, button)); }
    pointerLeave() { this.call("sinew_player_leave"); }
    wheel(notches) { this.call("sinew_player_scroll", notches); }
    pinch(dx, dy, factor) { this.call("sinew_player_pinch", dx, dy, factor); }
    touch(finger, phase, x, y) { this.call("sinew_player_touch", BigInt(finger), numberOf(phases, phase), x, y); }
    key(name, isDown = true) { this.say("sinew_player_key", [name], isDown ? 1 : 0); }

    pan(dx, dy) { this.call("sinew_player_pan", dx, dy); }
    orbit(dx, dy) { this.call("sinew_player_orbit", dx, dy); }
    zoom(factor) { this.call("sinew_player_zoom", factor); }

    // --- actions --------------------------------------------------------------------------------------------------

    do(action) { this.say("sinew_player_do", [action]); }
    pause(on = true) { this.call("sinew_player_pause", on ? 1 : 0); }
    step() { this.do("step"); }
    stepBack() { this.do("back"); }
    restart() { this.do("restart"); }
    undo() { this.do("undo"); }
    redo() { this.do("redo"); }
    goTo(step) { this.call("sinew_player_go_to", step); }
    setTimeScale(scale) { this.call("sinew_player_time_scale", scale); }
    setTool(name) { this.say("sinew_player_tool", [name]); }
    setPrefab(name, parameters = {}) { this.say("sinew_player_prefab", [name, JSON.stringify(parameters)]); }
    setJoint(name) { this.say("sinew_player_joint", [name]); }
    setOverlays(overlays) { this.call("sinew_player_overlays", this.engine.overlayBits(overlays)); }
    setTheme(theme) { this.say("sinew_player_theme", [theme]); }

    parameters() { return this.simulation.parameters(); }
    set(path, value, goesOn = false) { this.say("sinew_player_set", [path, valueText(value)], goesOn ? 1 : 0); }
    sceneText() { return this.simulation.sceneText(); }
    hash() { return this.simulation.hash(); }

    state() {
        const { isPaused, isEdited, isHolding, overlays, ...state } = this.engine.data.read(playerState, this.ask("sinew_player_get_state"));
        return {
            ...state, isPaused: isPaused !== 0, isEdited: isEdited !== 0, isHolding: isHolding !== 0,
            overlays: this.engine.overlaysOf(overlays),
        };
    }

    events() {
        const { data } = this.engine;
        const events = [];
        while (this.engine.finds("sinew_player_next_event", this.handle, data.result))
            events.push(JSON.parse(data.textFrom(data.result)));
        return events;
    }
}

if (Symbol.dispose) Player.prototype[Symbol.dispose] = Player.prototype.dispose;
