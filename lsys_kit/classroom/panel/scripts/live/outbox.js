// What a phone says to its class, and what it hears: kept in the phone's own storage until the server has kept it, and sent again
// after whatever broke the connection, under the same number, so that it counts once.

const PATIENCE = 5_000; // milliseconds after which a server that acknowledges nothing is taken to be gone
const SOONEST = 400, LATEST = 6_000; // milliseconds before a connection is tried again, at first and at last
const MOST_KEPT = 200; // so many messages wait at most
const STRIDE = 1_000; // numbers of messages are drawn at random from so many, so that two tabs take different ones

// What the browser keeps; where it keeps nothing, as long as the page is open.
function storage() {
  const here = new Map();
  const safely = (use, otherwise) => {
    try {
      return use();
    } catch {
      return otherwise();
    }
  };
  return {
    get: (name) => here.get(name) ?? safely(() => localStorage.getItem(name), () => null),
    set(name, value) {
      safely(() => localStorage.setItem(name, value), () => here.set(name, value));
    },
  };
}

const kept = storage();

function read(name, otherwise) {
  try {
    return JSON.parse(kept.get(name)) ?? otherwise;
  } catch {
    return otherwise;
  }
}

// The random number of this phone, which is all that a class knows of it.
export function phoneNumber() {
  const name = "lsys-class-phone", known = kept.get(name);
  if (/^[0-9a-f]{32}$/.test(known ?? "")) return known;
  const made = Array.from(crypto.getRandomValues(new Uint8Array(16)), (each) => each.toString(16).padStart(2, "0")).join("");
  kept.set(name, made);
  return made;
}

// The next number of a message of this phone.
export function nextNumber(code) {
  const name = `lsys-class-${code}-sent`, next = read(name, 0) + 1 + Math.floor(Math.random() * STRIDE);
  kept.set(name, String(next));
  return next;
}

// A connection to the class at an address, as "/ABCD/". `heard` has state(state), linked(isThere), and told(message, answer), which is
// called when a message was kept or refused.
export function classConnection(base, code, heard) {
  const phone = phoneNumber(), name = `lsys-class-${code}-outbox`;
  let socket = null, wait = SOONEST, silent = 0, again = 0, closed = false;
  const waiting = () => read(name, []);
  const keep = (messages) => kept.set(name, JSON.stringify(messages.slice(-MOST_KEPT)));
  const isOpen = () => socket?.readyState === WebSocket.OPEN;

  function connect() {
    clearTimeout(again);
    if (closed || socket) return;
    const place = new URL(`${base}live?phone=${phone}`, location.href);
    place.protocol = place.protocol === "https:" ? "wss:" : "ws:";
    const opened = (socket = new WebSocket(place));
    silent = setTimeout(() => leave(opened), PATIENCE);
    opened.addEventListener("open", () => {
      clearTimeout(silent);
      wait = SOONEST;
      heard.linked(true);
      waiting().forEach(send);
    });
    opened.addEventListener("message", ({ data }) => hear(JSON.parse(data)));
    opened.addEventListener("close", () => gone(opened));
  }

  // A network that is gone does not say so.
  function leave(which) {
    if (socket !== which) return;
    which.close();
    gone(which);
  }

  function gone(which) {
    if (socket !== which) return;
    socket = null;
    clearTimeout(silent);
    heard.linked(false);
    if (closed) return;
    again = setTimeout(connect, wait * (0.5 + Math.random()));
    wait = Math.min(LATEST, wait * 2);
  }

  function send(message) {
    if (!isOpen()) return;
    socket.send(JSON.stringify(message));
    expect();
  }

  function expect() {
    clearTimeout(silent);
    const asked = socket;
    silent = setTimeout(() => waiting().length && leave(asked), PATIENCE);
  }

  function hear(answer) {
    if (answer.state) heard.state(answer.state);
    const number = answer.kept ?? answer.refused;
    if (answer.later) setTimeout(() => waiting().filter(({ sent }) => sent === answer.later).forEach(send), 1_500);
    const message = waiting().find(({ sent }) => sent === (number ?? answer.later));
    if (number) keep(waiting().filter(({ sent }) => sent !== number));
    if (!waiting().length) clearTimeout(silent);
    if (message) heard.told(message, answer);
  }

  const hurry = () => {
    if (document.visibilityState === "hidden" || isOpen()) return;
    wait = SOONEST;
    connect();
  };
  addEventListener("online", hurry);
  document.addEventListener("visibilitychange", hurry);
  connect();

  return {
    waiting,
    tell(kind, about, round, value, more = {}) {
      const message = { sent: nextNumber(code), kind, about, round, value, ...more };
      keep([...waiting(), message]);
      send(message);
      return message.sent;
    },
    close() {
      closed = true;
      socket?.close();
    },
  };
}

// A function that has things brought once: it returns what is known by a name, or else something in its place, and calls `arrived`
// when it is known. What cannot be brought is asked for again later.
export function broughtOnce(bring) {
  const known = new Map();
  return (name, otherwise, arrived) => {
    if (!known.has(name)) {
      known.set(name, otherwise);
      bring(name).then(
        (found) => {
          known.set(name, found);
          arrived();
        },
        () => setTimeout(() => {
          known.delete(name);
          arrived();
        }, PATIENCE),
      );
    }
    return known.get(name);
  };
}

const fetched = broughtOnce((place) => fetch(place).then((answer) => (answer.ok ? answer.json() : Promise.reject(new Error(String(answer.status))))));

// What a question asks.
export const whatIsAsked = (kind, about, otherwise, arrived) => fetched(`/asked/${kind}/${about}`, otherwise, arrived);

// Ask the kit itself, on the server: what it answers, or a mistake.
export async function askKit(base, question) {
  try {
    const answer = await fetch(`${base}ask`, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify({ phone: phoneNumber(), ...question }),
      signal: AbortSignal.timeout(20_000) });
    if (answer.ok) return await answer.json();
  } catch {
    // said below
  }
  return { mistake: { message: "The class does not answer", hint: "Try it again when the connection is back." } };
}
