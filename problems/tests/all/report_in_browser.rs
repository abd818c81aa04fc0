//! Reports in a real browser: no errors, quickly open, usable from the keyboard, accessible. Skipped where there is no Chromium.
//!
//! Accessibility is judged by axe-core where `AXE` is the path of its `axe.min.js`; `.ci/run` gets it from PyPI.

use crate::browser::{Browser, Reader};
use lagrange_problems::catalogue::scenes;
use std::path::PathBuf;
use std::process::Command;

const AT_A_DESK: Reader = Reader {
    width: 1200,
    dark: false,
    reduced_motion: false,
};
const ON_A_PHONE: Reader = Reader {
    width: 390,
    dark: true,
    reduced_motion: false,
};

/// A file that is removed in the end.
struct Written(PathBuf);

impl Written {
    fn report(name: &str, arguments: &[&str]) -> Self {
        let path = std::env::temp_dir().join(format!("lagrange-{}-{name}", std::process::id()));
        let mut program = Command::new(env!("CARGO_BIN_EXE_lagrange"));
        let program = program
            .arg("report")
            .args(arguments)
            .arg("--output")
            .arg(&path);
        assert!(
            program.status().expect("the program").success(),
            "{arguments:?}"
        );
        Self(path)
    }
}

impl Drop for Written {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

/// The instant that the page shows, s.
fn now(browser: &mut Browser) -> f64 {
    let time = browser.evaluate("Number(document.getElementById('time').value)");
    time.as_f64().expect("a time")
}

#[test]
fn every_page_opens_without_complaints() {
    let Some(mut browser) = Browser::start() else {
        return;
    };
    for (i, scene) in scenes().enumerate() {
        let name = scene.name();
        let page = Written::report(&format!("{name}.html"), &[name]);
        let size = std::fs::metadata(&page.0).expect("the page").len();
        assert!(size < 700_000, "{name}: {size} bytes");
        let reader = if i % 2 == 0 { AT_A_DESK } else { ON_A_PHONE };
        println!("{name} opens in {:.0} ms", browser.open(&page.0, reader));
        assert_eq!(browser.complaints, Vec::<String>::new(), "{name}");
        let wide = browser.evaluate("document.documentElement.scrollWidth");
        let fits = wide
            .as_u64()
            .is_some_and(|wide| wide <= u64::from(reader.width));
        assert!(fits, "{name} is {wide} wide");
        let drawn =
            browser.evaluate("document.querySelectorAll('.stage > svg, .stage > .view').length");
        assert_eq!(drawn, 1, "{name} is drawn");
    }
}

/// How many colours a canvas shows, as an expression of the page.
fn colours(canvas: &str) -> String {
    format!(
        "(() => {{ const c = {canvas}, d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data, seen = new Set();
          for (let i = 0; i < d.length; i += 4) seen.add((d[i] << 16) | (d[i + 1] << 8) | d[i + 2]); return seen.size; }})()"
    )
}

/// Opens a page whose scene in space is drawn in a given way, by WebGL or painted; whether it is.
fn open_drawn(browser: &mut Browser, page: &Written, way: &str, context: &str) -> bool {
    browser.open(&page.0, AT_A_DESK);
    // What `location.hash` is when the page is read decides.
    browser.evaluate(&format!("location.hash = '{way}'"));
    browser.reload();
    let canvas = "document.querySelector('.view canvas')";
    browser.wait(&format!("location.hash === '#{way}' && !!{canvas}"));
    browser.evaluate(&format!("!!{canvas}.getContext('{context}')")) == true
}

/// Where no graphics card works the picture is painted: not blank, and it turns with the arrow keys.
#[test]
fn space_is_painted_without_a_graphics_card() {
    let Some(mut browser) = Browser::start() else {
        return;
    };
    let page = Written::report("painted.html", &["rattleback"]);
    assert!(open_drawn(&mut browser, &page, "painted", "2d"));
    let canvas = "document.querySelector('.view canvas')";
    browser.wait(&format!("{} > 20", colours(canvas)));
    let picture = format!("{canvas}.toDataURL()");
    let before = browser.evaluate(&picture);
    browser.evaluate("document.querySelector('.view').focus()");
    browser.press("ArrowRight");
    let before = serde_json::to_string(&before).expect("text");
    browser.wait(&format!("{picture} !== {before}"));
    assert_eq!(browser.complaints, Vec::<String>::new());
}

/// What WebGL draws is gone after a frame: paper gets a copy of it.
#[test]
fn a_scene_in_space_is_on_paper_too() {
    let Some(mut browser) = Browser::with_webgl() else {
        return;
    };
    let page = Written::report("paper.html", &["rattleback"]);
    if !open_drawn(&mut browser, &page, "webgl", "webgl2") {
        println!("skipped: this chromium has no WebGL");
        return;
    }
    let printed = colours("document.querySelector('.printed')");
    browser.wait(&format!(
        "(dispatchEvent(new Event('beforeprint')), {printed} > 20)"
    ));
    assert_eq!(browser.complaints, Vec::<String>::new());
}

