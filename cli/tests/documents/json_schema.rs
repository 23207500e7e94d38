//! The JSON Schemas of scenes and sweeps, by a validator that shares no code with them; and what reading takes from
//! documents.

use std::fs;
use std::path::Path;

use boon::{Compiler, Draft, SchemaIndex, Schemas};
use rayon::prelude::*;
use serde_json::{Map, Value, json};
use shadowstep_scenes::schema::Section;
use shadowstep_scenes::{SHIPPED_SCENES, Scene, ensemble::Ensemble, keys, scene_text};
use shadowstep_schemes::document::{Source, document};
use shadowstep_studies::sweeps::SweepPlan;
use toml::de::{DeTable, DeValue};

use crate::document::NAME;

/// A schema that is ready.
struct Validator(Schemas, SchemaIndex);

impl Validator {
    fn of(schema: &str) -> Validator {
        let (mut schemas, mut compiler) = (Schemas::new(), Compiler::new());
        compiler.set_default_draft(Draft::V2020_12);
        compiler.add_resource("schema.json", serde_json::from_str(schema).unwrap()).unwrap();
        let index = compiler.compile("schema.json", &mut schemas).unwrap();
        Validator(schemas, index)
    }

    fn fault(&self, document: &Value) -> Option<String> {
        self.0.validate(document, self.1).err().map(|fault| format!("{fault:#}"))
    }
}

/// A document as JSON, as editors read it.
fn json_of(text: &str) -> Value {
    let source = Source { path: NAME.to_owned(), text: text.to_owned() };
    let (table, faults) = document(&source);
    assert!(faults.is_empty(), "{faults:?}");
    of_table(&table.unwrap())
}

fn of_table(table: &DeTable<'_>) -> Value {
    table
        .iter()
        .map(|(key, value)| (key.get_ref().to_string(), of_value(value.get_ref())))
        .collect::<Map<_, _>>()
        .into()
}

fn of_value(value: &DeValue<'_>) -> Value {
    match value {
        DeValue::String(text) => json!(text),
        DeValue::Integer(number) => json!(i64::from_str_radix(number.as_str(), number.radix()).unwrap_or(i64::MAX)),
        DeValue::Float(number) => json!(number.as_str().parse::<f64>().unwrap()),
        DeValue::Boolean(truth) => json!(truth),
        DeValue::Datetime(date) => json!(date.to_string()),
        DeValue::Array(members) => members.iter().map(|member| of_value(member.get_ref())).collect(),
        DeValue::Table(table) => of_table(table),
    }
}

#[test]
fn shipped_documents_are_valid() {
    let scenes = Validator::of(&shadowstep_scenes::scene_schema());
    let shipped = SHIPPED_SCENES.iter().flat_map(|(_, scenes)| scenes.iter()).map(|scene| scene.text.to_owned());
    let problems = shadowstep::problems::PROBLEMS.iter().map(|problem| scene_text(problem.name()).unwrap());
    for text in shipped.chain(problems) {
        assert_eq!(scenes.fault(&json_of(&text)), None, "{text}");
    }
    let sweeps = Validator::of(&shadowstep_studies::sweeps::sweep_schema());
    for sweep in fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/sweeps")).unwrap() {
        let text = fs::read_to_string(sweep.unwrap().path()).unwrap();
        assert_eq!(sweeps.fault(&json_of(&text)), None, "{text}");
    }
}

/// Whether the program reads the document of a number.
fn is_read(source: Source, number: u64) -> bool {
    match number.is_multiple_of(5) {
        true => SweepPlan::of(&source).is_ok(),
        false if Ensemble::is_in(&source) => Ensemble::read(source).is_ok(),
        false => Scene::read(source).is_ok(),
    }
}

/// What reading takes from a document is there: a missing line is a fault, or not needed.
#[test]
fn documents_that_lack_a_line_are_read_or_refused() {
    super::TESTED.into_par_iter().filter(|number| number.is_multiple_of(4)).for_each(|number| {
        let lines = &super::document(number).files[0].lines;
        for missing in 0..lines.len() {
            let rest = [&lines[..missing], &lines[missing + 1..]].concat();
            is_read(Source { path: NAME.to_owned(), text: rest.join("\n") }, number);
        }
    });
}

/// What the program reads is valid.
#[test]
fn random_documents_that_are_read_are_valid() {
    let [scenes, sweeps] = [shadowstep_scenes::scene_schema(), shadowstep_studies::sweeps::sweep_schema()]
        .map(|schema| Validator::of(&schema));
    let mut read = 0;
    for number in super::TESTED {
        let folder = tempfile::tempdir().unwrap();
        let document = super::document(number);
        document.write(folder.path());
        let path = folder.path().join(NAME);
        let text = fs::read_to_string(&path).unwrap();
        let source = Source { path: path.display().to_string(), text: text.clone() };
        if is_read(source, number) {
            read += 1;
            let fault = if number.is_multiple_of(5) { &sweeps } else { &scenes }.fault(&json_of(&text));
            assert_eq!(fault, None, "document {number}:\n{text}");
        }
    }
    assert!(read > 200, "{read} documents were read");
}

#[test]
fn documents_with_a_wrong_or_unknown_key_are_invalid() {
    let scenes = Validator::of(&shadowstep_scenes::scene_schema());
    let valid = json!({ "problem": { "name": "kepler" } });
    assert_eq!(scenes.fault(&valid), None);
    let with = |heading: &str, key: &str, value: Value| {
        let mut document = valid.clone();
        let mut within = &mut document;
        for name in heading.trim_matches(['[', ']']).split('.') {
            if within.get(name).is_none() {
                within[name] = json!({});
            }
            within = &mut within[name];
        }
        within[key] = value;
        document
    };
    let all = keys::SECTIONS.into_iter().flat_map(|section| [section].into_iter().chain(section.tables()));
    for Section { heading, keys, names, .. } in all {
        for key in *keys {
            let document = with(heading, key.name, json!({ "?": [[[]]] }));
            assert!(scenes.fault(&document).is_some(), "{document}");
        }
        let unknown = with(heading, "frobnicate", json!([[[]]]));
        assert!(scenes.fault(&unknown).is_some(), "{unknown}");
        assert!(names.is_some() || scenes.fault(&with(heading, "frobnicate", json!("x"))).is_some(), "{heading}");
    }
}
