//! The table of a form: which weights there are, and which are the same.

use shadowstep_schemes::{First, Kinetic, Source};

use crate::search::request::Request;

/// The names of the weights of a form, in the order of the table's text.
pub(super) struct Form<'a> {
    request: &'a Request,
    lists: Vec<(&'static str, Vec<String>)>,
    /// Those of the processor.
    post: Vec<(&'static str, Vec<String>)>,
    names: Vec<String>,
}

impl<'a> Form<'a> {
    /// The form of a number of stages.
    pub(super) fn of(request: &'a Request, stages: usize) -> Form<'a> {
        let list = |letter: char, count: usize| -> Vec<String> {
            let number = |i: usize| 1 + if request.symmetric { i.min(count - 1 - i) } else { i };
            (0..count).map(|i| format!("{letter}{}", number(i))).collect()
        };
        let zero = || vec!["0".to_owned()];
        let lists = match (&request.base, request.first) {
            (Some(_), _) => vec![("gamma", list('g', stages))],
            (None, First::Kick) => {
                let gradient = ("gradient_kick", list('c', stages + 1));
                let lists = [("kick", list('a', stages + 1)), ("drift", [list('b', stages), zero()].concat())];
                lists.into_iter().chain(request.gradient_kicks.then_some(gradient)).collect()
            }
            (None, First::Drift) => {
                let gradient = ("gradient_kick", [zero(), list('c', stages)].concat());
                let lists = [("kick", [zero(), list('a', stages)].concat()), ("drift", list('b', stages + 1))];
                lists.into_iter().chain(request.gradient_kicks.then_some(gradient)).collect()
            }
        };
        let different = |letter: char, count: usize| (1..=count).map(|n| format!("{letter}{n}")).collect::<Vec<_>>();
        let post = match (request.processor, &request.base) {
            (None, _) => Vec::new(),
            (Some(stages), Some(_)) => vec![("gamma", different('p', stages))],
            (Some(stages), None) => vec![("kick", different('y', stages)), ("drift", different('z', stages))],
        };
        let mut names: Vec<String> = Vec::new();
        for name in lists.iter().chain(&post).flat_map(|(_, list)| list).filter(|name| *name != "0") {
            if !names.contains(name) {
                names.push(name.clone());
            }
        }
        Form { request, lists, post, names }
    }

    /// The order that every consistent step of the form has.
    pub(super) fn least_order(&self) -> u32 {
        1 + u32::from(self.request.symmetric)
    }

    /// The names of the weights that are different.
    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    /// The table with the weights' values as texts; those in `free` are its free parameters.
    /// `kernel` is the order that is claimed of a kernel.
    pub(super) fn table(&self, name: &str, values: &[String], free: &[&str], kernel: u32) -> Source {
        let request = self.request;
        let kinetic = if request.kinetic == Kinetic::Any { "any" } else { "quadratic" };
        let order = if request.processor.is_some() { kernel } else { request.order };
        let mut text = format!("name = \"{name}\"\norder = {order}\nkinetic = \"{kinetic}\"\n");
        let near_integrable = match request.near_integrable.is_empty() {
            true => String::new(),
            false => format!("near_integrable = {:?}\n", request.near_integrable),
        };
        if request.processor.is_none() {
            text += &near_integrable;
        }
        text += &format!("symmetric = {}\n", request.symmetric);
        if !free.is_empty() {
            text += &format!("free = {free:?}\n");
        }
        text += "\n[constants]\n";
        // of each list the free ones first: a formula that makes a sum exactly 1 uses what stands above it
        let mut constants: Vec<_> = self.names.iter().zip(values).collect();
        constants.sort_by_key(|(name, _)| (name.chars().next(), !free.contains(&name.as_str())));
        for (name, value) in constants {
            text += &format!("{name} = \"{value}\"\n");
        }
        text += &match &request.base {
            Some(base) => format!("\n[composition]\nbase = \"{base}\"\n"),
            None => "\n[stages]\n".to_owned(),
        };
        text += &written(&self.lists);
        if request.processor.is_some() {
            text += &format!("\n[processor]\norder = {}\n{near_integrable}{}", request.order, written(&self.post));
        }
        // its lines are not those of the file of the search
        Source { path: format!("the table of {name}"), text }
    }
}

/// Lists of weights as lines of a table.
fn written(lists: &[(&'static str, Vec<String>)]) -> String {
    let cell = |name: &String| if name == "0" { name.clone() } else { format!("\"{name}\"") };
    let line = |(list, names): &(&'static str, Vec<String>)| {
        format!("{list} = [{}]\n", names.iter().map(cell).collect::<Vec<_>>().join(", "))
    };
    lists.iter().map(line).collect()
}
