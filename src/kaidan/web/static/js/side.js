// The traverse from the side, to scrub and to play: the answer's poses drawn, nothing computed anew.

import { button } from "./controls.js";
import { fold, fresh, h, line, replace, s } from "./dom.js";
import { said, t } from "./i18n.js";
import { kept } from "./kept.js";
import { placeName } from "./sentences.js";
import { figure, shown } from "./units.js";

const MM = 1000;

// Frames of the film: the poses, and between them rotations and moves of the flippers.
function framesOf(found) {
  const frames = [];
  let outline = found.outline;
  found.poses.x_m.forEach((x, row) => {
    frames.push({ row, outline, x, z: found.poses.z_m[row], phi: found.poses.inclination_deg[row], kind: "" });
    const at = (place, kind, shape) => frames.push({ row, outline: shape, x: place.x_m, z: place.z_m, phi: place.inclination_deg, kind });
    for (const rotation of found.rotations.filter((each) => each.row === row)) {
      for (const place of rotation.placements) at(place, "rotating", outline);
    }
    for (const move of found.moves.filter((each) => each.row === row)) {
      for (const pose of move.poses) at(pose.placement, "moving", pose.outline);
      if (move.poses.length) outline = move.poses.at(-1).outline;
    }
  });
  return frames;
}

// Hull of two discs as a path: two arcs and the lines that touch both.
function hull({ x_1_m: x1, z_1_m: z1, radius_1_m: r1, x_2_m: x2, z_2_m: z2, radius_2_m: r2 }) {
  const reach = Math.hypot(x2 - x1, z2 - z1);
  if (reach <= Math.abs(r1 - r2)) return "";
  const along = Math.atan2(z2 - z1, x2 - x1), open = Math.acos((r1 - r2) / reach);
  const at = (x, z, r, angle) => `${((x + r * Math.cos(angle)) * MM).toFixed(1)} ${((z + r * Math.sin(angle)) * MM).toFixed(1)}`;
  const [up, down] = [along + open, along - open];
  const arc = (r, large, end) => (r > 0 ? `A${r * MM} ${r * MM} 0 ${large} 1 ${end}` : `L${end}`);
  return `M${at(x1, z1, r1, up)}${arc(r1, open < Math.PI / 2 ? 1 : 0, at(x1, z1, r1, down))}L${at(x2, z2, r2, down)}${arc(r2, open < Math.PI / 2 ? 0 : 1, at(x2, z2, r2, up))}Z`;
}

function angleOf(part, ahead) {
  const sign = ahead ? 1 : -1;
  const [root, tip] = ahead ? [[part.x_1_m, part.z_1_m], [part.x_2_m, part.z_2_m]] : [[part.x_2_m, part.z_2_m], [part.x_1_m, part.z_1_m]];
  return (Math.atan2(tip[1] - root[1], sign * (tip[0] - root[0])) * 180) / Math.PI;
}

