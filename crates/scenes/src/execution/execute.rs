//! Running a scene: into its file, which a later run can resume, or into a writer.

use std::io::{self, Write};
use std::path::Path;

use crate::execution::engine::{Outcome, SceneRun};
use crate::execution::posed::Followed;
use crate::motion::stability;
use crate::results::{Begun, Checkpoint, FileOptions, Metadata, Rows, Target, file_hashes, prolonged, records};
use crate::run::note::Note;
use crate::scene::{Format, Scene};
use crate::texts::error::Error;
use crate::watch::observer::Observer;

impl Scene {
    /// Runs the scene and writes its rows to the file that it names, from the last checkpoint if there is one.
    ///
    /// If the file is complete, and was made by this scene with these tables and this version, nothing is done.
    ///
    /// # Errors
    /// A scene without a file, a file that is not from this scene or cannot be written, a checkpoint of another scene,
    /// a run that fails. The rows of a run that fails stay in a partial file if the scene asks for checkpoints.
    pub fn run_to_file(&self, options: FileOptions, observer: &mut dyn Observer) -> Result<Outcome, Error> {
        match Target::open(self, &self.names(), options, observer)? {
            Some((target, begun)) => self.run((target, self.output.format), &begun, observer),
            None => Ok(Outcome::AlreadyComplete),
        }
    }

    /// The hashes of other files than tables of schemes that the scene has read: of particles, of Horizons.
    pub fn file_hashes(&self) -> Vec<String> {
        file_hashes(self)
    }

    /// The hash of the scene with an earlier end whose complete file a run of this scene goes on with, and changes only
    /// by adding rows; `None` where there is no such file, or another.
    pub fn prolonged_sha256(&self) -> Option<String> {
        prolonged(self)
    }

    /// Runs the scene and writes its rows, whatever file it names, without checkpoints.
    ///
    /// # Errors
    /// A run that fails, a writer that does.
    pub fn run_into(&self, rows: &mut dyn Write, observer: &mut dyn Observer) -> Result<Outcome, Error> {
        self.run((Target::Writer(rows), self.output.format), &Begun::Anew, observer)
    }

    /// The same as CSV, whatever format it names.
    ///
    /// # Errors
    /// As [`run_into`](Scene::run_into).
    pub fn run_into_csv(&self, rows: &mut dyn Write, observer: &mut dyn Observer) -> Result<Outcome, Error> {
        self.run((Target::Writer(rows), Format::Csv), &Begun::Anew, observer)
    }

    /// The names of the columns of its rows.
    pub fn column_names(&self) -> Vec<String> {
        self.names().into_iter().filter(|name| name.is_column).map(|name| name.text).collect()
    }

    /// The rows of a complete file of NumPy's format, as cells of [columns](Scene::column_names).
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn numpy_rows(&self, path: &Path) -> io::Result<impl Iterator<Item = io::Result<Vec<String>>> + use<>> {
        records(path, self.column_names().len())
    }

    /// Everything that determines the numbers of the run, as a JSON object.
    pub fn metadata(&self) -> serde_json::Value {
        serde_json::json!(Metadata::of(self))
    }

    /// Whether the steps are too large for the motion at the start, if a summary is wanted.
    fn note_of_steps(&self, observer: &dyn Observer) -> Option<Note> {
        if !self.summarises(observer) {
            return None;
        }
        let system = (&self.system, self.system.fastest_frequency());
        stability::note_of_steps(system, &self.scheme, self.h.exact())
    }

    /// That whole steps end before `until`.
    fn note_of_end(&self) -> Option<Note> {
        let plain = self.until.as_ref().filter(|_| self.physical_end().is_none());
        plain.and_then(|until| Note::of_end(self.h.exact(), self.steps()?, until))
    }

    /// Whether a summary is made.
    pub(crate) fn summarises(&self, observer: &dyn Observer) -> bool {
        self.output.summary && observer.summarises()
    }

