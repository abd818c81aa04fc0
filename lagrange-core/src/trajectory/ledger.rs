//! The energy ledger: who put how much energy in, and whether it adds up.
//!
//! The Jacobi integral h = v·∂L/∂v − L (the energy, where neither L nor the constraints contain time) obeys
//! dh/dt = Σ Q·v − ∂L/∂t (Goldstein, Poole & Safko 2002, section 2.7). Each power is integrated over the stored step
//! polynomials by Gauss–Legendre quadrature; impacts add their jumps, of which each item has
//! the work of its impulse. What is left over is the closure error.

use super::energy::{Energies, EnergyMeter, place_of_row};
use super::{EventKind, State, Trajectory};
use crate::arithmetic::Scalar;
use crate::dynamics::row_name;
use crate::error::Error;
use crate::mode::Mode;
use crate::system::Description;

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
    /// Largest of the works and of the kinetic energies on the way: what the closure is to be compared with, J.
    pub scale: f64,
    /// h(end) − h(start) − Σ work, J.
    pub closure: f64,
}

impl Ledger {
    /// Whether the works balance another quantity than T + V ([`Energies::has_own_jacobi`]).
    pub fn has_own_jacobi(&self) -> bool {
        self.start.has_own_jacobi() || self.end.has_own_jacobi()
    }
}

/// Positive nodes and weights of Gauss–Legendre quadrature with 8 points on [−1, 1] (Abramowitz & Stegun, 25.4.30).
///
/// A step of order p that is made for the tolerance ε goes ε^(1/p) of the way to the next singular point, a third or less: powers
/// are integrated to 1e-15 and better.
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

impl<T: Scalar> Trajectory<T> {
    /// The ledgers at these times, or that of the end.
    pub(crate) fn book(&self, times: Option<&[f64]>) -> Result<Vec<Ledger>, Error> {
        match times {
            Some(times) => self.book_at(times),
            None => Ok(vec![self.book_whole()?]),
        }
    }

    fn book_whole(&self) -> Result<Ledger, Error> {
        let mut books = Books::open(self)?;
        books.turn_to(self.segments.len(), None)?;
        let end = books.meter.energies_at(self.last_time())?;
        Ok(books.balance(end))
    }

    fn book_at(&self, times: &[f64]) -> Result<Vec<Ledger>, Error> {
        let mut order: Vec<usize> = (0..times.len()).collect();
        order.sort_by(|&i, &j| times[i].total_cmp(&times[j]));
        let mut books = Books::open(self)?;
        let mut ledgers = vec![None; times.len()];
        for i in order {
            let now = books.meter.energies_at(times[i])?;
            let after = self.segments.partition_point(|s| s.t.value() <= times[i]);
            books.turn_to(after.saturating_sub(1), Some(times[i]))?;
            ledgers[i] = Some(books.balance(now));
        }
        Ok(ledgers.into_iter().flatten().collect())
    }
}

/// The books of a trajectory, kept from its beginning to some time.
struct Books<'a, T: Scalar> {
    trajectory: &'a Trajectory<T>,
    meter: EnergyMeter<'a, T>,
    start: Energies,
    /// Every item, its work up to the begin of the first segment that is not booked.
    booked: Vec<Entry>,
    /// Segments that are booked.
    segments: usize,
    /// Largest kinetic energy until now, J.
    kinetic: f64,
    /// Work in a part of the next segment.
    part: Vec<f64>,
    /// Energy jumps: (time, entry, J), in order of time, and how many are booked.
    jumps: Vec<(f64, usize, f64)>,
    jumped: usize,
    /// Entry of each power of [`EnergyMeter::powers`].
    entries: Vec<usize>,
    power: Vec<T>,
}

