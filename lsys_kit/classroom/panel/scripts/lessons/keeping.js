// What was typed into a page without a kernel, kept by the browser: it is there again when the page is opened once more. Where the
// browser keeps nothing it lasts as long as the page.

const PREFIX = "lsys-kit: ", here = new Map();

export function keptAnswer(question) {
  try {
    return here.get(question) ?? JSON.parse(localStorage[PREFIX + question]);
  } catch {
    // nothing is kept
  }
}

// Nothing takes back what was kept. What another tab keeps is seen in this one.
export function keepAnswer(question, answer) {
  here.set(question, answer);
  try {
    localStorage[PREFIX + question] = JSON.stringify(answer);
    here.delete(question);
  } catch {
    // it is full, or not allowed
  }
}

// Some texts, so many as there are boxes.
export const fitted = (given, many) => Array.from({ length: many }, (_, at) => String(given?.[at] ?? "").slice(0, 1000));
