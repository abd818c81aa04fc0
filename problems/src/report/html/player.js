
// One clock for all runs.
(() => {
  const { runs } = JSON.parse(document.getElementById("numbers").textContent);
  const element = (id) => document.getElementById(id);
  const [play, scrub, now, speed, arrows] = ["play", "time", "now", "speed", "arrows"].map(element);
  const still = matchMedia("(prefers-reduced-motion: reduce)");
  const first = Math.min(...runs.map((run) => run.time[0] ?? 0));
  const end = Math.max(...runs.map((run) => run.time[run.time.length - 1] ?? 0));
  const duration = Math.max(end - first, 1e-9);
  const stops = [first, ...runs.flatMap((run) => run.events.map((event) => event.time)), end].sort((a, b) => a - b);
  const decimals = Math.max(0, 3 - Math.floor(Math.log10(duration)));
  let time = first, playing = false, since = 0;

  const sections = document.querySelectorAll(".run");
  const views = runs.map((run, i) => {
    const part = (name) => sections[i].querySelector("." + name);
    const shows = [];
    if (!run.time.length) return shows;
    if (run.picture) {
      const show = picture(part("stage"), run);
      shows.push((t) => show(place(run.time, t), arrows.checked));
    }
    shows.push(timeline(part("timeline"), part("mode"), run));
    for (const spec of run.plots) shows.push(plot(part("plots"), spec, run.time, seek));
    shows.push(portrait(part("plots"), run.phase, run.time, run.title));
    return shows;
  });

  // A bar of modes, a colour for each, and the present one in words.
  function timeline(bar, words, run) {
    const modes = [...new Set(run.phases.map((phase) => phase.mode))];
    bar.setAttribute("aria-hidden", "true");
    for (const phase of run.phases) {
      const colour = `var(--c${modes.indexOf(phase.mode) % 6})`;
      html("span", { title: phase.mode, style: `flex: ${Math.max(phase.to - phase.from, 0)} 1 0; background: ${colour}` }, bar);
    }
    const cursor = html("span", { class: "cursor" }, bar);
    const last = run.time[run.time.length - 1], begin = run.time[0], long = last - begin || 1;
    bar.addEventListener("click", (event) => {
      const box = bar.getBoundingClientRect();
      seek(begin + ((event.clientX - box.left) / box.width) * long);
    });
    words.setAttribute("role", "status");
    return (t) => {
      const phase = run.phases.findLast((phase) => phase.from <= t) || run.phases[0];
      const text = phase ? `Mode: ${phase.mode || "one"}${t > last ? " (ended)" : ""}` : "";
      if (words.textContent !== text) words.textContent = text;
      cursor.style.left = `${(Math.min(Math.max((t - begin) / long, 0), 1) * 100).toFixed(2)}%`;
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

  const rates = [0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10, 20];
  const wanted = rates.findLast((rate) => rate <= Math.max(duration / 40, 1) && duration / rate >= 4) ?? 0.05;
  for (const rate of rates) {
    const option = html("option", { value: rate }, speed, `${rate} ×`);
    option.selected = rate === wanted;
  }
  [scrub.min, scrub.max] = [first, end];
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
