//! Initial states and masses as exact expressions.

/// The initial state of a problem, in the order of its coordinates. All texts are exact expressions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Initial {
    /// Names and defaults of q_1, …, q_d; they may use the parameters.
    pub positions: Vec<(String, String)>,
    /// Names and defaults of p_1, …, p_d; they may use the positions, too.
    pub momenta: Vec<(String, String)>,
    /// The mass of each coordinate; `None` if all are 1.
    pub masses: Option<Vec<String>>,
}

/// A body of a problem: its name, its mass, and its position and velocity in D dimensions, as exact numbers.
pub(super) struct Body<const D: usize> {
    pub(super) name: &'static str,
    pub(super) mass: &'static str,
    pub(super) position: [&'static str; D],
    pub(super) velocity: [&'static str; D],
}

impl Initial {
    /// Coordinates of mass 1.
    pub(super) fn new<const D: usize>(positions: [(&str, &str); D], momenta: [(&str, &str); D]) -> Self {
        let owned = |list: [(&str, &str); D]| list.map(|(name, value)| (name.to_owned(), value.to_owned())).to_vec();
        Initial { positions: owned(positions), momenta: owned(momenta), masses: None }
    }

    /// Bodies with coordinates such as `x_sun` and momenta such as `px_sun`, which are mass times velocity.
    pub(super) fn of_bodies<const D: usize>(bodies: &[Body<D>]) -> Self {
        let mut initial = Initial { positions: Vec::new(), momenta: Vec::new(), masses: Some(Vec::new()) };
        for Body { name, mass, position, velocity } in bodies {
            for ((axis, position), velocity) in ["x", "y", "z"].iter().zip(position).zip(velocity) {
                initial.positions.push((format!("{axis}_{name}"), (*position).to_owned()));
                let momentum = match velocity.strip_prefix('-') {
                    _ if *velocity == "0" => "0".to_owned(),
                    Some(speed) => format!("-{mass} * {speed}"),
                    None => format!("{mass} * {velocity}"),
                };
                initial.momenta.push((format!("p{axis}_{name}"), momentum));
                initial.masses.get_or_insert_default().push((*mass).to_owned());
            }
        }
        initial
    }

    /// A chain of bodies of mass 1 with coordinates `q1`, `q2`, … and momenta `p1`, `p2`, …; position and momentum are
    /// functions of the body's number, from 1.
    pub(super) fn of_chain(
        bodies: usize,
        position: impl Fn(usize) -> String,
        momentum: impl Fn(usize) -> String,
    ) -> Self {
        Initial {
            positions: (1..=bodies).map(|i| (format!("q{i}"), position(i))).collect(),
            momenta: (1..=bodies).map(|i| (format!("p{i}"), momentum(i))).collect(),
            masses: None,
        }
    }
}
