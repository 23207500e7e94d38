//! The rows as a JSON Schema, with which editors complete and check documents.

use serde_json::{Map, Value, json};

use super::{Key, Kind, Section, Sign};

/// The schema of a document with these keys and sections, of which some are required.
pub fn json_schema(title: &str, keys: &[Key], sections: &[&'static Section], required: &[&str]) -> String {
    let mut properties = of_keys(keys);
    for section in sections {
        let table = of_section(section);
        let many = section.heading.starts_with("[[");
        let value = if many { json!({ "anyOf": [table, { "type": "array", "items": table }] }) } else { table };
        properties.insert(section.name().to_owned(), value);
    }
    let schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": title,
        "type": "object",
        "properties": properties,
        "required": required,
        "additionalProperties": false,
        "$defs": { "name": { "type": "string", "pattern": "^\\$", "description": "An axis or a column that stands for \
            the value." } },
    });
    format!("{schema:#}\n")
}

fn of_section(section: &Section) -> Value {
    let required: Vec<_> = section.keys.iter().filter(|key| key.default.is_none()).map(|key| key.name).collect();
    let mut all: Vec<Value> = section.keys.iter().flat_map(others).collect();
    if !section.one_of.is_empty() {
        all.extend(any_of(section.one_of));
    }
    let mut schema = json!({
        "type": "object",
        "description": section.meaning,
        "properties": of_keys(section.keys),
        "required": required,
        "additionalProperties": section.names.map_or(json!(false), of_kind),
    });
    if !all.is_empty() {
        schema["allOf"] = all.into();
    }
    schema
}

fn of_keys(keys: &[Key]) -> Map<String, Value> {
    keys.iter().map(|key| (key.name.to_owned(), of_key(key))).collect()
}

fn of_key(key: &Key) -> Value {
    let default = key.default.map_or("Required.".to_owned(), |default| format!("Default: {default}."));
    let mut schema = of_kind(&key.kind);
    let about = format!("{}\n\n{} = {}\n\n{default}", key.meaning, key.name, key.example);
    schema.as_object_mut().expect("it is an object").insert("description".to_owned(), json!(about));
    schema
}

fn of_kind(kind: &Kind) -> Value {
    let or_name = |schema: Value| json!({ "anyOf": [schema, { "$ref": "#/$defs/name" }] });
    match kind {
        Kind::Text(_) => json!({ "type": "string", "pattern": "\\S" }),
        Kind::Word(words) => or_name(json!({ "enum": words })),
        // what is very small is 0 for a validator
        Kind::Number(Sign::Positive) => json!({ "type": ["number", "string"], "minimum": 0, "pattern": "\\S" }),
        Kind::Number(_) => json!({ "type": ["number", "string"], "pattern": "\\S" }),
        Kind::Whole(least, most) => or_name(json!({ "type": "integer", "minimum": least, "maximum": most })),
        Kind::Truth => or_name(json!({ "type": "boolean" })),
        Kind::List(kind) => or_name(json!({ "type": "array", "items": of_kind(kind), "minItems": 1 })),
        Kind::Names(kind) => json!({ "type": "object", "additionalProperties": of_kind(kind) }),
        Kind::Table(section) => of_section(section),
        Kind::Any(kinds) => json!({ "anyOf": kinds.iter().map(of_kind).collect::<Vec<_>>() }),
    }
}

/// What a key needs and excludes in its own section.
fn others(key: &Key) -> Vec<Value> {
    if key.if_list {
        return Vec::new();
    }
    let needs = key.needs.iter().filter_map(|need| any_of(need));
    let excludes = key.excludes.iter().filter_map(|other| Some(json!({ "not": any_of(other)? })));
    needs.chain(excludes).map(|schema| json!({ "dependentSchemas": { key.name: schema } })).collect()
}

/// That one of these keys is there; `None` where they are not all of the section itself.
fn any_of(keys: &str) -> Option<Value> {
    let required = |key: &str| match key.strip_suffix("[]") {
        Some(list) => Some(json!({ "required": [list], "properties": { list: { "type": "array" } } })),
        None => (!key.contains(['[', '.'])).then(|| json!({ "required": [key] })),
    };
    let any = keys.split('|').map(required).collect::<Option<Vec<_>>>()?;
    Some(json!({ "anyOf": any }))
}
