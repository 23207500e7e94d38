//! The curves of a run, from its states one by one.

use shadowstep::Real;
use shadowstep_scenes::plot::{Content, Distance, Orbit, Picture};

use super::thin::{InTime, Points};

/// What is known at one time of a run.
pub(crate) struct Values<'a, N> {
    /// The step, from 0.
    pub(crate) n: u64,
    pub(crate) t: f64,
    pub(crate) energy: Option<&'a N>,
    pub(crate) modified_energy: Option<&'a N>,
    /// The estimated error of the modified energy.
    pub(crate) estimate: Option<&'a N>,
    /// Positions, then momenta; empty where they are not known.
    pub(crate) state: &'a [f64],
}

/// A run with the lines of each chart.
#[derive(Debug)]
pub(super) struct RunOfChart {
    pub(super) name: String,
    pub(super) charts: Vec<Vec<Line>>,
    /// The time of the reference of the modified energy, and log₁₀ of its estimated error.
    pub(super) reference: Option<(f64, f64)>,
}

/// The points of a curve, those in time of energies with log₁₀ of the values; one of this number of states is shown.
pub(super) type Line = (Vec<(f64, f64)>, u64);

/// A run that is being followed, and the energy at its beginning.
pub(crate) struct RunLines<N> {
    name: String,
    steps: u64,
    first: Option<N>,
    reference: Option<Reference<N>>,
    charts: Vec<Vec<Followed<N>>>,
}

/// The modified energy from which changes are measured: that with the smallest estimated error, or the first one where
/// no errors are known. The first one of a run may be the one that is known worst, as at a pericentre.
struct Reference<N> {
    t: f64,
    value: N,
    error: Option<N>,
}

/// A curve as it is made.
enum Followed<N> {
    /// |H − H(0)|.
    Energy(InTime),
    /// The modified energy itself.
    ModifiedEnergy(InTime<N>),
    /// Its estimated error.
    Estimate(InTime),
    Orbit(Orbit, Points),
    Distance(Distance, InTime),
}

impl<N: Real> RunLines<N> {
    pub(super) fn new(name: String, steps: u64, pictures: &[Picture]) -> Self {
        let curves = |picture: &Picture| match &picture.content {
            Content::Energies => vec![
                Followed::Energy(InTime::default()),
                Followed::ModifiedEnergy(InTime::default()),
                Followed::Estimate(InTime::default()),
            ],
            Content::Orbit { curves, .. } => {
                curves.iter().map(|of| Followed::Orbit(of.clone(), Points::new())).collect()
            }
            Content::Distances(all) => all.iter().map(|of| Followed::Distance(of.clone(), InTime::default())).collect(),
        };
        RunLines { name, steps, first: None, reference: None, charts: pictures.iter().map(curves).collect() }
    }

    /// Takes the next values of the run.
    pub(crate) fn take(&mut self, values: &Values<'_, N>) {
        let Values { n, t, energy, modified_energy, estimate, state } = *values;
        let energy = energy.map(|value| (t, change(self.first.get_or_insert_with(|| value.clone()), value)));
        let modified_energy = modified_energy.filter(|value| value.is_finite());
        if let Some(value) = modified_energy {
            self.refer(t, value, estimate);
        }
        let (steps, has_state) = (self.steps, !state.is_empty());
        for curve in self.charts.iter_mut().flatten() {
            match curve {
                Followed::Energy(line) => energy.into_iter().for_each(|point| line.take(n, steps, point)),
                Followed::ModifiedEnergy(line) => {
                    line.take_finite(n, steps, modified_energy.map(|value| (t, value.clone())));
                }
                Followed::Estimate(line) => {
                    estimate.into_iter().for_each(|size| line.take(n, steps, (t, size.log10_abs())));
                }
                Followed::Orbit(of, points) if has_state => points.take((state[of.values[0]], state[of.values[1]])),
                Followed::Distance(of, line) if has_state => line.take(n, steps, (t, distance(of, state))),
                Followed::Orbit(..) | Followed::Distance(..) => {}
            }
        }
    }

    /// Takes a modified energy as the reference, if it is the one with the smallest error so far.
    fn refer(&mut self, t: f64, value: &N, error: Option<&N>) {
        let is_better = match (&self.reference, error) {
            (None, _) => true,
            (Some(Reference { error: Some(least), .. }), Some(error)) => error < least,
            (Some(Reference { error: None, .. }), Some(_)) => true,
            (Some(_), None) => false,
        };
        if is_better {
            self.reference = Some(Reference { t, value: value.clone(), error: error.cloned() });
        }
    }

