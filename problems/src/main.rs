//! The program `lagrange`.

fn main() -> std::process::ExitCode {
    lagrange_problems::Program::of_the_catalogue().main()
}
