//! Arguments → the system: a shipped problem, that of a scene, or a formula.

use std::path::Path;

use shadowstep::problems::problem;
use shadowstep::tables::{Faults, Source};
use shadowstep_scenes::arithmetic::{Arithmetic, GUARD_DIGITS, MOST_VALUE_DIGITS};
use shadowstep_scenes::{Error, KineticEnergy, PotentialEnergy, System, source};
use shadowstep_schemes::symbolic::decimal::to_significant;

use crate::quantity::{assignment, problem_error};
use crate::report;
use crate::run_arguments::SystemArguments;

/// A system with its description.
#[derive(Debug)]
pub(crate) struct Described {
    /// The name of a shipped problem, the path of a scene, or `formula`.
    pub(crate) name: String,
    pub(crate) title: String,
    /// H, or as much of it as is a text.
    pub(crate) hamiltonian: String,
    pub(crate) system: System,
}

impl Described {
    pub(crate) fn read(arguments: &SystemArguments, arithmetic: Arithmetic) -> Result<Self, Error> {
        refuse_state(arguments)?;
        match (arguments.problem(), &arguments.potential) {
            (_, Some(formula)) => by_formula(arguments, formula, arithmetic),
            (Some(path), None) if is_file(path) => of_scene(arguments, path, arithmetic),
            (Some(name), None) => shipped(arguments, name, arithmetic),
            (None, None) => unreachable!("clap requires one of the two"),
        }
    }
}

/// Refuses the flags of --potential without it: clap lets them pass where a problem is named.
fn refuse_state(arguments: &SystemArguments) -> Result<(), Error> {
    let SystemArguments { q, p, masses, .. } = arguments;
    let written = [("--q", q), ("--p", p), ("--masses", masses)].into_iter().find(|(_, values)| !values.is_empty());
    match (written, arguments.problem()) {
        (Some((flag, _)), Some(problem)) => {
            let hint = match is_file(problem) {
                true => format!("change the values in {problem}"),
                false => "set values of a shipped problem with --set: --set x=1".to_owned(),
            };
            Err(Error::usage(format!("{flag} requires --potential, not {problem}"), hint))
        }
        _ => Ok(()),
    }
}

pub(crate) fn is_file(word: &str) -> bool {
    word.ends_with(".toml") || word.contains(std::path::is_separator)
}

fn shipped(arguments: &SystemArguments, name: &str, arithmetic: Arithmetic) -> Result<Described, Error> {
    let set = arguments.set.iter().map(|text| assignment(text)).collect::<Result<Vec<_>, _>>()?;
    let digits = arithmetic.value_digits();
    let setup = problem(name).and_then(|problem| problem.setup(&set, digits)).map_err(problem_error)?;
    if let Some((name, _)) = setup.values.named().iter().find(|(_, value)| !arithmetic.has_digits_of(value)) {
        return Err(Error::usage(
            format!("{name} is irrational and computed to {MOST_VALUE_DIGITS} digits; the run needs {digits}"),
            format!("use --digits {} or less, or set {name} to a fraction", MOST_VALUE_DIGITS - GUARD_DIGITS),
        ));
    }
    if let Some(mass) = setup.values.masses().and_then(|masses| arithmetic.mass_out_of_range(masses)) {
        let (mass, arithmetic) = (to_significant(&mass.value, 6), arithmetic.described());
        return Err(Error::usage(
            format!("a mass of {mass} or its inverse overflows or underflows in {arithmetic}"),
            "use --digits 16 for numbers of any size",
        ));
    }
    let description = setup.problem.description();
    Ok(Described {
        name: description.name.to_owned(),
        title: description.title.to_owned(),
        hamiltonian: description.hamiltonian.to_owned(),
        system: System::of_setup(setup),
    })
}

fn of_scene(arguments: &SystemArguments, path: &str, arithmetic: Arithmetic) -> Result<Described, Error> {
    if let Some(set) = arguments.set.first() {
        let message = format!("--set {set} requires a shipped problem or --potential, not a scene");
        return Err(Error::usage(message, format!("change the value in {path}")));
    }
    let (system, notes) = System::read(&source(Path::new(path))?, arithmetic)?;
    notes.iter().for_each(report::note);
    Ok(describe(path.to_owned(), system))
}

/// The formula is read as a scene is, each of whose lines is that of a flag, which faults name.
fn by_formula(arguments: &SystemArguments, formula: &str, arithmetic: Arithmetic) -> Result<Described, Error> {
    let lines = lines_of(arguments, formula)?;
    let text = lines.iter().map(|(_, line)| format!("{line}\n")).collect();
    let wrong = |Faults(faults): Faults| match faults.first() {
        Some(fault) => {
            let (flag, _) = lines.get(fault.line.saturating_sub(1)).unwrap_or(&lines[0]);
            let hint = fault.hint.clone().unwrap_or_else(|| "compare --q, --p, --masses and --set".to_owned());
            let values = fault.values.as_ref();
            let values = values.map_or(String::new(), |(found, needed)| format!(": found {found}, needed {needed}"));
            Error::usage(format!("{flag}: {}{values}", fault.message), hint)
        }
        None => Error::usage("--potential is not valid", "write a smooth formula such as \"x^2/2\""),
    };
    let (system, notes) = System::read(&Source { path: "--potential".to_owned(), text }, arithmetic).map_err(wrong)?;
    notes.iter().for_each(report::note);
    Ok(Described { title: format!("U = {formula}"), ..describe("formula".to_owned(), system) })
}

