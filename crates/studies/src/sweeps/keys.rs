//! The keys of a sweep beside those of its scene: a row for each.

use shadowstep_scenes::schema::{
    CONDITION, FORMULA, Kind, NAME, NAMES, NUMBER, NUMBERS, PATH, Section, has_form, json_schema,
};
use shadowstep_scenes::{explanation, keys, rows};
use shadowstep_schemes::document::Reader;
use toml::de::DeTable;

use crate::sweeps::values::{NAMES_OF_VALUES, RunValue, VALUES};

const INTRODUCTION: &str = "\
A sweep is a TOML file: the sections of a scene, or `scene` with the path of one, and [axes], [keep] and [picture]. \
`shadowstep scene --explain` explains those of a scene; [output] can be left out. There is one run for each choice of \
a value on each axis; the last axis varies fastest.

The name of an axis stands for its value: in every number of the \
scene, as a parameter does, step = \"h\" or q = [\"1 - e\", 0]; and \"$scheme\" in place of a whole value, scheme = \
\"$scheme\" or steps = \"$n\".";

/// The most draws.
const MOST_DRAWS: u64 = 1_000_000_000_000;

/// The sections, and the keys before all of them.
const SECTIONS: [&Section; 4] = [&BEGINNING, &AXES, &KEEP, &PICTURE];

/// An axis: a list of numbers or of words, a range, or draws.
const AXIS: Kind =
    Kind::Any(&[Kind::List(&Kind::Any(&[NUMBER, Kind::Text("word")])), Kind::Text("range"), Kind::Table(&DRAWS)]);

pub(crate) const BEGINNING: Section = Section::new(
    "At the beginning, before all sections:",
    "The scene's file, and axes that advance together.",
    rows! {
        scene: PATH => "\"kepler.toml\"",
            "The path of the scene, relative to the folder of the sweep.",
            else "none; the sections of the scene are in the sweep";
        zip: Kind::List(&NAMES) => "[[\"h\", \"n\"]]",
            "Lists of axes that advance together; they need equally many values.",
            else "none; every value of an axis meets every value of the others";
    },
);

pub(crate) const AXES: Section = Section::new(
    "[axes]",
    "Names with their values, in one of these forms. Names are free, but for run, failure, t, E and pi.",
    rows! {
        e: AXIS => "[0, \"1/10\", 0.25]", "A list of exact numbers.", else "none";
        scheme: AXIS => "[\"yoshida4\", \"mine.toml\"]", "A list of words, for \"$scheme\".", else "none";
        h: AXIS => "\"1/10 … 1/100 in 19 steps of 1/h\"",
            "A range, also with ... in place of …: equal distances of the value, `of 1/h` of its reciprocal, `of \
             log(h)` of its logarithm. `in 20 values` counts values, `in 19 steps` what is between them. Values are \
             exact; those of logarithms are rounded to 12 digits, irrational ends to 30, and exact from there on.",
            else "none";
        phase: AXIS => "{ draws = 100, uniform = [0, \"2*pi\"], seed = 1 }",
            "Random draws, uniform = [a, b], log = [a, b] (whose logarithm is uniform) or normal = [mean, deviation]. \
             A draw depends on the seed, the name of the axis and its number only; it is rounded to 17 digits, and \
             exact from there on.",
            else "none";
    },
)
.with_names(&AXIS);

pub(crate) const DRAWS: Section = Section::new(
    "draws",
    "Random draws.",
    rows! {
        draws: Kind::Whole(1, MOST_DRAWS) => "100", "How many.";
        seed: Kind::Whole(0, u64::MAX) => "1", "The seed.";
        uniform: NUMBERS => "[0, \"2*pi\"]", "The least and the greatest \
            value.", else "none", excludes ["log", "normal"];
        log: NUMBERS => "[\"1e-6\", \"1e-3\"]", "The same of values whose logarithm is \
            uniform.", else "none", excludes ["normal"];
        normal: NUMBERS => "[0, \"1/10\"]", "The mean and the standard deviation.", else "none";
    },
)
.one_of("uniform|log|normal");

