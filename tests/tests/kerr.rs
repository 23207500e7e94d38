//! Protects parts with the flows of monomials, and transformed time of many parts: geodesics of Kerr's metric, as the
//! shipped scene has them.
//!
//! Yardsticks in closed form: Carter's constant; the roots of the quartic R(r) and of Θ, where the orbit turns; the
//! radial period in the time of Mino by a complete elliptic integral (R. Fujita, W. Hikida, Class. Quantum Grav. 26
//! (2009) 135002, eqs. 14 and 15).

use std::f64::consts::PI;

use shadowstep_scenes::Scene;

use shadowstep::tables::Source;

const A: f64 = 0.9;
const ENERGY: f64 = 0.95;
const MOMENTUM: f64 = 2.0;
const FARTHEST: f64 = 15.0;

/// Carter's constant of an orbit that turns at the equator in r = FARTHEST.
fn carter() -> f64 {
    let delta = FARTHEST * FARTHEST - 2.0 * FARTHEST + A * A;
    let first = (FARTHEST * FARTHEST + A * A) * ENERGY - A * MOMENTUM;
    first * first / delta - FARTHEST * FARTHEST - (MOMENTUM - A * ENERGY).powi(2)
}

/// The roots of R(r), from the largest to the smallest.
fn radii() -> [f64; 4] {
    let q = carter();
    let below = ENERGY * ENERGY - 1.0;
    let [c4, c3, c2] = [below, 2.0, A * A * below - MOMENTUM * MOMENTUM - q];
    let [c1, c0] = [2.0 * ((A * ENERGY - MOMENTUM).powi(2) + q), -A * A * q];
    let r = |x: f64| (((c4 * x + c3) * x + c2) * x + c1) * x + c0;
    let mut found: Vec<f64> = Vec::new();
    for i in 0..40_000 {
        let [mut left, mut right] = [i, i + 1].map(|i| f64::from(i) / 2000.0 + 1e-5);
        if r(left) * r(right) < 0.0 {
            for _ in 0..60 {
                let middle = (left + right) / 2.0;
                if r(left) * r(middle) <= 0.0 { right = middle } else { left = middle }
            }
            found.push(left);
        }
    }
    found.reverse();
    found.try_into().expect("a bound orbit has four radii")
}

/// cos² of the angle farthest from the equator: the smaller root of Θ.
fn square_of_cosine() -> f64 {
    let beta = A * A * (1.0 - ENERGY * ENERGY);
    let sum = carter() + MOMENTUM * MOMENTUM + beta;
    // without cancellation
    2.0 * carter() / (sum + (sum * sum - 4.0 * beta * carter()).sqrt())
}

/// ∫₀^{π/2} dφ/√(1 − k² sin²φ), by the arithmetic–geometric mean.
fn complete_elliptic_integral(square_of_k: f64) -> f64 {
    let (mut a, mut g) = (1.0, (1.0 - square_of_k).sqrt());
    for _ in 0..8 {
        (a, g) = ((a + g) / 2.0, (a * g).sqrt());
    }
    PI / (2.0 * a)
}

/// The columns of a run of the shipped scene with other sections [run] and [output], and other parts.
fn columns(parts: Option<&str>, rest: &str) -> Vec<Vec<f64>> {
    let shipped = shadowstep_scenes::scene_text("kerr").expect("it is shipped");
    let (problem, _) = shipped.split_once("[run]").unwrap();
    let problem = match parts {
        None => problem.to_owned(),
        Some(parts) => {
            let (before, after) = problem.split_once("parts = [").unwrap();
            format!("{before}parts = [{parts}{}", &after[after.find("\n]").unwrap()..])
        }
    };
    let scene = Scene::read(Source { path: "kerr.toml".to_owned(), text: problem + rest }).unwrap();
    let mut rows = Vec::new();
    scene.run_into(&mut rows, &mut ()).unwrap();
    let text = String::from_utf8(rows).unwrap();
    let rows: Vec<Vec<f64>> = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    (0..rows[0].len()).map(|column| rows.iter().map(|row| row[column]).collect()).collect()
}

