//! Faults that are being mended: what the fault is called, and what the document has.

pub(crate) const KNOWN: [(&str, &str); 6] = [
    ("runtime/src/systems/pairs/neighbours.rs", "[time]"),
    ("scenes/src/scene/split/wisdom_holman.rs", "mass = 0"),
    ("scenes/src/scene/split/wisdom_holman.rs", "particles"),
    ("sweeps/src/axis.rs", "panels"),
    ("mean_megno", "chaos"),
    ("s of CPU time", "modified_hamiltonian"),
];
