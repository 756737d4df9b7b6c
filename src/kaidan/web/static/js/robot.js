// Panel of the robot: the catalogue, its figures on a labelled drawing, a file, the guide.

import { button, picker, slider } from "./controls.js";
import { fold, h, replace, s } from "./dom.js";
import { t, titled } from "./i18n.js";
import { guide } from "./measure.js";
import { catalogue, valueOf, withFigures } from "./question.js";
import { change, clear, packed, state, unpacked } from "./state.js";
import { nameOf, save, sheetsOf } from "./storage.js";
import { shown } from "./units.js";
import { fileReader } from "./upload.js";

// Where somebody who describes a robot of their own begins.
const OWN = {
  name: "own", mass: 20, com_from_front: 0.3, com_height: 0.15,
  track: { flat_length: 0.6, front_radius: 0.09, rear_radius: 0.09 },
};
const FIGURES = [
  ["track.flat_length", "flat_length", "length", 0.05, 5],
  ["com_from_front", "com_from_front", "length", -1, 6],
  ["com_height", "com_height", "length", 0.005, 3],
  ["track.front_radius", "front_radius", "length", 0, 0.6],
  ["track.rear_radius", "rear_radius", "length", 0, 0.6],
  ["front_flippers.length", "front_flippers", "length", 0.02, 3],
  ["rear_flippers.length", "rear_flippers", "length", 0.02, 3],
  ["mass", "mass", "mass", 0.5, 1500],
];

const listed = (which) => catalogue.robots.filter(which).map((each) => [each.name, titled(each.title)]);

// Robots of the catalogue to be ticked: their names go into the set that is given.
export function robotBoxes(chosen) {
  return [h("legend", {}, t("building.robots")), catalogue.robots.map((robot) => {
    const box = h("input", { type: "checkbox", value: robot.name, onchange: () => (box.checked ? chosen.add(robot.name) : chosen.delete(robot.name)) });
    box.checked = chosen.has(robot.name);
    const mark = robot.unweighed ? h("small", {}, ` ${t("robot.until_weighed")}`) : null;
    return h("label", { class: "check" }, box, h("span", {}, titled(robot.title), mark));
  })];
}

export function robotPanel(current) {
  const figures = h("div", { class: "figures" });
  const drawing = h("div", { class: "drawing" });
  const changed = h("p", { class: "quiet" });
  const details = fold("robot", t("robot.figures"), drawing, figures, changed);
  const file = fileReader({
    kind: "robots", label: t("robot.upload"), accept: ".toml,.urdf,.sdf,.xml,.xacro", begins: () => change({ robot: "" }), use,
  });
  const pick = picker({
    label: t("robot.heading"), empty: t("robot.choose"), get: () => state.robot,
    groups: () => {
      const own = packed(OWN);
      const kept = Object.entries(sheetsOf("robots")).map(([name, sheet]) => [packed(sheet), name]);
      const given = state.robot.startsWith("~") && state.robot !== own && !nameOf("robots", state.robot)
        ? [[state.robot, unpacked(state.robot)?.title || unpacked(state.robot)?.name || "?"]] : [];
      return [
        [t("robot.given"), given], [t("robot.saved"), kept],
        [t("robot.catalogue"), listed((each) => !each.unweighed)], [t("robot.unweighed"), listed((each) => each.unweighed)],
        ["", [[own, t("robot.own")]]],
      ];
    },
    set: (robot) => { file.forget(); clear("robotFigures"); change({ robot }); if (robot === packed(OWN)) details.open = true; },
  });
  let sliders = [], of = null;

  const kept = button(t("robot.save"), () => {
    const sheet = withFigures(current.robot, state.robotFigures);
    const name = Object.keys(state.robotFigures).length ? `${sheet.name}*` : sheet.name;
    save("robots", name, sheet);
    clear("robotFigures");
    change({ robot: packed(sheet) });
    current.say(t("saved.done", { name }));
  });

  function use(sheet) {
    clear("robotFigures");
    change({ robot: packed(sheet) });
    details.open = true;
  }

  function build(sheet) {
    sliders = FIGURES.filter(([place]) => Number.isFinite(valueOf(sheet, place))).map(([place, name, kind, low, high]) => {
      const base = valueOf(sheet, place);
      const least = Math.max(low, Math.min(0.4 * base, base)), most = Math.min(high, Math.max(1.8 * base, 0.05));
      return slider({
        label: t(`figure.${name}`), kind, low: least, high: most,
        get: () => state.robotFigures[place] ?? base,
        set: (value, done) => change({ robotFigures: { [place]: value } }, { push: done }),
      });
    });
    replace(figures, sliders.map((each) => each.node),
      h("div", { class: "buttons" }, button(t("robot.reset"), () => clear("robotFigures")), kept));
  }

  return {
    node: h("section", { class: "panel", "aria-label": t("robot.heading") },
      pick.node, details,
      guide("robot", use), file.nodes),
    update() {
      pick.update();
      const sheet = current.robot;
      details.hidden = !sheet;
      if (!sheet) return;
      if (of !== state.robot) build(sheet);
      of = state.robot;
      for (const each of sliders) each.update();
      const count = Object.keys(state.robotFigures).length;
      changed.textContent = count ? t("robot.changed", { count }) : "";
      replace(drawing, robotDrawing(withFigures(sheet, state.robotFigures)));
    },
  };
}

