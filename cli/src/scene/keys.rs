//! The keys of a scene: what they mean is said here only, for `--explain`, for messages and for the shipped scenes.

use shadowstep_symbolic::nearest;

/// A section of a scene, or the table that a key of a section may be.
pub(crate) struct Section {
    /// As TOML has it: `output`, `output.energy`.
    pub(crate) name: &'static str,
    pub(crate) meaning: &'static str,
}

/// A key of a section.
pub(crate) struct Key {
    pub(crate) section: &'static str,
    pub(crate) name: &'static str,
    pub(crate) meaning: &'static str,
    /// A value as it is written.
    pub(crate) example: &'static str,
    /// What holds where the key is left out; `None` where it cannot be.
    pub(crate) default: Option<&'static str>,
}

pub(crate) const SECTIONS: [Section; 7] = [
    section("problem", "What moves: H = T(p) + U(q), either a shipped problem or a potential of your own."),
    section("initial", "The state at t = 0."),
    section("run", "The steps, and the numbers they are made with."),
    section("output", "What is written down. What is not asked for is not computed."),
    section("output.energy", "When the energy is written, in place of `energy = true`."),
    section("output.modified_energy", "How and when the modified energy is, in place of `modified_energy = true`."),
    section("output.trajectory", "When positions and momenta are, in place of `trajectory = true`."),
];

pub(crate) const KEYS: [Key; 28] = [
    key(
        "problem",
        "name",
        "A shipped problem; `shadowstep problems` lists them.",
        "\"kepler\"",
        Some("none: there is a `potential`"),
    ),
    key(
        "problem",
        "potential",
        "U(q), a smooth formula in the coordinates and parameters. Its gradient is derived.",
        "\"-1/sqrt(x^2 + y^2)\"",
        Some("none: there is a `name`"),
    ),
    key(
        "problem",
        "coordinates",
        "Names of q_1, q_2, … for `potential`.",
        "[\"x\", \"y\"]",
        Some("none; a shipped problem has its own"),
    ),
    key(
        "problem",
        "parameters",
        "Values by name, for `potential` or of the shipped problem. Each may use those before it; masses, state, step \
         and times may use them all.",
        "{ depth = 2, width = \"depth/3\" }",
        Some("those of the shipped problem, else none"),
    ),
    key(
        "problem",
        "masses",
        "The m_i of T = p_1^2/(2 m_1) + p_2^2/(2 m_2) + …, one for each coordinate.",
        "[1, \"1/1000\"]",
        Some("all are 1"),
    ),
    key(
        "problem",
        "kinetic",
        "T(p), a smooth formula in the momenta and parameters, in place of `masses`. Where it is not quadratic in p, the \
         scheme must be one for every T(p).",
        "\"sqrt(1 + px^2 + py^2)\"",
        Some("p_1^2/(2 m_1) + p_2^2/(2 m_2) + …"),
    ),
    key(
        "problem",
        "momenta",
        "Names of p_1, p_2, … for `kinetic` and the output, one for each of the `coordinates`.",
        "[\"px\", \"py\"]",
        Some("the momentum of x is called px"),
    ),
    key(
        "initial",
        "q",
        "Positions, one for each coordinate.",
        "[\"1 - 0.6\", 0]",
        Some("those of the shipped problem; with a `potential` they are needed"),
    ),
    key(
        "initial",
        "p",
        "Momenta, one for each coordinate.",
        "[0, \"sqrt((1 + 0.6)/(1 - 0.6))\"]",
        Some("those of the shipped problem; with a `potential` they or `v` are needed"),
    ),
    key("initial", "v", "Velocities in place of momenta: p_i = m_i v_i.", "[0, 2]", Some("none: there are momenta")),
    key(
        "run",
        "scheme",
        "A shipped scheme, or the file of a table, seen from the scene's folder. `shadowstep schemes` lists the shipped \
         ones.",
        "\"yoshida4\"",
        None,
    ),
    key("run", "first", "Whether a step begins with a \"kick\" or a \"drift\".", "\"drift\"", Some("as in the table")),
    key("run", "step", "The step size h; negative to go back in time.", "\"1/20\"", None),
    key(
        "run",
        "until",
        "The time at which the run ends, or just before it if it is no multiple of h.",
        "100",
        Some("none: there are `steps`"),
    ),
    key("run", "steps", "How many steps are made, in place of `until`.", "2000", Some("none: there is `until`")),
    key("run", "digits", "Decimal digits of all numbers, or \"double\" for double precision.", "120", Some("120")),
    key(
        "output",
        "file",
        "Where rows go, seen from the scene's folder: .csv, whose head is of lines with #, as in \
         pandas.read_csv(file, comment=\"#\"), or .jsonl, JSON lines of which the first is the head. The file has its \
         name only when it is complete.",
        "\"kepler.csv\"",
        Some("none: rows go to stdout"),
    ),
    key(
        "output",
        "format",
        "\"csv\" or \"jsonl\", whatever the file is called.",
        "\"jsonl\"",
        Some("by the file's name; \"csv\" on stdout"),
    ),
    key("output", "energy", "H, as a column `energy`: true, or a table.", "{ every = 10 }", Some("false")),
    key(
        "output",
        "modified_energy",
        "The modified energy by central differences, as columns `modified_energy`, `estimate` (of its error, no bound) \
         and `order` (the m of D_m): true, or a table.",
        "{ order = \"auto\", max_order = 100 }",
        Some("false"),
    ),
    key(
        "output",
        "trajectory",
        "Positions and momenta, as columns x, y, …, px, py, …: true, or a table.",
        "{ every = 100 }",
        Some("false"),
    ),
    key(
        "output",
        "checkpoint",
        "How often the run saves all it needs to go on: a time in s, min or h, or a number of steps. A run that was \
         stopped goes on from there when the scene is run again, and its file has the same bytes. It needs a `file`.",
        "\"1 min\"",
        Some("none: a run that is stopped leaves nothing"),
    ),
    key("output.energy", "every", "It is written at each n that is a multiple of this.", "10", Some("1")),
    key("output.modified_energy", "every", "It is written at each n that is a multiple of this.", "10", Some("1")),
    key(
        "output.modified_energy",
        "order",
        "The m of D_m, or \"auto\" for the best m of each state.",
        "40",
        Some("\"auto\""),
    ),
    key("output.modified_energy", "max_order", "The largest m that \"auto\" tries.", "100", Some("200")),
    key(
        "output.modified_energy",
        "stop",
        "When \"auto\" stops trying: \"full\" at the largest m, \"early\" where the errors rise.",
        "\"early\"",
        Some("\"full\""),
    ),
    key("output.trajectory", "every", "They are written at each n that is a multiple of this.", "100", Some("1")),
];

