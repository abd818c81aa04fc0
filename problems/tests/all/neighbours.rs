//! What a run gives does not depend on the runs before it in the same memory, nor on those beside it: of every scene, over every
//! parameter, coordinate and velocity, bit for bit.

use lagrange_core::prelude::Method;
use lagrange_problems::catalogue::{self, scenes};
use lagrange_program::request::Request;
use lagrange_program::scene::Scene;
use lagrange_program::sweep::{Axis, Points, Sampling, Sweep};

/// A sweep over some values of a parameter, or of a coordinate or velocity of the start; none if the scene has no such starts.
fn sweep(scene: &'static dyn Scene, method: Method, name: &str, value: f64) -> Option<Sweep> {
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
        method,
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
    Sweep::new(scene, request, points, &observed).ok()
}

/// What is varied, around which value.
fn varied(scene: &dyn Scene) -> Vec<(String, f64)> {
    let description = scene.description();
    let parameters = description.parameters.iter().map(|p| p.name.to_owned());
    // Of a large system a few say as much as all.
    let coordinates = description.coordinates.iter().take(4);
    let states = coordinates.flat_map(|c| [c.name.to_owned(), format!("der({})", c.name)]);
    parameters
        .zip(scene.defaults())
        .chain(states.map(|name| (name, 0.3)))
        .collect()
}

/// Checks all sweeps of a scene; the number of runs that went well.
fn check(scene: &'static dyn Scene, method: Method) -> usize {
    let mut well = 0;
    for (name, value) in varied(scene) {
        let Some(sweep) = sweep(scene, method, &name, value) else {
            continue;
        };
        let (points, width) = (sweep.points.len(), sweep.width());
        let mut together = scene.worker(&sweep).expect("a worker");
        let mut rows = vec![0.0; points * width];
        together(0..points, &mut rows);
        let bits = |row: &[f64]| row.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        let (first, what) = (bits(&rows), format!("{name} of {}", scene.name()));
        together(0..points, &mut rows);
        assert_eq!(bits(&rows), first, "{what} once more");
        for (index, row) in rows.chunks(width).enumerate() {
            let mut alone = vec![0.0; width];
            scene.worker(&sweep).expect("a worker")(index..index + 1, &mut alone);
            assert_eq!(bits(row), bits(&alone), "{what}, point {index}");
            well += usize::from(row.last() == Some(&0.0));
        }
    }
    well
}

#[test]
fn a_run_among_others_in_used_memory_is_that_run_alone_in_new_memory() {
    for scene in scenes() {
        assert!(check(scene, Method::Taylor) >= 5, "{}", scene.name());
    }
}

#[test]
fn so_it_is_with_other_methods() {
    for name in [
        "rolling-slipping-sphere",
        "bouncing-ball",
        "five-link-chain",
    ] {
        for method in [Method::DormandPrince853, Method::Radau5] {
            assert!(
                check(catalogue::all().find(name).expect("a scene"), method) >= 5,
                "{name}"
            );
        }
    }
}
