//! What a sweep has done is kept: whatever happens to it, the result is the same byte for byte as if nothing had.

use crate::program::{folder, lagrange, path, refuses, says, sweep, text};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

/// Chunks of the sweep.
const CHUNKS: usize = 9;

/// A folder of its own, empty.
fn place(name: &str) -> PathBuf {
    folder(&format!("kept-{name}"))
}

/// What a sweep writes that nothing happens to.
fn undisturbed(folder: &Path) -> Vec<u8> {
    let file = folder.join("undisturbed.csv");
    says(&sweep(&["--output", path(&file)]));
    fs::read(file).expect("results")
}

/// The folder with what is done of a sweep, and the file in it.
fn part(output: &Path, shard: &str) -> (PathBuf, PathBuf) {
    let folder = PathBuf::from(format!("{}.part", path(output)));
    let rows = folder.join(format!("rows-{}", shard.replace('/', "-of-")));
    (folder, rows)
}

fn start(arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_lagrange"))
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("it starts")
}

#[test]
fn shards_in_one_folder_or_in_many_are_merged() {
    let folder = place("shards");
    let expected = undisturbed(&folder);
    for (count, order) in [
        (2, vec![2, 1]),
        (4, vec![3, 1, 4, 2]),
        (16, (1..=16).collect()),
    ] {
        let together = folder.join(format!("{count}.csv"));
        let mut folders = Vec::new();
        for part_of in order {
            let shard = format!("{part_of}/{count}");
            let apart = folder.join(format!("{count}-{part_of}.csv"));
            assert_eq!(
                says(&sweep(&["--output", path(&together), "--shard", &shard])),
                ""
            );
            says(&sweep(&["--output", path(&apart), "--shard", &shard]));
            assert!(!together.exists() && !apart.exists());
            folders.push(part(&apart, &shard).0);
        }
        let merged = folder.join("merged.csv");
        let mut arguments = vec!["merge", "--output", path(&merged)];
        arguments.extend(folders.iter().map(|folder| path(folder)));
        says(&arguments);
        assert_eq!(fs::read(&merged).expect("results"), expected, "{count}");
        let here = part(&together, "").0;
        let said = says(&["merge", path(&here), "--output", path(&merged)]);
        assert!(
            said.contains("9000 runs of rolling-slipping-sphere, of which 1200 failed."),
            "{said}"
        );
        assert_eq!(fs::read(&merged).expect("results"), expected, "{count}");
        assert!(here.exists());
        // The sweep itself takes what shards have done, and removes it.
        says(&sweep(&["--output", path(&together)]));
        assert_eq!(fs::read(&together).expect("results"), expected, "{count}");
        assert!(!here.exists());
    }
}

#[test]
fn missing_shards_are_named() {
    let folder = place("missing");
    let output = folder.join("runs.csv");
    let merged = folder.join("merged.csv");
    for shard in ["1/4", "4/4"] {
        says(&sweep(&["--output", path(&output), "--shard", shard]));
    }
    let (kept, rows) = part(&output, "4/4");
    // One of the two chunks of a shard is torn off.
    let whole = fs::read(&rows).expect("rows");
    fs::write(&rows, &whole[..whole.len() - 1]).expect("torn");
    let merge = ["merge", path(&kept), "--output", path(&merged)];
    refuses(
        &merge,
        1,
        "missing; shards not here: 2/4, 3/4; shards not finished: 4/4",
    );
    assert!(!merged.exists());
    // A part of another sweep.
    let other = folder.join("other.csv");
    let shard = ["--output", path(&other), "--shard", "2/4"];
    says(&sweep(&[&["--set", "mu_kinetic=0.1"], &shard[..]].concat()));
    let (strange, _) = part(&other, "2/4");
    let merge = ["merge", path(&kept), path(&strange)];
    refuses(&merge, 1, "another sweep");
    refuses(&sweep(&shard), 1, "another sweep");
    refuses(&["merge", path(&folder)], 1, "is not the folder of a sweep");
}

