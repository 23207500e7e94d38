//! The head of a file: everything that determines its numbers, and nothing that differs in another run of the same
//! scene.

use std::path::Path;

use serde::{Serialize, Serializer};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use shadowstep::systems::pairs::Ends;
use shadowstep_schemes::Source;
use shadowstep_schemes::symbolic::Exact;
use shadowstep_schemes::symbolic::decimal::to_text;
use shadowstep_schemes::table::{Table, Weights};

use crate::document::library;
use crate::run::arithmetic::Arithmetic;
use crate::scene::{KineticEnergy, PairCutoff, PairEnergy, PotentialEnergy, Scene, SmoothEnd, System};

/// Names and values in the order in which they are written.
pub(crate) struct Metadata(Vec<(&'static str, Value)>);

impl Serialize for Metadata {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

impl Metadata {
    pub(crate) fn of(scene: &Scene) -> Metadata {
        let proved = scene.scheme.scheme.proved();
        let order = if scene.system.has_general_kinetic() { &proved.proof.general } else { proved.order() };
        let mut all = made_with(scene);
        all.extend([
            ("first", json!(proved.scheme.maps().first().map(|map| map.kind.to_string()))),
            ("scheme_order", json!(order.order)),
            ("digits", json!(scene.arithmetic.label())),
        ]);
        all.extend(scene.displaced.then(|| ("gradient_kicks", json!("displaced"))));
        // the same digits may be MPFR's, with other last places
        all.extend(scene.arithmetic.limbs().map(|limbs| ("limbs", json!(limbs))));
        all.extend(system(&scene.system, scene.arithmetic));
        all.extend(steps(scene));
        all.extend(
            scene.output.modified_energy.iter().map(|(chosen, _)| ("modified_energy_by", json!(chosen.to_string()))),
        );
        let values: serde_json::Map<_, _> =
            scene.output.named_values().map(|value| (value.name.clone(), json!(value.expression.text.value))).collect();
        all.extend((!values.is_empty()).then(|| ("values", json!(values))));
        Metadata(all)
    }

    /// Of an ensemble with columns of this hash, by the scene of one of its trajectories.
    pub(crate) fn of_ensemble(scene: &Scene, columns_sha256: &str) -> Metadata {
        let mut all = made_with(scene);
        all.extend([("columns_sha256", json!(columns_sha256)), ("digits", json!(scene.arithmetic.label()))]);
        all.extend(steps(scene));
        Metadata(all)
    }

    /// Whether an object of JSON has the same values; the scene's file may have another name meanwhile.
    pub(crate) fn is(&self, other: &Value) -> bool {
        let count = other.as_object().map_or(0, serde_json::Map::len);
        let mut names: Vec<&str> = self.0.iter().map(|(name, _)| *name).collect();
        names.sort_unstable();
        names.dedup();
        // of a name that stands here twice, the last value is read
        let value = |name: &str| self.0.iter().rfind(|(own, _)| *own == name).map(|(_, value)| value);
        count == names.len() && names.iter().all(|name| *name == "scene" || value(name) == other.get(name))
    }

    /// One line for each: `digits: 120`.
    pub(crate) fn lines(&self) -> impl Iterator<Item = String> + '_ {
        self.0.iter().map(|(name, value)| match value.as_str() {
            Some(text) if !text.contains(char::is_control) => format!("{name}: {text}"),
            _ => format!("{name}: {value}"),
        })
    }
}

/// The program, the scene and the tables.
fn made_with(scene: &Scene) -> Vec<(&'static str, Value)> {
    let table = &scene.scheme.scheme.proved().scheme.table;
    let mut all = vec![
        ("shadowstep", json!(env!("CARGO_PKG_VERSION"))),
        ("platform", json!(platform())),
        ("scene", json!(file_name(&scene.source.path))),
        ("scene_sha256", json!(sha256(&scene.source.text))),
        ("scheme", json!(scene.scheme.name)),
        ("table_sha256", json!(sha256(&table.source.text))),
    ];
    all.extend(bases(table).iter().map(|base| ("base_table_sha256", json!(sha256(&base.text)))));
    all.extend((!scene.files.is_empty()).then(|| ("states_sha256", json!(file_hashes(scene)))));
    all
}

fn steps(scene: &Scene) -> impl Iterator<Item = (&'static str, Value)> {
    let until = scene.until.iter().map(|until| ("until", json!(to_text(until))));
    let end = scene.ends.iter().map(|condition| ("end", json!(condition.text())));
    let section = scene.output.section.iter().map(|surface| ("section", json!(surface.expression.text.value)));
    let step = [("step", json!(to_text(scene.h.exact())))].into_iter();
    step.chain(until).chain(end).chain(scene.steps().map(|steps| ("steps", json!(steps)))).chain(section)
}

fn system(system: &System, arithmetic: Arithmetic) -> Vec<(&'static str, Value)> {
    let texts = |values: &[Exact]| json!(values.iter().map(|value| arithmetic.text(value)).collect::<Vec<_>>());
    let named = match &system.potential {
        PotentialEnergy::Shipped(setup) => {
            let problem = setup.problem.description();
            vec![("problem", json!(problem.name)), ("hamiltonian", json!(problem.hamiltonian))]
        }
        PotentialEnergy::Formula(formula) => vec![("potential", json!(formula.text()))],
        PotentialEnergy::Pairs(pairs) => pair_energy(pairs, texts),
        PotentialEnergy::Own(own) => vec![("potential", json!(own.name()))],
        PotentialEnergy::OfParts => vec![("momenta", json!(system.momenta))],
    };
    let parameters: serde_json::Map<_, _> =
        system.parameters.iter().map(|(name, value)| (name.clone(), json!(arithmetic.text(value)))).collect();
    let kinetic = match &system.kinetic {
        KineticEnergy::Masses(masses) => masses_of(system, masses.as_deref(), arithmetic),
        KineticEnergy::Formula(formula) => vec![("kinetic", json!(formula.text())), ("momenta", json!(system.momenta))],
    };
    named
        .into_iter()
        .chain(system.parts.metadata())
        .chain([("parameters", json!(parameters)), ("coordinates", json!(system.coordinates))])
        .chain(kinetic)
        .chain([("q", texts(&system.q)), ("p", texts(&system.p))])
        .collect()
}

/// The masses of the coordinates, where they are not all 1: of particles 0, though their momenta are divided by it.
fn masses_of(system: &System, masses: Option<&[Exact]>, arithmetic: Arithmetic) -> Vec<(&'static str, Value)> {
    let massive = system.massive_coordinates();
    let mut texts = match masses {
        Some(masses) => masses.iter().map(|mass| arithmetic.text(mass)).collect(),
        None if massive < system.q.len() => vec!["1".to_owned(); system.q.len()],
        None => return Vec::new(),
    };
    texts.iter_mut().skip(massive).for_each(|mass| *mass = "0".to_owned());
    vec![("masses", json!(texts))]
}

fn pair_energy(pairs: &PairEnergy, texts: impl Fn(&[Exact]) -> Value) -> Vec<(&'static str, Value)> {
    let properties: serde_json::Map<_, _> =
        pairs.properties.iter().map(|(name, values)| (name.clone(), texts(values))).collect();
    let bodies = if properties.is_empty() { json!(pairs.bodies) } else { json!(properties) };
    let neighbours = pairs.ends.map(|ends| match ends {
        Ends::Free => "free",
        Ends::Fixed => "fixed",
        Ends::Periodic => "periodic",
    });
    [("pair", json!(pairs.formula.text())), ("dimensions", json!(pairs.dimensions)), ("bodies", bodies)]
        .into_iter()
        .chain(neighbours.map(|neighbours| ("neighbours", json!(neighbours))))
        .chain(pairs.of_bodies.iter().map(|energy| (energy.key(), json!(energy.text()))))
        .chain(pairs.cutoff.iter().flat_map(|cutoff| cutoff_of_pairs(cutoff, &texts)))
        .collect()
}

fn cutoff_of_pairs(cutoff: &PairCutoff, texts: impl Fn(&[Exact]) -> Value) -> Vec<(&'static str, Value)> {
    let text = |value: &Exact| texts(std::slice::from_ref(value))[0].clone();
    let at = text(&cutoff.radius);
    let end = match &cutoff.smooth {
        Some(SmoothEnd { from, derivatives }) => json!({ "at": at, "from": text(from), "derivatives": derivatives }),
        None => at,
    };
    let sides = cutoff.sides.iter().map(|sides| ("box", texts(sides)));
    std::iter::once(("cutoff", end)).chain(sides).collect()
}

/// The hashes of the tables that a scheme is made of: its own, and of a composition those of its bases.
pub(crate) fn table_hashes(scene: &Scene) -> Vec<String> {
    let table = &scene.scheme.scheme.proved().scheme.table;
    std::iter::once(&table.source).chain(&bases(table)).map(|source| sha256(&source.text)).collect()
}

/// The hashes of other files that have states.
pub(crate) fn file_hashes(scene: &Scene) -> Vec<String> {
    scene.files.iter().map(|file| sha256(&file.text)).collect()
}

/// What messages call these tables, and these files.
pub(crate) fn input_names(scene: &Scene) -> Vec<String> {
    let table = &scene.scheme.scheme.proved().scheme.table;
    let tables = std::iter::once(table.source.clone()).chain(bases(table));
    let names = tables.map(|source| format!("table {}", file_name(&source.path)));
    names.chain(scene.files.iter().map(|file| format!("file {}", file.path))).collect()
}

/// The base tables of a composition, which were found when it was read.
fn bases(table: &Table) -> Vec<Source> {
    let mut bases: Vec<Source> = Vec::new();
    let mut above = table.clone();
    while let Some(Weights::Composition { base, .. }) = &above.weights {
        let Some(source) = library::beside_or_shipped(&base.value, &above.source) else { break };
        let (Some(table), _) = shadowstep_schemes::parse::table(&source) else { break };
        // a file that was changed in the meantime may form a circle
        if bases.contains(&source) {
            break;
        }
        bases.push(source);
        above = table;
    }
    bases
}

/// The platform: it provides the functions of double precision.
pub(crate) fn platform() -> String {
    format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS)
}

/// In hexadecimal digits.
pub(crate) fn sha256(text: &str) -> String {
    hexadecimal(&Sha256::digest(text))
}

/// Bytes as two hexadecimal digits each, as hashes are shown.
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn file_name(path: &str) -> String {
    Path::new(path).file_name().map_or_else(|| path.to_owned(), |name| name.to_string_lossy().into_owned())
}
