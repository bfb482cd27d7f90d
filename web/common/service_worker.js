// Keeps the files of the site, so that it opens without a network: modules that a scene or a file asks for when they have
// been loaded, all else at the first visit. A new version takes over at the next visit.
const files = [/* files */];
const modulesOfThreads = [/* modules of threads */];
const cacheName = "sinew-/* version */";

self.addEventListener("install", (event) => {
    const wanted = self.crossOriginIsolated ? [...files, ...modulesOfThreads] : files;
    event.waitUntil(caches.open(cacheName).then((cache) => cache.addAll(wanted)).then(() => self.skipWaiting()));
});

self.addEventListener("activate", (event) => {
    const isOld = (name) => name.startsWith("sinew-") && name !== cacheName;
    event.waitUntil(caches.keys()
        .then((names) => Promise.all(names.filter(isOld).map((name) => caches.delete(name))))
        .then(() => self.clients.claim()));
});

async function answer(request) {
    const cache = await caches.open(cacheName), found = await cache.match(request, { ignoreSearch: true });
    if (found) return found;
    const response = await fetch(request);
    if (response.ok && new URL(request.url).pathname.endsWith(".wasm")) await cache.put(request, response.clone());
    return response;
}

self.addEventListener("fetch", (event) => {
    if (event.request.method !== "GET" || new URL(event.request.url).origin !== self.location.origin) return;
    event.respondWith(answer(event.request));
});
