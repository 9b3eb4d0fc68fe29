// What stands in the place of a page of the course that is being made: it says how many are there, and goes on when its own is.

import { speak, worded } from "../views/controls.js";

const AGAIN = 2_000; // milliseconds before the page is asked for again
const MAKING = 503; // the server's answer as long as it is being made

export function openWaiting() {
  speak(JSON.parse(document.getElementById("lsys-data").textContent).words);
  const progress = document.getElementById("progress");

  async function look() {
    const answer = await fetch(location.href, { cache: "no-store" }).catch(() => null); // a server that is gone for a while is asked again
    if (answer && answer.status !== MAKING) return location.reload();
    const [made, many] = (answer?.headers.get("Pages-Made") ?? "").split("/");
    if (many) progress.textContent = worded("Pages of the course that are there: {made} of {many}.", { made, many });
    setTimeout(look, AGAIN);
  }

  look();
}
