//! Where lines go: stdout, or a file that gets its name when it is complete.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::complaint::Complaint;

/// Takes lines.
pub(crate) struct Output {
    writer: Box<dyn Write>,
    file: Option<Unfinished>,
}

/// A file under a temporary name; it goes away unless it is finished.
struct Unfinished {
    temporary: PathBuf,
    path: PathBuf,
}

impl Output {
    /// The file, or stdout. In complaints, `named` is the flag or key that gives the file.
    pub(crate) fn open(path: Option<&Path>, named: &str) -> Result<Self, Complaint> {
        let Some(path) = path else {
            return Ok(Output { writer: Box::new(io::stdout().lock()), file: None });
        };
        let name = path.file_name().filter(|_| path.is_file() || !path.exists()).ok_or_else(|| {
            Complaint::usage(format!("{named} {} is no file", path.display()), "give the name of a file")
        })?;
        let temporary = path.with_file_name(format!("{}.{}.partial", name.display(), std::process::id()));
        let file = File::create_new(&temporary).map_err(|error| {
            let sentence = format!("{named} {} cannot be written: {error}", path.display());
            Complaint::usage(sentence, "give a file in a folder that exists and is yours")
        })?;
        let file = (BufWriter::new(file), Unfinished { temporary, path: path.to_owned() });
        Ok(Output { writer: Box::new(file.0), file: Some(file.1) })
    }

    /// One JSON object on a line of its own.
    pub(crate) fn json(&mut self, record: &impl Serialize) -> Result<(), Complaint> {
        let line = serde_json::to_string(record)?;
        Ok(writeln!(self, "{line}")?)
    }

    /// Gives the file its name.
    pub(crate) fn finish(mut self) -> Result<(), Complaint> {
        self.flush()?;
        if let Some(file) = &self.file {
            fs::rename(&file.temporary, &file.path)?;
        }
        Ok(())
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        // after `finish` there is no such file any more
        let _ = fs::remove_file(&self.temporary);
    }
}
