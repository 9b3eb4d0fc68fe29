// The panel as a widget of Jupyter.

import { hostOf } from "./panels/jupyter.js";
import { openPanel } from "./panels/panel.js";

function render({ model, el }) {
  const { host, leave } = hostOf(model), panel = openPanel(el, host);
  return () => {
    panel.close();
    leave();
  };
}

export default { render };
