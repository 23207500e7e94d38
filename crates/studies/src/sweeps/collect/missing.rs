//! The chunks that are not there.

use std::path::Path;

use crate::sweeps::chunk::{Chunk, header};
use crate::sweeps::manifest::Manifest;

/// Chunks that are missing, and those that cannot be used.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Missing {
    /// Their numbers, in order.
    pub chunks: Vec<u64>,
    /// Those of them that are there, each with why it cannot be used.
    pub unusable: Vec<(u64, String)>,
}

impl Missing {
    /// By names and headers; what is in the files is not read.
    pub(crate) fn find(manifest: &Manifest, folder: &Path) -> Missing {
        let mut missing = Missing::default();
        for chunk in manifest.all_chunks() {
            let Some(header) = header(&chunk.path(folder)) else {
                missing.chunks.push(chunk.number);
                continue;
            };
            let header = header.ok_or_else(|| "its first line is not a header".to_owned());
            if let Err(why) = header.and_then(|header| manifest.check_header(&header)) {
                missing.add(chunk, why);
            }
        }
        missing
    }

    /// Whether every chunk is there.
    pub(crate) fn is_empty(&self) -> bool {
        self.chunks.is_empty()
    }

    /// The numbers as `sbatch --array=` takes them: `3,7-9`.
    pub fn list(&self) -> String {
        ranges(&self.chunks)
    }

    pub(crate) fn add(&mut self, chunk: Chunk, why: String) {
        self.chunks.push(chunk.number);
        self.unusable.push((chunk.number, why));
    }
}

/// Numbers in order as `3,7-9`.
pub(super) fn ranges(numbers: &[u64]) -> String {
    let mut groups: Vec<(u64, u64)> = Vec::new();
    for &number in numbers {
        match groups.last_mut() {
            Some((_, end)) if *end + 1 == number => *end = number,
            _ => groups.push((number, number)),
        }
    }
    let text = |(begin, end): &(u64, u64)| if begin == end { begin.to_string() } else { format!("{begin}-{end}") };
    groups.iter().map(text).collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_a_row_are_a_range() {
        assert_eq!(ranges(&[3, 7, 8, 9, 11, 12]), "3,7-9,11-12");
        assert_eq!((ranges(&[]), ranges(&[5])), (String::new(), "5".to_owned()));
    }
}
