//! Finds circles of files and shows them.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use petgraph::algo::tarjan_scc;
use petgraph::graphmap::DiGraphMap;

use super::imports::Imports;

/// The strongly connected components of more than one file: each file imports from every other, directly or through
/// more.
pub(crate) fn circles(imports: &Imports) -> BTreeSet<BTreeSet<PathBuf>> {
    let graph: DiGraphMap<&Path, ()> = imports.keys().map(|(from, to)| (from.as_path(), to.as_path())).collect();
    let groups = tarjan_scc(&graph).into_iter().filter(|files| files.len() > 1);
    groups.map(|files| files.into_iter().map(Path::to_path_buf).collect()).collect()
}

/// The files of a circle with what each takes from the others; paths are shown from `base`.
pub(crate) fn show(circle: &BTreeSet<PathBuf>, imports: &Imports, base: &Path) -> String {
    let short = |file: &Path| file.strip_prefix(base).unwrap_or(file).display().to_string();
    let files: Vec<_> = circle.iter().map(|file| short(file)).collect();
    let mut text = format!("{} files import each other: {}\n", files.len(), files.join(", "));
    for ((from, to), names) in imports.iter().filter(|((from, to), _)| circle.contains(from) && circle.contains(to)) {
        let names: Vec<_> = names.iter().map(String::as_str).collect();
        writeln!(text, "  {} imports from {}: {}", short(from), short(to), names.join(", ")).expect("memory suffices");
    }
    text
}
