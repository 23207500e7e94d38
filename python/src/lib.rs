//! The Python package `shadowstep`: what the library and scenes compute, from Python. There is no mathematics in it.
//!
//! The module `_shadowstep` takes and gives plain values; the package's own files in `shadowstep/` have the classes,
//! docstrings and types that its users see.
//!
//! | module | what it is |
//! | --- | --- |
//! | `errors` | Python's exceptions for the errors of scenes |
//! | `waiting` | work without Python's lock, until Ctrl-C |
//! | `given` | a problem, from the text of a scene or with a function for its forces |
//! | `own_forces` | forces from a C function or a Python function |
//! | `given_run` | a run of a problem, from its options |
//! | `scheme` | schemes with what is proved of them |
//! | `estimator` | the estimator of the modified energy, from its options |
//! | `arrays`, `json` | results as arrays, and as dictionaries |
//! | `integrate` | runs into arrays |
//! | `derivatives` | derivatives of runs |
//! | `ensemble` | many trajectories at once |
//! | `followed` | indicators of chaos, the drift of the modified energy |
//! | `work_precision` | speed against error, and advice |
//! | `scene` | runs that a file describes, and the program `shadowstep` |
//! | `laboratory` | tables polished to more digits; searches for schemes |
//! | `of_scheme` | schemes as code and for Monte Carlo, the modified Hamiltonian |
//! | `monitor` | the monitor of the modified energy, for loops |
//! | `recorded` | trajectories that other programs have computed |

#![allow(clippy::needless_pass_by_value)] // arguments from Python have no owner

mod arrays;
mod derivatives;
mod ensemble;
mod errors;
mod estimator;
mod followed;
mod given;
mod given_run;
mod integrate;
mod json;
mod laboratory;
mod monitor;
mod of_scheme;
mod own_forces;
mod recorded;
mod scene;
mod scheme;
mod waiting;
mod work_precision;

use pyo3::prelude::*;

/// The module.
#[pymodule]
mod _shadowstep {
    #[pymodule_export]
    use crate::{
        derivatives::{derivatives, distance_of, gradient},
        ensemble::ensemble,
        errors::{InputError, RunError},
        followed::{chaos, drift},
        given::{Given, problem_keys, problem_names},
        integrate::{fixed_names, integrate},
        laboratory::{polished, searched},
        monitor::Monitor,
        of_scheme::{emit, modified_formulas, modified_series, proposal},
        recorded::{
            Observer, energies_of_log, energies_of_states, momenta_of_half_steps, momenta_with_gradients, unwrapped,
        },
        scene::{command, run_scene, scene_text},
        scheme::{Table, shipped_names},
        work_precision::{advise, work_precision},
    };

    #[pymodule_export]
    #[allow(non_upper_case_globals)] // as Python names it
    const __version__: &str = env!("CARGO_PKG_VERSION");
    #[pymodule_export]
    const WINDOWS: u64 = shadowstep_scenes::run::Run::WINDOWS;
    #[pymodule_export]
    const LEAST_WINDOWS: u64 = shadowstep::shadow::Verdict::LEAST_WINDOWS;
}
