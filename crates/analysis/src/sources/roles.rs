//! What a list can mean: a composition, kicks and drifts, or half of a palindrome of these.

use std::fmt;

use crate::sources::numbers::{Id, Numbers, name};

/// A weight: its formula over the numbers of the source, and its value.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    pub(super) text: String,
    pub(super) value: f64,
}

/// What the weights are of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Steps {
    /// Of steps of Störmer–Verlet.
    Composition,
    /// Of kicks and drifts in turn.
    Maps,
    /// Of steps of a map of order 1 and its adjoint in turn.
    Adjoints,
}

/// Which part of the step the list is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Whole,
    /// The last entry is the middle.
    HalfWithMiddle,
    /// The last entry is there twice.
    Half,
    /// One or two weights in the middle follow from the sums.
    WithoutMiddle(usize),
}

/// A meaning of a list or of two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Role {
    pub(super) steps: Steps,
    pub(super) part: Part,
    /// Whether the list begins in the middle.
    pub(super) from_middle: bool,
}

/// The weights of a list in a role.
#[derive(Clone, Debug)]
pub(super) struct Reading {
    pub(super) role: Role,
    /// As the role has them: γ's, or weights of maps.
    pub(super) cells: Vec<Cell>,
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let steps = match self.steps {
            Steps::Composition => "composition of a symmetric step of order 2",
            Steps::Maps => "kicks and drifts in turn",
            Steps::Adjoints => "steps of a map of order 1 and its adjoint in turn",
        };
        let from = if self.from_middle { ", from the middle" } else { "" };
        match self.part {
            Part::Whole => write!(f, "{steps}"),
            Part::HalfWithMiddle => write!(f, "{steps}, half of a palindrome with its middle{from}"),
            Part::Half => write!(f, "{steps}, half of a palindrome{from}"),
            Part::WithoutMiddle(1) => {
                write!(f, "{steps}, half of a palindrome, whose middle follows from the sum{from}")
            }
            Part::WithoutMiddle(_) => {
                write!(f, "{steps}, half of a palindrome, whose middle weights follow from the sums")
            }
        }
    }
}

/// The cells of numbers.
pub(super) fn cells(entries: &[Id], numbers: &Numbers) -> Vec<Cell> {
    entries.iter().map(|id| Cell { text: name(*id), value: numbers.get(*id).float }).collect()
}

/// One weight of each list in turn.
pub(super) fn interleaved(first: &[Cell], second: &[Cell]) -> Vec<Cell> {
    let mut cells = Vec::new();
    for i in 0..first.len().max(second.len()) {
        cells.extend(first.get(i).cloned());
        cells.extend(second.get(i).cloned());
    }
    cells
}

/// All readings of a list.
pub(super) fn readings(list: &[Cell], steps: &[Steps]) -> Vec<Reading> {
    let mut found = Vec::new();
    let backwards: Vec<_> = list.iter().rev().cloned().collect();
    for &steps in steps {
        for (list, from_middle) in [(list, false), (&*backwards, true)] {
            for part in [Part::Whole, Part::HalfWithMiddle, Part::Half, Part::WithoutMiddle(1), Part::WithoutMiddle(2)]
            {
                let role = Role { steps, part, from_middle };
                found.extend(read(list, role).map(|cells| Reading { role, cells }));
            }
        }
    }
    found
}

fn read(list: &[Cell], role: Role) -> Option<Vec<Cell>> {
    let Role { steps, part, from_middle } = role;
    let mut half = list.to_vec();
    match (steps, part) {
        (_, Part::Whole) if from_middle => return None,
        (Steps::Composition | Steps::Maps, Part::Whole) => return (list.len() > 2).then_some(half),
        (Steps::Adjoints, Part::Whole) => return adjoints(&half),
        (_, Part::HalfWithMiddle | Part::Half) if list.len() < 2 => return None,
        (Steps::Composition | Steps::Maps, Part::HalfWithMiddle) => {}
        // the middle map is that of both halves
        (Steps::Maps, Part::Half) => {
            let last = half.pop()?;
            half.push(Cell { text: format!("2*({})", last.text), value: 2.0 * last.value });
        }
        (Steps::Composition | Steps::Adjoints, Part::Half) => {
            half.extend(list.iter().rev().cloned());
            return if steps == Steps::Adjoints { adjoints(&half) } else { Some(half) };
        }
        (Steps::Composition, Part::WithoutMiddle(1)) => half.push(rest("1", 1.0, 2, list.iter())),
        (Steps::Maps, Part::WithoutMiddle(missing)) if !from_middle => {
            // the last one is the middle
            for left in (0..missing).rev() {
                let kind = half.len() % 2;
                let own: Vec<_> = half.iter().skip(kind).step_by(2).cloned().collect();
                half.push(if left == 0 { rest("1", 1.0, 2, own.iter()) } else { rest("1/2", 0.5, 1, own.iter()) });
            }
        }
        _ => return None,
    }
    let mirrored: Vec<_> = half.iter().rev().skip(1).cloned().collect();
    half.extend(mirrored);
    Some(half)
}

