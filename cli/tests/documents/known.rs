//! Faults that are being mended: what the fault is called, and what the document has.

pub(crate) const KNOWN: [(&str, &str); 0] = [];
