//! Complete files: they are those of their checkpoints, and of the inputs that are there now; they go on by
//! `--continue`.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use crate::scenes::{folder, run};

const KEPLER: &str = "[problem]\nname = \"kepler\"\n[run]\nscheme = \"mine.toml\"\nstep = \"1/20\"\nsteps = \
    20\ndigits = \"double\"\n\
                      [output]\ntrajectory = true\nenergy = true\nfile = \"out.csv\"\n";

const PLANETS: &str = "[problem]\nparameters.g = 40\nparticles = \"p.csv\"\n[[body]]\nname = \"sun\"\nmass = 1\n\
                       [[body]]\nname = \"jupiter\"\nmass = 0.001\na = 5\n[run]\nscheme = \"saba4\"\nstep \
                       = \"1/20\"\nsteps = 20\n\
                       digits = \"double\"\n[output]\nenergy = true\nfile = \"out.csv\"\n";

const ENSEMBLE: &str = "[problem]\nname = \"kepler\"\nparameters.eccentricity = \"e\"\n[run]\nscheme \
    = \"ruth3\"\nstep = \"1/20\"\nsteps = 20\n\
                        digits = \"double\"\n[output]\nenergy = true\nfile = \"out.csv\"\n[ensemble]\nfile \
                        = \"c.csv\"\n";

const TABLE: &str = "name = \"mine\"\norder = 2\nkinetic = \"any\"\nsymmetric = true\nreference = \"L. Verlet\"\n\
                     [composition]\nbase = \"base\"\ngamma = [\"1\"]\n";

const BASE: &str = "name = \"base\"\norder = 2\nkinetic = \"any\"\nsymmetric = true\nreference = \"L. Verlet\"\n\
                    [stages]\nkick = [\"1/2\", \"1/2\"]\ndrift = [1, 0]\n";

const TABLES: &[(&str, &str)] = &[("mine.toml", TABLE), ("base.toml", BASE)];

