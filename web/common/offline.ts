/** Registers the service worker of a built site. */
export function workOffline(address: string): void {
    if (import.meta.env.PROD && "serviceWorker" in navigator && location.protocol !== "file:")
        navigator.serviceWorker.register(address).catch(() => {}); // a page that is not kept works all the same
}
