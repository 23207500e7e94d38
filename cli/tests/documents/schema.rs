//! The keys of scenes and sweeps, as `--explain` lists them.

use std::collections::BTreeSet;

/// A key with what is said about it.
pub(crate) struct Key {
    pub(crate) section: String,
    pub(crate) name: String,
    /// Its example, its meaning and its default.
    pub(crate) text: String,
}

/// What `shadowstep scene --explain` and `shadowstep sweep --explain` list.
pub(crate) fn keys() -> Vec<Key> {
    [shadowstep_scenes::explain(), shadowstep_studies::sweeps::explain()].iter().flat_map(|text| of(text)).collect()
}

fn of(text: &str) -> Vec<Key> {
    let (mut section, mut keys) = (String::new(), Vec::<Key>::new());
    for line in text.split("\nThe values of [keep]:").next().unwrap().lines() {
        let (indent, rest) = (line.len() - line.trim_start().len(), line.trim_start());
        match rest.split_once(" = ") {
            Some((name, example)) if indent == 2 => {
                keys.push(Key { section: section.clone(), name: name.to_owned(), text: example.to_owned() });
            }
            _ if indent > 2 => keys.last_mut().unwrap().text += &format!(" {rest}"),
            _ if rest.starts_with('[') && rest.ends_with(']') => section = rest.trim_matches(['[', ']']).to_owned(),
            _ => {}
        }
    }
    keys
}

impl Key {
    /// The words in quotes: those of a choice, as other values are formulas, paths or names.
    pub(crate) fn words(&self) -> BTreeSet<&str> {
        let is_word = |word: &str| word.len() > 2 && word.bytes().all(|byte| byte.is_ascii_lowercase() || byte == b'-');
        self.text.split('"').skip(1).step_by(2).filter(|word| is_word(word)).collect()
    }
}

/// The values that \[keep\] can have.
pub(crate) fn kept_values() -> Vec<String> {
    let text = shadowstep_studies::sweeps::explain();
    let (_, list) = text.split_once("The values of [keep]:\n").unwrap();
    list.lines().filter_map(|line| line.split_whitespace().next()).map(str::to_owned).collect()
}
