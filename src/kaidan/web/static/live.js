// A climb that is watched: numbers, chart, alarm with sound. Judged by the server; here it is shown.

import { has, japanese, language, loadTexts, setLanguage, t as text, titled } from "./js/i18n.js";
import { unpacked } from "./js/state.js";
import { preference, prefer } from "./js/storage.js";

const SEEN = 20; // s of the chart
const TICK = 50; // ms between two requests of a replay
const TIPPING = ["tipped over", "tip-over"]; // causes of the robot itself; the others are the sensor's
const GIVEN = "~"; // value of a list for the sheet that the question has in the place of a name
const at = (id) => document.getElementById(id);
const named = (sheet) => typeof sheet === "string";
const hash = location.hash.slice(1); // a climb that is watched, or what the question of the page hands over
const given = (hash.startsWith("~") && unpacked(hash)) || {};
await loadTexts();

let head = null; // what the server says of the climb
let states = [];
let last = 0; // when the last state came [ms]
let mood = "idle";
let over = false;
let socket = null;
let replay = null;
let audio = null;
let loud = false;

function t(key, values) {
  return text(`live.${key}`, values);
}

function speak(chosen) {
  setLanguage(chosen);
  at("language").value = language;
  document.title = t("title");
  sayCarried();
  for (const each of [...catalogue.robots, ...catalogue.stairs]) {
    const option = [...at("robot").options, ...at("stairs").options].find((one) => one.value === each.name);
    if (option) option.textContent = `${each.name}: ${titled(each.title)}`;
  }
  for (const each of document.querySelectorAll("[data-text]")) each.textContent = t(each.dataset.text);
  if (replay) at("pause").textContent = t(replay.paused ? "go_on" : "pause");
  show();
}

// A sentence of the server in the language of the page, where it is known in it.
function inWords(sentence) {
  return (language === "ja" ? japanese(sentence) : null) ?? sentence;
}

// What the robot of the question has beyond its sheet, as long as it is the one that is chosen.
function carried() {
  const its = at("robot").value === (named(given.robot) ? given.robot : GIVEN);
  return its ? { payload: given.payload, override: given.override } : {};
}

function sayCarried() {
  const { payload = [], override = {} } = carried();
  const mass = payload.reduce((sum, each) => sum + each.mass, 0), count = Object.keys(override).length;
  at("given").textContent = [mass && t("given_load", { mass: mass.toFixed(1) }), count && t("given_figures", { count })].filter(Boolean).join(" ");
}

// Connection

