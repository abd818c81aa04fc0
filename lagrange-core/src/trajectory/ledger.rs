//! The energy ledger: who put how much energy in, and whether it adds up.
//!
//! The Jacobi integral h = v·∂L/∂v − L (the energy, where neither L nor the constraints contain time) obeys
//! dh/dt = Σ Q·v − ∂L/∂t (Goldstein, Poole & Safko 2002, section 2.7). Each power is integrated over the stored step
//! polynomials by Gauss–Legendre quadrature; impacts add their jumps. What is left over is the closure error.

use super::{EventKind, Trajectory};
use crate::arithmetic::Scalar;
use crate::dynamics::row_name;
use crate::error::Error;
use crate::system::System;

/// Energies at one instant, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// T as declared.
    pub kinetic: f64,
    /// V as declared.
    pub potential: f64,
    /// v·∂L/∂v − L.
    pub jacobi: f64,
}

/// Work of one item, J; positive if it put energy in.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Name of the item, or `explicit time`.
    pub name: &'static str,
    /// `force`, `dissipation`, `constraint`, `contact`, `friction`, `impact`, `time`.
    pub kind: &'static str,
    /// Work, J.
    pub work: f64,
}

/// Energy at both ends of a trajectory and the work in between.
#[derive(Clone, Debug, PartialEq)]
pub struct Ledger {
    /// At the beginning.
    pub start: Energies,
    /// At the end.
    pub end: Energies,
    /// Work of every item that did some or could have.
    pub work: Vec<Entry>,
    /// Largest of the energies and works: what the closure is to be compared with, J.
    pub scale: f64,
    /// h(end) − h(start) − Σ work, J.
    pub closure: f64,
}

/// Positive nodes and weights of Gauss–Legendre quadrature with 16 points on [−1, 1] (Abramowitz & Stegun, 25.4.30).
const GAUSS: [(f64, f64); 8] = [
    (0.095_012_509_837_637_44, 0.189_450_610_455_068_5),
    (0.281_603_550_779_258_9, 0.182_603_415_044_923_6),
    (0.458_016_777_657_227_4, 0.169_156_519_395_002_54),
    (0.617_876_244_402_643_7, 0.149_595_988_816_576_73),
    (0.755_404_408_355_003, 0.124_628_971_255_533_87),
    (0.865_631_202_387_831_7, 0.095_158_511_682_492_78),
    (0.944_575_023_073_232_6, 0.062_253_523_938_647_89),
    (0.989_400_934_991_649_9, 0.027_152_459_411_754_095),
];

impl<S: System> Trajectory<S> {
    /// Books the energy of the whole trajectory.
    ///
    /// # Errors
    /// [`Error::NotRecorded`]; or the equations of motion could not be evaluated somewhere on the way.
    pub fn ledger(&self) -> Result<Ledger, Error> {
        self.check_recorded()?;
        let d = S::DESCRIPTION;
        let mut sampler = self.sampler();
        let loads = d.forces.len() + d.dissipations.len();
        let items = loads + d.rows.len() + 1;
        let mut totals = vec![0.0; items];
        let mut power = vec![S::Scalar::default(); items];
        for (k, segment) in self.segments.iter().enumerate() {
            let half = 0.5 * segment.end.value();
            for (node, weight) in GAUSS.into_iter().flat_map(|(x, w)| [(-x, w), (x, w)]) {
                sampler.powers(k, S::Scalar::from_f64(half * (1.0 + node)), &mut power)?;
                let factor = weight * half * segment.h.value();
                for (total, power) in totals.iter_mut().zip(&power) {
                    *total += factor * power.value();
                }
            }
        }
        let mut work: Vec<Entry> = Vec::new();
        for (i, load) in d.forces.iter().enumerate() {
            work.push(Entry {
                name: load.name,
                kind: "force",
                work: totals[i],
            });
        }
        for (i, load) in d.dissipations.iter().enumerate() {
            work.push(Entry {
                name: load.name,
                kind: "dissipation",
                work: totals[d.forces.len() + i],
            });
        }
        for row in 0..d.rows.len() {
            let friction = d
                .frictions
                .iter()
                .find(|f| (f.row..f.row + f.components).contains(&row));
            let kind = match friction {
                Some(_) => "friction",
                None if d.contacts.iter().any(|c| c.row == row) => "contact",
                None => "constraint",
            };
            let name = row_name(d, row);
            let amount = totals[loads + row];
            match work.last_mut() {
                Some(last) if kind == "friction" && last.kind == kind && last.name == name => {
                    last.work += amount
                }
                _ => work.push(Entry {
                    name,
                    kind,
                    work: amount,
                }),
            }
        }
        work.push(Entry {
            name: "explicit time",
            kind: "time",
            work: totals[items - 1],
        });
        self.book_impacts(&mut sampler, &mut work)?;
        let mode = self.segments.first().map_or(0, |s| s.mode);
        let start = energies(&sampler.evaluate(self.first_time, mode, &self.start)?);
        let end = energies(&sampler.evaluate(self.last_time, self.modes.len() - 1, &self.last)?);
        let sum: f64 = work.iter().map(|e| e.work).sum();
        let sizes = [
            start.kinetic,
            end.kinetic,
            end.potential - start.potential,
            end.jacobi - start.jacobi,
        ];
        let scale = sizes
            .into_iter()
            .chain(work.iter().map(|e| e.work))
            .fold(0.0_f64, |m, x| m.max(x.abs()));
        Ok(Ledger {
            start,
            end,
            scale,
            closure: end.jacobi - start.jacobi - sum,
            work,
        })
    }

    /// Energy jumps at impacts; several events of one impact book it once.
    fn book_impacts(
        &self,
        sampler: &mut super::Sampler<'_, S>,
        work: &mut Vec<Entry>,
    ) -> Result<(), Error> {
        let d = S::DESCRIPTION;
        let mut booked = None;
        for event in self.events.iter().filter(|e| e.kind == EventKind::Impact) {
            // Impacts that follow each other at one instant begin in different states.
            if booked == Some(&event.state) {
                continue;
            }
            booked = Some(&event.state);
            let mode = self
                .modes
                .iter()
                .position(|m| *m == event.before)
                .unwrap_or(0);
            let before = sampler.evaluate(event.time, mode, &event.state)?.jacobi;
            let after = sampler
                .evaluate(event.time, mode, &event.state_after)?
                .jacobi;
            let name = event.subject.name(d);
            let amount = (after - before).value();
            match work
                .iter_mut()
                .find(|e| e.kind == "impact" && e.name == name)
            {
                Some(entry) => entry.work += amount,
                None => work.push(Entry {
                    name,
                    kind: "impact",
                    work: amount,
                }),
            }
        }
        Ok(())
    }
}

fn energies<T: Scalar>(instant: &super::Instant<T>) -> Energies {
    Energies {
        kinetic: instant.kinetic.value(),
        potential: instant.potential.value(),
        jacobi: instant.jacobi.value(),
    }
}
