//! The program `lagrange`.

fn main() -> std::process::ExitCode {
    lagrange_program::Program::from(lagrange_problems::catalogue::all()).main()
}
