//! One chunk at a time, in any order, by any number of processes.

use std::fs;
use std::path::Path;
use std::process::Command;

use sha2::{Digest, Sha256};

use super::{SWEEP, assert_same, files, finished, folder, program, run, succeeds, undisturbed};

fn chunk(number: u32) -> String {
    format!("sweep sweep.toml --out out --chunk {number}/16")
}

/// As a task of a Slurm array whose tasks have these numbers.
fn task(folder: &Path, number: u32, count: u32, ends: (u32, u32)) -> crate::program::Finished {
    let mut program = program(folder, "sweep sweep.toml --out out");
    for (name, value) in [("ID", number), ("COUNT", count), ("MIN", ends.0), ("MAX", ends.1)] {
        program.env(format!("SLURM_ARRAY_TASK_{name}"), value.to_string());
    }
    finished(&program.output().unwrap())
}

#[test]
fn a_chunk_that_is_there_is_not_touched() {
    let folder = folder(SWEEP);
    succeeds(folder.path(), &chunk(2));
    let path = folder.path().join("out/chunks/00002-of-00016");
    let before = fs::metadata(&path).unwrap().modified().unwrap();
    let result = succeeds(folder.path(), &chunk(2));
    assert!(result.err.contains("note: chunk 2/16 is there already: nothing is done"), "{}", result.err);
    assert_eq!(fs::metadata(&path).unwrap().modified().unwrap(), before);
}

