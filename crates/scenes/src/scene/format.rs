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
    /// The format that a file's name gives.
    pub(crate) fn of(file: &str) -> Option<Format> {
        match file.rsplit_once('.')?.1 {
            "csv" => Some(Format::Csv),
            "jsonl" => Some(Format::JsonLines),
            "npy" => Some(Format::Numpy),
            _ => None,
        }
    }

    /// Whether the file itself has the metadata.
    pub(crate) fn has_metadata(self) -> bool {
        self == Format::Csv
    }
}
