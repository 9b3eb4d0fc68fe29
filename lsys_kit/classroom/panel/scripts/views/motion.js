// What a panel shows of how things come about: the walk of the turtle, the unfolding of a step, and a sample. A page that asks for none of
// them has none of this.

import { sampleView } from "./sample.js";
import { unfoldingView } from "./unfolding.js";
import { walkView } from "./walk.js";
import { worded } from "./controls.js";

// As the panel gives what there is to be seen, `trace`, `light` and `goTo` to the views; given back are also two ways for a drawing, one that
// paints in place of its own, and one that gives other shapes.
function open(view, sentence, seen, trace, light, goTo) {
  const walk = walkView?.(view.walk, sentence, seen, trace, light), unfolding = unfoldingView?.(view.unfolding, view.stages, seen, light, goTo), sample = sampleView?.(view.sample, seen), all = [walk, unfolding, sample].filter(Boolean);
  return {
    over: (pen, shapes, frame, look) => (frame ? walk?.paint(pen, shapes, frame, look) : unfolding?.paint(pen, shapes, look)),
    between: (now) => unfolding?.between(now) ?? null,
    show: () => all.forEach((each) => each.show()),
    stop: () => all.forEach((each) => each.stop()),
    offer({ turtle, mode, chance }) {
      view.walk.offer(walk && turtle);
      view.sample.offer(sample && chance);
      view.unfolding.offer(unfolding && (turtle || mode === "filament"));
    },
  };
}

export const motions = { open, titles: () => ({ walk: worded("walk"), unfolding: worded("unfolding"), sample: worded("sample") }) };
