//! A folder of someone else has links of the names that commands write: no file outside of it changes, and nothing is
//! written through a link.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::program::{Finished, shadowstep};

const SCENE: &str = "[problem]\nname = \"kepler\"\n[run]\nscheme = \"yoshida4\"\nstep = \"1/20\"\nsteps = 20\ndigits \
    = \"double\"\n\
                     [output]\nenergy = true\n";

const SWEEP: &str = "[problem]\nname = \"kepler\"\nparameters.eccentricity = \"e\"\n[run]\nscheme \
    = \"yoshida4\"\nstep = \"1/20\"\n\
                     steps = 20\ndigits = \"double\"\n[output]\nenergy = true\n[axes]\ne = [0.1, 0.2]\n[keep]\nvalues \
                     = [\"energy_error\"]\n";

const PRECIOUS: &str = "export PRECIOUS=1\n";

/// A precious file, a folder of someone else beside it, and its name there.
struct Untrusted {
    folder: TempDir,
}

impl Untrusted {
    fn new() -> Untrusted {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("bashrc"), PRECIOUS).unwrap();
        for name in ["a", "other"] {
            fs::create_dir(folder.path().join(name)).unwrap();
        }
        let untrusted = Untrusted { folder };
        let scene = format!("{SCENE}file = \"out.csv\"\nplot = \"out.svg\"\n");
        fs::write(untrusted.path("scene.toml"), scene).unwrap();
        fs::write(untrusted.path("resumed.toml"), format!("{SCENE}file = \"out.csv\"\ncheckpoint = 5\n")).unwrap();
        fs::write(untrusted.path("lines.toml"), format!("{SCENE}file = \"out.jsonl\"\n")).unwrap();
        fs::write(untrusted.path("sweep.toml"), SWEEP).unwrap();
        untrusted
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join("a").join(name)
    }

    /// Gives a command, in which `@` stands for the folder.
    fn run(&self, words: &str) -> Finished {
        shadowstep(&words.replace('@', &self.path("").display().to_string()))
    }

    /// The files outside of the folder, and those in it that are links, are as they were.
    fn check(&self, when: &str) {
        let outside = |path: &Path| fs::read_to_string(self.folder.path().join(path)).unwrap();
        assert_eq!(outside(Path::new("bashrc")), PRECIOUS, "{when}");
        let others = ["", "other"].map(|name| fs::read_dir(self.folder.path().join(name)).unwrap().count());
        assert_eq!(others, [3, 0], "{when}");
    }
}

const TRACE: &str = "trace kepler --scheme yoshida4 --step 1/20 --until 1 --double --order 2 --csv --no-summary";

