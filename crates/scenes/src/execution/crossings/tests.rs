use crate::scene::Scene;
use crate::watch::observer::testing;
use shadowstep_schemes::symbolic::decimal::{from_text, to_significant};

fn read(step: &str, trajectory: &str, more: &str) -> Scene {
    testing::read(&format!(
        "problem.name = \"henon-heiles\"\n[run]\nscheme = \"blanes-moan-srkn11b\"\nstep = \"{step}\"\nuntil = \
            60\ndigits = 40\n[output]\n\
         trajectory = {trajectory}\n{more}"
    ))
}

/// The rows without their names.
fn rows(scene: &Scene) -> Vec<Vec<String>> {
    testing::rows(scene).split_off(1)
}

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

/// Differences of halved steps fall as the order of the scheme says: the crossing is a point of the trajectory with the
/// error of a step.
#[test]
fn crossings_have_the_order_of_the_scheme() {
    let of_step = |step: &str| rows(&read(step, "{ section = \"x\" }", ""));
    let found = ["1/10", "1/20", "1/40"].map(of_step);
    assert_eq!(found.each_ref().map(Vec::len), [9, 9, 9]);
    let last = found.each_ref().map(|rows| &rows[8]);
    for row in last {
        assert!(number(&row[2]).abs() < 1e-40, "{row:?}");
        assert!(number(&row[4]) > 0.0);
    }
    let [a, b, c] = last.map(|row| &row[3]);
    let slope = (distance(a, b) / distance(b, c)).log2();
    assert!((slope - 6.0).abs() < 0.1, "{slope}");
}

/// The size of the difference of two decimals.
fn distance(a: &str, b: &str) -> f64 {
    let [a, b] = [a, b].map(|text| from_text(text).unwrap());
    number(&to_significant(&(a - b), 12)).abs()
}

fn of_formula(problem: &str, [scheme, step]: [&str; 2], trajectory: &str) -> Vec<Vec<String>> {
    let text = format!(
        "{problem}\n[run]\nscheme = \"{scheme}\"\nstep = \"{step}\"\nuntil = 4\ndigits = 40\n[output]\ntrajectory = \
            {trajectory}"
    );
    rows(&testing::read(&text))
}

/// x = cos(3t/2) grows through 0 at t = π: a crossing is as accurate as the states, also of a processed scheme, whose
/// kernel is not.
#[test]
fn crossings_of_processed_schemes_are_points_of_the_trajectory() {
    const PI: &str = "3.14159265358979323846264338327950288419716939937511";
    let oscillator = "[problem]\npotential = \"9/8*x^2 + y^2/2\"\ncoordinates = [\"x\", \"y\"]\n[initial]\nq = \
        [1, \"1/3\"]\np = [0, 0]";
    let schemes = shadowstep_schemes::shipped_names();
    let is_processed = |name: &&str| shadowstep_schemes::shipped_proved(name).unwrap().scheme.processor.is_some();
    let processed: Vec<&str> = schemes.into_iter().filter(is_processed).collect();
    assert!(processed.len() > 20, "{processed:?}");
    for scheme in processed {
        let crossings = of_formula(oscillator, [scheme, "1/32"], "{ section = \"x\", direction = \"up\" }");
        let [crossing] = &crossings[..] else { panic!("{scheme}: {crossings:?}") };
        let error = |row: &Vec<String>| {
            let [t, x, p] = [1, 2, 4].map(|column| number(&row[column]));
            (x - (1.5 * t).cos()).hypot(p + 1.5 * (1.5 * t).sin())
        };
        let of_states = of_formula(oscillator, [scheme, "1/32"], "true").iter().map(error).fold(1e-15, f64::max);
        let missed = distance(&crossing[1], PI);
        assert!(missed < of_states, "{scheme}: {missed:e} beside {of_states:e}");
    }
}

