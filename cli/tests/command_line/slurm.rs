//! `shadowstep sweep --submit` and `--status`, with programs in place of those of Slurm. `make test-cluster` uses a
//! real cluster.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use tempfile::TempDir;

use crate::program::Finished;

const SWEEP: &str = r#"
problem.name = "pendulum"
run = { scheme = "yoshida4", step = "h", until = 1, digits = "double" }
axes.h = "1/10 … 1/100 in 9 steps of 1/h"
keep.values = ["energy_error"]
"#;

/// Prints the next number and notes how it was called.
const SBATCH: &str = r#"
echo "$*" >> "$SITE/calls"
wc -l < "$SITE/calls"
"#;

/// A folder with a sweep, and a folder of programs that are the PATH.
struct Site {
    folder: TempDir,
}

impl Site {
    fn new(programs: &[(&str, &str)]) -> Self {
        let site = Site { folder: TempDir::new().unwrap() };
        fs::create_dir(site.path("bin")).unwrap();
        fs::write(site.path("sweep.toml"), SWEEP).unwrap();
        programs.iter().for_each(|(name, text)| site.program(name, text));
        site
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    fn program(&self, name: &str, text: &str) {
        let path = self.path("bin").join(name);
        fs::write(&path, format!("#!/bin/sh\nPATH=/usr/bin:/bin\n{text}")).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    }

    /// `shadowstep sweep sweep.toml --out DIR` with some flags.
    fn sweep(&self, flags: &str) -> Finished {
        let mut command = Command::cargo_bin("shadowstep").unwrap();
        command.args(["sweep", "sweep.toml", "--out", "out"]).args(flags.split_whitespace());
        command.current_dir(self.folder.path()).env("PATH", self.path("bin")).env("SITE", self.folder.path());
        let output = command.output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Finished { code: output.status.code().unwrap(), out: text(output.stdout), err: text(output.stderr) }
    }

    fn has(&self, name: &str) -> bool {
        self.path(name).exists()
    }
}

/// The job scripts of another sweep are replaced with it.
#[test]
fn the_scripts_of_another_sweep_are_replaced_only_by_force() {
    let site = Site::new(&[]);
    assert_eq!(site.sweep("--submit --dry-run --chunks 5").code, 0);
    fs::write(site.path("sweep.toml"), SWEEP.replace("until = 1", "until = 2")).unwrap();
    let refused = site.sweep("--submit --dry-run --chunks 4");
    assert!(refused.code == 2 && refused.err.contains("is of another sweep"), "{}", refused.err);
    assert!(site.read("out/array.sbatch").contains("--array=1-5\n"));
    assert_eq!(site.sweep("--submit --dry-run --chunks 4 --force").code, 0);
    assert!(site.read("out/array.sbatch").contains("--array=1-4\n"));
}

#[test]
fn chunks_are_submitted_and_then_those_that_are_missing() {
    let site = Site::new(&[("sbatch", SBATCH), ("squeue", "cat $SITE/queue")]);
    let submitted = site.sweep("--submit --chunks 5 --time 30 --partition short");
    assert_eq!((submitted.code, submitted.err.as_str()), (0, ""));
    assert!(
        submitted.out.ends_with("submitted: job 1, an array of 5 tasks, 1-5; job 2 collects after it\n"),
        "{}",
        submitted.out
    );
    assert!(
        submitted.out.contains("\n#SBATCH --time=30\n") && submitted.out.contains("\n#SBATCH --array=1-5\n"),
        "{}",
        submitted.out
    );
    let out = fs::canonicalize(site.path("out")).unwrap();
    let script = |name: &str| Path::new(&out).join(name).display().to_string();
    let first = format!(
        "--parsable {}\n--parsable --dependency=afterany:1 {}\n",
        script("array.sbatch"),
        script("collect.sbatch")
    );
    assert_eq!(site.read("calls"), first);

    for chunk in [2, 3] {
        assert_eq!(site.sweep(&format!("--chunk {chunk}/5")).code, 0);
    }
    fs::write(
        site.path("queue"),
        "1|1|RUNNING|None\n1|2|COMPLETED|None\n1|3|COMPLETED|None\n1|4|TIMEOUT|TimeLimit\n1|5|CANCELLED|None\n2|N/A|PENDING|Dependency\n",
    )
    .unwrap();
    let submitted = site.sweep("--submit");
    assert_eq!((submitted.code, submitted.err.as_str()), (0, ""));
    assert!(
        submitted.out.ends_with("submitted: job 3, an array of 2 tasks, 4-5; job 4 collects after it\n"),
        "{}",
        submitted.out
    );
    let second = format!(
        "--parsable --array=4-5 {}\n--parsable --dependency=afterany:1:3 {}\n",
        script("array.sbatch"),
        script("collect.sbatch")
    );
    assert_eq!(site.read("calls"), first + &second);
}

#[test]
fn the_status_has_tasks_chunks_and_the_next_command() {
    let site = Site::new(&[("sbatch", SBATCH), ("squeue", "cat $SITE/queue"), ("sacct", "echo '1_4|OUT_OF_MEMORY'")]);
    assert_eq!(site.sweep("--submit --chunks 5").code, 0);
    fs::write(site.path("queue"), "1|1|RUNNING|None\n1|5|PENDING|Priority\n1|3|COMPLETED|None\n").unwrap();
    for chunk in [2, 3] {
        assert_eq!(site.sweep(&format!("--chunk {chunk}/5")).code, 0);
    }
    let status = site.sweep("--status");
    assert_eq!(
        status.out,
        "tasks:   1 pending (Priority), 1 running, 1 done, 1 failed, 1 no longer listed by Slurm\n\
         failed:  4 (OUT_OF_MEMORY)\n\
         chunks:  2 of 5 are complete, missing: 1,4-5\n\
         next:    submit the missing chunks: shadowstep sweep sweep.toml --out out --submit\n"
    );
    assert_eq!((status.code, status.err.as_str()), (1, ""));
    assert_eq!(site.sweep("--chunk 4/5").code, 0);
    let status = site.sweep("--status");
    assert!(status.out.ends_with("next:    wait for the tasks 1,5\n"), "{}", status.out);
    assert_eq!(status.code, 0);
}

#[test]
fn without_slurm_the_line_of_gnu_parallel_is_given() {
    let site = Site::new(&[]);
    let refused = site.sweep("--submit --chunks 5");
    assert_eq!((refused.code, refused.out.as_str()), (2, ""));
    assert!(refused.err.starts_with("error: sbatch is not found: "), "{}", refused.err);
    let line = refused.err.split("GNU parallel computes the chunks: ").nth(1).unwrap();
    assert!(line.starts_with("seq 5 | RAYON_NUM_THREADS=1 parallel --joblog "), "{line}");
    assert!(line.ends_with(" --chunk {}/5\n"), "{line}");
    assert!(!site.has("out"));
}

#[test]
fn scripts_are_shown_without_submitting_and_kept_when_edited() {
    let site = Site::new(&[("sbatch", SBATCH)]);
    let shown = site.sweep("--submit --dry-run --time 30");
    assert_eq!((shown.code, shown.err.as_str()), (0, ""));
    let array = site.read("out/array.sbatch");
    assert!(shown.out.contains(&array) && shown.out.contains(&site.read("out/collect.sbatch")) && !site.has("calls"));
    let edited = array.replace("--array=1-10", "--array=1-10%3");
    assert_ne!(edited, array);
    fs::write(site.path("out/array.sbatch"), &edited).unwrap();
    let refused = site.sweep("--submit --time 40");
    assert!(refused.code == 2 && refused.err.contains("has --time=30, and --time 40 was given"), "{}", refused.err);
    assert_eq!(site.sweep("--chunk 3/10").code, 0);
    assert_eq!(site.sweep("--submit").code, 0);
    assert_eq!(site.read("out/array.sbatch"), edited);
    assert!(site.read("calls").starts_with("--parsable --array=1-2,4-10%3 "), "{}", site.read("calls"));
}

#[test]
fn a_refused_submission_leaves_nothing() {
    let refuses = "echo 'sbatch: error: invalid partition specified: shrot' >&2; exit 1";
    for (sbatch, flags) in [(refuses, "--partition shrot"), (SBATCH, "--time '"), (SBATCH, "--chunks 11")] {
        let site = Site::new(&[("sbatch", sbatch)]);
        assert_ne!(site.sweep(&format!("--submit {flags}")).code, 0, "{flags}");
        assert!(!site.has("out"), "{flags}");
        // what was there before stays
        assert_eq!(site.sweep("--chunk 3/10").code, 0);
        fs::write(site.path("out/notes.txt"), "mine").unwrap();
        assert_ne!(site.sweep(&format!("--submit {flags}")).code, 0, "{flags}");
        let mut names: Vec<_> =
            fs::read_dir(site.path("out")).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        assert_eq!(names, ["chunks", "notes.txt", "plan.json"], "{flags}");
        assert!(site.has("out/chunks/00003-of-00010"));
    }
    // an array that was submitted needs its script, whatever became of the job that collects
    let once = "[ -e $SITE/called ] && exit 1; touch $SITE/called; echo 1";
    let site = Site::new(&[("sbatch", once)]);
    assert_eq!(site.sweep("--submit").code, 3);
    assert!(site.has("out/array.sbatch") && site.has("out/slurm-jobs.jsonl") && site.has("out/plan.json"));
}

#[test]
fn what_slurm_refuses_leaves_no_script() {
    let site = Site::new(&[("sbatch", "echo 'sbatch: error: invalid partition specified: shrot' >&2; exit 1")]);
    let refused = site.sweep("--submit --partition shrot");
    assert_eq!(refused.code, 3);
    assert!(refused.err.starts_with("error: sbatch: error: invalid partition specified: shrot\n"), "{}", refused.err);
    assert!(!site.has("out/array.sbatch") && !site.has("out/collect.sbatch") && !site.has("out/slurm-jobs.jsonl"));
}

#[test]
fn a_cluster_that_cannot_be_reached_gets_nothing_twice() {
    let site = Site::new(&[
        ("sbatch", SBATCH),
        ("squeue", "echo 'slurm_load_jobs error: Unable to contact slurm controller' >&2; exit 1"),
    ]);
    assert_eq!(site.sweep("--submit --chunks 5").code, 0);
    let calls = site.read("calls");
    for flag in ["--submit", "--status"] {
        let refused = site.sweep(flag);
        assert!(refused.code == 3 && refused.err.contains("Unable to contact slurm controller"), "{}", refused.err);
    }
    assert_eq!(site.read("calls"), calls);
}

#[test]
fn a_complete_sweep_is_not_submitted() {
    let site = Site::new(&[("sbatch", SBATCH)]);
    assert_eq!(site.sweep("").code, 0);
    let done = site.sweep("--submit");
    assert_eq!(
        (done.code, done.err.as_str()),
        (0, "note: all chunks are complete: collect them with `shadowstep collect out`\n")
    );
    assert!(!site.has("calls"));
    let status = site.sweep("--status");
    assert!(
        status.code == 0
            && status.out.ends_with("next:    nothing: all chunks are complete and the results are written\n")
    );
}
