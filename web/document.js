// The document with what the checks say of it, in place.
import {app, ask, complain} from "/api.js";
import {$, make} from "/tools.js";

// The line that another screen points to.
function aim() {
  const row = app.line && $("listing").querySelectorAll(":scope > div")[app.line - 1];
  if (!row) return;
  for (const other of $("listing").querySelectorAll(".aim")) other.classList.remove("aim");
  row.classList.add("aim");
  row.scrollIntoView({block: "center"});
  app.line = 0;
}

let settled = false, loading = false, shown = 0;

async function load() {
  if (settled || loading || $("screen-document").hidden) return;
  loading = true;
  try {
    const {version, file, text, checked, messages} = await ask("document", app.source()), again = shown !== 0, top = $("listing").scrollTop;
    $("document-name").textContent = file + (checked ? "" : " \u2013 being checked ...");
    const order = ["failure", "error", "warning", "statement"];
    const here = m => m.line && (m.file === file || m.file.endsWith("/" + file) || file.endsWith("/" + m.file));
    $("messages").replaceChildren(...messages.slice().sort((a, b) => order.indexOf(a.severity) - order.indexOf(b.severity)).map(m => {
      const place = m.file && m.line ? `${m.severity}, line ${m.line}: ` : m.severity === "statement" ? "" : `${m.severity}: `;
      return make("li", {class: m.severity}, place + (here(m) ? m.text.split("\n")[0] : m.text));
    }));
    const wrong = new Map(messages.filter(here).map(m => [m.line, m]));
    let first = null;
    $("listing").replaceChildren(...text.split("\n").flatMap((line, i) => {
      const m = wrong.get(i + 1), row = make("div", m ? {class: "wrong"} : {}, line);
      if (m && !first) first = row;
      return m ? [row, make("p", {}, m.text)] : [row];
    }));
    // Who edits goes on where he looks.
    if (again) $("listing").scrollTop = top;
    else if (first) first.scrollIntoView({block: "center"});
    shown = version;
    aim();
    settled = checked && version >= app.version;
    if (!settled) setTimeout(() => { loading = false; load(); }, 700);
  } catch (error) {
    if (error.status === 404) $("document-name").textContent = error.message;
    else complain(error);
  }
  loading = false;
}
app.on("screen-document", load);
app.on("line", aim);
app.on("document", () => { settled = false; load(); });
app.on("runs", () => { if (!app.document) { settled = false; load(); } });
