//! Faults that are being mended: what the fault is called, and what the document has.

pub(crate) const KNOWN: [(&str, &str); 1] = [
    // formulas of a high grade take longer than that in a build without optimisation
    ("s of CPU time", "modified_hamiltonian"),
];
