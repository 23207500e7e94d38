//! What a run needs to be resumed with the same bits: the identity of its scene, the length of its valid rows, a state.

use serde::{Deserialize, Serialize};

use crate::motion::tangent::VECTORS_OF_ROWS;
use crate::results::functions::elementary_functions;
use crate::results::metadata::{file_hashes, input_names, platform, sha256, table_hashes};
use crate::run::arithmetic::Numbers;
use crate::run::saved_state::{SavedState, SavedVector};
use crate::run::saved_summary::SavedSummary;
use crate::scene::Scene;

/// Everything that determines the numbers of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Identity {
    version: String,
    platform: String,
    scene_sha256: String,
    /// The hash of the scene without the value of `until` or `steps`.
    #[serde(default)]
    without_end_sha256: String,
    tables_sha256: Vec<String>,
    /// Of other files that have states.
    #[serde(default)]
    files_sha256: Vec<String>,
    /// Those of the machine, for a run in double precision with checkpoints.
    #[serde(default)]
    functions_sha256: Option<String>,
    /// What messages call the tables and the files. This and what follows comes from the scene.
    #[serde(skip)]
    names: Vec<String>,
    #[serde(skip)]
    steps: u64,
    #[serde(skip)]
    dimension: usize,
    /// How many remainders of positions a state has, and of momenta.
    #[serde(skip)]
    remainders: usize,
    /// How many tangent vectors there are.
    #[serde(skip)]
    vectors: usize,
}

impl Identity {
    pub(crate) fn of(scene: &Scene) -> Identity {
        let dimension = scene.system.dimension();
        Identity {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            platform: platform(),
            scene_sha256: sha256(&scene.source.text),
            without_end_sha256: without_end(scene),
            tables_sha256: table_hashes(scene),
            files_sha256: file_hashes(scene),
            functions_sha256: functions(scene).map(str::to_owned),
            names: input_names(scene),
            steps: scene.most_steps(),
            dimension,
            remainders: if scene.arithmetic.is_compensated() { dimension } else { 0 },
            vectors: if scene.output.chaos.is_some() { VECTORS_OF_ROWS } else { 0 },
        }
    }

    /// The hash of the scene.
    pub(crate) fn scene(&self) -> &String {
        &self.scene_sha256
    }

    /// That of a run of the same scene with another end.
    fn with_end_of(&self, other: &Identity) -> Identity {
        let is_same = self.without_end_sha256 == other.without_end_sha256;
        let scene = if is_same { other } else { self };
        Identity { scene_sha256: scene.scene_sha256.clone(), ..self.clone() }
    }

    /// Everything else, as it stands in metadata, and how a file was made in which it does not.
    pub(crate) fn inputs(&self) -> impl Iterator<Item = (&str, String)> {
        let program = [
            (self.version.as_str(), "by another version of shadowstep".to_owned()),
            (self.platform.as_str(), "on another platform".to_owned()),
        ];
        let hashes = self.tables_sha256.iter().chain(&self.files_sha256);
        let files = hashes.zip(&self.names).map(|(hash, name)| (hash.as_str(), format!("with a different {name}")));
        program.into_iter().chain(files)
    }

    /// The first difference of another identity, as the end of "was made with".
    fn differs(&self, other: &Identity) -> Option<String> {
        if self.scene_sha256 != other.scene_sha256 {
            return Some("a different text of the scene".to_owned());
        }
        let hashes = |identity: &Identity| [identity.tables_sha256.clone(), identity.files_sha256.clone()].concat();
        let (own, others) = (hashes(self), hashes(other));
        if own.len() != others.len() {
            return Some("other files".to_owned());
        }
        if let Some(place) = (0..own.len()).find(|&place| own[place] != others[place]) {
            return Some(format!("a different {}", self.names[place]));
        }
        if self.version != other.version {
            return Some(format!("shadowstep {}", other.version));
        }
        if self.platform != other.platform {
            return Some(format!("a different platform, {}", other.platform));
        }
        (self.functions_sha256 != other.functions_sha256).then(|| {
            "elementary functions of double precision with other last bits, of another processor or C library"
                .to_owned()
        })
    }
}

/// A hash of the text with nothing in the place of the value of `until` or `steps`.
fn without_end(scene: &Scene) -> String {
    let (text, end) = (&scene.source.text, &scene.end_at);
    sha256(&format!("{}\0{}", &text[..end.start], &text[end.end..]))
}

/// The fingerprint of the functions that determine the bits of a run.
fn functions(scene: &Scene) -> Option<&'static str> {
    let is_double = !matches!(scene.arithmetic.numbers(), Numbers::Digits(..));
    (is_double && scene.output.checkpoint.is_some()).then(elementary_functions)
}

