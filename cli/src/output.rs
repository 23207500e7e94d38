//! The output of a command: stdout, or a file that gets its name when it is complete.

use std::fmt::Display;
use std::io::{self, StdoutLock, Write};
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use shadowstep_scenes::{Error, WholeFile};

use crate::headings::OUTPUT;

/// Where a command writes.
#[derive(Debug, Args)]
#[command(next_help_heading = OUTPUT)]
pub(crate) struct OutputArguments {
    /// Writes to a new file, such as out.json
    ///
    /// The file gets its name when it is complete. A file that exists is not replaced without --force.
    #[arg(long, value_name = "FILE", group = "written")]
    pub(crate) output: Option<PathBuf>,
    /// Replaces files that exist
    #[arg(long, requires = "written")]
    pub(crate) force: bool,
}

/// Where a command writes its lines.
pub(crate) enum Output {
    Stdout(StdoutLock<'static>),
    File(WholeFile),
}

impl Output {
    pub(crate) fn stdout() -> Self {
        Output::Stdout(io::stdout().lock())
    }

    /// The file of `--output`, or stdout.
    pub(crate) fn of(arguments: &OutputArguments) -> Result<Self, Error> {
        Ok(match &arguments.output {
            Some(path) if arguments.force => Output::File(WholeFile::create(path, "--output")?),
            Some(path) => Output::File(WholeFile::create_new(path, "--output")?),
            None => Output::stdout(),
        })
    }

    /// One JSON object on a line of its own.
    pub(crate) fn json(&mut self, record: &impl Serialize) -> Result<(), Error> {
        let line = serde_json::to_string(record)?;
        Ok(writeln!(self, "{line}")?)
    }

    /// Writes a text, and gives the file its name.
    pub(crate) fn text(mut self, text: impl Display) -> Result<(), Error> {
        write!(self, "{text}")?;
        self.finish()
    }

    /// Writes JSON objects, each on a line of its own, or in their place a text for people.
    pub(crate) fn records_or_text<R: Serialize>(
        mut self,
        json: bool,
        records: impl IntoIterator<Item = R>,
        text: impl FnOnce() -> String,
    ) -> Result<(), Error> {
        if !json {
            return self.text(text());
        }
        records.into_iter().try_for_each(|record| self.json(&record))?;
        self.finish()
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
