//! What a run gives does not depend on the runs before it in the same memory, nor on those beside it: of every scene, over every
//! parameter, bit for bit.

use lagrange_problems::catalogue::{Scene, scenes};
use lagrange_problems::request::Request;
use lagrange_problems::sweep::{Axis, Points, Sampling, Sweep};

/// A sweep over some values of a parameter.
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
fn a_run_among_others_in_used_memory_is_that_run_alone_in_new_memory() {
    for scene in scenes() {
        let parameters = scene.description().parameters.iter();
        for (parameter, value) in parameters.zip(scene.defaults()) {
            let sweep = sweep(scene, parameter.name, value);
            let (points, width) = (sweep.points.len(), sweep.width());
            let mut together = scene.worker(&sweep).expect("a worker");
            let mut rows = vec![0.0; points * width];
            together(0..points, &mut rows);
            let bits = |row: &[f64]| row.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            let (first, what) = (
                bits(&rows),
                format!("{} of {}", parameter.name, scene.name()),
            );
            together(0..points, &mut rows);
            assert_eq!(bits(&rows), first, "{what} once more");
            for (index, row) in rows.chunks(width).enumerate() {
                let mut alone = vec![0.0; width];
                scene.worker(&sweep).expect("a worker")(index..index + 1, &mut alone);
                assert_eq!(bits(row), bits(&alone), "{what}, point {index}");
            }
        }
    }
}
