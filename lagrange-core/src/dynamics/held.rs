//! What of the programs is held in a mode: what its equations need, and what was asked for beside.

use super::output_mask::OutputMask;
use super::shape::{Asked, Part};
use crate::system::Description;

/// What is held in one mode. It stays while the motion is in other modes, and is made anew where something else is asked for.
#[derive(Clone, Debug)]
pub(super) struct Held {
    /// Outputs of the motion asked for beside the equations of motion.
    extra: OutputMask,
    /// Outputs asked of the report.
    report_needs: OutputMask,
    /// Outputs that the motion program gives.
    pub motion: OutputMask,
    /// Outputs that the functions of the mode give as a series.
    pub series: OutputMask,
    /// Outputs that the functions of the mode give as values: with what a projection takes, where they give that.
    pub value: OutputMask,
    /// Outputs that the report program gives: for the effects, and those asked for.
    report: OutputMask,
    /// Whether the report runs with the motion.
    reports: bool,
    /// Which interpreted equations are in use; none if they were loaded for other needs.
    pub selected: Option<Part>,
}

impl Held {
    /// Nothing yet.
    pub(super) fn new(d: &Description) -> Self {
        let none = || OutputMask::new(d);
        Self {
            // No mask is without need 0.
            extra: OutputMask::default(),
            report_needs: none(),
            motion: none(),
            series: none(),
            value: none(),
            report: none(),
            reports: false,
            selected: None,
        }
    }

    /// Holds what the motion `needs`, what a projection takes of the `rows` and what is asked for.
    #[inline]
    pub(super) fn renew(
        &mut self,
        d: &Description,
        needs: &OutputMask,
        rows: Option<&OutputMask>,
        (extra, report_needs, energies): (&OutputMask, &OutputMask, &OutputMask),
    ) {
        if self.extra == *extra && self.report_needs == *report_needs {
            return;
        }
        self.selected = None;
        self.extra.clone_from(extra);
        self.report_needs.clone_from(report_needs);
        self.motion.clone_from(needs);
        self.motion.extend(extra);
        self.series.clone_from(&self.motion);
        self.series.extend(report_needs);
        self.value.clone_from(&self.series);
        if let Some(rows) = rows {
            self.value.extend(rows);
        }
        // The named energies stand under their own needs also in the report, for the energy balance alone.
        let balance = report_needs.contains(d.energy.need) || report_needs.contains(d.momenta.need);
        let left_out = |energies: u64| if balance { 0 } else { energies };
        let report = self.series.iter().zip(energies.iter());
        self.report.assign(report.map(|(a, &e)| a & !left_out(e)));
        let mut branches = d.branches.iter();
        let after_solve = branches.any(|b| b.after_solve && self.motion.contains(b.need));
        let mut words = report_needs.iter().enumerate();
        self.reports = after_solve || words.any(|(i, &w)| w & !u64::from(i == 0) != 0);
    }

    /// What interpreted equations are loaded for.
    pub(super) fn asked(&self, part: Part) -> Asked<'_> {
        Asked {
            held: &self.motion,
            extra: &self.extra,
            report: self.reports.then_some(&self.report),
            part,
            forcing: true,
        }
    }
}
