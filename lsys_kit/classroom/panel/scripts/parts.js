// The parts of a page of the course, each in the place where its data belong.

import { unpacked } from "./books/packed.js";

const NEAR = "50%"; // of a window's height: so near to it something is opened at once

// What comes into view is opened first; then all the rest, one after another, so that a page can be printed and searched. Of each
// kind of parts there is a function, which is given its place, its data and what the page knows; `cannot` says that it failed.
export async function openParts(kinds, cannot, known = {}) {
  const page = { ...JSON.parse(document.getElementById("lsys-data").textContent), ...known, kinds: { ...kinds, picture }, cannot };
  const places = [...document.querySelectorAll("[data-part]")].filter((place) => !place.parentElement.closest("[data-part]"));
  const closed = new Set(places);
  const openOnce = async (place) => { if (closed.delete(place)) await openPart(place, page); };
  const watcher = new IntersectionObserver((seen) => {
    for (const { isIntersecting, target } of seen) if (isIntersecting) openOnce(target);
  }, { rootMargin: NEAR });
  for (const place of places) watcher.observe(place);
  for (const place of places) {
    if (closed.has(place)) await idle();
    await openOnce(place);
  }
  watcher.disconnect();
}

const PATIENCE = 500; // milliseconds after which the next part is opened though the browser is busy, as one in the background always is

// When the browser has nothing else to do; one that does not tell is given a moment.
const idle = () => new Promise((done) => ("requestIdleCallback" in window ? requestIdleCallback(done, { timeout: PATIENCE }) : setTimeout(done, 50)));

// Put a part in its place, instead of what stands there for readers without scripts.
export async function openPart(place, page) {
  const { kind, data } = page.parts[Number(place.dataset.part)];
  try {
    await page.kinds[kind](place, data, page);
    place.dataset.open = "";
  } catch (fault) {
    place.append(page.cannot(fault));
  }
}

async function picture(place, { drawing }) {
  place.src = URL.createObjectURL(new Blob([await unpacked(drawing)], { type: "image/svg+xml" }));
}
