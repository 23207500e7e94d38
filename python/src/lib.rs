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
//! | `given_run` | a run of a problem and the estimator of its modified energy, from their options |
//! | `scheme` | schemes with what is proved of them |
//! | `values` | results as arrays, dictionaries and lists |
//! | `integrate` | runs into arrays |
//! | `derivatives` | derivatives of runs |
//! | `followed` | indicators of chaos, the drift of the modified energy |
//! | `work_precision` | speed against error, and advice |
//! | `scene` | runs that the text of a scene describes, ensembles; the program `shadowstep` |
//! | `of_scheme` | schemes as code and for Monte Carlo, the modified Hamiltonian, new tables |
//! | `monitor` | the monitor of the modified energy, for loops |
//! | `recorded` | trajectories that other programs have computed |

#![allow(clippy::needless_pass_by_value)] // arguments from Python have no owner

mod derivatives;
mod errors;
mod followed;
mod given;
mod given_run;
mod integrate;
mod monitor;
mod of_scheme;
mod own_forces;
mod recorded;
mod scene;
mod scheme;
mod values;
mod waiting;
mod work_precision;

use pyo3::prelude::*;

/// The module.
#[pymodule]
mod _shadowstep {
    #[pymodule_export]
    use crate::{
        derivatives::{derivatives, distance_of, gradient},
        errors::{InputError, RunError},
        followed::{chaos, drift},
        given::{Given, problem_keys, problem_names},
        integrate::{fixed_names, integrate},
        monitor::Monitor,
        of_scheme::{emit, modified_formulas, modified_series, polished, proposal, searched},
        recorded::{Observer, energies_of_log, energies_of_states},
        scene::{command, ensemble, run_scene, scene_text},
        scheme::{Table, shipped_names},
        work_precision::{advise, work_precision},
    };

    #[pymodule_export]
    #[allow(non_upper_case_globals)] // as Python names it
    const __version__: &str = env!("CARGO_PKG_VERSION");
    #[pymodule_export]
    const LEAST_WINDOWS: u64 = shadowstep::shadow::Verdict::LEAST_WINDOWS;
}