/// A picture without a point is refused when all else is written, so that nothing is left to be gone on with.
#[test]
fn what_has_no_picture_is_done_all_the_same() {
    let folder = place("no-picture");
    let file = |name: &str| folder.join(name);
    let (lines, picture) = (file("runs.csv"), file("runs.svg"));
    let swept = |observed: &str| {
        let arguments = [
            "sweep",
            "bouncing-ball",
            "--vary",
            "bounce=0.1..0.2:3",
            "--quiet",
        ];
        let files = ["--output", path(&lines), "--plot", path(&picture)];
        lagrange(&[&arguments[..], &["--observe", observed], &files].concat())
    };
    let output = swept("t at floor impact 90");
    assert_eq!(output.status.code(), Some(1));
    let said = text(&output.stderr);
    assert!(
        said.contains("there is nothing to draw: no run has what was observed"),
        "{said}"
    );
    assert!(
        text(&output.stdout).contains("3 runs of bouncing-ball"),
        "{}",
        text(&output.stdout)
    );
    assert_eq!(
        fs::read_to_string(&lines).expect("lines").lines().count(),
        4
    );
    assert!(!picture.exists() && !part(&lines, "").0.exists());
    assert_eq!(swept("t at floor impact 2").status.code(), Some(0));
    assert!(picture.exists());
}

#[test]
fn killed_ten_times_it_loses_nothing() {
    let folder = place("killed");
    let expected = undisturbed(&folder);
    let output = folder.join("killed.csv");
    let (_, rows) = part(&output, "1/1");
    // Moments that differ from one time to the next, and from one machine to the next.
    let mut wait = Duration::from_millis(1);
    for _ in 0..10 {
        let mut child = start(&sweep(&["--output", path(&output), "--workers", "1"]));
        std::thread::sleep(wait);
        wait = wait.mul_f64(1.7);
        // SIGKILL; it may have ended before.
        let _ = child.kill();
        let ended = child.wait().expect("it has ended").success();
        // It may have been killed while it cleared up, when all was written.
        let written = output.exists();
        assert!(written || !ended);
        if written {
            assert_eq!(fs::read(&output).expect("results"), expected);
            fs::remove_file(&output).expect("it can be removed");
            wait = Duration::from_millis(17);
        }
        assert!(written || wait < Duration::from_millis(100) || rows.exists());
    }
    // One that is killed while it writes down what the sweep is leaves that file unfinished.
    let (kept, _) = part(&output, "1/1");
    fs::create_dir_all(&kept).expect("a folder");
    fs::write(kept.join("sweep.1.unfinished"), "[swe").expect("a file");
    says(&sweep(&["--output", path(&output)]));
    assert_eq!(fs::read(&output).expect("results"), expected);
    let left: Vec<_> = fs::read_dir(&folder).expect("a folder").collect();
    assert_eq!(left.len(), 2, "{left:?}");
}

#[test]
fn damaged_chunks_are_done_again() {
    let folder = place("damaged");
    let expected = undisturbed(&folder);
    let output = folder.join("runs.csv");
    let (_, rows) = part(&output, "1/1");
    // All of it, kept: a shard that is the whole.
    says(&sweep(&["--output", path(&output), "--shard", "1/1"]));
    let whole = fs::read(&rows).expect("rows");
    type Damage = dyn Fn(&mut Vec<u8>);
    let damages: [&Damage; 5] = [
        &|bytes| bytes.truncate(bytes.len() / 2),
        &|bytes| bytes[100_000] ^= 1,
        &|bytes| bytes[0] ^= 0x80,
        &|bytes| bytes[30_000..90_000].fill(0),
        &|bytes| bytes.extend([7; 100]),
    ];
    for damage in damages {
        let mut bytes = whole.clone();
        damage(&mut bytes);
        fs::create_dir_all(rows.parent().expect("a folder")).expect("a folder");
        fs::write(&rows, bytes).expect("damaged");
        says(&sweep(&["--output", path(&output)]));
        assert_eq!(fs::read(&output).expect("results"), expected);
    }
    assert!(whole.len() / (1024 * 3 * 8) >= CHUNKS - 1);
}

