// Controls that the panels share: a slider with a number beside it, a choice, a row of buttons.

import { fresh, h } from "./dom.js";
import { scaleOf } from "./units.js";

// Slider and number field of one figure. `get` gives the SI value, `set(value, done)` takes it;
// `done` is false while the slider is under way. An emptied number field gives null: the sheet's value.
export function slider({ label, kind, low, high, step, get, set }) {
  const id = fresh("figure");
  const { factor, digits, unit } = scaleOf(kind);
  const text = (value) => (value === null || value === undefined ? "" : (value * factor).toFixed(digits));
  const finest = step ? step * factor : 10 ** -digits;
  const common = { min: (low * factor).toFixed(digits), max: (high * factor).toFixed(digits), step: finest };
  const range = h("input", { type: "range", id, ...common, "aria-describedby": `${id}-unit` });
  const number = h("input", { type: "number", ...common, step: "any", "aria-label": label, inputmode: "decimal", placeholder: "–" });
  const take = (input, done) => {
    const value = Number(input.value);
    if (input.value === "" && !input.validity.badInput) return set(null, done);
    if (input.value === "" || !Number.isFinite(value)) return;
    (input === range ? number : range).value = input.value;
    set(value / factor, done);
  };
  range.addEventListener("input", () => take(range, false));
  range.addEventListener("change", () => take(range, true));
  number.addEventListener("change", () => take(number, true));
  const node = h("div", { class: "figure" },
    h("label", { for: id }, label),
    range,
    h("span", { class: "number" }, number, h("span", { id: `${id}-unit`, class: "unit" }, unit)));
  return {
    node,
    update() {
      const value = get();
      if (document.activeElement !== number) number.value = text(value);
      if (document.activeElement !== range) range.value = value === null || value === undefined ? range.min : value * factor;
      range.setAttribute("aria-valuetext", `${text(value)} ${unit}`);
    },
  };
}

// A few alternatives as a row of large buttons (radio buttons to keyboard and screen reader).
export function choice({ label, options, get, set }) {
  const name = fresh("choice");
  const inputs = options.map(([value, text]) => {
    const input = h("input", { type: "radio", name, value, onchange: () => set(value) });
    return [input, h("label", { class: "segment" }, input, h("span", {}, text))];
  });
  return {
    node: h("fieldset", { class: "segments" }, h("legend", {}, label), h("div", {}, inputs.map(([, each]) => each))),
    update() {
      for (const [input] of inputs) input.checked = input.value === get();
    },
  };
}

// A list to choose from, in groups: [[group, [[value, text], ...]], ...].
export function picker({ label, empty, groups, get, set }) {
  const id = fresh("picker");
  const select = h("select", { id, onchange: () => set(select.value) });
  return {
    node: h("div", { class: "picker" }, h("label", { for: id }, label), select),
    update() {
      const options = [];
      if (empty !== null) options.push(h("option", { value: "" }, empty));
      for (const [group, entries] of groups()) {
        if (entries.length === 0) continue;
        const made = entries.map(([value, text]) => h("option", { value }, text));
        options.push(group ? h("optgroup", { label: group }, made) : made);
      }
      select.replaceChildren(...options.flat());
      select.value = get();
    },
  };
}

export function button(text, onclick, attributes = {}) {
  return h("button", { type: "button", onclick, ...attributes }, text);
}

// A file input under its label, with the file that was chosen before the page was built anew.
export function fileField({ label, id, accept = null, file, take }) {
  const input = h("input", { type: "file", id, accept, onchange: () => take(input.files[0] ?? null) });
  if (file) {
    const chosen = new DataTransfer();
    chosen.items.add(file);
    input.files = chosen.files;
  }
  return h("div", { class: "picker" }, h("label", { for: id }, label), input);
}

// A file input that looks like a button; the input itself takes focus and keys.
export function fileButton(text, accept, take) {
  const input = h("input", { type: "file", accept, onchange: () => { if (input.files[0]) take(input.files[0]); input.value = ""; } });
  return h("label", { class: "file" }, input, h("span", {}, text));
}
