// The margin chart: how steep stairs may be for every nosing spacing, and where these are.

import { Chart } from "./chart.js";
import { h, replace } from "./dom.js";
import { t } from "./i18n.js";
import { figure, scaleOf, shown } from "./units.js";

export function drawMargin(place, curve, answer) {
  if (curve.outside) return replace(place, h("p", {}, t("chart.outside", { why: curve.outside })));
  const { factor, unit } = scaleOf("length");
  const spacings = curve.nosing_spacing_m.map((each) => each * factor);
  const here = [answer.nosing_spacing_m * factor, answer.angle_deg];
  const right = Math.max(spacings.at(-1), here[0] * 1.1);
  const nearest = curve.nosing_spacing_m.reduce(
    (best, each, index) =>
      Math.abs(each - answer.nosing_spacing_m) <
      Math.abs(curve.nosing_spacing_m[best] - answer.nosing_spacing_m)
        ? index
        : best,
    0,
  );
  const [low, high] = [curve.margin_angle_corrected_low_deg, curve.margin_angle_corrected_high_deg];
  const says = t("chart.margin_says", {
    spacing: shown(curve.nosing_spacing_m[nearest], "length"),
    low: shown(low[nearest], "degrees"),
    high: shown(high[nearest], "degrees"),
    here: shown(answer.angle_deg, "degrees"),
  });
  const chart = new Chart({
    x: [0, right],
    y: [0, 90],
    label: `${t("chart.margin")}. ${says}`,
    xLabel: t("chart.spacing_axis", { unit }),
    yLabel: t("chart.slope_axis"),
  });
  const known = spacings.map((x, index) => [x, index]).filter(([, index]) => high[index] !== null);
  chart.band(
    known.map(([x, index]) => [x, high[index], 90]),
    "tips",
  );
  chart.band(
    known.map(([x, index]) => [x, low[index], high[index]]),
    "doubt",
  );
  chart.curve(
    known.map(([x, index]) => [x, high[index]]),
    "limit",
  );
  chart.curve(
    known.map(([x, index]) => [x, low[index]]),
    "limit dashed",
  );
  const least = curve.lower_angle_corrected_high_deg;
  const under = known.filter(([, index]) => least[index] !== null && least[index] > 0);
  chart.band(
    under.map(([x, index]) => [x, 0, least[index]]),
    "tips-up",
  );
  if (known.length) {
    const [x] = known[Math.floor(known.length * 0.7)];
    chart.text(x, 84, t("chart.tips_down"));
    chart.text(known[Math.floor(known.length * 0.25)][0], 8, t("chart.holds"));
  }
  chart.here(...here, t("chart.here"));
  const rows = known
    .filter((_, index) => index % Math.ceil(known.length / 12) === 0)
    .map(([, index]) => [curve.nosing_spacing_m[index], low[index], high[index]]);
  replace(
    place,
    h("p", { class: "quiet" }, t("chart.closed_form")),
    chart.node,
    h("p", {}, says),
    h(
      "details",
      {},
      h("summary", {}, t("chart.alone")),
      h(
        "table",
        {},
        h(
          "thead",
          {},
          h(
            "tr",
            {},
            [t("answer.spacing"), t("answer.worst"), t("answer.best")].map((each) =>
              h("th", { scope: "col" }, each),
            ),
          ),
        ),
        h(
          "tbody",
          {},
          rows.map(([p, worst, best]) =>
            h(
              "tr",
              {},
              h("td", {}, figure(p, "length")),
              h("td", {}, figure(worst, "degrees")),
              h("td", {}, figure(best, "degrees")),
            ),
          ),
        ),
      ),
    ),
  );
}
