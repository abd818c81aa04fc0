//! Linear equations in any arithmetic: Gauss–Jordan elimination with complete pivoting.

use super::arithmetic::Arithmetic;
use crate::symbolic::field::Trouble;

/// Solution of linear equations.
pub(super) struct Solution<N> {
    /// One value per unknown.
    pub x: Vec<N>,
    /// Whether the equations determine it.
    pub determined: Vec<bool>,
    /// Number of independent equations.
    pub rank: usize,
}

/// x with `rows` · (x, −1) = 0 for rows of n coefficients and a right side; what they leave free is `free`.
/// None if they contradict each other.
pub(super) fn solve<A: Arithmetic>(
    a: &A,
    mut rows: Vec<Vec<A::Number>>,
    free: &[A::Number],
) -> Result<Option<Solution<A::Number>>, Trouble> {
    let n = free.len();
    let mut columns: Vec<usize> = (0..n).collect();
    let mut rank = 0;
    while rank < rows.len().min(n) {
        let mut best = (0.0, rank, rank);
        for (i, row) in rows.iter().enumerate().skip(rank) {
            for (place, &column) in columns.iter().enumerate().skip(rank) {
                let size = a.size(row[column]);
                if size > best.0 {
                    best = (size, i, place);
                }
            }
        }
        let (size, i, place) = best;
        if size == 0.0 {
            break;
        }
        rows.swap(rank, i);
        columns.swap(rank, place);
        let pivot = columns[rank];
        let divisor = rows[rank][pivot];
        for &column in columns[rank..].iter().chain([&n]) {
            rows[rank][column] = a.div(rows[rank][column], divisor)?;
        }
        let (above, rest) = rows.split_at_mut(rank);
        let Some((source, below)) = rest.split_first_mut() else {
            break;
        };
        for row in above.iter_mut().chain(below) {
            let factor = row[pivot];
            for &column in columns[rank + 1..].iter().chain([&n]) {
                row[column] = a.sub(row[column], a.mul(factor, source[column]));
            }
            row[pivot] = a.integer(0);
        }
        rank += 1;
    }
    if rows[rank..].iter().any(|row| a.size(row[n]) != 0.0) {
        return Ok(None);
    }
    let (mut x, mut determined) = (free.to_vec(), vec![false; n]);
    for (row, &pivot) in rows.iter().zip(&columns[..rank]) {
        x[pivot] = row[n];
        determined[pivot] = true;
        for &column in &columns[rank..] {
            x[pivot] = a.sub(x[pivot], a.mul(row[column], free[column]));
            determined[pivot] &= a.size(row[column]) == 0.0;
        }
    }
    Ok(Some(Solution {
        x,
        determined,
        rank,
    }))
}
