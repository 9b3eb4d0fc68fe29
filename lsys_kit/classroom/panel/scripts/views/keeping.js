// What can be taken along: the pictures, the page, the link, and the line of code that makes the panel as it stands.

import { made, button } from "./controls.js";
import { worded } from "./language.js";

// `panel` has { canvas, file(), code(), state() }, the host perhaps a name of its own for files; `host.keep(kind, state)` gives { name, type, text or bytes }, or null.
export function keeping(host, { canvas, file, code, state }) {
  const said = made("output.lsys-hint"), field = made("input.lsys-code", { type: "text", readonly: true, hidden: true, "aria-label": worded("to be copied") });
  const element = made("div.lsys-controls.lsys-keep", { role: "group", "aria-label": worded("take along") }, made("span.lsys-hint", worded("take along:")));

  async function keep(kind) {
    const kept = await host.keep(kind, state());
    if (!kept || kept.mistake) said.textContent = kept?.mistake ? `${kept.mistake.message}. ${kept.mistake.hint ?? ""}` : "The kernel does not answer.";
    else if (kept.name) download(kept.name, new Blob([kept.bytes ?? kept.text], { type: kept.type }));
    else show(kept.text);
  }

  function show(text) {
    field.hidden = false;
    field.value = text;
    field.focus();
    field.select();
    navigator.clipboard?.writeText(text).then(() => (said.textContent = worded("copied")), () => (said.textContent = worded("copy it from here:")));
  }

  function download(name, blob) {
    const address = URL.createObjectURL(blob), link = made("a", { href: address, download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(address), 10_000);
    said.textContent = worded("kept as {name}", { name });
  }

  const kinds = { svg: "SVG", page: worded("page"), link: worded("link") };
  element.append(button("PNG", worded("keep the drawing as a PNG picture"), () => canvas.toBlob((blob) => download(`${host.file || file()}.png`, blob))));
  for (const [kind, text] of Object.entries(kinds)) {
    if (host.keeps.includes(kind)) element.append(button(text, worded("take along: {text}", { text }), () => keep(kind)));
  }
  element.append(button(worded("code"), worded("the line of Python that makes this panel as it stands"), () => show(code())), field, said);
  return element;
}
