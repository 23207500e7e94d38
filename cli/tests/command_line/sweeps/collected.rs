//! What is collected, what is refused, and runs that fail.

use std::fs;

use super::{SWEEP, TABLE, assert_same, files, folder, rows, run, succeeds, undisturbed};

const CHUNK_2: &str = "out/chunks/00002-of-00016";

/// The answer of `collect` where chunk 2 cannot be used.
fn refused(folder: &std::path::Path, why: &str) {
    let result = run(folder, "collect out");
    assert_eq!((result.code, result.out.as_str()), (1, "2\n"), "{}", result.err);
    assert!(result.err.contains(&format!("chunk 2 cannot be used: {why}")), "{why}: {}", result.err);
    assert!(!folder.join("out/results.csv").exists());
}

/// The hint is a command to copy, whatever the name of the folder is.
#[test]
fn folders_in_hints_are_words_of_the_shell() {
    let folder = folder(SWEEP);
    let mut begins = super::program(folder.path(), "sweep sweep.toml --chunk 1/16 --out");
    assert!(begins.arg("it's out").status().unwrap().success());
    let result = super::finished(&super::program(folder.path(), "collect").arg("it's out").output().unwrap());
    assert!(result.err.contains(r"`shadowstep sweep FILE --out 'it'\''s out'`"), "{}", result.err);
}

/// A table that does not belong to the chunks that are there would be taken for theirs.
#[test]
fn an_earlier_table_does_not_stay_beside_missing_chunks() {
    let folder = folder(&format!("{SWEEP}[picture]\nvalue = \"steps\"\n"));
    succeeds(folder.path(), "sweep sweep.toml --out out");
    succeeds(folder.path(), "collect out --format parquet");
    let written = ["results.csv", "results.parquet", "rows.csv", "picture.svg"];
    let are_there = || written.map(|name| folder.path().join("out").join(name).exists());
    assert_eq!(are_there(), [true; 4]);
    let chunk = fs::read(folder.path().join(CHUNK_2)).unwrap();
    for damaged in [None, Some(&chunk[..chunk.len() - 9])] {
        match damaged {
            None => fs::remove_file(folder.path().join(CHUNK_2)).unwrap(),
            Some(damaged) => fs::write(folder.path().join(CHUNK_2), damaged).unwrap(),
        }
        let result = run(folder.path(), "collect out");
        assert_eq!((result.code, result.out.as_str()), (1, "2\n"), "{}", result.err);
        assert!(
            result.err.contains("note: out/results.csv is removed: chunks of it are missing now"),
            "{}",
            result.err
        );
        assert_eq!(are_there(), [false; 4]);
        fs::write(folder.path().join(CHUNK_2), &chunk).unwrap();
        succeeds(folder.path(), "collect out");
    }
}

/// The axes of the table are those of the plan: its text is not trusted without its hash.
#[test]
fn a_changed_plan_is_refused() {
    let folder = folder(&SWEEP.replace("\"0 … 4/5 in 2 steps\"", "[0, \"2/5\", \"4/5\"]"));
    succeeds(folder.path(), "sweep sweep.toml --out out");
    let plan = folder.path().join("out/plan.json");
    let whole = fs::read_to_string(&plan).unwrap();
    for (old, new) in [("[0, \\\"2/5", "[\\\"1/2\\\", \\\"2/5"), ("\"energy_error\",", "\"steps\",")] {
        assert!(whole.contains(old), "{whole}");
        fs::write(&plan, whole.replacen(old, new, 1)).unwrap();
        for command in ["collect out", "sweep sweep.toml --out out", "sweep sweep.toml --out out --chunk 2/16"] {
            let result = run(folder.path(), command);
            assert_eq!((result.code, result.out.as_str()), (2, ""), "{command}: {}", result.err);
            assert!(result.err.contains("out/plan.json was changed: its hash differs\n  hint: "), "{}", result.err);
        }
    }
    // without it, the sweep writes it again
    fs::remove_file(&plan).unwrap();
    succeeds(folder.path(), "sweep sweep.toml --out out");
    assert_eq!(fs::read_to_string(&plan).unwrap(), whole);
}

