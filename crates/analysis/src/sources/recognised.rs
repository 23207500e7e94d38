//! Lists → the readings of them that are schemes, or nearly.

use std::collections::BTreeSet;

use crate::floats::Floats;
use shadowstep_schemes::MapKind;
use shadowstep_schemes::order::{lyndon_words, word_conditions};

use num_traits::ToPrimitive;

use crate::known::{KNOWN, Known, Slip, resembles, slip};
use crate::sources::claims::Context;
use crate::sources::list::List;
use crate::sources::lists::Found;
use crate::sources::numbers::Id;
use crate::sources::roles::{Cell, Part, Reading, Steps, cells, interleaved, readings};

/// Sums and conditions that are farther off are wrong, not rounded.
const CLOSE: f64 = 1e-5;

/// The highest order of conditions by which a list is recognised.
const HIGHEST: usize = 4;

/// Two lists that are farther apart are not a pair.
const FAR: usize = 3000;

/// Lists between two that are a pair.
const MOST_APART: usize = 20;

/// How sure it is that a list is meant as a scheme.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Certainty {
    /// By its name, though its weights do not sum to 1.
    Named,
    /// A palindrome whose weights sum to 1.
    Sums,
    /// A shipped scheme but for a slip.
    Slipped,
    /// Order 3 at least.
    Order,
    /// A shipped scheme.
    Known,
}

/// A reading of one list or two that is a scheme.
pub(super) struct Recognised<'a> {
    text: &'a str,
    found: &'a Found,
    lists: Vec<&'a List>,
    pub(super) reading: Reading,
    certainty: Certainty,
    order: usize,
    closure: BTreeSet<Id>,
}

/// The lists that are schemes, each once, and the number of the others.
pub(super) fn recognised<'a>(text: &'a str, found: &'a Found) -> (Vec<Recognised<'a>>, usize) {
    let mut tries: Vec<Recognised<'a>> = Vec::new();
    for (i, list) in found.lists.iter().enumerate() {
        tries.extend(Recognised::best(text, found, &[list], false));
        let others = found.lists.iter().enumerate().skip(i + 1).take(MOST_APART);
        for (_, other) in others.filter(|(j, other)| are_pair(list, other, j - i)) {
            tries.extend(Recognised::best(text, found, &[list, other], false));
        }
    }
    // lists beside a scheme under the same name are meant as schemes
    let table = |list: &List| list.name.split('[').next().unwrap_or_default().to_owned();
    let named: BTreeSet<_> =
        tries.iter().filter(|found| found.lists.len() == 1).map(|found| table(found.lists[0])).collect();
    let siblings = found.lists.iter().filter(|list| list.rows > 1 && named.contains(&table(list)));
    let siblings =
        siblings.filter(|list| !tries.iter().any(|found| found.lists.iter().any(|other| std::ptr::eq(*other, *list))));
    let siblings: Vec<_> = siblings.filter_map(|list| Recognised::best(text, found, &[list], true)).collect();
    tries.extend(siblings);
    // a list that is made of others says more than they do
    let built = |found: &Recognised<'_>, others: &[Recognised<'_>]| {
        let ids = || found.lists.iter().flat_map(|list| &list.entries);
        others.iter().any(|other| other.entries() > found.entries() && ids().all(|id| other.closure.contains(id)))
    };
    let parts: Vec<_> = tries.iter().map(|found| built(found, &tries)).collect();
    let mut is_part = parts.into_iter();
    tries.retain(|_| !is_part.next().unwrap_or(false));
    // what explains most comes first; constants last
    tries.sort_by_key(|found| {
        let groups = found.lists.iter().filter(|list| list.is_group).count();
        std::cmp::Reverse((found.certainty, found.lists.len() - groups, found.order, found.entries()))
    });
    let mut chosen: Vec<Recognised<'a>> = Vec::new();
    for found in tries {
        let is_explained = |list: &&List| {
            chosen.iter().any(|chosen| {
                let is_same = chosen.lists.iter().any(|other| std::ptr::eq(*other, *list));
                is_same || (list.entries.iter().all(|id| chosen.closure.contains(id)) && !list.entries.is_empty())
            })
        };
        if !found.lists.iter().any(is_explained) {
            chosen.push(found);
        }
    }
    let explained = |list: &&List| {
        !list.is_group && !chosen.iter().any(|chosen| list.entries.iter().all(|id| chosen.closure.contains(id)))
    };
    let skipped = found.lists.iter().filter(explained).count();
    chosen.sort_by_key(|found| found.lists[0].at.start);
    (chosen, skipped)
}