const fn section(name: &'static str, meaning: &'static str) -> Section {
    Section { name, meaning }
}

const fn key(
    section: &'static str,
    name: &'static str,
    meaning: &'static str,
    example: &'static str,
    default: Option<&'static str>,
) -> Key {
    Key { section, name, meaning, example, default }
}

/// The keys of a section.
pub(crate) fn of(section: &str) -> impl Iterator<Item = &'static Key> + Clone {
    KEYS.iter().filter(move |key| key.section == section)
}

/// What a key means.
pub(crate) fn find(section: &str, name: &str) -> Option<&'static Key> {
    of(section).find(|key| key.name == name)
}

/// The key that is spelt most like a word.
pub(crate) fn near(section: &str, word: &str) -> Option<&'static str> {
    nearest(word, of(section).map(|key| key.name))
}

/// What may be meant by a word that is no key of this section.
pub(crate) fn hint(section: &str, word: &str) -> String {
    if let Some(near) = near(section, word) {
        return format!("did you mean `{near}`?");
    }
    let names: Vec<&str> = of(section).map(|key| key.name).collect();
    match KEYS.iter().find(|key| key.name == word) {
        Some(elsewhere) => format!("`{word}` is a key of [{}]", elsewhere.section),
        None => format!("the keys of [{section}] are {}", names.join(", ")),
    }
}