impl<'a, T: Scalar> Books<'a, T> {
    fn open(trajectory: &'a Trajectory<T>) -> Result<Self, Error> {
        trajectory.check_recorded()?;
        tell(trajectory, trajectory.first_time);
        let mut meter = EnergyMeter::new(trajectory);
        let (mut booked, entries) = items(trajectory.description());
        let jumps = jumps(trajectory, &mut meter, (&mut booked, &entries))?;
        let mode = trajectory.segments.first().map_or(0, |s| s.mode);
        let mode = &trajectory.modes[mode];
        let start = meter.energies(trajectory.first_time, mode, &trajectory.start)?;
        Ok(Books {
            trajectory,
            start: start.values(),
            kinetic: 0.0,
            part: vec![0.0; booked.len()],
            booked,
            segments: 0,
            jumps,
            jumped: 0,
            power: vec![T::default(); entries.len()],
            entries,
            meter,
        })
    }

    /// Books the segments before number `segment`, and the next one up to `time` if one is given.
    fn turn_to(&mut self, segment: usize, time: Option<f64>) -> Result<(), Error> {
        while self.segments < segment {
            let next = &self.trajectory.segments[self.segments];
            let whole = next.end.value();
            tell(self.trajectory, next.t);
            self.integrate(self.segments, whole)?;
            for (entry, part) in self.booked.iter_mut().zip(&self.part) {
                entry.work += part;
            }
            self.segments += 1;
        }
        self.part.fill(0.0);
        if let (Some(time), Some(next)) = (time, self.trajectory.segments.get(segment)) {
            let s = (time - next.t.value()) / next.h.value();
            // A step that ended where it began has no length.
            if s > 0.0 {
                self.integrate(segment, s.min(next.end.value()))?;
            }
        }
        let last = time.unwrap_or(f64::INFINITY);
        while let Some(&(_, entry, energy)) = self.jumps.get(self.jumped).filter(|j| j.0 <= last) {
            self.booked[entry].work += energy;
            self.jumped += 1;
        }
        Ok(())
    }

    /// Work from the begin of a segment to part `end` of it, into `part`.
    fn integrate(&mut self, segment: usize, end: f64) -> Result<(), Error> {
        self.part.fill(0.0);
        let kinetic = self.meter.kinetic(segment, T::from_f64(end))?;
        self.kinetic = self.kinetic.max(kinetic.value());
        if !self.meter.works(segment) {
            return Ok(());
        }
        let h = self.trajectory.segments[segment].h.value();
        let half = 0.5 * end;
        for (node, weight) in GAUSS.into_iter().flat_map(|(x, w)| [(-x, w), (x, w)]) {
            let s = T::from_f64(half * (1.0 + node));
            self.meter.powers(segment, s, &mut self.power)?;
            for (&entry, power) in self.entries.iter().zip(&self.power) {
                self.part[entry] += weight * half * h * power.value();
            }
        }
        Ok(())
    }

    /// The ledger at the time turned to, with these energies then.
    fn balance(&self, end: Energies) -> Ledger {
        let mut work = self.booked.clone();
        for (entry, part) in work.iter_mut().zip(&self.part) {
            entry.work += part;
        }
        let sum: f64 = work.iter().map(|e| e.work).sum();
        let start = self.start;
        let sizes = [
            start.kinetic,
            self.kinetic,
            end.kinetic,
            end.potential - start.potential,
            end.jacobi - start.jacobi,
        ];
        let scale = sizes
            .into_iter()
            .chain(work.iter().map(|e| e.work))
            .fold(0.0_f64, |m, x| m.max(x.abs()));
        Ledger {
            start,
            end,
            scale,
            closure: end.jacobi - start.jacobi - sum,
            work,
        }
    }
}

/// Lets those who watch see how far the books are.
fn tell<T: Scalar>(trajectory: &Trajectory<T>, time: T) {
    if let Some(monitor) = &trajectory.monitor {
        monitor.tell(time.value());
    }
}

