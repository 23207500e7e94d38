//! Charts of runs: `trace --plot`, and `plot` in a scene.

use std::fs;
use std::path::Path;

use crate::program::{Finished, quietly, shadowstep};
use crate::scenes::{folder, names, run};

const RUN: &str =
    "trace kepler --scheme stormer-verlet --step 1/32 --until 4 --digits 30 --estimator central --order 5 --no-summary";

/// The pictures of a scene like [`RUN`].
const SCENE: &str = r#"
[problem]
name = "kepler"
[run]
scheme = "stormer-verlet"
step = "1/32"
until = 4
digits = 30
[output]
energy = true
modified_energy = { estimator = "central", order = 5 }
trajectory = true
file = "rows.csv"
plot = { file = "kepler.svg", of = ["energies", "orbit=x:y", "distance"] }
"#;

fn plot(folder: &Path, words: &str) -> Finished {
    shadowstep(&format!("{words} --plot {}", folder.join("kepler.svg").display()))
}

fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}

/// The curves of a chart: the points of lines with more points than those of axes.
fn curves(svg: &str) -> Vec<&str> {
    let lines = svg.split(" points=\"").skip(1).map(|rest| rest.split('"').next().unwrap());
    lines.filter(|points| points.split_whitespace().count() > 20).collect()
}

#[test]
fn a_plot_alone_is_written_without_rows() {
    let folder = tempfile::tempdir().unwrap();
    let result = plot(folder.path(), RUN);
    assert_eq!((result.code, result.out.as_str(), result.err.as_str()), (0, "", ""));
    assert_eq!(names(folder.path()), ["kepler.svg"]);
    let svg = read(folder.path(), "kepler.svg");
    assert_eq!(curves(&svg).len(), 3, "H, the modified energy and its error");
    for text in ["yoshida4", "ruth3"] {
        assert!(!svg.contains(text));
    }
    for text in ["stormer-verlet, step 1/32", ">H</text>", ">H̄</text>", ">error of H̄</text>", "time t"] {
        assert!(svg.contains(text), "{text}");
    }
    // rows where they are requested, and the same ones
    for flag in ["--json", "--csv", "--states"] {
        assert_eq!(plot(folder.path(), &format!("{RUN} {flag} --force")).out, quietly(&format!("{RUN} {flag}")));
    }
}

#[test]
fn several_charts_have_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let result = plot(folder.path(), &format!("{RUN} --plot-of orbit=x:y,energies,distance"));
    assert_eq!((result.code, result.err.as_str()), (0, ""));
    assert_eq!(names(folder.path()), ["kepler-distance.svg", "kepler-energies.svg", "kepler.svg"]);
    let [orbit, distance] = ["kepler.svg", "kepler-distance.svg"].map(|name| read(folder.path(), name));
    assert!(curves(&orbit).len() == 1 && orbit.contains(">x</text>") && orbit.contains(">y</text>"));
    // from 1 - e to 1 + e
    assert!(curves(&distance).len() == 1 && distance.contains(">0.4</text>") && distance.contains(">1.6</text>"));
}

#[test]
fn curves_of_several_runs_have_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let words = RUN.replace("stormer-verlet", "ruth3,yoshida4").replace("1/32", "1/32,1/64");
    assert_eq!(plot(folder.path(), &format!("{words} --plot-of energies,orbit=x:px")).code, 0);
    let [energies, orbit] = ["kepler.svg", "kepler-orbit-x-px.svg"].map(|name| read(folder.path(), name));
    assert_eq!((curves(&energies).len(), curves(&orbit).len()), (8, 4));
    assert!(energies.contains(">H̄, yoshida4, step 1/64</text>") && orbit.contains(">ruth3, step 1/32</text>"));
}

#[test]
fn all_bodies_are_in_one_chart() {
    let folder = tempfile::tempdir().unwrap();
    let words = "trace outer-solar-system --scheme yoshida4 --step 100 --until 20000 --double --order 2 --no-summary";
    assert_eq!(plot(folder.path(), &format!("{words} --plot-of orbit=x:y,distance=sun")).code, 0);
    let [orbit, distance] = ["kepler.svg", "kepler-distance-sun.svg"].map(|name| read(folder.path(), name));
    assert!(["sun", "jupiter", "pluto"].iter().all(|body| orbit.contains(&format!(">{body}</text>"))));
    assert!(curves(&distance).len() == 5 && distance.contains(">sun–neptune</text>"));
}

