// The panel: a system's rules, word, stage diagram, drawing and counts, side by side, for one step.
//
// A book is sent for a setting of the constants (books/book.py): the states with their labels, what becomes of each or the words, how
// each is drawn, and the layout of the stage diagram. books/book.js turns its pages: words, counts, mothers and daughters of a step.
// Step, angle, view, mark and trace are turned here; only another setting, or other rules, ask the host for another book.
//
// A host says what is chosen (get, set, on), answers for books, rules and variants, and says what it can do (editable, keeps, ahead):
// Jupyter's kernel (panels/jupyter.js), or a page with its books inside (page.js). The panel listens to it, shows what is chosen in
// every view, and sets what a person moves; a view is given a parent and functions that hear of the person, and knows no host.
// A drawing goes from a word to shapes (filament, turtle, map, tissue), to where they are seen (projection), to paint (painter).
// Numbers that the kit's own pictures have too stand in drawing/constants.js, which is made.

import { library } from "../books/book.js";
import { clamped, times } from "../books/numbers.js";
import { themeOf, whenRecoloured } from "../drawing/colours.js";
import { drawingView } from "../drawing/drawing.js";
import { seedsView, variantsView } from "../drawing/gallery.js";
import { keeping, player } from "../views/bars.js";
import { button, eachFrame, list, made, ownKeys, slider, speak, worded } from "../views/controls.js";
import { countsView } from "../views/counts.js";
import { folding, moreOf, roving } from "../views/folding.js";
import { ownName } from "../views/landmarks.js";
import { letterSwitches } from "../views/letters.js";
import { motions } from "../views/motion.js";
import { netView } from "../views/net.js";
import { rulesView } from "../views/rules.js";
import { sentenceView } from "../views/sentence.js";
import { wordView } from "../views/word.js";
import { caption, code, litAt, placesOf, told } from "./telling.js";

const REST = 400; // milliseconds after which a movement has come to rest, and the kernel is told
const SLOW = 1000; // milliseconds after which an answer is said to be waited for
const ANGLES = times(1801, (i) => (i / 10).toString());
const DEGREES = (least, most) => times(most - least + 1, (i) => String(least + i));
const NAMED = [90, 60, 120, 45, 30]; // degrees that stand below the slider of the angle, where there is room for them
const MARKED = [...NAMED, 18, 22.5, 25.7, 36, 72, 108, 137.5, 144]; // and those at which it stops in any case
const SEEDS = DEGREES(0, 999);

