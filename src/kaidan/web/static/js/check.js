// The view of one robot on one staircase: panels at the side, the answer, its pictures in tabs.

import { Latest, fetchedFile } from "./api.js";
import { download, h, replace } from "./dom.js";
import { language, said, t } from "./i18n.js";
import { groundPanel } from "./ground.js";
import { kept } from "./kept.js";
import { drawMargin } from "./margin.js";
import { drawPlane } from "./plane.js";
import { drawMap, noMap } from "./posemap.js";
import { bodyOf, marginBody, planeBody, quickBody, sheetOf, withFigures } from "./question.js";
import { robotPanel } from "./robot.js";
import { sideView } from "./side.js";
import { stairsPanel } from "./stairs.js";
import { change, questionOf, state } from "./state.js";
import { findingsTable, verdictPanel } from "./verdict.js";

const TABS = ["side", "margin", "plane", "map", "findings", "text"];
const LABELS = { side: "side.heading", margin: "chart.margin", plane: "chart.plane", map: "chart.map", findings: "answer.findings", text: "answer.text" };
const ONE_CENTROID = ["side", "margin", "plane", "map"]; // what a robot does not have before it is weighed
const FOLLOW = ["quick", "margin", "plane"]; // what follows a slider while it moves
const SETTLED = 120; // after the last change of a slider, the whole question is put [ms]