/// The same where the drift is the dominant part, beside a scheme of order 10 and short steps.
#[test]
fn crossings_have_the_effective_order_of_near_integrable_systems() {
    let weak = "[problem]\npotential = \"-cos(x)/1000\"\ncoordinates = [\"x\"]\n[initial]\nq = [0]\np = [1]";
    let crossing = |scheme: [&str; 2]| of_formula(weak, scheme, "{ section = \"x - 2\" }").remove(0).remove(1);
    let reference = crossing(["hairer10-33", "1/20"]);
    for scheme in ["wisdom-kernel-17", "bcr764"] {
        let missed = distance(&crossing([scheme, "1/3"]), &reference);
        // by steps of the kernel 4e-9 and 4e-10
        assert!(missed < 5e-11, "{scheme}: {missed:e}");
    }
}

/// The number types, as `digits` has them.
const NUMBERS: [&str; 6] = ["\"double\"", "\"compensated\"", "\"double-double\"", "12", "40", "320"];

/// The times of crossings in both directions of a scene without its digits.
fn times(scene: &str, digits: &str, section: &str) -> Vec<f64> {
    let text = scene.replace(
        "[run]",
        &format!(
            "[output]\ntrajectory = {{ section = \"{section}\", direction = \"both\" }}\n[run]\ndigits = {digits}"
        ),
    );
    let rows = rows(&testing::read(&text));
    rows.iter().map(|row| number(&row[1])).collect()
}

/// Round-off of the maps of processed schemes moves a start off the surface; one that is off it by more than round-off
/// is a crossing.
#[test]
fn a_start_on_the_surface_is_no_crossing_of_processed_schemes() {
    for scheme in ["bcm-rkn6-4", "bcm10-23", "escorihuela6-8", "wisdom-corrector-17"] {
        let oscillator = |x: &str| {
            format!(
                "[problem]\npotential = \"x^2/2 + y^2\"\ncoordinates = [\"x\", \"y\"]\n[initial]\nq = [{x}, 1]\np = \
                    [\"2/3\", \"1/7\"]\n\
                 [run]\nscheme = \"{scheme}\"\nstep = \"1/16\"\nuntil = 1"
            )
        };
        for digits in &NUMBERS[..if scheme == "bcm-rkn6-4" { 6 } else { 5 }] {
            for (x, section) in
                [("0", "x"), ("0", "x^3 + x"), ("\"1/3\"", "3*x - 1"), ("\"sqrt(2)\"", "x^2 - 2"), ("0", "E*x")]
            {
                let found = times(&oscillator(x), digits, section);
                assert!(found.first().is_none_or(|t| *t > 0.05), "{scheme}, {digits}, {section}: {found:?}");
            }
            // 1e-10 before the surface, with a speed of 2/3
            let found = times(&oscillator("-1e-10"), digits, "x");
            assert!((found[0] - 1.5e-10).abs() < 1e-15, "{scheme}, {digits}: {found:?}");
            let found = times(&oscillator("\"1/3 - 1e-10\""), digits, "3*x - 1");
            assert!((found[0] - 1.5e-10).abs() < 1e-15, "{scheme}, {digits}: {found:?}");
        }
    }
}

/// Planets at their pericentres: r·v is 0 but for the round-off of their elements.
#[test]
fn a_start_at_the_pericentre_is_no_crossing() {
    for parts in ["wisdom-holman", "wisdom-holman-heliocentric", "kinetic-potential"] {
        for angle in 1..4 {
            let scene = format!(
                "[problem]\nparts = \"{parts}\"\nparameters = {{ g = 1 }}\n[[body]]\nmass = 1\n[[body]]\nmass \
                    = \"1/1000\"\na = 1\ne = \"1/{angle}0\"\ni = \"{angle}/5\"\npericentre = \"{angle}\"\n\
                 node = \"{angle}/3\"\nM = 0\n[[body]]\nmass = \"1/3000\"\na = 3\ne = \"1/3\"\n[run]\nscheme \
                 = \"abah864\"\nstep = \"1/10\"\nuntil = 7"
            );
            let of = |x: &str| format!("({x}2 - {x}1)*(1000*p{x}2 - p{x}1)");
            let section = ["x", "y", "z"].map(of).join(" + ");
            for digits in &NUMBERS[..if angle == 1 { 6 } else { 5 }] {
                let found = times(&scene, digits, &section);
                // the apocentre and the pericentre
                assert!(
                    found.len() == 2 && (found[0] - std::f64::consts::PI).abs() < 0.1,
                    "{parts}, {angle}, {digits}: {found:?}"
                );
            }
        }
    }
}

