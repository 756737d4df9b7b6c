// The paper's d-a plane: which acceleration is safe where between two nosings, and what is requested.

import { Chart } from "./chart.js";
import { h, replace } from "./dom.js";
import { t } from "./i18n.js";
import { figure, scaleOf, shown } from "./units.js";

export function drawPlane(place, plane) {
  if (plane.outside || !plane.curves)
    return replace(place, h("p", {}, t("chart.outside", { why: plane.outside ?? "" })));
  const { factor, unit } = scaleOf("length");
  const limits = [
    plane.a_S,
    plane.a_slides_up,
    plane.min_a_r0,
    plane.max_a_rn,
    plane.a_max,
    plane.a_min,
    plane.acceleration,
    0,
  ].filter((each) => each !== null);
  const room = Math.max(0.2 * (Math.max(...limits) - Math.min(...limits)), 0.5);
  const [low, high] = [Math.min(...limits) - room, Math.max(...limits) + room];
  const right = plane.nosing_spacing_m * factor;
  const says = t("chart.plane_says", {
    low: shown(plane.a_min, "friction"),
    high: shown(plane.a_max, "friction"),
    here: shown(plane.acceleration, "friction"),
  });
  const chart = new Chart({
    x: [0, right],
    y: [low, high],
    label: `${t("chart.plane")}. ${says}`,
    xLabel: t("chart.progress_axis", { unit }),
    yLabel: t("chart.a_axis"),
  });
  const named = new Set();
  for (const region of plane.regions) {
    const points = region.d_m.map((d, index) => [
      d * factor,
      region.low[index] ?? low,
      region.high[index] ?? high,
    ]);
    chart.band(points, `area-${region.area}`);
    const middle = points.reduce((best, each) => {
      const room = (point) =>
        chart.clamp(point[2]) - chart.clamp(point[1]) - 0.001 * Math.abs(point[0] - right / 2);
      return room(each) > room(best) ? each : best;
    });
    const [below, above] = [chart.clamp(middle[1]), chart.clamp(middle[2])];
    if (above - below > 0.07 * (high - low) && !named.has(region.area)) {
      chart.text(
        Math.min(Math.max(middle[0], right * 0.16), right * 0.84),
        (below + above) / 2,
        t(`chart.area_${region.area}`),
      );
      named.add(region.area);
    }
  }
  const { d_m: d, a_r0: down, a_rn: up } = plane.curves;
  chart.curve(
    d.map((each, index) => [each * factor, down[index]]),
    "limit",
  );
  chart.curve(
    d.map((each, index) => [each * factor, up[index]]),
    "limit dashed",
  );
  chart.curve(
    [
      [0, plane.acceleration],
      [right, plane.acceleration],
    ],
    "requested",
  );
  chart.here(right / 2, plane.acceleration, t("chart.here"));
  replace(
    place,
    h("p", { class: "quiet" }, t("chart.closed_form")),
    chart.node,
    h(
      "p",
      {},
      says,
      " ",
      h(
        "span",
        { class: "visually-hidden" },
        figure(plane.a_min, "friction", { of: "a_min" }),
        figure(plane.a_max, "friction", { of: "a_max" }),
      ),
    ),
  );
}
