// A scene to scale: what is drawn where has been decided, here it is put down.

function pairs(numbers) {
  const points = [];
  for (let i = 0; i + 1 < numbers.length; i += 2) points.push(`${numbers[i].toFixed(2)},${numbers[i + 1].toFixed(2)}`);
  return points.join(" ");
}

// What is returned shows the scene at a place among the samples.
function picture(stage, run) {
  const { height, marks, arrows, rulers, cut } = run.picture;
  const root = svg("svg", { viewBox: `0 0 1000 ${height}`, role: "img", "aria-label": `${run.title}, drawn to scale` }, stage);

  const forms = {
    circle(shape, [cx, cy, r]) { set(shape, { cx, cy, r }); },
    polygon(shape, n) { set(shape, { points: pairs(n) }); },
    polyline(shape, n) { set(shape, { points: pairs(n) }); },
    ground(shape, [y]) { set(shape, { y }); },
    placed(shape, [x, y, turn, long]) { set(shape, { transform: `translate(${x} ${y}) rotate(${turn}) scale(${long} 1)` }); },
  };
  const elements = { circle: "circle", polygon: "polygon", ground: "rect" };
  const drawn = marks.map((mark) => {
    const shape = svg(elements[mark.form] || "polyline", { class: mark.class }, root);
    if (mark.form === "ground") set(shape, { x: -30000, width: 61000, height: height + 10 });
    if (mark.form === "placed") set(shape, { points: mark.line.map((point) => point.join(",")).join(" ") });
    if (mark.form === "trace") {
      const path = run.time.map((_, i) => pairs(mark.numbers.map((column) => at(column, [i, 0]))));
      return (n, [index]) => set(shape, { points: [...path.slice(0, index + 1), pairs(n)].join(" ") });
    }
    return (n) => forms[mark.form](shape, n);
  });

  // Letters are as large as those of the page, whatever the size of the picture.
  let letter = 16;
  const scales = svg("g", {}, root);
  const fit = () => {
    const wide = root.getScreenCTM();
    if (wide && wide.a > 0) letter = 13 / wide.a;
    root.style.fontSize = `${letter}px`;
    scales.replaceChildren();
    let x = letter;
    const y = height - 0.7 * letter, up = 0.35 * letter;
    rulers.forEach(({ length, text }, i) => {
      const end = x + length;
      const ends = i ? `M${end - up} ${y - up}L${end} ${y}L${end - up} ${y + up}` : `M${x} ${y - up}V${y + up}M${end} ${y - up}V${y + up}`;
      svg("path", { class: "ruler", d: `M${x} ${y}H${end}${ends}` }, scales);
      svg("text", { class: "words", x, y: y - 0.6 * letter }, scales).textContent = text;
      x = Math.max(end, x + 0.6 * letter * text.length) + 1.5 * letter;
    });
  };

  const legend = html("ul", { class: "legend" }, arrows.length ? stage : null);
  const pushes = svg("g", {}, root);
  const pointed = arrows.map((arrow, i) => {
    const shape = svg("polygon", { style: `fill: ${colour(i)}` }, pushes);
    const name = svg("text", { class: "name", style: `fill: ${colour(i)}` }, pushes);
    name.textContent = arrow.name;
    const value = entry(legend, arrow.impulse ? arrow.name : `force ${arrow.name}`, colour(i));
    return (where, taken) => {
      const [x1, y1, dx, dy] = arrow.numbers.map((column) => at(column, where)), [x2, y2] = [x1 + dx, y1 + dy];
      value.textContent = `${digits(at(arrow.size, where))} ${arrow.impulse ? "Ns" : "N"}`;
      const length = Math.hypot(x2 - x1, y2 - y1);
      shape.style.display = length < 2 ? "none" : "";
      name.style.display = "none";
      if (length < 2) return;
      const [ux, uy] = [(x2 - x1) / length, (y2 - y1) / length];
      const thick = letter / 16, tip = Math.min(0.5 * length, 12 * thick), neck = length - tip;
      const corners = [[0, thick], [neck, thick], [neck, 0.45 * tip], [length, 0], [neck, -0.45 * tip], [neck, -thick], [0, -thick]];
      set(shape, { points: pairs(corners.flatMap(([along, left]) => [x1 + along * ux - left * uy, y1 + along * uy + left * ux])) });
      const half = 0.3 * letter * arrow.name.length, within = (v, most, margin) => Math.max(Math.min(v, most - margin), margin);
      // Beyond the end where it does not act.
      const [u, v, out] = arrow.impulse ? [x1, y1, -1] : [x2, y2, 1];
      const x = within(u + out * ux * (half + 6), 1000, half), y = within(v + out * uy * (0.5 * letter + 6), height, 0.6 * letter) + 0.35 * letter;
      set(name, { x, y });
      // A name that would cover another one is left to the legend.
      if (length < 0.5 * letter || taken.some(([a, b, wide]) => Math.abs(x - a) < half + wide && Math.abs(y - b) < letter)) return;
      taken.push([x, y, half]);
      name.style.display = "";
    };
  });
  if (cut) html("p", { class: "note" }, stage, "The strongest forces are drawn shorter than they are.");

  let last = [0, 0];
  const point = (where) => {
    const taken = [];
    for (const one of pointed) one(where, taken);
  };
  const show = (where, pushing) => {
    last = where;
    marks.forEach((mark, i) => drawn[i](mark.numbers.map((column) => at(column, where)), where));
    point(where);
    pushes.style.display = pushing ? "" : "none";
  };
  new ResizeObserver(() => { fit(); point(last); }).observe(root);
  fit();
  return show;
}