/// A pole and the turn of an angle change the sign, and are no zeros.
#[test]
fn a_jump_is_no_crossing() {
    // an orbit on which x and y are not 0 in one step
    let start = "[initial]\nq = [\"1/10\", \"1/5\"]\np = [\"3/10\", \"-1/10\"]\n";
    let count = |section: &str| {
        rows(&read("1/10", &format!("{{ section = \"{section}\", direction = \"both\" }}"), start)).len()
    };
    assert!(count("x") > 10 && count("y") > 10);
    assert_eq!(count("y/x"), count("y"));
    assert_eq!(count("atan(y/x)"), count("y"));
    // 1/y has no zero
    assert_eq!(count("1/y"), 0);
}

/// Up and down are both together, x = 0 at the start being no crossing, and the run itself goes on as without a
/// section.
#[test]
fn a_section_changes_nothing_else() {
    let count =
        |direction: &str| rows(&read("1/10", &format!("{{ section = \"x\", direction = \"{direction}\" }}"), "")).len();
    assert_eq!((count("up"), count("down"), count("both")), (9, 10, 19));
    let energies = |trajectory: &str| {
        let rows = rows(&read("1/10", trajectory, "energy = { every = 100 }"));
        let is_of_step = |row: &Vec<String>| (number(&row[1]) * 10.0 - number(&row[0])).abs() < 1e-9;
        assert!(
            rows.iter().all(|row| !row[2].is_empty()) && rows.is_sorted_by_key(|row| (number(&row[1]) * 1e9) as i64)
        );
        rows.into_iter().filter(is_of_step).map(|row| row[2].clone()).collect::<Vec<_>>()
    };
    assert_eq!(energies("{ section = \"x\", direction = \"both\" }"), energies("{ every = 1000 }"));
}

/// Only a crossing costs forces.
#[test]
fn a_surface_that_is_not_crossed_costs_no_forces() {
    let evaluations = |trajectory: &str| {
        let scene = read("1/10", trajectory, "summary = false");
        scene.run_into(&mut Vec::new(), &mut ()).unwrap()
    };
    assert_eq!(evaluations("{ section = \"x - 100\" }"), evaluations("true"));
}

/// cos t = 0 of the coordinate t.
#[test]
fn a_section_may_be_one_of_explicit_time() {
    for time in ["", "[time]\ntransform = \"logarithmic\"\n"] {
        let text = format!(
            "[problem]\npotential = \"-(1 + sin(t)/10)/sqrt(x^2 + 1)\"\ncoordinates = [\"x\"]\n[initial]\nq = [1]\np \
                = [0]\n{time}[run]\n\
             scheme = \"blanes-moan-s6\"\nstep = \"1/10\"\nuntil = 20\ndigits = 30\n[output]\ntrajectory = {{ section \
             = \"cos(t)\" }}"
        );
        let rows = rows(&testing::read(&text));
        // cos grows through 0 at 3π/2, 7π/2 and 11π/2
        for (row, quarters) in rows.iter().zip([3.0, 7.0, 11.0]) {
            assert!((number(&row[1]) - quarters * std::f64::consts::FRAC_PI_2).abs() < 1e-14, "{row:?}");
        }
        assert_eq!(rows.len(), 3);
    }
}
