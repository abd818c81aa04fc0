// Runs of one scene in one plot: a coordinate or its rate, or how far the others are from the first run.
function comparison(parent, runs, clock, seek, zoom) {
  const figure = html("figure", { class: "run" }, parent);
  html("figcaption", {}, figure, `Together: ${runs[0].scene}`);
  const row = html("p", { class: "choices" }, figure);
  const what = html("select", {}, html("label", {}, row, "Show "));
  const kinds = [
    (c) => [c.name, named(c.name, c.unit), c.q, c.q_fine],
    (c) => [`d${c.name}/dt`, named(`d${c.name}/dt`, c.rate_unit), c.v, c.v_fine],
    (c) => [`${c.name} less that of the first run`, named(`difference of ${c.name}`, c.unit), c.apart],
  ];
  kinds.forEach((kind, k) => runs[0].phase.forEach((c, i) => html("option", { value: `${k} ${i}` }, what, kind(c)[0])));
  const stage = html("div", {}, figure);
  let last = 0, show = () => {};
  const draw = () => {
    const [k, i] = what.value.split(" ");
    stage.replaceChildren();
    const legend = html("ul", { class: "legend" });
    const lines = runs.map((run, r) => {
      // The first run has no difference from itself.
      const [, , values = run.time.map(() => 0), fine] = kinds[k](run.phase[i]);
      return { name: run.title, ...overTime(run.time, values, fine), dash: dashes[r % dashes.length] };
    });
    const [title, axis] = kinds[k](runs[0].phase[i]);
    show = chart(stage, legend, { title, xName: "time [s]", axis, whole: clock, lines, seek, zoom });
    stage.append(legend);
    show(last);
  };
  what.addEventListener("change", draw);
  draw();
  return (t) => { last = t; show(t); };
}
