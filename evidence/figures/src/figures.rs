//! All figures: a file for each, and the list of them. A file for a problem has what several figures share.

mod estimators;
mod henon_heiles;
mod kepler;
mod pendulum;

mod contour;
mod double_precision;
mod estimators_exact_flow;
mod estimators_schemes;
mod henon_heiles_bilinear;
mod henon_heiles_momentum;
mod henon_heiles_step;
mod kepler_eccentricity;
mod kepler_energies;
mod kepler_orders;
mod kepler_schemes;
mod kepler_step;
mod modified_hamiltonian;
mod pendulum_bilinear;
mod pendulum_momentum;
mod pendulum_step;
mod permanent_change;
mod reliability;
mod scattering;

use crate::figure::Figure;

/// Those of the paper in its order, then additional ones.
pub(crate) const FIGURES: &[Figure] = &[
    pendulum_step::FIGURE,
    pendulum_momentum::FIGURE,
    kepler_step::FIGURE,
    kepler_eccentricity::FIGURE,
    kepler_schemes::FIGURE,
    kepler_energies::FIGURE,
    kepler_orders::FIGURE,
    henon_heiles_step::FIGURE,
    henon_heiles_momentum::FIGURE,
    scattering::FIGURE,
    contour::FIGURE,
    estimators_exact_flow::FIGURE,
    estimators_schemes::FIGURE,
    permanent_change::FIGURE,
    pendulum_bilinear::FIGURE,
    henon_heiles_bilinear::FIGURE,
    double_precision::FIGURE,
    reliability::FIGURE,
    modified_hamiltonian::FIGURE,
];
