// The unfolding: one slider from a step to the next, on which every module becomes its successor in place; the word, whose letters part;
// and the tokens, which run along their arcs. Where it is asked for, one rule is applied after another.

import { hasOrder, isSequential, oneAfterAnother } from "../books/sequential.js";
import { clamped, times } from "../books/numbers.js";
import { paintDividing } from "../drawing/dividing.js";
import { unfoldedShapes } from "../drawing/unfolded.js";
import { button, face, list, made, slider, worded } from "./controls.js";
import { roving } from "./folding.js";
import { runTokens } from "./tokens.js";
import { labelled } from "./word.js";

const PARTS = times(101, String); // hundredths of the way
const PACE = 5; // hundredths that an arrow key goes on
const SPEEDS = ["6", "3", "1.5"]; // seconds from a step to the next
const STILLS = 4; // with reduced motion so many pictures of a step
const MOST_LETTERS = 150, MOST = 50_000; // modules of which the word is shown, and of which the drawing unfolds

// `seen` says what there is: { book, step, angle, boxed }; `light` shows it again, and `goTo` goes to a step; with `turnTo`, another book
// is shown.
export function unfoldingView(view, stages, seen, light, goTo) {
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  let part = 0, shown = "", known = null, frame = 0, last = 0, seconds = Number(SPEEDS[1]), groups = [], together = null, arrived = false;
  const bar = slider("unfolding", worded("hundredths of the way from this step to the next"), PARTS, 0, (at) => {
    stop();
    if (arrived) return bar.show(0);
    arrived = at === PARTS.length - 1;
    put(at / 100);
  }, worded("unfolding"), { pace: PACE, least: 1 });
  // What is dragged to the next step stays there until it is let go: otherwise the mouse at the end would run through all steps.
  for (const each of ["pointerdown", "keydown", "click"]) bar.element.addEventListener(each, () => { arrived = false; }, true);
  const play = button("play", worded("let it unfold"), toggle, { class: "lsys-button lsys-play" });
  const speed = list("unfolds", worded("seconds from a step to the next"), SPEEDS.map((each) => [each, each]), SPEEDS[1], (each) => { seconds = Number(each); }, worded("seconds"));
  const player = made("div.lsys-player", { role: "toolbar", "aria-label": worded("let it unfold") }, play);
  const said = made("div.lsys-caption", { role: "status" }), word = made("div.lsys-word", { "aria-hidden": "true" });
  const hint = worded("as a program does that works rule after rule"), order = button(worded("one rule after another"), hint, () => {
    const { book, step, turnTo } = seen(), back = isSequential(book);
    if (!back) together = book;
    turnTo(back ? together : oneAfterAnother(book));
    goTo(back ? Math.floor(step / book.data.program.length) : 0);
  });
  const parts = [made("div.lsys-controls", player, bar.element, speed.element, order), said, word];
  roving(player);

  const most = ({ book }) => book.steps;

  function present() {
    const found = seen();
    return { ...found, step: Math.min(found.step, found.book.steps) };
  }

  const canUnfold = ({ book, step }) => step < book.steps && book.length(step + 1) <= MOST;

  // What is all the way is the next step at its beginning.
  function put(to) {
    const now = present();
    part = canUnfold(now) ? clamped(0, 1, to) : 0;
    if (part < 1) return light();
    part = 0;
    goTo(now.step + 1);
  }

  function toggle() {
    if (frame) return stop();
    if (!canUnfold(present())) goTo(0);
    last = 0;
    said.setAttribute("aria-live", "off");
    face(play, "pause", worded("pause"));
    frame = requestAnimationFrame(run);
  }

  function run(time) {
    frame = requestAnimationFrame(run);
    const way = last ? (time - last) / 1000 / seconds : 0;
    if (last && still.matches && way < 1 / STILLS) return;
    last = time;
    put(part + way);
    if (!canUnfold(present())) stop();
  }

  function stop() {
    if (!frame) return;
    cancelAnimationFrame(frame);
    frame = 0;
    said.setAttribute("aria-live", "polite");
    face(play, "play", worded("let it unfold"));
  }

  function show() {
    const now = present(), { book, step } = now, key = `${step} ${part}`;
    if (!view.open) stop();
    if (stages.open) runTokens(stages.body, book, step, view.open && known === book && shown.startsWith(`${step} `) && canUnfold(now) ? part : 0);
    if (known !== book || !shown.startsWith(`${step} `)) part = 0;
    if (!view.open || (known === book && shown === key)) return;
    if (!said.isConnected) view.body.prepend(...parts); // it is opened for the first time
    if (known !== book || !shown.startsWith(`${step} `)) openWord(now);
    [known, shown] = [book, `${step} ${part}`];
    order.hidden = !isSequential(book) && !hasOrder(book);
    order.setAttribute("aria-pressed", String(isSequential(book)));
    bar.show(Math.round(100 * part));
    said.textContent = step === most(now) ? worded("This is the last step that is here.")
      : !canUnfold(now) ? worded("Step {step} is too large to be seen to unfold; go back to an earlier step.", { step: step + 1 })
      : isSequential(book) ? worded("{part} of 100 of {line}.", { part: Math.round(100 * part), line: book.data.doing[step] })
      : worded("{part} of 100 on the way from step {step} to step {next}.", { part: Math.round(100 * part), step, next: step + 1 });
    for (const { element, mother, daughters, widths } of groups) {
      const wide = (1 - part) * widths[0] + part * widths[1];
      element.style.width = `${wide}px`;
      Object.assign(mother.style, { translate: `0 ${-50 * part}%`, opacity: 1.5 - 2 * part }); // it leaves upwards
      Object.assign(daughters.style, { translate: `0 ${50 * (1 - part)}%`, opacity: 2 * part - 0.5, scale: `${wide / (widths[1] || 1)} 1` });
    }
  }

  // Each module with what it becomes, one upon the other; a module that stays is seen once.
  function openWord(now) {
    const { book, step } = now;
    groups = [];
    word.replaceChildren();
    word.hidden = !canUnfold(now) || book.length(step + 1) > MOST_LETTERS;
    if (word.hidden) return;
    for (let first = 0, next = 1; first < book.length(step); first = next++) {
      const [from, to] = book.daughters(step, first);
      while (next < book.length(step) && from !== to && book.daughters(step, next)[0] === from) next++;
      const before = book.word(step).subarray(first, next), after = book.word(step + 1).subarray(from, to), same = before.join() === after.join();
      const [mother, daughters] = [before, same ? [] : after].map((states) => made("span", { style: "position: absolute; left: 0; transform-origin: left; white-space: nowrap" }, ...chips(book, states)));
      const element = made("span", { style: "display: inline-block; position: relative; height: 1.8em; vertical-align: bottom" }, mother, daughters);
      word.append(element);
      if (same) mother.style.position = "static";
      else groups.push({ element, mother, daughters, widths: [0, 0] });
    }
    for (const each of groups) each.widths = [each.mother, each.daughters].map((part) => part.getBoundingClientRect().width);
  }

  function chips(book, states) {
    return Array.from(states, (state) => {
      const label = book.label(state), element = made(label.steering ? "span.lsys-steering" : "span.lsys-module", ...labelled(label));
      if (label.colour) element.style.setProperty("--symbol", label.colour);
      return element;
    });
  }

  // Whether a part of the way is to be seen.
  const isUnfolding = () => view.open && known === seen().book && part > 0;

  return {
    show, stop,
    // The shapes of what is to be seen of the turtle's drawing; null where the walk, or another step, is.
    between({ step, angle }) {
      const { book } = seen();
      return view.open && book.data.turtle && step < book.steps ? unfoldedShapes(book, step, angle, isUnfolding() ? part : 0) : null;
    },
    paint(pen, sheet, look) {
      if (!isUnfolding()) return false;
      const { book, step, boxed } = present();
      paintDividing(pen, sheet, look, book, step, part, boxed);
      return true;
    },
  };
}
