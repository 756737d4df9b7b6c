// The measuring guide: what scales, tape and level say goes to the server, a sheet comes back.

import { Refused, ask } from "./api.js";
import { button } from "./controls.js";
import { fold, fresh, h, replace } from "./dom.js";
import { has, said, t } from "./i18n.js";
import { kept } from "./kept.js";
import { scaleOf } from "./units.js";

const RADIANS = Math.PI / 180;

const ROBOT = [
  ["flat_length", "length"], ["front_scale", "mass"], ["rear_scale", "mass"], ["slope", "angle"],
  ["front_on_slope", "mass"], ["rear_on_slope", "mass"], ["front_radius", "length"], ["rear_radius", "length"],
];
const STAIRS = [["risers", "count"], ["total_rise", "length"], ["total_going", "length"], ["first_rise", "length"]];

function robotOf(found) {
  const { mass, flat_length: L, com_from_front: C_L, com_height: C_N, radii_m: [front, rear] } = found;
  return {
    name: found.name, mass: mass?.value ?? null, com_from_front: C_L.value, com_height: C_N.value,
    track: { flat_length: L.value, front_radius: front ?? 0, rear_radius: rear ?? 0 },
    uncertainty: { com_from_front: C_L.uncertainty, com_height: C_N.uncertainty, flat_length: L.uncertainty },
  };
}

function stairsOf(found) {
  return {
    name: found.name, rise: found.rise_m, going: found.going_m, steps: found.risers,
    first_rise: found.first_rise_m, last_rise: found.last_rise_m,
    uncertainty: {
      angle: found.angle_of_totals_deg * RADIANS, nosing_spacing: found.nosing_spacing_of_totals_m,
      rise: found.rise_spread_m, going: found.going_spread_m,
    },
  };
}

// Guide with fields for one kind of thing; `use(sheet)` takes what follows from them.
export function guide(kind, use) {
  const [fields, verb, sheetOf] = kind === "robot" ? [ROBOT, "measure-robot", robotOf] : [STAIRS, "measure-stairs", stairsOf];
  const mine = kept(`measured ${kind}`, () => ({ name: null, values: {}, found: null, error: null }));
  const name = h("input", { type: "text", value: mine.name ?? t(`${kind}.mine`), id: fresh("name"), oninput: () => { mine.name = name.value; } });
  const inputs = fields.map(([key, of]) => {
    const { factor, unit } = scaleOf(of);
    const held = mine.values[key];
    const input = h("input", {
      type: "number", step: "any", inputmode: "decimal", id: fresh("measure"), value: held === undefined ? null : Number((held * factor).toPrecision(6)),
      oninput() {
        if (input.value === "") delete mine.values[key];
        else mine.values[key] = Number(input.value) / factor;
      },
    });
    return h("div", { class: "measured" }, h("label", { for: input.id }, t(`measure.${key}`)), h("span", { class: "number" }, input, h("span", { class: "unit" }, unit)));
  });
  const outcome = h("div", { "aria-live": "polite" });

  async function workOut() {
    Object.assign(mine, { found: null, error: null });
    mine.draw();
    try {
      const found = await ask(verb, { name: name.value, ...mine.values });
      if (kind === "robot" && !found.com_height) throw new Refused(t("measure.no_height"));
      mine.found = found;
      use(sheetOf(found));
    } catch (error) {
      mine.error = error;
    }
    mine.draw();
  }

  mine.draw = () => {
    const { found, error } = mine;
    if (error) replace(outcome, h("p", { role: "alert", class: "refused" }, error instanceof Refused ? error.message : t("state.offline")));
    else replace(outcome, found ? [h("p", {}, t("measure.done")), h("ul", {}, found.notes.map((note) => said(note, "li")))] : []);
  };
  mine.draw();

  return fold(`guide ${kind}`, t(`${kind}.guide`),
    h("ol", {}, [1, 2, 3, 4].map((each) => `guide.${kind}_${each}`).filter(has).map((each) => h("li", {}, t(each)))),
    h("div", { class: "measured" }, h("label", { for: name.id }, t("saved.name")), name),
    inputs, button(t("measure.work_out"), workOut, { class: "main" }), outcome);
}
