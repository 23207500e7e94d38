//! Checkpoints that are cut or changed: they are refused, or do no harm.

use std::fs;
use std::path::{Path, PathBuf};

use shadowstep_scenes::{FileOptions, Observer, Outcome, Scene};
use tempfile::TempDir;

const SCENE: &str = r#"
[problem]
name = "pendulum"
[run]
scheme = "ruth3"
step = "1/10"
steps = 60
digits = 20
[output]
modified_energy = { order = 4, every = 5 }
trajectory = { every = 8 }
file = "out.csv"
checkpoint = "1 h"
"#;

/// Stops a run after this many states.
struct StopAfter(u32);

impl Observer for StopAfter {
    fn stops(&mut self) -> bool {
        self.0 -= 1;
        self.0 == 0
    }
}

/// A run that was stopped, and what it writes if nothing is wrong.
struct Stopped {
    folder: TempDir,
    scene: Scene,
    checkpoint: Vec<u8>,
    partial: Vec<u8>,
    whole: Vec<u8>,
}

impl Stopped {
    fn new() -> Self {
        let folder = TempDir::new().unwrap();
        let path = folder.path().join("scene.toml");
        fs::write(&path, SCENE).unwrap();
        let scene = Scene::open(&path).unwrap();
        let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
        scene.run_to_file(FileOptions::default(), &mut ()).unwrap();
        let whole = read("out.csv");
        fs::remove_file(folder.path().join("out.csv")).unwrap();
        let stopped = scene.run_to_file(FileOptions::default(), &mut StopAfter(40)).unwrap();
        assert_eq!(stopped, Outcome::Stopped { n: 39 });
        let (checkpoint, partial) = (read("out.csv.checkpoint"), read("out.csv.partial"));
        Stopped { folder, scene, checkpoint, partial, whole }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Resumes the run with other contents of its files; whether that is refused. If it is not, the file must be right.
    fn refuses(&self, checkpoint: &[u8], partial: &[u8], what: &str) -> bool {
        let remove = |path: &Path| drop(fs::remove_file(path));
        remove(&self.path("out.csv"));
        fs::write(self.path("out.csv.checkpoint"), checkpoint).unwrap();
        fs::write(self.path("out.csv.partial"), partial).unwrap();
        match self.scene.run_to_file(FileOptions::default(), &mut ()) {
            Ok(_) => assert!(fs::read(self.path("out.csv")).unwrap() == self.whole, "{what}: other bytes"),
            Err(error) => {
                let error = error.to_string();
                assert!(error.contains("`restart`") || error.contains("`force`"), "{what}: {error}");
                assert!(!self.path("out.csv").exists(), "{what}");
                return true;
            }
        }
        false
    }
}

#[test]
fn a_cut_checkpoint_is_refused() {
    let stopped = Stopped::new();
    let (checkpoint, partial) = (&stopped.checkpoint, &stopped.partial);
    assert!(!stopped.refuses(checkpoint, partial, "undamaged"));
    for length in 0..checkpoint.len() {
        let refused = stopped.refuses(&checkpoint[..length], partial, &format!("{length} bytes of the checkpoint"));
        // only the line feed at the end is not needed
        assert!(refused || length == checkpoint.len() - 1, "{length} bytes");
    }
    for length in 0..partial.len() {
        let refused = stopped.refuses(checkpoint, &partial[..length], &format!("{length} bytes of the rows"));
        // without rows the run begins again
        assert!(refused || length == 0, "{length} bytes");
    }
}

#[test]
fn a_flipped_bit_is_refused_or_does_no_harm() {
    let stopped = Stopped::new();
    let (mut refused, mut all) = (0, 0);
    for place in 0..stopped.checkpoint.len() {
        let mut checkpoint = stopped.checkpoint.clone();
        checkpoint[place] ^= 1 << (place % 8);
        let what = format!("byte {place} of the checkpoint is {:?}", checkpoint[place] as char);
        refused += usize::from(stopped.refuses(&checkpoint, &stopped.partial, &what));
        all += 1;
    }
    // blanks between the values are not protected
    assert!(refused * 10 > all * 7, "{refused} of {all}");
    for place in 0..stopped.partial.len() {
        let mut partial = stopped.partial.clone();
        partial[place] ^= 1 << (place % 8);
        let what = format!("byte {place} of the rows");
        assert!(stopped.refuses(&stopped.checkpoint, &partial, &what), "{what}");
    }
}
