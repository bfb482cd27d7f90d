import "../common/base.css";
import "./playground.css";
import { announce, byId, el } from "../common/dom.js";
import { loadEngine, usefulThreads } from "../common/engine.js";
import { stayFresh } from "../common/fresh.js";
import { workOffline } from "../common/offline.js";
import { applyTheme } from "../common/theme.js";
import { App } from "./app.js";

applyTheme();
stayFresh();
workOffline("./sw.js");

try {
    const { engine, assets } = await loadEngine(usefulThreads());
    const app = new App(engine, assets);
    Object.assign(window, { sinew: app }); // for the browser's console
    await app.follow(location.hash);
} catch (error) {
    byId("gallery").hidden = false;
    byId("gallery").replaceChildren(el("p", { class: "none", role: "alert" }, `Sinew did not start: ${error instanceof Error ? error.message : error}`));
    announce("");
    throw error;
}
