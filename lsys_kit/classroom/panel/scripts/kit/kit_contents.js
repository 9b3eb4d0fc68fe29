// The first page of a course whose pages hold the kit: that they open without a network, too, is said there, and Python kept for that.

import { openContents } from "../contents.js";
import { made, worded } from "../views/controls.js";
import { keepOffline } from "./offline.js";

export function openKitContents() {
  const { home, python } = JSON.parse(document.getElementById("lsys-data").textContent);
  tellOfOffline(home, python);
  return openContents();
}

async function tellOfOffline(home, { file, bytes }) {
  const text = made("span"), place = made("p.quiet.kit-offline", { role: "status" }, text), keepPython = await keepOffline(home);
  if (!keepPython) return;
  const button = made("button", { type: "button", onclick: keep }, worded("Keep Python, too: {many} MB", { many: Math.ceil(bytes / 1e6) }));
  document.querySelector("main").append(place);
  show(await caches.match(new URL(file, new URL(home, location.href))));

  function show(whole) {
    text.textContent = whole ? worded("This browser keeps the course and Python: all of it works without a network.") : worded("This browser keeps these pages: they open without a network, and answers wait for Python.");
    if (whole) button.remove();
    else place.append(" ", button);
  }

  async function keep() {
    button.disabled = true;
    text.textContent = worded("Python is fetched.");
    const whole = await keepPython();
    button.disabled = false;
    show(whole);
    if (!whole) text.textContent = worded("Python could not be fetched, or there is no room for it.");
  }
}