/// Whether two lists may be the kicks and drifts of a scheme: neighbours, or named alike.
fn are_pair(first: &List, second: &List, apart: usize) -> bool {
    let near = second.at.start < first.at.end + FAR && first.at.start < second.at.end + FAR;
    let alike = first.is_group == second.is_group;
    // two arguments are a pair, rows of a table are not
    let table = |list: &List| list.name.split('[').next().map(str::to_owned);
    let are_rows = first.rows > 2 && table(first) == table(second);
    near && alike && !are_rows && (apart == 1 || (are_named_alike(&first.name, &second.name)))
}

/// Whether names differ in one letter, or in the words of kick and drift: `c_4` and `d_4`, `rows_c[2]` and `rows_d[2]`.
fn are_named_alike(first: &str, second: &str) -> bool {
    let neutral = |name: &str| {
        let mut name = name.to_lowercase();
        for word in ["kick", "drift", "position", "momentum", "velocity", "pos", "vel", "mom"] {
            name = name.replace(word, "_");
        }
        name
    };
    let (first, second) = (neutral(first), neutral(second));
    let differ = first.chars().zip(second.chars()).filter(|(a, b)| a != b);
    !first.is_empty()
        && first.chars().count() == second.chars().count()
        && differ.filter(|(a, b)| !a.is_ascii_digit() || !b.is_ascii_digit()).count() <= 2
        && first.chars().zip(second.chars()).all(|(a, b)| a == b || !(a.is_ascii_digit() && b.is_ascii_digit()))
}

