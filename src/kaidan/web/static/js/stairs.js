// Panel of the stairs: codes, sliders on a drawing, tape measure, a file.

import { button, choice, picker, slider } from "./controls.js";
import { fold, h, replace, s } from "./dom.js";
import { t, titled } from "./i18n.js";
import { landingsOf } from "./landings.js";
import { guide } from "./measure.js";
import { catalogue, stairsWithFigures, terrainOf, valueOf } from "./question.js";
import { change, clear, packed, state, unpacked } from "./state.js";
import { nameOf, save, sheetsOf } from "./storage.js";
import { figure, shown } from "./units.js";
import { fileReader } from "./upload.js";

const OWN = { name: "measured", rise: 0.18, going: 0.28, steps: 12 };
const FIGURES = [
  ["rise", "length", 0.02, 0.35, 0.001],
  ["going", "length", 0.1, 0.6, 0.001],
  ["steps", "count", 2, 40, 1],
  ["first_rise", "length", 0.02, 0.35, 0.001],
  ["width", "length", 0.3, 3, 0.01],
];

export function stairsPanel(current) {
  const figures = h("div", { class: "figures" });
  const drawing = h("div", { class: "drawing" });
  const slope = h("p", { class: "quiet" });
  const ends = h("div", {});
  const landings = fold("landings", t("landing.heading"), h("p", { class: "quiet" }, t("landing.about")), ends);
  const buttons = h("div", { class: "buttons" });
  const details = fold("stairs", t("stairs.figures"), drawing, slope, figures, landings, buttons);
  const file = fileReader({
    kind: "stairs", label: t("stairs.upload"), accept: "", begins: () => change({ stairs: "" }),
    use(sheet) {
      clear("stairsFigures");
      change({ stairs: packed(sheet) });
      details.open = true;
    },
  });
  const pick = picker({
    label: t("stairs.heading"), empty: t("stairs.choose"), get: () => state.stairs,
    groups: () => {
      const own = packed(OWN);
      const kept = Object.entries(sheetsOf("stairs")).map(([name, sheet]) => [packed(sheet), name]);
      const given = state.stairs.startsWith("~") && state.stairs !== own && !nameOf("stairs", state.stairs)
        ? [[state.stairs, nameIn(unpacked(state.stairs))]] : [];
      return [
        [t("stairs.given"), given], ["", [[own, t("stairs.own")]]], [t("stairs.saved"), kept],
        [t("stairs.catalogue"), catalogue.stairs.map((each) => [each.name, titled(each.title)])],
      ];
    },
    set: (stairs) => { file.forget(); clear("stairsFigures"); change({ stairs }); if (stairs === packed(OWN)) details.open = true; },
  });
  const direction = choice({
    label: t("stairs.direction"), options: [["up", t("stairs.up")], ["down", t("stairs.down")]],
    get: () => state.direction, set: (value) => change({ direction: value }),
  });
  let controls = [], of = null;

  function build(sheet) {
    const regular = !Array.isArray(sheet) && Number.isFinite(sheet.rise);
    const single = !Array.isArray(sheet);
    const own = FIGURES.filter(([name]) => regular || (single && name === "width"));
    const sliders = own.map(([name, kind, low, high, step]) => slider({
      label: t(`figure.${name}`), kind, low, high, step,
      get: () => state.stairsFigures[name] ?? valueOf(sheet, name) ?? (name === "first_rise" ? state.stairsFigures.rise ?? sheet.rise : null),
      set: (value, done) => change({ stairsFigures: { [name]: kind === "count" && value !== null ? Math.round(value) : value } }, { push: done }),
    }));
    const both = single ? landingsOf(sheet) : null;
    controls = both ? [...sliders, both] : sliders;
    landings.hidden = !single;
    replace(ends, both ? both.nodes : []);
    replace(figures, sliders.map((each) => each.node));
    replace(buttons,
      single ? button(t("robot.reset"), () => clear("stairsFigures")) : null,
      button(t("robot.save"), () => {
        const made = single ? stairsWithFigures(sheet) : sheet;
        const name = `${nameIn(made)}${Object.keys(state.stairsFigures).length ? "*" : ""}`;
        save("stairs", name, made);
        clear("stairsFigures");
        change({ stairs: packed(made) });
        current.say(t("saved.done", { name }));
      }));
  }

  return {
    node: h("section", { class: "panel", "aria-label": t("stairs.heading") },
      pick.node, direction.node, details,
      guide("stairs", (sheet) => {
        change({ stairs: packed(sheet), stairsFigures: Object.fromEntries(Object.keys(sheet).map((name) => [name, null])) });
        details.open = true;
      }),
      file.nodes),
    update() {
      pick.update();
      direction.update();
      const sheet = current.stairs;
      details.hidden = !sheet;
      if (!sheet) return;
      if (of !== state.stairs) build(sheet);
      of = state.stairs;
      for (const each of controls) each.update();
      const made = terrainOf(sheet);
      const flight = typeof made === "string" ? sheet : made;
      const rise = flight.rise, going = flight.going;
      const regular = Number.isFinite(rise) && Number.isFinite(going);
      slope.textContent = regular ? t("stairs.slope", {
        angle: shown(Math.atan2(rise, going), "angle"), spacing: shown(Math.hypot(rise, going), "length"),
      }) : "";
      replace(drawing, regular ? stairsDrawing(flight) : Array.isArray(flight.rises) ? unevenStairs(flight) : "");
    },
  };
}

