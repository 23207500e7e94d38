//! The keys of a sweep with their meanings: the one place for `--explain` and messages.

use shadowstep_scenes::explanation;
use shadowstep_scenes::keys::{Key, Section, key, section};
use shadowstep_schemes::document;

use crate::values::{Description, VALUES};

const INTRODUCTION: &str = "\
A sweep is a TOML file: the sections of a scene, or `scene` with the path of one, and [axes], [keep] and [picture]. `shadowstep scene \
--explain` explains those of a scene; [output] can be left out. There is one run for each choice of a value on each axis; the last axis \
varies fastest.

The name of an axis stands for its value: in every number of the scene, as a parameter does, step = \"h\" or q = [\"1 - e\", 0]; and \
\"$scheme\" in place of a whole value, scheme = \"$scheme\" or steps = \"$n\".";

const SECTIONS: [Section; 4] = [
    section("", "At the beginning, before all sections:", "The scene's file, and axes that advance together."),
    section(
        "axes",
        "[axes]",
        "Names with their values, in one of these forms. Names are free, but for run, failure, t, E and pi.",
    ),
    section("keep", "[keep]", "What is kept of each run. Nothing else is computed."),
    section(
        "picture",
        "[picture]",
        "A map of a value over two axes, or curves over one. It can be changed without computing anything again.",
    ),
];

const KEYS: [Key; 24] = [
    key(
        "",
        "scene",
        "The path of the scene, relative to the folder of the sweep.",
        "\"kepler.toml\"",
        Some("none; the sections of the scene are in the sweep"),
    ),
    key(
        "",
        "zip",
        "Lists of axes that advance together; they need equally many values.",
        "[[\"h\", \"n\"]]",
        Some("none; every value of an axis meets every value of the others"),
    ),
    key("axes", "e", "A list of exact numbers.", "[0, \"1/10\", 0.25]", Some("none")),
    key("axes", "scheme", "A list of words, for \"$scheme\".", "[\"yoshida4\", \"mine.toml\"]", Some("none")),
    key(
        "axes",
        "h",
        "A range, also with ... in place of …: equal distances of the value, `of 1/h` of its reciprocal, `of log(h)` of its \
         logarithm. `in 20 values` counts values, `in 19 steps` what is between them. Values are exact; those of logarithms are rounded to 12 \
         digits, irrational ends to 30, and exact from there on.",
        "\"1/10 … 1/100 in 19 steps of 1/h\"",
        Some("none"),
    ),
    key(
        "axes",
        "phase",
        "Random draws, uniform = [a, b], log = [a, b] (whose logarithm is uniform) or normal = [mean, deviation]. A draw depends on the \
         seed, the name of the axis and its number only; it is rounded to 17 digits, and exact from there on.",
        "{ draws = 100, uniform = [0, \"2*pi\"], seed = 1 }",
        Some("none"),
    ),
    key("keep", "values", "Values that every run has; see below.", "[\"verdict\", \"energy_error\"]", Some("none")),
    key("keep", "state", "Whether q and p of the last state are kept.", "true", Some("false")),
    key(
        "keep",
        "at_end",
        "Formulas at the last state: in the coordinates, momenta and parameters, the axes, t and E.",
        "{ L = \"x*py - y*px\" }",
        Some("none"),
    ),
    key(
        "keep",
        "min",
        "The least values of formulas over all states of the run.",
        "{ closest = \"x^2 + y^2\" }",
        Some("none"),
    ),
    key(
        "keep",
        "max",
        "The greatest values of formulas over all states of the run.",
        "{ E_max = \"E\" }",
        Some("none"),
    ),
    key(
        "keep",
        "first_time",
        "Conditions, one comparison each. The value is the time of the first state that meets it, and nothing where no state does.",
        "{ escape = \"x^2 + y^2 > 100\" }",
        Some("none"),
    ),
    key(
        "keep",
        "stop",
        "Names of first_time: a run ends at the first state that meets one of them.",
        "[\"escape\"]",
        Some("none"),
    ),
    key(
        "keep",
        "rows",
        "Whether the rows of the scene's [output] are kept, in rows.csv with the number of the run; each run is made twice then.",
        "true",
        Some("false"),
    ),
    key("picture", "x", "The axis in horizontal direction.", "\"h\"", Some("the first axis of numbers")),
    key(
        "picture",
        "y",
        "The axis in vertical direction, for a map.",
        "\"e\"",
        Some("the next axis of numbers; without one, curves are drawn"),
    ),
    key(
        "picture",
        "curves",
        "The axis that has a curve for each value, in place of y.",
        "\"scheme\"",
        Some("the first axis of words"),
    ),
    key(
        "picture",
        "panels",
        "The axis that has a map for each value, or a chart with the curves.",
        "\"scheme\"",
        Some("of maps, the first axis of words"),
    ),
    key(
        "picture",
        "value",
        "What is drawn: a column of the results.",
        "\"permanent_change\"",
        Some("the first one with numbers"),
    ),
    key(
        "picture",
        "of_several",
        "What is shown of runs that differ in other axes only: \"mean\", \"largest\" or \"least\".",
        "\"largest\"",
        Some("\"mean\""),
    ),
    key(
        "picture",
        "scale",
        "The scale of the values, \"linear\" or \"log\".",
        "\"log\"",
        Some("the one that suits the values"),
    ),
    key(
        "picture",
        "range",
        "The values at the ends of a map's colours, which values beyond share.",
        "[1, 100]",
        Some("the least and the largest value"),
    ),
    key("picture", "title", "The title.", "\"Permanent change\"", Some("the name of the sweep's file")),
    key(
        "picture",
        "label",
        "What the value is called.",
        "\"|change of the modified energy|\"",
        Some("the name of the column"),
    ),
];

/// Every key of a sweep with its meaning, and the values that can be kept.
///
/// ```
/// assert!(shadowstep_sweeps::explain().contains("first_time = { escape = \"x^2 + y^2 > 100\" }"));
/// ```
pub fn explain() -> String {
    let mut text = explanation(INTRODUCTION, &SECTIONS, &KEYS);
    text += "\nThe values of [keep]:\n";
    for Description { name, meaning, .. } in &VALUES {
        text += &format!("  {name:<22}{meaning}\n");
    }
    text
}

/// The keys of a section, for the reader of documents.
pub(crate) fn of(section: &'static str) -> document::Keys {
    let heading = SECTIONS.iter().find(|known| known.name == section).map_or("a sweep", |known| known.heading);
    let keys = KEYS.iter().filter(|key| key.section == section);
    document::Keys::new(heading, keys.map(|key| document::Key::new(key.name, key.example)))
}
