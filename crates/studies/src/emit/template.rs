//! Templates: text with places to fill in, and lines that are left out.
//!
//! `‹name›` stands for a value. Alone on a line it may stand for several lines, which are indented as it is, or for
//! none. Lines between `‹if name›` or `‹if not name›` and `‹end›` are there if the condition is true.

use std::collections::BTreeMap;

/// What a template is filled with.
#[derive(Debug, Default)]
pub(crate) struct Values {
    texts: BTreeMap<&'static str, String>,
    conditions: BTreeMap<&'static str, bool>,
}

impl Values {
    pub(crate) fn text(&mut self, name: &'static str, value: impl Into<String>) -> &mut Self {
        self.texts.insert(name, value.into());
        self
    }

    pub(crate) fn lines(&mut self, name: &'static str, lines: impl IntoIterator<Item = String>) -> &mut Self {
        self.text(name, lines.into_iter().collect::<Vec<_>>().join("\n"))
    }

    pub(crate) fn condition(&mut self, name: &'static str, holds: bool) -> &mut Self {
        self.conditions.insert(name, holds);
        self
    }

    /// The template with the values in their places.
    ///
    /// # Panics
    /// If the template has a name without a value, which the tests of all targets exclude.
    pub(crate) fn fill(&self, template: &str) -> String {
        let mut text = String::new();
        let mut shown = vec![true];
        for line in template.lines() {
            match line.trim().strip_prefix('‹').and_then(|rest| rest.strip_suffix('›')) {
                Some("end") => {
                    shown.pop();
                }
                Some(name) if name.starts_with("if ") => {
                    let holds = self.holds(&name[3..]);
                    shown.push(holds && shown.iter().all(|shown| *shown));
                }
                _ if !shown.iter().all(|shown| *shown) => {}
                Some(name) if !name.contains('‹') => {
                    let indent = &line[..line.len() - line.trim_start().len()];
                    self.value(name).lines().for_each(|line| push_line(&mut text, indent, line));
                }
                _ => push_line(&mut text, "", &self.replaced(line)),
            }
        }
        text
    }

    fn holds(&self, condition: &str) -> bool {
        let (name, wanted) = condition.strip_prefix("not ").map_or((condition, true), |name| (name, false));
        self.conditions.get(name).unwrap_or_else(|| panic!("a template asks for `{name}`")) == &wanted
    }

    fn value(&self, name: &str) -> &str {
        self.texts.get(name).unwrap_or_else(|| panic!("a template has ‹{name}›"))
    }

    /// A line with the values in it.
    fn replaced(&self, line: &str) -> String {
        let mut parts = line.split('‹');
        let mut text = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            let (name, rest) = part.split_once('›').expect("a place ends");
            text.push_str(self.value(name));
            text.push_str(rest);
        }
        text
    }
}

fn push_line(text: &mut String, indent: &str, line: &str) {
    if !line.is_empty() {
        text.push_str(indent);
        text.push_str(line);
    }
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_lines_and_conditions() {
        let mut values = Values::default();
        values.text("a", "1").lines("b", ["x".to_owned(), String::new(), "y".to_owned()]).lines("none", []);
        values.condition("yes", true).condition("no", false);
        let template = "‹a› + ‹a›\n  ‹b›\n‹none›\n‹if yes›\nyes\n‹if no›\nno\n‹end›\n‹if not no›\nnot \
            no\n‹end›\n‹end›\n‹if no›\n‹if yes›\nno\n‹end›\nno\n‹end›\nend";
        assert_eq!(values.fill(template), "1 + 1\n  x\n\n  y\nyes\nnot no\nend\n");
    }
}
