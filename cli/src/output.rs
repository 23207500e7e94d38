//! The output of a command: stdout, or a file that gets its name when it is complete.

use std::io::{self, StdoutLock, Write};
use std::path::Path;

use serde::Serialize;
use shadowstep_scenes::{Error, WholeFile};

/// Where a command writes its lines.
pub(crate) enum Output {
    Stdout(StdoutLock<'static>),
    File(WholeFile),
}

impl Output {
    /// The file, or stdout. In messages, `named` is the flag or key that gives the file.
    pub(crate) fn open(path: Option<&Path>, named: &str) -> Result<Self, Error> {
        Ok(match path {
            Some(path) => Output::File(WholeFile::create(path, named)?),
            None => Output::Stdout(io::stdout().lock()),
        })
    }

    /// One JSON object on a line of its own.
    pub(crate) fn json(&mut self, record: &impl Serialize) -> Result<(), Error> {
        let line = serde_json::to_string(record)?;
        Ok(writeln!(self, "{line}")?)
    }

    /// Gives the file its name.
    pub(crate) fn finish(self) -> Result<(), Error> {
        match self {
            Output::Stdout(mut stdout) => Ok(stdout.flush()?),
            Output::File(file) => file.finish(),
        }
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Output::Stdout(stdout) => stdout.write(bytes),
            Output::File(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Output::Stdout(stdout) => stdout.flush(),
            Output::File(file) => file.flush(),
        }
    }
}
