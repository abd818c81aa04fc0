
const plotBox = { left: 58, right: 430, top: 24, bottom: 200, width: 440, height: 240 };

// Axes with ticks around ranges; gives the scales.
function axes(root, [x0, x1], [y0, y1], xName, yName) {
  const box = plotBox;
  const widen = (a, b) => (b > a ? [a, b] : [a - (Math.abs(a) || 1) * 0.5, b + (Math.abs(b) || 1) * 0.5]);
  [x0, x1] = widen(x0, x1);
  [y0, y1] = widen(y0, y1);
  const air = 0.05 * (y1 - y0);
  [y0, y1] = [y0 - air, y1 + air];
  const X = (x) => box.left + ((x - x0) / (x1 - x0)) * (box.right - box.left);
  const Y = (y) => box.bottom - ((y - y0) / (y1 - y0)) * (box.bottom - box.top);
  const ticks = (from, to) => {
    const step = nice((to - from) / 4), list = [];
    for (let i = Math.ceil(from / step); i * step <= to; i++) list.push(i * step);
    return list;
  };
  for (const x of ticks(x0, x1)) {
    svg("line", { class: "grid", x1: X(x), x2: X(x), y1: box.top, y2: box.bottom }, root);
    svg("text", { x: X(x), y: box.bottom + 18, "text-anchor": "middle" }, root).textContent = digits(x);
  }
  for (const y of ticks(y0, y1)) {
    svg("line", { class: "grid", x1: box.left, x2: box.right, y1: Y(y), y2: Y(y) }, root);
    svg("text", { x: box.left - 6, y: Y(y) + 4, "text-anchor": "end" }, root).textContent = digits(y);
  }
  svg("text", { x: box.right, y: box.height - 8, "text-anchor": "end" }, root).textContent = xName;
  svg("text", { x: 4, y: 14 }, root).textContent = yName;
  return [X, Y, x0, x1];
}

function range(values) {
  let low = Infinity, high = -Infinity;
  for (const value of values) if (value !== null) { low = Math.min(low, value); high = Math.max(high, value); }
  return low <= high ? [low, high] : [0, 1];
}

// A line that is broken where there is no value.
function path(xs, ys, X, Y) {
  let text = "", pen = "M";
  ys.forEach((y, i) => {
    if (y === null) { pen = "M"; return; }
    text += `${pen}${X(xs[i]).toFixed(1)} ${Y(y).toFixed(1)}`;
    pen = "L";
  });
  return text;
}

// Curves over time; a click goes there.
function plot(parent, spec, samples, seek) {
  const times = spec.time || samples;
  const figure = html("figure", {}, parent);
  html("figcaption", {}, figure, spec.title);
  const span = range(spec.curves.flatMap((curve) => curve.values));
  const unit = spec.unit ? ` ${spec.unit}` : "";
  const said = `${spec.title}: ${spec.curves.map((c) => c.name).join(", ")} over time, from ${digits(span[0])} to ${digits(span[1])}${unit}`;
  const root = svg("svg", { viewBox: `0 0 ${plotBox.width} ${plotBox.height}`, role: "img", "aria-label": said }, figure);
  const [X, Y, x0, x1] = axes(root, [times[0], times[times.length - 1]], span, "t [s]", spec.unit ? `[${spec.unit}]` : "");
  const legend = html("ul", { class: "legend" }, figure);
  const shown = spec.curves.map((curve, i) => {
    const colour = `var(--c${i % 6})`;
    svg("path", { class: curve.limit ? "curve limit" : "curve", style: `stroke: ${colour}`, d: path(times, curve.values, X, Y) }, root);
    return [curve.values, entry(legend, curve.name, colour, curve.limit)];
  });
  const cursor = svg("line", { class: "cursor", y1: plotBox.top, y2: plotBox.bottom }, root);
  root.addEventListener("click", (event) => {
    const box = root.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * plotBox.width;
    seek(x0 + ((x - plotBox.left) / (plotBox.right - plotBox.left)) * (x1 - x0));
  });
  return (t) => {
    const where = place(times, t);
    const x = X(Math.min(Math.max(t, x0), x1));
    cursor.setAttribute("x1", x);
    cursor.setAttribute("x2", x);
    for (const [values, output] of shown) output.textContent = digits(at(values, where));
  };
}

// Rate over position, for the coordinate that is chosen.
function portrait(parent, coordinates, samples, name) {
  if (!coordinates.length) return () => {};
  const figure = html("figure", {}, parent);
  html("figcaption", {}, figure, "Phase plot");
  const label = html("label", {}, figure, "Coordinate ");
  const select = html("select", { "aria-label": `Coordinate of the phase plot of ${name}` }, label);
  coordinates.forEach((c, i) => html("option", { value: i }, select, c.name));
  const root = svg("svg", { viewBox: `0 0 ${plotBox.width} ${plotBox.height}`, role: "img" }, figure);
  let last = 0, dot, scales, chosen;
  const show = (t) => {
    last = t;
    const where = place(samples, t);
    dot.setAttribute("cx", scales[0](at(chosen.q, where)));
    dot.setAttribute("cy", scales[1](at(chosen.v, where)));
  };
  const draw = () => {
    chosen = coordinates[select.value];
    root.replaceChildren();
    const named = (name, unit) => (unit ? `${name} [${unit}]` : name);
    const rate = `d${chosen.name}/dt`;
    root.setAttribute("aria-label", `Phase plot: ${rate} over ${chosen.name}`);
    scales = axes(root, range(chosen.q), range(chosen.v), named(chosen.name, chosen.unit), named(rate, chosen.rate_unit));
    svg("path", { class: "curve", style: "stroke: var(--c0)", d: path(chosen.q, chosen.v, scales[0], scales[1]) }, root);
    dot = svg("circle", { class: "point", r: 5 }, root);
    show(last);
  };
  select.addEventListener("change", draw);
  draw();
  return show;
}
