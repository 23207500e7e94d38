//! `shadowstep problems`.

use crate::program::{objects, quietly, text};
use shadowstep::problems::PROBLEMS;

#[test]
fn every_problem_is_listed_with_its_parameters_and_initial_values() {
    // lines are broken at 80 columns
    let in_a_line = |words: &str| quietly(words).split_whitespace().collect::<Vec<_>>().join(" ");
    let all = in_a_line("problems");
    let records = objects(&quietly("problems --json"));
    assert_eq!(records.len(), PROBLEMS.len());
    for (problem, record) in PROBLEMS.iter().map(|problem| problem.description()).zip(&records) {
        assert_eq!(text(record, "name"), problem.name);
        assert_eq!(text(record, "hamiltonian"), problem.hamiltonian);
        assert!(all.contains(problem.hamiltonian) && all.contains(problem.source), "{all}");
        let one = in_a_line(&format!("problems {}", problem.name));
        let initial = (problem.initial)();
        for (name, default) in initial.positions.iter().chain(&initial.momenta) {
            assert!(one.contains(&format!("{name} = {default}")), "{name} in\n{one}");
        }
        for parameter in problem.parameters {
            assert!(one.contains(&format!("{} = {}", parameter.name, parameter.default)), "{one}");
            assert!(one.contains(parameter.meaning) && one.contains(parameter.range), "{one}");
        }
    }
}
