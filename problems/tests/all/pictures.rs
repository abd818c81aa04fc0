//! Pictures as files: what is drawn, and what it becomes by the name of the file. What comes out is read by other decoders than
//! wrote it, and compared with closed forms and single pictures.

use crate::program::{folder, lagrange, lagrange_in, path, refuses, says, text};
use std::fs::{self, File};
use std::io::BufReader;
use std::path::Path;

/// A decoded picture: red, green, blue.
struct Pixels {
    width: usize,
    height: usize,
    colours: Vec<[u8; 3]>,
}

impl Pixels {
    fn white(width: usize, height: usize) -> Self {
        Self {
            width,
            height,
            colours: vec![[255; 3]; width * height],
        }
    }

    /// Puts a piece there; what is transparent of it leaves what was there before.
    fn put(&mut self, (left, top): (usize, usize), width: usize, rgba: &[u8]) {
        for (index, pixel) in rgba.chunks_exact(4).enumerate() {
            let place = (top + index / width) * self.width + left + index % width;
            if pixel[3] == 255 {
                self.colours[place] = [pixel[0], pixel[1], pixel[2]];
            }
        }
    }
}

/// All pictures of a PNG file, animated or not, laid upon each other as a viewer does.
fn png(file: &Path) -> (usize, Pixels) {
    let file = BufReader::new(File::open(file).expect("a file"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG");
    let count = reader
        .info()
        .animation_control()
        .map_or(1, |control| control.num_frames as usize);
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    let mut pixels = Pixels::white(width, height);
    let mut buffer = vec![0; reader.output_buffer_size()];
    for _ in 0..count {
        let info = reader.next_frame(&mut buffer).expect("a frame");
        let place = reader.info().frame_control().map_or((0, 0), |control| {
            (control.x_offset as usize, control.y_offset as usize)
        });
        pixels.put(place, info.width as usize, &buffer[..info.buffer_size()]);
    }
    (count, pixels)
}

/// The same of a GIF.
fn gif(file: &Path) -> (usize, Pixels) {
    let mut options = gif::DecodeOptions::new();
    options.set_color_output(gif::ColorOutput::RGBA);
    let mut decoder = options
        .read_info(File::open(file).expect("a file"))
        .expect("a GIF");
    let mut pixels = Pixels::white(decoder.width().into(), decoder.height().into());
    let mut count = 0;
    while let Some(frame) = decoder.read_next_frame().expect("a frame") {
        pixels.put(
            (frame.left.into(), frame.top.into()),
            frame.width.into(),
            &frame.buffer,
        );
        count += 1;
    }
    (count, pixels)
}

/// A falling ball: rows of the ink are a + b t², columns are proportional to t.
#[test]
fn ink_is_where_the_motion_is() {
    let folder = folder("pictures-ink");
    let file = folder.join("fall.png");
    says(&[
        "run",
        "bouncing-ball",
        "--until",
        "0.3",
        "--plot",
        path(&file),
        "--show",
        "y vs t",
        "--output",
        path(&folder.join("fall.csv")),
    ]);
    let (_, picture) = png(&file);
    assert_eq!(picture.width, 1800);
    let blue = [0, 114, 178];
    // Left of the names.
    let columns = 0..1480;
    let middle = |x: usize| {
        let rows = (0..picture.height).filter(|y| picture.colours[y * picture.width + x] == blue);
        let rows: Vec<f64> = rows.map(|y| y as f64).collect();
        (!rows.is_empty()).then(|| rows.iter().sum::<f64>() / rows.len() as f64)
    };
    let ink: Vec<(f64, f64)> = columns
        .filter_map(|x| Some((x as f64, middle(x)?)))
        .collect();
    assert!(ink.len() > 1200, "{}", ink.len());
    let (first, last) = (ink[0].0, ink[ink.len() - 1].0);
    // Least squares for a + b s, s = (t / t_end)².
    let points: Vec<(f64, f64)> = ink
        .iter()
        .map(|(x, y)| (((x - first) / (last - first)).powi(2), *y))
        .collect();
    let mean = |f: fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / points.len() as f64;
    let (s, y, ss, sy) = (
        mean(|p| p.0),
        mean(|p| p.1),
        mean(|p| p.0 * p.0),
        mean(|p| p.0 * p.1),
    );
    let b = (sy - s * y) / (ss - s * s);
    let worst = points
        .iter()
        .map(|p| (p.1 - y - b * (p.0 - s)).abs())
        .fold(0.0, f64::max);
    assert!(b > 200.0 && worst < 1.5, "{b} {worst}");
    // Words: dark ink in the line of the title.
    let dark = picture.colours[..60 * picture.width]
        .iter()
        .filter(|colour| colour.iter().all(|part| *part < 90));
    assert!(dark.count() > 500);
}

#[test]
fn a_picture_becomes_what_its_name_says() {
    let folder = folder("pictures-names");
    let draw = |name: &str| {
        let file = folder.join(name);
        says(&[
            "run",
            "mass-on-wheel",
            "--plot",
            path(&file),
            "--output",
            path(&folder.join("run.csv")),
        ]);
        fs::read(&file).expect("a picture")
    };
    assert!(draw("a.svg").starts_with(b"<svg"));
    assert!(draw("a.PNG").starts_with(b"\x89PNG"));
    let pdf = draw("a.pdf");
    let pdf = String::from_utf8_lossy(&pdf);
    assert!(
        pdf.starts_with("%PDF-1.") && pdf.contains("/Count 1") && pdf.trim_end().ends_with("%%EOF")
    );
    // 900 pixels of 3/4 pt.
    let page = pdf
        .split("/MediaBox [")
        .nth(1)
        .and_then(|rest| rest.split(']').next());
    let page: Vec<f64> = page
        .expect("a page")
        .split_whitespace()
        .map(|x| x.parse().expect("a number"))
        .collect();
    assert!(
        (page[2] - 900.0).abs() < 1.0 || (page[2] - 675.0).abs() < 1.0,
        "{page:?}"
    );
    for wrong in ["x.jpg", "x", "x.svg.gz"] {
        refuses(
            &["run", "mass-on-wheel", "--plot", wrong],
            2,
            "end in .svg, .png or .pdf",
        );
        refuses(
            &[
                "sweep",
                "mass-on-wheel",
                "--vary",
                "mass=1..2:2",
                "--observe",
                "t",
                "--plot",
                wrong,
            ],
            2,
            "end in .svg",
        );
        refuses(
            &["accuracy", "mass-on-wheel", "--plot", wrong],
            2,
            "end in .svg",
        );
    }
    refuses(
        &["run", "mass-on-wheel", "--plot", "theta vs t"],
        2,
        "what to draw is said with --show",
    );
    fs::write(
        folder.join("a.toml"),
        "scene = \"kepler\"\n[outputs]\nplot = \"a.bmp\"\n",
    )
    .expect("a file");
    let refused = lagrange_in(&folder, &["run", "a.toml"]);
    assert!(
        text(&refused.stderr).contains("a.toml:3:8: let the name of a picture end in"),
        "{}",
        text(&refused.stderr)
    );
}

#[test]
fn what_is_asked_for_is_drawn() {
    let folder = folder("pictures-show");
    let file = folder.join("show.svg");
    let draw = |more: &[&str]| {
        let fixed = [
            "run",
            "mass-on-wheel",
            "--plot",
            path(&file),
            "--format",
            "json",
        ];
        says(&[&fixed[..], more].concat());
        fs::read_to_string(&file).expect("a picture")
    };
    let shown = draw(&[
        "--show",
        "theta, |grip|, limit(grip) vs t",
        "--show",
        "der(theta) vs theta",
    ]);
    for words in [
        "\nθ\n",
        "|grip|",
        "μN of grip",
        "dθ/dt",
        "rate, °/s",
        "θ, °",
        "angle, °",
        "force, N",
        "rim open",
    ] {
        assert!(shown.contains(words), "{words}");
    }
    assert!(!shown.contains("position"), "not asked for");
    let upon = draw(&[
        "--show",
        "theta",
        "--compare",
        "set:mu_static=1",
        "--compare",
        "without:grip",
    ]);
    for words in ["mu_static = 1", "without grip", "mass-on-wheel"] {
        assert!(upon.contains(words), "{words}");
    }
    // Three runs of one quantity in three colours; modes of one are not those of the others.
    let colours = ["#0072B2", "#D55E00", "#009E73"].map(|colour| upon.matches(colour).count());
    assert!(colours.iter().all(|count| *count > 1), "{colours:?}");
    assert!(!upon.contains("rim open"));
    let run = |more: &[&'static str]| [&["run", "mass-on-wheel"][..], more].concat();
    refuses(
        &run(&["--plot", "x.svg", "--show", "thetadot"]),
        2,
        "did you mean `der(theta)`?",
    );
    refuses(
        &run(&["--plot", "x.svg", "--show", "rimm vs theta"]),
        2,
        "did you mean `rim`?",
    );
    refuses(&run(&["--show", "theta"]), 2, "say where with --plot");
    refuses(
        &run(&["--compare", "without:grip"]),
        2,
        "say where with --plot",
    );
    // A scene file says it again.
    let saved = folder.join("saved.toml");
    draw(&["--show", "energy vs t", "--save", path(&saved)]);
    fs::remove_file(&file).expect("it was drawn");
    says(&["run", path(&saved), "--format", "json"]);
    assert!(
        fs::read_to_string(&file)
            .expect("a picture")
            .contains("energy, J")
    );
    let wrong = fs::read_to_string(&saved)
        .expect("a file")
        .replace("energy vs t", "enrgy vs t");
    fs::write(&saved, wrong).expect("a file");
    refuses(
        &["run", path(&saved)],
        2,
        "no quantity is called `enrgy`; did you mean `energy`?",
    );
}

/// What moves ends as the last single picture, pixel by pixel; in a GIF white stays white and colours are near.
#[test]
fn what_moves_is_made_of_its_frames() {
    let folder = folder("pictures-moving");
    let wheel = [
        "report",
        "mass-on-wheel",
        "--fps",
        "2",
        "--speed",
        "0.5",
        "--width",
        "400",
        "--quiet",
    ];
    let frames = folder.join("frames");
    says(&[&wheel[..], &["--frames", path(&frames), "--format", "png"]].concat());
    assert_eq!(fs::read_dir(&frames).expect("the folder").count(), 14);
    let (_, last) = png(&frames.join("frame-0014.png"));
    assert_eq!(last.width, 400);
    for name in ["wheel.png", "wheel.gif"] {
        says(&[&wheel[..], &["--output", path(&folder.join(name))]].concat());
    }
    let (count, moved) = png(&folder.join("wheel.png"));
    assert_eq!(
        (count, moved.width, moved.height),
        (14, last.width, last.height)
    );
    assert!(moved.colours == last.colours, "the last pictures differ");
    let (count, moved) = gif(&folder.join("wheel.gif"));
    assert_eq!(
        (count, moved.width, moved.height),
        (14, last.width, last.height)
    );
    for (seen, meant) in moved.colours.iter().zip(&last.colours) {
        assert!(*meant != [255; 3] || seen == meant);
        let apart = seen.iter().zip(meant).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(apart < Some(60), "{seen:?} {meant:?}");
    }
    refuses(
        &["report", "kepler", "--output", "x.gif", "--fps", "60"],
        2,
        "at most 50 pictures a second",
    );
    refuses(
        &["report", "kepler", "--output", "x.webm"],
        2,
        "a report is no .webm",
    );
    refuses(
        &["report", "kepler", "--frames", "x", "--format", "gif"],
        2,
        "--format svg or --format png",
    );
}

/// A stand-in for ffmpeg gets every pixel of every picture, and of the pause.
#[test]
#[cfg(unix)]
fn ffmpeg_is_given_all_pictures() {
    use std::os::unix::fs::PermissionsExt;
    use std::process::Command;
    let folder = folder("pictures-film");
    let film = folder.join("wheel.mp4");
    let make = |search: &Path| {
        let mut program = Command::new(env!("CARGO_BIN_EXE_lagrange"));
        program.env("PATH", search).args([
            "report",
            "mass-on-wheel",
            "--fps",
            "2",
            "--speed",
            "0.5",
            "--width",
            "200",
            "--output",
        ]);
        program.arg(&film).output().expect("it starts")
    };
    let without = make(Path::new("/nowhere"));
    assert_eq!(without.status.code(), Some(2));
    assert!(
        text(&without.stderr)
            .contains("an .mp4 needs the program ffmpeg, which is not on the PATH")
    );
    let script = folder.join("ffmpeg");
    let search = std::env::var("PATH").expect("a path");
    let lines = format!(
        "#!/bin/sh\nPATH='{search}'\n[ \"$1\" = -version ] && exit 0\nfor last; do :; done\ncat > \"$last\"\n"
    );
    fs::write(&script, lines).expect("a script");
    fs::set_permissions(&script, fs::Permissions::from_mode(0o755)).expect("it can be run");
    let made = make(&folder);
    assert_eq!(made.status.code(), Some(0), "{}", text(&made.stderr));
    let bytes = fs::metadata(&film).expect("a film").len();
    // 14 pictures and a second of pause.
    assert_eq!(bytes % (200 * 3 * 16), 0, "{bytes}");
    let lines = "#!/bin/sh\n[ \"$1\" = -version ] && exit 0\necho no codec >&2\nexit 1\n";
    fs::write(&script, lines).expect("a script");
    let failed = make(&folder);
    assert_eq!(failed.status.code(), Some(1));
    assert!(
        text(&failed.stderr).contains("ffmpeg failed: no codec"),
        "{}",
        text(&failed.stderr)
    );
}

/// Two-dimensional sweeps and diagrams of accuracy are drawn by the same hands.
#[test]
fn every_plot_can_be_pixels() {
    let folder = folder("pictures-others");
    let map = folder.join("map.png");
    let sweep = |observed: &str| {
        let axes = ["--vary", "mu_static=0.6..1:3", "--vary", "mass=0.1..4:3"];
        let run = [
            "sweep",
            "mass-on-wheel",
            "--quiet",
            "--observe",
            observed,
            "--plot",
            path(&map),
        ];
        says(&[&run[..], &axes].concat());
        png(&map).1
    };
    // Nine cells of 426 × 280 pixels: low friction, heavy masses slip; high friction does not let light ones.
    let angles = sweep("leave angle");
    assert_eq!((angles.width, angles.height), (1800, 1040));
    let centre = |picture: &Pixels, i: usize, j: usize| {
        picture.colours[(784 - 280 * j) * 1800 + 385 + 426 * i]
    };
    let places = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
    assert!(
        places
            .clone()
            .all(|(i, j)| centre(&angles, i, j) != [255; 3])
    );
    let modes = sweep("modes");
    let mut colours: Vec<[u8; 3]> = places.map(|(i, j)| centre(&modes, i, j)).collect();
    colours.sort();
    colours.dedup();
    assert_eq!(colours, [[119, 170, 221], [238, 136, 102]]);
    assert!(modes.height > angles.height, "no key");
    let diagram = folder.join("accuracy.png");
    let measured = lagrange(&[
        "accuracy",
        "cartesian-pendulum",
        "--until",
        "1",
        "--methods",
        "taylor",
        "--tolerances",
        "1e-6",
        "--repeat",
        "1",
        "--plot",
        path(&diagram),
    ]);
    assert_eq!(
        measured.status.code(),
        Some(0),
        "{}",
        text(&measured.stderr)
    );
    assert_eq!(png(&diagram).1.width, 1800);
}