#[test]
fn it_plays_and_is_searched_by_keyboard_and_mouse() {
    let Some(mut browser) = Browser::start() else {
        return;
    };
    let page = Written::report("keys.html", &["mass-on-wheel"]);
    browser.open(&page.0, AT_A_DESK);
    assert_eq!(now(&mut browser), 0.0);
    let playing = "document.getElementById('play').textContent === 'Pause'";
    browser.press(" ");
    browser.wait(playing);
    browser.wait("Number(document.getElementById('time').value) > 0.05");
    browser.press(" ");
    browser.wait(&format!("!({playing})"));
    let paused = now(&mut browser);
    assert_eq!(now(&mut browser), paused);

    let end = 3.007037;
    let near = |t: f64, wanted: f64| assert!((t - wanted).abs() < 1e-4, "{t}, not {wanted}");
    browser.press("Home");
    near(now(&mut browser), 0.0);
    browser.press("ArrowRight");
    near(now(&mut browser), end / 200.0);
    browser.press("ArrowLeft");
    near(now(&mut browser), 0.0);
    for event in [2.461759, 2.732116, end] {
        browser.press("PageDown");
        near(now(&mut browser), event);
    }
    browser.press("PageUp");
    near(now(&mut browser), 2.732116);
    let mode = browser.evaluate("document.querySelector('.mode').textContent");
    assert_eq!(mode, "Mode: rim open");
    browser.press("End");
    near(now(&mut browser), end);

    browser.click(".timeline", 0.5);
    assert!((now(&mut browser) - 0.5 * end).abs() < 0.01);
    browser.click(".plots svg", 0.5);
    assert!((now(&mut browser) - 0.5 * end).abs() < 0.2);
    // The forces of the scene are those that are told beside the plot.
    let told = browser.evaluate("document.querySelector('.stage .legend').textContent");
    assert!(
        told.as_str()
            .is_some_and(|text| text.contains("force rim 1.")),
        "{told}"
    );
    assert_eq!(browser.complaints, Vec::<String>::new());
}

#[test]
fn plots_are_chosen_and_enlarged_and_events_jumped_to() {
    let Some(mut browser) = Browser::start() else {
        return;
    };
    let page = Written::report("plots.html", &["mass-on-wheel"]);
    browser.open(&page.0, AT_A_DESK);
    assert_eq!(
        browser.evaluate("document.querySelectorAll('h1').length"),
        1
    );
    let told = browser.evaluate("document.querySelector('.command code').textContent");
    let told = told.as_str().expect("the command");
    assert!(
        told.starts_with("lagrange report mass-on-wheel --output "),
        "{told}"
    );

    browser.click(".jump", 0.5);
    assert!((now(&mut browser) - 2.461759).abs() < 1e-4);

    // All plots over time show the same part of it.
    let shown = "[...document.querySelectorAll('.all')].filter((button) => !button.hidden).length";
    assert_eq!(browser.evaluate(shown), 0);
    browser.evaluate("document.querySelector('.plots svg').focus()");
    browser.press("+");
    let enlarged = browser.evaluate(shown);
    assert!(
        enlarged.as_u64().is_some_and(|count| count > 3),
        "{enlarged}"
    );
    browser.press("0");
    assert_eq!(browser.evaluate(shown), 0);

    let choose = "(() => { const s = document.querySelector('.plots select'); const names = [...s.options].map((o) => o.text); \
                  s.value = names.indexOf('dθ/dt'); s.dispatchEvent(new Event('change')); \
                  return document.querySelector('.plots .legend').textContent; })()";
    let legend = browser.evaluate(choose);
    assert!(
        legend.as_str().is_some_and(|text| text.contains("dθ/dt")),
        "{legend}"
    );
    assert_eq!(browser.complaints, Vec::<String>::new());
}

/// A slip that turns round some eighty times in a second: the modes take turns in less than the bar can show, one as long as the other.
#[test]
fn short_modes_share_the_bar() {
    let Some(mut browser) = Browser::start() else {
        return;
    };
    let declared = "coordinates(x), kinetic = der(x)^2/2, potential = 31600 * x^2, friction(rub: slip = der(x), limit = 0.1),
        start(out: x = 1), until = 4,";
    let file =
        Written(std::env::temp_dir().join(format!("lagrange-{}.lagrange", std::process::id())));
    std::fs::write(&file.0, declared).expect("a file");
    let page = Written::report("short.html", &[file.0.to_str().expect("a path")]);
    browser.open(&page.0, AT_A_DESK);
    assert_eq!(browser.complaints, Vec::<String>::new());
    let blocks = browser.evaluate(
        "[...document.querySelectorAll('.timeline span:not(.cursor)')].map((block) => block.style.background)",
    );
    let blocks = blocks.as_array().expect("blocks");
    assert!((40..60).contains(&blocks.len()), "{}", blocks.len());
    let shares = blocks.iter().filter(|block| {
        let text = block.as_str().unwrap_or_default();
        text.starts_with("linear-gradient(var(--c0)") && text.contains("var(--c1)")
    });
    assert!(shares.count() > 40, "{blocks:?}");
}

