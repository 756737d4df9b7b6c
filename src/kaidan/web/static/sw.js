// The page without the network: its files and the catalogue from the last time the server was there.
// The server comes first, so that a new version shows at once; questions are never answered from here.

const STORE = "kaidan-1";
const FILES = [
  "./", "style.css", "manifest.webmanifest", "icon.svg", "icon-192.png", "icon-512.png",
  "live.html", "live.css", "live.js",
  ...[
    "api", "building", "chart", "check", "controls", "dom", "ground", "i18n", "kept", "landings", "light", "main", "margin", "measure", "plane",
    "posemap", "question", "robot", "saved", "sentences", "sheet", "side", "stairs", "state", "storage",
    "units", "upload", "verdict", "work",
  ].map((name) => `js/${name}.js`),
  "api/texts", "api/catalogue",
];
const PATIENCE = 3000; // [ms]

self.addEventListener("install", (event) => {
  event.waitUntil((async () => {
    const store = await caches.open(STORE);
    await store.addAll(FILES.map((each) => new Request(each, { cache: "reload" })));
    const { robots, stairs, surfaces } = await (await store.match("api/catalogue")).json();
    const sheets = Object.entries({ robots, stairs, surfaces }).flatMap(([kind, list]) => list.map((each) => `api/catalogue/${kind}/${encodeURIComponent(each.name)}`));
    await store.addAll(sheets);
    await self.skipWaiting();
  })());
});

self.addEventListener("activate", (event) => {
  event.waitUntil((async () => {
    for (const name of await caches.keys()) if (name !== STORE) await caches.delete(name);
    await self.clients.claim();
  })());
});

self.addEventListener("fetch", (event) => {
  const { request } = event;
  if (request.method !== "GET" || new URL(request.url).origin !== location.origin) return;
  event.respondWith((async () => {
    const store = await caches.open(STORE);
    const kept = await store.match(request, { ignoreSearch: true });
    if (!kept) return fetch(request);
    const abort = new AbortController();
    const timer = setTimeout(() => abort.abort(), PATIENCE);
    try {
      const fresh = await fetch(request, { signal: abort.signal });
      if (fresh.ok) await store.put(request, fresh.clone());
      return fresh;
    } catch {
      return kept;
    } finally {
      clearTimeout(timer);
    }
  })());
});
