// A building model: its flights with a verdict for each robot, ways to the storeys, the plan.

import { Refused, upload } from "./api.js";
import { button, fileField, picker } from "./controls.js";
import { h, line, replace, s } from "./dom.js";
import { said, t, titled } from "./i18n.js";
import { kept } from "./kept.js";
import { symbol } from "./light.js";
import { catalogue } from "./question.js";
import { robotBoxes } from "./robot.js";
import { change, clear, packed, state } from "./state.js";
import { figure, shown } from "./units.js";

export function buildingView() {
  const mine = kept("building", () => ({
    turn: 0, reading: false, answer: null, error: null, file: null, surface: "",
    chosen: new Set(state.robot && !state.robot.startsWith("~") ? [state.robot] : []),
  }));
  const { chosen } = mine;
  const boxes = h("fieldset", { class: "robots" });
  const outcome = h("div", { "aria-live": "polite" });
  const model = fileField({ label: t("building.file"), id: "model", accept: ".ifc,.ifczip", file: mine.file, take: (file) => forget({ file }) });
  const ground = picker({
    label: t("ground.surface"), empty: t("ground.none"), get: () => mine.surface, set: (surface) => forget({ surface }),
    groups: () => [["", catalogue.surfaces.map((each) => [each.name, titled(each.title)])]],
  });
  const node = h("section", { class: "panel building" }, h("h2", {}, t("building.heading")), h("p", {}, t("building.lead")),
    model, boxes, ground.node,
    button(t("building.ask"), judge, { class: "main" }), outcome);

  mine.draw = draw;
  draw();

  // What was judged is of another file, or on another ground: it does not stand beside this one.
  function forget(chosen) {
    mine.turn += 1;
    Object.assign(mine, { reading: false, answer: null, error: null }, chosen);
    draw();
  }

  async function judge() {
    const { file, surface } = mine;
    if (!file || chosen.size === 0) return replace(outcome, h("p", { role: "alert", class: "refused" }, t("building.pick")));
    forget({ reading: true });
    const { turn } = mine;
    const fields = [...chosen].map((name) => ["robots", name]);
    if (surface) fields.push(["surface", surface]);
    const judged = await upload("building", file, fields).then((answer) => ({ answer }), (error) => ({ error }));
    if (turn !== mine.turn) return;
    Object.assign(mine, { reading: false }, judged);
    mine.draw();
  }

  function draw() {
    const { reading, answer, error } = mine;
    if (reading) replace(outcome, h("p", {}, t("building.reading")));
    else if (error) replace(outcome, h("p", { role: "alert", class: "refused" }, error instanceof Refused ? said(error.message) : t("state.offline")));
    else replace(outcome, answer ? page(answer) : []);
  }

  // The flight as a question of its own, with the robot of the cell and its manner.
  function open(flight, cell) {
    clear("stairsFigures");
    clear("robotFigures");
    change({
      view: "check", robot: cell.robot, stairs: packed(flight.sheet), direction: cell.direction, facing: cell.facing, surface: mine.surface,
      flippers: cell.flippers || "best",
    });
  }

  function page(found) {
    const wide = found.robots.length;
    return [
      storeys(found),
      h("h3", {}, t("building.flights")),
      found.flights.length === 0 ? null : h("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": t("building.flights") }, h("table", {},
        h("thead", {}, h("tr", {}, h("th", { scope: "col" }, t("building.flight")), found.robots.map((name) => h("th", { scope: "col" }, name)))),
        h("tbody", {}, found.flights.map((flight, row) => h("tr", {},
          h("th", { scope: "row" }, flight.name || flight.identity, h("div", { class: "quiet" },
            `${flight.storey} · ${flight.steps} × `, figure(flight.rise_m, "length"), " / ", figure(flight.going_m, "length"), ", ", figure(flight.angle_deg, "degrees"), h("br"),
            ends(flight))),
          found.cells.slice(row * wide, (row + 1) * wide).map((cell) => h("td", {}, verdictOf(cell), h("div", {}, said(cell.reason)),
            button(t("building.open"), () => open(flight, cell), { "aria-label": `${t("building.open")}: ${flight.name}, ${cell.robot}` })))))))),
      plans(found),
      found.ways.length === 0 ? null : [h("h3", {}, t("building.ways", { start: found.start })), ways(found)],
      account(found.elements), notes(found),
    ];
  }

  return { node, update() { replace(boxes, robotBoxes(chosen)); ground.update(); } };
}

// First and last riser as they are drawn; none: no floor is drawn at the foot.
function ends(flight) {
  return [t("building.first"), " ", flight.first_rise_m === null ? t("building.not_drawn") : figure(flight.first_rise_m, "length"), ", ",
    t("building.last"), " ", figure(flight.last_rise_m, "length")];
}

