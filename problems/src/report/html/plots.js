// The largest of 1, 2 and 5 times a power of ten that is not above x.
function nice(x) {
  const power = 10 ** Math.floor(Math.log10(x));
  return power * (x / power >= 5 ? 5 : x / power >= 2 ? 2 : 1);
}

const dashes = ["none", "7 4", "2 3", "9 3 2 3"];

// A piece of paper as wide as there is room, so that letters keep their size.
function paper(figure) {
  const width = Math.min(Math.max(Math.round(figure.clientWidth) || 440, 280), 1600), height = width > 900 ? 200 : 240;
  const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img" }, figure);
  return { root, left: 62, right: width - 12, top: 26, bottom: height - 40, width, height };
}

// Axes with ticks around ranges; gives the scales.
function axes(box, [x0, x1], [y0, y1], xName, yName) {
  const { root, left, right, top, bottom, height } = box;
  const widen = (a, b) => (b > a ? [a, b] : [a - (Math.abs(a) || 1) * 0.5, b + (Math.abs(b) || 1) * 0.5]);
  [x0, x1] = widen(x0, x1);
  [y0, y1] = widen(y0, y1);
  const air = 0.05 * (y1 - y0);
  [y0, y1] = [y0 - air, y1 + air];
  const X = (x) => left + ((x - x0) / (x1 - x0)) * (right - left);
  const Y = (y) => bottom - ((y - y0) / (y1 - y0)) * (bottom - top);
  const ticks = (from, to, most) => {
    const step = nice((2.4 * (to - from)) / most), decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), list = [];
    const plain = Math.max(Math.abs(from), Math.abs(to)) < 1e6 && decimals < 7;
    for (let i = Math.ceil(from / step); i * step <= to; i++) {
      const text = plain ? (i * step).toFixed(decimals) : (i * step).toPrecision(3);
      list.push([i * step, text.replace(/^-(?=0\.?0*$)/, "").replace("-", "−")]);
    }
    return list;
  };
  for (const [x, text] of ticks(x0, x1, (right - left) / 45)) {
    svg("line", { class: "grid", x1: X(x), x2: X(x), y1: top, y2: bottom }, root);
    svg("text", { class: "words", x: X(x), y: bottom + 18, "text-anchor": "middle" }, root).textContent = text;
  }
  for (const [y, text] of ticks(y0, y1, 10)) {
    svg("line", { class: "grid", x1: left, x2: right, y1: Y(y), y2: Y(y) }, root);
    svg("text", { class: "words", x: left - 6, y: Y(y) + 4, "text-anchor": "end" }, root).textContent = text;
  }
  svg("text", { class: "words", x: right, y: height - 6, "text-anchor": "end" }, root).textContent = xName;
  svg("text", { class: "words", x: 4, y: 14 }, root).textContent = yName;
  return { X, Y, x0, x1 };
}

function range(values) {
  let low = Infinity, high = -Infinity;
  for (const value of values) {
    if (value === null) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low <= high ? [low, high] : [0, 1];
}

const named = (name, unit) => (unit ? `${name} [${unit}]` : name);

// A line that is broken where there is no value.
function path(xs, ys, { X, Y }) {
  let text = "", pen = "M";
  ys.forEach((y, i) => {
    if (y === null) { pen = "M"; return; }
    text += `${pen}${X(xs[i]).toFixed(1)} ${Y(y).toFixed(1)}`;
    pen = "L";
  });
  return text;
}

// The ground of a plot in the colours of the modes.
function shades(box, { X }, run, modes) {
  if (run.phases.length > 60) return;
  for (const { from, to, mode } of run.phases) {
    const fill = colour(modes.indexOf(mode));
    svg("rect", { class: "shade", x: X(from), width: Math.max(X(to) - X(from), 0), y: box.top, height: box.bottom - box.top, style: `fill: ${fill}` }, box.root);
  }
}

// Curves [{ name, times, values, dash }] over the time of the clock; a click goes there. Axes may be those of other plots too.
function curves(figure, legend, { title, axis, span, lines, clock, seek, under }) {
  const box = paper(figure);
  const [low, high] = range(lines.flatMap((line) => line.values));
  const says = `${title}: ${lines.map((line) => line.name).join(", ")} over time, ${axis} from ${digits(low)} to ${digits(high)}`;
  set(box.root, { "aria-label": says });
  const scale = axes(box, clock, span || [low, high], "time [s]", axis);
  if (under) under(box, scale);
  const [x, y, width, height] = [box.left, box.top, box.right - box.left, box.bottom - box.top];
  const inside = svg("svg", { x, y, width, height, viewBox: `${x} ${y} ${width} ${height}` }, box.root);
  const shown = lines.map(({ name, times, values, dash }, i) => {
    svg("path", { class: "curve", style: `stroke: ${colour(i)}`, "stroke-dasharray": dash, d: path(times, values, scale) }, inside);
    return [times, values, entry(legend, name, colour(i), dash)];
  });
  const cursor = svg("line", { class: "cursor", y1: box.top, y2: box.bottom }, box.root);
  box.root.addEventListener("click", (event) => {
    const on = box.root.getBoundingClientRect();
    const at = ((event.clientX - on.left) / on.width) * box.width;
    seek(scale.x0 + ((at - box.left) / (box.right - box.left)) * (scale.x1 - scale.x0));
  });
  return (t) => {
    const now = scale.X(Math.min(Math.max(t, scale.x0), scale.x1));
    set(cursor, { x1: now, x2: now });
    for (const [times, values, output] of shown) {
      output.textContent = digits(t > times[times.length - 1] + 1e-9 ? null : at(values, place(times, t)));
    }
  };
}

// A plot of a run.
function plot(parent, spec, run, { modes, span, clock, seek }) {
  const times = spec.time || run.time;
  const figure = html("figure", {}, parent);
  html("figcaption", {}, figure, spec.title);
  const lines = spec.curves.map(({ name, values, limit }) => ({ name, times, values, dash: limit ? "7 4" : "none" }));
  const legend = html("ul", { class: "legend" });
  const under = (box, scale) => shades(box, scale, run, modes);
  const show = curves(figure, legend, { ...spec, span, lines, clock, seek, under });
  figure.append(legend);
  return show;
}

// Rate over position, for the coordinate that is chosen.
function portrait(parent, coordinates, run, spans) {
  if (!coordinates.length) return () => {};
  const figure = html("figure", {}, parent);
  html("figcaption", {}, figure, "Phase plot");
  const label = html("label", {}, figure, "Coordinate ");
  const select = html("select", { "aria-label": `Coordinate of the phase plot of ${run.title}` }, label);
  coordinates.forEach((c, i) => html("option", { value: i }, select, c.name));
  const box = paper(figure);
  let last = 0, dot, scale, chosen;
  const show = (t) => {
    last = t;
    const where = place(run.time, t);
    set(dot, { cx: scale.X(at(chosen.q, where)), cy: scale.Y(at(chosen.v, where)) });
  };
  const draw = () => {
    chosen = coordinates[select.value];
    box.root.replaceChildren();
    const rate = `d${chosen.name}/dt`;
    set(box.root, { "aria-label": `Phase plot: ${rate} over ${chosen.name}` });
    scale = axes(box, ...spans(select.value), named(chosen.name, chosen.unit), named(rate, chosen.rate_unit));
    svg("path", { class: "curve", style: `stroke: ${colour(0)}`, d: path(chosen.q, chosen.v, scale) }, box.root);
    dot = svg("circle", { class: "point", r: 5 }, box.root);
    show(last);
  };
  select.addEventListener("change", draw);
  draw();
  return show;
}
