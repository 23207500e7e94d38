//! Scenes of bodies: sums over pairs have the bits of the shipped problems, and formulas stand for long lists.

use crate::scenes::{printed, table};

const OUTER_SOLAR_SYSTEM: &str = r#"
[problem]
pair = "-g*m_i*m_j/sqrt(r2)"
dimensions = 3
bodies = { m = [1.00000597682, 0.000954786104043, 0.000285583733151, 0.0000437273164546, 0.0000517759138449, "1/1.3e8"] }
masses = "m"
parameters = { g = 2.95912208286e-4 }
[initial]
q = [
    [0, 0, 0],
    [-3.5023653, -3.8169847, -1.5507963],
    [9.0755314, -3.0458353, -1.6483708],
    [8.3101420, -16.2901086, -7.2521278],
    [11.4707666, -25.7294829, -10.8169456],
    [-15.5387357, -25.2225594, -3.1902382],
]
v = [
    [0, 0, 0],
    [0.00565429, -0.00412490, -0.00190589],
    [0.00168318, 0.00483525, 0.00192462],
    [0.00354178, 0.00137102, 0.00055029],
    [0.00288930, 0.00114527, 0.00039677],
    [0.00276725, -0.00170702, -0.00136504],
]
[run]
step = 100
"#;

const FIGURE_EIGHT: &str = r#"
[problem]
pair = "-m_i*m_j/sqrt(r2)"
dimensions = 2
bodies = { m = [1, 1, 1] }
masses = "m"
[initial]
q = [0.97000436, -0.24308753, -0.97000436, 0.24308753, 0, 0]
v = [0.466203685, 0.43236573, 0.466203685, 0.43236573, -0.93240737, -0.86473146]
[run]
step = "1/100"
"#;

const FPUT_ALPHA: &str = r#"
[problem]
pair = "d^2/2 + alpha*d^3/3"
bodies = 32
neighbours = "fixed"
parameters = { alpha = 0.25 }
[initial]
q = "sin(i*pi/33)/sin(16*pi/33)"
p = "0"
[run]
step = 0.025
"#;

const TODA: &str = r#"
[problem]
pair = "exp(-d) + d - 1"
bodies = { count = 200, m = "1" }
neighbours = "periodic"
masses = "m"
[initial]
q = "0"
v = "sin(i*pi/100)/m"
[run]
step = 0.05
"#;

/// A scene that ends with its step, with all outputs.
fn whole(scene: &str, digits: &str) -> String {
    format!(
        "{scene}steps = 40\nscheme = \"yoshida4\"\ndigits = {digits}\n\
         [output]\nenergy = true\nmodified_energy = {{ order = 6 }}\ntrajectory = true\n"
    )
}

/// The lines below the head and the names of the columns, which differ.
fn rows(csv: &str) -> Vec<&str> {
    csv.lines().filter(|line| !line.starts_with('#')).skip(1).collect()
}

#[test]
fn pairs_have_the_bits_of_the_shipped_problems() {
    for (problem, step, scene) in [
        ("outer-solar-system", "100", OUTER_SOLAR_SYSTEM),
        ("figure-eight", "0.01", FIGURE_EIGHT),
        ("fput-alpha", "0.025", FPUT_ALPHA),
        ("toda", "0.05", TODA),
    ] {
        let shipped = format!("[problem]\nname = \"{problem}\"\n[run]\nstep = {step}\n");
        for digits in ["\"double\"", "40"] {
            let (own, shipped) = (printed(&whole(scene, digits)), printed(&whole(&shipped, digits)));
            assert_eq!(rows(&own).len(), 41, "{problem}");
            assert!(rows(&own) == rows(&shipped), "{problem}, {digits} digits");
        }
    }
}

#[test]
fn bodies_have_fixed_names_of_coordinates_and_momenta_and_are_in_the_metadata() {
    for (scene, names, lines) in [
        (
            FIGURE_EIGHT,
            "x1 y1 x2 y2 x3 y3 px1 py1 px2 py2 px3 py3",
            "# pair: -m_i*m_j/sqrt(r2)\n# dimensions: 2\n# bodies: {\"m\":[\"1\",\"1\",\"1\"]}\n",
        ),
        (OUTER_SOLAR_SYSTEM, "x1 y1 z1 x2 y2", "# dimensions: 3\n"),
        (FPUT_ALPHA, "q1 q2", "# bodies: 32\n# neighbours: fixed\n"),
    ] {
        let csv = printed(&whole(scene, "30"));
        let columns = table(&csv).0[6..].join(" ");
        assert!(csv.contains(lines) && columns.starts_with(names), "{names}: {csv}");
        assert!(scene != FPUT_ALPHA || columns.contains(" q32 p1 ") && columns.ends_with(" p32"), "{columns}");
    }
}

/// The rows of a scene.
fn run_of(scene: &str) -> Vec<Vec<String>> {
    table(&printed(&whole(scene, "30"))).1
}

#[test]
fn a_list_may_be_flat_or_of_lists_or_a_formula() {
    let flat = run_of(FIGURE_EIGHT);
    let q = "[0.97000436, -0.24308753, -0.97000436, 0.24308753, 0, 0]";
    let lists = "[[0.97000436, -0.24308753], [-0.97000436, 0.24308753], [0, 0]]";
    assert_eq!(flat, run_of(&FIGURE_EIGHT.replace(q, lists)));
    assert_eq!(flat, run_of(&FIGURE_EIGHT.replace("masses = \"m\"", "masses = [1, 1, 1]")));
    let chain = |bodies: &str, masses: &str, q: &str| {
        format!(
            "[problem]\npair = \"c_i*c_j*d^2/2\"\nbodies = {bodies}\nmasses = {masses}\nneighbours = \"free\"\n\
             [initial]\nq = {q}\np = \"0\"\n[run]\nstep = 0.1\n"
        )
    };
    let lists = run_of(&chain("{ c = [1, 4, 9], m = [3, 6, 11] }", "[3, 6, 11]", "[1, 0.5, \"1/3\"]"));
    let formulas = run_of(&chain("{ count = 3, c = \"i^2\", m = \"c + 2\" }", "\"m\"", "\"1/i\""));
    let nested = run_of(&chain("{ c = [1, 4, 9], m = \"c + 2\" }", "\"c + 2\"", "[[1], [0.5], [\"1/3\"]]"));
    assert_eq!(lists, formulas);
    assert_eq!(lists, nested);
}

#[test]
fn a_general_kinetic_energy_moves_bodies() {
    let kinetic = "sqrt(1 + px1^2 + py1^2) + sqrt(1 + px2^2 + py2^2) + sqrt(1 + px3^2 + py3^2)";
    let scene = FIGURE_EIGHT.replace("masses = \"m\"", &format!("kinetic = \"{kinetic}\"")).replace("v =", "p =");
    let rows = run_of(&scene);
    let spread = |column: usize| {
        let values: Vec<f64> = rows.iter().map(|row| row[column].parse().unwrap()).collect();
        values.iter().copied().fold(f64::MIN, f64::max) - values.iter().copied().fold(f64::MAX, f64::min)
    };
    // h^4 against h^6 and beyond
    assert!(spread(2) > 1e-10 && spread(3) < spread(2) / 100.0, "{} {}", spread(2), spread(3));
}