// What became of every element for going up, and the reasons of those that are not judged.
function account(elements) {
  if (elements.length === 0) return null;
  const word = (table, key) => t(`${table}.${(key || "other").replaceAll(" ", "_")}`);
  const counted = (key) => [...elements.reduce((counts, each) => counts.set(each[key], (counts.get(each[key]) ?? 0) + 1), new Map())]
    .map(([name, count]) => `${count} × ${word(key, name)}`).join(", ");
  const left = elements.filter((each) => each.reasons.length > 0);
  return [h("h3", {}, t("building.elements")), h("p", { class: "account" }, `${counted("kind")}: ${counted("outcome")}`),
    left.length === 0 ? null : [h("h3", {}, t("building.refusals")), h("ul", { class: "not-judged" }, left.map((each) => h("li", {},
      h("b", {}, each.name), ` (${word("kind", each.kind)}, ${each.identity}): `, each.reasons.map((why) => said(why)))))]];
}

function notes(found) {
  const entries = [...found.notes, ...[...found.flights, ...found.elements].flatMap((each) => each.notes.map((note) => `${each.name}: ${note}`))];
  return entries.length === 0 ? null : [h("h3", {}, t("building.notes")), h("ul", {}, entries.map((each) => said(each, "li")))];
}

function verdictOf(cell) {
  return h("div", { class: `tag is-${cell.verdict}` }, symbol(cell.verdict, 22), h("b", {}, t(`verdict.${cell.verdict}`)), " ",
    cell.binds ? t("building.binds", { what: t(`binds.${cell.binds}`) }) : "", " ",
    cell.margin_deg === undefined || cell.margin_deg === null ? null : figure(cell.margin_deg, "degrees", { plus: true, of: "cell.margin_deg" }));
}

function storeys(found) {
  return [h("h3", {}, t("building.storeys")), h("ul", { class: "storeys" }, [...found.storeys].reverse().map((storey) =>
    h("li", {}, h("b", {}, storey.name), " ", t("building.level", { level: shown(storey.level_m, "length") }))))];
}

function ways(found) {
  return h("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": t("building.ways", { start: found.start }) }, h("table", {},
    h("thead", {}, h("tr", {}, h("th", { scope: "col" }, t("building.storey")), found.robots.map((name) => h("th", { scope: "col" }, name)))),
    h("tbody", {}, [...new Set(found.ways.map((way) => way.storey))].map((storey) => h("tr", {}, h("th", { scope: "row" }, storey),
      found.robots.map((name) => {
        const way = found.ways.find((each) => each.storey === storey && each.robot === name);
        return h("td", {}, way?.verdict ? [verdictOf(way), way.where ? h("div", {}, `${way.where}: `, said(way.reason)) : null] : t("building.no_way"));
      }))))));
}

// How far beyond the flights a plan shows floors, and the edge around it [m]; its largest sides.
const BEYOND = 5, EDGE = 0.5, WIDE = 340, TALL = 300;

// A plan for each storey that flights begin on, for those of the next one lie above them.
function plans(found) {
  const storeys = [...new Set(found.flights.map((each) => each.storey))];
  if (storeys.length === 0) return null;
  return [h("h3", {}, t("building.plan")), h("div", { class: "plans" }, storeys.map((storey) =>
    plan(storey, found.flights.filter((each) => each.storey === storey), found.floors)))];
}

// Flights with their names, and the floors that they join: the nosings and the lane, as the answer has them.
function plan(storey, flights, every) {
  const joined = new Set(flights.flatMap((each) => [each.lower, each.upper]));
  const floors = every.filter((each) => joined.has(each.key)).flatMap((each) => each.outlines);
  const points = flights.flatMap((flight) => flight.lane);
  const [[left, right], [low, high]] = [0, 1].map((axis) => {
    const [own, all] = [points, [...points, ...floors.flat()]].map((each) => each.map((point) => point[axis]));
    const most = (values) => values.reduce((one, other) => Math.max(one, other));
    const least = (values) => values.reduce((one, other) => Math.min(one, other));
    return [Math.max(least(all), least(own) - BEYOND) - EDGE, Math.min(most(all), most(own) + BEYOND) + EDGE];
  });
  const [wide, tall] = [right - left, high - low];
  const k = Math.min(WIDE / wide, TALL / tall);
  const at = ([x, y]) => [(x - left) * k, (low + tall - y) * k];
  const middle = (lane) => at([0, 1].map((axis) => lane.reduce((sum, point) => sum + point[axis], 0) / lane.length));
  return h("figure", {}, h("figcaption", {}, storey),
    s("svg", { class: "floor-plan", viewBox: `0 0 ${(wide * k).toFixed(0)} ${(tall * k).toFixed(0)}`, role: "img", "aria-label": `${t("building.plan")}, ${storey}: ${flights.map((each) => each.name).join(", ")}` },
      floors.map((each) => s("path", { class: "floor", d: `${line(each.map(at))}Z` })),
      flights.map((flight) => [s("path", { class: "lane", d: `${line(flight.lane.map(at))}Z` }),
        flight.nosings.map(([x1, y1, x2, y2]) => s("path", { class: "nosing", d: line([at([x1, y1]), at([x2, y2])]) }))]),
      flights.map((flight) => {
        const [x, y] = middle(flight.lane);
        return s("text", { x, y: y + 5 }, flight.name);
      })));
}
