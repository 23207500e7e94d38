//! The least and the greatest values of expressions along a run.

use shadowstep::number::saved::{Fields, optional};
use shadowstep::steps::integrator::{VectorIntegrator, at_output};

use crate::columns::column::Column;
use crate::columns::evaluator::Evaluator;
use crate::columns::extremum::Extremum;
use crate::run::Run;
use crate::scene::{NamedExpression, SceneNumber, System};
use crate::watch::summary::Extreme;

/// The least and the greatest values of expressions, over states in the order of time.
pub(crate) struct Extremes<'a, N: SceneNumber>(Vec<ExtremesOfOne<'a, N>>);

struct ExtremesOfOne<'a, N: SceneNumber> {
    name: &'a str,
    evaluator: Evaluator<N>,
    /// The least and the greatest value so far, each with the n of its first state.
    found: [Option<(N, i64)>; 2],
}

impl<'a, N: SceneNumber> Extremes<'a, N> {
    pub(crate) fn new(expressions: &'a [NamedExpression], system: &System, context: &N::Context) -> Self {
        let one = |named: &'a NamedExpression| ExtremesOfOne {
            name: &named.name,
            evaluator: named.evaluator(system, context),
            found: [None, None],
        };
        Extremes(expressions.iter().map(one).collect())
    }

    /// What was found, in the order of the text.
    pub(crate) fn found(&self) -> Vec<Extreme> {
        let one = |one: &ExtremesOfOne<'_, N>| {
            let [least, greatest] =
                one.found.each_ref().map(|found| found.as_ref().map(|(value, n)| (value.to_text(), *n)));
            Some(Extreme { name: one.name.to_owned(), least: least?, greatest: greatest? })
        };
        self.0.iter().filter_map(one).collect()
    }
}

impl<N: SceneNumber> Column<N> for Extremes<'_, N> {
    fn sees_each(&self) -> bool {
        !self.0.is_empty()
    }

    /// Values that are not finite are left out.
    fn see(&mut self, n: i64, run: Run<'_>, integrator: &mut VectorIntegrator<'_, N>) -> bool {
        at_output(integrator, |integrator| {
            for one in &mut self.0 {
                let value = one.evaluator.value(integrator.system(), || run.time(n));
                for (extremum, found) in [Extremum::Least, Extremum::Greatest].into_iter().zip(&mut one.found) {
                    if extremum.is_beyond(value, found.as_ref().map(|(value, _)| value)) {
                        *found = Some((value.clone(), n));
                    }
                }
            }
        });
        false
    }

    fn fields(&mut self, context: &N::Context, to: &mut dyn Fields<N>) {
        let none = (N::zero(context), 0);
        for found in self.0.iter_mut().flat_map(|one| &mut one.found) {
            optional(to, found, &none, |to, (value, n)| {
                to.number(value);
                to.whole(n);
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::Scene;
    use crate::watch::observer::testing::{self, rows, summary};

    fn read(more: &str, output: &str) -> Scene {
        testing::read(&format!(
            "{more}\n[run]\nscheme = \"yoshida4\"\nstep = \"1/10\"\nsteps = 100\ndigits = \"double\"\n[output]\n{output}"
        ))
    }

    const KEPLER: &str = "problem.name = \"kepler\"";

    /// Values are those of the state in the same row, with estimates and without, and extremes those of all rows.
    #[test]
    fn columns_and_extremes_are_of_the_states() {
        for modified in ["", "modified_energy = { estimator = \"bilinear\", order = 6 }\n"] {
            for problem in [KEPLER, "problem.name = \"kepler\"\ntime.transform = \"logarithmic\""] {
                let output = format!(
                    "{modified}energy = true\ntrajectory = true\nvalues = {{ x2 = \"2*x\", T = \"E + 0*t\", w \
                        = \"t/2\" }}\nextremes = {{ x = \"x\" }}"
                );
                let scene = read(problem, &output);
                let (rows, summary) = (rows(&scene), summary(&scene));
                let column = |name: &str| rows[0].iter().position(|found| found == name).unwrap();
                let number = |row: &[String], name: &str| row[column(name)].parse::<f64>().unwrap();
                for row in &rows[1..] {
                    assert_eq!(number(row, "x2"), 2.0 * number(row, "x"), "{row:?}");
                    assert_eq!(number(row, "w"), number(row, "t") / 2.0);
                    assert_eq!(row[column("T")], row[column("energy")]);
                }
                let all = || rows[1..].iter().map(|row| (number(row, "x"), number(row, "n")));
                let least = all().min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
                let greatest = all().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
                let found = &summary.extremes[0];
                let of = |(value, n): &(String, i64)| (value.parse::<f64>().unwrap(), *n as f64);
                assert_eq!((of(&found.least), of(&found.greatest)), (least, greatest));
            }
        }
    }

    #[test]
    fn values_have_their_period() {
        let scene = read(KEPLER, "energy = { every = 50 }\nvalues = { r = \"log(x)\", every = 20 }");
        let rows = rows(&scene);
        let written = |column: usize| {
            rows[1..]
                .iter()
                .filter(|row| !row[column].is_empty())
                .map(|row| row[0].clone())
                .collect::<Vec<_>>()
                .join(" ")
        };
        // where x < 0 the logarithm has no value
        assert_eq!((&*written(2), &*written(3)), ("0 50 100", "0 60"));
        assert!(summary(&scene).extremes.is_empty());
    }
}