    pub(super) fn finish(self) -> RunOfChart {
        let reference = self.reference.as_ref();
        let from = |value: &N| reference.map_or(f64::NAN, |reference| change(&reference.value, value));
        let finish = |curve| match curve {
            Followed::ModifiedEnergy(line) => {
                let changes = line.finish().into_iter().map(|(t, value)| (t, from(&value)));
                (changes.filter(|(_, height)| height.is_finite()).collect(), 1)
            }
            Followed::Orbit(_, points) => points.finish(),
            Followed::Energy(line) | Followed::Estimate(line) | Followed::Distance(_, line) => (line.finish(), 1),
        };
        RunOfChart {
            name: self.name,
            charts: self.charts.into_iter().map(|curves| curves.into_iter().map(finish).collect()).collect(),
            reference: reference.and_then(|of| Some((of.t, of.error.as_ref()?.log10_abs()))),
        }
    }
}

/// log₁₀ |value − reference|, with the digits of the run.
fn change<N: Real>(reference: &N, value: &N) -> f64 {
    let mut change = value.clone();
    change.subtract(reference);
    change.log10_abs()
}

fn distance(of: &Distance, state: &[f64]) -> f64 {
    let from = &state[of.from.clone()];
    match &of.to {
        Some(to) => from.iter().zip(&state[to.clone()]).map(|(a, b)| a - b).fold(0.0, f64::hypot),
        None => from.iter().copied().fold(0.0, f64::hypot),
    }
}

#[cfg(test)]
mod tests {
    use shadowstep::exact;
    use shadowstep::number::{Limbs, Number};
    use shadowstep::problems::problem;
    use shadowstep_scenes::System;

    use super::*;

    #[test]
    fn changes_of_energies_have_the_digits_of_the_run() {
        let system = System::of_setup(problem("kepler").unwrap().setup(&[], 50).unwrap());
        let picture = |text: &str| Picture::read(text, &system).unwrap();
        let pictures = ["energies", "orbit=y:x", "distance"].map(picture);
        let mut run = RunLines::<Limbs<3>>::new("run".to_owned(), 2, &pictures);
        let number = |text: &str| Limbs::<3>::from_rational(&exact(text).unwrap(), &());
        let (error, energies) = (number("1e-40"), ["1", "1", "1 - 1e-45"].map(number));
        for (n, energy) in (0..).zip(&energies) {
            let (t, state) = (n as f64 / 4.0, [3.0, 4.0 * n as f64, 0.0, 0.0]);
            let modified_energy = (n != 1).then_some(energy);
            run.take(&Values { n, t, energy: Some(energy), modified_energy, estimate: Some(&error), state: &state });
        }
        let charts = run.finish().charts;
        let [(energy, _), (modified_energy, _), (estimate, _)] = &charts[0][..] else { panic!("{charts:?}") };
        let is_near = |points: &[(f64, f64)], height: f64| matches!(points, [(t, reached)] if *t == 0.5 && (reached - height).abs() < 1e-4);
        assert!(is_near(energy, -45.0) && is_near(modified_energy, -45.0), "{energy:?} {modified_energy:?}");
        assert!(estimate.len() == 3 && estimate.iter().all(|(_, height)| (height + 40.0).abs() < 1e-9));
        assert_eq!(charts[1], [(vec![(0.0, 3.0), (4.0, 3.0), (8.0, 3.0)], 1)]);
        assert_eq!(charts[2][0].0[..2], [(0.0, 3.0), (0.25, 5.0)]);
    }

    /// At a pericentre, where most runs begin, the modified energy is known worst.
    #[test]
    fn changes_are_measured_from_the_best_known_modified_energy() {
        let system = System::of_setup(problem("kepler").unwrap().setup(&[], 50).unwrap());
        let pictures = [Picture::read("energies", &system).unwrap()];
        let mut run = RunLines::<f64>::new("run".to_owned(), 3, &pictures);
        for (n, (value, error)) in (0..).zip([(1.5, 0.5), (1.0, 1e-9), (1.01, 0.1), (1.001, 1e-8)]) {
            let (energy, t) = (None, n as f64);
            run.take(&Values { n, t, energy, modified_energy: Some(&value), estimate: Some(&error), state: &[] });
        }
        let RunOfChart { charts, reference, .. } = run.finish();
        let modified_energy = &charts[0][1].0;
        let expected = [(0.0, 0.5_f64.log10()), (2.0, -2.0), (3.0, -3.0)];
        assert_eq!(modified_energy.len(), expected.len(), "{modified_energy:?}");
        // differences of numbers near 1 are known to 1e-16, and their logarithms to 1e-13
        let is_near = |one: &(f64, f64), other: &(f64, f64)| one.0 == other.0 && (one.1 - other.1).abs() < 1e-12;
        assert!(modified_energy.iter().zip(&expected).all(|(one, other)| is_near(one, other)), "{modified_energy:?}");
        assert!(reference.is_some_and(|reference| is_near(&reference, &(1.0, -9.0))), "{reference:?}");
    }
}
