//! The rows: systems, each of which can be run in several ways, as scenes with the text between them and with faults.

use std::path::Path;
use std::{env, fs};

/// A file of a folder: lines `# key: value`, and a part of a scene.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub(crate) name: String,
    /// `kind: what it is`
    pub(crate) title: String,
    keys: Vec<(String, String)>,
    pub(crate) text: String,
}

impl Row {
    pub(crate) fn key(&self, name: &str) -> Option<&str> {
        self.keys.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    /// The same with a fault: `# wrong: text => what is wrong`.
    pub(crate) fn faulty(&self) -> Row {
        let (right, wrong) = self.key("wrong").and_then(|key| key.split_once(" => ")).expect("each row has a fault");
        let text = self.text.replacen(right, wrong, 1);
        assert_ne!(text, self.text, "{}: the fault is not in the text", self.name);
        Row { text, ..self.clone() }
    }
}

/// All rows of a folder, in the order of their titles.
pub(crate) fn rows(folder: &str) -> Vec<Row> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/crosses").join(folder);
    let mut rows: Vec<Row> = fs::read_dir(folder).unwrap().map(|entry| row(&entry.unwrap().path())).collect();
    rows.sort_by(|a, b| a.title.cmp(&b.title));
    rows
}

fn row(path: &Path) -> Row {
    let whole = fs::read_to_string(path).unwrap();
    let (comments, lines): (Vec<_>, Vec<_>) = whole.lines().partition(|line| line.starts_with('#'));
    let mut comments = comments.iter().map(|line| line.trim_start_matches("# ").to_owned());
    let title = comments.next().expect("the first line is the title");
    let key = |line: String| line.split_once(": ").map(|(key, value)| (key.to_owned(), value.to_owned())).unwrap();
    let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
    Row { name, title, keys: comments.map(key).collect(), text: lines.join("\n") + "\n" }
}

/// A system that is run in some way.
#[derive(Clone, Debug)]
pub(crate) struct Scene {
    pub(crate) system: Row,
    pub(crate) run: Row,
}

impl Scene {
    /// The step size; a sweep has the name h in its place.
    pub(crate) fn step(&self) -> &str {
        self.system.key("step").expect("each system has a step")
    }

    pub(crate) fn is_ensemble(&self) -> bool {
        self.system.key("varied").is_none()
    }

    /// The whole scene with a step size, and more lines of [output], which is its last section.
    pub(crate) fn text(&self, step: &str, output: &str) -> String {
        let run = self.run.text.replace("\"h\"", &format!("\"{step}\"")).replace("-h", &format!("-{step}"));
        let run = run.replace("*h", &format!("*{step}"));
        // rows of an ensemble have the states at the end
        let run = if self.is_ensemble() { run.replace("trajectory = { every = 2 }\n", "") } else { run };
        format!("{}{run}{output}", self.system.text)
    }

    /// The same, with a name in place of a number of the system, and the two values of the name.
    pub(crate) fn varied(&self) -> (Scene, [&str; 2]) {
        let (a, b) = self.system.key("varied").and_then(|key| key.split_once(", ")).expect("it is no ensemble");
        let text = self.system.text.replacen(&format!("\"{a}\""), "\"x0\"", 1);
        assert!(text != self.system.text, "{}: {a} is not in the text", self.system.name);
        (Scene { system: Row { text, ..self.system.clone() }, run: self.run.clone() }, [a, b])
    }

    /// The same with the second value.
    pub(crate) fn with_other_value(&self) -> Scene {
        let (mut scene, [_, other]) = self.varied();
        scene.system.text = scene.system.text.replace("\"x0\"", &format!("\"{other}\""));
        scene
    }
}
