//! The columns: what is done with a scene, and whether its results are there and plausible.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use assert_cmd::cargo::CommandCargoExt;
use tempfile::TempDir;

use crate::rows::Scene;

/// What is done with a scene in a folder.
pub(crate) type Done = fn(&Scene, &Path) -> Outcome;

/// How it ended; another end is a fault of the program.
pub(crate) type Outcome = Result<Cell, String>;

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Cell {
    Works,
    /// The command takes nothing of this row: the cell would be that of another one.
    Same,
    /// Why not, and whether that has a line and a column.
    Refused {
        reason: String,
        has_place: bool,
    },
}

/// A column with its name.
#[derive(Clone, Copy)]
pub(crate) struct Column {
    pub(crate) name: &'static str,
    pub(crate) done: Done,
    /// Whether the sections [run] and [output] of the scene are read.
    pub(crate) reads_run: bool,
    /// What the cell is of a scene for which there is no such command.
    pub(crate) without: fn(&Scene) -> Option<Cell>,
}

const fn column(name: &'static str, done: Done) -> Column {
    Column { name, done, reads_run: true, without: |_| None }
}

pub(crate) const COLUMNS: [Column; 11] = [
    column("run", run),
    column("resume", resume),
    column("plot", plot),
    Column { reads_run: false, without: has_no_flag, ..column("trace", trace) },
    Column { reads_run: false, without: has_no_flag, ..column("drift", drift) },
    Column { without: has_own, ..column("work-precision", work_precision) },
    Column { without: has_own, ..column("advise", advise) },
    Column { without: has_no_estimator, ..column("chaos", chaos) },
    column("sweep", sweep),
    column("sweep of a file", sweep_of_a_file),
    column("ensemble", ensemble),
];

impl Column {
    /// A cell, in a folder of its own.
    pub(crate) fn of(self, scene: &Scene) -> Outcome {
        if let Some(cell) = (self.without)(scene) {
            return Ok(cell);
        }
        (self.done)(scene, folder().path())
    }
}

/// A folder for a command, with the table that scenes name.
fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/crosses/own-scheme.toml");
    fs::copy(table, folder.path().join("own-scheme.toml")).unwrap();
    folder
}

/// The program in the folder of a cell.
fn shadowstep(folder: &Path, words: &str) -> Command {
    let mut command = Command::cargo_bin("shadowstep").unwrap();
    command.args(words.split_whitespace()).current_dir(folder).env("RAYON_NUM_THREADS", "1");
    command
}

/// The end of a command whose results are then looked at.
fn ended(scene: &Scene, mut command: Command, check: impl FnOnce(&Output) -> Result<(), String>) -> Outcome {
    let output = command.output().unwrap();
    let err = String::from_utf8_lossy(&output.stderr).into_owned();
    match output.status.code() {
        Some(0) => check(&output).map(|()| Cell::Works).map_err(|wrong| format!("{wrong}\n{err}")),
        Some(2) => refused(&err, value(scene, "scheme")).ok_or(err),
        code => Err(format!("exit code {code:?}\n{err}")),
    }
}

/// The sentence of a refusal, after its place: `scene.toml:LINE:COLUMN: `. That of any scheme and trajectory is one
/// reason.
fn refused(err: &str, scheme: &str) -> Option<Cell> {
    let line = err.lines().find(|line| !line.starts_with("note: ") && !line.trim().is_empty())?;
    let is_number = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    let place = line.split_once(".toml:").map(|(_, rest)| rest.splitn(3, ':').collect::<Vec<_>>());
    let (reason, has_place) = match place.as_deref() {
        Some([row, column, sentence]) if is_number(row) && is_number(column) => (*sentence, true),
        _ => (line.strip_prefix("error: ")?, false),
    };
    let reason = reason.split(" (trajectory ").next()?.trim().replace(scheme, "SCHEME");
    Some(Cell::Refused { reason, has_place })
}

fn expect(holds: bool, wrong: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(wrong()) }
}

/// The columns of a file of rows by their names, as numbers; what is empty is NaN.
struct Table {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Table {
    fn read(path: &Path) -> Result<Table, String> {
        let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
        let mut lines = text.lines().filter(|line| !line.starts_with('#'));
        let names = lines.next().ok_or("there are no rows")?.split(',').map(str::to_owned).collect();
        let rows = lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect()).collect();
        Ok(Table { names, rows })
    }

    fn column(&self, name: &str) -> Result<Vec<f64>, String> {
        let place = self.names.iter().position(|known| known == name).ok_or_else(|| format!("no column {name}"))?;
        Ok(self.rows.iter().map(|row| row[place]).filter(|value| !value.is_nan()).collect())
    }

