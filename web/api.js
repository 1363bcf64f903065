// What the server knows. The token comes behind the '#' of the address, which browsers keep to themselves, and goes back in a header.
const given = /^#([\w-]{22,128})$/.exec(location.hash);
if (given) {
  sessionStorage.setItem("ifov-token", given[1]);
  history.replaceState(null, "", location.pathname);
}
const token = sessionStorage.getItem("ifov-token") || "";

export class Refusal extends Error {
  constructor(status, message) { super(message); this.status = status; }
}

export async function ask(name, query = {}, signal, method = "GET") {
  let response;
  try {
    response = await fetch(`/api/${name}?${new URLSearchParams(query)}`, {method, headers: {"X-Ifov-Token": token}, signal});
  } catch (error) {
    if (error.name === "AbortError") throw error;
    throw new Refusal(0, "ifov view does not answer: it has ended");
  }
  if (!response.ok) {
    const said = await response.json().catch(() => ({}));
    throw new Refusal(response.status, said.error || `the server answers ${response.status}`);
  }
  if ((response.headers.get("content-type") || "").startsWith("application/json")) return response.json();
  return {about: JSON.parse(response.headers.get("X-Ifov-About")), values: new Float32Array(await response.arrayBuffer())};
}

// What the screens share: sources as the server tells them, what is chosen, and who wants to know of it.
export const app = Object.assign(new EventTarget(), {
  sources: [], shown: 0, pixel: null, band: 0, selection: null, colours: null, document: false, version: 0,
  times: [], made: "", working: "", at: [], other: [], hold: false, waiting: false,
  tell(what) { app.dispatchEvent(new Event(what)); },
  on(what, listener) { app.addEventListener(what, listener); },
  run(k = app.shown) { return app.sources[k] && app.sources[k].run; },
  // A and B, of a series the times that were chosen; what is at work there stands in `other`.
  source(k = app.shown) { return {source: app.sources[k] ? app.sources[k].index : 0}; },
  query(k = app.shown) { return {...app.source(k), generation: app.sources[k].generation}; },
  cube(name, k = app.shown) { const run = app.run(k); return run && run.cubes.find(c => c.name === name); },
  main(k = app.shown) { return app.run(k).cubes[0]; },
});

// What goes wrong is said in the bar below the head; what is no longer asked for is not.
export function complain(error) {
  if (error.name === "AbortError") return;
  document.getElementById("notice").textContent = error.message;
  if (error.status === 409) app.tell("stale");
}
