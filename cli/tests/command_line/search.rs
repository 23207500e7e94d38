//! `shadowstep search`: its files, what it resumes, refusals. What searches find is held against published schemes in
//! `analysis`.

use std::fs;
use std::path::Path;

use crate::program::shadowstep;

fn request(folder: &Path, text: &str) -> String {
    let file = folder.join("found.toml");
    fs::write(&file, text).unwrap();
    file.to_str().unwrap().to_owned()
}

/// McLachlan's and Atela's optimal scheme of two stages is known, and shipped.
#[test]
fn a_search_writes_proved_tables_beside_the_shipped_ones() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let file = request(
        folder.path(),
        "order = 2\nkinetic = \"any\"\nstages = 2\nminimise = \"effective-error\"\nstarts = 3\n",
    );
    let command = format!("search {file} --digits 40 --out {}", out.display());
    let first = shadowstep(&command);
    assert_eq!((first.code, &*first.err), (0, ""));
    let lines: Vec<&str> = first.out.lines().collect();
    assert!(lines[3].starts_with(" found-1") && lines[3].contains("0.18"), "{}", first.out);
    assert!(first.out.contains(" mclachlan-s2 (shipped)"), "{}", first.out);
    let table = out.join("found-1.toml");
    let checked = shadowstep(&format!("schemes check {}", table.display()));
    assert_eq!(checked.code, 0, "{}", checked.out);
    let text = fs::read_to_string(&table).unwrap();
    assert!(
        text.contains("digits = 40\n") && text.contains("a2 = \"0.61363\"\n"),
        "a free parameter has few digits: {text}"
    );
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("3 of 3 random starts met the order conditions") && page.contains("<svg"), "{page}");
    assert_eq!(fs::read_to_string(out.join("search.csv")).unwrap().lines().count(), 2 + 1 + 3);
    // a second call computes nothing and finds the same
    let results = fs::read_to_string(out.join("results.jsonl")).unwrap();
    let again = shadowstep(&command);
    assert_eq!((again.code, again.out), (0, first.out));
    assert_eq!(fs::read_to_string(out.join("results.jsonl")).unwrap(), results);
}

#[test]
fn processed_schemes_and_fronts_have_tables_too() {
    let folder = tempfile::tempdir().unwrap();
    for (text, found) in [
        (
            "order = 4\nkinetic = \"any\"\nstages = 5\nbase = \"stormer-verlet\"\nprocessor = 4\nminimise \
                = \"effective-error\"\nstarts = 2\n",
            "[processor]\norder = 4\n",
        ),
        (
            "order = 2\nkinetic = \"any\"\nstages = [2, 3]\nfront = [\"effective-error\", \"instability\"]\nstarts = \
                3\nkeep = 2\n",
            "order = 2\n",
        ),
        (
            "order = 4\nkinetic = \"quadratic\"\nstages = 2\nfirst = \"drift\"\ngradient_kicks = true\nminimise \
                = \"phase-error\"\nstarts = 2\n",
            "gradient_kick = [0, \"c1\", \"c1\"]\n",
        ),
    ] {
        let file = request(folder.path(), text);
        let out = folder.path().join(found.len().to_string());
        let result = shadowstep(&format!("search {file} --digits 30 --out {}", out.display()));
        assert_eq!((result.code, &*result.err), (0, ""), "{text}");
        let table = fs::read_to_string(out.join("found-1.toml")).unwrap();
        assert!(table.contains(found), "{table}");
        assert_eq!(shadowstep(&format!("schemes check {}", out.join("found-1.toml").display())).code, 0, "{table}");
    }
}
