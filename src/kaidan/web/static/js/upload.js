// A file of others, read by the server; what was found in it is chosen by hand, with its doubt.

import { Refused, upload } from "./api.js";
import { button, fileButton } from "./controls.js";
import { h, replace } from "./dom.js";
import { said, t } from "./i18n.js";
import { kept } from "./kept.js";
import { shown } from "./units.js";

const MOST = 6; // notes that are shown

// Button for a file of robots or stairs, and what was found in it. `begins()` takes back what was chosen before,
// for no verdict on it may stand beside the file; `use(sheet)` takes what was chosen of the file.
export function fileReader({ kind, label, accept, begins, use }) {
  const mine = kept(`file of ${kind}`, () => ({ turn: 0, reading: false, answer: null, error: null }));
  const found = h("div", {});
  mine.draw = draw;
  mine.use = use;

  async function read(file) {
    const turn = forget();
    mine.reading = true;
    mine.draw();
    begins();
    const read = await upload("sheets", file).then((answer) => ({ answer }), (error) => ({ error }));
    if (turn !== mine.turn) return;
    Object.assign(mine, { reading: false }, read);
    if (mine.answer?.[kind].length === 1) mine.use(mine.answer[kind][0]);
    mine.draw();
  }

  // Something else was chosen: what is on its way does not count any more.
  function forget() {
    mine.turn += 1;
    Object.assign(mine, { reading: false, answer: null, error: null });
    return mine.turn;
  }

  function draw() {
    const { reading, answer, error } = mine;
    if (reading) replace(found, h("p", { role: "status" }, t("upload.reading")));
    else if (error) replace(found, h("p", { role: "alert", class: "refused" }, error instanceof Refused ? said(error.message) : t("state.offline")));
    else replace(found, answer ? whatIs(answer) : []);
  }

  function whatIs(answer) {
    const sheets = answer[kind], doubts = answer.notes.slice(0, MOST);
    return [
      h("p", { role: "status" }, sheets.length ? t("upload.doubt") : t("upload.nothing")),
      sheets.length > 1 ? h("p", {}, t("upload.choose")) : null,
      sheets.length > 1 ? h("div", { class: "buttons" }, sheets.map((sheet, row) => button(labelOf(sheet, kind === "stairs" ? answer.storeys[row] : "", row), () => use(sheet)))) : null,
      doubts.length ? h("ul", {}, doubts.map((each) => said(String(each), "li"))) : null,
    ];
  }

  draw();
  return { nodes: [fileButton(label, accept, read), found], forget() { forget(); mine.draw(); } };
}

// What tells one of several from the others: its number, where it begins, its name, its size.
function labelOf(sheet, storey, row) {
  const [first] = [sheet].flat();
  const size = Number.isFinite(first.rise) ? ` (${first.steps} × ${shown(first.rise, "length")} / ${shown(first.going, "length")})` : "";
  return `${row + 1}. ${storey ? `${storey}: ` : ""}${nameOf(sheet)}${size}`;
}

function nameOf(sheet) {
  return Array.isArray(sheet) ? sheet.map((each) => each.name).join(" + ") : sheet.title || sheet.name;
}