/// v = 1 + 1e-7 sin t, and a coordinate of a million: no two numbers of an axis are alike, and with what it is counted from they
/// are the values.
#[test]
fn numbers_of_a_narrow_axis_differ() {
    let Some(mut browser) = Browser::start() else {
        return;
    };
    let declared =
        "coordinates(x, y), kinetic = (der(x)^2 + der(y)^2)/2, potential = (y - 2500000)^2/2,
        force(push: 1e-7 * cos(t) along der(x)), start(out: der(x) = 1, y = 2500400), until = 10,";
    let file = Written(
        std::env::temp_dir().join(format!("lagrange-{}-narrow.lagrange", std::process::id())),
    );
    std::fs::write(&file.0, declared).expect("a file");
    let page = Written::report("narrow.html", &[file.0.to_str().expect("a path")]);
    browser.open(&page.0, AT_A_DESK);
    let names = "[...document.querySelectorAll('.choices select')][0]";
    for (quantity, low, high) in [
        ("dx/dt", 0.999_999_9, 1.000_000_1),
        ("y", 2_499_600.0, 2_500_400.0),
    ] {
        browser.evaluate(&format!(
            "{names}.value = [...{names}.options].findIndex((option) => option.text === '{quantity}'); {names}.dispatchEvent(new Event('change'))"
        ));
        let texts = browser.evaluate(
            "[...document.querySelector('.choices').closest('figure').querySelectorAll('text')].map((text) => [text.getAttribute('text-anchor') || 'name', text.textContent.replace('−', '-')])",
        );
        let texts = texts.as_array().expect("texts");
        let of = |anchor: &str| -> Vec<&str> {
            let here = texts.iter().filter(|text| text[0] == anchor);
            here.filter_map(|text| text[1].as_str()).collect()
        };
        let name = of("name").join(" ");
        let from = name.split_once(" from ");
        let from: f64 = from.map_or(0.0, |(_, from)| from.parse().expect("a number"));
        // The name of the other axis is on the right, too.
        let ticks: Vec<f64> = of("end")
            .iter()
            .filter_map(|text| text.parse().ok())
            .collect();
        assert!(ticks.len() > 3, "{texts:?}");
        for pair in ticks.windows(2) {
            assert!(pair[1] > pair[0], "{texts:?}");
        }
        let room = 0.1 * (high - low);
        let within = |tick: &f64| (low - room..=high + room).contains(&(from + tick));
        assert!(ticks.iter().all(within), "{texts:?}");
    }
    assert_eq!(browser.complaints, Vec::<String>::new());
}

#[test]
fn long_equations_stay_on_the_page() {
    let Some(mut browser) = Browser::start() else {
        return;
    };
    let page = Written::report("long.html", &["rattleback", "--until", "0.5"]);
    browser.open(&page.0, AT_A_DESK);
    let beyond = "[...document.querySelectorAll('math[display=block]')].filter((math) => !math.closest('td') && \
                  math.getBoundingClientRect().right > math.closest('.scroll').getBoundingClientRect().right + 1).length";
    assert_eq!(browser.evaluate(beyond), 0);
}

/// Where the page draws the name of the push.
fn named(browser: &mut Browser) -> [f64; 2] {
    browser.evaluate(
        "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))",
    );
    let place = "(() => { const e = document.querySelector('.view .name'); return [e.getAttribute('x'), e.getAttribute('y')].map(Number); })()";
    let place = browser.evaluate(place);
    [0, 1].map(|k| place[k].as_f64().expect("a place"))
}

#[test]
fn a_scene_in_space_is_turned_moved_and_zoomed() {
    let Some(mut browser) = Browser::start() else {
        return;
    };
    let page = Written::report("space.html", &["table", "--until", "2"]);
    browser.open(&page.0, AT_A_DESK);
    browser.press("End");
    let time = now(&mut browser);
    let begin = named(&mut browser);
    browser.evaluate("document.querySelector('.view').focus()");
    for key in ["ArrowLeft", "ArrowUp", "+", "t"] {
        let before = named(&mut browser);
        browser.press(key);
        assert_ne!(named(&mut browser), before, "{key}");
    }
    // The keys of the picture are not those of the clock.
    assert_eq!(now(&mut browser), time);
    browser.press("0");
    assert_eq!(named(&mut browser), begin);
    browser.evaluate("document.querySelectorAll('.views button')[1].click()");
    assert_ne!(named(&mut browser), begin);
    assert_eq!(browser.complaints, Vec::<String>::new());
}

