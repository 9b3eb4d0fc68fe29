// What a student takes along from a page of exercises: what was tried, as the file progress.csv, which a copy of the course reads, and the
// answers as a notebook, which lsys-kit collect reads. It needs no Python.

import { keepAnswer, keptAnswer } from "../lessons/keeping.js";
import { made, worded } from "../views/controls.js";

const TRIES = "tries", MOST_TRIES = 2_000; // under which name tries are kept, and how many

const triesSoFar = () => (Array.isArray(keptAnswer(TRIES)) ? keptAnswer(TRIES) : []);

// Keep what was tried, as exercises/progress.py keeps it: not the same answer again, nor anything after the right one.
export function keepTry(id, said, answer) {
  if (!["Correct", "Almost", "Not yet"].includes(said)) return;
  const tries = triesSoFar(), own = tries.filter((each) => each.id === id);
  if (own.some((each) => each.result === "solved" || each.answer === answer)) return;
  const time = new Date(Date.now() - 60_000 * new Date().getTimezoneOffset()).toISOString().slice(0, 16).replace("T", " ");
  keepAnswer(TRIES, [...tries, { time, id, result: said === "Correct" ? "solved" : "tried", answer }].slice(-MOST_TRIES));
}

// Buttons that save both; and where the browser has no room for what is typed, that is said, and asked about before the page is left.
export function handingIn(ids) {
  const name = `${/(\w+)\.html$/.exec(location.pathname)?.[1] ?? "answers"}.ipynb`, told = made("span", { role: "status" });
  const saves = (text, file, content) => made("button", { type: "button", onclick: () => save(file, content()) }, `${text}: ${file}`);
  const look = () => {
    const lasts = isRoom();
    told.textContent = lasts ? "" : `\u26a0 ${worded("This browser has no room for what you type, or allows none: it lasts as long as this page. Save your answers before you leave it.")}`;
    onbeforeunload = lasts ? null : (event) => event.preventDefault();
  };
  const place = made("p.kit-saving", saves(worded("Save my answers, to hand them in"), name, () => notebookOf(ids)), " ", saves(worded("Save what was tried"), "progress.csv", progress), " ", told);
  document.querySelector("main").addEventListener("input", look);
  look();
  return place;
}

function isRoom() {
  try {
    localStorage.setItem("lsys-kit: room", "-".repeat(6_000));
    localStorage.removeItem("lsys-kit: room");
    return true;
  } catch {
    return false;
  }
}

function save(file, content) {
  const address = URL.createObjectURL(new Blob([content], { type: "application/octet-stream" }));
  made("a", { href: address, download: file }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

function progress() {
  const rows = triesSoFar().map(({ time, id, result }) => `${time},${/[",]/.test(id) ? `"${id.replaceAll('"', '""')}"` : id},${result}`);
  return ["time,exercise,result", ...rows, ""].join("\n");
}

// A notebook with a cell for each exercise, as exercises/notebooks.py writes them; what was not answered is "...".
function notebookOf(ids) {
  const cells = ids.map((id) => {
    const answer = String(keptAnswer(`exercise ${id}`)?.answer ?? "");
    return cell(`exercise-${id.replace(/\W/g, "-")}-answer`, `answer = ${answer.trim() ? literal(answer) : "..."}\ncheck(${JSON.stringify(id)}, answer)`);
  });
  const metadata = { kernelspec: { display_name: "Python 3 (ipykernel)", language: "python", name: "python3" }, language_info: { name: "python" } };
  return `${JSON.stringify({ cells: [cell("import", "from lsys_kit import check"), ...cells], metadata, nbformat: 4, nbformat_minor: 5 }, null, 1)}\n`;
}

const cell = (id, text) => ({ cell_type: "code", execution_count: null, id, metadata: {}, outputs: [], source: text.split(/(?<=\n)/) });

// A text as Python has it, each of its lines on one of its own.
function literal(text) {
  const lines = text.split(/(?<=\n)/).map((line) => JSON.stringify(line));
  return lines.length > 1 ? `(\n${lines.map((line) => `    ${line}\n`).join("")})` : lines[0];
}