#[test]
fn chunks_of_something_else_are_refused_with_the_reason() {
    let scheme = |sweep: &str| sweep.replace("[\"stormer-verlet\", \"ruth3\"]", "[\"mine.toml\", \"ruth3\"]");
    let first = folder(&scheme(SWEEP));
    succeeds(first.path(), "sweep sweep.toml --out out");
    fs::remove_file(first.path().join("out/results.csv")).unwrap();
    let whole = fs::read(first.path().join(CHUNK_2)).unwrap();

    let other = folder(&scheme(SWEEP).replace("until = 3", "until = 4"));
    succeeds(other.path(), "sweep sweep.toml --out out --chunk 2/16");
    fs::copy(other.path().join(CHUNK_2), first.path().join(CHUNK_2)).unwrap();
    refused(first.path(), "it is of another sweep");

    let other = folder(&scheme(SWEEP));
    fs::write(other.path().join("mine.toml"), TABLE.replace("[\"1\"]", "[\"1/2\", \"1/2\"]")).unwrap();
    succeeds(other.path(), "sweep sweep.toml --out out --chunk 2/16");
    fs::copy(other.path().join(CHUNK_2), first.path().join(CHUNK_2)).unwrap();
    refused(first.path(), "it was made with other tables of schemes");

    let version = env!("CARGO_PKG_VERSION");
    let text = String::from_utf8(whole.clone()).unwrap();
    fs::write(first.path().join(CHUNK_2), text.replacen(version, "0.0.1", 1)).unwrap();
    refused(first.path(), "it was made by version 0.0.1");

    fs::copy(first.path().join("out/chunks/00003-of-00016"), first.path().join(CHUNK_2)).unwrap();
    refused(first.path(), "it has other runs than its name");

    fs::write(first.path().join(CHUNK_2), &whole[..whole.len() / 2]).unwrap();
    refused(first.path(), "run ");

    let mut flipped = whole.clone();
    let place = whole.len() / 2 + text[whole.len() / 2..].find("\":\"").unwrap_or(0);
    let digit = (place..).find(|&place| flipped[place].is_ascii_digit()).unwrap();
    flipped[digit] ^= 1;
    fs::write(first.path().join(CHUNK_2), flipped).unwrap();
    let result = run(first.path(), "collect out");
    assert_eq!((result.code, result.out.as_str()), (1, "2\n"), "{}", result.err);

    fs::write(first.path().join(CHUNK_2), whole).unwrap();
    assert!(succeeds(first.path(), "collect out").out.starts_with("out/results.csv\nout/rows.csv\n"));
}

#[test]
fn comments_and_pictures_change_no_sweep_and_axes_do() {
    let text = SWEEP.replace("stormer-verlet", "mine.toml");
    let folder = folder(&text);
    succeeds(folder.path(), "sweep sweep.toml --out out");
    let before = files(&folder.path().join("out"));
    let sweep = |text: &str| fs::write(folder.path().join("sweep.toml"), text).unwrap();
    // spaces, comments, the order of sections and keys, what is drawn
    let (scene, axes) = text.split_once("[axes]").unwrap();
    for same in [
        format!("# a comment\n{text}"),
        format!("[axes]{axes}{scene}").replace("until = 3\n", "").replace("step =", "until = 3\nstep  ="),
        format!("{text}\n[picture]\nvalue = \"steps\"\n"),
    ] {
        sweep(&same);
        succeeds(folder.path(), "sweep sweep.toml --out out --chunk 3/16");
        succeeds(folder.path(), "sweep sweep.toml --out out");
        let out = files(&folder.path().join("out"));
        for (name, bytes) in before.iter().filter(|(name, _)| name.starts_with("chunks") || name.ends_with("csv")) {
            assert!(out[name] == *bytes, "{name}");
        }
    }
    for (old, new) in [
        ("9 steps of", "8 steps of"),
        ("4/5 in 2", "3/5 in 2"),
        ("until = 3", "until = 2"),
        ("\"energy_error\", \"steps\"", "\"steps\", \"energy_error\""),
        ("< 1/2", "< 1/3"),
        ("\"mine.toml\", \"ruth3\"", "\"ruth3\", \"mine.toml\""),
    ] {
        assert!(text.contains(old), "{old}");
        sweep(&text.replace(old, new));
        for flags in ["", " --chunk 3/16"] {
            let result = run(folder.path(), &format!("sweep sweep.toml --out out{flags}"));
            assert_eq!(result.code, 2, "{new}");
            assert!(
                result.err.contains("out is of another sweep, or of this one before it was changed"),
                "{}",
                result.err
            );
        }
    }
    sweep(&text);
    fs::write(folder.path().join("mine.toml"), TABLE.replace("L. Verlet", "C. Störmer")).unwrap();
    succeeds(folder.path(), "sweep sweep.toml --out out");
    fs::write(folder.path().join("mine.toml"), TABLE.replace("[\"1\"]", "[\"1/2\", \"1/2\"]")).unwrap();
    let result = run(folder.path(), "sweep sweep.toml --out out");
    assert_eq!(result.code, 2);
    assert!(result.err.contains("out was made with other tables of schemes"), "{}", result.err);
}

