// The answer, the verdict first: symbol, word, reason, what to do, the figures that decide.

import { button } from "./controls.js";
import { fold, h, replace } from "./dom.js";
import { japanese, language, said, t, titled } from "./i18n.js";
import { symbol } from "./light.js";
import { modeName, placeName, reason, stated } from "./sentences.js";
import { KIND_OF_UNIT, figure, shown } from "./units.js";

export function verdictPanel(current) {
  const light = h("div", { class: "light" });
  const aloud = h("p", { class: "visually-hidden", "aria-live": "polite", "aria-atomic": "true" });
  const estimate = h("p", { class: "estimate", hidden: true });
  const body = h("div", { class: "said" });
  let spoken = "";

  function lit(kind, word, ...rest) {
    light.className = `light is-${kind}`;
    light.dataset.verdict = kind;
    replace(light, symbol(kind, 64), h("div", {}, h("strong", { class: "word" }, word), rest));
    current.chip(kind, word);
    if (word !== spoken && kind !== "working") {
      aloud.textContent = `${word}. ${kind === current.answer?.verdict ? said(current.answer.reason).textContent : ""}`;
    }
    if (kind !== "working") spoken = word;
  }

  return {
    node: h(
      "section",
      { class: "answer", id: "answer", tabindex: "-1", "aria-labelledby": "answer-heading" },
      h("h2", { id: "answer-heading", class: "visually-hidden" }, t("answer.heading")),
      aloud,
      light,
      estimate,
      body,
    ),
    empty() {
      estimate.hidden = true;
      lit("empty", t("state.empty"), h("p", {}, t("state.empty_todo")));
      replace(body);
    },
    // Between a change and its answer no verdict stands. Of a slider the estimate before stands until the next.
    working(sliding) {
      lit("working", t("state.working"));
      body.setAttribute("aria-busy", "true");
      if (!sliding) estimate.setAttribute("aria-busy", "true");
    },
    estimated(answer, flat) {
      const text =
        answer && answer.margin_deg !== null
          ? [
              t("state.quick_margin", {
                margin: shown(answer.margin_deg, "degrees", { plus: true }),
              }),
              modeName(answer.governs, answer),
            ].join(", ")
          : t("state.quick_none");
      estimate.hidden = false;
      estimate.removeAttribute("aria-busy");
      estimate.textContent = `${t(flat ? "state.quick_flat" : "state.quick")} ${text}`;
    },
    failed(error) {
      estimate.hidden = true;
      body.removeAttribute("aria-busy");
      const offline = error.constructor.name === "Unreachable";
      lit(
        offline ? "offline" : "failed",
        t(offline ? "state.offline_short" : "state.failed"),
        h("p", { role: "alert" }, offline ? t("state.offline") : said(error.message)),
      );
      replace(
        body,
        offline ? button(t("state.again"), () => current.ask(), { class: "main" }) : null,
      );
    },
    show(answer) {
      estimate.hidden = true;
      body.removeAttribute("aria-busy");
      const { robot, terrain } = answer.question;
      const on = Array.isArray(terrain)
        ? terrain.map((each) => each.name).join(" + ")
        : terrain.name;
      lit(
        answer.verdict,
        t(`verdict.${answer.verdict}`),
        h(
          "p",
          { class: "subject" },
          `${titled(robot.title) || robot.name} · ${on} · ${t(`stairs.${answer.question.direction}`)}, ${t(`answer.${answer.question.facing}`)}`,
        ),
        h("p", { class: "quiet" }, t("state.final")),
      );
      replace(
        body,
        reason(answer),
        turnsOf(answer),
        toDo(answer),
        numbers(answer),
        first(answer),
        notes(answer),
        h(
          "div",
          { class: "buttons" },
          button(t("app.print"), current.print, { class: "main" }),
          button(t("app.report_pdf"), () => current.report("pdf")),
          button(t("app.report_html"), () => current.report("html")),
          button(t("app.share"), current.share),
        ),
      );
    },
  };
}

function toDo(answer) {
  const { plan, what_would_help: help } = answer;
  const planned =
    plan && plan.flippers !== "stowed"
      ? h(
          "ol",
          { class: "plan" },
          plan.steps.map((step) =>
            h(
              "li",
              {},
              h(
                "b",
                {},
                step.before_step === null
                  ? t("answer.at_start")
                  : t("answer.before_step", { step: step.before_step }),
              ),
              " ",
              flippersOf(step),
            ),
          ),
        )
      : null;
  const changes = help.slice(0, 3).map((each) =>
    h(
      "li",
      {},
      said(each.change),
      " ",
      h(
        "span",
        { class: `tag is-${each.verdict}` },
        symbol(each.verdict, 18),
        t(each.verdict === answer.verdict ? "answer.still" : "answer.then", {
          verdict: t(`verdict.${each.verdict}`),
        }),
      ),
      each.margin_deg === null ? null : [" ", figure(each.margin_deg, "degrees", { plus: true })],
    ),
  );
  let otherwise = null;
  if (!planned && changes.length === 0) {
    otherwise = h(
      "p",
      {},
      answer.verdict === "go" ? t("answer.nothing_to_do") : t("answer.nothing_helps"),
    );
  }
  if (answer.verdict === "outside-model" && changes.length === 0) return null;
  return h(
    "div",
    { class: "do" },
    h("h3", {}, t("answer.do")),
    planned,
    changes.length ? h("ul", {}, changes) : null,
    otherwise,
  );
}

