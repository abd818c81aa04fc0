//! What a run gives does not depend on the runs before it in the same memory, nor on those beside it: of every scene, over every
//! parameter, bit for bit.

use lagrange_problems::catalogue::{Scene, scenes};
use lagrange_problems::request::Request;
use lagrange_problems::sweep::{Axis, Points, Sampling, Sweep};

/// A sweep over some values of a parameter, each of which comes twice.
fn sweep(scene: &'static dyn Scene, name: &str, value: f64) -> Sweep {
    let axis = |name: &str, from: f64, to: f64, count: usize| Axis {
        name: name.to_owned(),
        from,
        to,
        count,
        logarithmic: false,
    };
    let around = if value == 0.0 { 0.1 } else { 0.2 * value };
    let request = Request {
        until: Some(1.0),
        ..Request::default()
    };
    let observed: Vec<String> = scene
        .description()
        .coordinates
        .iter()
        .flat_map(|c| [c.name.to_owned(), format!("der({})", c.name)])
        .collect();
    // In the middle is the value that most declarations make the most of: numbers are equal there that differ elsewhere.
    let axes = vec![axis(name, value - around, value + around, 5)];
    let points = Points {
        axes,
        sampling: Sampling::Grid,
    };
    Sweep::new(scene, request, points, &observed).expect("a sweep")
}

#[test]
fn a_run_in_used_memory_is_that_in_new_memory() {
    for scene in scenes() {
        let parameters = scene.description().parameters.iter();
        for (parameter, value) in parameters.zip(scene.defaults()) {
            let sweep = sweep(scene, parameter.name, value);
            let mut used = scene.worker(&sweep).expect("a worker");
            for index in [0, 2, 4, 1, 2, 3, 0] {
                let mut point = [0.0];
                sweep.points.write(index, &mut point);
                let mut rows = [vec![0.0; sweep.width()], vec![0.0; sweep.width()]];
                let mut new = scene.worker(&sweep).expect("a worker");
                used(&point, &mut rows[0]);
                new(&point, &mut rows[1]);
                let [found, expected] =
                    rows.map(|row| row.iter().map(|x: &f64| x.to_bits()).collect::<Vec<_>>());
                assert_eq!(
                    found,
                    expected,
                    "{} {point:?} of {}",
                    parameter.name,
                    scene.name()
                );
            }
        }
    }
}