/// An entry for every item but impacts, and the entry of every power of [`EnergyMeter::powers`].
fn items(d: &'static Description) -> (Vec<Entry>, Vec<usize>) {
    let mut work: Vec<Entry> = Vec::new();
    let mut entries = Vec::new();
    let loads = d.forces.iter().map(|load| (load.name, "force"));
    let dampers = d.dissipations.iter().map(|load| (load.name, "dissipation"));
    let rows = (0..d.rows.len()).map(|row| (row_name(d, row), kind(d, row)));
    let time = [("explicit time", "time")];
    for (name, kind) in loads.chain(dampers).chain(rows).chain(time) {
        // A friction in space is one item with two rows.
        let again = kind == "friction"
            && work
                .last()
                .is_some_and(|e| e.kind == kind && e.name == name);
        if !again {
            work.push(Entry {
                name,
                kind,
                work: 0.0,
            });
        }
        entries.push(work.len() - 1);
    }
    (work, entries)
}

fn kind(d: &Description, row: usize) -> &'static str {
    let mut frictions = d.frictions.iter();
    if frictions.any(|f| f.rows().contains(&row)) {
        "friction"
    } else if d.contacts.iter().any(|c| c.row == row) {
        "contact"
    } else {
        "constraint"
    }
}

/// Energy jumps at impacts, (time, entry, J), and where energies change with time alone; several events of one impact book it once. Adds an entry
/// for every contact that was hit, and for whatever else began to hold or rubbed in it.
fn jumps<T: Scalar>(
    trajectory: &Trajectory<T>,
    meter: &mut EnergyMeter<'_, T>,
    (work, entries): (&mut Vec<Entry>, &[usize]),
) -> Result<Vec<(f64, usize, f64)>, Error> {
    let d = trajectory.description();
    let mut jumps = Vec::new();
    let time = work.iter().position(|e| e.kind == "time");
    let mode_of = |mode: &Mode| {
        let mut modes = trajectory.modes.iter();
        modes.find(|m| *m == mode).unwrap_or(&trajectory.modes[0])
    };
    let (mut booked, mut changed) = (None, None);
    let mut last: Option<(T, &State<T>)> = None;
    for event in trajectory.events.iter() {
        let (began, from, to) = match event.kind {
            // Impacts that follow each other at one instant begin in different states.
            EventKind::Impact if booked != Some(&event.state) => {
                booked = Some(&event.state);
                last = Some((event.time, &event.state_after));
                (event.time, &event.state, &event.state_after)
            }
            // What the last impact left is lost in the infinitely many that follow, which take some time.
            EventKind::Accumulates { .. } => match last.take() {
                Some((time, left)) => (time, left, &event.state),
                None => continue,
            },
            EventKind::Branches => {
                let switch = (event.time.value(), &event.before, &event.after);
                if let Some(entry) = time.filter(|_| changed != Some(switch)) {
                    let mut energy =
                        |mode: &Mode| meter.energies(event.time, mode_of(mode), &event.state);
                    let [before, after] = [energy(&event.before)?, energy(&event.after)?];
                    jumps.push((switch.0, entry, (after.jacobi - before.jacobi).value()));
                }
                changed = Some(switch);
                continue;
            }
            _ => continue,
        };
        // What an impact moves may be on another side of its conditions.
        let before = meter.energies(began, mode_of(&event.before), from)?;
        let after = meter.energies(event.time, mode_of(&event.after), to)?;
        let (name, time) = (event.subject.name(d), event.time.value());
        let entry = entry_of_impact(work, name);
        let mut energy = (after.jacobi - before.jacobi).value();
        if event.kind == EventKind::Impact {
            // The contact that names the impact has what the others leave.
            for (row, share) in meter.works_of_impulses(event) {
                let item = row_name(d, row);
                let other = match kind(d, row) {
                    "constraint" if d.rows[row].rheonomic => entries[place_of_row(d, row)],
                    _ if item == name => continue,
                    _ => entry_of_impact(work, item),
                };
                energy -= share;
                jumps.push((time, other, share));
            }
        }
        jumps.push((time, entry, energy));
    }
    Ok(jumps)
}

/// The entry of what an item does in impacts; a new one where it has none.
fn entry_of_impact(work: &mut Vec<Entry>, name: &'static str) -> usize {
    let mut known = work.iter();
    let known = known.position(|e| e.kind == "impact" && e.name == name);
    known.unwrap_or_else(|| {
        work.push(Entry {
            name,
            kind: "impact",
            work: 0.0,
        });
        work.len() - 1
    })
}
