//! What a person at the terminal sees while something is being made, and how Ctrl-C ends it: bars on stderr, colours, the
//! first Ctrl-C that keeps what is done and the second that does not.

use crate::progress::Progress;
use crate::scene::Scene;
use clap::ColorChoice;
use indicatif::{HumanDuration, ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// What takes no longer shows no bar.
const PATIENCE: Duration = Duration::from_secs(1);
/// Time between two looks at how far it is.
const TICK: Duration = Duration::from_millis(100);
/// Time between two lines where nobody sees a bar: a file, a pipe, the log of a cluster.
const BETWEEN_LINES: Duration = Duration::from_secs(10);
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

/// Says what the declaration of a scene in a file makes one wonder about.
pub(super) fn remark(scene: &dyn Scene) {
    if !QUIET.load(Relaxed) {
        let hints = scene.hints().iter();
        hints.for_each(|hint| super::say(&format!("hint: {hint}")));
    }
}

/// Does `work`; if it takes longer than a second, shows on stderr how far it is and how long it still takes. Where stderr is no
/// terminal, it says so in a line now and then.
pub(super) fn patiently<T>(what: &str, progress: &Progress, work: impl FnOnce() -> T) -> T {
    let (done, waiting) = channel::<()>();
    let begin = Instant::now();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            let pause = |time| waiting.recv_timeout(time) == Err(RecvTimeoutError::Timeout);
            if !std::io::stderr().is_terminal() {
                while !QUIET.load(Relaxed) && pause(BETWEEN_LINES) {
                    let part = progress.part().unwrap_or(0.0);
                    super::say(&line(what, begin.elapsed(), part));
                }
                return;
            }
            if !pause(PATIENCE) {
                return;
            }
            let form = "{prefix} {wide_bar} {percent:>3} %, {msg}";
            let bar = bar(PARTS, form).with_prefix(what.to_owned());
            loop {
                let part = progress.part().unwrap_or(0.0);
                bar.set_position((part * PARTS as f64) as u64);
                bar.set_message(times(begin.elapsed(), part));
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

/// How far it is, without a bar.
fn line(what: &str, gone: Duration, part: f64) -> String {
    format!("{what}: {:.0} %, {}", 100.0 * part, times(gone, part))
}

/// How long a part took, and how long the rest takes at that speed.
fn times(gone: Duration, part: f64) -> String {
    let left = gone.as_secs_f64() * (1.0 - part) / part;
    let gone = HumanDuration(gone);
    // A year is as good as for ever.
    match left < 3e7 {
        true => {
            let left = HumanDuration(Duration::from_secs_f64(left));
            format!("{gone:#} gone, {left:#} left")
        }
        false => format!("{gone:#} gone"),
    }
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

/// Lets Ctrl-C end the process at once, with a word on what that costs.
pub(super) fn end_at_once(word: &'static str) {
    let interrupt = move || {
        super::say(&format!("interrupted; {word}"));
        std::process::exit(super::INTERRUPTED);
    };
    // Without a handler Ctrl-C does what it always does.
    let _ = ctrlc::set_handler(interrupt);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_follows_from_what_is_done() {
        let told = |part: f64| times(Duration::from_secs(60), part);
        assert_eq!(told(0.75), "60s gone, 20s left");
        assert_eq!(told(1.0), "60s gone, 0s left");
        assert_eq!(told(0.0), "60s gone");
        assert_eq!(told(1e-9), "60s gone");
        let line = line("measuring arm", Duration::from_secs(30), 0.25);
        assert_eq!(line, "measuring arm: 25 %, 30s gone, 2m left");
    }
}
