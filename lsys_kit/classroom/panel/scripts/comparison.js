// Two panels as one widget of Jupyter; each has a model of its own, as if it stood alone.

import { openComparison } from "./panels/compare.js";
import { hostOf } from "./panels/jupyter.js";

async function render({ model, el }) {
  const found = await Promise.all(["left", "right"].map((side) => model.widget_manager.get_model(model.get(side).slice("IPY_MODEL_".length))));
  const hosts = found.map(hostOf), close = openComparison(el, hosts.map(({ host }) => host), model.get("shared"));
  return () => {
    close();
    for (const { leave } of hosts) leave();
  };
}

export default { render };
