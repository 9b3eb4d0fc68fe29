// A widget's script as Jupyter loads it, anew for each widget and for ever: it takes the real one from the page, where it is kept once.

const loaded = (/** @type {any} */ (globalThis).lsysKit ??= new Map());

// A module of a text, which the browser reads once.
function module(text) {
  if (!loaded.has(text)) {
    const address = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
    loaded.set(text, import(address).finally(() => URL.revokeObjectURL(address)));
  }
  return loaded.get(text);
}

function dress(sheet, text) {
  const known = document.getElementById(sheet);
  if (known?.textContent === text) return;
  const looks = document.createElement("style");
  looks.id = sheet;
  looks.textContent = text;
  known ? known.replaceWith(looks) : document.head.append(looks);
}

async function render(given) {
  const { model } = given, script = await model.widget_manager.get_model(model.get("_script").slice("IPY_MODEL_".length));
  dress(`lsys-${script.get("sheet")}`, script.get("style"));
  return (await module(script.get("script"))).default.render(given);
}

export default { render };
