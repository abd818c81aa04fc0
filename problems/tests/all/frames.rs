//! `lagrange report` for slides: numbered frames, and a picture that moves by itself.

use crate::markup::unclosed;
use crate::program::{folder, lagrange_in, refuses, says, text};
use lagrange_problems::catalogue::scenes;
use lagrange_program::report::frames::{Clock, Panel, animated, stills};
use lagrange_program::request::Request;

#[test]
fn every_scene_moves_in_a_file_that_is_whole_and_small() {
    for scene in scenes() {
        let request = Request {
            samples: 300,
            ..Request::default()
        };
        let film = scene.film(&request).expect("a film");
        let name = scene.name();
        let panels = [Panel {
            title: name,
            film: &film,
        }];
        let clock = Clock::new(&panels, 25.0, None).expect("a clock");
        let picture = animated(&panels, &clock);
        assert_eq!(unclosed(&picture), Vec::<&str>::new(), "{name}");
        assert!(
            !picture.contains("NaN") && !picture.contains("var("),
            "{name}"
        );
        assert!(picture.len() < 1_000_000, "{name}: {} bytes", picture.len());
        assert!(picture.contains("<animate"), "{name}");
        // All lists of values are as long: instants are shown equally long.
        let animate = picture.split("<animate ").skip(1);
        let lists = animate.filter(|tag| !tag.contains("calcMode"));
        let lengths: Vec<usize> = lists
            .filter_map(|tag| tag.split("values=\"").nth(1)?.split('"').next())
            .map(|values| values.split(';').count())
            .collect();
        assert!(lengths.iter().all(|n| *n == lengths[0]), "{name}");
        let first = stills(&panels, &clock).next().expect("a frame");
        assert_eq!(unclosed(&first), Vec::<&str>::new(), "{name}");
    }
}

/// A marble that falls into a bowl in space, 0.284 s after it was dropped (√(2 (0.15 + 0.2458)/9.81)).
const MARBLE: &str = "
    parameters(mass = 0.02, radius = 0.3, marble = 0.02, gravity = 9.81, aside = 0.12),
    coordinates(x, y, z),
    define(distance = sqrt(x^2 + y^2 + z^2)),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    potential = mass * gravity * z,
    contact(bowl: distance <= radius - marble, restitution = 1/2),
    start(dropped: x = aside, y = aside/2, z = radius/2),
    draw(floor: -radius),
    draw(bowl: (0, 0, 0), radius = radius),
    draw(shell: (-2*radius, 0, -radius/2), radius = radius/2),
    draw(sphere: (x, y, z), radius = marble),
    draw(pivot: (0, 0, radius)),
    draw(arrow: bowl * (-x/distance, -y/distance, -z/distance) at (x, y, z)),
    until = 0.6,
";

/// In space an impulse is an arrow that ends in a dot where it acts; the wall of a bowl hides what lies in it.
#[test]
fn impulses_and_hidden_things_in_space() {
    let scene = lagrange_program::file::scene("marble.lagrange", MARBLE).expect("a declaration");
    let film = scene
        .film(&Request {
            samples: 200,
            ..Request::default()
        })
        .expect("a film");
    let panels = [Panel {
        title: "marble",
        film: &film,
    }];
    let frame = |time: f64| {
        let clock = Clock {
            instants: vec![time],
            rate: 25.0,
        };
        stills(&panels, &clock).next().expect("a frame")
    };
    let (before, after) = (frame(0.27), frame(0.29));
    let dots = |frame: &str| frame.matches(" r=\"4\"").count();
    assert_eq!(dots(&before), 0);
    assert_eq!(dots(&after), 1);
    assert!(!before.contains(">impulse of bowl<") && after.contains(">impulse of bowl<"));
    // The stripes of the marble, then the wall, then the arrow.
    let at = |part: &str| {
        after
            .find(part)
            .unwrap_or_else(|| panic!("{part} in {after}"))
    };
    let (ball, wall) = (at("url(#round)"), at("fill-rule=\"evenodd\""));
    let last_ball = after.rfind("url(#round)").expect("the marble");
    assert!(ball < wall && last_ball < wall && wall < at(">impulse of bowl<"));
    assert_eq!(unclosed(&after), Vec::<&str>::new());
    let moving = animated(&panels, &Clock::new(&panels, 25.0, None).expect("a clock"));
    assert_eq!(unclosed(&moving), Vec::<&str>::new());
    assert!(moving.contains("<circle"));
}

