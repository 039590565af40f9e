// Keeps the page's files, so that it opens without a network after the first visit. A new version is kept beside the old
// one and takes its place when the page is opened next.
'use strict';

// A server may hold several of these folders, each with files of its own.
const own = 'zstep ' + self.registration.scope + ' ';
const version = own + '@VERSION@';
const files = @FILES@;

self.addEventListener('install', (event) => {
  event.waitUntil(caches.open(version).then((cache) => cache.addAll(files)));
});

self.addEventListener('activate', (event) => {
  const old = (names) => Promise.all(names.filter((name) => name.startsWith(own) && name !== version).map((name) => caches.delete(name)));
  event.waitUntil(caches.keys().then(old).then(() => self.clients.claim()));
});

self.addEventListener('fetch', (event) => {
  if (event.request.method !== 'GET' || !event.request.url.startsWith(self.registration.scope)) return;
  event.respondWith(caches.open(version).then((cache) => cache.match(event.request, {ignoreSearch: true}))
    .then((kept) => kept || fetch(event.request)));
});
