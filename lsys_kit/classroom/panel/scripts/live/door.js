// The page on which the code of a class is typed.

import { speak } from "../views/controls.js";

export function openDoor() {
  speak(JSON.parse(document.getElementById("lsys-data").textContent).words);
  document.getElementById("door").addEventListener("submit", (event) => {
    event.preventDefault();
    const code = /** @type {HTMLInputElement} */ (document.getElementById("code")).value.trim().toUpperCase();
    if (/^[A-Z]{4}$/.test(code)) location.assign(`/${code}/`);
  });
}
