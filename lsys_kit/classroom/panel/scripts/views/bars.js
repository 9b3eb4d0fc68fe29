// What stands around the views: step after step by itself; and what can be taken along: the pictures, the page, the link, and the
// line of code that makes the panel as it stands.

import { clamped } from "../books/numbers.js";
import { button, face, freshId, list, made, worded } from "./controls.js";
import { roving } from "./folding.js";

const SPEEDS = [["1200", "slow"], ["600", "normal"], ["250", "fast"]]; // milliseconds a step

// `steps` tells { now, most }; `go` goes to a step. `tools` are what few need of it: how fast, and whether again and again.
export function player(steps, go, moved) {
  let timer = 0, pause = 600;
  const play = button("play", worded("play"), toggle, { class: "lsys-button lsys-play" });
  const back = button("back", worded("one step back"), () => one(-1)), forward = button("forward", worded("one step on"), () => one(1));
  const first = button("first", worded("to step 0"), () => { stop(); go(0); });
  const loop = made("input", { type: "checkbox", id: freshId() });
  const speed = list("speed", worded("how long each step is shown"), SPEEDS.map(([value, name]) => [value, worded(name)]), "600", (value) => {
    pause = Number(value);
    if (timer) start();
  }, worded("speed"));
  const element = made("div.lsys-player", { role: "toolbar", "aria-label": worded("play") }, first, back, play, forward);
  const tools = [speed.element, made("label.lsys-check", { for: loop.id }, loop, worded("loop"))];
  roving(element);

  function one(way) {
    stop();
    const { now, most } = steps();
    go(clamped(0, most, now + way));
  }

  function tick() {
    const { now, most } = steps();
    if (now < most) go(now + 1);
    else if (loop.checked) go(0);
    else stop();
  }

  function start() {
    clearInterval(timer);
    timer = setInterval(tick, pause);
    face(play, "pause", worded("pause"));
    moved(true);
  }

  function stop() {
    if (!timer) return;
    clearInterval(timer);
    timer = 0;
    face(play, "play", worded("play"));
    moved(false);
  }

  function toggle() {
    if (timer) return stop();
    const { now, most } = steps();
    if (now >= most) go(0);
    start();
  }

  return { element, tools, stop, get playing() { return timer !== 0; } };
}

// `panel` has { canvas, file(), code(), state() }, the host perhaps a name of its own for files; `host.keep(kind, state)` gives { name, type, text or bytes }, or null.
export function keeping(host, { canvas, file, code, state }) {
  const said = made("output.lsys-hint"), field = made("input.lsys-code", { type: "text", readonly: true, hidden: true, "aria-label": worded("to be copied") });
  const element = made("div.lsys-keep", { role: "toolbar", "aria-label": worded("take along") }, made("span.lsys-hint", worded("take along:")));

  async function keep(kind) {
    const kept = await host.keep(kind, state());
    if (!kept || kept.mistake) said.textContent = kept?.mistake ? `${kept.mistake.message}. ${kept.mistake.hint ?? ""}` : "The kernel does not answer.";
    else if (kept.said) said.textContent = kept.said;
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

  const kinds = { svg: "SVG", page: worded("page"), link: worded("link"), wall: worded("to the wall") };
  element.append(button("PNG", worded("keep the drawing as a PNG picture"), () => canvas.toBlob((blob) => download(`${host.file || file()}.png`, blob))));
  for (const [kind, text] of Object.entries(kinds)) {
    if (host.keeps.includes(kind)) element.append(button(text, worded("take along: {text}", { text }), () => keep(kind)));
  }
  element.append(button(worded("code"), worded("the line of Python that makes this panel as it stands"), () => show(code())), field, said);
  roving(element);
  return element;
}