pub(crate) const KEEP: Section = Section::new(
    "[keep]",
    "What is kept of each run. Nothing else is computed.",
    rows! {
        values: Kind::List(&Kind::Word(&NAMES_OF_VALUES)) => "[\"verdict\", \"energy_error\"]", "Values that every \
            run has; see below.", else "none";
        state: Kind::Truth => "true", "Whether q and p of the last state are kept.", else "false";
        at_end: Kind::Names(&FORMULA) => "{ L = \"x*py - y*px\" }",
            "Formulas at the last state: in the coordinates, momenta and parameters, the axes, t and E.", else "none";
        min: Kind::Names(&FORMULA) => "{ closest = \"x^2 + y^2\" }", "The least values of formulas over all states of \
            the run.", else "none";
        max: Kind::Names(&FORMULA) => "{ E_max = \"E\" }", "The greatest values of formulas over all states of the \
            run.", else "none";
        first_time: Kind::Names(&CONDITION) => "{ escape = \"x^2 + y^2 > 100\" }",
            "Conditions, one comparison each. The value is the time of the first state that meets it, and nothing \
                where no state does.", else "none";
        stop: NAMES => "[\"escape\"]",
            "Names of first_time: a run ends at the first state that meets one of \
                them.", else "none", needs ["first_time"];
        rows: Kind::Truth => "true",
            "Whether the rows of the scene's [output] are kept, in rows.csv with the number of the run; each run is \
                made twice then.", else "false";
    },
);

pub(crate) const PICTURE: Section = Section::new(
    "[picture]",
    "A map of a value over two axes, or curves over one. It can be changed without computing anything again.",
    rows! {
        x: NAME => "\"h\"", "The axis in horizontal direction.", else "the first axis of numbers";
        y: NAME => "\"e\"", "The axis in vertical direction, for a map.", else "the next axis of numbers; without \
            one, curves are drawn";
        curves: NAME => "\"scheme\"",
            "The axis that has a curve for each value, in place of y.", else "the first axis of words", excludes ["y"];
        panels: NAME => "\"scheme\"",
            "The axis that has a map for each value, or a chart with the curves.", else "of maps, the first axis of words";
        value: NAME => "\"permanent_change\"", "What is drawn: a column of the results.", else "the first one with numbers";
        of_several: Kind::Word(&["mean", "largest", "least"]) => "\"largest\"",
            "What is shown of runs that differ in other axes only.", else "\"mean\"";
        scale: Kind::Word(&["linear", "log"]) => "\"log\"", "The scale of the values.", else "the one that suits the values";
        range: NUMBERS => "[1, 100]",
            "The values at the ends of a map's colours, which values beyond share.", else "the least and the largest value";
        title: Kind::Text("title") => "\"Permanent change\"", "The title.", else "the name of the sweep's file";
        label: Kind::Text("label") => "\"|change of the modified energy|\"", "What the value is called.", else "the \
            name of the column";
    },
);

/// Every key of a sweep with its meaning, and the values that can be kept.
///
/// ```
/// assert!(shadowstep_studies::sweeps::explain().contains("first_time = { escape = \"x^2 + y^2 > 100\" }"));
/// ```
pub fn explain() -> String {
    let mut text = explanation(INTRODUCTION, SECTIONS);
    text += "\nThe values of [keep]:\n";
    for RunValue { name, meaning, .. } in &VALUES {
        text += &format!("  {name:<22}{meaning}\n");
    }
    text
}

/// The JSON Schema of sweeps.
pub fn sweep_schema() -> String {
    let sections: Vec<&Section> = SECTIONS[1..].iter().copied().chain(keys::SECTIONS).collect();
    json_schema("A sweep of Shadowstep", BEGINNING.keys, &sections, &["axes", "keep"])
}

/// Whether the sections and keys that are not of the scene have what their rows say; faults are added to the reader.
pub(crate) fn have_form(reader: &mut Reader<'_>, root: &DeTable<'_>) -> bool {
    has_form(reader, root, &SECTIONS, section_with)
}

/// The heading of the section that has a key of this name.
fn section_with(name: &str) -> Option<&'static str> {
    let own = SECTIONS[2..].iter().find(|section| section.find(name).is_some());
    own.map(|section| section.heading).or_else(|| keys::section_with(name))
}