export function checkView(shell) {
  const lines = {
    quick: new Latest("estimate"), answer: new Latest("assess"), side: new Latest("traverse"),
    margin: new Latest("margin"), plane: new Latest("plane"), map: new Latest("pose-map"), text: new Latest("text/assess"),
  };
  const mine = kept("check", () => ({ current: { robot: null, stairs: null, answer: null, body: null }, question: null, asked: null, found: {} }));
  const { current } = mine;
  Object.assign(current, {
    async report(format) {
      current.say(t("app.report_making"));
      try {
        download(await fetchedFile("report", { ...current.body, format, language }), `kaidan.${format}`);
        current.say(t("app.report_made"));
      } catch (error) {
        current.say(error.message || t("state.offline"));
      }
    },
    say: shell.say, chip: shell.chip, share: shell.share, print: shell.print, ask: () => put(true),
  });
  const panels = [robotPanel(current), stairsPanel(current), groundPanel(current)];
  const verdict = verdictPanel(current);
  const side = sideView();
  const views = Object.fromEntries(TABS.map((name) => [name, h("div", { role: "tabpanel", id: `tab-${name}`, "aria-labelledby": `to-${name}`, tabindex: "0" })]));
  views.side.append(side.node);
  const tabs = TABS.map((name) => h("button", {
    type: "button", role: "tab", id: `to-${name}`, "aria-controls": `tab-${name}`, onclick: () => change({ tab: name }), onkeydown: move,
  }, t(LABELS[name])));
  const pictures = h("section", { class: "pictures", "aria-label": t("side.heading"), hidden: true },
    h("div", { role: "tablist", "aria-label": t("answer.figures") }, tabs), Object.values(views));
  const node = h("div", { class: "check" }, h("div", { class: "inputs" }, panels.map((each) => each.node)),
    h("div", { class: "outcome" }, verdict.node, pictures));
  const shownFor = {};
  let begun = false, timer = 0, turn = 0;

  function move(event) {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!by) return;
    const next = tabs[(tabs.indexOf(event.currentTarget) + by + tabs.length) % tabs.length];
    next.focus();
    next.click();
  }

  // While something is asked, nothing of the question before stands: it would be read as of this one.
  function withdraw() {
    clearTimeout(timer);
    current.answer = null;
    mine.asked = null;
    const follow = shell.sliding() ? FOLLOW : [];
    for (const [name, line] of Object.entries(lines)) if (!follow.includes(name)) line.drop();
    for (const name of TABS) if (!follow.includes(name)) views[name].setAttribute("aria-busy", "true");
    verdict.working(shell.sliding());
  }

  // Put the question: at once a first estimate and, once the sliders rest, the whole traverse.
  function put(whole = false) {
    const { body } = current;
    const text = JSON.stringify(body), same = text === mine.asked && !whole, first = !begun;
    begun = true;
    if (same && !first) return;
    if (same && current.answer) return settled();
    withdraw();
    mine.asked = text;
    if (!body) {
      lines.quick.drop();
      pictures.hidden = true;
      verdict.empty();
      return;
    }
    if (!current.robot.com_range) lines.quick.ask(quickBody(body), (answer) => {
      if (current.answer === null && answer) verdict.estimated(answer, body.flippers === "best");
      if (current.answer === null && answer && !pictures.hidden) charts(answer);
    });
    timer = setTimeout(() => lines.answer.ask(body, (answer, error) => {
      if (error) return failed(error);
      current.answer = answer;
      lines.quick.drop();
      settled();
    }, { cancel: true }), whole || !shell.sliding() ? 0 : SETTLED);
  }

  function settled() {
    verdict.show(current.answer);
    pictures.hidden = current.answer.verdict === "outside-model";
    draw();
  }

  function failed(error) {
    pictures.hidden = true;
    verdict.failed(error);
  }

  // What the server has for a tab of an answer is asked once, also where the page is built anew.
  function paint(name, answer, body, draws, options) {
    const known = mine.found[name];
    if (known?.answer === answer) return show(name, null, () => draws(known.found));
    lines[name].ask(body, (found, error) => {
      if (found) mine.found[name] = { answer, found };
      show(name, error, () => draws(found));
    }, options);
  }

  function charts(answer) {
    if (state.tab === "margin") paint("margin", answer, marginBody(current.body), (curve) => drawMargin(views.margin, curve, answer));
    if (state.tab === "plane") paint("plane", answer, planeBody(current.body), (plane) => drawPlane(views.plane, plane));
  }

  function show(name, error, draws) {
    views[name].removeAttribute("aria-busy");
    if (!error) draws();
    else if (name === "side") side.none(error.message);
    else if (name === "map") noMap(views.map, error.message);
    else replace(views[name], h("p", { role: "status" }, error.message ? said(error.message) : t("state.offline")));
  }

  // Draw the open tab of the current answer, once.
  function draw() {
    if (!TABS.includes(state.tab)) state.tab = TABS[0];
    tabs.forEach((tab, index) => {
      const open = TABS[index] === state.tab;
      tab.setAttribute("aria-selected", String(open));
      tab.tabIndex = open ? 0 : -1;
      views[TABS[index]].hidden = !open;
    });
    const { answer, body } = current;
    if (!answer || shownFor[state.tab] === answer) return;
    shownFor[state.tab] = answer;
    if (current.robot.com_range && ONE_CENTROID.includes(state.tab)) {
      const none = t("robot.unweighed_picture");
      show(state.tab, null, () => (state.tab === "side" ? side.none(none) : replace(views[state.tab], h("p", {}, none))));
      return;
    }
    if (state.tab === "side") paint("side", answer, body, (report) => side.show(report), { cancel: true });
    if (state.tab === "findings") show("findings", null, () => replace(views.findings, findingsTable(answer)));
    if (state.tab === "map") paint("map", answer, body, (map) => drawMap(views.map, map), { cancel: true });
    if (state.tab === "text") paint("text", answer, body, (found) => replace(views.text, h("pre", { lang: "en" }, found.text)));
    charts(answer);
  }

  return {
    node,
    current,
    stop() {
      turn += 1;
      clearTimeout(timer);
      for (const line of Object.values(lines)) line.drop();
      side.stop();
    },
    async update() {
      turn += 1;
      const last = turn, question = questionOf();
      if (question !== mine.question) withdraw();
      mine.question = question;
      try {
        const [robot, stairs] = await Promise.all([sheetOf("robots", state.robot), sheetOf("stairs", state.stairs)]);
        if (last !== turn) return;
        Object.assign(current, { robot, stairs });
      } catch (error) {
        if (last === turn) failed(error);
        return;
      }
      current.body = bodyOf(current.robot && state.robot.startsWith("~") ? withFigures(current.robot, {}) : current.robot, current.stairs);
      for (const panel of panels) panel.update();
      draw();
      put();
    },
  };
}
