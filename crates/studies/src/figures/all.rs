//! All figures: a table and a file for each, and the list of them. A file for a problem has what several figures share.

mod contour;
mod double_precision;
mod estimators;
mod henon_heiles_bilinear;
mod henon_heiles_momentum;
mod henon_heiles_step;
mod kepler;
mod kepler_eccentricity;
mod kepler_energies;
mod kepler_orders;
mod kepler_schemes;
mod kepler_step;
mod modified_hamiltonian;
mod pendulum;
mod pendulum_bilinear;
mod pendulum_momentum;
mod pendulum_step;
mod permanent_change;
mod reliability;
mod scattering;

use crate::figures::figure::Figure;

/// Those of the paper in its order, then additional ones.
pub(crate) static FIGURES: [Figure; 19] = [
    Figure::new("pendulum-step", include_str!("all/pendulum_step.toml"), pendulum_step::draw),
    Figure::new("pendulum-momentum", include_str!("all/pendulum_momentum.toml"), pendulum_momentum::draw),
    Figure::new("kepler-step", include_str!("all/kepler_step.toml"), kepler_step::draw),
    Figure::new("kepler-eccentricity", include_str!("all/kepler_eccentricity.toml"), kepler_eccentricity::draw),
    Figure::new("kepler-schemes", include_str!("all/kepler_schemes.toml"), kepler_schemes::draw),
    Figure::new("kepler-energies", include_str!("all/kepler_energies.toml"), kepler_energies::draw),
    Figure::new("kepler-orders", include_str!("all/kepler_orders.toml"), kepler_orders::draw),
    Figure::new("henon-heiles-step", include_str!("all/henon_heiles_step.toml"), henon_heiles_step::draw),
    Figure::new("henon-heiles-momentum", include_str!("all/henon_heiles_momentum.toml"), henon_heiles_momentum::draw),
    Figure::new("scattering", include_str!("all/scattering.toml"), scattering::draw),
    Figure::new("contour", include_str!("all/contour.toml"), contour::draw),
    Figure::new("estimators-exact-flow", include_str!("all/estimators_exact_flow.toml"), estimators::on_the_exact_flow),
    Figure::new("estimators-schemes", include_str!("all/estimators_schemes.toml"), estimators::on_schemes),
    Figure::new("permanent-change", include_str!("all/permanent_change.toml"), permanent_change::draw),
    Figure::new("pendulum-bilinear", include_str!("all/pendulum_bilinear.toml"), pendulum_bilinear::draw),
    Figure::new("henon-heiles-bilinear", include_str!("all/henon_heiles_bilinear.toml"), henon_heiles_bilinear::draw),
    Figure::new("double-precision", include_str!("all/double_precision.toml"), double_precision::draw),
    Figure::new("reliability", include_str!("all/reliability.toml"), reliability::draw),
    Figure::new("modified-hamiltonian", include_str!("all/modified_hamiltonian.toml"), modified_hamiltonian::draw),
];
