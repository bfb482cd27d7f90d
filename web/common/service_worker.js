// Keeps every file of the site, so that it opens without a network. A new version takes over at the next visit.
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

self.addEventListener("fetch", (event) => {
    if (event.request.method !== "GET" || new URL(event.request.url).origin !== self.location.origin) return;
    event.respondWith(caches.open(cacheName)
        .then((cache) => cache.match(event.request, { ignoreSearch: true }))
        .then((found) => found ?? fetch(event.request)));
});
