// The page: what belongs to no view, and which view is open.

import { onReach } from "./api.js";
import { buildingView } from "./building.js";
import { checkView } from "./check.js";
import { copied, h, replace } from "./dom.js";
import { language, loadTexts, setLanguage, t } from "./i18n.js";
import { symbol } from "./light.js";
import { loadCatalogue } from "./question.js";
import { fillSheet } from "./sheet.js";
import { savedView } from "./saved.js";
import { change, followAddress, packed, readAddress, state, subscribe } from "./state.js";
import { prefer, preference } from "./storage.js";
import { lengths, setLengths } from "./units.js";
import { workView } from "./work.js";

const VIEWS = { check: checkView, building: buildingView, work: workView, saved: savedView };
let views = {}, chip = null, status = null, banner = null, sliding = false, reached = true;

const shell = {
  say: (text) => { status.textContent = text; },
  sliding: () => sliding,
  share,
  print: printed,
  chip(kind, word) {
    replace(chip, symbol(kind, 24), h("span", {}, word));
    chip.className = `chip is-${kind}`;
  },
};

function select(label, name, options, value) {
  return h("label", { class: "setting" }, h("span", {}, label),
    h("select", { id: `setting-${name}`, onchange: (event) => {
      prefer(name, event.target.value);
      apply();
      if (name !== "theme") buildAnew(`setting-${name}`);
    } },
      options.map(([key, text]) => h("option", { value: key, selected: key === value }, text))));
}

// Escape, or going elsewhere, closes the settings.
function shutSettings({ type, key, currentTarget: settings, relatedTarget: to }) {
  if (type === "keydown" ? key === "Escape" : to && !settings.contains(to)) settings.open = false;
}

function apply() {
  setLanguage(preference("language", navigator.language.startsWith("ja") ? "ja" : "en"));
  setLengths(preference("lengths", "mm"));
  document.documentElement.dataset.theme = preference("theme", "auto");
}

// The page in another language or unit, at the same place; views keep what they know, see kept.js.
async function buildAnew(focused) {
  const place = scrollY;
  const drawn = build();
  document.querySelector(".settings").open = true;
  document.getElementById(focused).focus({ preventScroll: true });
  await drawn;
  scrollTo(0, place);
}

// All of the page in one language and one unit.
function build() {
  for (const view of Object.values(views)) view.stop?.();
  document.title = t("app.title");
  chip = h("a", { class: "chip", href: "#answer", onclick: (event) => { event.preventDefault(); const answer = document.getElementById("answer"); answer?.scrollIntoView(); answer?.focus(); } });
  status = h("p", { role: "status", class: "toast" });
  banner = h("p", { role: "status", class: "banner" });
  sayReach();
  views = Object.fromEntries(Object.entries(VIEWS).map(([name, make]) => [name, make(shell)]));
  const links = Object.keys(VIEWS).map((name) => h("a", { href: `#/${name}`, "data-view": name, onclick: (event) => {
    event.preventDefault();
    openView(name);
  } }, t(`app.${name}`)));
  replace(document.getElementById("page"),
    h("a", { class: "skip", href: "#answer", onclick: (event) => { event.preventDefault(); document.getElementById("answer")?.focus(); } }, t("app.skip")),
    h("header", {},
      h("p", { class: "brand" }, h("b", {}, "kaidan"), h("span", { lang: "ja", "aria-hidden": "true" }, " 階段")),
      h("nav", { "aria-label": "kaidan" }, links, h("a", { href: "live.html", onclick: (event) => { event.currentTarget.href = `live.html${watched()}`; } }, t("app.live"))), chip,
      h("details", { class: "settings", onkeydown: shutSettings, onfocusout: shutSettings }, h("summary", {}, t("app.settings")), h("div", {},
        select(t("app.language"), "language", [["en", "English"], ["ja", "日本語"]], language),
        select(t("app.units"), "lengths", [["mm", "mm"], ["in", "inch"]], lengths),
        select(t("app.theme"), "theme", ["auto", "light", "dark", "contrast"].map((each) => [each, t(`app.theme_${each}`)]), preference("theme", "auto"))))),
    banner,
    h("main", { id: "main" }, h("h1", { class: "visually-hidden" }, t("app.title")), Object.values(views).map((view) => view.node)),
    h("div", { id: "sheet" }), status);
  document.body.classList.add("ready");
  return update();
}

function sayReach() {
  banner.hidden = reached;
  banner.textContent = reached ? "" : t("state.offline");
}

// What the live page begins with, behind the "#": of the question what a monitor takes, in one posture.
function watched() {
  const { body } = views.check.current;
  sessionStorage.setItem("kaidan.question", location.hash); // where "back" leads
  if (!body) return "";
  const { robot, stairs, direction, facing, flippers, payload, override } = body;
  return `#${packed({ robot, stairs, direction, facing, payload, override, flippers: flippers === "best" ? null : flippers })}`;
}

function openView(name) {
  change({ view: name });
  document.getElementById("main").scrollIntoView();
}

function update() {
  const open = state.view in views ? state.view : "check";
  for (const [name, view] of Object.entries(views)) view.node.hidden = name !== open;
  for (const link of document.querySelectorAll("nav a")) {
    if (link.dataset.view === open) link.setAttribute("aria-current", "page");
    else link.removeAttribute("aria-current");
  }
  chip.hidden = open !== "check";
  return views[open].update();
}

async function share() {
  shell.say(t(await copied(location.href) ? "app.shared" : "app.not_shared"));
}

function printed() {
  fillSheet(document.getElementById("sheet"), views.check.current.answer);
  window.print();
}

async function begin() {
  apply();
  readAddress();
  for (const name of ["pointerdown", "keydown"]) addEventListener(name, (event) => { sliding = event.target?.type === "range"; }, true);
  onReach((there) => {
    reached = there;
    if (banner) sayReach();
  });
  await loadTexts();
  await loadCatalogue().catch(() => {});
  subscribe(update);
  followAddress();
  addEventListener("beforeprint", () => fillSheet(document.getElementById("sheet"), views.check.current.answer));
  build();
  if ("serviceWorker" in navigator && window.isSecureContext) navigator.serviceWorker.register("sw.js").catch(() => {});
}

begin();
