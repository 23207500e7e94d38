//! The job scripts: their texts, and the options that a script has.

use std::fmt::Write as _;
use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use shadowstep_scenes::outside::is_outside_allowed;
use shadowstep_scenes::{Error, not_written, shell_word};
use tempfile::NamedTempFile;

use crate::chunk::{create_folder, make_readable};

/// What a task gets: options of sbatch. What is omitted has the site's default.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Resources {
    /// `--partition`
    pub partition: Option<String>,
    /// `--time`, such as `30` minutes, `2:00:00` or `1-12`.
    pub time: Option<String>,
    /// `--mem` of a task, such as `2G`.
    pub memory: Option<String>,
    /// `--cpus-per-task`, the threads of a task; 1 if omitted.
    pub cpus: Option<u32>,
}

/// What the scripts run.
#[derive(Clone, Debug)]
pub struct SweepCommand {
    /// The program, an absolute path.
    pub program: PathBuf,
    /// The file of the sweep, an absolute path.
    pub sweep: PathBuf,
    /// The folder of its results, an absolute path.
    pub folder: PathBuf,
    /// How many chunks the sweep has.
    pub chunks: u64,
}

/// The two scripts in the folder of a sweep.
#[derive(Debug)]
pub struct Scripts {
    /// Of the array, `array.sbatch`.
    pub array: Script,
    /// Of the job that collects, `collect.sbatch`.
    pub collect: Script,
}

/// A job script.
#[derive(Debug)]
pub struct Script {
    /// Its file.
    pub path: PathBuf,
    /// Its text.
    pub text: String,
}

/// The names of the scripts.
pub(super) const ARRAY: &str = "array.sbatch";
pub(super) const COLLECT: &str = "collect.sbatch";
pub(crate) const SCRIPTS: [&str; 2] = [ARRAY, COLLECT];
/// The folder of what tasks print.
pub(super) const LOGS: &str = "slurm-logs";

impl Scripts {
    /// Reads the scripts of the folder, and writes those that it lacks.
    ///
    /// # Errors
    /// Resources or chunks that contradict a script that is there; a script of another folder; a path that a script
    /// cannot hold; files that cannot be read or written.
    pub fn prepare(command: &SweepCommand, resources: &Resources) -> Result<Self, Error> {
        check_words(resources)?;
        check_path(&command.folder)?;
        check_path(&command.sweep)?;
        let logs = command.folder.join(LOGS);
        create_folder(&logs)?;
        let array = Script::prepare(command, ARRAY, &array_text(command, resources))?;
        let collect = Script::prepare(command, COLLECT, &collect_text(command, resources))?;
        array.refuse_contradictions(resources, command.chunks)?;
        Ok(Scripts { array, collect })
    }
}

impl Script {
    fn prepare(command: &SweepCommand, name: &str, text: &str) -> Result<Self, Error> {
        let path = command.folder.join(name);
        match fs::read_to_string(&path) {
            Ok(text) => {
                let script = Script { path, text };
                script.refuse_other_folder(&command.folder)?;
                Ok(script)
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                write(&path, text).map_err(|error| not_written(&path, error, "submit the sweep again"))?;
                Ok(Script { path, text: text.to_owned() })
            }
            Err(error) => {
                Err(Error::usage(format!("{} cannot be read: {error}", path.display()), "mend the file, or remove it"))
            }
        }
    }

    /// A folder that was moved or copied has scripts that write into the old one.
    fn refuse_other_folder(&self, folder: &Path) -> Result<(), Error> {
        let word = format!(" {} ", shell_word(folder));
        let mut commands = self.text.lines().filter(|line| !line.starts_with('#'));
        if commands.any(|line| format!("{line} ").contains(&word)) {
            return Ok(());
        }
        let message = format!("{} does not use this folder, {}", self.path.display(), folder.display());
        Err(Error::usage(message, "if the folder was moved, remove the file: it is written again"))
    }

