// Long work in the background: begin it, see how far it is, cancel it, take what it came to. The
// server keeps it, so that a reload or a new start of the server loses nothing.

import { Refused, ask, fetchedText, get, remove, upload } from "./api.js";
import { button, fileField, picker, slider } from "./controls.js";
import { h, replace } from "./dom.js";
import { has, language, said, t } from "./i18n.js";
import { kept } from "./kept.js";
import { symbol } from "./light.js";
import { bodyOf, catalogue, sheetOf } from "./question.js";
import { robotBoxes } from "./robot.js";
import { change, state } from "./state.js";
import { figure } from "./units.js";

const EVERY = 1000; // how often the server is asked while something runs [ms]
const KINDS = ["compare", "sweep", "posture", "experiment", "film", "report", "file"];
const VARIED = {
  com_height: ["length", 0, 1], com_from_front: ["length", 0, 2], friction: ["friction", 0, 2],
  speed: ["speed", 0, 3], acceleration: ["acceleration", -3, 3], yaw: ["angle", 0, 0.5],
};
const OWN = ["com_height", "com_from_front"]; // figures that a sheet's override would hide

export function workView(shell) {
  const mine = kept("work", () => ({
    kind: "compare", varied: "com_height", format: "pdf", file: null, chosen: new Set(), range: { low: 0.1, high: 0.3, count: 21, trials: 5 }, turn: 0, shown: null,
  }));
  const { chosen, range } = mine;
  let timer = 0, listed = "", stopped = false;
  const form = h("div", {}), word = h("p", { role: "alert" }), list = h("ul", { class: "jobs" }), outcome = h("div", { "aria-live": "polite" });
  const kinds = picker({ label: t("work.kind"), empty: null, groups: () => [["", KINDS.map((each) => [each, t(`work.${each}`)])]], get: () => mine.kind, set: (kind) => { mine.kind = kind; fill(); } });
  const node = h("section", { class: "panel work" }, h("h2", {}, t("work.heading")), h("p", {}, t("work.lead")),
    kinds.node, form, button(t("work.begin"), begin, { class: "main" }), word, h("h3", {}, t("work.list")), list, outcome);

  function number(label, of, name, low, high) {
    const field = slider({ label, kind: of, low, high, get: () => range[name], set: (value) => { range[name] = value; } });
    field.update();
    return field.node;
  }

  function choose(label, entries, get, set) {
    const made = picker({ label, empty: null, groups: () => [["", entries]], get, set });
    made.update();
    return made.node;
  }

  const robots = () => h("fieldset", { class: "robots" }, robotBoxes(chosen));

  const FORMS = {
    compare: () => robots(),
    sweep: () => {
      const [of, low, high] = VARIED[mine.varied];
      return [choose(t("work.varied"), Object.keys(VARIED).map((each) => [each, t(`work.${each}`)]), () => mine.varied, (value) => {
        mine.varied = value;
        [, range.low, range.high] = VARIED[value];
        fill();
      }), number(t("work.from"), of, "low", low, high), number(t("work.to"), of, "high", low, high), number(t("work.count"), "count", "count", 2, 2000)];
    },
    experiment: () => number(t("work.trials"), "count", "trials", 1, 20),
    report: () => choose(t("work.format"), [["pdf", "PDF"], ["html", "HTML"]], () => mine.format, (format) => { mine.format = format; }),
    file: () => [fileField({ label: t("work.of_file"), id: "work-file", file: mine.file, take: (file) => { mine.file = file; } }), robots()],
  };

  function fill() {
    replace(form, h("p", { class: "quiet" }, t(`work.${mine.kind}_is`)), [FORMS[mine.kind]?.() ?? []].flat());
  }

  // The question under "Stairs", as the whole of it or with what this work changes.
  async function bodyOfWork() {
    const { kind, varied, format } = mine;
    const [robot, stairs] = await Promise.all([sheetOf("robots", state.robot), sheetOf("stairs", state.stairs)]);
    const body = bodyOf(robot, stairs);
    if (kind === "experiment") return robot && { robot: body?.robot ?? state.robot, trials: range.trials };
    if (!body && !(kind === "compare" && stairs)) return null;
    if (kind === "compare") {
      const { robot: _, override: __, stairs: on, ...rest } = body ?? bodyOf({ front_flippers: {}, rear_flippers: {} }, stairs);
      return { ...rest, stairs: [on], robots: [...chosen] };
    }
    if (kind === "sweep") {
      const values = Array.from({ length: range.count }, (_, k) => range.low + ((range.high - range.low) * k) / (range.count - 1));
      const { override, surface, ...rest } = body;
      const kept = Object.entries(override ?? {}).filter(([name]) => !OWN.includes(name));
      return {
        ...rest, ...(surface && varied !== "friction" ? { surface } : {}), ...(kept.length ? { override: Object.fromEntries(kept) } : {}), [varied]: values,
      };
    }
    if (kind === "posture") return Object.fromEntries(Object.entries(body).filter(([name]) => name !== "flippers"));
    return kind === "report" ? { ...body, format, language } : body;
  }

  async function begin() {
    const { kind, file } = mine;
    try {
      if ((kind === "file" && !file) || (kind === "compare" && chosen.size === 0)) return replace(word, t("building.pick"));
      if (kind === "file") {
        const building = /\.ifc(zip)?$/i.test(file.name) && chosen.size > 0;
        const body = building ? { robots: [...chosen], ...(state.surface && state.surface !== "own" ? { surface: state.surface } : {}) } : {};
        await upload("jobs", file, [["verb", building ? "building" : "read"], ["body", JSON.stringify(body)]]);
      } else {
        const body = await bodyOfWork();
        if (!body) return replace(word, t("work.no_question"));
        await ask("jobs", { verb: kind, body });
      }
      replace(word);
      look();
    } catch (error) {
      replace(word, error instanceof Refused ? said(error.message) : t("state.offline"));
    }
  }

  async function look() {
    clearTimeout(timer);
    let running = true;
    try {
      const { jobs } = await get("jobs");
      running = jobs.some((job) => job.state === "queued" || job.state === "running");
      if (JSON.stringify(jobs) !== listed) {
        listed = JSON.stringify(jobs);
        keepingFocus(() => replace(list, jobs.length === 0 ? h("li", {}, t("work.none")) : [...jobs].reverse().map(entry)));
      }
    } catch {
      shell.say(t("state.offline"));
    }
    if (running && !node.hidden && !stopped) timer = setTimeout(look, EVERY);
  }

  // Draw the list anew without taking the keyboard away from the job it is at.
  function keepingFocus(redraw) {
    const job = list.contains(document.activeElement) ? document.activeElement.closest("[data-job]") : null;
    const place = job ? [...job.querySelectorAll("button")].reverse().indexOf(document.activeElement) : 0;
    redraw();
    if (!job) return;
    const buttons = [...list.querySelectorAll(`[data-job="${job.dataset.job}"] button`)].reverse();
    (buttons[place] ?? list.querySelector("button"))?.focus();
  }

  function entry(job) {
    const name = `${has(`work.${job.verb}`) ? t(`work.${job.verb}`) : job.verb}: ${job.about}`;
    const { done, of, what } = job.progress;
    const going = job.state === "queued" || job.state === "running";
    return h("li", { "data-job": job.id, "data-state": job.state },
      h("span", {}, h("b", {}, name), h("span", { class: "quiet" }, ` ${t(`work.${job.state}`)}${going && of ? ` ${done} / ${of}` : ""} `, going && of ? said(what) : null),
        job.error ? said(job.error.error, "p") : null,
        going ? h("progress", { "aria-label": name, ...(of ? { value: done, max: of } : {}) }) : null),
      job.state === "done" ? button(t("work.show"), () => show(job), { class: "main", "aria-label": `${t("work.show")}: ${name}` }) : null,
      button(t(going ? "work.cancel" : "work.forget"), async () => { await remove(`jobs/${job.id}`); look(); }, { "aria-label": `${t(going ? "work.cancel" : "work.forget")}: ${name}` }));
  }

  // What a job came to; while it is asked for, that of another one does not stand.
  async function show(job) {
    mine.turn += 1;
    const { turn } = mine;
    mine.shown = { job };
    mine.draw();
    try {
      const cells = job.verb === "compare" ? await get(`jobs/${job.id}/result`) : null;
      const words = ["film", "report"].includes(job.verb) ? "" : await fetchedText(`jobs/${job.id}/text`);
      if (turn === mine.turn) mine.shown = { job, came: { cells, words } };
    } catch (error) {
      if (turn === mine.turn) mine.shown = { job, error };
    }
    if (turn !== mine.turn) return;
    mine.draw();
    outcome.scrollIntoView();
  }

  mine.draw = () => {
    if (!mine.shown) return;
    const { job, came, error } = mine.shown, address = `api/jobs/${job.id}/result`;
    replace(outcome, h("h3", {}, job.about),
      came || error ? null : h("p", { role: "status" }, t("work.fetching")),
      error ? h("p", { role: "alert", class: "refused" }, error instanceof Refused ? said(error.message) : t("state.offline")) : null,
      came?.cells ? compared(came.cells) : null,
      came && job.verb === "film" ? h("img", { src: address, alt: job.about }) : null,
      came?.words ? h("pre", { lang: "en", tabindex: "0" }, came.words) : null,
      came ? h("p", {}, h("a", { href: address, download: `kaidan-${job.verb}` }, t("work.file_saved"))) : null);
  };
  mine.draw();

  return {
    node,
    stop() {
      stopped = true;
      clearTimeout(timer);
    },
    update() {
      if (chosen.size === 0 && state.robot && !state.robot.startsWith("~")) chosen.add(state.robot);
      kinds.update();
      fill();
      look();
    },
  };
}

// Robots by stairs: the verdict of each pair, and the way to its question.
function compared({ robots, stairs, cells }) {
  return h("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": t("work.compare") }, h("table", {},
    h("thead", {}, h("tr", {}, h("th", { scope: "col" }, t("building.robots")), stairs.map((name) => h("th", { scope: "col" }, name)))),
    h("tbody", {}, robots.map((robot) => h("tr", {}, h("th", { scope: "row" }, robot), stairs.map((on) => {
      const cell = cells.find((each) => each.robot === robot && each.stairs === on);
      return h("td", {}, cell ? [h("div", { class: `tag is-${cell.verdict}` }, symbol(cell.verdict, 22), h("b", {}, t(`verdict.${cell.verdict}`)),
        figure(cell.margin_deg, "degrees", { plus: true, of: "cell.margin_deg" })),
      catalogue.robots.some((each) => each.name === robot) ? button(t("work.open"), () => change({ view: "check", robot, ...(cell.facing ? { facing: cell.facing } : {}) }), { "aria-label": `${t("work.open")}: ${robot}` }) : null] : "–");
    }))))));
}
