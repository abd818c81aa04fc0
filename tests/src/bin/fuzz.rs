//! temporary: the catalogue's product
use lagrange_core::prelude::*;
use lagrange_problems::catalogue::scenes;
use lagrange_problems::request::Request;
fn main() {
    let only: Vec<String> = std::env::args().skip(1).collect();
    let methods = ["taylor", "dop853", "dopri5", "verner98", "radau5"];
    for scene in scenes() {
        if !only.is_empty() && !only.iter().any(|o| o == scene.name()) {
            continue;
        }
        for method in methods {
            for tolerance in [1e-6, 1e-9, 1e-12] {
                let until = if scene.name() == "kepler" {
                    Some(20.0)
                } else {
                    None
                };
                let request = Request {
                    tolerance,
                    method: method.parse::<Method>().unwrap(),
                    until,
                    ..Request::default()
                };
                let clock = std::time::Instant::now();
                let head = format!("{} {method} {tolerance:e}", scene.name());
                match scene.run(&request) {
                    Err(e) => println!("{head}: refused {e}"),
                    Ok(outcome) => {
                        if let Some(e) = &outcome.failure {
                            println!("{head}: failure {e}");
                        }
                        match &outcome.certificate {
                            None => println!("{head}: no certificate"),
                            Some(c) => {
                                for k in &c.checks {
                                    println!(
                                        "{head}: {} {} {:.2e} {:.2e} {:.3} {} t={:.9}",
                                        if k.holds() { "ok" } else { "BEYOND" },
                                        k.subject.words().replace(' ', "-"),
                                        k.figure,
                                        k.bound,
                                        k.share(),
                                        k.item,
                                        k.time
                                    );
                                }
                            }
                        }
                    }
                }
                eprintln!("{head} {:?}", clock.elapsed());
            }
        }
    }
}