#[test]
fn a_scene_that_goes_far_in_a_plane_is_followed() {
    let Some(mut browser) = Browser::start() else {
        return;
    };
    let page = Written::report("far.html", &["backspin-ball"]);
    browser.open(&page.0, AT_A_DESK);
    let window = "document.querySelector('.stage > svg').getAttribute('viewBox')";
    let part = |browser: &mut Browser, k: usize| {
        let number = browser.evaluate(&format!("Number({window}.split(' ')[{k}])"));
        number.as_f64().expect("a number")
    };
    let follow = "document.querySelector('.views button').click()";
    let whole = browser.evaluate(window);
    browser.evaluate(follow);
    assert!(part(&mut browser, 2) < 600.0, "it is enlarged");
    let left = part(&mut browser, 0);
    browser.press("End");
    let moved = (part(&mut browser, 0) - left).abs();
    assert!(moved > 100.0, "{moved}");
    browser.evaluate(follow);
    assert_eq!(browser.evaluate(window), whole);
    assert_eq!(browser.complaints, Vec::<String>::new());
}

#[test]
fn runs_are_compared_on_one_clock() {
    let Some(mut browser) = Browser::start() else {
        return;
    };
    let page = Written::report("both.html", &["mass-on-wheel", "--compare", "without:grip"]);
    browser.open(&page.0, ON_A_PHONE);
    browser.press("End");
    let modes = "[...document.querySelectorAll('.mode')].map((mode) => mode.textContent).join(';')";
    assert_eq!(
        browser.evaluate(modes),
        "Mode: rim open;Mode: rim open (ended)"
    );
    let choices = browser.evaluate("document.querySelector('#together select').length");
    assert_eq!(choices, 12);
    let lines = "(() => { const s = document.querySelector('#together select'); s.value = '2 3'; \
                 s.dispatchEvent(new Event('change')); return document.querySelectorAll('#together .curve').length; })()";
    assert_eq!(browser.evaluate(lines), 2);
    assert_eq!(browser.complaints, Vec::<String>::new());
}

#[test]
fn moving_pictures_move_unless_that_is_unwelcome() {
    let Some(mut browser) = Browser::start() else {
        return;
    };
    let picture = Written::report("wheel.svg", &["mass-on-wheel"]);
    browser.open(&picture.0, AT_A_DESK);
    let x = "(() => { const s = document.documentElement; s.pauseAnimations(); s.setCurrentTime(TIME); \
             return document.querySelector('.moving circle').cx.animVal.value; })()";
    let at = |browser: &mut Browser, time: &str| {
        let value = browser.evaluate(&x.replace("TIME", time));
        value.as_f64().expect("a number")
    };
    let (begin, late) = (at(&mut browser, "0"), at(&mut browser, "5.9"));
    assert!(late > begin + 100.0, "{begin} to {late}");
    let shown = "['.moving', '.still'].map((name) => getComputedStyle(document.querySelector(name)).display).join()";
    assert_eq!(browser.evaluate(shown), "inline,none");
    let quiet = Reader {
        reduced_motion: true,
        ..AT_A_DESK
    };
    browser.open(&picture.0, quiet);
    assert_eq!(browser.evaluate(shown), "none,inline");
    assert_eq!(browser.complaints, Vec::<String>::new());
}

#[test]
fn pages_are_accessible() {
    let Some(axe) = std::env::var_os("AXE") else {
        println!("skipped: AXE does not say where axe.min.js is");
        return;
    };
    let Some(mut browser) = Browser::start() else {
        return;
    };
    let axe = std::fs::read_to_string(axe).expect("axe.min.js");
    let found = "axe.run(document, { resultTypes: ['violations'] }).then((result) => \
                 result.violations.map((v) => `${v.impact} ${v.id}: ${v.nodes[0].html}`).join('\\n'))";
    let both = ["mass-on-wheel", "--compare", "without:grip"];
    let pages: [&[&str]; 5] = [
        &both,
        &["rocking-block"],
        &["double-pendulum"],
        &["cue-ball"],
        &["table"],
    ];
    for (i, arguments) in pages.into_iter().enumerate() {
        let page = Written::report(&format!("axe-{i}.html"), arguments);
        for reader in [AT_A_DESK, ON_A_PHONE] {
            browser.open(&page.0, reader);
            browser.evaluate(&format!("{axe}; 0"));
            assert_eq!(browser.evaluate(found), "", "{arguments:?} {reader:?}");
        }
    }
}
