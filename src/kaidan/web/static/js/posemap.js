// The map of poses: height of the centroid over place and inclination, and what was driven.

import { Chart } from "./chart.js";
import { h, replace, s } from "./dom.js";
import { said, t } from "./i18n.js";
import { scaleOf } from "./units.js";

export function drawMap(place, map) {
  const { factor, unit } = scaleOf("length");
  const [x, angle] = [map.x_m.map((each) => each * factor), map.inclination_deg];
  const chart = new Chart({
    x: [x[0], x.at(-1)],
    y: [angle[0], angle.at(-1)],
    label: `${t("chart.map")}. ${t("chart.map_says")}`,
    xLabel: t("chart.centroid_axis", { unit }),
    yLabel: t("chart.inclination_axis"),
  });
  chart.inside.append(
    s("image", {
      href: heights(map.height_mm),
      x: chart.x(x[0]),
      y: chart.y(angle.at(-1)),
      preserveAspectRatio: "none",
      width: chart.x(x.at(-1)) - chart.x(x[0]),
      height: chart.y(angle[0]) - chart.y(angle.at(-1)),
    }),
  );
  const draw = (lines, kind) => {
    for (const each of lines)
      chart.curve(
        each.x_m.map((value, index) => [value * factor, each.inclination_deg[index]]),
        kind,
      );
  };
  draw(map.stable, "stable");
  draw(map.ridges, "ridge");
  draw(map.driven, "driven");
  replace(place, chart.node, h("p", { class: "quiet" }, t("chart.map_says")));
}

// Heights as a picture, the lowest light; its rows run upward in the chart.
function heights(rows) {
  const canvas = h("canvas", { width: rows[0].length, height: rows.length });
  const brush = canvas.getContext("2d");
  const picture = brush.createImageData(rows[0].length, rows.length);
  const most = Math.max(...rows.map((row) => Math.max(...row)));
  rows.forEach((row, index) =>
    row.forEach((height, column) => {
      const at = 4 * ((rows.length - 1 - index) * row.length + column);
      const shade = 245 - 190 * Math.sqrt(height / most);
      picture.data.set([shade * 0.82, shade * 0.92, shade, 255], at);
    }),
  );
  brush.putImageData(picture, 0, 0);
  return canvas.toDataURL();
}

export function noMap(place, error) {
  replace(place, h("p", {}, t("chart.map_none")), error ? said(error, "p") : null);
}