/// n, t, r, th, tau, pr, pth, ptau at the crossings of a surface.
fn turns(parts: Option<&str>, section: &str, step: &str) -> Vec<Vec<f64>> {
    let rest = format!(
        "[run]\nscheme = \"kahan-li8\"\nstep = {step}\nsteps = 3000\ndigits = \"double\"\n[output]\ntrajectory = \
            {section}\n"
    );
    columns(parts, &rest)
}

fn farthest_from(values: impl Iterator<Item = f64>, expected: f64) -> f64 {
    values.map(|value| (value - expected).abs()).fold(0.0, f64::max)
}

/// Errors are those of the scheme: 1e-9 here, and 2⁸ times smaller for half the step.
#[test]
fn orbits_turn_at_the_roots() {
    let [farthest, nearest, ..] = radii();
    assert!((farthest - FARTHEST).abs() < 1e-12);
    for (direction, radius) in [("up", nearest), ("down", farthest)] {
        let section = format!("{{ section = \"pr\", direction = \"{direction}\" }}");
        let found = turns(None, &section, "\"1/2\"");
        assert!(found[2].len() > 5, "{direction}: {}", found[2].len());
        let off = farthest_from(found[2].iter().copied(), radius);
        println!("{direction}: {off:e}");
        assert!(off < 1e-8, "{direction}: {off:e}");
    }
    let found = turns(None, "{ section = \"pth\", direction = \"both\" }", "\"1/2\"");
    let off = farthest_from(found[3].iter().map(|angle| angle.cos().powi(2)), square_of_cosine());
    println!("th: {off:e}");
    assert!(found[3].len() > 10 && off < 1e-8, "{off:e}");
}

/// The steps do not use Carter's constant: its error has the order of the scheme.
#[test]
fn carters_constant_is_kept() {
    let errors = ["1", "1/2", "1/4"].map(|step| {
        let rest = format!(
            "[run]\nscheme = \"blanes-moan-s6\"\nstep = \"{step}\"\nuntil = 500\ndigits = \
             \"double\"\n[output]\nvalues = {{ carter = \"pth^2 + cos(th)^2*(a^2*(1 - en^2) + (lz/sin(th))^2)\" }}\n"
        );
        farthest_from(columns(None, &rest)[2].iter().copied(), carter())
    });
    println!("{errors:?}");
    let orders = [(errors[0] / errors[1]).log2(), (errors[1] / errors[2]).log2()];
    assert!(errors[2] < 1e-6 && orders.iter().all(|order| (order - 4.0).abs() < 0.4), "{errors:?} {orders:?}");
}

/// In the time of Mino, dτ = Σ dλ, r moves by itself, with a period in closed form; other parts, other flows.
#[test]
fn the_period_in_minos_time_is_an_elliptic_integral() {
    let parts = "\n\"((a*en*sin(th) - lz/sin(th))^2 - ((r^2 + a^2)*en - a*lz)^2/(r^2 - 2*r + a^2))/2 + (r^2 + \
        (a*cos(th))^2)*ptau\",\n\
                 \"r^2*pr^2/2\", \"-r*pr^2\", \"(a^2*pr^2 + pth^2)/2\"";
    let [r1, r2, r3, r4] = radii();
    let square_of_k = (r1 - r2) * (r3 - r4) / ((r1 - r3) * (r2 - r4));
    let period =
        4.0 * complete_elliptic_integral(square_of_k) / ((1.0 - ENERGY * ENERGY) * (r1 - r3) * (r2 - r4)).sqrt();
    let found = turns(Some(parts), "{ section = \"pr\" }", "\"1/50\"");
    let times = &found[1];
    assert!(times.len() > 10);
    let off = farthest_from(times.windows(2).map(|pair| pair[1] - pair[0]), period);
    println!("{period} {off:e}");
    assert!(off < 1e-9 * period, "{period}: {off:e}");
}