function connect(id, wait = 500) {
  socket?.close();
  const mine = new WebSocket(new URL(`api/live/${id}`, location.href.replace(/^http/, "ws").replace(/#.*/, "")));
  socket = mine;
  mine.onmessage = (message) => {
    wait = 500;
    take(JSON.parse(message.data));
  };
  mine.onclose = (ended) => {
    if (socket !== mine) return;
    if (ended.code === 4404) {
      at("note").textContent = t("gone");
      return;
    }
    at("note").textContent = t("lost");
    setTimeout(() => socket === mine && connect(id, Math.min(2 * wait, 5000)), wait);
  };
}

function take(said) {
  if (said.kind === "begin") {
    head = said;
    states = [];
    over = false;
    at("note").textContent = `${t("linked")}: ${said.robot}, ${said.stairs}`;
  } else if (said.kind === "end") {
    over = true;
    at("note").textContent = `${t("over")} ${said.text.split("\n").map(inWords).join(" ")}`;
  } else {
    states.push(said);
    if (states.length > 6000) states = states.slice(-3000);
    last = performance.now();
  }
  if (!take.waits) {
    take.waits = true;
    requestAnimationFrame(() => {
      take.waits = false;
      show();
    });
  }
}

// What is shown

function number(value, digits) {
  return value === null || value === undefined ? "–" : value.toFixed(digits).replace("-", "−");
}

// The last state, without numbers that are no longer known; that a sample is missing the server cannot say without a line to it.
function current() {
  const state = states.at(-1);
  if (!state || over) return state;
  const late = state.due_s !== null && performance.now() - last > 1000 * state.due_s;
  const missing = late || socket?.readyState !== WebSocket.OPEN;
  if (!missing && !state.causes.includes("frozen")) return state;
  const tipping = state.causes.filter((each) => TIPPING.includes(each));
  const causes = missing ? [...new Set([...tipping, "silent", ...state.causes])] : state.causes;
  return { ...state, margin_deg: null, time_to_tip_s: null, tilt_deg: null, causes };
}

function show() {
  const state = current();
  const causes = state?.causes ?? [];
  const tipped = causes.includes("tipped over");
  const outside = state?.status === "outside-model";
  const moods = outside && !causes.includes("silent") ? ["unknown"] : causes.map((each) => each.replace(/\W/, "_"));
  const said = JSON.stringify([language, Boolean(state), moods]);
  if (said !== show.said) {
    show.said = said;
    const also = moods.slice(1).map((each) => t(each));
    mood = !state ? "idle" : moods[0] ?? "calm";
    at("alarm").className = mood;
    at("status").textContent = "";
    at("mark").textContent = { idle: "○", calm: "●", tipped_over: "▼", tip_over: "▲", unknown: "?" }[mood] ?? "✕";
    at("said").textContent = t(mood);
    at("why").textContent = [has(`live.${mood}_do`) && t(`${mood}_do`, { why: state.message }), also.length && t("also", { names: also.join(", ") })].filter(Boolean).join(" ");
  }
  at("margin").textContent = number(state?.margin_deg, 1);
  at("time").textContent = tipped ? "–" : state && state.time_to_tip_s === null && state.margin_deg !== null ? `> ${head?.horizon_s ?? 2}` : number(state?.time_to_tip_s, 1);
  at("tilt").textContent = number(state?.tilt_deg, 1);
  at("phase").textContent = Number.isFinite(state?.margin_deg) && !tipped ? t(state.phase) : "–";
  if (state?.message && !outside && state.status !== "missing") at("note").textContent = state.message;
  draw();
}

function draw() {
  const times = states.filter((each) => each.t_s !== null && each.margin_deg !== null);
  const end = times.at(-1)?.t_s ?? 0;
  const seen = times.filter((each) => each.t_s > end - SEEN);
  const most = Math.max(20, ...seen.map((each) => each.margin_deg));
  const least = Math.min(-2, ...seen.map((each) => each.margin_deg));
  const x = (time) => 600 * (1 - (end - time) / SEEN);
  const y = (margin) => 135 - (130 * (margin - least)) / (most - least);
  at("curve").setAttribute("points", seen.map((each) => `${x(each.t_s).toFixed(1)},${y(each.margin_deg).toFixed(1)}`).join(" "));
  const limit = head?.margin_on_deg ?? 0;
  for (const [id, value] of [["zero", 0], ["limit", limit]])
    for (const [name, to] of [["x1", 0], ["x2", 600], ["y1", y(value)], ["y2", y(value)]]) at(id).setAttribute(name, to);
  at("limit-name").textContent = head ? `${t("limit")} ${limit.toFixed(1)}°` : "";
  at("limit-name").setAttribute("x", 6);
  at("limit-name").setAttribute("y", y(limit) - 5);
}

// For a screen reader: a sentence now and then; the alarm speaks for itself at once.
setInterval(() => {
  const state = states.at(-1);
  const told = (mood === "calm" || mood === "tip_over") && !over && state.margin_deg !== null;
  at("status").textContent = told ? t("state", { margin: number(state.margin_deg, 1), phase: t(state.phase) }) : "";
}, 5000);
setInterval(show, 100);

// Sound

function beep(pitch) {
  if (!audio) return;
  const tone = audio.createOscillator();
  const volume = audio.createGain();
  tone.type = "square";
  tone.frequency.value = pitch;
  volume.gain.setValueAtTime(0.25, audio.currentTime);
  volume.gain.setValueAtTime(0, audio.currentTime + 0.22);
  tone.connect(volume).connect(audio.destination);
  tone.start();
  tone.stop(audio.currentTime + 0.25);
  document.body.dataset.beeps = Number(document.body.dataset.beeps ?? 0) + 1;
}

function wake() {
  audio ??= new AudioContext();
  audio.resume();
}

function setLoud(on) {
  loud = on;
  at("sound").setAttribute("aria-pressed", String(on));
  if (on) wake();
}

setInterval(() => {
  if (!loud || over || mood === "idle" || mood === "calm") return;
  beep(mood === "tip_over" || mood === "tipped_over" ? 880 : 440);
}, 450);
at("sound").onclick = () => setLoud(!loud);
at("try").onclick = () => {
  wake();
  beep(880);
};

// Begin, and replay

async function ask(path, options) {
  const answer = await fetch(path, options);
  const said = await answer.json().catch(() => ({ error: answer.statusText }));
  if (!answer.ok) throw new Error(said.error);
  return said;
}

function post(path, body) {
  return ask(path, { method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(body) });
}

async function begin() {
  at("error").textContent = "";
  const body = {};
  for (const each of ["robot", "stairs", "direction", "facing", "flippers"]) body[each] = at(each).value;
  for (const each of ["robot", "stairs"]) if (body[each] === GIVEN) body[each] = given[each];
  Object.assign(body, carried());
  const limits = { resolution: at("resolution").value.trim(), no_data_on: at("silence").value.trim() };
  body.limits = Object.fromEntries(Object.entries(limits).filter(([, value]) => value));
  const made = await post("api/live", body);
  history.replaceState(null, "", `#${made.id}`);
  over = false;
  scrollTo(0, 0);
  connect(made.id);
  return made;
}

async function attempt(what) {
  try {
    await what();
  } catch (error) {
    at("error").textContent = error.message;
  }
}

at("watch").onclick = () =>
  attempt(async () => {
    forget();
    const made = await begin();
    const values = { robot: made.robot, stairs: made.stairs, url: location.href };
    at("link").textContent = t("feed", values);
  });

at("begin").onsubmit = (event) => {
  event.preventDefault();
  setLoud(true); // a click is what lets a page make a sound
  attempt(async () => {
    forget();
    const file = at("file").files[0];
    if (!file) throw new Error(t("no_file"));
    const form = new FormData();
    const up = at("direction").value === "up";
    form.append("nose", up === (at("facing").value === "nose-first") ? "up" : "down");
    form.append("file", file);
    const { samples } = await ask("api/samples", { method: "POST", body: form });
    const made = await begin();
    play(made.id, samples);
  });
};

// What a climb before came to does not stand while another one is asked for.
function forget() {
  stopReplay();
  states = [];
  show();
}

function stopReplay() {
  if (replay) replay.over = true;
  replay = null;
  at("pause").hidden = true;
  at("link").textContent = "";
}

async function play(id, samples) {
  const mine = (replay = { paused: false, over: false });
  at("pause").hidden = false;
  at("pause").textContent = t("pause");
  let now = samples.find((each) => each.t !== null)?.t ?? 0;
  let next = 0;
  let before = performance.now();
  while (!mine.over && next < samples.length) {
    const passed = performance.now() - before;
    before = performance.now();
    if (!mine.paused) now += (Number(at("speed").value) * passed) / 1000;
    const due = [];
    while (next < samples.length && due.length < 500 && !(samples[next].t > now)) due.push(samples[next++]);
    if (due.length) {
      try {
        await post(`api/live/${id}`, { samples: due, recorded: true });
      } catch (error) {
        at("error").textContent = error.message;
        break;
      }
    }
    await new Promise((done) => setTimeout(done, TICK));
  }
  if (!mine.over) {
    await post(`api/live/${id}`, { end: true }).catch(() => null);
    stopReplay();
  }
}

at("pause").onclick = () => {
  replay.paused = !replay.paused;
  at("pause").textContent = t(replay.paused ? "go_on" : "pause");
};

at("language").onchange = () => {
  prefer("language", at("language").value);
  speak(at("language").value);
};
const catalogue = await ask("api/catalogue", {});
for (const [id, kind, first] of [["robot", "robots", "absolem"], ["stairs", "stairs", "ibc"]]) {
  for (const each of catalogue[kind].filter((each) => !each.unweighed)) at(id).append(new Option("", each.name));
  at(id).value = first;
}
for (const id of ["robot", "stairs"]) {
  if (!given[id] || named(given[id])) continue;
  const sheets = [given[id]].flat();
  at(id).prepend(new Option(sheets.map((each) => each.title || each.name || "?").join(" + "), GIVEN));
}
for (const id of ["robot", "stairs", "direction", "facing", "flippers"]) {
  const value = named(given[id]) || !given[id] ? given[id] : GIVEN;
  if (value) at(id).value = value; // a list without it shows nothing, and the server says so
}
at("robot").onchange = sayCarried;
at("back").href = `./${sessionStorage.getItem("kaidan.question") ?? ""}`;
document.documentElement.dataset.theme = preference("theme", "auto");
speak(preference("language", navigator.language.slice(0, 2)));
if (hash && !hash.startsWith("~")) connect(hash);
document.body.dataset.ready = "yes";
