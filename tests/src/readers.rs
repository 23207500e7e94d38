//! The readers of files and formulas on any bytes: `make fuzz` searches for inputs on which they panic, hang or need
//! too much memory, and `tests/tests/corpus.rs` replays those in `evidence/fuzz/corpus`.

use std::collections::BTreeMap;
use std::fs;
use std::hint::black_box;
use std::path::PathBuf;
use std::sync::LazyLock;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use shadowstep::systems::formula::FormulaPotential;
use shadowstep::tables::Source;
use shadowstep_analysis::sources::{Language, check};
use shadowstep_scenes::{FileOptions, Observer, Outcome, Scene};
use shadowstep_schemes::symbolic::{Budget, Exact, evaluate_within, exact, parse};
use shadowstep_studies::sweeps::SweepPlan;
use tempfile::TempDir;

/// A reader: what it reads, which is the name of its folder in `evidence/fuzz/corpus`, and how.
pub type Reader = (&'static str, fn(&[u8]));

/// All readers.
pub const READERS: [Reader; 6] = [
    ("table", table),
    ("expression", expression),
    ("scene", scene),
    ("sweep", sweep),
    ("checkpoint", checkpoint),
    ("code", code),
];

fn source(bytes: &[u8]) -> Option<Source> {
    let text = String::from_utf8(bytes.to_vec()).ok()?;
    Some(Source { path: "fuzz.toml".to_owned(), text })
}

/// Proves the claims of a table, and words what it finds.
pub fn table(bytes: &[u8]) {
    let Some(source) = source(bytes) else { return };
    match shadowstep_schemes::read(&source, &|base, _| shadowstep_schemes::shipped(base)) {
        Ok(proved) => black_box(format!("{:?}", proved.notes)),
        Err(faults) => black_box(faults.to_string()),
    };
}

/// Computes a formula in two numbers, and makes a potential of it.
pub fn expression(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let number = |value: &str, rounded| Exact { value: exact(value).expect("a number"), rounded };
    let names = BTreeMap::from([("x".to_owned(), number("-7/24", false)), ("k".to_owned(), number("1.414", true))]);
    match parse(text) {
        Ok(expression) => match evaluate_within(&expression, &names, 50, &Budget::default()) {
            Ok(value) => black_box(value.value.to_string()),
            Err(error) => black_box(error.to_string()),
        },
        Err(error) => black_box(error.to_string()),
    };
    if let Err(error) = FormulaPotential::<f64>::new(text, &["x", "y"], &[("k", 1.5)]) {
        black_box((error.range(), error.to_string()));
    }
}

/// Finds the schemes in source code, whatever its language is.
pub fn code(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    for language in Language::ALL {
        black_box(check(text, language).verdicts);
    }
}

/// Reads a scene, and words its faults.
pub fn scene(bytes: &[u8]) {
    let Some(source) = source(bytes) else { return };
    match Scene::read(source) {
        Ok(scene) => black_box(scene.metadata().to_string()),
        Err(faults) => black_box(faults.to_string()),
    };
}

/// Reads a sweep, and words its faults, or some of its runs.
pub fn sweep(bytes: &[u8]) {
    let Some(source) = source(bytes) else { return };
    match SweepPlan::of(&source) {
        Ok(plan) => {
            let last = plan.axes().runs() - 1;
            for run in [0, last / 3, last] {
                black_box(plan.axes().described(run));
                black_box(plan.scene(run).err().map(|faults| faults.to_string()));
            }
            black_box((plan.picture(), plan.digests()));
        }
        Err(error) => drop(black_box(error.to_string())),
    };
}

// ---- checkpoints ----

/// A stopped run with its files.
struct Stopped {
    folder: TempDir,
    scene: Scene,
    /// The rows so far.
    partial: Vec<u8>,
    /// The checkpoint's text.
    text: String,
    /// What the checkpoint has of the scene, as compact JSON.
    identity: String,
}

/// The parts of a checkpoint that a change can get past its hash.
#[derive(Serialize, Deserialize)]
struct Content {
    n: i64,
    bytes: u64,
    state: Option<State>,
}

/// The state of a checkpoint, with its fields in their order.
#[derive(Serialize, Deserialize)]
struct State {
    n: i64,
    q: Vec<String>,
    p: Vec<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    q_remainders: Vec<String>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    p_remainders: Vec<String>,
}

struct StopAt(i64);

impl Observer for StopAt {
    fn progress(&mut self, n: i64) {
        self.0 -= i64::from(n > 0);
    }

    fn stops(&mut self) -> bool {
        self.0 == 0
    }
}

impl Stopped {
    fn new() -> Stopped {
        let folder = tempfile::tempdir().expect("a folder for temporary files");
        let path = folder.path().join("scene.toml");
        let text = "problem.name = \"kepler\"\n\
                    run = { scheme = \"ruth3\", step = \"1/20\", steps = 12, digits = \"double\" }\n\
                    output = { energy = true, trajectory = true, file = \"out.csv\", checkpoint = 4 }\n";
        let source = Source { path: path.display().to_string(), text: text.to_owned() };
        let scene = Scene::read(source).expect("a valid scene");
        let outcome = scene.run_to_file(FileOptions::default(), &mut StopAt(5)).expect("a run that can be stopped");
        assert_eq!(outcome, Outcome::Stopped { n: 5 });
        let read = |name: &str| fs::read(folder.path().join(name)).expect("a file of the stopped run");
        let (partial, text) = (read("out.csv.partial"), String::from_utf8(read("out.csv.checkpoint")).expect("JSON"));
        let (_, rest) = text.split_once("\"identity\": ").expect("an identity");
        let (identity, _) = rest.split_once(",\n    \"n\"").expect("an n after it");
        let identity: String = identity.lines().map(|line| line.trim().replacen("\": ", "\":", 1)).collect();
        Stopped { folder, scene, partial, text, identity }
    }

    fn path(&self, extension: &str) -> PathBuf {
        self.folder.path().join(format!("out.csv{extension}"))
    }

    /// The text of a checkpoint with a hash that fits.
    fn sealed(&self, content: &Content) -> String {
        let length = usize::try_from(content.bytes).unwrap_or(usize::MAX).min(self.partial.len());
        let rows = hexadecimal(&self.partial[..length]);
        let state = serde_json::to_string(&content.state).expect("texts and numbers are JSON");
        let Content { n, bytes, .. } = content;
        let checkpoint = format!(
            "{{\"identity\":{},\"n\":{n},\"is_last\":false,\"bytes\":{bytes},\"head\":0,\"hashed_from\":0,\
             \"sha256\":\"{rows}\",\"state\":{state}}}",
            self.identity
        );
        let seal = hexadecimal(checkpoint.as_bytes());
        format!("{{\n  \"checkpoint\": {checkpoint},\n  \"sha256\": \"{seal}\"\n}}\n")
    }

    /// Resumes the run from a checkpoint of this text.
    fn resume(&self, text: &[u8]) -> Result<Outcome, shadowstep_scenes::Error> {
        let _ = fs::remove_file(self.path(""));
        fs::write(self.path(".partial"), &self.partial).expect("the folder can be written");
        fs::write(self.path(".checkpoint"), text).expect("the folder can be written");
        self.scene.run_to_file(FileOptions::default(), &mut ())
    }
}

fn hexadecimal(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

static STOPPED: LazyLock<Stopped> = LazyLock::new(|| {
    let stopped = Stopped::new();
    // otherwise only refusals would be tried
    let whole: serde_json::Value = serde_json::from_str(&stopped.text).expect("JSON");
    let content = serde_json::from_value(whole["checkpoint"].clone()).expect("n, bytes and a state");
    for text in [stopped.text.clone(), stopped.sealed(&content)] {
        let outcome = stopped.resume(text.as_bytes()).expect("a valid checkpoint");
        assert!(matches!(outcome, Outcome::Complete { .. }), "{outcome:?}");
    }
    stopped
});

/// Resumes a run from a checkpoint: of these bytes, or where they are the content of one, of that with a hash that
/// fits.
pub fn checkpoint(bytes: &[u8]) {
    let text = match serde_json::from_slice(bytes) {
        Ok(content) => STOPPED.sealed(&content).into_bytes(),
        Err(_) => bytes.to_vec(),
    };
    if let Err(error) = STOPPED.resume(&text) {
        black_box(error.to_string());
    }
}