// The sheet's main dimensions on a drawing; nose to the right.
export function robotDrawing(sheet) {
  const L = valueOf(sheet, "track.flat_length"), C_L = sheet.com_from_front, C_N = sheet.com_height;
  const front = valueOf(sheet, "track.front_radius") || 0, rear = valueOf(sheet, "track.rear_radius") || 0;
  if (![L, C_L, C_N].every(Number.isFinite)) return h("p", {}, t("answer.unknown"));
  const label = t("robot.drawing", { L: shown(L, "length"), CL: shown(C_L, "length"), CN: shown(C_N, "length"), R: shown(front, "length") });
  const k = 240 / L, x = (value) => 60 + value * k, base = 130;
  const z = (value) => base - Math.min(value * k, 118);
  const com = [x(L - C_L), z(C_N)];
  const hull = `M${x(0)} ${base} H${x(L)} A${front * k} ${front * k} 0 0 0 ${x(L)} ${base - 2 * front * k} L${x(0)} ${base - 2 * rear * k} A${rear * k} ${rear * k} 0 0 0 ${x(0)} ${base} Z`;
  const arrow = (x_1, x_2, at, text) => [
    s("path", { class: "dimension", d: `M${x_1} ${at - 5} v10 M${x_2} ${at - 5} v10 M${x_1} ${at} H${x_2}` }),
    s("text", { x: (x_1 + x_2) / 2, y: at - 4, "text-anchor": "middle" }, text)];
  return s("svg", { viewBox: "0 0 360 200", role: "img", "aria-label": label, class: "sketch" },
    s("path", { class: "robot", d: hull }),
    s("path", { class: "flat", d: `M${x(0)} ${base} H${x(L)}` }),
    arrow(x(0), x(L), 186, `L ${shown(L, "length")}`),
    arrow(com[0], x(L), 160, `C_L ${shown(C_L, "length")}`),
    s("path", { class: "thin", d: `M${com[0]} ${com[1]} V165 M${x(L)} ${base} V191 M${x(0)} ${base} V191` }),
    s("path", { class: "dimension", d: `M${com[0] - 5} ${base} h10 M${com[0]} ${base} V${com[1]}` }),
    s("text", { x: com[0] + 8, y: Math.min((base + com[1]) / 2 + 14, base - 4) }, `C_N ${shown(C_N, "length")}`),
    s("text", { x: x(L) + front * k + 4, y: base - front * k + 4 }, "R"),
    s("text", { x: 4, y: base - rear * k + 4 }, "R"),
    s("circle", { class: "centroid", cx: com[0], cy: com[1], r: 6 }),
    s("circle", { class: "centroid-dot", cx: com[0], cy: com[1], r: 2 }),
    s("text", { class: "quiet", x: 356, y: 12, "text-anchor": "end" }, `${t("robot.front")} →`));
}
