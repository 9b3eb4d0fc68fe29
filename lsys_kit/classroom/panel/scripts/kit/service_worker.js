// The service worker of pages that hold the kit, by which they open without a network: it keeps the files of the site, each under its
// address and its hash, and Python once a page has asked for it. Of a site that was written again it fetches what has changed.
// Nothing is asked for but these files, and nothing is sent.

const page = /** @type {any} */ (globalThis), home = new URL(".", page.location.href).href;
const { pages, python: files } = page.SITE; // the hashes of files by their names; addresses, some with the hash that their content must have
const NAME = `lsys-kit ${home}`, PATIENCE = 4_000; // milliseconds that a page may take to come before the kept one is shown
const addressIn = (name) => new URL(name, home).href;
const places = new Map(Object.entries(pages).map(([name, hash]) => [addressIn(name), addressIn(`${name}?${hash}`)]));
const ofPython = new Map(files.map(({ address, integrity }) => [addressIn(address), integrity ? { integrity } : {}]));

page.oninstall = (event) => event.waitUntil(prepare());
page.onactivate = (event) => event.waitUntil(begin());
page.onmessage = (event) => event.waitUntil(keepPython().then(() => event.ports[0]?.postMessage(true), () => event.ports[0]?.postMessage(false)));
page.onfetch = (event) => {
  const { method, url } = event.request, there = url.split(/[?#]/)[0].replace(/\/$/, "/index.html");
  if (method !== "GET") return;
  if (ofPython.has(url)) event.respondWith(once(event.request));
  else if (places.has(there)) event.respondWith(newest(event.request, places.get(there)));
};

const kept = () => page.caches.open(NAME);

async function prepare() {
  const store = await kept(), before = (await store.keys()).map(({ url }) => url);
  if (!page.navigator.connection?.saveData) for (const [address, place] of places) await keep(store, place, address, { cache: "no-cache" });
  if (before.some((url) => url.includes(".wasm"))) await keepPython();
  await page.skipWaiting();
}

// What belongs to an older site is given up only when all of the new one is there.
async function begin() {
  const store = await kept(), wanted = new Set([...places.values(), ...ofPython.keys()]);
  for (const request of await store.keys()) if (!wanted.has(request.url)) await store.delete(request);
  await page.clients.claim();
}

async function keepPython() {
  const store = await kept();
  for (const [address, how] of ofPython) await keep(store, address, address, how);
}

async function keep(store, place, address, how) {
  if (await store.match(place)) return;
  const response = await fetch(address, how);
  if (!response.ok) throw new Error(`${address}: ${response.status}`);
  await store.put(place, await plain(response));
}

// A response that was redirected is no answer to a page that is opened.
const plain = async (response) => (response.redirected ? new Response(await response.blob(), { headers: response.headers }) : response);

// A file of Python, which does not change: what was kept, else what comes, which is kept then.
async function once(request) {
  const store = await kept(), had = await store.match(request.url);
  if (had) return had;
  const response = await fetch(request);
  if (response.ok) store.put(request.url, response.clone()).catch(() => {}); // the browser may have no room
  return response;
}

// A page as it is now; the kept one where there is no network, or a bad one.
async function newest(request, place) {
  const store = await kept(), had = await store.match(place), comes = fetch(request);
  if (had) return Promise.race([comes.then((response) => (response.ok ? response : had), () => had), new Promise((done) => setTimeout(done, PATIENCE, had))]);
  const response = await comes;
  if (response.ok) plain(response.clone()).then((copy) => store.put(place, copy)).catch(() => {});
  return response;
}
