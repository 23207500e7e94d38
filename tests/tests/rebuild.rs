//! Protects what a user does with a table of their own: editing it rebuilds the crate that names it, a wrong edit is a
//! compile error with the table's place, a name that is not there is answered with the nearest one.
//!
//! A small crate outside this workspace, with the library as a path dependency and without its features, so that no C
//! is compiled. The library has no warnings then, either.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::{env, fs};

struct Project {
    folder: tempfile::TempDir,
    target: PathBuf,
}

impl Project {
    fn new(table: &str) -> Project {
        let own = Path::new(env!("CARGO_MANIFEST_DIR"));
        let folder = tempfile::tempdir().expect("a temporary folder");
        // the dependencies are built once and kept beside the other build products of the tests
        let project = Project { folder, target: Path::new(env!("CARGO_TARGET_TMPDIR")).join("rebuild") };
        let manifest = format!(
            "[package]\nname = \"user\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n[workspace]\n\n[dependencies]\n\
             shadowstep = {{ path = {:?}, default-features = false }}\n",
            own.join("../runtime")
        );
        project.write("Cargo.toml", &manifest);
        // the same versions as here, so that nothing has to be fetched
        fs::copy(own.join("../Cargo.lock"), project.path("Cargo.lock")).expect("the workspace has a lock file");
        fs::create_dir(project.path("src")).expect("a folder");
        project.name_table("table.toml");
        project.write("src/table.toml", table);
        project
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).expect("the folder can be written");
    }

    /// The program prints the state after a step of size 1/2 and what is known of the scheme.
    fn name_table(&self, table: &str) {
        let program = format!(
            "use shadowstep::{{problems::Pendulum, Motion, Scheme, Stepper, UnitMasses}};\n\n\
             #[shadowstep::splitting_scheme({table:?})]\npub struct Mine;\n\n\
             fn main() {{\n    \
                 let mut motion = Motion::new(Pendulum, UnitMasses, [0.0], [1.0]).unwrap();\n    \
                 Stepper::new(Mine, \"1/2\").unwrap().step(&mut motion);\n    \
                 println!(\"{{}} {{}} {{}}\", Mine.summary().name, Mine.summary().order, motion.q()[0]);\n}}\n"
        );
        self.write("src/main.rs", &program);
    }

    fn run(&self) -> Output {
        Command::new(env!("CARGO"))
            .args(["run", "--quiet", "--offline"])
            .current_dir(self.folder.path())
            .env("CARGO_TARGET_DIR", &self.target)
            .env("RUSTFLAGS", "-D warnings")
            .output()
            .expect("cargo runs")
    }

    #[track_caller]
    fn prints(&self, expected: &str) {
        let Output { status, stdout, stderr } = self.run();
        assert!(status.success(), "{}", String::from_utf8_lossy(&stderr));
        assert_eq!(String::from_utf8_lossy(&stdout).trim(), expected);
    }

    #[track_caller]
    fn fails(&self, with: &[&str]) {
        let Output { status, stderr, .. } = self.run();
        let message = String::from_utf8_lossy(&stderr);
        assert!(!status.success(), "it must not compile");
        for part in with {
            assert!(message.contains(part), "{part:?} is not in:\n{message}");
        }
        assert_eq!(message.matches("\nerror: ").count() + usize::from(message.starts_with("error: ")), 2, "{message}");
    }
}

const EULER: &str = "name = \"euler\"\norder = 1\nkinetic = \"any\"\nreference = \"none\"\n\n\
                     [stages]\nkick = [1]\ndrift = [1]\n";

#[test]
fn an_edited_table_rebuilds_its_user() {
    let project = Project::new(EULER);
    project.prints("euler 1 0.5");
    project.prints("euler 1 0.5");

    // the drift in two halves with the kick between them: ½·1 + ½·(1 − ½ sin ¼)
    let verlet = EULER
        .replace("euler", "verlet")
        .replace("order = 1", "order = 2")
        .replace("kick = [1]\ndrift = [1]", "kick = [0, 1]\ndrift = [\"1/2\", \"1/2\"]");
    project.write("src/table.toml", &verlet);
    project.prints(&format!("verlet 2 {}", 0.25 + 0.25 * (1.0 - 0.5 * 0.25_f64.sin())));

    // a wrong claim, with its place; then right again, with the same program
    project.write("src/table.toml", &verlet.replace("order = 2", "order = 3"));
    project.fails(&[
        "table.toml:2:9: order 3 is claimed, order 2 holds for every T(p)",
        "2 | order = 3",
        "src/main.rs:3:32",
    ]);
    project.write("src/table.toml", EULER);
    project.prints("euler 1 0.5");

    // a composition, whose base is edited
    let twice = "name = \"twice\"\norder = 1\nkinetic = \"any\"\nreference = \"none\"\n\n\
                 [composition]\nbase = \"base\"\ngamma = [\"1/2\", \"1/2\"]\n";
    project.write("src/base.toml", EULER);
    project.write("src/table.toml", twice);
    project.prints(&format!("twice 1 {}", 0.25 + 0.25 * (1.0 - 0.25 * 0.25_f64.sin())));
    project.write("src/base.toml", &EULER.replace("kick = [1]", "kick = [\"2/1 - 1 - 1/0\"]"));
    project.fails(&["base.toml:7:22: division by zero"]);

    // a name close to a shipped table's, one close to a file beside, and one like nothing
    project.name_table("yoshda4.toml");
    let beside = fs::canonicalize(project.path("src")).expect("it exists").display().to_string();
    project.fails(&["there is no table \"yoshda4.toml\"; looked", &beside, "did you mean \"yoshida4.toml\"?"]);
    project.name_table("tabel.toml");
    project.fails(&["did you mean \"table.toml\"?"]);
    project.name_table("quadrature.toml");
    project.fails(&["no shipped table has a name like that"]);
}
