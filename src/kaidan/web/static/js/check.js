// The view of one robot on one staircase: panels at the side, the answer, its pictures in tabs.

import { Latest, fetchedFile } from "./api.js";
import { download, h, replace } from "./dom.js";
import { language, said, t } from "./i18n.js";
import { groundPanel } from "./ground.js";
import { drawMargin } from "./margin.js";
import { drawPlane } from "./plane.js";
import { drawMap, noMap } from "./posemap.js";
import { bodyOf, marginBody, planeBody, quickBody, sheetOf, withFigures } from "./question.js";
import { robotPanel } from "./robot.js";
import { sideView } from "./side.js";
import { stairsPanel } from "./stairs.js";
import { change, state } from "./state.js";
import { findingsTable, verdictPanel } from "./verdict.js";

const TABS = ["side", "margin", "plane", "map", "findings", "text"];
const LABELS = { side: "side.heading", margin: "chart.margin", plane: "chart.plane", map: "chart.map", findings: "answer.findings", text: "answer.text" };
const ONE_CENTROID = ["side", "margin", "plane", "map"]; // what a robot does not have before it is weighed
const SETTLED = 120; // after the last change of a slider, the whole question is put [ms]

export function checkView(shell) {
  const lines = {
    quick: new Latest("estimate"), answer: new Latest("assess"), side: new Latest("traverse"),
    margin: new Latest("margin"), plane: new Latest("plane"), map: new Latest("pose-map"), text: new Latest("text/assess"),
  };
  const current = {
    robot: null, stairs: null, answer: null, body: null,
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
  };
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
  let asked = "", timer = 0, turn = 0;

  function move(event) {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!by) return;
    const next = tabs[(tabs.indexOf(event.currentTarget) + by + tabs.length) % tabs.length];
    next.focus();
    next.click();
  }

  // Put the question: at once a first estimate and, once the sliders rest, the whole traverse.
  function put(whole = false) {
    const { body } = current;
    const text = JSON.stringify(body);
    if (text === asked && !whole) return;
    asked = text;
    clearTimeout(timer);
    current.answer = null;
    for (const name of ["side", "map", "text"]) lines[name].drop();
    lines.answer.drop();
    if (!body) {
      lines.quick.drop();
      pictures.hidden = true;
      verdict.empty();
      return;
    }
    verdict.working();
    if (!current.robot.com_range) lines.quick.ask(quickBody(body), (answer) => {
      if (current.answer === null && answer) verdict.estimated(answer, body.flippers === "best");
      if (current.answer === null && answer && !pictures.hidden) charts(answer);
    });
    timer = setTimeout(() => lines.answer.ask(body, (answer, error) => {
      if (error) {
        pictures.hidden = true;
        verdict.failed(error);
        return;
      }
      current.answer = answer;
      lines.quick.drop();
      verdict.show(answer);
      pictures.hidden = answer.verdict === "outside-model";
      draw();
    }, { cancel: true }), whole || !shell.sliding() ? 0 : SETTLED);
  }

  function charts(answer) {
    if (state.tab === "margin") lines.margin.ask(marginBody(current.body), (curve, error) => show("margin", error, () => drawMargin(views.margin, curve, answer)));
    if (state.tab === "plane") lines.plane.ask(planeBody(current.body), (plane, error) => show("plane", error, () => drawPlane(views.plane, plane)));
  }

  function show(name, error, paint) {
    if (error) replace(views[name], h("p", { role: "status" }, error.message ? said(error.message) : t("state.offline")));
    else paint();
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
      if (state.tab === "side") side.none(t("robot.unweighed_picture"));
      else replace(views[state.tab], h("p", {}, t("robot.unweighed_picture")));
      return;
    }
    if (state.tab === "side") lines.side.ask(body, (report, error) => (error ? side.none(error.message) : side.show(report)), { cancel: true });
    if (state.tab === "findings") replace(views.findings, findingsTable(answer));
    if (state.tab === "map") lines.map.ask(body, (map, error) => (error ? noMap(views.map, error.message) : drawMap(views.map, map)), { cancel: true });
    if (state.tab === "text") lines.text.ask(body, (found, error) => show("text", error, () => replace(views.text, h("pre", { lang: "en" }, found.text))));
    charts(answer);
  }

  return {
    node,
    current,
    stop: side.stop,
    async update() {
      turn += 1;
      const mine = turn;
      try {
        const [robot, stairs] = await Promise.all([sheetOf("robots", state.robot), sheetOf("stairs", state.stairs)]);
        if (mine !== turn) return;
        Object.assign(current, { robot, stairs });
      } catch (error) {
        verdict.failed(error);
        return;
      }
      current.body = bodyOf(current.robot && state.robot.startsWith("~") ? withFigures(current.robot, {}) : current.robot, current.stairs);
      for (const panel of panels) panel.update();
      draw();
      put();
    },
  };
}