export function sideView() {
  const id = fresh("pose");
  const picture = h("div", { class: "side" });
  const facts = h("dl", { class: "numbers compact" });
  const log = h("div", {});
  const strip = h("div", { class: "strip" });
  const range = h("input", { type: "range", id, min: 0, step: 1, oninput: () => { stop(); show(Number(range.value)); } });
  const play = button(t("side.play"), () => (timer ? stop() : start()), { class: "main" });
  const mine = kept("side", () => ({ report: null, at: 0, follow: true }));
  const follow = h("input", { type: "checkbox", onchange: () => { mine.follow = follow.checked; show(at); } });
  follow.checked = mine.follow;
  const controls = h("div", { class: "player" },
    h("label", { for: id, class: "visually-hidden" }, t("side.position")), range,
    h("div", { class: "buttons" }, play,
      button("◀", () => step(-1), { "aria-label": t("side.back") }),
      button("▶", () => step(1), { "aria-label": t("side.ahead") }),
      button(t("side.deciding"), () => { stop(); show(deciding); }),
      h("label", { class: "check" }, follow, h("span", {}, t("side.follow")))));
  const whole = h("div", {}, picture, h("p", { class: "quiet" }, t("side.legend")), controls, strip, facts,
    fold("log", t("side.log"), log));
  const node = h("div", {}, whole);
  let found = null, frames = [], at = 0, deciding = 0, timer = null, drawn = null;

  function stop() {
    cancelAnimationFrame(timer);
    timer = null;
    play.textContent = t("side.play");
  }

  function start() {
    if (frames.length === 0) return;
    if (at >= frames.length - 1) at = 0;
    play.textContent = t("side.pause");
    const began = performance.now(), from = at, speed = matchMedia("(prefers-reduced-motion: reduce)").matches ? 15 : 45;
    const tick = (now) => {
      const next = Math.min(frames.length - 1, from + Math.floor(((now - began) / 1000) * speed));
      show(next);
      if (next >= frames.length - 1) stop();
      else timer = requestAnimationFrame(tick);
    };
    timer = requestAnimationFrame(tick);
  }

  function step(by) {
    stop();
    show(Math.max(0, Math.min(frames.length - 1, at + by)));
  }

  function build() {
    const { points_m: points, nosings_m: nosings } = found.profile;
    const bottom = Math.min(...points.map((each) => each[1])) - 3;
    const ground = line(points.map(([x, z]) => [x * MM, z * MM]));
    const [first, last] = [points[0], points.at(-1)];
    drawn = {
      ground: s("path", { class: "ground", d: `${ground}L${(last[0] + 50) * MM} ${last[1] * MM}V${bottom * MM}H${(first[0] - 50) * MM}V${first[1] * MM}Z` }),
      path: s("path", { class: "path", d: line(found.poses.x_m.map((x, row) => [x * MM, found.poses.z_m[row] * MM])) }),
      nosings: s("g", {}, nosings.map(([x, z]) => s("circle", { class: "nosing", cx: x * MM, cy: z * MM, r: 9 }))),
      robot: s("g", {}), forces: s("g", {}),
      svg: null,
    };
    drawn.svg = s("svg", { role: "img", class: "traverse" },
      s("g", { transform: "scale(1 -1)" }, drawn.ground, drawn.nosings, drawn.path, drawn.robot, drawn.forces));
    replace(picture, drawn.svg);
  }

  function frame(pose) {
    const size = Math.max(...pose.outline.flatMap((part) => [Math.hypot(part.x_1_m, part.z_1_m) + part.radius_1_m, Math.hypot(part.x_2_m, part.z_2_m) + part.radius_2_m]));
    const wide = window.innerWidth < 600 ? 1.5 : 2.1;
    if (follow.checked) return [(pose.x - wide * size) * MM, -(pose.z + 1.15 * size) * MM, 2 * wide * size * MM, 2.2 * size * MM];
    const { x_m: x, z_m: z } = found.poses;
    const [left, right] = [Math.min(...x) - 1.2 * size, Math.max(...x) + 1.2 * size];
    const [low, high] = [Math.min(...z) - size, Math.max(...z) + 1.1 * size];
    return [left * MM, -high * MM, (right - left) * MM, (high - low) * MM];
  }

  function show(index) {
    at = index;
    mine.at = index;
    const pose = frames[index];
    range.value = index;
    range.setAttribute("aria-valuetext", `${placeName(found.poses.phase[pose.row])}, ${shown(pose.phi, "degrees")}`);
    drawn.svg.setAttribute("viewBox", frame(pose).map((each) => each.toFixed(0)).join(" "));
    drawn.svg.setAttribute("aria-label", t("side.picture", {
      pose: index + 1, of: frames.length, phase: placeName(found.poses.phase[pose.row]), angle: shown(pose.phi, "degrees"),
    }));
    const parts = pose.outline.filter((part) => part.kind !== "belly").sort((a, b) => (a.kind === "flipper") - (b.kind === "flipper"));
    drawn.robot.setAttribute("transform", `translate(${pose.x * MM} ${pose.z * MM}) rotate(${pose.phi})`);
    drawn.robot.replaceChildren(...parts.map((part) => s("path", { class: `robot ${part.kind}`, d: hull(part) })));
    drawForces(pose);
    drawFacts(pose);
    mark.setAttribute("x1", (index / Math.max(1, frames.length - 1)) * 1000);
    mark.setAttribute("x2", (index / Math.max(1, frames.length - 1)) * 1000);
  }

  function drawForces(pose) {
    const { poses } = found;
    const [x, z] = [pose.x * MM, pose.z * MM];
    const size = 250, tilt = poses.gravity_tilt[pose.row] ?? 0;
    const marks = [
      s("path", { class: "gravity", d: `M${x - tilt * 600} ${z + 600}L${x + tilt * 2000} ${z - 2000}` }),
      s("circle", { class: "centroid", cx: x, cy: z, r: 16 }), s("circle", { class: "centroid-dot", cx: x, cy: z, r: 6 }),
    ];
    for (const force of pose.kind ? [] : poses.forces[pose.row]) {
      const [fx, fz] = [force.x_m * MM, force.z_m * MM];
      marks.push(s("circle", { class: "contact", cx: fx, cy: fz, r: 12 }));
      const { load_over_weight: load, traction_over_weight: traction } = force;
      if (!load || traction === null) continue;
      const end = [fx + size * (load * force.normal_x + traction * force.normal_z), fz + size * (load * force.normal_z - traction * force.normal_x)];
      const turn = (Math.atan2(end[1] - fz, end[0] - fx) * 180) / Math.PI;
      marks.push(s("path", { class: "force", d: `M${fx} ${fz}L${end[0]} ${end[1]}` }),
        s("path", { class: "head", d: "M10 0L-34 16V-16Z", transform: `translate(${end[0]} ${end[1]}) rotate(${turn})` }));
    }
    drawn.forces.replaceChildren(...marks);
  }

  function drawFacts(pose) {
    const { poses } = found, row = pose.row;
    const friction = poses.required_friction[row];
    const doing = pose.kind ? ` (${t(`side.${pose.kind}`)})` : "";
    const flippers = pose.outline.filter((part) => part.kind === "flipper")
      .map((part) => [part.x_1_m + part.x_2_m > 0, part])
      .sort(([one]) => (one ? -1 : 1))
      .map(([ahead, part]) => [t(ahead === (found.assessment.question.facing === "nose-first") ? "ground.front" : "ground.rear"), angleOf(part, ahead)]);
    replace(facts, [
      [t("side.phase"), `${placeName(poses.phase[row])}${doing}`],
      [t("side.inclination"), figure(pose.phi, "degrees", { of: "inclination_deg" })],
      [t("side.friction"), friction === null ? t("side.no_friction") : figure(friction, "friction", { of: "pose.required_friction" })],
      [t("side.energy"), figure(poses.energy_margin_mm[row], "millimetres", { of: "pose.energy_margin_mm" })],
      ...flippers.map(([name, angle]) => [name, shown(angle, "degrees")]),
    ].map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))));
  }

  let mark = s("line", {});
  // Friction required along the film, with the band that is stated.
  function drawStrip() {
    const needed = frames.map((each) => found.poses.required_friction[each.row]);
    const band = found.assessment.friction ?? [];
    const top = 1.15 * Math.max(0.2, ...needed.filter((each) => each !== null), ...band);
    const y = (value) => 100 - (100 * value) / top;
    mark = s("line", { class: "now", y1: 0, y2: 100 });
    replace(strip, s("svg", { viewBox: "0 0 1000 100", preserveAspectRatio: "none", role: "img", "aria-label": t("side.strip") },
      band.length ? s("rect", { class: "band", x: 0, width: 1000, y: y(band[1]), height: Math.max(2, y(band[0]) - y(band[1])) }) : null,
      s("path", { class: "curve", d: line(needed.map((each, index) => (each === null ? null : [(1000 * index) / Math.max(1, needed.length - 1), y(each)]))) }),
      mark), h("p", { class: "quiet" }, t("side.strip")));
  }

  return {
    node,
    stop,
    show(report) {
      stop();
      found = report;
      frames = framesOf(found);
      if (frames.length === 0) { replace(node, h("p", {}, t("side.none"))); return; }
      replace(node, whole);
      deciding = Math.max(0, frames.findIndex((each) => each.row === found.poses.governing_row));
      range.max = frames.length - 1;
      build();
      drawStrip();
      replace(log, h("ol", {}, found.event_log.map((entry) => h("li", {},
        h("button", { type: "button", class: "link", onclick: () => { stop(); show(frames.findIndex((each) => each.row === entry.row)); } },
          placeName(entry.phase, entry.step)), " ", said(entry.text)))));
      const before = mine.report === report ? mine.at : deciding;
      mine.report = report;
      show(before);
    },
    none(text) {
      stop();
      found = null;
      frames = [];
      replace(node, h("p", {}, text ?? t("side.none")));
    },
  };
}
