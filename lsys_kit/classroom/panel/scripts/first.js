// What a page runs first: it unpacks its style and its other scripts. A policy that names both by their hashes lets no other run.

import { unpacked } from "./books/packed.js";

const packed = JSON.parse(document.getElementById("lsys-data").textContent);
Promise.all([packed.style, packed.script].map(unpacked)).then(([style, script]) => {
  const policy = /** @type {any} */ (window).trustedTypes?.createPolicy("lsys", { createScript: (text) => text });
  const [looks, element] = [document.createElement("style"), document.createElement("script")];
  looks.textContent = style;
  element.text = policy ? policy.createScript(script) : script;
  document.head.append(looks, element);
});
