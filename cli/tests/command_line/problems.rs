//! `shadowstep problems`.

use crate::program::{objects, quietly, shadowstep, text};
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

#[test]
fn json_has_parameters_and_state() {
    let kepler = &objects(&quietly("problems kepler --json"))[0];
    assert_eq!(text(&kepler["parameters"][0], "name"), "eccentricity");
    assert_eq!(text(&kepler["parameters"][0], "default"), "0.6");
    assert_eq!(kepler["positions"][1], serde_json::json!({"name": "y", "default": "0"}));
    assert_eq!(text(&kepler["momenta"][0], "name"), "px");
}

#[test]
fn every_problem_runs() {
    for problem in PROBLEMS.iter().map(|problem| problem.description()) {
        let words = format!(
            "drift --problem {} --scheme stormer-verlet --step {} --until 10*{1} --double --order 2 --json",
            problem.name, problem.step
        );
        let record = &objects(&quietly(&words))[0];
        let initial = (problem.initial)();
        let count = problem.parameters.len() + initial.positions.len() + initial.momenta.len();
        assert_eq!(record["parameters"].as_object().unwrap().len(), count);
    }
}

#[test]
fn an_unknown_problem_gets_a_hint() {
    let result = shadowstep("problems pendulun");
    assert_eq!((result.code, result.out.as_str()), (2, ""));
    assert_eq!(result.err, "error: there is no problem `pendulun`\n  hint: did you mean `pendulum`?\n");
}