#[test]
fn frames_are_numbered_and_show_their_instants() {
    let folder = std::env::temp_dir().join(format!("lagrange-frames-{}", std::process::id()));
    let path = folder.to_str().expect("UTF-8");
    let wheel = ["report", "mass-on-wheel", "--fps", "2", "--speed", "0.5"];
    says(&[&wheel[..], &["--frames", path]].concat());
    let mut names: Vec<String> = std::fs::read_dir(&folder)
        .expect("the folder")
        .map(|file| {
            file.expect("a file")
                .file_name()
                .into_string()
                .expect("UTF-8")
        })
        .collect();
    names.sort();
    // A quarter of a second apart, and the end at 3.007 s.
    let expected: Vec<String> = (1..=14).map(|i| format!("frame-{i:04}.svg")).collect();
    assert_eq!(names, expected);
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).expect("a frame");
    let slips = read("frame-0011.svg");
    assert!(
        slips.contains("t = 2.500 s") && slips.contains(">rim closed, grip slips forward</text>")
    );
    // Both arrows at the mass, and their names.
    assert!(slips.contains(">rim</text>") && slips.contains(">grip</text>"));
    let end = read("frame-0014.svg");
    assert!(end.contains("t = 3.007 s") && !end.contains(">grip</text>"));
    says(&[&wheel[..], &["--until", "1", "--frames", path]].concat());
    assert_eq!(std::fs::read_dir(&folder).expect("the folder").count(), 5);
    std::fs::remove_dir_all(&folder).expect("it is ours");
}

#[test]
fn what_makes_no_sense_is_refused() {
    let long = ["report", "kepler", "--frames", "frames", "--speed", "0.01"];
    refuses(&long, 2, "choose a lower --fps");
    let longest = [
        "report", "kepler", "--output", "a.svg", "--until", "1", "--speed", "1e-300",
    ];
    refuses(&longest, 2, "that makes 2.5e301 pictures, more than 10000;");
    let both = [
        "report", "kepler", "--frames", "frames", "--output", "a.svg",
    ];
    refuses(&both, 2, "--output");
    let page = ["report", "kepler", "--frames", "frames", "--format", "html"];
    refuses(&page, 2, "--format svg or --format png");
    refuses(&["report", "kepler", "--fps", "0"], 2, "above 0");
    assert!(!std::path::Path::new("frames").exists());
    let place = folder("frames-of-nothing");
    let declared = "coordinates(x), kinetic = der(x)^2, start(a: der(x) = 1), until = 1,";
    std::fs::write(place.join("bare.lagrange"), declared).expect("a file");
    for (frames, reason) in [
        (
            "frames",
            "nothing of bare.lagrange is drawn: declare `draw(…)`",
        ),
        ("bare.lagrange", "cannot make bare.lagrange: it is a file"),
    ] {
        let scene = if frames == "frames" {
            "bare.lagrange"
        } else {
            "kepler"
        };
        let said = lagrange_in(&place, &["report", scene, "--frames", frames]);
        assert!(
            text(&said.stderr).contains(reason),
            "{}",
            text(&said.stderr)
        );
    }
}

/// What is drawn of paths in a picture: the points of every stroke.
fn strokes(picture: &str) -> Vec<Vec<[f64; 2]>> {
    let lines = picture.split("class=\"trace\" d=\"").skip(1);
    let lines = lines.filter_map(|rest| rest.split('"').next());
    let point = |text: &str| {
        let (x, y) = text.split_once(' ').expect("a point");
        [x, y].map(|number| number.parse().expect("a number"))
    };
    let strokes = lines.flat_map(|line| line.split('M').skip(1));
    strokes
        .map(|stroke| stroke.split('L').map(point).collect())
        .collect()
}