    /// Flags do not change a script that is there; a flag that differs from it is refused.
    fn refuse_contradictions(&self, resources: &Resources, chunks: u64) -> Result<(), Error> {
        let cpus = resources.cpus.map(|cpus| cpus.to_string());
        let given = [
            ("--partition", "--partition", resources.partition.as_deref()),
            ("--time", "--time", resources.time.as_deref()),
            ("--memory", "--mem", resources.memory.as_deref()),
            ("--cpus", "--cpus-per-task", cpus.as_deref()),
        ];
        for (flag, option, value) in given {
            let Some(value) = value else { continue };
            let found = self.option(option);
            if found.as_ref().is_none_or(|(_, found)| found != value) {
                return Err(self.contradiction(option, found, &format!("{flag} {value} was given")));
            }
        }
        let array = self.option("--array");
        let tasks = array.as_ref().map(|(_, value)| value.split('%').next().unwrap_or(value));
        if tasks != Some(&format!("1-{chunks}")) && !(chunks == 1 && tasks == Some("1")) {
            return Err(self.contradiction("--array", array, &format!("the sweep has the chunks 1-{chunks}")));
        }
        Ok(())
    }

    fn contradiction(&self, option: &str, found: Option<(usize, String)>, given: &str) -> Error {
        let path = self.path.display();
        let message = match found {
            Some((line, value)) => format!("{path}:{line} has {option}={value}, and {given}"),
            None => format!("{path} has no {option}, and {given}"),
        };
        Error::usage(message, "edit the file, or remove it: it is written again with the flags")
    }

    /// The most tasks that run at a time, `%8` in `--array=1-100%8`; empty if that is not limited.
    pub(super) fn limit(&self) -> String {
        let array = self.option("--array").map(|(_, value)| value).unwrap_or_default();
        array.split_once('%').map(|(_, limit)| format!("%{limit}")).unwrap_or_default()
    }

    /// An option of sbatch with its line, counted from 1. Of several, the last one counts.
    fn option(&self, name: &str) -> Option<(usize, String)> {
        let short = SHORT.iter().find(|(long, _)| *long == name).map(|(_, short)| *short);
        let mut found = None;
        for (line, words) in option_lines(&self.text) {
            let mut words = words.split_whitespace();
            while let Some(word) = words.next() {
                if let Some(value) = word.strip_prefix(name).and_then(|rest| rest.strip_prefix('=')) {
                    found = Some((line, value.to_owned()));
                } else if word == name || Some(word) == short {
                    found = Some((line, words.next().unwrap_or_default().to_owned()));
                } else if let Some(value) = short.and_then(|short| word.strip_prefix(short)) {
                    found = Some((line, value.to_owned()));
                }
            }
        }
        found
    }
}

/// Writes a file that is whole when it has its name; without locks, which a cluster's file system may not have.
fn write(path: &Path, text: &str) -> io::Result<()> {
    let mut file = NamedTempFile::new_in(path.parent().unwrap_or(Path::new(".")))?;
    file.write_all(text.as_bytes())?;
    make_readable(file.as_file())?;
    file.as_file().sync_all()?;
    file.persist_noclobber(path)?;
    Ok(())
}

/// Short forms of options.
const SHORT: [(&str, &str); 4] =
    [("--array", "-a"), ("--partition", "-p"), ("--time", "-t"), ("--cpus-per-task", "-c")];

/// The lines that sbatch reads, without `#SBATCH`: those before the first command.
fn option_lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let head = text.lines().enumerate().take_while(|(_, line)| line.trim().is_empty() || line.starts_with('#'));
    head.filter_map(|(number, line)| Some((number + 1, line.strip_prefix("#SBATCH")?)))
}

fn array_text(command: &SweepCommand, resources: &Resources) -> String {
    let SweepCommand { program, sweep, folder, chunks } = command;
    let mut text = "\
#!/bin/sh
# Each task computes one chunk of the sweep. A chunk that is complete is kept, so that a task can be requeued or \
submitted again.
# This file can be edited: other options of sbatch, such as --account, or modules to load.
"
    .to_owned();
    let name = sweep.file_stem().unwrap_or_default().to_string_lossy();
    options(&mut text, &name, resources);
    let _ = writeln!(text, "#SBATCH --cpus-per-task={}", resources.cpus.unwrap_or(1));
    let _ = writeln!(text, "#SBATCH --array=1-{chunks}");
    text += "#SBATCH --requeue\n#SBATCH --open-mode=append\n";
    let _ = writeln!(text, "#SBATCH --output={}", log(folder, "%A_%a.log"));
    text += "\nexport RAYON_NUM_THREADS=\"${SLURM_CPUS_PER_TASK:-1}\"\n";
    let (program, sweep, folder) = (shell_word(program), shell_word(sweep), shell_word(folder));
    let outside = if is_outside_allowed() { " --allow-outside" } else { "" };
    let _ = writeln!(
        text,
        "exec {program} sweep {sweep} --out {folder} --chunk \"$SLURM_ARRAY_TASK_ID/{chunks}\"{outside}"
    );
    text
}

