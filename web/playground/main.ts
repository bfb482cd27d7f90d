import "../shared/base.css";
import "./playground.css";
import { announce, byId, el } from "../shared/dom.js";
import { loadEngine } from "../shared/engine.js";
import { workOffline } from "../shared/offline.js";
import { applyTheme } from "../shared/theme.js";
import { App } from "./app.js";

applyTheme();
workOffline("./sw.js");

try {
    const { engine, scenes, assets } = await loadEngine();
    const app = new App(engine, scenes, assets);
    Object.assign(window, { sinew: app }); // for the browser's console
    await app.follow(location.hash);
} catch (error) {
    byId("gallery").hidden = false;
    byId("gallery").replaceChildren(el("p", { class: "none", role: "alert" }, `Sinew did not start: ${error instanceof Error ? error.message : error}`));
    announce("");
    throw error;
}