/// A moment of a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Checkpoint {
    pub(crate) identity: Identity,
    /// All rows up to this n are in the partial file.
    pub(crate) n: i64,
    /// Whether it is the last one.
    #[serde(default)]
    pub(crate) is_last: bool,
    /// Their length in bytes, with the head.
    pub(crate) bytes: u64,
    /// The length of the head before them.
    #[serde(default)]
    pub(crate) head: u64,
    /// From where on these bytes are hashed: the head of some formats is written anew at the end.
    #[serde(default)]
    pub(crate) hashed_from: u64,
    /// The hash of these bytes.
    pub(crate) sha256: String,
    /// The state from which the run is resumed; `None` for the one at t = 0.
    pub(crate) state: Option<SavedState>,
    /// The hash of the scene with an earlier end whose file is prolonged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) prolongs: Option<String>,
    /// The tangent vectors at n, if there are any.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) vectors: Vec<SavedVector>,
    /// What its summary needs of the states so far; `None` of a run without one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) summary: Option<SavedSummary>,
}

/// A checkpoint with its own hash: the content of the file.
#[derive(Serialize, Deserialize)]
struct Sealed {
    checkpoint: Checkpoint,
    sha256: String,
}

impl Checkpoint {
    pub(crate) fn to_text(&self) -> String {
        let sealed = Sealed { sha256: seal(self), checkpoint: self.clone() };
        serde_json::to_string_pretty(&sealed).expect("texts and numbers are JSON") + "\n"
    }

    /// Reads a checkpoint of this scene.
    ///
    /// # Errors
    /// Why the run cannot be resumed from it, as the predicate of a sentence.
    pub(crate) fn read(text: &str, identity: &Identity) -> Result<Checkpoint, String> {
        let checkpoint = Checkpoint::sealed(text)?;
        if let Some(other) = identity.differs(&checkpoint.identity) {
            return Err(format!("was made with {other}"));
        }
        checkpoint.check(identity)?;
        Ok(checkpoint)
    }

    /// Reads the checkpoint that a complete run of this scene, but with an earlier end, has left.
    pub(crate) fn of_earlier_end(text: &str, identity: &Identity) -> Option<Checkpoint> {
        let checkpoint = Checkpoint::sealed(text).ok()?;
        let expected = identity.with_end_of(&checkpoint.identity);
        let is_other_end = expected.scene_sha256 != identity.scene_sha256;
        let is_valid = is_other_end && expected.differs(&checkpoint.identity).is_none();
        Some(checkpoint).filter(|checkpoint| is_valid && checkpoint.check(identity).is_ok())
    }

    /// The hash of the scene that it is of.
    pub(crate) fn scene(&self) -> &str {
        &self.identity.scene_sha256
    }

    /// What no one has changed.
    fn sealed(text: &str) -> Result<Checkpoint, String> {
        let sealed: Sealed = serde_json::from_str(text).map_err(|_| "is damaged".to_owned())?;
        if seal(&sealed.checkpoint) != sealed.sha256 {
            return Err("was changed after it was written".to_owned());
        }
        Ok(sealed.checkpoint)
    }

    /// Refuses what no run of the scene writes: a checkpoint may have been made by another program, with a hash that
    /// fits.
    fn check(&self, identity: &Identity) -> Result<(), String> {
        let Identity { steps, vectors, .. } = *identity;
        let is_of_run = |n: i64| u64::try_from(n).is_ok_and(|n| n <= steps);
        if !is_of_run(self.n) {
            return Err(format!("is at n = {}, which is not a state of the run", self.n));
        }
        if self.head > self.bytes || self.hashed_from > self.head {
            return Err(format!("has a head of {} bytes in {} bytes", self.head, self.bytes));
        }
        if self.vectors.len() != vectors {
            return Err(format!("has {} tangent vectors, where the scene has {vectors}", self.vectors.len()));
        }
        let vectors = self.vectors.iter().flat_map(|vector| [&vector.state, &vector.derivatives]);
        self.state.iter().chain(vectors).try_for_each(|state| self.check_state(state, identity))
    }

    fn check_state(
        &self,
        SavedState { n, q, p, q_remainders, p_remainders }: &SavedState,
        &Identity { steps, dimension, remainders, .. }: &Identity,
    ) -> Result<(), String> {
        let is_of_run = |n: i64| u64::try_from(n).is_ok_and(|n| n <= steps);
        if !is_of_run(*n) || *n > self.n {
            return Err(format!("is at n = {} and has the state n = {n}", self.n));
        }
        if (q.len(), p.len()) != (dimension, dimension) {
            let (q, p) = (q.len(), p.len());
            return Err(format!("has {q} positions and {p} momenta, where the scene has {dimension} of each"));
        }
        if (q_remainders.len(), p_remainders.len()) != (remainders, remainders) {
            let (q, p) = (q_remainders.len(), p_remainders.len());
            return Err(format!(
                "has {q} remainders of positions and {p} of momenta, where the scene has {remainders} of each"
            ));
        }
        Ok(())
    }
}

fn seal(checkpoint: &Checkpoint) -> String {
    sha256(&serde_json::to_string(checkpoint).expect("texts and numbers are JSON"))
}
