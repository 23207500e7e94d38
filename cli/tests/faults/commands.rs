//! The commands that are disturbed. One line adds another.

/// A command whose files must not depend on how often it was stopped.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Disturbed {
    pub(crate) name: &'static str,
    /// The command line; FOLDER is where it writes.
    pub(crate) words: &'static str,
    /// The scene, if it runs one: FOLDER/scene.toml.
    pub(crate) scene: &'static str,
    /// Whether it is resumed, so that a command that is always stopped comes to its end.
    pub(crate) resumes: bool,
}

pub(crate) const COMMANDS: &[Disturbed] = &[
    Disturbed { name: "run", words: RUN, scene: PLAIN, resumes: true },
    Disturbed { name: "run with modified energies", words: RUN, scene: SHADOWED, resumes: true },
    Disturbed { name: "run without checkpoints", words: RUN, scene: UNSAVED, resumes: false },
    Disturbed { name: "trace", words: TRACE, scene: "", resumes: false },
    Disturbed { name: "figures", words: "figures reliability --quick --out FOLDER", scene: "", resumes: true },
    Disturbed { name: "stability", words: STABILITY, scene: "", resumes: true },
    Disturbed { name: "sweep", words: "sweep FOLDER/scene.toml --out FOLDER", scene: SWEEP, resumes: true },
];

/// Its checkpoints are made by the clock.
pub(crate) const TIMED: Disturbed =
    Disturbed { name: "run by the clock", words: RUN, scene: BY_THE_CLOCK, resumes: true };

const RUN: &str = "run FOLDER/scene.toml --no-summary";

const STABILITY: &str = "stability frames --schemes stormer-verlet --quick --out FOLDER";

const TRACE: &str = "trace pendulum --scheme ruth3 --step 1/10 --until 30 --double --order 4 --no-summary --force \
                     --output FOLDER/out.jsonl --plot FOLDER/out.svg";

const PLAIN: &str = r#"
[problem]
name = "kepler"
[run]
scheme = "stormer-verlet"
step = "1/100"
steps = 20000
digits = "double"
[output]
energy = { every = 30 }
trajectory = { every = 70 }
file = "out.csv"
checkpoint = 1500
plot = { file = "out.svg", of = ["energies", "orbit=x:y"] }
"#;

const SHADOWED: &str = r#"
[problem]
name = "pendulum"
[run]
scheme = "yoshida4"
step = "1/20"
steps = 600
digits = 40
[output]
modified_energy = { order = "auto", max_order = 12 }
energy = { every = 7 }
file = "out.jsonl"
checkpoint = 50
"#;

const UNSAVED: &str = r#"
[problem]
name = "henon-heiles"
[run]
scheme = "pefrl"
step = "1/10"
steps = 3000
digits = "double"
[output]
trajectory = true
file = "out.jsonl"
"#;

const SWEEP: &str = r#"
[problem]
name = "kepler"
parameters.eccentricity = "e"
[run]
scheme = "stormer-verlet"
step = "h"
until = 10
digits = "double"
[output]
energy = { every = 100 }
[axes]
e = "0 … 1 in 5 steps"
h = "1/20 … 1/100 in 6 steps of 1/h"
[keep]
values = ["energy_error"]
rows = true
"#;

const BY_THE_CLOCK: &str = r#"
[problem]
name = "kepler"
[run]
scheme = "stormer-verlet"
step = "1/100"
steps = 20000
digits = "double"
[output]
trajectory = { every = 70 }
file = "out.csv"
checkpoint = "5 min"
"#;