function nameIn(sheet) {
  return Array.isArray(sheet) ? sheet.map((each) => each.name ?? "?").join(" + ") : sheet?.title || sheet?.name || "?";
}

// Steps that differ: each riser and each going, as they were measured.
function unevenStairs({ rises, goings }) {
  const sum = (values) => values.reduce((all, each) => all + each, 0);
  const between = (values) => [Math.min(...values), Math.max(...values)].map((each) => shown(each, "length")).join(" – ");
  const text = t("stairs.uneven", { steps: rises.length, rises: between(rises), goings: between(goings), angle: shown(Math.atan2(sum(rises.slice(1)), sum(goings)), "angle") });
  const k = Math.min(280 / sum(goings), 130 / sum(rises));
  let x = 40, z = 160, path = "M0 160 H40";
  rises.forEach((rise, step) => {
    z -= rise * k;
    path += ` V${z}`;
    x += (goings[step] ?? 0) * k;
    path += goings[step] ? ` H${x}` : "";
  });
  const rows = rises.map((rise, step) => h("tr", {}, h("th", { scope: "row" }, step + 1), h("td", {}, figure(rise, "length")), h("td", {}, figure(goings[step] ?? null, "length"))));
  return [s("svg", { viewBox: "0 0 360 180", role: "img", "aria-label": text, class: "sketch" }, s("path", { class: "ground", d: `${path} H360 V180 H0 Z` })),
    h("p", {}, text),
    fold("each step", t("stairs.each"), h("table", {},
      h("thead", {}, h("tr", {}, [t("stairs.step"), t("figure.rise"), t("figure.going")].map((each) => h("th", { scope: "col" }, each)))), h("tbody", {}, rows)))];
}

// Three steps with rise, going and slope.
function stairsDrawing({ rise, going, first_rise: first }) {
  const label = t("stairs.drawing", { rise: shown(rise, "length"), going: shown(going, "length"), angle: shown(Math.atan2(rise, going), "angle") });
  const start = first ?? rise;
  const k = Math.min(75 / going, 140 / (start + 2 * rise));
  const foot = 80, z = (value) => 160 - value * k;
  let path = `M0 160 H${foot}`, x = foot, height = start;
  path += ` V${z(height)}`;
  for (let step = 0; step < 2; step += 1) {
    x += going * k;
    height += rise;
    path += ` H${x} V${z(height)}`;
  }
  const second = foot + going * k, level = z(start);
  return s("svg", { viewBox: "0 0 360 180", role: "img", "aria-label": label, class: "sketch" },
    s("path", { class: "ground", d: `${path} H360 V180 H0 Z` }),
    s("path", { class: "dimension", d: `M${foot} ${level + 14} H${second} M${foot} ${level + 9} v10 M${second} ${level + 9} v10` }),
    s("text", { x: (foot + second) / 2, y: level + 30, "text-anchor": "middle" }, shown(going, "length")),
    s("path", { class: "dimension", d: `M${second + 12} ${level} V${z(start + rise)} M${second + 7} ${level} h10 M${second + 7} ${z(start + rise)} h10` }),
    s("text", { x: second + 20, y: (level + z(start + rise)) / 2 + 4 }, shown(rise, "length")),
    s("path", { class: "thin", d: `M${foot} ${level} L${x} ${z(height)}` }),
    s("text", { x: foot - 8, y: (160 + level) / 2 + 4, "text-anchor": "end" }, shown(start, "length")));
}