/// Commands, the name of a link that they meet, and the exit code, 2 or more; 0 where they have no use of the name, or
/// replace the link itself.
fn commands() -> Vec<(String, &'static str, i32)> {
    let mut all = Vec::new();
    let mut add = |words: &str, links: &[(&'static str, i32)]| {
        all.extend(links.iter().map(|(link, code)| (words.to_owned(), *link, *code)));
    };
    for force in ["", " --force"] {
        add(
            &format!("run @scene.toml{force}"),
            &[
                ("out.csv.shadowstep-partial", 0),
                ("out.svg.shadowstep-partial", 0),
                ("out.csv.partial", 2),
                ("out.csv", 2),
                ("out.svg", 2),
            ],
        );
        add(&format!("run @resumed.toml{force}"), &[("out.csv.partial", 2), ("out.csv.checkpoint.new", 2)]);
        add(&format!("run @lines.toml{force}"), &[("out.jsonl.metadata.json", 2), ("out.jsonl.partial", 2)]);
        add(&format!("{TRACE} --output @t.csv{force}"), &[("t.csv.shadowstep-partial", 0), ("t.csv", 2)]);
        add(&format!("{TRACE} --plot @t.svg{force}"), &[("t.svg.shadowstep-partial", 0), ("t.svg", 2)]);
    }
    add("collect @o", &[("o/results.csv.shadowstep-partial", 0), ("o/results.csv", 2), ("o/picture.svg", 2)]);
    add("sweep @sweep.toml --out @n", &[("n/plan.json", 2), ("n/results.csv", 2), ("n/chunks", 2)]);
    add("figures scattering --quick --out @f", &[("f/results.jsonl", 2)]);
    add("man --out @m", &[("m/shadowstep.1", 2), ("m/shadowstep-drift.1", 2)]);
    all
}

/// A link that leads out of the folder: to a file that is there, to one that is not, or to a folder.
#[test]
fn links_out_of_the_folder_are_not_followed() {
    for (words, name, code) in commands() {
        for target in ["bashrc", "other/new", "other"] {
            let untrusted = Untrusted::new();
            if name.starts_with("o/") {
                assert_eq!(untrusted.run("sweep @sweep.toml --out @o").code, 0);
            }
            let link = untrusted.path(name);
            fs::create_dir_all(link.parent().unwrap()).unwrap();
            let _ = fs::remove_file(&link);
            symlink(untrusted.folder.path().join(target), &link).unwrap();
            let result = untrusted.run(&words);
            let when = format!("{words}, {name} -> {target}: {}", result.err);
            untrusted.check(&when);
            assert_eq!(result.code == 0, code == 0, "{when}");
            assert!(link.is_symlink(), "{when}");
            assert!(code == 0 || result.err.contains("hint: "), "{when}");
        }
    }
}

/// A file that is appended to, or resumed, has no other name.
#[test]
fn files_with_other_names_are_not_opened() {
    for (words, name) in [
        ("run @scene.toml --force", "out.csv.partial"),
        ("run @resumed.toml", "out.csv.partial"),
        ("figures scattering --quick --out @f", "f/results.jsonl"),
    ] {
        let untrusted = Untrusted::new();
        let link = untrusted.path(name);
        fs::create_dir_all(link.parent().unwrap()).unwrap();
        fs::hard_link(untrusted.folder.path().join("bashrc"), &link).unwrap();
        let result = untrusted.run(words);
        untrusted.check(words);
        assert!(result.code == 2 && result.err.contains("by a hard link"), "{words}: {}", result.err);
    }
    // one that is replaced gets a new file, and its other name keeps the old one
    let untrusted = Untrusted::new();
    fs::hard_link(untrusted.folder.path().join("bashrc"), untrusted.path("t.csv")).unwrap();
    assert_eq!(untrusted.run(&format!("{TRACE} --output @t.csv --force")).code, 0);
    untrusted.check("--force");
}

/// A file of someone else that has the name temporary files once had stays as it is.
#[test]
fn a_file_with_the_name_of_a_temporary_one_stays() {
    for words in [format!("{TRACE} --output @out.csv"), "run @scene.toml".to_owned()] {
        let untrusted = Untrusted::new();
        let foreign = ["out.csv.shadowstep-partial", "out.svg.shadowstep-partial", "out.csv.0123.shadowstep-partial"];
        foreign.iter().for_each(|name| fs::write(untrusted.path(name), "notes").unwrap());
        assert_eq!(untrusted.run(&words).code, 0, "{words}");
        assert!(foreign.iter().all(|name| fs::read_to_string(untrusted.path(name)).unwrap() == "notes"), "{words}");
    }
}

/// To open one would wait for its other end.
#[test]
fn pipes_in_place_of_chunks_are_not_opened() {
    let untrusted = Untrusted::new();
    assert_eq!(untrusted.run("sweep @sweep.toml --out @o").code, 0);
    for (name, code) in [("o/chunks/00001-of-00002", 1), ("o/chunks/00002-of-00002.partial-x", 0)] {
        let _ = fs::remove_file(untrusted.path(name));
        assert!(std::process::Command::new("mkfifo").arg(untrusted.path(name)).status().unwrap().success());
        let (collected, again) = (untrusted.run("collect @o"), untrusted.run("sweep @sweep.toml --out @o"));
        assert_eq!((collected.code, again.code), (code, 0), "{name}: {}{}", collected.err, again.err);
    }
}
