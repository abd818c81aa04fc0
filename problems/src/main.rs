//! The program `lagrange`.

mod cli;

fn main() -> std::process::ExitCode {
    cli::main()
}