/// A scene with the files that it reads, the one to which some text is added, and what the message says.
type Input = (&'static str, &'static [(&'static str, &'static str)], &'static str, &'static str, &'static str);

const INPUTS: [Input; 4] = [
    (KEPLER, TABLES, "mine.toml", "# changed\n", "with a different table mine.toml"),
    (KEPLER, TABLES, "base.toml", "# changed\n", "with a different table base.toml"),
    (PLANETS, &[("p.csv", "a,e\n3,0.1\n")], "p.csv", "4,0.1\n", "with a different file p.csv"),
    (ENSEMBLE, &[("c.csv", "e\n0.1\n")], "c.csv", "0.2\n", "with different columns"),
];

#[test]
fn a_file_made_with_other_inputs_is_kept_and_what_differs_is_named() {
    for (scene, files, changed, added, wanted) in INPUTS {
        for checkpoint in ["", "checkpoint = 5\n"] {
            if !checkpoint.is_empty() && scene == ENSEMBLE {
                continue;
            }
            let folder = folder(&scene.replace("file = \"out.csv\"\n", &format!("file = \"out.csv\"\n{checkpoint}")));
            files.iter().for_each(|(name, text)| fs::write(folder.path().join(name), text).unwrap());
            assert_eq!(run(folder.path(), "").code, 0);
            let rows = fs::read(folder.path().join("out.csv")).unwrap();
            let text = files.iter().find(|(name, _)| *name == changed).unwrap().1;
            fs::write(folder.path().join(changed), format!("{text}{added}")).unwrap();
            for flags in ["", "--restart", "--continue"] {
                let result = run(folder.path(), flags);
                let is_kept = fs::read(folder.path().join("out.csv")).unwrap() == rows;
                assert!(result.code == 2 && is_kept, "{wanted} {flags}: {}", result.err);
                assert!(
                    result.err.contains(&format!("out.csv already exists and was made {wanted}")),
                    "{}",
                    result.err
                );
            }
            assert_eq!(run(folder.path(), "--force").code, 0);
            assert_ne!(fs::read(folder.path().join("out.csv")).unwrap(), rows, "{wanted}");
        }
    }
}

/// A complete run of a scene with checkpoints in a format.
fn complete(format: &str) -> TempDir {
    let scene = KEPLER.replace("mine.toml", "ruth3").replace("out.csv", &format!("out.{format}"));
    let folder = folder(&format!("{scene}checkpoint = 5\n"));
    assert_eq!(run(folder.path(), "").code, 0);
    let result = run(folder.path(), "");
    assert!(result.code == 0 && result.err.contains("is complete"), "{}", result.err);
    folder
}

#[test]
fn a_complete_file_that_was_changed_is_not_called_complete() {
    for format in ["csv", "jsonl", "npy"] {
        let folder = complete(format);
        let path = folder.path().join(format!("out.{format}"));
        let whole = fs::read(&path).unwrap();
        for part in 0..25 {
            let place = (whole.len() - 1) * part / 24;
            let mut flipped = whole.clone();
            flipped[place] ^= 1;
            let (damaged, what) = match part % 2 {
                0 => (&whole[..place.max(1)], "bytes, and had"),
                _ => (&flipped[..], "was changed after it was complete"),
            };
            fs::write(&path, damaged).unwrap();
            let result = run(folder.path(), "");
            assert_eq!(result.code, 2, "{format}, {place}: {}", result.err);
            assert!(result.err.contains(what) && result.err.contains("restore it, or"), "{place}: {}", result.err);
            assert_eq!(fs::read(&path).unwrap(), damaged);
        }
        for flags in ["--restart", "--force"] {
            let mut damaged = whole.clone();
            *damaged.last_mut().unwrap() ^= 1;
            fs::write(&path, damaged).unwrap();
            assert_eq!(run(folder.path(), flags).code, 0);
            assert_eq!(fs::read(&path).unwrap(), whole, "{format} {flags}");
        }
    }
}

#[test]
fn changed_metadata_beside_a_complete_file_are_named() {
    for format in ["jsonl", "npy"] {
        let folder = complete(format);
        let path = folder.path().join(format!("out.{format}.metadata.json"));
        let text = fs::read_to_string(&path).unwrap();
        for damaged in [
            text.replace("\"ruth3\"", "\"ruth4\""),
            text.replace("\"steps\": 20", "\"steps\": 21"),
            text[..text.len() - 20].to_owned(),
        ] {
            fs::write(&path, damaged).unwrap();
            let result = run(folder.path(), "");
            assert!(result.code == 2 && result.err.contains("metadata.json was changed after"), "{}", result.err);
        }
        // another name of the scene is no change
        fs::write(&path, text.replace("scene.toml", "other.toml")).unwrap();
        assert_eq!(run(folder.path(), "").code, 0);
    }
}

fn rows(folder: &Path) -> Vec<String> {
    let text = fs::read_to_string(folder.join("out.csv")).unwrap();
    text.lines().filter(|line| !line.starts_with('#')).map(str::to_owned).collect()
}

#[test]
fn a_run_with_charts_goes_on_by_a_flag_of_its_own() {
    let scene = format!("{}checkpoint = 5\nplot = \"out.svg\"\n", KEPLER.replace("mine.toml", "ruth3"));
    let folder = folder(&scene);
    let here = folder.path();
    let write = |text: &str| fs::write(here.join("scene.toml"), text).unwrap();
    let chart = || fs::read_to_string(here.join("out.svg")).unwrap();
    // where nothing is there, the flag begins a run
    assert_eq!(run(here, "--continue").code, 0);
    let (short, first) = (rows(here), chart());
    write(&scene.replace("steps = 20", "steps = 30"));
    let refused = run(here, "");
    assert!(refused.code == 2 && refused.err.contains("--continue prolongs"), "{}", refused.err);
    // another key is changed, too: the rows that are there are not replaced
    for other in [("1/20", "1/21"), ("energy = true\n", "energy = { every = 2 }\n"), ("ruth3", "yoshida4")] {
        write(&scene.replace("steps = 20", "steps = 30").replace(other.0, other.1));
        let refused = run(here, "--continue");
        assert!(refused.code == 2 && refused.err.contains("already exists and"), "{}", refused.err);
        assert_eq!((rows(here), chart()), (short.clone(), first.clone()));
    }
    write(&scene.replace("steps = 20", "steps = 30"));
    let result = run(here, "--continue");
    assert_eq!(result.code, 0, "{}", result.err);
    assert!(rows(here).starts_with(&short) && rows(here).len() == 32 && chart() != first);
    let whole = rows(here);
    assert_eq!(run(here, "--force --restart").code, 0);
    assert_eq!(rows(here), whole);
    // a chart of someone else stays
    fs::write(here.join("out.svg"), "precious").unwrap();
    write(&scene.replace("steps = 20", "steps = 40"));
    assert!(run(here, "--continue").code == 2 && chart() == "precious");
    for flags in ["--continue --force", "--continue --restart"] {
        assert_eq!(run(here, flags).code, 2);
    }
}
