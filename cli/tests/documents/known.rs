//! Faults that are being mended: what the fault is called, and what the document has.

pub(crate) const KNOWN: [(&str, &str); 8] = [
    ("runtime/src/systems/pairs/neighbours.rs", "[time]"),
    ("scenes/src/scene/split/wisdom_holman.rs", "mass = 0"),
    ("scenes/src/scene/split/wisdom_holman.rs", "particles"),
    ("sweeps/src/axis.rs", "panels"),
    ("mean_megno", "chaos"),
    ("s of CPU time", "modified_hamiltonian"),
    // a physical end that a trajectory at a singularity does not come to
    ("s of CPU time", "transform = "),
    // H that is not finite at a start, of which no column is written
    ("of a value in stderr", "run document.toml"),
];
