// The worker in which Python answers a page: it fetches Pyodide and the kit, says how far it is, and then passes questions, texts of
// JSON, to one function of the kit (site/answers.py). Nothing else of what a page says reaches Python.

const page = /** @type {any} */ (globalThis);
const had = new Set();
let python, answered, given;

page.onmessage = async ({ data }) => {
  try {
    if (data.ask === undefined) await start(data);
    else page.postMessage({ answer: await answerTo(data.ask) });
  } catch (fault) {
    page.postMessage(fault.missing ? { missing: fault.missing } : { fault: String(fault.message ?? fault).trim().split("\n").at(-1) });
  }
};

async function start(data) {
  given = data;
  const from = new URL(data.python.address, data.home).href, files = Object.entries(data.python.files);
  const wanted = [...files.map(([name, { bytes, integrity }]) => ({ address: from + name, bytes, integrity })), ofSite(data.kit)];
  const contents = await fetchedAll(wanted), kit = contents.pop();
  const [library, module, machine, modules, lock] = contents; // in the order of pyodide.toml
  const fetchAnything = fetch;
  page.fetch = (asked, ...more) => // Pyodide asks for its machine code by an address
    String(asked).endsWith(".wasm") ? Promise.resolve(new Response(machine, { headers: { "Content-Type": "application/wasm" } })) : fetchAnything(asked, ...more);
  const { loadPyodide } = await import(addressOf(library, "text/javascript"));
  const { default: createPyodideModule } = await import(addressOf(module, "text/javascript"));
  python = await loadPyodide({
    indexURL: from, createPyodideModule, lockFileContents: new TextDecoder().decode(lock), stdLibURL: addressOf(modules, "application/zip"),
    env: { HOME: "/home", ...data.variables }, stdout: () => {}, stderr: () => {},
  });
  unpack(kit);
  python.pyimport("sys").path.insert(0, "/kit");
  answered = python.pyimport("lsys_kit.classroom.site.answers").answered;
  page.postMessage({ ready: true });
}

// A package that an answer asks for is fetched, once, and the question is asked again.
async function answerTo(question) {
  for (;;) {
    const answer = JSON.parse(answered(question)), more = given.packages[answer.needs];
    if (!more || had.has(answer.needs)) return answer;
    had.add(answer.needs);
    try {
      unpack((await fetchedAll([ofSite(more)]))[0]);
      python.pyimport("importlib").invalidate_caches();
      python.pyimport(answer.needs); // now, so that the time for an answer begins after it
    } catch {
      return answer;
    }
  }
}

const ofSite = ({ address, bytes }) => ({ address: given.home + address, bytes });

const unpack = (archive) => python.unpackArchive(archive, "zip", { extractDir: "/kit" });

const addressOf = (content, type) => URL.createObjectURL(new Blob([content], { type }));

// The contents of some files, while the page hears which part of them is there.
async function fetchedAll(files) {
  const total = files.reduce((sum, { bytes }) => sum + bytes, 0);
  let seen = 0, told = 0;
  const count = (bytes) => {
    seen += bytes;
    const part = Math.min(1, Math.floor((100 * seen) / total) / 100);
    if (part > told) page.postMessage({ part: (told = part) });
  };
  return Promise.all(files.map((file) => fetched(file, count)));
}

async function fetched({ address, integrity }, count) {
  const response = await fetch(address, integrity ? { integrity } : {}).catch(() => null);
  if (!response?.ok) throw Object.assign(new Error(address), { missing: { file: address.split("?")[0], status: response?.status ?? "-" } });
  const parts = [], reader = response.body.getReader();
  for (let part = await reader.read(); !part.done; part = await reader.read()) {
    parts.push(part.value);
    count(part.value.length);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}
