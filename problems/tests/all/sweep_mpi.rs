//! Sweeps by many processes (feature `mpi`): the same bytes as by one, also when processes are killed.
//!
//! Where there is no `mpirun` these tests say so and do nothing.

use crate::program::{folder, path, refuses, says, text};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const SWEEP: &[&str] = &[
    "sweep",
    "rolling-slipping-sphere",
    "--vary",
    "mu_static=0.2..1:30",
    "--vary",
    "theta=0.01..0.4:1500",
    "--observe",
    "theta at shell lost",
    "--observe",
    "t at grip slips",
    "--quiet",
];

/// A folder of its own, empty.
fn place(name: &str) -> PathBuf {
    folder(&format!("mpi-{name}"))
}

/// The program under mpirun, each process telling its number in a file named by its rank; `None` without mpirun.
fn mpirun(processes: usize, options: &[&str], folder: &Path, output: &Path) -> Option<Command> {
    let found = Command::new("mpirun").arg("--version").output();
    if !found.is_ok_and(|found| text(&found.stdout).contains("Open MPI")) {
        println!("skipped: there is no mpirun of Open MPI");
        return None;
    }
    let mut command = Command::new("mpirun");
    command
        .env("OMPI_ALLOW_RUN_AS_ROOT", "1")
        .env("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1")
        .args(["--oversubscribe", "-n", &processes.to_string()])
        .args(options)
        .args([
            "sh",
            "-c",
            "echo $$ > $0/$OMPI_COMM_WORLD_RANK; exec \"$@\"",
        ])
        .arg(folder)
        .arg(env!("CARGO_BIN_EXE_lagrange"))
        .args(SWEEP)
        .args(["--output", path(output)]);
    Some(command)
}

fn undisturbed(folder: &Path) -> Vec<u8> {
    let file = folder.join("undisturbed.parquet");
    says(&[SWEEP, &["--output", path(&file)]].concat());
    fs::read(file).expect("results")
}

/// Starts it, waits until results are being kept, kills (SIGKILL) one rank, and gives what mpirun ends with.
fn kill(mut command: Command, rank: usize, folder: &Path, output: &Path) -> Option<i32> {
    let mut run = command
        .stdout(Stdio::null())
        .stderr(fs::File::create(folder.join("stderr")).expect("a file"))
        .spawn()
        .expect("it starts");
    let rows = PathBuf::from(format!("{}.part/rows-1-of-1", path(output)));
    let begun = Instant::now();
    while fs::metadata(&rows).map_or(0, |rows| rows.len()) < 100_000 {
        assert!(begun.elapsed() < Duration::from_secs(60), "nothing is kept");
        std::thread::sleep(Duration::from_millis(1));
    }
    let number = fs::read_to_string(folder.join(rank.to_string())).expect("its number");
    let killed = Command::new("kill").args(["-9", number.trim()]).status();
    assert!(killed.expect("kill").success());
    run.wait().expect("it ends").code()
}

#[test]
fn any_number_of_processes_writes_the_same() {
    let folder = place("number");
    let expected = undisturbed(&folder);
    let output = folder.join("runs.parquet");
    for processes in [1, 2, 5] {
        let Some(mut command) = mpirun(processes, &[], &folder, &output) else {
            return;
        };
        let ended = command.output().expect("it starts");
        assert!(ended.status.success(), "{}", text(&ended.stderr));
        let said = text(&ended.stdout);
        assert!(
            said.contains("45000 runs of rolling-slipping-sphere"),
            "{said}"
        );
        assert_eq!(said.matches("45000 runs").count(), 1, "{said}");
        assert_eq!(fs::read(&output).expect("results"), expected, "{processes}");
        assert!(!folder.join("runs.parquet.part").exists());
        fs::remove_file(&output).expect("it can be removed");
    }
}

#[test]
fn a_rank_that_is_killed_is_made_up_for() {
    let folder = place("rank");
    let expected = undisturbed(&folder);
    let output = folder.join("runs.parquet");
    // By shared memory; by network connections, which break.
    for (rank, way) in [(1, "self,vader"), (3, "self,tcp")] {
        let options = ["--enable-recovery", "--mca", "btl", way];
        let Some(command) = mpirun(4, &options, &folder, &output) else {
            return;
        };
        let code = kill(command, rank, &folder, &output);
        let said = fs::read_to_string(folder.join("stderr")).expect("words");
        // Memory that others share is read from the process that has it: one that dies meanwhile ends the job, and says what to do.
        if way == "self,vader" && said.contains("a process died while it sent results") {
            let mut again = mpirun(4, &options, &folder, &output).expect("as before");
            let ended = again.output().expect("it starts");
            assert!(ended.status.success(), "{}", text(&ended.stderr));
        }
        let results = fs::read(&output).unwrap_or_else(|e| panic!("{e}, exit {code:?}: {said}"));
        assert_eq!(results, expected, "{rank}");
        fs::remove_file(&output).expect("it can be removed");
    }
}

#[test]
fn a_job_that_is_aborted_goes_on() {
    let folder = place("job");
    let expected = undisturbed(&folder);
    let output = folder.join("runs.parquet");
    for rank in [0, 2] {
        let Some(command) = mpirun(4, &[], &folder, &output) else {
            return;
        };
        assert_ne!(kill(command, rank, &folder, &output), Some(0));
        if rank == 0 {
            // Nobody else writes. Of the others, rank 0 may have done the rest before the job was ended.
            assert!(!output.exists());
            let kept = format!("{}.part", path(&output));
            refuses(&["merge", &kept], 1, "of 45000 runs are missing");
        }
        // With another number of processes.
        let command = mpirun(2, &[], &folder, &output);
        let ended = command.expect("as before").output().expect("it starts");
        assert!(ended.status.success(), "{}", text(&ended.stderr));
        assert_eq!(fs::read(&output).expect("results"), expected, "{rank}");
        fs::remove_file(&output).expect("it can be removed");
    }
}