/// A charge in a magnetic field goes round a circle of radius v m / (q B) about a point beside its start, 477 times between 300 samples.
#[test]
fn the_path_of_a_circle_is_round_however_often_it_is_gone_round() {
    let declared = "parameters(m = 2, v = 3, b = 120), coordinates(x, y),
        kinetic = m/2*(der(x)^2 + der(y)^2) + b/2*(x*der(y) - y*der(x)), start(go: x = 0.3, der(y) = v),
        draw(path: (x, y)), draw(mass: (x, y)), until = 50,";
    let scene = lagrange_program::file::scene("charge.lagrange", declared).expect("a declaration");
    let request = Request {
        samples: 300,
        ..Request::default()
    };
    let film = scene.film(&request).expect("a film");
    let panels = [Panel {
        title: "charge",
        film: &film,
    }];
    let clock = Clock::new(&panels, 5.0, None).expect("a clock");
    let last = stills(&panels, &clock).last().expect("a frame");
    for picture in [last, animated(&panels, &clock)] {
        let strokes = strokes(&picture);
        let ends = |k: usize| {
            let values = strokes.iter().flatten().map(|point| point[k]);
            let least = values.clone().fold(f64::INFINITY, f64::min);
            [least, values.fold(f64::NEG_INFINITY, f64::max)]
        };
        let ([left, right], [top, bottom]) = (ends(0), ends(1));
        let radius = 0.5 * (right - left);
        // The whole is 1000 wide, with some air around.
        assert!((400.0..500.0).contains(&radius), "{radius}");
        let mut seen = [false; 72];
        for pair in strokes.iter().flat_map(|stroke| stroke.windows(2)) {
            for part in [0.0, 0.5, 1.0] {
                let at = |k: usize| pair[0][k] + part * (pair[1][k] - pair[0][k]);
                let (x, y) = (at(0) - 0.5 * (left + right), at(1) - 0.5 * (top + bottom));
                assert!((x.hypot(y) - radius).abs() < 1.0, "{x} {y} {radius}");
                seen[((y.atan2(x).to_degrees() + 180.0) / 5.0) as usize % 72] = true;
            }
        }
        assert!(seen.iter().all(|seen| *seen), "{seen:?}");
        let points: usize = strokes.iter().map(Vec::len).sum();
        assert!(points < 2000, "{points}");
    }
}

/// A length that shrinks evenly, so that its root ends after 1 s and a radius that is as long is negative from then on.
const SHRINKS: &str = "
    coordinates(x),
    kinetic = der(x)^2/2,
    start(go: x = 1, der(x) = -1),
    draw(disc: (0, 1), radius = x),
    draw(path: (sqrt(x), 0)),
    draw(rod: (0, 0) to (sqrt(x), 0)),
    draw(arrow: (0, ln(x)) at (1, 1), name = fall),
    until = 2,
";

#[test]
fn what_has_no_place_is_not_drawn_and_told() {
    let scene = lagrange_program::file::scene("shrinks.lagrange", SHRINKS).expect("a declaration");
    let request = Request {
        samples: 400,
        ..Request::default()
    };
    let film = scene.film(&request).expect("a film");
    let names: Vec<&str> = film.nowhere.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["disc", "path", "rod", "fall"]);
    let near = |(_, first): &(&str, f64)| (first - 1.0).abs() < 0.02;
    assert!(film.nowhere.iter().all(near), "{:?}", film.nowhere);
    let panels = [Panel {
        title: "shrinks",
        film: &film,
    }];
    let clock = Clock {
        instants: vec![0.5, 1.5],
        rate: 25.0,
    };
    let frames: Vec<String> = stills(&panels, &clock).collect();
    let drawn = |part: &str| [0, 1].map(|k| frames[k].matches(part).count());
    assert_eq!(drawn("class=\"body\""), [1, 0]);
    // The spoke of the disc, and the rod.
    assert_eq!(drawn("class=\"rod\""), [2, 0]);
    assert_eq!(drawn("<polygon fill"), [1, 0]);
    // The path goes from √1 to √½, and then on to 0.
    let [half, whole] = [0, 1].map(|k| strokes(&frames[k]).concat());
    let long = |line: &[[f64; 2]]| line[0][0] - line[line.len() - 1][0];
    let part = long(&half) / long(&whole);
    assert!((part - (1.0 - 0.5_f64.sqrt())).abs() < 0.02, "{part}");
    for picture in frames.iter().chain(&[animated(&panels, &clock)]) {
        assert!(
            !picture.contains("NaN") && !picture.contains("r=\"-"),
            "{picture}"
        );
        assert_eq!(unclosed(picture), Vec::<&str>::new());
    }
}

/// A picosecond.
#[test]
fn the_clock_of_a_short_film_has_digits() {
    let declared = "coordinates(x), kinetic = der(x)^2/2, start(go: der(x) = 1), draw(mass: (x, 0)), until = 1e-12,";
    let scene = lagrange_program::file::scene("short.lagrange", declared).expect("a declaration");
    let film = scene.film(&Request::default()).expect("a film");
    let panels = [Panel {
        title: "short",
        film: &film,
    }];
    let clock = Clock::new(&panels, 25.0, None).expect("a clock");
    assert!(clock.instants.len() > 100, "{}", clock.instants.len());
    let last = stills(&panels, &clock).last().expect("a frame");
    assert!(last.contains(">t = 1.000e-12 s<"), "{last}");
    let readings = animated(&panels, &clock);
    assert!(readings.matches(">t = ").count() > 30, "{readings}");
}
