//! The script of a job array of Slurm, each task of which computes a chunk.

use std::path::{Path, absolute};

use shadowstep_scenes::outside::is_outside_allowed;
use shadowstep_scenes::{Error, shell_word};

use crate::sweeps::chunk::create_folder;
use crate::sweeps::manifest::Manifest;
use crate::sweeps::plan::SweepPlan;

/// The folder of what tasks print, in the one of the sweep. Slurm does not create it.
const LOGS: &str = "slurm-logs";

/// Begins the folder of a sweep with this many chunks; returns the script for `sbatch` whose tasks compute them with
/// this program.
///
/// A task computes the chunk of its number, whatever part of the array is submitted. All paths are absolute.
///
/// # Errors
/// A path that Slurm would read differently; those of [`Manifest::begin`].
pub fn job_script(plan: &SweepPlan, folder: &Path, chunks: u64, program: &Path) -> Result<String, Error> {
    let from_root = |path: &Path| {
        let message = |error| format!("{} has no path from the root: {error}", path.display());
        absolute(path).map_err(|error| Error::usage(message(error), "give one, such as /home/me/sweep.toml"))
    };
    let (sweep, out) = (from_root(plan.source.path.as_ref())?, from_root(folder)?);
    let logs = out.join(LOGS);
    // in the path of a log, Slurm gives these characters another meaning
    let logs_text = logs.to_str().filter(|text| !text.contains(|c: char| c.is_control() || "\"'\\".contains(c)));
    let Some(logs_text) = logs_text else {
        let message = format!("{} has a quote, a backslash or a control character", out.display());
        return Err(Error::usage(message, "rename it: Slurm would read the path differently"));
    };
    Manifest::begin(folder, plan, Some(chunks))?;
    create_folder(&logs)?;
    let name = sweep.file_stem().unwrap_or_default().to_string_lossy();
    let name = name.replace(|c: char| !(c.is_alphanumeric() || "._-".contains(c)), "-");
    let logs_text = logs_text.replace('%', "%%");
    let [program, sweep, out] = [program, &sweep, &out].map(shell_word);
    let outside = if is_outside_allowed() { " --allow-outside" } else { "" };
    Ok(format!(
        "\
#!/bin/sh
# Each task computes one chunk of the sweep. A chunk that is complete is kept, so that a task can be requeued or \
submitted again.
# Options that sbatch is given, such as --time, --mem, --cpus-per-task and --account, are stronger than those here.
#SBATCH --job-name={name}
#SBATCH --cpus-per-task=1
#SBATCH --array=1-{chunks}
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=\"{logs_text}/%A_%a.log\"

export RAYON_NUM_THREADS=\"${{SLURM_CPUS_PER_TASK:-1}}\"
exec {program} sweep {sweep} --out {out} --chunk \"$SLURM_ARRAY_TASK_ID/{chunks}\"{outside}
"
    ))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use shadowstep::tables::Source;

    use super::*;

    const SWEEP: &str = "problem.name = \"pendulum\"\naxes.h = \"1/10 … 1/100 in 19 steps\"\nkeep.state = true\n\
        run = { scheme = \"ruth3\", step = \"h\", steps = 1, digits = \"double\" }";

    fn script(folder: &Path, chunks: u64) -> Result<String, Error> {
        let plan = SweepPlan::of(&Source { path: "/home/me/my map.toml".to_owned(), text: SWEEP.to_owned() }).unwrap();
        job_script(&plan, folder, chunks, Path::new("/opt/shadow step/bin/shadowstep"))
    }

    #[test]
    fn each_task_computes_its_chunk() {
        let folder = tempfile::tempdir().unwrap();
        let (out, shown) = (folder.path().join("100% mine"), folder.path().display());
        let expected = format!(
            "\
#!/bin/sh
# Each task computes one chunk of the sweep. A chunk that is complete is kept, so that a task can be requeued or \
submitted again.
# Options that sbatch is given, such as --time, --mem, --cpus-per-task and --account, are stronger than those here.
#SBATCH --job-name=my-map
#SBATCH --cpus-per-task=1
#SBATCH --array=1-16
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=\"{shown}/100%% mine/slurm-logs/%A_%a.log\"

export RAYON_NUM_THREADS=\"${{SLURM_CPUS_PER_TASK:-1}}\"
exec '/opt/shadow step/bin/shadowstep' sweep '/home/me/my map.toml' --out '{shown}/100% mine' \
--chunk \"$SLURM_ARRAY_TASK_ID/16\"
"
        );
        assert_eq!(script(&out, 16).unwrap(), expected);
        assert!(fs::read_dir(out.join(LOGS)).unwrap().next().is_none());
        assert_eq!(Manifest::read(&out).unwrap().chunks, 16);
    }

    #[test]
    fn what_is_refused_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        for (name, chunks, part) in [("a'b", 16, "a'b has a quote"), ("out", 21, "20 runs cannot be divided")] {
            let refused = script(&folder.path().join(name), chunks).unwrap_err().to_string();
            assert!(refused.contains(part), "{refused}");
            assert!(!folder.path().join(name).exists());
        }
    }
}
