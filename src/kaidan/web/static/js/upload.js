// A file of others, read by the server; what was found in it is chosen by hand, with its doubt.

import { Refused, upload } from "./api.js";
import { button } from "./controls.js";
import { h, replace } from "./dom.js";
import { said, t } from "./i18n.js";
import { shown } from "./units.js";

const MOST = 6; // notes that are shown

// Read a file into `place`; `use(sheet)` takes what was chosen of it.
export async function readFile(file, kind, place, use) {
  replace(place, h("p", { role: "status" }, t("upload.reading")));
  let answer;
  try {
    answer = await upload("sheets", file);
  } catch (error) {
    const text = error instanceof Refused ? said(error.message) : t("state.offline");
    replace(place, h("p", { role: "alert", class: "refused" }, text));
    return;
  }
  const sheets = answer[kind];
  if (sheets.length === 1) use(sheets[0]);
  const doubts = answer.notes.slice(0, MOST);
  replace(place,
    h("p", { role: "status" }, sheets.length ? t("upload.doubt") : t("upload.nothing")),
    sheets.length > 1 ? h("p", {}, t("upload.choose")) : null,
    sheets.length > 1 ? h("div", { class: "buttons" }, sheets.map((sheet, row) => button(labelOf(sheet, kind === "stairs" ? answer.storeys[row] : "", row), () => use(sheet)))) : null,
    doubts.length ? h("ul", {}, doubts.map((each) => said(String(each), "li"))) : null);
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