/// Waits until a process has kept something in a file: before, it may not hold it yet.
fn at_work(child: &mut Child, rows: &Path) {
    while fs::metadata(rows).map_or(0, |rows| rows.len()) == 0 {
        let ended = child.try_wait().expect("a child");
        assert!(ended.is_none(), "it ended before it was seen at work");
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn one_process_works_at_a_time() {
    let folder = place("busy");
    let output = folder.join("runs.csv");
    let (kept, rows) = part(&output, "1/1");
    // Long enough that it is still at work when the others come.
    let long = ["--vary", "mass=1..2:2000", "--output", path(&output)];
    let mut first = start(&sweep(&long));
    at_work(&mut first, &rows);
    let says = "another process works on";
    refuses(&sweep(&long), 1, says);
    let shard = [&long[..], &["--shard", "1/2"]].concat();
    refuses(&sweep(&shard), 1, says);
    first.kill().expect("it was at work");
    first.wait().expect("it has ended");
    // Shards work side by side, but each alone.
    let mut first = start(&sweep(&shard));
    at_work(&mut first, &part(&output, "1/2").1);
    refuses(&sweep(&shard), 1, says);
    refuses(&sweep(&long), 1, says);
    let mut second = start(&sweep(&[&long[..], &["--shard", "2/2"]].concat()));
    std::thread::sleep(Duration::from_millis(100));
    assert!(second.try_wait().expect("a child").is_none());
    for child in [&mut first, &mut second] {
        child.kill().expect("it was at work");
        child.wait().expect("it has ended");
    }
    assert!(kept.exists());
}

#[test]
#[cfg(unix)]
fn a_full_disk_costs_only_what_was_not_written() {
    let folder = place("full");
    let expected = undisturbed(&folder);
    let output = folder.join("runs.csv");
    // Files may not grow beyond 100 KiB (of 512 bytes or 1 KiB each, as shells differ): four chunks at most.
    let limited = Command::new("sh")
        .args(["-c", "trap '' XFSZ; ulimit -f 100; exec \"$0\" \"$@\""])
        .arg(env!("CARGO_BIN_EXE_lagrange"))
        .args(sweep(&["--output", path(&output), "--workers", "1"]))
        .output()
        .expect("it starts");
    let said = text(&limited.stderr);
    assert_eq!(limited.status.code(), Some(1), "{said}");
    assert!(said.contains("cannot write"), "{said}");
    assert!(
        said.contains("the same command goes on from there"),
        "{said}"
    );
    assert!(!output.exists());
    says(&sweep(&["--output", path(&output)]));
    assert_eq!(fs::read(&output).expect("results"), expected);
}

#[test]
fn folders_of_other_versions_are_refused() {
    let folder = place("version");
    let output = folder.join("runs.csv");
    let (kept, _) = part(&output, "1/1");
    says(&sweep(&["--output", path(&output), "--shard", "1/2"]));
    let file = kept.join("sweep.toml");
    let recipe = fs::read_to_string(&file).expect("a recipe");
    let version = format!("version = \"{}\"", env!("CARGO_PKG_VERSION"));
    assert!(recipe.contains(&version), "{recipe}");
    fs::write(&file, recipe.replace(&version, "version = \"0.0.1\"")).expect("another version");
    refuses(&sweep(&["--output", path(&output)]), 1, "another version");
    refuses(&["merge", path(&kept)], 1, "another version");
    fs::write(&file, "scene = 3").expect("nonsense");
    refuses(&["merge", path(&kept)], 1, "is not the folder of a sweep");
    // A folder that happens to have the name keeps what is not the sweep's.
    fs::remove_file(&file).expect("gone");
    fs::write(kept.join("notes.txt"), "mine").expect("a file");
    assert!(
        lagrange(&sweep(&["--output", path(&output)]))
            .status
            .success()
    );
    assert_eq!(
        fs::read_to_string(kept.join("notes.txt")).expect("kept"),
        "mine"
    );
}
