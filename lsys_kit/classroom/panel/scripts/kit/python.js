// Python in a worker of the page, which answers one question after another. It is fetched and started when it is first asked, and ended
// and started anew where an answer takes too long. Nothing is sent anywhere: what is asked stays in the browser.

import { worded } from "../views/controls.js";
import { trusted } from "./trusted.js";

// `data` is what site/python.py says of it; `home` is the address of the site. `told` hears in which state it is, and more of that state:
// "fetching" with a part of 1, "starting", "ready", "ended" with the reason, "absent" with the reason.
export function pythonIn(data, home, told) {
  const waiting = [], whenReady = [];
  let worker = null, isReady = false, current = null, clock = 0;

  function start() {
    told("fetching", 0);
    try {
      worker = new Worker(trusted(`${home}${data.worker}`), { type: "module" });
    } catch {
      return fail(worded("Python starts only on pages of a web server, not on files: the README of the kit says how to serve a folder."));
    }
    worker.onmessage = ({ data: said }) => heard(said);
    worker.onerror = (event) => {
      event.preventDefault();
      if (isReady) broken(event.message);
      else fail(worded("{file} is missing, or this browser cannot run it.", { file: data.worker.split("?")[0] }));
    };
    worker.postMessage({ ...data, home: new URL(home, location.href).href });
  }

  function heard({ part, ready, answer, missing, fault }) {
    if (part !== undefined) {
      if (current) watch();
      else told(part < 1 ? "fetching" : "starting", part);
    }
    if (missing) fail(worded("{file} is missing ({status}).", missing));
    else if (fault) broken(fault);
    else if (ready) {
      isReady = true;
      told("ready");
      for (const act of whenReady.splice(0)) act();
    } else if (answer) {
      clearTimeout(clock);
      const { done } = current;
      current = null;
      done(answer);
    }
    next();
  }

  function next() {
    if (!isReady || current || !waiting.length) return;
    current = waiting.shift();
    worker.postMessage({ ask: JSON.stringify(current.question) });
    watch();
  }

  function watch() {
    clearTimeout(clock);
    clock = setTimeout(() => again(worded("This takes too long, and Python was ended"), worded("Take fewer steps, or simpler rules.")), 1000 * data.patience);
  }

  function end() {
    clearTimeout(clock);
    worker?.terminate();
    [worker, isReady] = [null, false];
  }

  // The question that Python did not survive is answered so; all others are asked of another one.
  function again(message, hint) {
    const { done } = current;
    current = null;
    end();
    done({ mistake: { message, hint } });
    start();
    told("ended", message);
  }

  const broken = (fault) => (current ? again(worded("Python broke off"), fault) : fail(fault));

  function fail(why) {
    end();
    told("absent", why);
    const asked = [...(current ? [current] : []), ...waiting.splice(0)];
    current = null;
    for (const { done } of asked) done({ mistake: { message: worded("Python cannot start in this page"), hint: why } });
  }

  const begin = () => worker ?? start();
  return {
    begin,
    whenReady: (act) => (isReady ? act() : whenReady.push(act)),
    ask: (question) => new Promise((done) => {
      waiting.push({ question, done });
      begin();
      next();
    }),
  };
}
