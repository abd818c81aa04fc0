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