/// The bytes with another header, and the hash that fits.
fn resealed(bytes: &[u8], old: &str, new: &str) -> Vec<u8> {
    let text = String::from_utf8(bytes.to_vec()).unwrap();
    let content = &text[..text.trim_end().rfind('\n').unwrap() + 1];
    assert!(content.contains(old), "{old}");
    let content = content.replacen(old, new, 1);
    let hash: String = Sha256::digest(content.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect();
    format!("{content}{{\"sha256\":\"{hash}\"}}\n").into_bytes()
}

#[test]
fn a_damaged_chunk_is_computed_again() {
    let folder = folder(SWEEP);
    succeeds(folder.path(), &chunk(2));
    let path = folder.path().join("out/chunks/00002-of-00016");
    let whole = fs::read(&path).unwrap();
    assert_eq!(resealed(&whole, "x", "x"), whole, "the hash is that of the test");
    let flipped = |place: usize| {
        let mut bytes = whole.clone();
        bytes[place] ^= 1;
        bytes
    };
    let last = whole.len() - 1;
    let cut = |length: usize| whole[..length].to_vec();
    let mut damaged: Vec<Vec<u8>> = [0, 20, 200, last / 2, last - 90, last - 10, last].map(flipped).into();
    damaged.extend([0, 1, 100, last / 2, last - 80, last].map(cut));
    damaged.push([whole.as_slice(), whole.as_slice()].concat());
    damaged.push(resealed(
        &whole,
        &format!("\"shadowstep\":\"{}\"", env!("CARGO_PKG_VERSION")),
        "\"shadowstep\":\"0.0.1\"",
    ));
    damaged.push(resealed(&whole, "\"sweep\":\"", "\"sweep\":\"0"));
    damaged.push(resealed(&whole, "\"tables\":\"", "\"tables\":\"0"));
    damaged.push(resealed(&whole, "{\"run\":4,", "{\"run\":5,"));
    damaged.push(vec![b'['; 100_000]);
    for (case, bytes) in damaged.iter().enumerate() {
        fs::write(&path, bytes).unwrap();
        let result = succeeds(folder.path(), &chunk(2));
        assert_eq!(result.err, "", "case {case}");
        assert!(fs::read(&path).unwrap() == whole, "case {case}");
    }
    // chunk 3 under the name of chunk 2
    succeeds(folder.path(), &chunk(3));
    fs::copy(folder.path().join("out/chunks/00003-of-00016"), &path).unwrap();
    succeeds(folder.path(), &chunk(2));
    assert!(fs::read(&path).unwrap() == whole);
}

#[test]
fn processes_may_compute_the_same_chunk_at_the_same_time() {
    let wanted = undisturbed(SWEEP);
    let folder = folder(SWEEP);
    for _ in 0..3 {
        let children: Vec<_> = (0..4).map(|_| program(folder.path(), &chunk(1)).spawn().unwrap()).collect();
        for child in children {
            let result = finished(&child.wait_with_output().unwrap());
            assert_eq!(result.code, 0, "{}", result.err);
        }
        let out = files(&folder.path().join("out"));
        assert!(out["chunks/00001-of-00016"] == wanted["chunks/00001-of-00016"]);
        fs::remove_dir_all(folder.path().join("out")).unwrap();
    }
}

/// How a chunk of a folder is computed, among the first ones or later.
type Way<'a> = &'a dyn Fn(&Path, u32, bool) -> crate::program::Finished;

/// Chunks in an order, by a flag each, by the tasks of an array, or by those of a job script, which runs in any folder.
#[cfg(unix)]
#[test]
fn chunks_in_any_order_are_collected_as_a_sweep_on_one_machine() {
    let wanted = undisturbed(SWEEP);
    let elsewhere = tempfile::tempdir().unwrap();
    let by_flag = |folder: &Path, number: u32, _| run(folder, &chunk(number));
    // an array of all, and then one of those that are missing
    let by_array = |folder: &Path, number, is_first| match is_first {
        true => task(folder, number, 16, (1, 16)),
        false => task(folder, number, 13, (2, 15)),
    };
    let by_script = |folder: &Path, number: u32, _| {
        let script = succeeds(folder, "sweep sweep.toml --out out --job-script 16").out;
        let mut shell = Command::new("sh");
        shell.args(["-c", &script]).current_dir(elsewhere.path());
        finished(&shell.env("SLURM_ARRAY_TASK_ID", number.to_string()).output().unwrap())
    };
    let ways: [Way<'_>; 3] = [&by_flag, &by_array, &by_script];
    for way in ways {
        let folder = folder(SWEEP);
        let compute = |number: u32, is_first| {
            let result = way(folder.path(), number, is_first);
            assert_eq!((result.code, result.out.as_str(), result.err.as_str()), (0, "", ""), "{number}");
        };
        [16, 3, 1].into_iter().for_each(|number| compute(number, true));
        let missing = run(folder.path(), "collect out");
        assert_eq!((missing.code, missing.out.as_str()), (1, "2,4-15\n"), "{}", missing.err);
        assert!(missing.err.contains("13 chunks are missing or cannot be used: 2,4-15\n  hint: "), "{}", missing.err);
        assert!(!folder.path().join("out/results.csv").exists());
        [2].into_iter().chain(4..=15).for_each(|number| compute(number, false));
        let _ = fs::remove_dir(folder.path().join("out/slurm-logs"));
        succeeds(folder.path(), "collect out");
        assert_same(&folder.path().join("out"), &wanted, "chunks");
        // again, and with a flag that is stronger than the array
        assert!(succeeds(folder.path(), "collect out").out.starts_with("out/results.csv\nout/rows.csv\n"));
        assert_same(&folder.path().join("out"), &wanted, "collected twice");
        assert_eq!(run(folder.path(), &chunk(2)).code, 0);
    }
}

#[test]
fn a_job_script_begins_the_folder_with_its_chunks() {
    let folder = folder(SWEEP);
    assert!(succeeds(folder.path(), "sweep sweep.toml --out out --job-script 5").out.contains("--array=1-5\n"));
    let missing = run(folder.path(), "collect out");
    assert_eq!((missing.code, missing.out.as_str()), (1, "1-5\n"), "{}", missing.err);
    let other = run(folder.path(), "sweep sweep.toml --out out --job-script 8");
    assert!(other.code == 2 && other.err.contains("out has 5 chunks, not 8"), "{}", other.err);
    fs::write(folder.path().join("sweep.toml"), SWEEP.replace("until = 3", "until = 4")).unwrap();
    let other = run(folder.path(), "sweep sweep.toml --out out --job-script 5");
    assert!(other.code == 2 && other.err.contains("is of another sweep"), "{}", other.err);
    assert!(succeeds(folder.path(), "sweep sweep.toml --out out --job-script 4 --force").out.contains("-4\n"));
}

#[test]
fn arrays_that_have_no_chunk_are_refused() {
    let new = folder(SWEEP);
    for (number, count, ends, part) in [
        (3, 2, (3, 7), "the tasks of this array are not numbered 1, 2, …"),
        (0, 4, (0, 3), "the tasks of this array are not numbered 1, 2, …"),
        (61, 61, (1, 61), "60 runs cannot be divided into 61 chunks"),
    ] {
        let result = task(new.path(), number, count, ends);
        assert!(result.code == 2 && result.err.contains(part), "{}", result.err);
        assert!(!new.path().join("out").exists());
    }
    succeeds(new.path(), &chunk(1));
    let result = task(new.path(), 17, 1, (17, 17));
    assert!(result.code == 2 && result.err.contains("is 17, and the chunks are 1 to 16"), "{}", result.err);
}

#[test]
fn another_number_of_chunks_is_another_folder() {
    let folder = folder(SWEEP);
    succeeds(folder.path(), &chunk(1));
    let result = run(folder.path(), "sweep sweep.toml --out out --chunk 1/8");
    assert_eq!(result.code, 2);
    assert!(
        result.err.contains("out has 16 chunks, not 8\n  hint: give it 16 chunks, or another folder"),
        "{}",
        result.err
    );
    // a sweep on one machine goes on with those that are there
    assert_eq!(run(folder.path(), "sweep sweep.toml --out out").code, 0);
    assert_eq!(fs::read_dir(folder.path().join("out/chunks")).unwrap().count(), 16);
}