/// What is left of a sum: total − factor·Σ.
fn rest<'a>(total: &str, value: f64, factor: u32, cells: impl Iterator<Item = &'a Cell>) -> Cell {
    let (mut text, mut left) = (total.to_owned(), value);
    for cell in cells {
        text += &format!(" - {factor}*({})", cell.text);
        left -= f64::from(factor) * cell.value;
    }
    Cell { text, value: left }
}

/// The maps of steps α₁ of a map of order 1, α₂ of its adjoint, …: neighbours of one kind merge.
fn adjoints(alpha: &[Cell]) -> Option<Vec<Cell>> {
    if alpha.len() < 2 || !alpha.len().is_multiple_of(2) {
        return None;
    }
    let sum = |a: &Cell, b: &Cell| Cell { text: format!("{} + {}", a.text, b.text), value: a.value + b.value };
    let mut cells = vec![alpha[0].clone()];
    cells.extend(alpha.windows(2).map(|pair| sum(&pair[0], &pair[1])));
    cells.push(alpha[alpha.len() - 1].clone());
    Some(cells)
}

impl Reading {
    /// The weights of kicks and drifts in turn, without those that are 0.
    pub(super) fn maps(&self) -> Vec<f64> {
        let values = || self.cells.iter().map(|cell| cell.value);
        let written = if self.role.steps == Steps::Composition {
            let gamma: Vec<_> = std::iter::once(0.0).chain(values()).chain([0.0]).collect();
            gamma.windows(2).flat_map(|pair| [(pair[0] + pair[1]) / 2.0, pair[1]]).collect()
        } else {
            values().collect::<Vec<_>>()
        };
        let mut maps: Vec<(usize, f64)> = Vec::new();
        for (i, weight) in written.into_iter().enumerate().filter(|(_, weight)| *weight != 0.0) {
            match maps.last_mut() {
                Some((kind, last)) if *kind == i % 2 => *last += weight,
                _ => maps.push((i % 2, weight)),
            }
        }
        maps.into_iter().map(|(_, weight)| weight).collect()
    }

    /// Whether it reads the same from both ends.
    pub(super) fn is_palindrome(&self) -> bool {
        let maps = self.maps();
        // of an even number, the first and the last map are of different kinds
        !maps.len().is_multiple_of(2) && maps.iter().zip(maps.iter().rev()).all(|(a, b)| (a - b).abs() < 1e-9)
    }

    /// A table of it, of which nothing is claimed but order 1.
    pub(super) fn table(&self, constants: &str, claims: &str) -> String {
        let list = |cells: Vec<&str>| cells.iter().map(|cell| format!("\"{cell}\"")).collect::<Vec<_>>().join(", ");
        let texts: Vec<&str> = self.cells.iter().map(|cell| cell.text.as_str()).collect();
        let weights = match self.role.steps {
            Steps::Composition => format!("[composition]\nbase = \"stormer-verlet\"\ngamma = [{}]\n", list(texts)),
            Steps::Maps | Steps::Adjoints => {
                let kicks: Vec<_> = texts.iter().step_by(2).copied().collect();
                let mut drifts: Vec<_> = texts.iter().skip(1).step_by(2).copied().collect();
                drifts.resize(kicks.len(), "0");
                format!("[stages]\nkick = [{}]\ndrift = [{}]\n", list(kicks), list(drifts))
            }
        };
        format!("name = \"list\"\n{claims}\n[constants]\n{constants}\n{weights}")
    }
}
