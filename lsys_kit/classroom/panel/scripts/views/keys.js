// Keys and the mouse. Keys that are pressed in a panel are the panel's: a notebook that listens to the whole page would take the arrows for its cells.

const handlers = new WeakMap();

// What is to be done with keys while an element, or something in it, has the focus.
export function onKey(element, handler) {
  handlers.set(element, handler);
}

// Keep the keys of a panel from whoever else listens, but for those pressed together with Ctrl, Alt or the like. What the browser
// itself does with a key, as in sliders and lists, is not touched.
export function ownKeys(root) {
  const pressed = (event) => {
    if (!root.contains(event.target) || event.ctrlKey || event.metaKey || event.altKey) return;
    event.stopImmediatePropagation();
    for (let element = event.target; element && element !== root.parentElement; element = element.parentElement) {
      const handler = handlers.get(element);
      if (handler) return handler(event);
    }
  };
  window.addEventListener("keydown", pressed, true);
  return () => window.removeEventListener("keydown", pressed, true);
}

// Call a handler where the mouse moves over an element with no button pressed, once for each frame, and with null when it leaves.
// A finger does not point before it touches.
export function onMouse(element, handler) {
  let latest = null, waiting = 0;
  const later = (event) => {
    if (event && (event.pointerType !== "mouse" || event.buttons)) return;
    latest = event;
    waiting = waiting || requestAnimationFrame(() => {
      waiting = 0;
      if (element.isConnected) handler(latest);
    });
  };
  element.addEventListener("pointermove", later);
  element.addEventListener("pointerleave", () => later(null));
}
