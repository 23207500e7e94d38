//! Rows as NumPy's own format of arrays, .npy: records of doubles that Python maps into memory.
//!
//! The head has the names of the fields and the number of records, which is known at the end: it is written then, in
//! the place that is kept for it. Source: NumPy Enhancement Proposal 1.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, BufReader, ErrorKind, Read, Seek, SeekFrom};
use std::path::Path;

use shadowstep::Real;

use crate::results::row::{Cell, Name, Row};

/// The beginning of a file of version 2.
pub(super) const MAGIC: &[u8; 8] = b"\x93NUMPY\x02\x00";

/// Heads and records are aligned to this.
const ALIGNMENT: usize = 64;

/// The head of a file with this number of records; its length does not depend on that.
pub(super) fn head(names: &[Name], records: u64) -> Vec<u8> {
    let mut fields = "('n', '<i8'), ".to_owned();
    for names in names[1..].chunk_by(|a, b| a.list.is_some() && a.list == b.list) {
        let count = names.iter().filter(|name| name.is_column).count();
        match names[0].list {
            Some(list) => write!(fields, "('{list}', '<f8', ({count},)), "),
            None => write!(fields, "('{}', '<f8'), ", names[0].text),
        }
        .expect("a text grows");
    }
    let dictionary = format!("{{'descr': [{fields}], 'fortran_order': False, 'shape': ({records:20},), }}");
    let length = (MAGIC.len() + 4 + dictionary.len() + 1).next_multiple_of(ALIGNMENT) - MAGIC.len() - 4;
    // a width of Rust's formats is at most 65 535
    let blanks = " ".repeat(length - 1 - dictionary.len());
    let bytes = u32::try_from(length).expect("a head is shorter than 4 GiB").to_le_bytes();
    [MAGIC.as_slice(), &bytes, dictionary.as_bytes(), blanks.as_bytes(), b"\n"].concat()
}

/// The record of a row.
pub(super) fn record<N: Real>(row: &Row<'_, N>) -> Vec<u8> {
    row.of_columns().flat_map(Cell::bytes).collect()
}

/// The length of a record in bytes.
pub(super) fn length(names: &[Name]) -> u64 {
    8 * names.iter().filter(|name| name.is_column).count() as u64
}

/// The records of a file with this number of columns, as cells of CSV.
///
/// # Errors
/// A file that cannot be read.
pub(crate) fn records(
    path: &Path,
    columns: usize,
) -> io::Result<impl Iterator<Item = io::Result<Vec<String>>> + use<>> {
    let mut file = BufReader::new(File::open(path)?);
    let mut begin = [0; MAGIC.len() + 4];
    file.read_exact(&mut begin)?;
    let length = u32::from_le_bytes(begin[MAGIC.len()..].try_into().expect("4 bytes"));
    file.seek(SeekFrom::Current(length.into()))?;
    let mut record = vec![0; 8 * columns];
    Ok(std::iter::from_fn(move || match file.read_exact(&mut record) {
        Ok(()) => {
            let mut numbers = record.chunks(8).map(|bytes| bytes.try_into().expect("8 bytes"));
            let n = numbers.next().map(i64::from_le_bytes).map(|n| n.to_string());
            let text = |number: f64| if number.is_nan() { String::new() } else { number.to_text() };
            Some(Ok(n.into_iter().chain(numbers.map(f64::from_le_bytes).map(text)).collect()))
        }
        Err(error) if error.kind() == ErrorKind::UnexpectedEof => None,
        Err(error) => Some(Err(error)),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A head of more bytes than a format of Rust, or version 1 of NumPy's, can have is aligned, and has its length in
    /// front.
    #[test]
    fn heads_of_any_length() {
        for values in [0, 1, 4_000, 100_000] {
            let names: Vec<Name> = (0..=values).map(|i| Name::from(&*format!("value_{i}"))).collect();
            let head = head(&names, 7);
            let length = u32::from_le_bytes(head[8..12].try_into().unwrap());
            assert_eq!((head.len() % ALIGNMENT, head.len(), head.last()), (0, 12 + length as usize, Some(&b'\n')));
        }
    }
}
