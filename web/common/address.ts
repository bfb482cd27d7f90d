/** Scenes as the fragment of an address: #scene=ragdoll&mode=classic, or #z=... with a compressed text; the other pairs
 * are those of the command line. Nothing of it is sent to a server. */
export interface Address {
    scene?: string;  // name in the catalogue
    text?: string;   // of a scene
    name?: string;   // of the file that the text came from
    pairs: string[]; // "solver.substeps=16"
}

/** Quoted for a fragment, with the signs of paths and points left legible. */
const quoted = (text: string): string =>
    encodeURIComponent(text).replace(/%(5B|5D|2C|3A|2F|3D)/g, (code) => decodeURIComponent(code));

export async function readAddress(fragment: string): Promise<Address> {
    const address: Address = { pairs: [] };
    for (const part of fragment.replace(/^#/, "").split("&").filter(Boolean)) {
        const pair = decodeURIComponent(part.replaceAll("+", "%2B"));
        const [key, value] = [pair.slice(0, pair.indexOf("=")), pair.slice(pair.indexOf("=") + 1)];
        if (!pair.includes("=")) address.scene ??= pair;
        else if (key === "scene") address.scene = value;
        else if (key === "z") address.text = await inflated(value);
        else if (key === "name") address.name = value;
        else address.pairs.push(pair);
    }
    return address;
}

export async function writeAddress(address: Address): Promise<string> {
    const first = address.text !== undefined ? [`z=${await deflated(address.text)}`] : address.scene ? [`scene=${quoted(address.scene)}`] : [];
    const name = address.text !== undefined && address.name ? [`name=${quoted(address.name)}`] : [];
    return `#${[...first, ...name, ...address.pairs.map(quoted)].join("&")}`;
}

/** Base64url of the text's raw deflate stream. */
export async function deflated(text: string): Promise<string> {
    const bytes = await throughStream(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
    let binary = "";
    for (const byte of bytes) binary += String.fromCharCode(byte);
    return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

export async function inflated(code: string): Promise<string> {
    try {
        const binary = atob(code.replaceAll("-", "+").replaceAll("_", "/"));
        const bytes = Uint8Array.from(binary, (letter) => letter.charCodeAt(0));
        return new TextDecoder().decode(await throughStream(bytes, new DecompressionStream("deflate-raw")));
    } catch {
        throw new Error("The scene in this address is damaged: a part of it seems to be missing.");
    }
}

async function throughStream(bytes: Uint8Array<ArrayBuffer>, stream: CompressionStream | DecompressionStream): Promise<Uint8Array> {
    return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}
