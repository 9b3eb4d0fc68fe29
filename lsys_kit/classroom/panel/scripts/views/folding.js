// What is at hand: tabs that show or hide the views, a button that lets one fill the screen, and "more", behind which stands what few
// need. Buttons that belong together are one stop of the Tab key. What a person has chosen or seen once, the browser remembers.

import { button, freshId, made, onKey, worded } from "./controls.js";

const MEMORY = "lsys-kit-";

// What was remembered of a name, or null; where the browser keeps nothing, nothing is.
export function remembered(name) {
  try {
    return localStorage.getItem(MEMORY + name);
  } catch {
    return null;
  }
}

export function remember(name, text) {
  try {
    localStorage.setItem(MEMORY + name, text);
  } catch { /* it is forgotten with the page */ }
}

const WAYS = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 };

// Make the buttons of a group one stop of the Tab key; arrow keys, Home and End go from one to another. Given back are what does
// that with a key, and `refresh`, for when the button at which Tab stops may have been hidden.
export function roving(group, what = "button") {
  const all = () => [...group.querySelectorAll(what)], offered = () => all().filter((each) => !each.hasAttribute("hidden"));
  const stopAt = (one) => all().forEach((each) => each.setAttribute("tabindex", each === one ? "0" : "-1"));

  function press(event) {
    const each = offered(), at = each.indexOf(event.target.closest(what)), way = WAYS[event.key];
    const next = at < 0 ? null : way ? each[(at + way + each.length) % each.length] : { Home: each[0], End: each.at(-1) }[event.key];
    if (!next) return;
    event.preventDefault();
    next.focus();
  }

  function refresh() {
    const each = offered();
    stopAt(each.find((one) => one.getAttribute("tabindex") === "0") ?? each[0]);
  }

  onKey(group, press);
  group.addEventListener("focusin", (event) => all().includes(event.target) && stopAt(event.target));
  stopAt(offered()[0]);
  return { press, refresh };
}

// `views` are a name, a title, whether the view is open at first, and whether its tab is at hand. Of each its body is returned,
// whether it is open, `enlarge`, which lets it fill the screen, and `offer`, which says whether there is anything to show in it;
// further the tabs at hand, and the others.
export function folding(parent, views, changed) {
  const found = {}, tabs = [], others = [];
  for (const [name, title, open, atHand] of views) {
    const body = made("div.lsys-body");
    const section = made("div.lsys-view", { role: "group", "data-view": name, "aria-label": title, hidden: !open });
    const tab = button(title, worded("show or hide: {title}", { title }), () => {
      section.hidden = !section.hidden;
      tab.setAttribute("aria-pressed", String(!section.hidden));
      changed();
    }, { "aria-pressed": String(open), class: "lsys-button lsys-tab" });
    const wide = button("wide", worded("{title} on the whole screen", { title }), () => enlarge(section));
    section.append(made("div.lsys-title", title, wide), body);
    parent.append(section);
    (atHand ? tabs : others).push(tab);
    found[name] = {
      body,
      get open() { return !section.hidden; },
      enlarge: () => enlarge(section),
      offer(offered) {
        tab.hidden = !offered;
        if (!offered) section.hidden = true;
        tab.setAttribute("aria-pressed", String(!section.hidden));
      },
    };
  }
  return { view: found, tabs, others };
}

// Let a part fill the screen, or put it back; where a browser cannot, as on small phones, it fills the window.
function enlarge(section) {
  if (document.fullscreenEnabled) return document.fullscreenElement ? document.exitFullscreen() : section.requestFullscreen();
  if (!section.hasAttribute("popover")) {
    section.setAttribute("popover", "auto"); // as which it is hidden while it is not open
    section.addEventListener("toggle", ({ newState }) => newState === "closed" && section.removeAttribute("popover"));
  }
  section.togglePopover();
}

// A button, and what it shows or hides; whether it does is remembered.
export function moreOf(...parts) {
  const id = freshId(), open = remembered("more") === "open";
  const element = made("div.lsys-more", { id, role: "group", "aria-label": worded("more tools"), hidden: !open }, ...parts);
  const opener = button(worded("more"), worded("more views and tools"), () => {
    element.hidden = !element.hidden;
    opener.setAttribute("aria-expanded", String(!element.hidden));
    remember("more", element.hidden ? "" : "open");
  }, { "aria-expanded": String(open), "aria-controls": id, class: "lsys-button lsys-tab lsys-opener" });
  return { element, opener };
}
