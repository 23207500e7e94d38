//! Nelder and Mead's simplex method: the least value of a function that may have kinks, without derivatives.
//!
//! J. A. Nelder, R. Mead, A simplex method for function minimization, Comput. J. 7 (1965) 308; expansion, contraction
//! and shrinking as usual, by 2, 1/2 and 1/2.

/// A corner of the simplex: where, and the value there.
type Corner = (Vec<f64>, f64);

/// The least value that is found from a simplex, and where it is. It ends when all corners' values agree to
/// `tolerance`, relatively, or after `evaluations`. A function value that is not finite is larger than all others.
pub(super) fn minimise(
    function: &mut dyn FnMut(&[f64]) -> f64,
    simplex: Vec<Vec<f64>>,
    tolerance: f64,
    evaluations: usize,
) -> Corner {
    let mut left = evaluations;
    let mut value = |x: Vec<f64>| {
        left = left.saturating_sub(1);
        let value = function(&x);
        ((x, if value.is_finite() { value } else { f64::INFINITY }), left > 0)
    };
    let mut corners: Vec<Corner> = simplex.into_iter().map(|x| value(x).0).collect();
    loop {
        corners.sort_by(|a, b| a.1.total_cmp(&b.1));
        let (best, worst) = (corners[0].1, corners[corners.len() - 1].1);
        let may_go_on = step(&mut corners, &mut value);
        if !may_go_on || worst - best <= tolerance * best.abs() {
            corners.sort_by(|a, b| a.1.total_cmp(&b.1));
            return corners.swap_remove(0);
        }
    }
}

/// Replaces the worst of sorted corners, or all but the best; whether there are evaluations left.
fn step(corners: &mut Vec<Corner>, value: &mut impl FnMut(Vec<f64>) -> (Corner, bool)) -> bool {
    let (worst, others) = corners.split_last().expect("a simplex has corners");
    let Some((best, second)) = others.first().zip(others.last()) else { return false };
    let dimension = others.len() as f64;
    let centre: Vec<f64> =
        (0..worst.0.len()).map(|i| others.iter().map(|corner| corner.0[i]).sum::<f64>() / dimension).collect();
    let along = |factor: f64| centre.iter().zip(&worst.0).map(|(c, w)| c + factor * (c - w)).collect::<Vec<_>>();
    let (reflected, mut left) = value(along(1.0));
    let found = if reflected.1 < best.1 {
        let (expanded, more) = value(along(2.0));
        left = more;
        Some(if expanded.1 < reflected.1 { expanded } else { reflected })
    } else if reflected.1 < second.1 {
        Some(reflected)
    } else {
        let (contracted, more) = value(along(if reflected.1 < worst.1 { 0.5 } else { -0.5 }));
        left = more;
        Some(contracted).filter(|contracted| contracted.1 < reflected.1.min(worst.1))
    };
    match found {
        Some(corner) => {
            corners.pop();
            corners.push(corner);
        }
        None => {
            let best = best.0.clone();
            for corner in corners.iter_mut().skip(1) {
                let half = corner.0.iter().zip(&best).map(|(x, b)| (x + b) / 2.0).collect();
                (*corner, left) = value(half);
            }
        }
    }
    left
}

#[cfg(test)]
mod tests {
    use super::*;

    fn around(x: f64, y: f64) -> Vec<Vec<f64>> {
        vec![vec![x, y], vec![x + 0.1, y], vec![x, y + 0.1]]
    }

    /// Rosenbrock's valley, and a function with a kink; both have known minima.
    #[test]
    fn minima_are_found() {
        let valley = |x: &[f64]| (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2);
        let (x, least) = minimise(&mut { valley }, around(-1.2, 1.0), 1e-14, 2000);
        // 1e-14 of a value near 0: the corners differ by less than the square root of that
        assert!(least < 1e-12 && (x[0] - 1.0).abs() < 1e-5 && (x[1] - 1.0).abs() < 1e-5, "{x:?} {least}");
        let kink = |x: &[f64]| 1.0 + (x[0] - 0.3).abs() + 2.0 * (x[1] + 0.7).abs();
        let (x, least) = minimise(&mut { kink }, around(0.0, 0.0), 1e-12, 2000);
        assert!(least < 1.0 + 1e-8, "{x:?} {least}");
    }

    #[test]
    fn it_ends_after_the_evaluations_that_it_may_make() {
        let mut made = 0;
        let mut function = |x: &[f64]| {
            made += 1;
            x[0] * x[0] + x[1] * x[1] + 1.0
        };
        minimise(&mut function, around(3.0, 4.0), 0.0, 50);
        // a step may make a few more
        assert!((50..56).contains(&made), "{made}");
    }
}
