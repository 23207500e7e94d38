//! Faults that are being mended: what the fault is called, and what the document has.

pub(crate) const KNOWN: [(&str, &str); 1] = [
    // a physical end that a trajectory at a singularity does not come to
    ("s of CPU time", "transform = "),
];