fn collect_text(command: &SweepCommand, resources: &Resources) -> String {
    let SweepCommand { program, sweep, folder, .. } = command;
    let mut text =
        "#!/bin/sh\n# Collects the chunks when all tasks have ended; the log lists chunks that are missing.\n"
            .to_owned();
    let name = sweep.file_stem().unwrap_or_default().to_string_lossy();
    options(&mut text, &format!("{name}-collect"), resources);
    text += "#SBATCH --requeue\n#SBATCH --open-mode=append\n";
    let _ = writeln!(text, "#SBATCH --output={}", log(folder, "collect-%j.log"));
    let _ = writeln!(text, "\nexec {} collect {}", shell_word(program), shell_word(folder));
    text
}

/// The options that both scripts have.
fn options(text: &mut String, name: &str, resources: &Resources) {
    let name: String = name.chars().map(|c| if c.is_alphanumeric() || "._-".contains(c) { c } else { '-' }).collect();
    let Resources { partition, time, memory, .. } = resources;
    let _ = writeln!(text, "#SBATCH --job-name={name}");
    for (option, value) in [("partition", partition), ("time", time), ("mem", memory)] {
        if let Some(value) = value {
            let _ = writeln!(text, "#SBATCH --{option}={value}");
        }
    }
}

/// The path of a log as an option, in which Slurm puts numbers for `%A` and others.
fn log(folder: &Path, name: &str) -> String {
    let path = format!("{}/{name}", folder.join(LOGS).display().to_string().replace('%', "%%"));
    if path.contains(char::is_whitespace) { format!("\"{path}\"") } else { path }
}

/// A value with a blank or a quote would be read as something else.
fn check_words(resources: &Resources) -> Result<(), Error> {
    let Resources { partition, time, memory, .. } = resources;
    for (flag, value, example) in
        [("--partition", partition, "short"), ("--time", time, "2:00:00"), ("--memory", memory, "2G")]
    {
        let Some(value) = value else { continue };
        if value.is_empty() || value.chars().any(|c| c.is_whitespace() || c.is_control() || "\"'\\#".contains(c)) {
            return Err(Error::usage(format!("{flag} {value:?} is not valid"), format!("use {flag} {example}")));
        }
    }
    Ok(())
}

