import type { Engine, SceneParameter } from "../sinew/index.js";
import { writeAddress } from "../common/address.js";
import type { Stage } from "../common/stage.js";
import type { Opened } from "./app.js";

/** The shortest address that leads to the scene as it is: a name and pairs where that says all, else the whole text. */
export async function addressOf(engine: Engine, stage: Stage, opened: Opened, text: string): Promise<string> {
    const now = stage.player.sceneText();
    const found = pairsTo(engine, stage, opened, now);
    const isSplit = stage.player.state().panes > 1;
    const pairs = isSplit ? [...(found ?? []).filter((pair) => !/^(solver\.)?mode=/.test(pair)), both] : found ?? [];
    if (found && opened.isOfCatalogue) return writeAddress({ scene: opened.name, pairs });
    return writeAddress({ text: found ? opened.text : text, name: opened.isOfCatalogue || opened.name === unnamed ? undefined : opened.name, pairs });
}

/** The pair of an address that shows both modes beside each other. */
const both = "mode=both";
export const isBoth = (pair: string): boolean => /^(solver\.)?mode=both$/.test(pair);
/** Name of a scene that an address holds without one. */
export const unnamed = "shared scene";

/** Pairs that make the scene as opened the scene as it is, if there are such. */
function pairsTo(engine: Engine, stage: Stage, opened: Opened, now: string): string[] | null {
    for (const first of [opened.pairs, [...opened.pairs, `mode=${modeOf(now)}`]]) {
        const base = open(engine, stage, opened, first);
        if (!base) continue;
        const pairs = base.text === now ? first : [...first, ...differences(base.parameters, stage.player.parameters())];
        if (base.text === now || open(engine, stage, opened, pairs)?.text === now) return shortened(pairs);
    }
    return null;
}

function open(engine: Engine, stage: Stage, opened: Opened, overrides: string[]): { text: string; parameters: SceneParameter[] } | null {
    try {
        const simulation = engine.open(opened.text, { ...stage.optionsOf(opened.text), overrides });
        const found = { text: simulation.sceneText(), parameters: simulation.parameters() };
        simulation.dispose();
        return found;
    } catch {
        return null;
    }
}

const modeOf = (text: string): string => (/"mode"\s*:\s*"classic"/.test(text) ? "classic" : "physical");

function differences(before: SceneParameter[], after: SceneParameter[]): string[] {
    const old = new Map(before.map(({ path, value }) => [path, JSON.stringify(value)]));
    return after.filter(({ path, value }) => old.get(path) !== JSON.stringify(value))
        .map(({ path, value }) => `${path}=${typeof value === "string" ? value : JSON.stringify(value)}`);
}

/** The last pair of each path. */
function shortened(pairs: string[]): string[] {
    const last = new Map(pairs.map((pair) => [pair.slice(0, pair.indexOf("=")), pair]));
    return [...last.values()];
}