/// The lines of [problem] and [initial], each with its flag.
fn lines_of(arguments: &SystemArguments, formula: &str) -> Result<Vec<(String, String)>, Error> {
    let positions = arguments.q.iter().map(|text| named("--q", text, "x=0.4,y=0")).collect::<Result<Vec<_>, _>>()?;
    let (names, q): (Vec<_>, Vec<_>) = positions.into_iter().unzip();
    let momenta = if arguments.p.iter().all(|text| text.contains('=')) {
        arguments.p.iter().map(|text| named("--p", text, "px=0,py=2")).collect::<Result<Vec<_>, _>>()?
    } else {
        Vec::new()
    };
    let p = if momenta.is_empty() { arguments.p.clone() } else { in_order(&momenta, &names)? };
    if p.len() != q.len() {
        let values = |count: usize| if count == 1 { "1 value".to_owned() } else { format!("{count} values") };
        let message = format!("--q has {} and --p has {}", values(q.len()), values(p.len()));
        return Err(Error::usage(message, "give one momentum for each coordinate"));
    }
    let set = arguments.set.iter().map(|text| assignment(text)).collect::<Result<Vec<_>, _>>()?;
    let parameters: Vec<_> = set.iter().map(|(name, value)| format!("{name} = {}", quoted(value))).collect();
    let masses = &arguments.masses;
    let potential = format!("--potential \"{formula}\"");
    let mut lines = vec![
        (potential.as_str(), "[problem]".to_owned()),
        (&potential, format!("potential = {}", quoted(formula))),
        ("--q", format!("coordinates = {}", list(&names))),
        ("--set", format!("parameters = {{ {} }}", parameters.join(", "))),
    ];
    lines.extend((!masses.is_empty()).then(|| ("--masses", format!("masses = {}", list(masses)))));
    lines.push((&potential, "[initial]".to_owned()));
    lines.push(("--q", format!("q = {}", list(&q))));
    lines.push(("--p", format!("p = {}", list(&p))));
    Ok(lines.into_iter().map(|(flag, line)| (flag.to_owned(), line)).collect())
}

fn named(flag: &str, text: &str, example: &str) -> Result<(String, String), Error> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() => Ok((name.trim().to_owned(), value.trim().to_owned())),
        _ => Err(Error::usage(format!("{flag} `{text}` has no name"), format!("write {flag} {example}"))),
    }
}

/// The momenta in the order of the coordinates, whatever order they are given in.
fn in_order(momenta: &[(String, String)], coordinates: &[String]) -> Result<Vec<String>, Error> {
    let names: Vec<String> = coordinates.iter().map(|name| format!("p{name}")).collect();
    let value = |name: &String| momenta.iter().find(|(momentum, _)| momentum == name).map(|(_, value)| value.clone());
    let all: Vec<String> = names.iter().map_while(value).collect();
    if all.len() == names.len() && momenta.len() == names.len() {
        return Ok(all);
    }
    let fault = match momenta.iter().find(|(name, _)| !names.contains(name)) {
        Some((other, _)) => format!("--p has `{other}`, which is no momentum of --q"),
        None => "--p does not have each momentum once".to_owned(),
    };
    let example: Vec<_> = names.iter().map(|name| format!("{name}=…")).collect();
    Err(Error::usage(fault, format!("write --p {}", example.join(","))))
}

fn list(texts: &[String]) -> String {
    format!("[{}]", texts.iter().map(|text| quoted(text)).collect::<Vec<_>>().join(", "))
}

/// A string of TOML.
fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

fn describe(name: String, system: System) -> Described {
    let kinetic = match &system.kinetic {
        KineticEnergy::Masses(_) => "T(p)",
        KineticEnergy::Formula(formula) => formula.text(),
    };
    let (title, hamiltonian) = match &system.potential {
        PotentialEnergy::Shipped(setup) => {
            let problem = setup.problem.description();
            (problem.title.to_owned(), problem.hamiltonian.to_owned())
        }
        PotentialEnergy::Formula(formula) => (name.clone(), format!("{kinetic} + {}", formula.text())),
        PotentialEnergy::Pairs(pairs) => {
            let of_bodies = pairs.of_bodies.iter().map(|energy| format!(" + the sum over bodies of {}", energy.text()));
            let of_pairs = format!("{kinetic} + the sum over pairs of {}", pairs.formula.text());
            (name.clone(), of_bodies.fold(of_pairs, |all, energy| all + &energy))
        }
        PotentialEnergy::Own(own) => (name.clone(), format!("{kinetic} + {}", own.name())),
        PotentialEnergy::OfParts => (name.clone(), system.parts.hamiltonian().unwrap_or_default()),
    };
    let slow = system.parts.slow_forces().map_or_else(String::new, |slow| format!(" + {}", slow.described()));
    Described { name, title, hamiltonian: hamiltonian + &slow, system }
}
