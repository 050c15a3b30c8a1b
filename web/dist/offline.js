// After the first visit the walkthrough is there without a network. The page itself is asked for first, so that a new one is seen.
const name = 'oriel {{number}}';
self.addEventListener('activate', (event) => {
  event.waitUntil(self.clients.claim());
});
self.addEventListener('fetch', (event) => {
  if (event.request.method !== 'GET') return;
  const kept = () => caches.open(name).then((cache) => cache.match(event.request, { ignoreSearch: true }));
  const page = event.request.mode === 'navigate';
  event.respondWith(page ? fetch(event.request).catch(async () => (await kept()) ?? Response.error())
                         : kept().then((found) => found ?? fetch(event.request)));
});
