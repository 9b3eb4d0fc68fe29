// What was done to a text, to be taken back and done again: by keys, by buttons, and by the browser's own menu. The browser's own
// history of a text area ends where a script changes it, and Jupyter takes some of its keys.

import { button, worded } from "./controls.js";

const PAUSE = 1000; // milliseconds without a key after which what is typed is another change
const MOST = 200; // changes that can be taken back
const KINDS = { insertText: "typed", insertCompositionText: "typed", deleteContentBackward: "deleted", deleteContentForward: "deleted" };

// `put` is called with the text that was brought back, and with what `state` was when it was left.
export function undoing(area, put, state) {
  const undo = button(worded("undo"), worded("take back the last change of the rules"), () => go(-1), { disabled: true });
  const redo = button(worded("redo"), worded("make the change that was taken back again"), () => go(1), { disabled: true });
  const entries = [];
  let now = -1, kind = "", time = 0;

  function show() {
    undo.disabled = now < 1;
    redo.disabled = now > entries.length - 2;
  }

  // Note what stands in the area after an event, or after a script has changed it; a word that is typed in one go is one change.
  function note({ inputType = "", data = "" } = {}) {
    const text = area.value, same = (inputType === "insertText" && data?.length > 1 ? "" : KINDS[inputType]) ?? "", pause = performance.now() - time > PAUSE;
    if (text === entries[now]?.text) return;
    const joins = same && same === kind && !pause && now > 0 && !/^\s/.test(data ?? "");
    if (entries[now] && !joins) entries[now].state = state();
    entries.splice(joins ? now : now + 1, Infinity, { text, caret: area.selectionEnd, state: null });
    if (entries.length > MOST) entries.shift();
    now = entries.length - 1;
    [kind, time] = [same, performance.now()];
    show();
  }

  function go(way) {
    const to = entries[now + way];
    if (!to) return;
    entries[now].state = state();
    now += way;
    kind = "";
    area.value = to.text;
    area.setSelectionRange(to.caret, to.caret);
    show();
    put(to.text, to.state);
  }

  // In the whole panel, but for other boxes, in which these keys take back what was typed there.
  function pressed(event) {
    const key = event.key.toLowerCase(), way = key === "z" ? (event.shiftKey ? 1 : -1) : Number(key === "y" && !event.shiftKey);
    if (!way || event.altKey || !(event.ctrlKey || event.metaKey) || area.readOnly) return;
    if (!area.closest(".lsys-panel")?.contains(event.target) || (event.target !== area && event.target.matches("[type=text], textarea"))) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    go(way);
  }

  area.addEventListener("beforeinput", (event) => {
    const way = { historyUndo: -1, historyRedo: 1 }[event.inputType];
    if (!way) return;
    event.preventDefault();
    go(way);
  });
  window.addEventListener("keydown", pressed, true);
  return { note, tools: [undo, redo], close: () => window.removeEventListener("keydown", pressed, true) };
}
