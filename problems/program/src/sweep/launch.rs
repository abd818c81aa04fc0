//! Whether this process is one of many that `mpirun` or `srun` started.

use std::env;

/// The place of a process among those that were started together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// Its number, from 0.
    pub rank: usize,
    /// How many there are.
    pub of: usize,
}

/// Variables that say number and count: Open MPI, MPICH and Intel MPI, MVAPICH, srun with PMIx.
const VARIABLES: [(&str, &str); 4] = [
    ("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"),
    ("PMI_RANK", "PMI_SIZE"),
    ("MV2_COMM_WORLD_RANK", "MV2_COMM_WORLD_SIZE"),
    ("PMIX_RANK", "SLURM_STEP_NUM_TASKS"),
];

/// The place of this process, if it is one of several.
pub fn place() -> Option<Place> {
    let number = |name: &str| -> Option<usize> { env::var(name).ok()?.parse().ok() };
    let known = VARIABLES.iter().find_map(|(rank, of)| {
        Some(Place {
            rank: number(rank)?,
            of: number(of)?,
        })
    });
    known.filter(|place| place.of > 1)
}
