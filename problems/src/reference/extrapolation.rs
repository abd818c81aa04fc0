//! An integrator of its own kind for references: Gragg's midpoint rule, extrapolated (Bulirsch & Stoer 1966; Hairer,
//! Nørsett & Wanner 1993, section II.9). Fixed panels, sixteenth order; no code in common with the library.

/// y(b) of y′ = f(x, y), y(a) = y₀, in `panels` equal steps.
pub fn extrapolate<const N: usize>(
    f: impl Fn(f64, &[f64; N]) -> [f64; N],
    a: f64,
    b: f64,
    start: [f64; N],
    panels: usize,
) -> [f64; N] {
    let step = (b - a) / panels as f64;
    (0..panels).fold(start, |y, k| panel(&f, a + step * k as f64, step, y))
}

fn panel<const N: usize>(
    f: &impl Fn(f64, &[f64; N]) -> [f64; N],
    x: f64,
    step: f64,
    y: [f64; N],
) -> [f64; N] {
    const COLUMNS: usize = 8;
    let mut table: Vec<[f64; N]> = Vec::with_capacity(COLUMNS);
    for row in 0..COLUMNS {
        let parts = 2 * (row + 1);
        let h = step / parts as f64;
        let slope = f(x, &y);
        let mut previous = y;
        let mut present: [f64; N] = core::array::from_fn(|i| y[i] + h * slope[i]);
        for k in 1..parts {
            let slope = f(x + h * k as f64, &present);
            let next = core::array::from_fn(|i| previous[i] + 2.0 * h * slope[i]);
            (previous, present) = (present, next);
        }
        let slope = f(x + step, &present);
        let mut value: [f64; N] =
            core::array::from_fn(|i| 0.5 * (present[i] + previous[i] + h * slope[i]));
        // Neville's scheme in h², from the newest entry down the row.
        for (column, entry) in table.iter_mut().enumerate() {
            let ratio = (parts as f64 / (2 * (row - column)) as f64).powi(2) - 1.0;
            let better: [f64; N] =
                core::array::from_fn(|i| value[i] + (value[i] - entry[i]) / ratio);
            *entry = core::mem::replace(&mut value, better);
        }
        table.push(value);
    }
    table[COLUMNS - 1]
}
