/** The icons of the native window, drawn in a square from -1 to 1. */
const stroke = (path: string): string => `<path d="${path}"/>`;
const fill = (path: string): string => `<path class="fill" d="${path}"/>`;
const ring = (x: number, y: number, r: number): string => `<circle cx="${x}" cy="${y}" r="${r}"/>`;
const dot = (x: number, y: number, r: number): string => `<circle class="fill" cx="${x}" cy="${y}" r="${r}"/>`;

const point = (x: number, y: number, r: number, angle: number): string =>
    `${(x + r * Math.cos(angle)).toFixed(3)} ${(y + r * Math.sin(angle)).toFixed(3)}`;
const arc = (x: number, y: number, r: number, from: number, to: number): string =>
    stroke(`M${point(x, y, r, from)}A${r} ${r} 0 ${to - from > Math.PI ? 1 : 0} 1 ${point(x, y, r, to)}`);

const drawings: Record<string, string> = {
    grab: fill("M-.75-.95 .75 .1 .05 .2-.75 .85z") + stroke("M0 .1 .5 .95"),
    select: stroke("M-.9-.45V-.9H-.45M.45-.9H.9V-.45M.9 .45V.9H.45M-.45 .9H-.9V.45") + dot(0, 0, 0.4),
    pin: dot(0, -0.45, 0.5) + stroke("M0 0V.95"),
    cut: ring(-0.55, 0.6, 0.32) + ring(0.55, 0.6, 0.32) + stroke("M-.35 .32 .5-.95M.35 .32-.5-.95"),
    join: ring(-0.6, 0.6, 0.32) + ring(0.6, -0.6, 0.32) + stroke("M-.36 .36 .36-.36"),
    rope: stroke("M-.95 .7C-.2-1.7 .2 1.7 .95-.7"),
    polygon: stroke("M-.15-.9 .9-.35 .6 .8-.55 .75-.95-.2z"),
    cloth: stroke("M-.85-.85H.85V.85H-.85zM-.28-.85V.85M.28-.85V.85M-.85-.28H.85M-.85 .28H.85"),
    spawn: stroke("M0-.85V.85M-.85 0H.85"),
    wall: fill("M-.95 .45-.75 .85 .95-.45 .75-.85z"),
    terrain: stroke("M-.95 .3C-.4-1.3 .1 1.2 .95-.4M-.95 .85H.95"),
    remove: stroke("M-.9-.6H.9M-.3-.9H.3M-.65-.55-.5 .9H.5L.65-.55"),
    measure: stroke("M-.95 .55 .55-.95 .95-.55-.55 .95zM-.35-.05-.1 .2M.1-.5 .35-.25"),
    undo: arc(0.1, 0.25, 0.62, -2.6, 1.2) + fill("M-.95-.05-.5-.75-.05-.05z"),
    redo: arc(-0.1, 0.25, 0.62, 1.94, 5.74) + fill("M.95-.05 .5-.75 .05-.05z"),
    restart: arc(0, 0.05, 0.72, -0.9, 4.2) + fill("M-.75-.9 .05-.72-.52-.1z"),
    back: fill("M.75-.8V.8L-.45 0z") + stroke("M-.65-.75V.75"),
    step: fill("M-.75-.8 .45 0-.75 .8z") + stroke("M.65-.75V.75"),
    play: fill("M-.55-.85 .85 0-.55 .85z"),
    pause: fill("M-.65-.8H-.2V.8H-.65zM.2-.8H.65V.8H.2z"),
    scenes: stroke("M-.85-.85H-.15V-.15H-.85zM.15-.85H.85V-.15H.15zM-.85 .15H-.15V.85H-.85zM.15 .15H.85V.85H.15z"),
    share: stroke("M-.5 0 .55-.6M-.5 0 .55 .6") + dot(-0.6, 0, 0.3) + dot(0.62, -0.64, 0.3) + dot(0.62, 0.64, 0.3),
    save: stroke("M0-.9V.35M-.45-.1 0 .35 .45-.1M-.85 .45V.85H.85V.45"),
    panel: stroke("M-.9-.5H.9M-.9 .5H.9") + dot(-0.3, -0.5, 0.28) + dot(0.35, 0.5, 0.28),
    theme: ring(0, 0, 0.75) + fill("M0-.75A.75 .75 0 0 1 0 .75z"),
    help: stroke("M-.42-.45A.45 .45 0 1 1 .2-.02Q0 .1 0 .35") + dot(0, 0.75, 0.13),
    lessons: stroke("M0-.6C-.3-.85-.7-.85-.95-.75V.7C-.7 .6-.3 .6 0 .8C.3 .6 .7 .6 .95 .7V-.75C.7-.85 .3-.85 0-.6V.8"),
    steer_left: fill("M-.7 0 .5-.75V.75z"),
    steer_right: fill("M.7 0-.5-.75V.75z"),
    steer_up: fill("M0-.7.75.5H-.75z"),
    steer_down: fill("M0 .7.75-.5H-.75z"),
    jump: stroke("M-.8 .85H.8M0 .5V-.8M-.5-.3 0-.8 .5-.3"),
    hold: stroke("M.4-.95V.4A.5 .5 0 0 1-.6 .4V.05M-.9 .35-.6 .05-.3 .35"),
    close: stroke("M-.65-.65 .65 .65M.65-.65-.65 .65"),
    home: stroke("M-.95 0C-.5-.85 .5-.85 .95 0C.5 .85-.5 .85-.95 0z") + dot(0, 0, 0.3),
};

export function icon(name: string): SVGSVGElement {
    const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    svg.setAttribute("viewBox", "-1.15 -1.15 2.3 2.3");
    svg.setAttribute("class", "icon");
    svg.setAttribute("aria-hidden", "true");
    svg.innerHTML = drawings[name] ?? dot(0, 0, 0.5);
    return svg;
}
