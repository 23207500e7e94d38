//! Sweeps: many runs of a scene over axes of parameters, divided into chunks that can be computed anywhere and in any
//! order.
//!
//! ```
//! use shadowstep_studies::sweeps::{Chunk, Collected, Manifest, SweepPlan, TableFormat, collect, compute};
//!
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("sweep.toml");
//! std::fs::write(&path, r#"
//! problem.name = "pendulum"
//! run = { scheme = "$scheme", step = "h", until = 5, digits = "double" }
//! [axes]
//! scheme = ["stormer-verlet", "yoshida4"]
//! h = "1/10 … 1/100 in 9 steps of 1/h"
//! [keep]
//! values = ["energy_error"]
//! "#)?;
//! let plan = SweepPlan::open(&path)?;
//! let out = folder.path().join("out");
//! let manifest = Manifest::begin(&out, &plan, Some(4))?;
//! compute(&plan, &manifest, &out, [Chunk { number: 3, of: 4 }], &mut ())?;
//! let Collected::Incomplete { missing, .. } = collect(&out, TableFormat::Csv, &mut ())? else { panic!() };
//! assert_eq!(missing.list(), "1-2,4");
//!
//! compute(&plan, &manifest, &out, manifest.all_chunks(), &mut ())?;
//! let Collected::Complete { runs: 20, failed: 0, .. } = collect(&out, TableFormat::Csv, &mut ())? else { panic!() };
//! let csv = std::fs::read_to_string(out.join("results.csv"))?;
//! let rows: Vec<&str> = csv.lines().filter(|line| !line.starts_with('#')).collect();
//! assert_eq!(rows[0], "run,scheme,h,h_double,energy_error,failure");
//! assert!(rows[2].starts_with("1,stormer-verlet,1/20,0.05,"), "{}", rows[2]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | module | what it is |
//! | --- | --- |
//! | `plan` | a sweep's text → its scene, axes, and what is kept; hashes of what determines the results |
//! | `axes`, `axis` | names and their values; the values of a run from its number |
//! | `keys` | every key with its meaning |
//! | `keep`, `values` | what is kept of a run |
//! | `record` | one run |
//! | `batch`, `together` | some runs of one thread; runs that are computed together, one in each lane |
//! | `chunk`, `partial` | the file of a chunk, and of one that is not complete |
//! | `manifest` | what the chunks in a folder are of |
//! | `compute` | chunks on all cores |
//! | `collect` | chunks → a table and a picture, or what is missing |
//! | `foreign` | what a folder has that is not from a sweep |
//! | `picture` | maps and curves |
//! | `job_script` | the script of a job array of Slurm |
//! | `task` | which chunk a task of a Slurm array computes |

mod axes;
mod axis;
mod batch;
mod chunk;
mod collect;
mod compute;
mod foreign;
mod job_script;
mod keep;
mod keys;
mod manifest;
mod partial;
mod picture;
mod plan;
mod record;
mod task;
mod together;
mod values;

pub use chunk::Chunk;
pub use collect::{Collected, Missing, TableFormat, collect};
pub use compute::{Computed, compute, is_there};
pub use foreign::{refuse_foreign, remove_foreign};
pub use job_script::job_script;
pub use keys::{explain, sweep_schema};
pub use manifest::Manifest;
pub use plan::SweepPlan;
pub use task::chunk_of_task;
