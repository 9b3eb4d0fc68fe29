// The board of a class below a cell: the kernel passes on what the class tells, and what the teacher does.

import { tellsKernel } from "../panels/kernel.js";
import { made, onKey, ownKeys, speak, worded } from "../views/controls.js";
import { ownName } from "../views/landmarks.js";
import { showBoard } from "./board.js";
import { broughtOnce } from "./outbox.js";

function render({ model, el }) {
  const { words, name, board: projected, ...data } = model.get("about");
  speak(words);
  const [present, here, tools] = [made("p", { role: "status" }), made("div.board"), made("div.board-tools")];
  const link = made("a", { href: projected, target: "_blank", rel: "noreferrer" }, worded("The board for the projector"));
  const root = made("section.lsys-lesson.class-board", made("div.board-head", made("b", name), link, present), here, tools);
  root.setAttribute("aria-label", ownName(root, worded("class")));
  el.append(root);
  const waiting = new Map();
  const bring = (key) => new Promise((resolve, reject) => {
    waiting.set(key, (content) => (content === null ? reject(new Error(key)) : resolve(content)));
    tell({ want: JSON.parse(key) });
  });
  const brought = broughtOnce(bring);
  const tell = (message) => tellsKernel(model, message) || board.say(worded("The kernel does not answer. Run the cell again."));
  const board = showBoard({ here, present, tools }, data, {
    tell,
    asked: (kind, about, otherwise, arrived) => brought(JSON.stringify(["question", kind, about]), otherwise, arrived),
    plant: (number, arrived) => brought(JSON.stringify(["plant", number]), "", arrived),
  });

  function answered(message) {
    if (!message.wanted) return board.hear(message);
    const key = JSON.stringify(message.wanted), told = waiting.get(key);
    waiting.delete(key);
    told?.(message.content);
  }

  function show() {
    if ("present" in model.get("state")) board.hear({ state: model.get("state"), mistake: undefined });
    if (model.get("ended")) board.say(worded("The class has ended. Run the cell again, and it goes on where it was."));
  }

  model.on("msg:custom", answered);
  for (const trait of ["state", "ended"]) model.on(`change:${trait}`, show);
  onKey(root, board.keyed);
  const release = ownKeys(root);
  show();
  return () => {
    model.off("msg:custom", answered);
    for (const trait of ["state", "ended"]) model.off(`change:${trait}`, show);
    release();
    root.remove();
  };
}

export default { render };