    /// A column has values, all of which are finite.
    fn has(&self, name: &str) -> Result<(), String> {
        let column = self.column(name)?;
        expect(!column.is_empty() && column.iter().all(|value| value.is_finite()), || format!("{name}: {column:?}"))
    }

    /// H changes by less than a tenth: tables of these steps have smaller errors.
    fn conserves_energy(&self) -> Result<(), String> {
        let energy = self.column("energy")?;
        let first = *energy.first().ok_or("no energy")?;
        let far = energy.iter().find(|energy| (*energy - first).abs() >= 0.1 * first.abs());
        far.map_or(Ok(()), |energy| Err(format!("H changes from {first} to {energy}")))
    }
}

/// Writes scene.toml, and runs it.
fn running(scene: &Scene, folder: &Path, output: &str) -> Command {
    let output = format!("file = \"out.csv\"\n{output}");
    fs::write(folder.join("scene.toml"), scene.text(scene.step(), &output)).unwrap();
    shadowstep(folder, "run scene.toml")
}

fn run(scene: &Scene, folder: &Path) -> Outcome {
    ended(scene, running(scene, folder, ""), |_| rows_are_plausible(scene, folder))
}

fn rows_are_plausible(scene: &Scene, folder: &Path) -> Result<(), String> {
    let table = Table::read(&folder.join("out.csv"))?;
    if scene.is_ensemble() {
        return of_ensemble(&table);
    }
    let steps = table.column("n")?;
    expect(steps.len() > 4, || format!("n = {steps:?}"))?;
    table.has("t")?;
    table.has("modified_energy")?;
    table.conserves_energy()
}

fn of_ensemble(table: &Table) -> Result<(), String> {
    expect(table.rows.len() == 2, || format!("{:?}", table.rows))?;
    table.has("modified_drift")?;
    let errors = table.column("energy_error")?;
    expect(errors.len() == 2 && errors.iter().all(|error| *error < 0.1), || format!("{errors:?}"))
}

/// A row has the state at the end of the scene's run, with its time and energy where it has these; but for the
/// last bits of functions in lanes and of H in other coordinates.
fn has_end_of_run(scene: &Scene, table: &Table, row: usize) -> Result<(), String> {
    let folder = folder();
    let output = running(scene, folder.path(), "").arg("--no-summary").output().unwrap();
    expect(output.status.success(), || String::from_utf8_lossy(&output.stderr).into_owned())?;
    let run = Table::read(&folder.path().join("out.csv"))?;
    let state = run.names.iter().map(String::as_str).filter(|name| table.names.iter().any(|known| known == name));
    let ends = [("energy", "end_energy"), ("t", "end_t")]
        .into_iter()
        .filter(|(_, name)| table.names.contains(&(*name).to_owned()));
    for (name, column) in state.map(|name| (name, name)).chain(ends) {
        let (alone, here) = (run.column(name)?.last().copied(), table.column(column)?.get(row).copied());
        let (Some(alone), Some(here)) = (alone, here) else { return Err(format!("{column}: {alone:?}, {here:?}")) };
        expect((alone - here).abs() <= 1e-12 * alone.abs().max(1.0), || format!("{column}: {here}, alone {alone}"))?;
    }
    Ok(())
}

/// A run that is killed while it writes, and then is run again, has the bytes of one that was not.
fn resume(scene: &Scene, folder: &Path) -> Outcome {
    let (whole, counts) = (self::folder(), folder.join("calls"));
    let mut undisturbed = running(scene, whole.path(), "checkpoint = 2\n");
    undisturbed.env("LD_PRELOAD", crate::shim::shim()).env("FAULT_COUNT", &counts);
    match ended(scene, undisturbed, |_| Ok(()))? {
        Cell::Works => {}
        refused => return Ok(refused),
    }
    let calls: u64 = fs::read_to_string(&counts).unwrap().trim().parse().unwrap();
    let mut killed = running(scene, folder, "checkpoint = 2\n");
    killed.env("LD_PRELOAD", crate::shim::shim()).env("FAULT_KILL", (2 * calls / 3).to_string());
    let status = killed.output().unwrap().status;
    expect(status.code().is_none() && !folder.join("out.csv").exists(), || format!("it was not killed: {status}"))?;
    ended(scene, running(scene, folder, "checkpoint = 2\n"), |output| {
        let err = String::from_utf8_lossy(&output.stderr);
        expect(err.contains("note: resumed at n = "), || "it was not resumed".to_owned())?;
        let bytes = |folder: &Path| fs::read(folder.join("out.csv")).unwrap();
        expect(bytes(folder) == bytes(whole.path()), || "it has other bytes".to_owned())
    })
}

