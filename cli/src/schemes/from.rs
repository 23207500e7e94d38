//! `shadowstep schemes check --from`: the schemes in source code.

use std::io::{ErrorKind, Write};

use shadowstep_analysis::sources::{Language, Verdict, check};
use shadowstep_schemes::document::read_text;
use shadowstep_schemes::held;

use crate::output::Output;
use crate::readable::wrapped;
use crate::report::{self, Status};
use shadowstep_scenes::Error;

/// The most bytes of a source.
const LARGEST_SOURCE: u64 = 4 << 20;

/// The margin of what is said of a list.
const MARGIN: &str = "  ";

/// Goes through all sources; the worst answer counts.
pub(super) fn execute(paths: &[String]) -> Result<Status, Error> {
    let mut output = Output::stdout();
    let mut status = Status::Success;
    let (mut schemes, mut wrong, mut skipped) = (0, 0, 0);
    for path in paths {
        let (text, language) = match source(path) {
            Ok(source) => source,
            Err(error) => {
                status = status.max(report::error(&error));
                continue;
            }
        };
        let checked = check(&text, language);
        for verdict in &checked.verdicts {
            write!(output, "{}", readable(path, verdict))?;
        }
        schemes += checked.verdicts.len();
        wrong += checked.verdicts.iter().filter(|verdict| !verdict.faults.is_empty()).count();
        skipped += checked.skipped;
    }
    writeln!(output, "schemes: {schemes}, of which wrong: {wrong}; lists that are not schemes: {skipped}")?;
    output.finish()?;
    Ok(if wrong > 0 { status.max(Status::NegativeAnswer) } else { status })
}

fn source(path: &str) -> Result<(String, Language), Error> {
    let language = Language::of(path).ok_or_else(|| {
        let hint = format!("the language is known by the ending: {}", Language::endings());
        Error::usage(format!("{path} is not a source that can be read"), hint)
    })?;
    let text = read_text(path, LARGEST_SOURCE).map_err(|error| match error.kind() {
        ErrorKind::NotFound => Error::usage(format!("there is no file {path}"), "give the path of source code"),
        _ => Error::usage(format!("{path} cannot be read: {error}"), "give a file of source code in UTF-8"),
    })?;
    Ok((text, language))
}

fn readable(path: &str, verdict: &Verdict) -> String {
    let mut text = format!("{path}:{}: {}: {}\n", verdict.line, verdict.name, verdict.role);
    let mut lines = vec![truth(verdict)];
    lines.extend(verdict.faults.iter().map(|fault| format!("wrong: {fault}")));
    lines.extend(verdict.notes.iter().map(|note| format!("note: {note}")));
    lines.iter().for_each(|line| text += &wrapped(&format!("{MARGIN}{line}"), MARGIN));
    text
}

/// What holds.
fn truth(verdict: &Verdict) -> String {
    let [general, quadratic] = verdict.orders;
    if quadratic == 0 {
        return "order 0".to_owned();
    }
    let first = verdict.first.map_or_else(String::new, |first| format!(" that begins with a {first}"));
    let order = match quadratic {
        _ if quadratic > general => format!("order {general}, {quadratic} for quadratic T{first}"),
        _ => format!("order {general}"),
    };
    let symmetric = if verdict.symmetric { ", symmetric" } else { "" };
    let known = verdict
        .likeness
        .as_ref()
        .map_or_else(|| "not a shipped scheme".to_owned(), |known| format!("is {}", known.text()));
    format!("{order}, {}{symmetric}; {known}", held(verdict.digits))
}
