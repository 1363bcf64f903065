// Starts the page: screens, theme, and what the folders hold from time to time.
import {app, ask, complain} from "/api.js";
import {$} from "/tools.js";
import "/image.js";
import "/spectra.js";
import "/scatter.js";
import "/scene.js";
import "/run.js";
import "/document.js";
import {take, wanted} from "/times.js";

const screens = ["image", "scatter", "scene", "run", "document"];
let chosen = "", opened = false;

function choose(name) {
  if (chosen && chosen !== name) app.tell("screen-left");
  chosen = name;
  opened = true;
  for (const s of screens) {
    $(`screen-${s}`).hidden = s !== name;
    const tab = $(`tab-${s}`);
    tab.setAttribute("aria-selected", String(s === name));
    tab.tabIndex = s === name ? 0 : -1;
  }
  app.tell(`screen-${name}`);
  if (name === "image") app.tell("shown");
}
for (const s of screens) $(`tab-${s}`).addEventListener("click", () => choose(s));
$("tabs").addEventListener("keydown", e => {
  const by = {ArrowRight: 1, ArrowLeft: -1}[e.key];
  if (!by) return;
  const open = screens.filter(s => !$(`tab-${s}`).disabled), next = open[(open.indexOf(e.target.id.slice(4)) + by + open.length) % open.length];
  choose(next);
  $(`tab-${next}`).focus();
});

function theme(name) {
  document.documentElement.dataset.theme = name;
  $("theme").textContent = name === "dark" ? "Light" : "Dark";
  app.tell("theme");
}
const preferred = matchMedia("(prefers-color-scheme: dark)");
theme(localStorage.getItem("ifov-theme") || (preferred.matches ? "dark" : "light"));
$("theme").addEventListener("click", () => {
  const name = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
  localStorage.setItem("ifov-theme", name);
  theme(name);
});

let generations = "", newest = "", again = false, timer = 0, notices = "";
async function look() {
  clearTimeout(timer);
  if (app.waiting) { again = true; return; }
  app.waiting = true;
  let wait = 1000;  // ms
  try {
    const first = !app.times.length, said = await ask("sources", wanted());
    take(said);
    if (first && app.times.length) app.hold = $("hold").checked;
    app.document = said.document;
    const version = app.version || said.documentVersion;
    app.version = said.documentVersion;
    if (!app.colours) { app.colours = await ask("colours"); app.tell("colours"); }
    // That a document has no products yet is what one expects.
    const faults = app.sources.filter(s => !said.document || s.run || s.watch).map(s => s.fault).filter(Boolean).join("; ");
    if (faults !== notices) { notices = faults; $("notice").textContent = faults; }
    $("title").textContent = app.sources.map((s, k) => `${app.sources.length > 1 ? "AB"[k] + ": " : ""}${s.folder}`).join("   ") || "view";
    document.title = `${$("title").textContent} \u2013 ifov view`;
    app.tell("sources");
    if (version !== app.version) app.tell("document");
    const now = app.sources.map(s => `${s.index}:${s.run ? s.generation : 0}`).join(), made = app.sources.map(s => s.generation).join();
    if (now !== generations) {
      if (generations && made !== newest && !app.times.length && app.sources.some(s => s.generation > 1)) $("notice").textContent = "The products were made anew, and are shown as they are now.";
      generations = now;
      newest = made;
      app.tell("runs");
    }
    const has = app.sources.some(s => s.run), works = said.sources.some(s => s.watch);
    $("tab-image").disabled = $("tab-scatter").disabled = !has;
    $("tab-scene").disabled = !said.document;
    if (!opened) choose(has && !works ? "image" : works ? "run" : said.document ? "scene" : "run");
    wait = works ? 300 : has && !said.document ? 3000 : 1000;
  } catch (error) { complain(error); wait = 3000; }
  app.waiting = false;
  timer = setTimeout(look, again ? 0 : wait);
  again = false;
}
app.on("stale", () => { clearTimeout(timer); timer = setTimeout(look, app.times.length ? 0 : 400); });
look();
