// The site without a network, and as an app: a service worker of the browser keeps it (service_worker.js).

import { trusted } from "./trusted.js";

// Have the pages of the site kept. The answer comes when they are: a function that has Python kept, too, and tells whether it is; null
// where the browser keeps none, as it does of files, and of servers whose answers anybody could forge on the way.
export async function keepOffline(home) {
  try {
    await navigator.serviceWorker.register(trusted(`${home}service_worker.js`), { updateViaCache: "none" });
    const { active } = await navigator.serviceWorker.ready;
    const keepPython = () => new Promise((done) => {
      const { port1, port2 } = new MessageChannel();
      port1.onmessage = ({ data }) => done(data);
      active.postMessage("python", [port2]);
    });
    addEventListener("appinstalled", keepPython);
    if (matchMedia("(display-mode: standalone)").matches) keepPython();
    return keepPython;
  } catch {
    return null;
  }
}
