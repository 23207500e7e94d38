//! The files of a study in its folder.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;
use shadowstep_scenes::WholeFile;
use shadowstep_scenes::spreadsheet::cell;

use crate::chart::Chart;
use crate::finding::Finding;
use crate::page::{Report, Section};
use crate::{Error, Store};

/// The name of the page.
pub const PAGE: &str = "report.html";

/// Refuses a folder that has files of these names, in which a `*` stands for any characters, without outcomes of this
/// program beside them: others wrote them, and they are not replaced.
///
/// # Errors
/// Such a file.
pub fn refuse_foreign(folder: &Path, written: impl IntoIterator<Item = String>) -> Result<(), Error> {
    if Store::is_in(folder) {
        return Ok(());
    }
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort();
    let is_written = |name: &str, written: &str| match written.split_once('*') {
        None => name == written,
        Some((begin, end)) => name.strip_prefix(begin).is_some_and(|rest| rest.ends_with(end)),
    };
    let foreign = written.into_iter().find_map(|written| names.iter().find(|name| is_written(name, &written)));
    foreign.map_or(Ok(()), |name| {
        let message = format!("{} exists, without results of this program beside it", folder.join(name).display());
        Err(Error::usage(message, "give another folder, or replace its files with `force`"))
    })
}

/// Writes a file, which gets its name when it is complete.
///
/// # Errors
/// A file that cannot be written.
pub fn write_file(folder: &Path, name: &str, text: &str) -> Result<(), Error> {
    let mut file = WholeFile::create(&folder.join(name), "the file")?;
    file.write_all(text.as_bytes())?;
    file.finish()
}

/// Writes the charts of what was found; returns its section of the page, with the names of their files.
///
/// # Errors
/// A file that cannot be written.
pub fn write_section(folder: &Path, name: &str, title: &str, finding: Finding) -> Result<Section, Error> {
    let files = write_charts(folder, name, &finding.charts)?;
    Ok(Section { title: title.to_owned(), of_paper: None, finding, files })
}

/// Writes charts as `name.svg`, or as `name-1.svg` and so on if there are several; returns the names of the files.
///
/// # Errors
/// A file that cannot be written.
pub(crate) fn write_charts(folder: &Path, name: &str, charts: &[(Chart, String)]) -> Result<Vec<String>, Error> {
    let file = |(i, (chart, _)): (usize, &(Chart, String))| {
        let file = if charts.len() == 1 { format!("{name}.svg") } else { format!("{name}-{}.svg", i + 1) };
        write_file(folder, &file, &chart.svg())?;
        Ok(file)
    };
    charts.iter().enumerate().map(file).collect()
}

/// Writes the page; returns its path.
///
/// # Errors
/// A file that cannot be written.
pub fn write_page(folder: &Path, page: &Report) -> Result<PathBuf, Error> {
    write_file(folder, PAGE, &page.html())?;
    Ok(folder.join(PAGE))
}

/// Records as CSV, after the lines of a head with `# ` before each.
///
/// # Errors
/// A record that CSV cannot contain, such as a map.
pub fn csv<R: Serialize>(head: &[String], records: impl IntoIterator<Item = R>) -> Result<String, Error> {
    let head: String = head.iter().map(|line| format!("# {line}\n")).collect();
    let mut plain = csv::Writer::from_writer(Vec::new());
    records.into_iter().try_for_each(|record| plain.serialize(record))?;
    let plain = plain.into_inner().map_err(|error| error.into_error())?;
    let mut csv = csv::Writer::from_writer(head.into_bytes());
    for record in csv::ReaderBuilder::new().has_headers(false).from_reader(&plain[..]).records() {
        csv.write_record(record?.iter().map(|text| cell(text).into_owned()))?;
    }
    let bytes = csv.into_inner().map_err(|error| error.into_error())?;
    Ok(String::from_utf8(bytes).expect("CSV of texts is a text"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Names of files of others, and which of the written ones is said to be there.
    #[test]
    fn files_of_others_are_refused_unless_there_are_outcomes() {
        for (others, refused) in [
            (&["notes.txt", "case.csv"][..], None),
            (&["report.html"], Some("report.html")),
            (&["case-2.svg", "report.html"], Some("case-2.svg")),
            (&["case-.txt", "case.svg.txt", "-a.svg"], None),
        ] {
            let folder = tempfile::tempdir().unwrap();
            others.iter().for_each(|name| fs::write(folder.path().join(name), "").unwrap());
            let refuse = || refuse_foreign(folder.path(), ["case.svg", "case-*.svg", PAGE].map(str::to_owned));
            match (refuse(), refused) {
                (Ok(()), None) => {}
                (Err(error), Some(name)) => {
                    let words = format!("{} exists, without results", folder.path().join(name).display());
                    assert!(error.to_string().starts_with(&words), "{error}");
                }
                (found, _) => panic!("{others:?}: {found:?}"),
            }
            Store::open(folder.path(), &mut ()).unwrap();
            refuse().unwrap();
        }
    }

    #[test]
    fn csv_has_a_head_and_quotes() {
        let rows = [vec!["a", "b,c"], vec!["", "1"]];
        assert_eq!(csv(&["of mine".to_owned()], &rows).unwrap(), "# of mine\na,\"b,c\"\n,1\n");
    }
}
