//! What a person at the terminal sees while something is being made, and how Ctrl-C ends it: bars on stderr, colours, the
//! first Ctrl-C that keeps what is done and the second that does not.

use clap::ColorChoice;
use indicatif::{ProgressBar, ProgressStyle};
use lagrange_problems::progress::Progress;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// What takes no longer shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);
/// Time between two looks at how far it is.
const TICK: Duration = Duration::from_millis(100);
/// Parts of a bar.
const PARTS: u64 = 10_000;

/// As the arguments of the process say, from its beginning to its end.
static QUIET: AtomicBool = AtomicBool::new(false);

/// From now on no bars are shown.
pub(super) fn be_quiet() {
    QUIET.store(true, Relaxed);
}

/// From now on stderr is coloured so. `auto` asks whether it is a terminal, and `NO_COLOR`, `CLICOLOR`, `CLICOLOR_FORCE`.
pub(super) fn colour(choice: ColorChoice) {
    let choice = match choice {
        ColorChoice::Auto => anstream::ColorChoice::Auto,
        ColorChoice::Always => anstream::ColorChoice::Always,
        ColorChoice::Never => anstream::ColorChoice::Never,
    };
    choice.write_global();
}

/// A bar on stderr, in the form of indicatif; hidden if stderr is no terminal or the user wants quiet.
pub(super) fn bar(length: u64, form: &str) -> ProgressBar {
    if QUIET.load(Relaxed) {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::new(length);
    match ProgressStyle::with_template(form) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// Does `work`; if it takes longer than a second, shows on stderr how far it is and how long it still takes.
pub(super) fn patiently<T>(what: &str, progress: &Progress, work: impl FnOnce() -> T) -> T {
    let (done, waiting) = channel::<()>();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            let pause = |time| waiting.recv_timeout(time) == Err(RecvTimeoutError::Timeout);
            if !pause(PATIENCE) {
                return;
            }
            let form = "{msg} {wide_bar} {percent:>3} %, {elapsed} gone, {eta} left";
            let bar = bar(PARTS, form).with_message(what.to_owned());
            loop {
                let part = progress.part().unwrap_or(0.0);
                bar.set_position((part * PARTS as f64) as u64);
                bar.tick();
                if !pause(TICK) {
                    break;
                }
            }
            bar.finish_and_clear();
        });
        let result = work();
        drop(done);
        result
    })
}

/// Lets Ctrl-C end the work so that what is done is kept. Pressed again it ends the process at once.
pub(super) fn keep_what_is_done(progress: &Progress) {
    let progress = progress.clone();
    let interrupt = move || {
        if progress.is_stopped() {
            std::process::exit(super::INTERRUPTED);
        }
        progress.stop();
    };
    // Without a handler Ctrl-C does what it always does.
    let _ = ctrlc::set_handler(interrupt);
}
