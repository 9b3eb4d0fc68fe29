// A picture whose stages can be chosen: by a click, or by Enter or the space bar on the stage that has the focus.

function render({ model, el }) {
  function show() {
    const focused = el.querySelector("[data-place]:focus");
    const place = focused ? focused.dataset.place : null;
    el.innerHTML = model.get("svg");
    for (const stage of el.querySelectorAll("[data-place]")) {
      stage.setAttribute("tabindex", "0");
      stage.setAttribute("role", "button");
      stage.style.cursor = "pointer";
      if (stage.dataset.place === place) stage.focus();
    }
  }

  function choose(event) {
    const stage = event.target.closest("[data-place]");
    if (!stage || (event.type === "keydown" && event.key !== "Enter" && event.key !== " ")) return;
    event.preventDefault();
    event.stopPropagation();
    const place = Number(stage.dataset.place);
    model.set("chosen", model.get("chosen") === place ? -1 : place);
    model.save_changes();
  }

  el.addEventListener("click", choose);
  el.addEventListener("keydown", choose);
  model.on("change:svg", show);
  show();
  return () => model.off("change:svg", show);
}

export default { render };
