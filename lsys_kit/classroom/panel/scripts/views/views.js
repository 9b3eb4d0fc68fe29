// The views side by side: each can be folded away or fill the screen; in a class everything is larger.

import { made, button } from "./controls.js";
import { worded } from "./language.js";

// `views` are triples of a name, a title and whether the view is open at first. Of each its body is returned, whether it is open,
// and `offer`, which says whether there is anything to show in it.
export function folding(parent, root, views, changed) {
  const found = {}, tabs = made("div.lsys-tabs", { role: "group", "aria-label": worded("views") });
  for (const [name, title, open] of views) {
    const body = made("div.lsys-body");
    const section = made("section.lsys-view", { "data-view": name, "aria-label": title, hidden: !open });
    const tab = button(title, worded("show or hide: {title}", { title }), () => {
      section.hidden = !section.hidden;
      tab.setAttribute("aria-pressed", String(!section.hidden));
      changed();
    }, { "aria-pressed": String(open), class: "lsys-button lsys-tab" });
    const wide = button("wide", worded("{title} on the whole screen", { title }), () => (document.fullscreenElement ? document.exitFullscreen() : section.requestFullscreen()));
    section.append(made("div.lsys-title", title, wide), body);
    parent.append(section);
    tabs.append(tab);
    found[name] = {
      body,
      get open() { return !section.hidden; },
      offer(offered) {
        tab.hidden = !offered;
        if (!offered) section.hidden = true;
        tab.setAttribute("aria-pressed", String(!section.hidden));
      },
    };
  }
  const large = button(worded("class"), worded("larger, for a projector"), () => {
    large.setAttribute("aria-pressed", String(root.classList.toggle("lsys-class")));
    changed();
  }, { "aria-pressed": "false", class: "lsys-button lsys-tab" });
  tabs.append(large);
  parent.before(tabs);
  return found;
}