#[test]
fn what_is_not_from_the_sweep_is_replaced_only_by_force() {
    let forced = |folder: &std::path::Path, sentence: &str| {
        let before = files(&folder.join("out"));
        let result = run(folder, "sweep sweep.toml --out out");
        assert!(result.code == 2 && result.err.contains(sentence) && result.err.contains("--force"), "{}", result.err);
        assert_same(&folder.join("out"), &before, sentence);
        succeeds(folder, "sweep sweep.toml --out out --force");
        assert_same(&folder.join("out"), &undisturbed(SWEEP), sentence);
    };
    for name in ["results.csv", "picture.svg"] {
        let folder = folder(SWEEP);
        fs::create_dir(folder.path().join("out")).unwrap();
        fs::write(folder.path().join("out").join(name), "mine").unwrap();
        forced(folder.path(), "exists, without results of this program beside it");
    }
    // chunks of another sweep, of which one is not complete
    let folder = folder(&SWEEP.replace("until = 3", "until = 2"));
    succeeds(folder.path(), "sweep sweep.toml --out out --chunk 3/8");
    fs::rename(
        folder.path().join("out/chunks/00003-of-00008"),
        folder.path().join("out/chunks/00003-of-00008.partial-x"),
    )
    .unwrap();
    succeeds(folder.path(), "sweep sweep.toml --out out --chunk 4/8");
    fs::write(folder.path().join("sweep.toml"), SWEEP).unwrap();
    // a number of chunks that cannot be is refused before anything is removed
    let before = files(&folder.path().join("out"));
    let result = run(folder.path(), "sweep sweep.toml --out out --force --chunk 1/1000000");
    assert!(result.code == 2 && result.err.contains("cannot be divided into 1000000 chunks"), "{}", result.err);
    assert_same(&folder.path().join("out"), &before, "nothing is removed");
    forced(folder.path(), "out is of another sweep");
    // what is from the sweep stays
    let result = succeeds(folder.path(), "sweep sweep.toml --out out --force --chunk 3/16");
    assert!(result.err.contains("is there already"), "{}", result.err);
}

/// The scene is in a file; a change there is a change of the sweep.
#[test]
fn a_scene_may_have_its_own_file() {
    let (scene, axes) = SWEEP.split_once("[axes]").unwrap();
    let folder = folder(&format!("scene = \"scenes/kepler.toml\"\n[axes]{axes}"));
    fs::create_dir(folder.path().join("scenes")).unwrap();
    let write = |text: &str| fs::write(folder.path().join("scenes/kepler.toml"), text).unwrap();
    write(scene);
    succeeds(folder.path(), "sweep sweep.toml --out out");
    let csv = |path: &std::path::Path| fs::read(path.join("out/rows.csv")).unwrap();
    let together = super::folder(SWEEP);
    succeeds(together.path(), "sweep sweep.toml --out out");
    assert!(csv(folder.path()) == csv(together.path()));
    // collected without the scene
    fs::remove_file(folder.path().join("scenes/kepler.toml")).unwrap();
    fs::remove_file(folder.path().join("out/results.csv")).unwrap();
    succeeds(folder.path(), "collect out");
    write(&scene.replace("until = 3", "until = 2"));
    let result = run(folder.path(), "sweep sweep.toml --out out");
    assert!(result.code == 2 && result.err.contains("is of another sweep"), "{}", result.err);
}

/// q = 1/0 is refused, and in the potential −q⁴ a state overflows.
const FAILING: &str = r#"
[problem]
potential = "-a*q^4"
coordinates = ["q"]
[initial]
q = ["1/c"]
p = [0]
[run]
scheme = "stormer-verlet"
step = "1/10"
steps = 60
digits = "double"
[axes]
a = [-1, 1, 0]
c = [1, 2, 0]
[keep]
values = ["verdict", "energy_error", "steps"]
first_time = { far = "q > 100" }
state = true
"#;