    fn run(
        &self,
        (target, format): (Target<'_>, Format),
        begun: &Begun,
        observer: &mut dyn Observer,
    ) -> Result<Outcome, Error> {
        let mut rows = Rows { target, format, names: self.names() };
        let (checkpoint, steps) = (begun.checkpoint(), self.steps());
        match begun {
            Begun::Resumed(Checkpoint { n, .. }) => observer.note(&Note::Resumed { n: *n, steps }),
            Begun::Prolonged(Checkpoint { n, .. }) => observer.note(&Note::Prolonged { n: *n, steps }),
            Begun::Anew => {
                let notes = self.note_of_end().into_iter().chain(self.note_of_steps(observer));
                notes.for_each(|note| observer.note(&note));
            }
        }
        if !matches!(begun, Begun::Resumed(_)) {
            rows.head(&Metadata::of(self))?;
            rows.target.end_head(format == Format::Numpy, checkpoint)?;
        }
        let following = SceneRun { scene: self, rows: &mut rows, checkpoint, observer: &mut *observer };
        match self.arithmetic.compute(following) {
            Ok(Followed { n, is_stopped: true, .. }) => Ok(Outcome::Stopped { n }),
            Ok(Followed { n, is_met, evaluations: force_evaluations, summary, .. }) => {
                let steps = n.unsigned_abs();
                if let Some(condition) = &self.ends {
                    observer.note(&Note::Ends { condition: condition.text().to_owned(), steps, is_met });
                }
                rows.finish(&Metadata::of(self), summary.as_ref())?;
                summary.iter().for_each(|summary| observer.summary(summary));
                Ok(Outcome::Complete { steps, force_evaluations })
            }
            Err(error) => {
                // where the disk is full, a later run can resume it
                if matches!(error, Error::Run { .. }) {
                    rows.target.give_up(observer)?;
                }
                Err(error)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analyses::chaos::ChaosRequest;
    use crate::execution::posed::Posed;
    use crate::motion::tangent::Vectors;
    use crate::run::Run;
    use crate::watch::summary::Summary;
    use std::fs;

    const KEPLER: &str = "[problem]\nname = \"kepler\"";

    /// What moves in 20 steps with a checkpoint at each `interrupt`, in a number type, and what else the output is.
    fn scene_of(digits: &str, folder: &Path, system: &str, output: &str) -> Scene {
        let text = format!(
            "{system}\n[run]\nscheme = \"ruth3\"\nstep = \"1/20\"\nsteps = 20\ndigits = {digits}\n\
             [output]\nfile = \"out.csv\"\ncheckpoint = \"1 h\"\n{output}\n"
        );
        let path = folder.join("scene.toml");
        fs::write(&path, text).unwrap();
        Scene::open(&path).unwrap()
    }

    /// Stops a run after this many states.
    struct StopAfter(i64);

    impl Observer for StopAfter {
        fn stops(&mut self) -> bool {
            self.0 -= 1;
            self.0 <= 0
        }
    }

    /// Stops after `each` states, then after twice as many states of the resumed run, and so on; gives the
    /// bytes of the file and the n of the stops.
    fn with_stops(digits: &str, system: &str, output: &str, each: usize) -> (String, Vec<i64>) {
        let folder = tempfile::tempdir().unwrap();
        let scene = scene_of(digits, folder.path(), system, output);
        let mut stops = Vec::new();
        loop {
            let after = each * (stops.len() + 1) + 1;
            match scene.run_to_file(FileOptions::default(), &mut StopAfter(after as i64)).unwrap() {
                Outcome::Stopped { n } => stops.push(n),
                _ => break,
            }
            // a run that is killed may have written more than its checkpoint knows of
            let partial = fs::OpenOptions::new().append(true).open(folder.path().join("out.csv.partial"));
            partial.unwrap().write_all(b"a row, and the half of").unwrap();
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3, "the file, its last checkpoint, and the scene");
        (fs::read_to_string(folder.path().join("out.csv")).unwrap(), stops)
    }

    const SECTION: &str = "energy = { every = 5 }\ntrajectory = { section = \"x\", direction = \"both\" }";

    const OUTPUTS: &[&str] = &[
        "trajectory = true",
        "energy = { every = 3 }\ntrajectory = { every = 2 }",
        "modified_energy = { estimator = \"central\", order = 1 }",
        "modified_energy = { order = 4, every = 3 }\nenergy = true",
        "modified_energy = { max_order = 6 }\ntrajectory = { every = 5 }",
        "modified_energy = { max_order = 30 }",
        "modified_energy = { estimator = \"central\", max_order = 6, rule = \"robust\" }\nenergy = { every = 4 }",
        "modified_energy = { estimator = \"bilinear\", order = 6 }",
        "modified_energy = { estimator = \"bilinear\", max_order = 8, accuracy = \"1e-9\", every = 2 }",
        "chaos = true",
        "modified_energy = { max_order = 6 }\nchaos = { every = 3 }",
        SECTION,
    ];

    /// Checkpoints keep the remainders of compensated sums, too.
    #[test]
    fn wherever_a_run_is_stopped_its_file_has_the_same_bytes() {
        let pairs = "[problem]\npair = \"-m_i*m_j/sqrt(r2)\"\ndimensions = 2\nbodies = { m = [1, 2, \"sqrt(3)\"] }\n\
                     masses = \"m\"\n[initial]\nq = [0, 0, 1, 0, 0, 2]\nv = [0, \"1/3\", 1, 0, 0, 0]";
        let kinetic = "[problem]\npotential = \"q^2/2\"\ncoordinates = [\"q\"]\nkinetic = \"sqrt(1 + pq^2)\"\n\
                       [initial]\nq = [1]\np = [\"1/3\"]";
        let planets = "[problem]\nparts = \"wisdom-holman-heliocentric\"\nparameters = { g = 1 }\nbarycentric = true\n\
                       [[body]]\nmass = 1\n[[body]]\nmass = 0.01\na = 1\ne = 0.3\n[[body]]\nmass = 0.01\na = 2\nM = 80";
        let many_parts = "[problem]\nparts = [\"(q1^2 + p1^2)^2 + q2^2 + p2^2\", \"-p1*p2\", \"-q1*q2\"]\n\
                          coordinates = [\"q1\", \"q2\"]\nmomenta = [\"p1\", \"p2\"]\n[initial]\nq = [1, 0]\np = \
                          [0, \"1/3\"]";
        let transformed = format!("{KEPLER}\n[time]\ntransform = \"logarithmic\"");
        let few = ["trajectory = true", "chaos = true", "modified_energy = { max_order = 6 }\nenergy = { every = 3 }"];
        let of_others = [pairs, kinetic, planets, many_parts, &transformed].map(|system| ("30", system, &few[..]));
        let of_kepler =
            [("30", KEPLER, OUTPUTS), ("\"compensated\"", KEPLER, OUTPUTS), ("\"double\"", KEPLER, &[SECTION])];
        for (digits, system, outputs) in of_kepler.into_iter().chain(of_others) {
            for output in outputs {
                let (whole, stops) = with_stops(digits, system, output, 1000);
                let rows = || whole.lines().filter(|line| !line.starts_with('#'));
                assert!(stops.is_empty() && rows().count() > 2, "{output}: {whole}");
                assert!(
                    *output != SECTION || rows().filter(|row| !row.ends_with(',')).count() > 1,
                    "no crossings: {whole}"
                );
                for each in if outputs.len() > 3 { &[2, 5, 7, 8, 12, 13, 19, 20][..] } else { &[5, 8, 13] } {
                    let (bytes, stops) = with_stops(digits, system, output, *each);
                    assert!(!stops.is_empty() && stops.is_sorted(), "{output}: {stops:?}");
                    assert_eq!(bytes, whole, "{digits}, {output}: {stops:?}");
                }
            }
        }
    }

    /// Stops a run after some states, and keeps its summary.
    struct StopAfterAndKeep(StopAfter, Option<Summary>);

    impl Observer for StopAfterAndKeep {
        fn stops(&mut self) -> bool {
            self.0.stops()
        }

        fn summarises(&self) -> bool {
            true
        }

        fn summary(&mut self, summary: &Summary) {
            self.1 = Some(summary.clone());
        }
    }

    /// The summary as text and JSON of a run that is stopped after random numbers of states.
    fn summary_with_stops(text: &str, random: &mut impl FnMut() -> i64) -> (String, serde_json::Value) {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("scene.toml"), text).unwrap();
        let scene = Scene::open(folder.path().join("scene.toml")).unwrap();
        loop {
            let mut observer = StopAfterAndKeep(StopAfter(random()), None);
            scene.run_to_file(FileOptions::default(), &mut observer).unwrap();
            if let Some(summary) = observer.1 {
                return (summary.to_string(), serde_json::json!(summary));
            }
        }
    }

    /// Whatever is in a summary is that of a run without interruptions, wherever it was interrupted, also where its end
    /// is found on the way.
    #[test]
    fn wherever_a_run_is_stopped_its_summary_is_the_same() {
        let kepler = "problem = { name = \"kepler\", parameters = { eccentricity = \"7/10\" } }";
        let transformed = &format!("{kepler}\ntime.transform = \"logarithmic\"");
        let planets = "problem = { parts = \"wisdom-holman-heliocentric\", parameters = { g = 1 }, encounters = { \
            within = 0.2 } }\n\
                       body = [{ mass = 1 }, { mass = 3e-4, a = 1, e = 0.1 }, { mass = 1e-4, a = 1.2, e = 0.1, M = 80 }]";
        let particles = "problem = { parts = \"wisdom-holman\", parameters = { g = 1 } }\n\
                         body = [{ mass = 1 }, { mass = 3e-4, a = 1, e = 0.1 }, { mass = 0, a = 1.2, e = 0.1, M = 80 }]";
        let many = "problem = { name = \"toda\" }";
        let rows = "energy = { every = 7 }\n";
        let estimated = "modified_energy = { estimator = \"bilinear\", order = 8, every = 7 }\n";
        let extremes = "energy = { every = 9 }\nextremes = { r = \"x^2 + y^2\" }\n";
        let section = "trajectory = { section = \"y\", direction = \"up\" }\nchaos = { every = 20 }\n";
        // windows that overlap, and windows apart, but for what is short, where H is computed at all states
        let steps: &[&str] = &["steps = 60", "steps = 300", "steps = 900"];
        // of q and p alone the second one, at n = 1374: tested at many states at once
        let ends: &[&str] = &["steps = 5000, end = \"t > 31/2\"", "steps = 5000, end = \"x > 3/10\""];
        let (end_by_time, last): (&[&str], &[&str]) = (&["until = 16"], &["until = 1000, end = \"t > 31/2\""]);
        let mut seed = 71_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            2 + (seed >> 33).rem_euclid(120) as i64
        };
        for (system, scheme, h, digits, ends, outputs) in [
            (kepler, "yoshida4", "1/20", "\"double\"", steps, &[extremes][..]),
            (kepler, "yoshida4", "1/20", "\"double\"", steps, &[estimated]),
            (kepler, "bcm6-13", "1/20", "\"double\"", steps, &[rows]),
            (kepler, "yoshida4", "1/20", "\"double\"", steps, &[section]),
            (kepler, "stormer-verlet", "1/20", "\"compensated\"", steps, &[rows]),
            (kepler, "stormer-verlet", "1/20", "\"double-double\"", steps, &[rows]),
            (kepler, "stormer-verlet", "1/20", "30", steps, &[extremes]),
            (kepler, "stormer-verlet", "1/20", "40", steps, &[estimated]),
            (transformed, "yoshida4", "1/20", "30", steps, &[estimated]),
            (planets, "stormer-verlet", "1/40", "\"double\"", steps, &[rows]),
            (particles, "saba4", "1/10", "\"double\"", steps, &[rows]),
            (particles, "saba4", "1/10", "\"double\"", steps, &[estimated]),
            (many, "stormer-verlet", "1/10", "\"double\"", steps, &[rows]),
            (kepler, "yoshida4", "1/20", "\"double\"", ends, &[extremes, estimated]),
            (kepler, "bcm6-13", "1/20", "\"compensated\"", &ends[..1], &[extremes, estimated]),
            (transformed, "stormer-verlet", "1/20", "30", end_by_time, &[extremes, estimated]),
            (transformed, "yoshida4", "1/20", "\"double\"", last, &[extremes, estimated]),
        ] {
            for (end, output) in ends.iter().flat_map(|end| outputs.iter().map(move |output| (end, output))) {
                let text = format!(
                    "{system}\nrun = {{ scheme = \"{scheme}\", step = \"{h}\", {end}, digits = {digits} }}\n\
                     [output]\nfile = \"out.csv\"\ncheckpoint = \"1 h\"\n{output}"
                );
                let whole = summary_with_stops(&text, &mut || 10_000);
                let mut stops = [3, 40, 97, 150].into_iter().cycle();
                for _ in 0..2 {
                    let resumed = match end.starts_with("steps = ") && !end.contains("end") {
                        true => summary_with_stops(&text, &mut random),
                        false => summary_with_stops(&text, &mut || stops.next().unwrap()),
                    };
                    assert_eq!(resumed, whole, "{text}");
                }
            }
        }
    }

    /// However late it is interrupted, and where it goes on to a later end than the one that came before its condition.
    #[test]
    fn a_run_whose_condition_is_not_met_is_resumed_late_and_prolonged() {
        let folder = tempfile::tempdir().unwrap();
        let run = |steps: u64, stop: i64| {
            let text = format!(
                "problem.name = \"kepler\"\nrun = {{ scheme = \"yoshida4\", step = \"1/20\", steps = {steps}, end \
                    = \"x > 9\", digits = \"double\" }}\n\
                 [output]\nfile = \"out.csv\"\ncheckpoint = 50\nenergy = {{ every = 7 }}\n"
            );
            fs::write(folder.path().join("scene.toml"), text).unwrap();
            let mut observer = StopAfterAndKeep(StopAfter(stop), None);
            let scene = Scene::open(folder.path().join("scene.toml")).unwrap();
            scene.run_to_file(FileOptions::default(), &mut observer).unwrap();
            observer.1.map(|summary| summary.to_string())
        };
        assert_eq!(run(2000, 300), None);
        for stop in [2, 40, 3] {
            assert_eq!(run(2000, stop), None);
        }
        let resumed = run(2000, 100_000).expect("it is complete");
        let prolonged = run(20_000, 100_000).expect("it is complete");
        fs::remove_file(folder.path().join("out.csv")).unwrap();
        fs::remove_file(folder.path().join("out.csv.checkpoint")).unwrap();
        assert_eq!(run(2000, 100_000), Some(resumed));
        fs::remove_file(folder.path().join("out.csv")).unwrap();
        fs::remove_file(folder.path().join("out.csv.checkpoint")).unwrap();
        assert_eq!(run(20_000, 100_000), Some(prolonged));
    }

    /// A checkpoint of a run without a summary has nothing for one; that of a complete run has it for a later end.
    #[test]
    fn a_summary_is_of_all_steps_that_were_followed() {
        let folder = tempfile::tempdir().unwrap();
        let scene = scene_of("30", folder.path(), KEPLER, "energy = true");
        assert_eq!(scene.run_to_file(FileOptions::default(), &mut StopAfter(8)).unwrap(), Outcome::Stopped { n: 7 });
        let mut observer = StopAfterAndKeep(StopAfter(1000), None);
        scene.run_to_file(FileOptions::default(), &mut observer).unwrap();
        let summary = observer.1.unwrap();
        assert!(!summary.is_of_whole_run() && summary.to_string().contains("13 steps since n = 7"), "{summary}");
        let summary_of = |steps: u64, restart: bool| {
            fs::write(folder.path().join("scene.toml"), scene.source.text.replace("= 20", &format!("= {steps}")))
                .unwrap();
            let mut observer = StopAfterAndKeep(StopAfter(1000), None);
            let options = FileOptions { restart, force: restart };
            Scene::open(folder.path().join("scene.toml")).unwrap().run_to_file(options, &mut observer).unwrap();
            observer.1.unwrap()
        };
        summary_of(30, true);
        let prolonged = summary_of(60, false);
        // up to 64 steps H is computed at each, and there is a window at each
        assert_eq!(prolonged.to_string(), summary_of(60, true).to_string());
    }

    /// The bytes of a run to the end, from that of an earlier end, with a stop after a number of states of the
    /// prolonged one.
    fn prolonged(digits: &str, system: &str, output: &str, (earlier, stop): (u64, i64)) -> String {
        let folder = tempfile::tempdir().unwrap();
        let whole = scene_of(digits, folder.path(), system, output);
        let text = |steps: u64| whole.source.text.replace("steps = 20", &format!("steps = {steps}"));
        let run = |steps: u64, observer: &mut dyn Observer| {
            fs::write(folder.path().join("scene.toml"), text(steps)).unwrap();
            let scene = Scene::open(folder.path().join("scene.toml")).unwrap();
            scene.run_to_file(FileOptions::default(), observer).unwrap()
        };
        assert!(matches!(run(earlier, &mut ()), Outcome::Complete { .. }));
        let outcome = run(20, &mut StopAfter(stop));
        assert!(fs::exists(folder.path().join("out.csv")).unwrap(), "the file stays until there is a longer one");
        if matches!(outcome, Outcome::Stopped { .. }) {
            assert!(matches!(run(20, &mut ()), Outcome::Complete { .. }));
        }
        assert_eq!(run(20, &mut ()), Outcome::AlreadyComplete);
        fs::read_to_string(folder.path().join("out.csv")).unwrap()
    }

    #[test]
    fn a_run_with_a_later_end_goes_on_from_its_last_state() {
        let transformed = format!("{KEPLER}\n[time]\ntransform = \"logarithmic\"");
        for (digits, system) in [("30", KEPLER), ("\"compensated\"", KEPLER), ("\"double\"", &*transformed)] {
            for output in [
                "trajectory = true",
                "energy = { every = 3 }\ntrajectory = { every = 2 }",
                "modified_energy = { order = 4, every = 3 }\nenergy = true",
                "modified_energy = { estimator = \"bilinear\", order = 6 }",
                "modified_energy = { max_order = 6 }\nchaos = { every = 3 }",
                "trajectory = { section = \"x\", direction = \"both\" }",
                "values = { r = \"x^2 + y^2\" }",
            ] {
                let (whole, _) = with_stops(digits, system, output, 1000);
                for (earlier, stop) in [(12, 1000), (12, 1), (12, 3), (19, 1), (1, 8), (1, 1000)] {
                    let bytes = prolonged(digits, system, output, (earlier, stop));
                    assert_eq!(bytes, whole, "{digits}, {output}: {earlier} steps, a stop after {stop}");
                }
            }
        }
    }

    /// NumPy's records have the doubles of CSV, wherever the run is stopped, and when it is prolonged.
    #[test]
    fn so_are_records_of_numpy() {
        let folder = tempfile::tempdir().unwrap();
        let output = "modified_energy = { order = 4, every = 3 }\nenergy = true\ntrajectory = { every = 2 }\nchaos = \
            { every = 5 }\n\
                      values = { r = \"log(x)\" }";
        let text = |file: &str, steps: u64| {
            let scene = scene_of("\"double\"", folder.path(), KEPLER, output).source.text;
            scene.replace("out.csv", file).replace("steps = 20", &format!("steps = {steps}"))
        };
        let run = |file: &str, steps: u64, stop: i64| {
            fs::write(folder.path().join("scene.toml"), text(file, steps)).unwrap();
            let scene = Scene::open(folder.path().join("scene.toml")).unwrap();
            let outcome = scene.run_to_file(FileOptions::default(), &mut StopAfter(stop)).unwrap();
            (scene, matches!(outcome, Outcome::Complete { .. }))
        };
        let (scene, _) = run("a.csv", 20, 1000);
        let csv = fs::read_to_string(folder.path().join("a.csv")).unwrap();
        let mut lines = csv.lines().filter(|line| !line.starts_with('#'));
        assert_eq!(lines.next().unwrap(), scene.column_names().join(","));
        assert!(!run("b.npy", 12, 5).1 && !run("b.npy", 12, 9).1 && run("b.npy", 12, 1000).1);
        assert!(!run("b.npy", 20, 3).1 && run("b.npy", 20, 1000).1);
        let rows = scene.numpy_rows(&folder.path().join("b.npy")).unwrap();
        assert!(rows.map(|row| row.unwrap().join(",")).eq(lines.map(|line| line.replace(",4,", ",4.0,"))));
        // what a run that was killed before its first checkpoint has left
        fs::write(folder.path().join("c.npy.partial"), b"\x93NUMPY\x02\x00 and so on").unwrap();
        run("c.npy", 20, 1000);
        let [b, c] = ["b.npy", "c.npy"].map(|file| fs::read(folder.path().join(file)).unwrap());
        assert!(b == c && b.starts_with(b"\x93NUMPY\x02\x00"));
    }

    /// So it is where time is transformed and the end is a physical one: the last step to it is not of the longer run.
    #[test]
    fn a_run_to_a_later_physical_time_goes_on() {
        let folder = tempfile::tempdir().unwrap();
        let text = |until: &str, file: &str| {
            format!(
                "{KEPLER}\n[time]\ntransform = \"logarithmic\"\n[run]\nscheme = \"ruth3\"\nstep = \"1/20\"\nuntil = \
                    {until}\ndigits = 30\n\
                 [output]\nfile = \"{file}\"\ncheckpoint = 5\ntrajectory = {{ every = 3 }}\nenergy = true\n"
            )
        };
        let run = |until: &str, file: &str| {
            let path = folder.path().join("scene.toml");
            fs::write(&path, text(until, file)).unwrap();
            Scene::open(&path).unwrap().run_to_file(FileOptions::default(), &mut ()).unwrap();
            fs::read_to_string(folder.path().join(file)).unwrap()
        };
        let rows =
            |text: &str| text.lines().filter(|line| !line.starts_with('#')).map(str::to_owned).collect::<Vec<_>>();
        let (short, long, whole) = (run("\"1/2\"", "a.csv"), run("3", "a.csv"), run("3", "b.csv"));
        assert_eq!(rows(&long), rows(&whole));
        assert!(rows(&short).len() < rows(&long).len());
    }

    #[test]
    fn only_a_file_of_the_same_scene_is_prolonged() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.toml");
        let text = scene_of("30", folder.path(), KEPLER, "trajectory = true").source.text;
        let run = |text: &str| {
            fs::write(&path, text).unwrap();
            Scene::open(&path).unwrap().run_to_file(FileOptions::default(), &mut ()).map_err(|error| error.to_string())
        };
        run(&text).unwrap();
        let longer = text.replace("steps = 20", "steps = 30");
        for changed in [text.replace("= 20", "= 19"), longer.replace("trajectory = true", "energy = true")] {
            assert!(run(&changed).unwrap_err().contains("is not from this unchanged scene"), "{changed}");
        }
        let rows = fs::read_to_string(folder.path().join("out.csv")).unwrap();
        fs::write(folder.path().join("out.csv"), rows.replace("\n20,", "\n21,")).unwrap();
        assert!(
            run(&longer).unwrap_err().contains("is not from this unchanged scene"),
            "a changed file is not replaced"
        );
    }

    /// At the last state they are what the command of that name has.
    #[test]
    fn rows_have_the_indicators_of_chaos() {
        let folder = tempfile::tempdir().unwrap();
        for digits in ["\"double\"", "\"double-double\"", "25"] {
            let scene = scene_of(digits, folder.path(), KEPLER, "chaos = { every = 7 }");
            let mut rows = Vec::new();
            scene.run_into(&mut rows, &mut ()).unwrap();
            let rows = String::from_utf8(rows).unwrap();
            let rows: Vec<&str> = rows.lines().filter(|line| !line.starts_with('#')).collect();
            assert_eq!(rows[0], "n,t,lyapunov,megno,mean_megno,sali");
            assert_eq!(rows[1].split(',').skip(2).take(3).collect::<Vec<_>>(), ["", "0.0", ""]);
            assert_eq!(rows.len(), 4, "{rows:?}");
            let shorter = scene_of(digits, folder.path(), KEPLER, "energy = true");
            let posed = Posed { run: Run { steps: 14, ..shorter.as_run() }, ..shorter.posed() };
            let request = ChaosRequest { posed, vectors: Vectors::Free(2), every: 1 };
            let expected = request.run(1, &mut ()).unwrap();
            let found: Vec<f64> = rows[3].split(',').skip(2).map(|text| text.parse().unwrap()).collect();
            let means = [expected.lyapunov, expected.mean_megno].map(Option::unwrap);
            let expected = [means[0], expected.megno, means[1], expected.sali.unwrap()];
            assert_eq!(found, expected, "{digits}");
        }
    }

    #[test]
    fn a_resumed_run_repeats_only_the_steps_that_an_estimate_needs() {
        let folder = tempfile::tempdir().unwrap();
        let scene = scene_of("30", folder.path(), KEPLER, "modified_energy = { estimator = \"central\", order = 2 }");
        // each fifth state is kept, and the estimates after n need one at or before n - 5: D_2, and three states for
        // its error
        let mut first = 0;
        for (n, kept) in [(4, None), (6, Some(0)), (16, Some(10)), (17, Some(10)), (19, Some(10)), (20, Some(15))] {
            let outcome = scene.run_to_file(FileOptions::default(), &mut StopAfter(n - first + 1)).unwrap();
            assert_eq!(outcome, Outcome::Stopped { n });
            let text = fs::read_to_string(folder.path().join("out.csv.checkpoint")).unwrap();
            let state = serde_json::from_str::<serde_json::Value>(&text).unwrap()["checkpoint"]["state"]["n"].as_i64();
            assert_eq!(state, kept, "at n = {n}");
            // the first estimate of the run that is resumed from there
            first = kept.map_or(0, |kept| kept + 6);
        }
    }

    #[test]
    fn a_checkpoint_that_no_run_writes_is_refused() {
        use serde_json::json;
        type Change = fn(&mut serde_json::Value);
        let changes: [(Change, &str); 9] = [
            (
                |c| drop(c["state"]["q"].as_array_mut().unwrap().pop()),
                "has 1 positions and 2 momenta, where the scene has 2 of each",
            ),
            (
                |c| c["state"]["p"].as_array_mut().unwrap().push(json!("1")),
                "has 2 positions and 3 momenta, where the scene has 2 of each",
            ),
            (|c| (c["state"]["q"], c["state"]["p"]) = (json!([]), json!([])), "has 0 positions and 0 momenta"),
            (|c| c["n"] = json!(21), "is at n = 21, which is not a state of the run"),
            (|c| c["n"] = json!(-1), "is at n = -1, which is not a state of the run"),
            (|c| c["state"]["n"] = json!(13), "is at n = 12 and has the state n = 13"),
            (|c| c["state"]["n"] = json!(i64::MIN), "is at n = 12 and has the state n = -9223372036854775808"),
            (|c| c["state"]["q"][0] = json!("sqrt(2)"), "the state n = 12 of the checkpoint cannot be read"),
            (
                |c| drop(c["state"].as_object_mut().unwrap().remove("p_remainders").unwrap()),
                "has 2 remainders of positions and 0 of momenta, where the scene has 2 of each",
            ),
        ];
        for (change, message) in changes {
            let folder = tempfile::tempdir().unwrap();
            let digits = if message.contains("remainders") { "\"compensated\"" } else { "30" };
            let scene = scene_of(digits, folder.path(), KEPLER, "trajectory = true");
            let stopped = scene.run_to_file(FileOptions::default(), &mut StopAfter(13)).unwrap();
            assert_eq!(stopped, Outcome::Stopped { n: 12 });
            // a checkpoint with other values, whose hash fits
            let path = folder.path().join("out.csv.checkpoint");
            let mut file: serde_json::Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
            change(&mut file["checkpoint"]);
            let checkpoint: Checkpoint = serde_json::from_value(file["checkpoint"].take()).unwrap();
            fs::write(&path, checkpoint.to_text()).unwrap();
            let error = scene.run_to_file(FileOptions::default(), &mut ()).unwrap_err().to_string();
            assert!(error.contains(message) && error.contains("`restart`"), "{message}: {error}");
        }
    }

    #[test]
    fn a_plain_run_evaluates_the_gradient_once_a_step_and_once_to_begin() {
        let folder = tempfile::tempdir().unwrap();
        let mut scene = scene_of("30", folder.path(), KEPLER, "energy = true");
        scene.scheme = crate::document::library::scheme("stormer-verlet").unwrap();
        let outcome = scene.run_to_file(FileOptions::default(), &mut ()).unwrap();
        assert_eq!(outcome, Outcome::Complete { steps: 20, force_evaluations: 21 });
    }
}
