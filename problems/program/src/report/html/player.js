// One clock for all runs.
(() => {
  const { runs, speeds, speed: usual } = JSON.parse(document.getElementById("numbers").textContent);
  const element = (id) => document.getElementById(id);
  const [play, scrub, now, speed, arrows] = ["play", "time", "now", "speed", "arrows"].map(element);
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  const first = Math.min(...runs.map((run) => run.time[0] ?? 0));
  const end = Math.max(...runs.map((run) => run.time[run.time.length - 1] ?? 0));
  const duration = end - first || 1;
  const stops = [first, ...runs.flatMap((run) => run.events.map((event) => event.time)), end].sort((a, b) => a - b);
  const decimals = Math.min(Math.max(0, 3 - Math.floor(Math.log10(duration))), 100);
  let time = first, playing = false, since = 0;

  // Runs of one scene have the same axes.
  const alike = (run) => runs.filter((other) => other.scene === run.scene && other.time.length);
  const modes = [...new Set(runs.flatMap((run) => run.phases.map((phase) => phase.mode)))];
  const spanOf = (run, title, axis) => {
    const same = alike(run).flatMap((other) => other.plots).filter((plot) => plot.title === title && plot.axis === axis);
    const of = (limit) => same.flatMap((plot) => plot.curves.filter((curve) => !!curve.limit === limit).flatMap((curve) => curve.fine?.values || curve.values));
    const [low, high] = range(of(false)), [least, most] = range(of(true));
    if (least === 0 && most === 1 && !of(true).some((value) => value !== null)) return [low, high];
    // What can be held may be far above what is: it leaves the plot then.
    return [Math.min(low, least), high > low ? Math.max(high, Math.min(most, low + 3 * (high - low))) : most];
  };
  const zoom = zooming();
  const sections = document.querySelectorAll(".runs > .run");
  const views = runs.map((run, i) => {
    const part = (name) => sections[i].querySelector("." + name);
    const shows = [];
    if (!run.time.length) return shows;
    if (run.picture || run.space) {
      const show = (run.space ? space : picture)(part("stage"), run);
      shows.push((t) => show(place(run.time, t), arrows.checked));
    }
    shows.push(timeline(part("timeline"), part("mode"), run));
    const common = { modes, clock: [first, end], seek, zoom };
    // Runs of one scene have the same scales.
    const known = (name) => alike(run).map((other) => quantities(other).find((quantity) => quantity.name === name));
    const spans = (name) => range(known(name).flatMap((quantity) => quantity?.fine?.values || quantity?.values || []));
    if (run.phase.length) for (const chosen of [[1, 0], [2, 1]]) shows.push(free(part("plots"), run, chosen, { ...common, spans }));
    for (const spec of run.plots) {
      const span = spanOf(run, spec.title, spec.axis);
      shows.push(plot(part("plots"), spec, run, { ...common, span }));
    }
    for (const note of run.left_out || []) html("p", { class: "note" }, part("plots"), note);
    return shows;
  });
  const scenes = new Set(runs.map((run) => run.scene));
  for (const scene of scenes) {
    const same = runs.filter((run) => run.scene === scene && run.time.length);
    if (same.length > 1 && same[0].phase.length) views.push([comparison(element("together"), same, [first, end], seek, zoom)]);
  }

  // A bar of modes, a colour for each, and the present one in words.
  function timeline(bar, words, run) {
    bar.setAttribute("aria-hidden", "true");
    bar.hidden = words.hidden = run.one_mode;
    const last = run.time[run.time.length - 1], begin = run.time[0], part = (t) => (t - first) / duration;
    const blocks = gathered(run.phases, part).flatMap((phases) => {
      const [from, to] = [phases[0].from, phases[phases.length - 1].to].map(part);
      const title = [...new Set(phases.map((phase) => phase.mode))].join("; ");
      const place = `left: ${100 * from}%; width: ${100 * (to - from)}%; background: ${layers(phases, modes)}`;
      const block = html("span", { title, style: place }, bar);
      return phases.map(() => block);
    });
    const own = [...new Set(run.phases.map((phase) => phase.mode))];
    const legend = html("ul", { class: "legend" });
    if (own.length > 1) bar.after(legend);
    for (const mode of own.slice(0, 8)) entry(legend, mode, colour(modes.indexOf(mode)));
    const cursor = html("span", { class: "cursor" }, bar);
    bar.addEventListener("click", (event) => {
      // A click on a block goes to where it was hit, on its left end to the switch itself.
      const box = bar.getBoundingClientRect(), t = first + ((event.clientX - box.left) / box.width) * duration;
      const near = run.phases.find((phase) => Math.abs(part(phase.from) - part(t)) * box.width < 6);
      seek(near ? near.from : Math.min(Math.max(t, begin), last));
    });
    words.setAttribute("role", "status");
    return (t) => {
      const phase = run.phases.findLast((phase) => phase.from <= t) || run.phases[0];
      const text = phase ? `Mode: ${phase.mode || "one"}${t > last ? " (ended)" : ""}` : "";
      if (words.textContent !== text) words.textContent = text;
      const present = blocks[run.phases.indexOf(phase)];
      for (const block of blocks) block.classList.toggle("present", block === present);
      cursor.style.left = `${(Math.min(Math.max(part(t), 0), 1) * 100).toFixed(2)}%`;
    };
  }

  function show() {
    scrub.value = time;
    now.textContent = `${time.toFixed(decimals)} s`;
    scrub.setAttribute("aria-valuetext", now.textContent);
    for (const view of views) for (const part of view) part(time);
  }

  function seek(t) {
    time = Math.min(Math.max(t, first), end);
    show();
  }

  function run(yes) {
    if (yes && time >= end) time = first;
    playing = yes;
    play.textContent = yes ? "Pause" : "Play";
    since = performance.now();
    if (yes) requestAnimationFrame(tick);
  }

  // Who wants little motion sees a picture now and then.
  function tick(instant) {
    if (!playing) return;
    const passed = (instant - since) / 1000;
    if (passed >= (still.matches ? 0.75 : 0)) {
      since = instant;
      seek(time + Math.max(passed, 0) * Number(speed.value));
    }
    if (time >= end) run(false); else requestAnimationFrame(tick);
  }

  function event(forward) {
    const little = 1e-9 * duration;
    const next = forward ? stops.find((t) => t > time + little) : stops.findLast((t) => t < time - little);
    run(false);
    seek(next ?? (forward ? end : first));
  }

  for (const rate of speeds) {
    const option = html("option", { value: rate }, speed, `${rate} ×`);
    option.selected = rate === usual;
  }
  [scrub.min, scrub.max] = [first, end];
  for (const jump of document.querySelectorAll(".jump")) jump.addEventListener("click", () => { run(false); seek(Number(jump.dataset.time)); });
  for (const copy of document.querySelectorAll(".copy")) {
    copy.hidden = false;
    copy.addEventListener("click", async () => {
      const text = copy.previousElementSibling;
      try { await navigator.clipboard.writeText(text.textContent); } catch (refused) { getSelection().selectAllChildren(text); }
      copy.textContent = "Copied";
    });
  }
  wrapped();
  let wide = innerWidth;
  addEventListener("resize", () => { if (innerWidth !== wide) { wide = innerWidth; wrapped(); } });
  play.addEventListener("click", () => run(!playing));
  element("before").addEventListener("click", () => event(false));
  element("after").addEventListener("click", () => event(true));
  scrub.addEventListener("input", () => { run(false); seek(Number(scrub.value)); });
  arrows.addEventListener("change", show);
  document.addEventListener("keydown", (key) => {
    const busy = key.target.closest("button, select, summary, input:not([type=range]), .scroll");
    if (key.altKey || key.ctrlKey || key.metaKey || busy) return;
    const acts = {
      " ": () => run(!playing),
      ArrowLeft: () => seek(time - duration / 200),
      ArrowRight: () => seek(time + duration / 200),
      PageUp: () => event(false),
      PageDown: () => event(true),
      Home: () => seek(first),
      End: () => seek(end),
    };
    const act = acts[key.key];
    if (!act) return;
    key.preventDefault();
    if (key.key.startsWith("Arrow") || key.key === "Home" || key.key === "End") run(false);
    act();
  });
  element("controls").hidden = false;
  show();
})();
