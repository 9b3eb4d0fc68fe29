// The kernel behind a widget's model, which may have gone: Jupyter's own code then writes an error into the browser's console
// whenever something is to be told to it.

const GONE = ["dead", "terminating", "restarting", "autorestarting"];
const lost = new WeakSet(); // the models that were told so

// Listen for its end, and be told at once; given back is what ends that.
export function whenGone(model, handler = () => {}) {
  const heard = () => {
    lost.add(model);
    handler();
  };
  model.on("comm_live_update", heard);
  return () => model.off("comm_live_update", heard);
}

// Whether there is one; a host that does not say is taken to have one.
export function hasKernel(model) {
  const kernel = model.widget_manager?.kernel;
  return !lost.has(model) && kernel !== null && !kernel?.isDisposed && !GONE.includes(kernel?.status);
}

// Whether a message left: Jupyter throws where a kernel has been shut down and the model was not told.
export function tellsKernel(model, content) {
  if (!hasKernel(model)) return false;
  try {
    model.send(content);
  } catch {
    return false;
  }
  return true;
}

// Tell it what was set in the model; whether that was possible.
export function saved(model) {
  if (!hasKernel(model)) return false;
  try {
    model.save_changes();
  } catch { // Jupyter throws where a kernel has been shut down and nothing has heard of it yet
    return false;
  }
  return true;
}