#[test]
fn other_files_are_not_replaced_without_force() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("kepler-distance.svg"), "mine").unwrap();
    let words = format!("{RUN} --plot-of energies,distance");
    let result = plot(folder.path(), &words);
    assert!(result.code == 2 && result.err.contains("kepler-distance.svg already exists"), "{}", result.err);
    assert_eq!(names(folder.path()), ["kepler-distance.svg"]);
    assert_eq!(plot(folder.path(), &format!("{words} --force")).code, 0);
    assert!(read(folder.path(), "kepler-distance.svg").starts_with("<svg "));
}

#[test]
fn the_charts_of_a_scene_are_those_of_trace() {
    let charts = ["kepler.svg", "kepler-orbit-x-y.svg", "kepler-distance.svg"];
    for (file, digits, flag) in
        [("rows.csv", "30", "--digits 30"), ("rows.jsonl", "30", "--digits 30"), ("rows.npy", "\"double\"", "--double")]
    {
        let of_trace = tempfile::tempdir().unwrap();
        let words = format!("{} --plot-of energies,orbit=x:y,distance", RUN.replace("--digits 30", flag));
        assert_eq!(plot(of_trace.path(), &words).code, 0);
        let folder = folder(&SCENE.replace("rows.csv", file).replace("digits = 30", &format!("digits = {digits}")));
        let result = run(folder.path(), "");
        assert_eq!((result.code, result.err.as_str()), (0, ""));
        for chart in charts {
            let [of_scene, of_trace] = [folder.path(), of_trace.path()].map(|folder| read(folder, chart));
            assert!(of_scene.contains("scene.toml: stormer-verlet, step 1/32"), "{chart}");
            assert!(!curves(&of_scene).is_empty() && curves(&of_scene) == curves(&of_trace), "{file}: {chart}");
        }
    }
}

#[test]
fn rows_that_are_not_at_every_step_are_drawn() {
    let scene = SCENE
        .replace("energy = true\n", "energy = { every = 4 }\n")
        .replace("modified_energy = { estimator = \"central\", order = 5 }\n", "");
    let folder = folder(&scene.replace("trajectory = true", "trajectory = { every = 2 }"));
    assert_eq!(run(folder.path(), "").code, 0);
    let points = |name: &str| {
        let svg = read(folder.path(), name);
        curves(&svg).iter().map(|points| points.split_whitespace().count()).collect::<Vec<_>>()
    };
    // 128 steps; the change at t = 0 is 0, which a logarithmic axis does not have
    assert_eq!((points("kepler.svg"), points("kepler-distance.svg")), (vec![32], vec![65]));
}

#[test]
fn a_chart_of_a_complete_run_is_drawn_from_its_rows() {
    let folder = folder(SCENE);
    assert_eq!(run(folder.path(), "").code, 0);
    let drawn = read(folder.path(), "kepler-distance.svg");
    fs::remove_file(folder.path().join("kepler-distance.svg")).unwrap();
    let result = run(folder.path(), "");
    assert!(result.code == 0 && result.err.contains("is done"), "{}", result.err);
    assert_eq!(read(folder.path(), "kepler-distance.svg"), drawn);
    // its own charts are replaced
    assert_eq!(run(folder.path(), "--restart").code, 0);

    fs::write(folder.path().join("kepler.svg"), "mine").unwrap();
    for flags in ["", "--restart"] {
        let result = run(folder.path(), flags);
        let place = "scene.toml:14:17: ";
        let message = "kepler.svg already exists and is not from this unchanged scene";
        assert!(result.code == 2 && result.err.contains(place) && result.err.contains(message), "{}", result.err);
    }
    assert_eq!(read(folder.path(), "kepler.svg"), "mine");
    assert_eq!(run(folder.path(), "--force --restart").code, 0);
    assert!(read(folder.path(), "kepler.svg").contains("<svg "));
}
