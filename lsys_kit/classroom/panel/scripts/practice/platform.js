// The learning platform, by the API of SCORM 1.2 (ADL, SCORM Run-Time Environment 1.2, sections 3.3 and 3.4): found in a window above
// this one, or in one that opened it.

const MOST_WINDOWS = 50;
const [LEAST, GREATEST] = ["0", "100"];

// The platform's API; null where there is none.
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

// What the platform is told, and asked at the beginning. Without a platform nothing is told to anybody.
export function connected(api) {
  const started = Date.now();
  let open = Boolean(api) && said(api.LMSInitialize(""));
  const get = (name) => (open ? String(api.LMSGetValue(name) ?? "") : "");
  const set = (name, value) => said(api.LMSSetValue(name, value));

  function tell(solved, total) {
    if (!open) return false;
    const told = [
      set("cmi.core.score.min", LEAST), set("cmi.core.score.max", GREATEST),
      set("cmi.core.score.raw", String(scoreOf(solved.length, total))),
      set("cmi.core.lesson_status", solved.length === total ? "completed" : "incomplete"),
      set("cmi.suspend_data", JSON.stringify(solved)), said(api.LMSCommit("")),
    ];
    return told.every(Boolean);
  }

  function finish() {
    if (!open) return;
    set("cmi.core.session_time", spanOf(Date.now() - started));
    set("cmi.core.exit", "suspend");
    said(api.LMSCommit(""));
    api.LMSFinish("");
    open = false;
  }

  return { there: Boolean(api), solved: () => solvedBefore(get("cmi.suspend_data")), tell, finish };
}

const said = (answer) => String(answer) === "true";

export const scoreOf = (solved, total) => Math.round((100 * solved) / total);

// The ids of the exercises that were solved on another day.
function solvedBefore(kept) {
  try {
    const found = JSON.parse(kept);
    return Array.isArray(found) ? found.filter((each) => typeof each === "string") : [];
  } catch {
    return [];
  }
}

// A span of time as SCORM writes it: 0000:05:12.
export function spanOf(milliseconds) {
  const seconds = Math.floor(milliseconds / 1000), parts = [Math.floor(seconds / 3600) % 10000, Math.floor(seconds / 60) % 60, seconds % 60];
  return parts.map((part, number) => String(part).padStart(number ? 2 : 4, "0")).join(":");
}