// Of two panels beside each other `compared` has { bar, shared, shown(book, step) }: where the sliders of both are, or null in the
// second, and the names of the constants among them.
export function openPanel(element, host, compared = null) {
  const seen = new Proxy(/** @type {any} */ ({}), { get: (_, name) => host.get(name) }); // what is chosen, and the model
  speak(seen.model.words);
  const root = made("div.lsys-panel", { role: "region" });
  element.append(root);
  const offs = [], still = matchMedia("(prefers-reduced-motion: reduce)");
  let model, books, book, theme, resting = 0, asking = 0, typing = 0, idle = 0, wanted = seen.step, traced = null, pointed = null, shownTheme = "", boxed = null, underway = null, beside = null, reading = null, awaited = 0;
  let constants = [], switches, said;

  const status = made("div.lsys-status", { role: "status" }), sentence = made("div.lsys-sentence", { role: "status" });
  const message = made("div.lsys-message", { role: "alert", hidden: true }), patience = made("div.lsys-hint", { role: "status" });
  const step = slider("step", worded("the step of the derivation"), ["0"], 0, goTo, worded("step"));
  const angle = slider("angle", worded("degrees by which the turtle turns"), ANGLES, 900, (at) => move("angle", at), worded("angle"), { least: 50, pace: 10 });
  const side = (name, label, hint, most) => slider(name, hint, DEGREES(-most, most), most, (at) => change({ [name]: at - most }), label, { least: 5 });
  const around = side("around", worded("around"), worded("the side from which it is seen: 0 is the front, 90 the right"), 180);
  const above = side("above", worded("above"), worded("the height from which it is seen: 0 is the side, 90 the top"), 90);
  const mark = list("mark", worded("the stage that is marked in all views"), [["", worded("no stage")]], "", (name) => change({ mark: name }), worded("mark"));
  const scale = list("size", worded("one scale for all steps, or each step as large as it fits"), [["fit", worded("fit each step")], ["same", worded("one scale")]], "fit", () => show(), worded("size"));
  const seed = slider("seed", worded("the seed of the random numbers"), SEEDS, 0, (_, text) => host.set("seed", Number(text)), worded("seed"), { bar: false, whole: !seen.model.seeds?.length });
  const die = button("die", worded("another seed, at random"), () => sow(Number(seedTexts()[Math.floor(Math.random() * seedTexts().length)])));
  seed.element.append(die);
  const play = player(() => ({ now: seen.step, most: book.steps }), goTo, () => show());
  const reset = button(worded("reset"), worded("back to the first settings"), goBack);
  const bottom = made("div.lsys-controls"), views = made("div.lsys-views"), top = made("div.lsys-top", step.element, play.element);
  const titles = { rules: worded("rules"), word: worded("word"), stages: worded("stages"), drawing: worded("drawing"), ...motions?.titles(), counts: worded("how many"),
    seeds: worded("nine seeds"), variants: worded("nine variants") };
  const opening = seen.model.show ?? ["word", "drawing", ...(compared ? [] : ["stages"])];
  const atHand = ["rules", "seeds", ...(seen.model.show ?? ["word", "stages", "drawing"])];
  const { view, tabs, others } = folding(views, Object.entries(titles).map(([name, title]) => [name, title, opening.includes(name), atHand.includes(name)]), () => show());
  const large = button(worded("class"), worded("larger, for a projector"), () => {
    large.setAttribute("aria-pressed", String(root.classList.toggle("lsys-class")));
    show();
  }, { "aria-pressed": "false", class: "lsys-button lsys-tab" });
  const rules = rulesView(view.rules.body, newRules, () => seen.settings);
  const word = wordView(view.word.body, (position, way) => trace(seen.step, position, way, view.word), (position) => point({ step: seen.step, position }));
  const net = netView(view.stages.body, (place) => toggleMark(place), (place) => point({ place }), () => view.stages.enlarge());
  const motion = motions?.open(view, sentence, () => ({ ...sides(), book, traced, boxed, theme, asked: request(), turnTo, sow, sown: (seed) => books.book({ ...request(), seed }) }), trace, light, goTo);
  const drawing = drawingView(view.drawing.body, {
    ...motion,
    view: () => [seen.around, seen.above],
    front: () => [model.around, model.above],
    turned: (right, up) => change({ around: right, above: up }),
    traced: (at, position) => (at === null ? trace(seen.step, null, position) : trace(at, position)),
    pointed: (at, position) => point({ step: at, position }),
  });
  const counts = countsView(view.counts.body, goTo);
  const seeds = seedsView?.(view.seeds.body, sow, say), variants = variantsView?.(view.variants.body, (text) => rules.put(text), say);
  const kept = keeping(host, { canvas: drawing.canvas, file: () => book.data.file, code: () => code(seen, book, turns()), state: () => state() });
  const less = made("div.lsys-tabs", { role: "toolbar", "aria-label": worded("more views") }, ...others, large), ofSteps = compared && !compared.bar ? [] : play.tools;
  const more = moreOf(less, scale.element, mark.element, ...ofSteps, ...(compared ? [] : [kept]));
  const bar = made("div.lsys-tabs", { role: "toolbar", "aria-label": worded("views") }, ...tabs, more.opener), groups = [bar, less].map((group) => roving(group));
  top.append(bar);
  views.prepend(bottom, status);
  if (!compared) step.element.append(reset);
  root.append(top, more.element, message, patience, rules.offer, views);
  const shared = [step.element, play.element], turning = [angle.element, around.element, above.element];
  if (compared) compared.bar ? compared.bar.append(...shared) : [...shared, ...turning].forEach((each) => (each.hidden = true));

  // What happens.

  function goTo(at) {
    wanted = at;
    change({ step: at });
  }

  function move(name, at, text) {
    if (name === "angle") change({ angle: at / 10 });
    else host.set("settings", { ...seen.settings, [name]: text });
  }

  // Some settings of the browser's own: they are shown at once; the kernel is told when the movement has come to rest.
  function change(settings) {
    for (const [name, value] of Object.entries(settings)) host.set(name, value);
    rest();
  }

  function rest() {
    clearTimeout(resting);
    resting = setTimeout(() => host.save(), REST);
  }

  // Another setting of the constants, or another seed: another book.
  async function ask() {
    const asked = request(), number = ++asking;
    rest();
    root.ariaBusy = String(!books.known(asked)); // what is shown is still that of other settings
    if (!books.known(asked)) await underway; // a slider that moves on asks only for where it is when the kernel is free
    if (number !== asking) return; // another setting was asked for, or another model was opened
    underway = slow(books.book(asked));
    const answer = await underway;
    if (number !== asking) return;
    root.ariaBusy = "false";
    if (answer.mistake) return say(answer.mistake);
    turnTo(answer.book);
    clearTimeout(idle);
    if (host.ahead) idle = setTimeout(() => books.fetchAhead(request(), constants), REST);
  }

  const request = () => ({ constants: { ...seen.settings }, seed: seen.seed, letters: seen.letters });

  // An answer that takes long is said to be waited for.
  async function slow(answer) {
    const said = setTimeout(() => (patience.textContent = worded("Python is busy. What you asked for is shown as soon as it answers.")), SLOW);
    awaited += 1;
    const found = await answer;
    clearTimeout(said);
    if (!--awaited) patience.textContent = "";
    return found;
  }

  // Other rules, perhaps with settings that were theirs; while one text is read, only the last of those that follow is kept.
  async function newRules(text, settings) {
    const number = ++typing;
    root.ariaBusy = "true";
    await reading;
    if (number !== typing) return;
    reading = slow(host.rules(text, { ...settings, ...request().constants }));
    const answer = await reading;
    if (number !== typing) return;
    root.ariaBusy = "false";
    if (answer === null) return;
    root.toggleAttribute("data-stale", Boolean(answer.mistake)); // what is shown is still that of the rules before
    if (answer.mistake) rules.mistaken(answer.mistake); // otherwise the kernel has set another model
    else rules.understood();
  }

  // A book belongs to a model: what was asked about the one before is not shown.
  function openModel() {
    model = seen.model;
    root.setAttribute("aria-label", ownName(root, model.book.title ? `L-system ${model.book.title}` : model.book.file));
    root.removeAttribute("data-stale");
    asking += 1;
    root.ariaBusy = "false";
    books?.close();
    books = library(host);
    for (const each of constants) each.control.element.remove();
    constants = model.constants.map((each) => ({
      ...each,
      control: slider(each.name, each.hint, each.texts, each.index, (at, text) => move(each.name, at, text)),
    }));
    for (const { control, texts, index, name } of constants) control.offer(texts, Math.max(0, texts.indexOf(seen.settings[name])), [index]);
    switches = letterSwitches?.(host, constants);
    said = sentenceView?.(root, host, goTo, move);
    const tenths = (degrees) => [...new Set([...degrees, model.angle])].map((each) => Math.round(each * 10));
    angle.offer(ANGLES, Math.round(seen.angle * 10), tenths(MARKED), tenths(NAMED));
    const fixed = model.fixed ? [made("span.lsys-hint", model.fixed)] : [];
    const ofBoth = constants.filter((each) => compared?.shared.includes(each.name)), own = constants.filter((each) => !ofBoth.includes(each));
    compared?.bar?.append(...ofBoth.map((each) => each.control.element));
    bottom.replaceChildren(...own.map((each) => each.control.element), ...(turns() ? [angle.element] : []),
      ...(["space", "tissue"].includes(model.book.mode) ? [around.element, above.element] : []), ...(model.chance ? [seed.element] : []), ...(compared ? [reset] : []), ...fixed);
    seed.offer(seedTexts(), 0);
    showSeed();
    view.seeds.offer(model.chance);
    motion?.offer(model.book);
    view.variants.offer(host.editable && !["map", "tissue"].includes(model.book.mode));
    for (const group of groups) group.refresh();
    variants?.forget();
    const first = books.keep(model.asked, model.book);
    boxed = Math.min(model.step, first.steps);
    rules.open(model.book.text, host.editable, model.book.notes, model.first ?? model.book.text, model.standing);
    if (books.known(request())) turnTo(books.known(request()));
    else {
      turnTo(first);
      ask();
    }
  }

  function turnTo(next) {
    book = next;
    traced = pointed = null;
    theme = themeOf(root);
    shownTheme = JSON.stringify(theme);
    host.set("step", Math.min(wanted, book.steps)); // a setting with fewer steps does not forget which was wanted
    step.offer(DEGREES(0, book.steps), seen.step);
    mark.offer([["", worded("no stage")], ...book.data.net.places.map((place) => [place.name, place.name])], place(seen.mark) ? seen.mark : "");
    net.open(book.data.net, theme);
    drawing.open(book);
    counts.open(book);
    say(host.notice?.() ?? null); // a page may not hold all settings, and Python may have ended
    show();
  }

  const turns = () => model.book.turtle?.["uses angle"] && !model.without?.includes("angle");
  const place = (name) => book.data.net.places.find((each) => each.name === name);

  function toggleMark(number) {
    const { name } = book.data.net.places.find((each) => each.place === number);
    change({ mark: seen.mark === name ? "" : name });
  }

  function trace(at, position, way = 0, where = view.drawing) {
    beside = where;
    seat();
    if (position === null) {
      if (traced?.step !== at) traced = { step: at, position: way > 0 ? -1 : book.length(at) };
      position = clamped(0, book.length(at) - 1, traced.position + way);
    }
    traced = position < 0 || position >= book.length(at) ? null : { step: at, position };
    light();
    if (traced && at === seen.step) word.reveal(position);
  }

  // What is told of a part stands right below what it was pointed at in, or below a view that is open.
  function seat() {
    const above = [beside, view.drawing, view.word].find((each) => each?.open)?.body.firstChild ?? views.lastChild;
    if (sentence.previousSibling !== above) above.after(sentence);
  }

  // What the mouse is on, { step, position } or { place }, is lit until it leaves, unless something was chosen by a click.
  function point(at) {
    const next = at.position >= 0 || at.place >= 0 ? at : null;
    if (JSON.stringify(next) === JSON.stringify(pointed)) return;
    pointed = next;
    light();
  }

  const followed = () => traced ?? (pointed?.position >= 0 ? pointed : null);
  const chosen = () => place(seen.mark)?.place ?? pointed?.place ?? -1;

  // What is seen.

  function show() {
    if (!book) return;
    pointed = null;
    seat();
    const now = Math.min(seen.step, book.steps), tokens = book.tokens(now);
    step.show(now);
    angle.show(Math.round(seen.angle * 10));
    around.show(seen.around + 180);
    above.show(seen.above + 90);
    mark.show(seen.mark);
    said?.show(book, now);
    if (view.word.open) word.show(book, now);
    net.fill(tokens);
    counts.show(now);
    const kept = play.playing || scale.select.value === "same" ? boxed : null, looks = look();
    drawing.show({ ...sides(), step: now, boxed: kept, glides: play.playing && !still.matches }, looks);
    status.textContent = caption(book, now, view.stages.open ? tokens : null, drawing.measured());
    drawing.describe(`Drawing of ${status.textContent}`);
    lightAround(looks);
    if (view.seeds.open) seeds.show(books, request(), sides(), looks);
    if (view.variants.open) variants.show(host, sides(), looks);
    compared?.shown(book, now);
  }

  const sides = () => ({ step: seen.step, angle: seen.angle, around: seen.around, above: seen.above });

  const seedTexts = () => (model.seeds?.length ? model.seeds : SEEDS), showSeed = () => seed.find(String(seen.seed));

  function sow(number) {
    host.set("seed", number);
    showSeed();
  }

  function look() {
    const place = chosen(), now = seen.step, lit = (at) => litAt(book, followed(), at);
    const marked = new Set(book.data.states.flatMap((state, i) => (place >= 0 && state[2] === place ? [i] : [])));
    return { theme, marked, lit: lit(now), alone: litAt(book, traced, now), litAt: lit, current: now };
  }

  function light() {
    const looks = look();
    drawing.light(looks);
    lightAround(looks);
  }

  // Light what is marked and traced everywhere but in the drawing.
  function lightAround(looks) {
    const states = book.word(looks.current), traced = followed();
    word.light(looks.marked, looks.lit);
    const lit = new Set([...looks.lit.keys()].map((position) => book.data.states[states[position]][2]));
    net.light(place(seen.mark)?.place ?? -1, lit, pointed?.place ?? -1);
    rules.light(placesOf(book, traced));
    motion?.show();
    sentence.textContent = traced ? told(book, traced) : "";
  }

  function say(mistake) {
    message.hidden = !mistake;
    message.textContent = mistake ? `\u26a0 ${mistake.message}. ${mistake.hint ?? ""}` : "";
  }

  function goBack() {
    play.stop();
    traced = null;
    for (const each of constants) each.control.show(each.index);
    host.set("settings", Object.fromEntries(model.constants.map((each) => [each.name, each.texts[each.index]])));
    switches?.reset();
    sow(model.seed);
    drawing.home();
    wanted = model.step;
    change({ step: Math.min(wanted, book.steps), angle: model.angle, around: model.around, above: model.above, mark: "" });
  }

  const state = () => ({ ...request(), step: seen.step, angle: seen.angle, mark: seen.mark });

  // Listening.

  const later = eachFrame(show);
  offs.push(host.on("step", (at) => { if (at !== Math.min(wanted, book.steps)) wanted = at; }));
  for (const name of ["step", "angle", "around", "above", "mark"]) offs.push(host.on(name, later));
  offs.push(host.on("settings", () => {
    for (const each of constants) each.control.show(Math.max(0, each.texts.indexOf(seen.settings[each.name])));
    ask();
  }));
  offs.push(host.on("seed", () => { showSeed(); ask(); }));
  offs.push(host.on("letters", () => { switches?.show(); ask(); }));
  offs.push(host.on("model", openModel), host.on("gone", (text) => say({ message: text })));
  const recoloured = () => {
    if (!book || JSON.stringify(themeOf(root)) === shownTheme) return;
    if (root.clientWidth) turnTo(book);
    else again(); // Jupyter hides the page while it loads a theme, and nothing can be painted
  };
  const again = eachFrame(() => root.clientWidth && recoloured());
  offs.push(whenRecoloured(root, recoloured));
  offs.push(ownKeys(root));
  openModel();

  return { differ: word.differ, close };

  function close() {
    play.stop();
    motion?.stop();
    for (const off of offs) off();
    for (const timer of [resting, idle]) clearTimeout(timer);
    books.close();
    for (const each of [later, again]) each.cancel();
    drawing.close();
    rules.close();
    root.remove();
  }
}
