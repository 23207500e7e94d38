//! The formats of files.

/// How rows are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// A head of lines with `#`, a line of column names, and rows with commas.
    Csv,
    /// A JSON object a line, one for each row; the metadata are in a file beside it.
    JsonLines,
    /// An array of NumPy, a record for each row; the metadata are in a file beside it.
    Numpy,
}

impl Format {
    /// The formats by their names, which are the endings of files.
    pub(crate) const NAMES: [(&'static str, Format); 3] =
        [("csv", Format::Csv), ("jsonl", Format::JsonLines), ("npy", Format::Numpy)];

    /// The format that a file's name gives.
    pub(crate) fn of(file: &str) -> Option<Format> {
        let ending = file.rsplit_once('.')?.1;
        Format::NAMES.iter().find(|(name, _)| *name == ending).map(|(_, format)| *format)
    }

    /// Whether the file itself has the metadata.
    pub(crate) fn has_metadata(self) -> bool {
        self == Format::Csv
    }
}