fn plot(scene: &Scene, folder: &Path) -> Outcome {
    let distance = scene.system.key("distance").unwrap_or("distance");
    let charts =
        if scene.is_ensemble() { "[\"energies\"]".to_owned() } else { format!("[\"energies\", \"{distance}\"]") };
    ended(scene, running(scene, folder, &format!("plot = {{ file = \"out.svg\", of = {charts} }}\n")), |_| {
        picture(folder, "out.svg")?;
        picture(folder, &format!("out-{}.svg", distance.replace('=', "-")))
    })
}

/// A picture with lines.
fn picture(folder: &Path, name: &str) -> Result<(), String> {
    let text = fs::read_to_string(folder.join(name)).map_err(|error| format!("{name}: {error}"))?;
    expect(text.contains("<svg") && text.contains("<poly"), || format!("{name} has no lines"))
}

/// A command that takes the system of a scene, and flags in place of [run].
fn of_flags(scene: &Scene, folder: &Path, words: &str) -> Command {
    fs::write(folder.join("scene.toml"), &scene.system.text).unwrap();
    let (step, scheme) = (signed_step(scene), value(scene, "scheme"));
    let mut command = shadowstep(folder, words);
    command.args(["scene.toml", &format!("--scheme={scheme}"), &format!("--step={step}")]);
    command.arg(format!("--until=8*({step})"));
    for key in ["numbers", "estimator"] {
        command.args(scene.run.key(key).unwrap().split_whitespace());
    }
    command
}

fn signed_step(scene: &Scene) -> String {
    value(scene, "step").replace('h', scene.step())
}

/// A value of [run].
fn value<'a>(scene: &'a Scene, key: &str) -> &'a str {
    let line = scene.run.text.lines().find_map(|line| line.strip_prefix(&format!("{key} = "))).unwrap();
    line.trim_matches('"')
}

/// What of [run] has no flag.
fn has_no_flag(scene: &Scene) -> Option<Cell> {
    lacks(scene, &["first", "gradient_kicks"])
}

/// Which of these keys of [run] a command does not have.
fn lacks(scene: &Scene, keys: &[&str]) -> Option<Cell> {
    if scene.run.title == "Steps: until a time" {
        return Some(Cell::Same);
    }
    let key = keys.iter().find(|key| scene.run.text.contains(&format!("\n{key} = ")))?;
    let reason = format!("there is no flag for `{key}`: the command takes a scheme by its name or table only");
    Some(Cell::Refused { reason, has_place: false })
}

fn trace(scene: &Scene, folder: &Path) -> Outcome {
    let words = "trace --csv --states --output out.csv --plot out.svg";
    ended(scene, of_flags(scene, folder, words), |_| {
        let table = Table::read(&folder.join("out.csv"))?;
        table.has("modified_energy")?;
        table.conserves_energy()?;
        picture(folder, "out.svg")
    })
}

fn drift(scene: &Scene, folder: &Path) -> Outcome {
    ended(scene, of_flags(scene, folder, "drift --json"), |output| {
        let record: serde_json::Value = serde_json::from_slice(&output.stdout).map_err(|error| error.to_string())?;
        let drift = record["drift"].as_str().or(record["energy_drift"].as_str());
        let size: f64 = drift.and_then(|text| text.parse().ok()).unwrap_or(f64::NAN);
        expect(size.is_finite() && size >= 0.0, || format!("{record}"))
    })
}

/// A command that takes the system of a scene and its number type.
fn of_scene(scene: &Scene, folder: &Path, words: &str) -> Command {
    fs::write(folder.join("scene.toml"), scene.text(scene.step(), "")).unwrap();
    let mut command = shadowstep(folder, words);
    command.args(["scene.toml", &format!("--schemes={}", value(scene, "scheme"))]);
    command
}

/// Work–precision diagrams and advice have an estimator of their own, and begin steps with the map of the scene.
fn has_own(scene: &Scene) -> Option<Cell> {
    if scene.run.title.starts_with("Estimators: ") { Some(Cell::Same) } else { lacks(scene, &["gradient_kicks"]) }
}

fn work_precision(scene: &Scene, folder: &Path) -> Outcome {
    let step = signed_step(scene);
    let mut command = of_scene(scene, folder, "work-precision --out out");
    command.args([format!("--until=8*({step})"), format!("--step={step},({step})/4")]);
    ended(scene, command, |_| {
        let table = Table::read(&folder.join("out/work-precision.csv"))?;
        let errors = table.column("energy_error")?;
        expect(errors.len() == 2 && errors[1] < errors[0].max(1e-13), || format!("errors of H {errors:?}"))?;
        expect(folder.join("out/report.html").exists(), || "there is no report".to_owned())
    })
}

