// After the first visit the walkthrough is there without a network. The page itself is asked for first, so that a new one is seen.
// By folder: an origin may have several walkthroughs.
const own = `oriel ${new URL('./', self.location.href).pathname} `, name = `${own}{{number}}`;
self.addEventListener('install', () => self.skipWaiting());
self.addEventListener('activate', (event) => {
  const forget = async () => {
    for (const other of await caches.keys()) if (other.startsWith(own) && other !== name) await caches.delete(other);
    await self.clients.claim();
  };
  event.waitUntil(forget());
});
self.addEventListener('fetch', (event) => {
  if (event.request.method !== 'GET') return;
  const kept = () => caches.open(name).then((cache) => cache.match(event.request, { ignoreSearch: true }));
  const page = event.request.mode === 'navigate';
  event.respondWith(page ? fetch(event.request).catch(async () => (await kept()) ?? Response.error())
                         : kept().then((found) => found ?? fetch(event.request)));
});
