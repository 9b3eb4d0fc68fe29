// The learning platform, by the API of SCORM 1.2 (ADL, SCORM Run-Time Environment 1.2, sections 3.3 and 3.4): found in a window above
// this one, or in one that opened it.

const MOST_WINDOWS = 50;
const [LEAST, GREATEST] = ["0", "100"];
const MOST_CHARACTERS = 4096; // of what is kept

export function platformOf(own) {
  const above = [own];
  while (above.length < MOST_WINDOWS && above.at(-1).parent !== above.at(-1)) above.push(above.at(-1).parent);
  for (const each of above) {
    const api = apiOf(each) ?? (openerOf(each) && above.length < MOST_WINDOWS ? platformAbove(openerOf(each)) : null);
    if (api) return api;
  }
  return null;
}

function platformAbove(first) {
  for (let each = first, count = 0; count < MOST_WINDOWS; each = each.parent, count++) {
    const api = apiOf(each);
    if (api || each.parent === each) return api;
  }
  return null;
}

// Windows of other addresses do not let themselves be asked.
function apiOf(each) {
  try {
    return each.API && typeof each.API === "object" && "LMSInitialize" in each.API ? each.API : null;
  } catch {
    return null;
  }
}

function openerOf(each) {
  try {
    return each.opener;
  } catch {
    return null;
  }
}

// What the platform has kept, and what it is told. Without a platform nothing is told to anybody. What it has is never made less:
// nothing is written before something new was typed or solved, nor where it cannot be read.
export function connected(api) {
  const started = Date.now();
  let open = Boolean(api) && said(call("Initialize", "")), kept = null;

  // A platform that throws, or lacks a function, answers nothing.
  function call(name, ...given) {
    try {
      return api[`LMS${name}`](...given);
    } catch {
      return null;
    }
  }

  function get(name) {
    const value = call("GetValue", name), fault = String(call("GetLastError") ?? "");
    return value === null || !["", "0"].includes(fault) ? null : String(value ?? "");
  }

  const set = (name, value) => said(call("SetValue", name, value));

  // What there is: { solved, typed, score, completed }; null where it cannot be read.
  function known() {
    if (!open || kept) return kept;
    const found = ["cmi.suspend_data", "cmi.core.score.raw", "cmi.core.lesson_status"].map(get);
    if (found.includes(null)) return null;
    const [data, score, status] = found;
    return (kept = { ...answersIn(data), score: Number(score) || 0, completed: ["completed", "passed"].includes(status) });
  }

  // Keep what was typed, by exercise, and what was solved; `total` is the number of exercises, where one more was solved.
  function tell(typed, solved, total) {
    if (!known()) return false;
    const others = Object.entries(kept.typed).filter(([id]) => !(id in typed));
    const next = { ...kept, typed: { ...Object.fromEntries(others), ...typed }, solved: [...new Set([...kept.solved, ...solved])] };
    const told = [set("cmi.suspend_data", packed(next))];
    if (total) {
      next.score = Math.max(kept.score, scoreOf(solved.length, total));
      next.completed ||= solved.length === total;
      told.push(set("cmi.core.score.min", LEAST), set("cmi.core.score.max", GREATEST), set("cmi.core.score.raw", String(next.score)));
      if (!kept.completed) told.push(set("cmi.core.lesson_status", next.completed ? "completed" : "incomplete"));
    }
    told.push(said(call("Commit", "")));
    if (told.every(Boolean)) kept = next;
    return told.every(Boolean);
  }

  function finish() {
    if (!open) return;
    set("cmi.core.session_time", spanOf(Date.now() - started));
    set("cmi.core.exit", "suspend");
    call("Commit", "");
    call("Finish", "");
    open = false;
  }

  return { there: Boolean(api), isOpen: () => open, known, tell, finish };
}

const said = (answer) => String(answer) === "true";

const scoreOf = (solved, total) => Math.round((100 * solved) / total);

// What was typed and solved on another day; older pages have kept the ids of what was solved alone.
function answersIn(data) {
  try {
    const found = JSON.parse(data), { solved, typed } = Array.isArray(found) ? { solved: found } : found;
    const texts = Object.entries(typed ?? {}).filter(([, text]) => typeof text === "string");
    return { solved: (Array.isArray(solved) ? solved : []).filter((each) => typeof each === "string"), typed: Object.fromEntries(texts) };
  } catch {
    return { solved: [], typed: {} };
  }
}

// Both as a text for which the platform has room: what was typed longest ago is left out first.
function packed({ solved, typed }) {
  const texts = Object.entries(typed);
  let text;
  do {
    text = JSON.stringify({ solved, typed: Object.fromEntries(texts) });
  } while (text.length > MOST_CHARACTERS && texts.shift());
  return text;
}

// A span of time as SCORM writes it: 0000:05:12.
function spanOf(milliseconds) {
  const seconds = Math.floor(milliseconds / 1000), parts = [Math.floor(seconds / 3600) % 10000, Math.floor(seconds / 60) % 60, seconds % 60];
  return parts.map((part, number) => String(part).padStart(number ? 2 : 4, "0")).join(":");
}
