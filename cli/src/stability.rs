//! `shadowstep stability`: hard cases with what theory predicts of them, on any scheme.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::PossibleValuesParser;
use shadowstep_scenes::arithmetic::{Arithmetic, MOST_DIGITS};
use shadowstep_scenes::library::{NamedScheme, scheme};
use shadowstep_scenes::object::Object;
use shadowstep_scenes::{Error, shell_word};
use shadowstep_studies::finding::Finding;
use shadowstep_studies::stability::{CaseEntry, Suite, entries, examine, files, names};
use shadowstep_studies::verdict::Verdict;

use crate::output::Output;
use crate::posed::fitted;
use crate::quantity::whole;
use crate::readable::wrapped_to;
use crate::report::{self, Status};
use crate::terminal::{Terminal, study_in};

const EXAMPLES: &str = "\
Examples:
  shadowstep stability --quick
  shadowstep stability oscillator --schemes yoshida4,mine.toml
  shadowstep stability --out stability";

const MORE: &str = "\
DIR gets report.html with charts, and stability.md with all verdicts. Results are saved one by one in results.jsonl: \
after Ctrl-C (exit code 3) the same command computes only what is missing.

The exit code is 1 if a row differs from \
theory.";

/// Hard cases: what theory predicts, and whether it happens.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, after_long_help = format!("{EXAMPLES}\n\n{MORE}"))]
pub(crate) struct Arguments {
    /// Only these cases; all, if none is named
    #[arg(value_name = "CASE", value_parser = PossibleValuesParser::new(names()))]
    cases: Vec<String>,
    /// Shipped or custom schemes: yoshida4,mine.toml
    ///
    /// Custom schemes are files of tables. The default is the schemes that each case needs, and all shipped ones where
    /// they are cheap.
    #[arg(long, value_name = "NAME|FILE,…", value_delimiter = ',')]
    schemes: Vec<String>,
    /// Decimal digits [default: double precision]
    ///
    /// All numbers have them, such as 50, except in cases that are about a number type.
    #[arg(long, value_name = "DIGITS", value_parser = |text: &str| whole(text, 1..=MOST_DIGITS))]
    digits: Option<u32>,
    /// Fewer and shorter trials
    #[arg(long)]
    quick: bool,
    /// One JSON object a line
    #[arg(long)]
    json: bool,
    /// The folder for report, charts and results
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Replaces files in --out that are not from this program
    #[arg(long, requires = "out")]
    force: bool,
}

/// Makes the trials and writes what they show.
pub(crate) fn execute(arguments: &Arguments) -> Result<Status, Error> {
    let cases = entries(&arguments.cases)?;
    let suite = suite(arguments)?;
    let out = arguments.out.as_deref();
    let study = |folder: &Path, terminal: &mut Terminal| examine(&suite, &cases, folder, terminal);
    let (findings, status) = study_in(out, arguments.force, files::written(), study)?;
    let records = findings.iter().flat_map(|(case, finding)| records(case, finding));
    let text = || findings.iter().map(|(case, finding)| readable(case, finding)).collect();
    Output::stdout().records_or_text(arguments.json, records, text)?;
    let counts = files::counts(&findings);
    let report = out.map(|folder| files::write(findings, &command(arguments), folder)).transpose()?;
    if !arguments.json {
        let report = report.map_or_else(String::new, |report| format!("{}\n", report.display()));
        Output::stdout().text(format_args!("{report}{counts}\n"))?;
    }
    Ok(if counts.differ > 0 { status.max(Status::NegativeAnswer) } else { status })
}

fn suite(arguments: &Arguments) -> Result<Suite, Error> {
    let arithmetic = match arguments.digits {
        Some(digits) => {
            Arithmetic::with_digits(digits).map_err(|error| Error::usage(error.to_string(), "use --digits 120"))?
        }
        None => Arithmetic::DOUBLE,
    };
    let mut schemes: Vec<NamedScheme> = Vec::new();
    for word in &arguments.schemes {
        let named = fitted(scheme(word)?, arithmetic)?;
        named.note().iter().for_each(report::note);
        if !schemes.iter().any(|other| other.name == named.name) {
            schemes.push(named);
        }
    }
    Ok(Suite::new(schemes, arithmetic, arguments.quick))
}

/// The command that writes the same files.
fn command(arguments: &Arguments) -> String {
    let mut words = vec!["shadowstep stability".to_owned()];
    words.extend(arguments.cases.iter().map(shell_word));
    if !arguments.schemes.is_empty() {
        words.push(format!("--schemes {}", shell_word(arguments.schemes.join(","))));
    }
    words.extend(arguments.digits.map(|digits| format!("--digits {digits}")));
    if arguments.quick {
        words.push("--quick".to_owned());
    }
    words.extend(arguments.out.as_ref().map(|out| format!("--out {}", shell_word(out))));
    words.join(" ")
}

/// A row as an object.
fn records(case: &CaseEntry, finding: &Finding) -> impl Iterator<Item = Object> {
    finding.statements.iter().map(move |row| {
        let (subject, found) = (row.statement.as_str(), row.found.as_str());
        let facts = [("case", case.name()), ("subject", subject), ("found", found), ("verdict", row.verdict.word())];
        Object(facts.map(|(key, text)| (key, text.into())).into())
    })
}

/// The columns of a terminal, and the margin behind a verdict.
const WIDTH: usize = 100;
const MARGIN: &str = "               ";

/// A case: its heading, its rows, its remarks.
fn readable(case: &CaseEntry, finding: &Finding) -> String {
    let mut text = format!("{}: {}\n", case.name(), case.title());
    for row in &finding.statements {
        let line = format!("{}: {}", row.statement, row.explained());
        let word = match row.verdict {
            Verdict::Agrees => "agrees",
            Verdict::Differs => "DIFFERS",
            Verdict::NotDecided(_) => "not decided",
        };
        let lines = wrapped_to(&line, MARGIN, WIDTH);
        text += &format!("  {word:<11}  {}\n", lines.trim());
    }
    for remark in &finding.found {
        text += &format!("{}\n", wrapped_to(remark, "  ", WIDTH).trim_end());
    }
    text + "\n"
}