// Whether a manoeuvre takes more moves than the robot's sheet counts as sure.
function long(turn) {
  return turn.way === "manoeuvre" && turn.moves > turn.most_moves;
}

// How it turns on landings, or that it does not.
function turnsOf({ turns }) {
  if (turns.length === 0) return null;
  return h(
    "ul",
    { class: "turns", "aria-label": t("landing.turns") },
    turns.map((turn) => {
      const kind =
        turn.way === "none"
          ? "no-go"
          : turn.way === "unknown" || turn.tight || long(turn)
            ? "unsure"
            : "go";
      const landing =
        (language === "ja" ? japanese(turn.landing, "landing") : null) ?? turn.landing;
      const way = turn.way === "manoeuvre" && turn.reversals === 0 ? "forward" : turn.way;
      const how = t(`landing.way_${way}`, {
        moves: turn.moves,
        circle: shown(turn.circle_m, "length"),
        room: shown(turn.room_m, "length"),
      });
      const posture = turn.way === "none" ? "landing.nearest" : "landing.flippers";
      const more = [
        turn.flippers && (turn.way === "none" || turn.changed)
          ? t(posture, { flippers: turn.flippers })
          : "",
        turn.tight && turn.way !== "none" ? t("landing.tight") : "",
        long(turn) ? t("landing.long", { most: turn.most_moves }) : "",
      ];
      return h(
        "li",
        {},
        symbol(kind, 18),
        " ",
        h(
          "b",
          {},
          t("landing.turn_on", {
            landing,
            angle: turn.turn_deg === null ? "?" : `${Math.abs(turn.turn_deg).toFixed(0)}°`,
          }),
        ),
        " ",
        how,
        ...more,
      );
    }),
  );
}

function flippersOf({ front_deg: front, rear_deg: rear, flippers }) {
  const values = { front: shown(front, "degrees"), rear: shown(rear, "degrees") };
  if (front === null && rear === null) return flippers;
  return t(
    front === null ? "answer.only_rear" : rear === null ? "answer.only_front" : "answer.front_rear",
    values,
  );
}

function numbers(answer) {
  const rows = [
    [t("answer.worst"), figure(answer.margin_deg, "degrees", { plus: true, of: "margin_deg" })],
    [
      t("answer.best"),
      figure(answer.margin_best_deg, "degrees", { plus: true, of: "margin_best_deg" }),
    ],
    [
      t("answer.friction_required"),
      figure(answer.required_friction, "friction", { of: "required_friction" }),
    ],
    [t("answer.friction_stated"), h("span", {}, stated(answer.friction))],
    [
      t("answer.probability"),
      answer.failure_probability === null
        ? h("span", { class: "quiet" }, t("answer.probability_none"))
        : figure(answer.failure_probability, "probability", { of: "failure_probability" }),
    ],
    [t("answer.slope"), figure(answer.angle_deg, "degrees", { of: "angle_deg" })],
    [t("answer.spacing"), figure(answer.nosing_spacing_m, "length", { of: "nosing_spacing_m" })],
  ];
  return h(
    "dl",
    { class: "numbers", "aria-label": t("answer.figures") },
    rows.map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))),
  );
}

// What comes before driving: to secure what rocks, which the first note of a ROUGH answer says, or to
// measure what is not known.
function first(answer) {
  if (answer.verdict === "rough") {
    return h("p", { class: "secure" }, h("b", {}, said(answer.notes[0])));
  }
  const measure = answer.to_measure.find((each) => each.share > 0.01);
  if (!measure || answer.verdict !== "unsure") return null;
  return h(
    "p",
    { class: "measure" },
    h("b", {}, `${t("answer.measure")}: `),
    said(measure.what),
    " ",
    t("answer.measure_share", { share: (100 * measure.share).toFixed(0) }),
  );
}

function notes(answer) {
  const all = answer.verdict === "rough" ? answer.notes.slice(1) : answer.notes;
  if (all.length === 0) return null;
  return h(
    "div",
    { class: "notes" },
    fold(
      "notes",
      `${t("answer.notes")} (${all.length})`,
      h(
        "ul",
        {},
        all.map((note) => said(note, "li")),
      ),
    ),
  );
}

// Every failure mode with its margin, as a table.
export function findingsTable(answer) {
  const rows = Object.entries(answer.findings).map(([key, each]) => {
    const kind = KIND_OF_UNIT[each.unit] ?? "friction";
    const holds =
      each.holds === null ? t("answer.maybe") : each.holds ? t("answer.yes") : t("answer.no");
    return h(
      "tr",
      { class: each.holds === false ? "fails" : null },
      h("th", { scope: "row" }, modeName(key, answer)),
      h(
        "td",
        {},
        each.holds === false ? symbol("no-go", 16) : each.holds ? symbol("go", 16) : null,
        h("span", {}, ` ${holds}`),
      ),
      h("td", {}, figure(each.margin, kind, { plus: true, of: `findings.${key}.margin` })),
      h(
        "td",
        {},
        figure(each.margin_best, kind, { plus: true, of: `findings.${key}.margin_best` }),
      ),
      h("td", {}, placeName(each.phase, each.step)),
    );
  });
  return h(
    "div",
    { class: "scroll findings", tabindex: "0", role: "region", "aria-label": t("answer.findings") },
    h(
      "table",
      {},
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          ["mode", "holds", "margin", "margin_best", "where"].map((each) =>
            h("th", { scope: "col" }, t(`answer.${each}`)),
          ),
        ),
      ),
      h("tbody", {}, rows),
    ),
  );
}
