// What stands in the place of a page of the course that is being made: it says how many are there, and goes on when its own is.

const AGAIN = 2_000; // milliseconds before the page is asked for again
const MAKING = 503; // the server's answer as long as it is being made

export function openWaiting() {
  const said = document.getElementById("said");

  async function look() {
    try {
      const answer = await fetch(location.href, { cache: "no-store" });
      if (answer.status !== MAKING) return location.reload();
      const next = new DOMParser().parseFromString(await answer.text(), "text/html").getElementById("said")?.textContent;
      if (next && next !== said.textContent) said.textContent = next;
    } catch {
      // the server is gone for a while: it is asked again
    }
    setTimeout(look, AGAIN);
  }

  setTimeout(look, AGAIN);
}
