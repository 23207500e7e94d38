//! What a problem is given by.

/// Parameters, masses and the initial state.
pub struct Initial {
    /// In the order of the problem's description; those that are masses are left out.
    pub parameters: Vec<f64>,
    /// One for each coordinate.
    pub masses: Vec<f64>,
    pub q: Vec<f64>,
    pub p: Vec<f64>,
}
