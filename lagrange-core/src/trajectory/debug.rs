//! Results as `{:?}` shows them: every number by the name that it has in the declaration, and of a whole run a summary.

use super::{Event, Instant, Trajectory};
use crate::arithmetic::Scalar;
use crate::system::{Description, Friction};
use core::fmt::{Debug, Formatter, Result};

/// Numbers with their names.
struct Named<'a, N, T>(&'a [N], &'a [T]);

impl<N: AsRef<str>, T: Debug> Debug for Named<'_, N, T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let named = self.0.iter().zip(self.1);
        f.debug_map()
            .entries(named.map(|(name, value)| (Plain(name.as_ref()), value)))
            .finish()
    }
}

/// A text without quotes.
struct Plain<'a>(&'a str);

impl Debug for Plain<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        f.write_str(self.0)
    }
}

/// Names of what the rows belong to: constraints, contacts, frictions; `grip[0]`, `grip[1]` in space.
pub(super) fn rows(d: &Description) -> Vec<String> {
    let mut names = vec![String::new(); d.rows.len()];
    let constraints = d.constraints.iter().map(|c| (c.name, c.row));
    let contacts = d.contacts.iter().map(|c| (c.name, c.row));
    for (name, row) in constraints.chain(contacts) {
        names[row] = name.to_owned();
    }
    for friction in d.frictions {
        names[friction.row] = friction.name.to_owned();
        if friction.components > 1 {
            for k in 0..friction.components {
                names[friction.row + k] = format!("{}[{k}]", friction.name);
            }
        }
    }
    names
}

impl<T: Debug> Debug for Instant<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let d = self.owner.0;
        let rows = rows(d);
        let coordinates: Vec<&str> = d.coordinates.iter().map(|c| c.name).collect();
        let contacts: Vec<&str> = d.contacts.iter().map(|c| c.name).collect();
        let frictions: Vec<&str> = d.frictions.iter().map(|c| c.name).collect();
        let loads: Vec<&str> = d.forces.iter().map(|c| c.name).collect();
        let observes: Vec<&str> = d.observes.iter().map(|c| c.name).collect();
        let components = d.frictions.iter().flat_map(Friction::rows);
        let slips: Vec<&str> = components.map(|row| rows[row].as_str()).collect();
        f.debug_struct("Instant")
            .field("time", &self.time)
            .field("mode", &format_args!("{}", self.mode.display(d)))
            .field("q", &Named(&coordinates, &self.state.q))
            .field("v", &Named(&coordinates, &self.state.v))
            .field("acceleration", &Named(&coordinates, &self.acceleration))
            .field("forces", &Named(&rows, &self.forces))
            .field("undetermined", &Named(&rows, &self.undetermined))
            .field("gaps", &Named(&contacts, &self.gaps))
            .field("slips", &Named(&slips, &self.slips))
            .field("limits", &Named(&frictions, &self.limits))
            .field("kinetic", &self.kinetic)
            .field("potential", &self.potential)
            .field("jacobi", &self.jacobi)
            .field("loads", &Named(&loads, &self.loads))
            .field("observes", &Named(&observes, &self.observes))
            .finish()
    }
}

impl<T: Debug> Debug for Event<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let d = self.owner.0;
        let rows = rows(d);
        let named = |numbers| Named::<String, T>(&rows, numbers);
        f.debug_struct("Event")
            .field("time", &self.time)
            .field("subject", &Plain(self.subject.name(d)))
            .field("kind", &self.kind)
            .field("before", &format_args!("{}", self.before.display(d)))
            .field("after", &format_args!("{}", self.after.display(d)))
            .field("state", &self.state)
            .field("state_after", &self.state_after)
            .field("forces", &named(&self.forces))
            .field("forces_after", &named(&self.forces_after))
            .field("undetermined", &Named(&rows, &self.undetermined))
            .field(
                "undetermined_after",
                &Named(&rows, &self.undetermined_after),
            )
            .field("impulses", &named(&self.impulses))
            .field("restitution_lowered", &self.restitution_lowered)
            .field("impulses_undetermined", &self.impulses_undetermined)
            .field("ambiguous", &self.ambiguous)
            .field("other_impacts", &self.other_impacts)
            .finish()
    }
}

/// What can be read in a line: a run of a second may have megabytes of coefficients.
impl<T: Scalar> Debug for Trajectory<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let mut summary = f.debug_struct("Trajectory");
        summary
            .field("system", &self.system)
            .field("first_time", &self.first_time())
            .field("last_time", &self.last_time())
            .field("steps", &self.work().steps)
            .field("events", &self.events().len());
        if let Some(last) = self.events().last() {
            summary.field("last_event", &format_args!("{last}"));
        }
        summary.finish_non_exhaustive()
    }
}