impl<'a> Recognised<'a> {
    /// The best reading of lists that explains them.
    fn best(text: &'a str, found: &'a Found, lists: &[&'a List], is_meant: bool) -> Option<Recognised<'a>> {
        let ids = lists.iter().flat_map(|list| list.entries.iter().copied());
        let closure = found.numbers.closure(ids);
        let numbers = &found.numbers;
        // arrays of one size are filled up with zeros
        let cells = |list: &List| {
            let mut cells = cells(&list.entries, numbers);
            let end = cells.iter().rposition(|cell| cell.value != 0.0).map_or(0, |last| last + 1);
            cells.truncate(end);
            cells
        };
        let readings = match lists {
            [list] => readings(&cells(list), &[Steps::Composition, Steps::Maps, Steps::Adjoints]),
            [first, second] => {
                let [first, second] = [first, second].map(|list| cells(list));
                if first.len().abs_diff(second.len()) > 1 {
                    return None;
                }
                let order = if second.len() > first.len() { [&second, &first] } else { [&first, &second] };
                let mut all = readings(&interleaved(order[0], order[1]), &[Steps::Maps]);
                if first.len() == second.len() {
                    all.extend(readings(&interleaved(&second, &first), &[Steps::Maps]));
                }
                all
            }
            _ => return None,
        };
        let telling = numbers.are_telling(&closure);
        let (mut hints, named) = (None, context(text, found, lists).are_named());
        let mut best: Option<Recognised<'a>> = None;
        for reading in readings {
            let mut hinted = || is_meant || *hints.get_or_insert_with(|| context(text, found, lists).hints());
            let Some((certainty, order)) = certainty(&reading, [telling, named], &mut hinted) else { continue };
            let is_better = best.as_ref().is_none_or(|best| (certainty, order) > (best.certainty, best.order));
            if is_better {
                best = Some(Recognised {
                    text,
                    found,
                    lists: lists.to_vec(),
                    reading,
                    certainty,
                    order,
                    closure: closure.clone(),
                });
            }
        }
        best
    }

    fn entries(&self) -> usize {
        self.lists.iter().map(|list| list.entries.len()).sum()
    }

    pub(super) fn name(&self) -> String {
        let names = self.lists.iter().map(|list| match &*list.name {
            "" if list.at.len() < 30 => self.text[list.at.clone()].to_owned(),
            "" => format!("a list of {}", list.owner),
            name => name.to_owned(),
        });
        names.collect::<Vec<_>>().join(" and ")
    }

    pub(super) fn line(&self) -> usize {
        self.text[..self.lists[0].at.start].matches('\n').count() + 1
    }

    pub(super) fn context(&self) -> Context {
        context(self.text, self.found, &self.lists)
    }

    pub(super) fn digits(&self) -> Option<u32> {
        self.found.numbers.digits(&self.closure)
    }

    pub(super) fn constants(&self) -> String {
        self.found.numbers.constants(&self.closure)
    }

    /// A number as it stands in the source.
    pub(super) fn text_of(&self, id: Id) -> Option<&'a str> {
        let text = self.closure.contains(&id).then(|| &self.text[self.found.numbers.get(id).at.clone()])?;
        // without the conversion around it
        let numbers = text.split(|c: char| !c.is_ascii_digit() && !".-+eEdD_".contains(c));
        let literal = numbers
            .filter(|part| part.contains('.') && part.contains(|c: char| c.is_ascii_digit()))
            .max_by_key(|part| part.len());
        Some(literal.unwrap_or(text).trim_matches(|c: char| "+-_eEdD".contains(c)).trim())
    }

    /// The entry that a weight of the reading is, and its text.
    pub(super) fn entry(&self, place: usize) -> (String, Option<&'a str>) {
        let Some(cell) = self.reading.cells.get(place) else { return ("the end".to_owned(), None) };
        let id = cell.text.strip_prefix('n').and_then(|id| id.parse().ok());
        match id.and_then(|id| {
            Some((id, self.lists.iter().find_map(|list| list.entries.iter().position(|entry| *entry == id))?))
        }) {
            Some((id, entry)) => (format!("entry {}", entry + 1), self.text_of(id)),
            None => (format!("weight {}", place + 1), None),
        }
    }

    /// The shipped scheme that it was copied from with a slip.
    pub(super) fn slip(&self) -> Option<(&'static Known, Slip)> {
        slip_of(&self.reading)
    }
}

fn context(text: &str, found: &Found, lists: &[&List]) -> Context {
    let names: Vec<&str> =
        lists.iter().map(|list| list.name.as_str()).chain(lists.first().map(|list| list.owner.as_str())).collect();
    let at = lists[0].at.start..lists[lists.len() - 1].at.end;
    Context::of(text, &names, &at, &found.comments, &found.orders)
}

fn slip_of(reading: &Reading) -> Option<(&'static Known, Slip)> {
    let values: Vec<_> = reading.cells.iter().map(|cell: &Cell| cell.value).collect();
    match reading.role.steps {
        Steps::Composition => slip(&values, KNOWN.iter().filter_map(|known| Some((known, known.gamma.as_deref()?)))),
        Steps::Maps => slip(&values, KNOWN.iter().map(|known| (known, known.floats()))),
        Steps::Adjoints => None,
    }
}

/// How sure it is that a reading is what is meant, and to which order it holds, up to the highest that is tried.
fn certainty(
    reading: &Reading,
    [telling, named]: [bool; 2],
    hinted: &mut dyn FnMut() -> bool,
) -> Option<(Certainty, usize)> {
    let maps = reading.maps();
    let sum = |kind: usize| maps.iter().skip(kind).step_by(2).sum::<f64>();
    let sums = maps.len() > 2 && [sum(0), sum(1)].iter().all(|sum| (sum - 1.0).abs() < CLOSE);
    let order = if sums { order(&maps) } else { 0 };
    let part = reading.role.part;
    let is_written_out = !matches!(part, Part::WithoutMiddle(_));
    // what follows from the sums needs a number of its own
    if !is_written_out && (!telling || maps.len() < 5 || reading.cells.iter().any(|cell| cell.value == 0.0)) {
        return None;
    }
    // a single number, or an order by accident
    let is_little = |entries: usize| !is_written_out && (maps.len() <= entries);
    if is_little(5) && !hinted() {
        return None;
    }
    let is_enough = (telling && maps.len() > 3) || (named && (part == Part::Whole || maps.len() >= 5));
    if sums && is_enough && resembles(&maps) {
        return Some((Certainty::Known, order));
    }
    if order >= 3 && maps.len() > 4 && (is_written_out || hinted()) {
        return Some((Certainty::Order, order));
    }
    if telling && part != Part::WithoutMiddle(2) && slip_of(reading).is_some() {
        return Some((Certainty::Slipped, order));
    }
    let is_long = reading.role.steps == Steps::Maps && part == Part::Whole && maps.len() >= 5;
    let is_enough = part == Part::Whole || reading.cells.len() >= 5;
    if sums && order >= 2 && telling && is_written_out && is_enough && reading.is_palindrome() && (is_long || hinted())
    {
        return Some((Certainty::Sums, order));
    }
    let is_near = [sum(0), sum(1)].iter().all(|sum| (sum - 1.0).abs() < 0.9);
    let is_named =
        telling && part == Part::Whole && reading.cells.len() >= 5 && reading.is_palindrome() && is_near && hinted();
    is_named.then_some((Certainty::Named, 0))
}

/// The order in f64, up to the highest that is tried.
fn order(maps: &[f64]) -> usize {
    let maps: Vec<_> = maps
        .iter()
        .enumerate()
        .map(|(i, weight)| (if i % 2 == 0 { MapKind::Kick } else { MapKind::Drift }, *weight))
        .collect();
    let conditions = word_conditions(&lyndon_words(HIGHEST), &maps, &Floats);
    let fails = |(condition, value): &&(shadowstep_schemes::order::Condition, f64)| {
        (value - condition.needed.to_f64().unwrap_or(f64::NAN)).abs() > CLOSE
    };
    conditions.iter().find(fails).map_or(HIGHEST, |(condition, _)| condition.order as usize - 1)
}
