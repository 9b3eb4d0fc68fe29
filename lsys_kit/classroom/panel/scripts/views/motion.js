// What a panel shows of how things come about: the walk of the turtle, and the unfolding of a step. A page that asks for neither has none
// of this.

import { unfoldingView } from "./unfolding.js";
import { walkView } from "./walk.js";
import { worded } from "./controls.js";

// As the panel gives what there is to be seen, `trace`, `light` and `goTo` to the views; given back are also two ways for a drawing, one that
// paints in place of its own, and one that gives other shapes.
function open(view, sentence, seen, trace, light, goTo) {
  const walk = walkView?.(view.walk, sentence, seen, trace, light), unfolding = unfoldingView?.(view.unfolding, seen, light, goTo), both = [walk, unfolding].filter(Boolean);
  return {
    over: (pen, shapes, frame, look) => (frame ? walk?.paint(pen, shapes, frame, look) : unfolding?.paint(pen, shapes, look)),
    between: (now) => unfolding?.between(now) ?? null,
    show: () => both.forEach((each) => each.show()),
    stop: () => both.forEach((each) => each.stop()),
    offer({ turtle, mode }) {
      view.walk.offer(walk && turtle);
      view.unfolding.offer(unfolding && (turtle || mode === "filament"));
    },
  };
}

export const motions = { open, titles: () => ({ walk: worded("walk"), unfolding: worded("unfolding") }) };