fn advise(scene: &Scene, folder: &Path) -> Outcome {
    let mut command = of_scene(scene, folder, "advise --tolerance 1e-2 --seconds 1");
    command.arg(format!("--until=8*({})", signed_step(scene)));
    ended(scene, command, |output| {
        let text = String::from_utf8_lossy(&output.stdout);
        expect(text.contains("  verified ") && text.contains(", step "), || text.clone().into_owned())
    })
}

/// Indicators of chaos need no modified energy beside that of the verdict.
fn has_no_estimator(scene: &Scene) -> Option<Cell> {
    scene.run.title.starts_with("Estimators: ").then_some(Cell::Same)
}

fn chaos(scene: &Scene, folder: &Path) -> Outcome {
    fs::write(folder.join("scene.toml"), scene.text(scene.step(), "")).unwrap();
    ended(scene, shadowstep(folder, "chaos scene.toml --json"), |output| {
        let text = String::from_utf8_lossy(&output.stdout);
        let records: Vec<serde_json::Value> = text
            .lines()
            .map(|line| serde_json::from_str(line).map_err(|error| error.to_string()))
            .collect::<Result<_, _>>()?;
        let [whole, half] = &records[..] else { return Err(format!("{} records", records.len())) };
        let [a, b] = [whole, half].map(|record| record["lyapunov"].as_f64().unwrap_or(f64::NAN));
        let time = whole["time"].as_f64().unwrap_or(f64::NAN);
        // both follow the same flow: by how much the vector grew is the same up to the error of the steps
        expect(((a - b) * time).abs() < 0.5 && whole["motion"] == "undecided", || text.clone().into_owned())
    })
}

const SWEPT: &str = "[axes]\nh = [\"STEP\", \"(STEP)/2\"]\nx0 = [\"A\", \"B\"]\n\
                     [keep]\nstate = true\nvalues = [\"energy_error\", \"drift\"]\nat_end = { end_energy = \"E\", \
                     end_t = \"t\" }\n";

fn axes(scene: &Scene, [a, b]: [&str; 2]) -> String {
    SWEPT.replace("STEP", scene.step()).replace("\"A\"", &format!("\"{a}\"")).replace("\"B\"", &format!("\"{b}\""))
}

/// The scene in which names stand for its step and a number, and their axes.
fn swept(scene: &Scene) -> (String, String) {
    if scene.is_ensemble() {
        return (scene.text("h", ""), axes(scene, ["1", "2"]));
    }
    let (named, values) = scene.varied();
    (named.text("h", ""), axes(scene, values))
}

fn sweep(scene: &Scene, folder: &Path) -> Outcome {
    let (text, axes) = swept(scene);
    fs::write(folder.join("sweep.toml"), text + &axes).unwrap();
    ended(scene, shadowstep(folder, "sweep sweep.toml --out out"), |_| results_are_plausible(scene, folder))
}

fn sweep_of_a_file(scene: &Scene, folder: &Path) -> Outcome {
    let (text, axes) = swept(scene);
    fs::write(folder.join("scene.toml"), text).unwrap();
    fs::write(folder.join("sweep.toml"), format!("scene = \"scene.toml\"\n{axes}")).unwrap();
    ended(scene, shadowstep(folder, "sweep sweep.toml --out out"), |_| results_are_plausible(scene, folder))
}

fn results_are_plausible(scene: &Scene, folder: &Path) -> Result<(), String> {
    let table = Table::read(&folder.join("out/results.csv"))?;
    expect(table.rows.len() == 4, || format!("{} runs", table.rows.len()))?;
    for name in ["energy_error", "drift"] {
        let column = table.column(name)?;
        expect(column.len() == 4 && column.iter().all(|value| value.is_finite()), || format!("{name}: {column:?}"))?;
    }
    has_end_of_run(scene, &table, 0)
}

fn ensemble(scene: &Scene, folder: &Path) -> Outcome {
    if scene.is_ensemble() {
        return run(scene, folder);
    }
    let (named, [a, b]) = scene.varied();
    let text = named.text(scene.step(), "file = \"out.csv\"\n").replace("trajectory = { every = 2 }\n", "");
    let columns = format!("[ensemble]\ncolumns = {{ x0 = [\"{a}\", \"{b}\"] }}\n");
    fs::write(folder.join("scene.toml"), text + &columns).unwrap();
    ended(scene, shadowstep(folder, "run scene.toml"), |_| {
        let table = Table::read(&folder.join("out.csv"))?;
        of_ensemble(&table)?;
        has_end_of_run(scene, &table, 0)?;
        has_end_of_run(&scene.with_other_value(), &table, 1)
    })
}
