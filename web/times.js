// The times of a series: which is shown, which beside it, one after the other.
import {app} from "/api.js";
import {$, fill} from "/tools.js";

// Which are wanted of the server: that which is shown, that which it is compared with, and that which is at work.
export const wanted = () => {
  if (!app.times.length) return {};
  const [a, b] = app.at, query = {a: a ?? Math.max(0, app.made.indexOf("1"))};
  if (b >= 0) query.b = b;
  if (app.working !== "" && +app.working !== query.a && +app.working !== b) query[b >= 0 ? "c" : "b"] = app.working;
  return query;
};

// What was answered, apart: what is looked at, and what only is at work.
export function take({times, made, working, sources}) {
  const changed = made !== app.made || times.length !== app.times.length;
  Object.assign(app, {times, made, working});
  const shown = times.length ? 1 + (app.at[1] >= 0) : sources.length;
  app.sources = sources.slice(0, shown);
  app.other = sources.slice(shown);
  if (!times.length) return;
  app.at[0] ??= sources[0].index;
  $("times").hidden = false;
  $("time").max = times.length - 1;
  if (document.activeElement !== $("time")) $("time").value = app.at[0];
  say();
  if (changed) fill($("time-b"), [[-1, "nothing"], ...times.map((t, k) => [k, t]).filter(([k]) => made[k] === "1")], app.at[1] ?? -1);
}

function say() {
  const k = +$("time").value;
  $("time-name").textContent = app.times[k].replace("T", " ").replace("Z", " UTC") + (app.made[k] === "1" ? "" : " \u2013 not made yet");
  $("time").setAttribute("aria-valuetext", $("time-name").textContent);
}

function go(k) {
  $("time").value = k;
  app.at[0] = +k;
  say();
  app.tell("stale");
}

let playing = 0;
function play(on) {
  clearInterval(playing);
  playing = 0;
  $("play").setAttribute("aria-pressed", String(on));
  if (!on) return;
  playing = setInterval(() => {
    // The next that is made, once this one is there.
    if (document.hidden || app.waiting) return;
    for (let k = 1; k <= app.times.length; ++k) {
      const next = (app.at[0] + k) % app.times.length;
      if (app.made[next] === "1") return go(next);
    }
  }, 300);
}

$("time").addEventListener("input", e => { play(false); go(e.target.value); });
$("play").addEventListener("click", () => play(!playing));
$("time-b").addEventListener("change", e => { app.at[1] = +e.target.value; app.tell("stale"); });
$("hold").addEventListener("change", e => { app.hold = e.target.checked && app.times.length > 0; app.tell("runs"); });
