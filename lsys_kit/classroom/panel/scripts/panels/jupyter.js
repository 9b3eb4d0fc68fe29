// The host of a panel in Jupyter: the model that the kernel keeps. The kernel answers by numbered messages.

import { hasKernel, saved, tellsKernel, whenGone } from "./kernel.js";

const PATIENCE = 20_000; // milliseconds after which a kernel that does not answer, and is not busy, is taken to be gone
const GONE = { message: "The kernel does not answer. Restart it and run the cell again; what the panel has already shown goes on working" };

export function hostOf(model) {
  const waiting = new Map();
  let last = Math.floor(Math.random() * 1e9); // two views of one model hear each other's answers

  function answered(content) {
    waiting.get(content.number)?.(content);
    waiting.delete(content.number);
  }

  function ask(content) {
    const number = ++last;
    return new Promise((resolve) => {
      waiting.set(number, resolve);
      if (!tellsKernel(model, { ...content, number })) answered({ number, mistake: GONE });
      else expect(number);
    });
  }

  // A kernel that is busy with something else will answer in the end.
  function expect(number) {
    setTimeout(() => {
      if (!waiting.has(number)) return;
      if (model.widget_manager?.kernel?.status === "busy") expect(number);
      else answered({ number, mistake: GONE });
    }, PATIENCE);
  }

  // One that was restarted has forgotten all that it was asked.
  function forgotten() {
    if (model.comm_live === false) for (const number of [...waiting.keys()]) answered({ number, mistake: GONE });
  }

  model.on("msg:custom", answered);
  model.on("comm_live_update", forgotten);
  const host = {
    get: (name) => model.get(name),
    set: (name, value) => model.set(name, value),
    on(name, handler) {
      if (name === "gone") return whenGone(model, () => handler(GONE.message));
      const heard = () => handler(model.get(name));
      model.on(`change:${name}`, heard);
      return () => model.off(`change:${name}`, heard);
    },
    save: () => saved(model),
    notice: () => (hasKernel(model) ? null : GONE),
    book: (settings) => ask({ kind: "book", ...settings }),
    rules: (text, constants) => ask({ kind: "rules", text, constants }),
    variants: () => ask({ kind: "variants" }),
    keep: (kind, state) => ask({ kind: "keep", what: kind, state }),
    keeps: ["svg", "page", "link"],
    editable: true, ahead: true,
  };
  return { host, leave() {
    model.off("msg:custom", answered);
    model.off("comm_live_update", forgotten);
  } };
}
