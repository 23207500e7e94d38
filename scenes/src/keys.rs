//! The keys of a scene: what they mean is said here only, for `--explain`, for messages and for the shipped scenes.

use shadowstep_symbolic::nearest;

/// A section of a scene, or the table that a key of a section may be.
pub struct Section {
    /// As TOML has it: `output`, `output.energy`.
    pub name: &'static str,
    /// What it is about.
    pub meaning: &'static str,
}

/// A key of a section.
pub struct Key {
    /// The section's name.
    pub section: &'static str,
    /// Its own name.
    pub name: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// A value as it is written.
    pub example: &'static str,
    /// What holds where the key is left out; `None` where it cannot be.
    pub default: Option<&'static str>,
}

/// All sections, in the order in which they are explained.
pub const SECTIONS: [Section; 7] = [
    section(
        "problem",
        "What moves: H = T(p) + U(q). U is a shipped problem's, or a formula in coordinates, or a sum over pairs of bodies.",
    ),
    section("initial", "The state at t = 0."),
    section("run", "The steps, and the numbers they are made with."),
    section("output", "What is written down. What is not asked for is not computed."),
    section("output.energy", "When the energy is written, in place of `energy = true`."),
    section("output.modified_energy", "How and when the modified energy is, in place of `modified_energy = true`."),
    section("output.trajectory", "When positions and momenta are, in place of `trajectory = true`."),
];

/// All keys, section by section.
pub const KEYS: [Key; 35] = [
    key(
        "problem",
        "name",
        "A shipped problem; `shadowstep problems` lists them.",
        "\"kepler\"",
        Some("none: there is a `potential` or a `pair`"),
    ),
    key(
        "problem",
        "potential",
        "U(q), a smooth formula in the coordinates and parameters. Its gradient is derived.",
        "\"-1/sqrt(x^2 + y^2)\"",
        Some("none: there is a `name` or a `pair`"),
    ),
    key(
        "problem",
        "pair",
        "The energy of two bodies i and j, of which U is the sum over all pairs: a smooth formula in `r2`, the square of \
         their distance, or on a line in `d`, which is q_j - q_i; in the parameters, and in properties of both bodies. \
         Coordinates are called x1, y1, z1, x2, …, momenta px1, py1, …, and on a line q1, q2, …, p1, p2, ….",
        "\"-g*m_i*m_j/sqrt(r2)\"",
        Some("none: there is a `name` or a `potential`"),
    ),
    key(
        "problem",
        "bodies",
        "For `pair`: how many bodies there are, as in `bodies = 32`, or a table of their properties, each with a list of \
         one value for each body; the property m is `m_i` and `m_j` in the formula. A formula in quotes may stand for \
         the list: its values are those at i = 1, 2, …, and it may use the properties before it. Where all are \
         formulas, the number of bodies is said by `count`: { count = 32, m = \"1 + i/32\" }.",
        "{ m = [1, \"1/1000\", 2] }",
        Some("none; with `pair` it is needed"),
    ),
    key(
        "problem",
        "dimensions",
        "For `pair`: 1, 2 or 3.",
        "3",
        Some("1 for a formula in `d`; for one in `r2` it is needed"),
    ),
    key(
        "problem",
        "neighbours",
        "Makes the bodies a chain, in which each is paired with the next one only. Its ends are \"free\", \"fixed\" (the \
         first and the last body are paired with walls at rest at 0, and bodies have no properties), or \"periodic\" (a \
         ring: the last body is paired with the first).",
        "\"fixed\"",
        Some("none: all bodies are paired with one another"),
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
        "Values by name, for formulas or of the shipped problem. Each may use those before it; masses, state, step \
         and times may use them all.",
        "{ depth = 2, width = \"depth/3\" }",
        Some("those of the shipped problem, else none"),
    ),
    key(
        "problem",
        "masses",
        "The m_i of T = p_1^2/(2 m_1) + p_2^2/(2 m_2) + …, one for each coordinate. With `pair` there is one \
         for each body, or a formula for all, as among the `bodies`: masses = \"m\" takes the property m.",
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
        "Positions, one for each coordinate. With `pair` there may be a list for each body, [[0, 0, 0], [1, 0, 0]]; and \
         on a line a formula for all bodies, \"sin(i*pi/33)\", in the number i of the body and its properties.",
        "[\"1 - 0.6\", 0]",
        Some("those of the shipped problem; else they are needed"),
    ),
    key(
        "initial",
        "p",
        "Momenta, written as q is.",
        "[0, \"sqrt((1 + 0.6)/(1 - 0.6))\"]",
        Some("those of the shipped problem; else they or `v` are needed"),
    ),
    key(
        "initial",
        "v",
        "Velocities in place of momenta, p_i = m_i v_i; not with `kinetic`.",
        "[0, 2]",
        Some("none: there are momenta"),
    ),
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
         name only when it is complete. One of that name is replaced if it is from this very scene, else by --restart \
         only.",
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
        "The modified energy, as columns `modified_energy`, `estimate` (of its error, also near close encounters; \
         empty for order = 1, where none can be relied on) and `order` (the m or k used): true, or a table.",
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
         stopped goes on from there when the scene is run again, and its file has the same bytes; a \
         scene that was changed, were it a comment, is another one. It needs a `file`.",
        "\"1 min\"",
        Some("none: a run that is stopped leaves nothing"),
    ),
    key("output.energy", "every", "It is written at each n that is a multiple of this.", "10", Some("1")),
    key("output.modified_energy", "every", "It is written at each n that is a multiple of this.", "10", Some("1")),
    key(
        "output.modified_energy",
        "estimator",
        "\"central\" for central differences D_m of 2m + 1 states, or \"bilinear\" for products of k + 1 states in pairs, \
         which finds more from fewer states.",
        "\"bilinear\"",
        Some("\"central\""),
    ),
    key(
        "output.modified_energy",
        "order",
        "The m of D_m or the k of the bilinear estimator, which is even; or \"auto\" for the best one of each state.",
        "40",
        Some("\"auto\""),
    ),
    key(
        "output.modified_energy",
        "max_order",
        "The largest m or k that \"auto\" tries.",
        "100",
        Some("200 for central differences, 64 for the bilinear estimator"),
    ),
    key(
        "output.modified_energy",
        "stop",
        "When \"auto\" stops trying m: \"full\" at the largest, \"early\" where the errors rise.",
        "\"early\"",
        Some("\"full\""),
    ),
    key(
        "output.modified_energy",
        "rule",
        "Which m \"auto\" takes: \"least\" that with the least term |T_m - T_(m-1)|, \"robust\" that with the least largest of \
         ten terms about it, which none makes small by chance.",
        "\"robust\"",
        Some("\"least\""),
    ),
    key(
        "output.modified_energy",
        "accuracy",
        "For estimator = \"bilinear\": the largest error wanted; \"auto\" takes the least k for it, and where there is none the \
         best. The column `estimate` tells.",
        "1e-20",
        Some("none: the best that can be had"),
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
pub fn of(section: &str) -> impl Iterator<Item = &'static Key> + Clone {
    KEYS.iter().filter(move |key| key.section == section)
}

/// What a key means.
pub fn find(section: &str, name: &str) -> Option<&'static Key> {
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
