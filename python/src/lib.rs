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
//! | `scheme` | schemes with what is proved of them |
//! | `estimator` | the estimator of the modified energy, from its options |
//! | `integrate` | runs into arrays |
//! | `ensemble` | many trajectories at once |
//! | `chaos` | indicators of chaos |
//! | `drift` | the drift of the modified energy |
//! | `work_precision` | speed against error, and advice |
//! | `scene` | runs that a file describes |
//! | `modified_hamiltonian` | the modified Hamiltonian as a series and as formulas |
//! | `laboratory` | tables polished to more digits; searches for schemes |
//! | `sampling` | schemes for Hamiltonian Monte Carlo |
//! | `emit` | schemes as code of other ecosystems |
//! | `command` | the program `shadowstep` |
//! | `monitor` | the monitor of the modified energy, for loops |
//! | `recorded` | trajectories that other programs have computed |

#![allow(clippy::needless_pass_by_value)] // arguments from Python have no owner

mod chaos;
mod command;
mod derivatives;
mod drift;
mod emit;
mod ensemble;
mod errors;
mod estimator;
mod given;
mod given_run;
mod integrate;
mod laboratory;
mod modified_hamiltonian;
mod monitor;
mod own_forces;
mod recorded;
mod sampling;
mod scene;
mod scheme;
mod waiting;
mod work_precision;

use pyo3::prelude::*;

/// The module.
#[pymodule]
mod _shadowstep {
    #[pymodule_export]
    use crate::chaos::chaos;
    #[pymodule_export]
    use crate::command::command;
    #[pymodule_export]
    use crate::derivatives::{derivatives, distance_of, gradient};
    #[pymodule_export]
    use crate::drift::drift;
    #[pymodule_export]
    use crate::emit::emit;
    #[pymodule_export]
    use crate::ensemble::ensemble;
    #[pymodule_export]
    use crate::errors::{InputError, RunError};
    #[pymodule_export]
    use crate::given::{Given, problem_keys, problem_names};
    #[pymodule_export]
    use crate::integrate::{fixed_names, integrate};
    #[pymodule_export]
    use crate::laboratory::{polished, searched};
    #[pymodule_export]
    use crate::modified_hamiltonian::{modified_formulas, modified_series};
    #[pymodule_export]
    use crate::monitor::Monitor;
    #[pymodule_export]
    use crate::recorded::{
        Observer, energies_of_log, energies_of_states, momenta_of_half_steps, momenta_with_forces, unwrapped,
    };
    #[pymodule_export]
    use crate::sampling::proposal;
    #[pymodule_export]
    use crate::scene::{run_scene, scene_text};
    #[pymodule_export]
    use crate::scheme::{Table, shipped_names};
    #[pymodule_export]
    use crate::work_precision::{advise, work_precision};

    #[pymodule_export]
    #[allow(non_upper_case_globals)] // as Python names it
    const __version__: &str = env!("CARGO_PKG_VERSION");
    #[pymodule_export]
    const WINDOWS: u64 = shadowstep_scenes::run::Run::WINDOWS;
    #[pymodule_export]
    const LEAST_WINDOWS: u64 = shadowstep::shadow::Verdict::LEAST_WINDOWS;
}