#[test]
fn runs_that_fail_are_recorded_and_stop_nothing() {
    let folder = folder(FAILING);
    let result = succeeds(folder.path(), "sweep sweep.toml --out out");
    assert!(result.err.contains("note: 5 of 9 runs failed; run 2 (a = -1, c = 0): "), "{}", result.err);
    assert!(result.err.contains("note: 9 runs, 5 of them failed"), "{}", result.err);
    for row in rows(folder.path()) {
        let (a, c, failure) = (row["a"].as_str(), row["c"].as_str(), row["failure"].as_str());
        let values = ["verdict", "energy_error", "steps", "far", "q", "pq"].map(|name| row[name].as_str());
        match (a, c) {
            (_, "0") => assert_eq!(failure, "division by zero"),
            ("1", _) => assert!(failure.contains("step 1/10: the run stopped at n = "), "{failure}"),
            _ => assert_eq!(failure, ""),
        }
        match failure {
            "" => assert!(
                ["verdict", "energy_error", "steps", "q", "pq"].iter().all(|name| !row[*name].is_empty()),
                "{row:?}"
            ),
            _ => assert_eq!(values, [""; 6], "{row:?}"),
        }
    }
    // they are not made again
    let again = succeeds(folder.path(), "sweep sweep.toml --out out");
    assert_eq!(again.err.lines().filter(|line| line.contains("runs failed;")).count(), 0, "{}", again.err);
}

/// One complete run is enough, wherever it is.
#[test]
fn the_first_runs_may_fail() {
    for eccentricities in ["[2, 3, \"1/2\"]", "[1, \"1/2\", 2]", "[1, 2, 3, 4, 5, 6, 7, 8, 9, 0]"] {
        let folder = folder(&SWEEP.replace("\"0 … 4/5 in 2 steps\"", eccentricities));
        let result = succeeds(folder.path(), "sweep sweep.toml --out out");
        assert!(result.err.contains("eccentricity = ") && result.err.contains("is out of range"), "{}", result.err);
        assert_eq!(rows(folder.path()).iter().filter(|row| row["failure"].is_empty()).count(), 20);
    }
}

#[test]
fn a_mistake_in_the_scene_is_no_failure_of_every_run() {
    for (part, mistake) in [("digits =", "digit ="), ("steps = 60", "steps = \"$n\""), ("\"-a*q^4\"", "\"-a*q^4 + z\"")]
    {
        assert!(FAILING.contains(part));
        let folder = folder(&FAILING.replace(part, mistake));
        let result = run(folder.path(), "sweep sweep.toml --out out");
        assert_eq!(result.code, 2, "{}", result.err);
        assert!(result.err.contains("sweep.toml:"), "{}", result.err);
        assert!(!folder.path().join("out").exists());
    }
}

/// A file of particles that was edited: what is there was made with another one.
#[test]
fn another_file_of_particles_is_another_sweep() {
    let sweep = "[problem]\nparameters.g = 40\nparticles = \"p.csv\"\n[[body]]\nname = \"sun\"\nmass = \
        1\n[[body]]\nname = \"jupiter\"\n\
                 mass = 0.001\na = 5\n[run]\nscheme = \"saba4\"\nstep = \"h\"\nsteps = 20\ndigits \
                 = \"double\"\n[axes]\n\
                 h = [\"1/20\", \"1/40\"]\n[keep]\nvalues = [\"energy_error\"]\nstate = true\n";
    let folder = folder(sweep);
    fs::write(folder.path().join("p.csv"), "a,e\n3,0.1\n").unwrap();
    assert_eq!(run(folder.path(), "sweep sweep.toml --out out").code, 0);
    let wanted = fs::read(folder.path().join("out/results.csv")).unwrap();
    fs::write(folder.path().join("p.csv"), "a,e\n4,0.1\n").unwrap();
    let result = run(folder.path(), "sweep sweep.toml --out out");
    assert!(result.code == 2 && result.err.contains("other files of particles or bodies"), "{}", result.err);
    assert_eq!(fs::read(folder.path().join("out/results.csv")).unwrap(), wanted);
    assert_eq!(run(folder.path(), "sweep sweep.toml --out out --force").code, 0);
    assert_ne!(fs::read(folder.path().join("out/results.csv")).unwrap(), wanted);
}