/// Slurm gives a quote, a backslash or a line's end in the path of a log another meaning.
fn check_path(path: &Path) -> Result<(), Error> {
    match path.to_str() {
        Some(text) if !text.chars().any(|c| c.is_control() || "\"'\\".contains(c)) => Ok(()),
        _ => {
            let message = format!("{} has a quote, a backslash or a control character", path.display());
            Err(Error::usage(message, "rename it: Slurm would read the path differently"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn command(folder: &Path) -> SweepCommand {
        let program = PathBuf::from("/opt/shadow step/bin/shadowstep");
        SweepCommand { program, sweep: "/home/me/my map.toml".into(), folder: folder.to_owned(), chunks: 16 }
    }

    fn resources() -> Resources {
        Resources {
            partition: Some("short".into()),
            time: Some("2:00:00".into()),
            memory: Some("2G".into()),
            cpus: Some(4),
        }
    }

    #[test]
    fn the_array_has_the_flags_as_options() {
        let expected = "\
#!/bin/sh
# Each task computes one chunk of the sweep. A chunk that is complete is kept, so that a task can be requeued or \
submitted again.
# This file can be edited: other options of sbatch, such as --account, or modules to load.
#SBATCH --job-name=my-map
#SBATCH --partition=short
#SBATCH --time=2:00:00
#SBATCH --mem=2G
#SBATCH --cpus-per-task=4
#SBATCH --array=1-16
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=/scratch/me/map/slurm-logs/%A_%a.log

export RAYON_NUM_THREADS=\"${SLURM_CPUS_PER_TASK:-1}\"
exec '/opt/shadow step/bin/shadowstep' sweep '/home/me/my map.toml' --out /scratch/me/map \
--chunk \"$SLURM_ARRAY_TASK_ID/16\"
";
        assert_eq!(array_text(&command(Path::new("/scratch/me/map")), &resources()), expected);
    }

    #[test]
    fn the_collecting_job_needs_no_cores_of_its_own() {
        let expected = "\
#!/bin/sh
# Collects the chunks when all tasks have ended; the log lists chunks that are missing.
#SBATCH --job-name=my-map-collect
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=\"/scratch/100%% mine/slurm-logs/collect-%j.log\"

exec '/opt/shadow step/bin/shadowstep' collect '/scratch/100% mine'
";
        assert_eq!(collect_text(&command(Path::new("/scratch/100% mine")), &Resources::default()), expected);
    }

    #[test]
    fn options_are_found_in_every_form_before_the_first_command() {
        let text = "#!/bin/sh\n#SBATCH -p short --time 30\n#SBATCH -c4 --array=1-16%8\n#SBATCH \
            --time=40\n\nrun\n#SBATCH --mem=1G\n";
        let script = Script { path: "array.sbatch".into(), text: text.to_owned() };
        assert_eq!(script.option("--partition"), Some((2, "short".to_owned())));
        assert_eq!(script.option("--time"), Some((4, "40".to_owned())));
        assert_eq!(script.option("--cpus-per-task"), Some((3, "4".to_owned())));
        assert_eq!(script.option("--mem"), None);
        assert_eq!(script.limit(), "%8");
    }

    fn refusal(result: Result<Scripts, Error>) -> String {
        result.unwrap_err().to_string()
    }

    #[test]
    fn a_script_that_is_there_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let command = command(folder.path());
        let scripts = Scripts::prepare(&command, &resources()).unwrap();
        let edited =
            scripts.array.text.replace("#SBATCH --requeue\n", "#SBATCH --requeue\n#SBATCH --account=physics\n");
        fs::write(&scripts.array.path, &edited).unwrap();
        for resources in [resources(), Resources::default()] {
            let scripts = Scripts::prepare(&command, &resources).unwrap();
            assert_eq!(scripts.array.text, edited);
        }
    }

    #[test]
    fn flags_that_contradict_a_script_are_refused_with_its_line() {
        let folder = tempfile::tempdir().unwrap();
        let command = command(folder.path());
        let given = Resources { memory: None, ..resources() };
        let path = Scripts::prepare(&command, &given).unwrap().array.path;
        let path = path.display();
        let other = |other: Resources| refusal(Scripts::prepare(&command, &other));
        let partition = other(Resources { partition: Some("long".into()), ..Resources::default() });
        assert!(
            partition.starts_with(&format!("{path}:5 has --partition=short, and --partition long was given\n")),
            "{partition}"
        );
        let memory = other(resources());
        assert!(memory.starts_with(&format!("{path} has no --mem, and --memory 2G was given\n")), "{memory}");
        let cpus = other(Resources { cpus: Some(2), ..Resources::default() });
        assert!(cpus.starts_with(&format!("{path}:7 has --cpus-per-task=4, and --cpus 2 was given\n")), "{cpus}");
        let chunks = refusal(Scripts::prepare(&SweepCommand { chunks: 20, ..command.clone() }, &Resources::default()));
        assert!(
            chunks.starts_with(&format!("{path}:8 has --array=1-16, and the sweep has the chunks 1-20\n")),
            "{chunks}"
        );
    }

    #[test]
    fn the_script_of_a_folder_that_was_moved_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let (old, new) = (folder.path().join("old"), folder.path().join("new"));
        Scripts::prepare(&command(&old), &Resources::default()).unwrap();
        fs::rename(&old, &new).unwrap();
        let refused = refusal(Scripts::prepare(&command(&new), &Resources::default()));
        assert!(refused.contains("does not use this folder"), "{refused}");
        fs::remove_file(new.join("array.sbatch")).unwrap();
        fs::remove_file(new.join("collect.sbatch")).unwrap();
        assert!(Scripts::prepare(&command(&new), &Resources::default()).is_ok());
    }

    #[test]
    fn values_that_would_be_read_as_something_else_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let time = Resources { time: Some("1 0".into()), ..Resources::default() };
        let refused = refusal(Scripts::prepare(&command(folder.path()), &time));
        assert_eq!(refused, "--time \"1 0\" is not valid\n  hint: use --time 2:00:00");
        let quote = refusal(Scripts::prepare(&command(&folder.path().join("a'b")), &Resources::default()));
        assert!(quote.contains("a'b has a quote"), "{quote}");
        assert!(!folder.path().join("array.sbatch").exists());
    }
}
