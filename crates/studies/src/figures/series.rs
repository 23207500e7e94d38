//! How much the modified Hamiltonian varies along a run as a series that ends at a power of h: by a scene, whose
//! columns it is.

use std::fmt::Write as _;

use shadowstep::tables::Source;
use shadowstep_scenes::{Observer, Outcome, Scene};

use crate::Continues;
use crate::Error;
use crate::figures::numbers::number;
use crate::figures::run::Run;

/// The highest powers of h, from H itself; a symmetric scheme has no odd ones.
pub(crate) const GRADES: [(u32, &str); 6] = [
    (0, "max - min of H"),
    (2, "max - min up to h^2"),
    (4, "max - min up to h^4"),
    (6, "max - min up to h^6"),
    (8, "max - min up to h^8"),
    (10, "max - min up to h^10"),
];

/// The progress of the run, which stops with the calculation.
struct SeriesProgress<'a> {
    continues: Continues<'a>,
    steps: f64,
    n: i64,
}

impl Observer for SeriesProgress<'_> {
    fn progress(&mut self, n: i64) {
        self.n = n;
    }

    fn stops(&mut self) -> bool {
        !(self.continues)(self.n as f64 / self.steps)
    }
}

/// max − min of the series up to each of the grades.
pub(crate) fn variations(run: &Run, continues: Continues<'_>) -> Result<Vec<String>, Error> {
    let mut text = format!("problem.name = \"{}\"\n", run.problem.name());
    for (name, value) in &run.set {
        writeln!(text, "problem.parameters.{name} = \"{value}\"").expect("a text can be written");
    }
    let Run { propagator, step, until, digits, .. } = run;
    let grades: Vec<u32> = GRADES[1..].iter().map(|(grade, _)| *grade).collect();
    write!(
        text,
        "[run]\nscheme = \"{propagator}\"\nstep = \"{step}\"\nuntil = {until}\ndigits = {digits}\n\
         [output]\nsummary = false\nvalues = {{ H = \"E\" }}\nmodified_hamiltonian = {grades:?}\n"
    )
    .expect("a text can be written");
    let scene = Scene::read(Source { path: "series.toml".to_owned(), text }).expect("figures have valid scenes");
    let mut rows = Vec::new();
    let mut observer = SeriesProgress { continues, steps: run.steps() as f64, n: 0 };
    if let Outcome::Stopped { n } = scene.run_into(&mut rows, &mut observer)? {
        return Err(Error::run(format!("the run was stopped at n = {n}"), "run it again"));
    }
    let rows = String::from_utf8(rows).expect("rows are text");
    let mut lines = rows.lines().filter(|line| !line.starts_with('#')).map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().expect("rows have a head");
    let rows: Vec<_> = lines.collect();
    let range = |grade: u32| {
        let name = if grade == 0 { "H".to_owned() } else { format!("modified_hamiltonian_{grade}") };
        let column = names.iter().position(|found| **found == name).expect("the scene has the column");
        let mut values: Vec<_> = rows.iter().map(|row| number(row[column])).collect();
        values.sort_by(|a, b| a.partial_cmp(b).expect("energies are finite"));
        (&values[values.len() - 1] - &values[0]).to_text()
    };
    Ok(GRADES.iter().map(|(grade, _)| range(*grade)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::numbers::log10;
    use shadowstep::problems::Problem;

    /// What is left falls like the first power of h that is left out, for a symmetric scheme h^(g + 2).
    #[test]
    fn the_columns_are_the_series_up_to_each_grade() {
        let [coarse, fine] = ["1/16", "1/32"].map(|step| {
            variations(&Run::of(Problem::Pendulum, "stormer-verlet", step).until("2").digits(60), &|_| true).unwrap()
        });
        for ((grade, _), (coarse, fine)) in GRADES.iter().zip(coarse.iter().zip(&fine)) {
            let power = (log10(coarse) - log10(fine)) / 2f64.log10();
            // the next power of h, and the states at which the extremes are
            assert!((power - f64::from(grade + 2)).abs() < 0.1, "up to h^{grade}: h^{power:.2}");
        }
        assert!(variations(&Run::of(Problem::Pendulum, "stormer-verlet", "1/16"), &|_| false).is_err());
    }
}
