//! Faults of formulas: of potentials, of pairs, and of kinetic energies.

use shadowstep::{kinetic, potential};

// a function with one argument too many
potential! {
    pub struct Wave;
    U(x) = sin(x, 2)
}

// a division by zero
potential! {
    pub struct DivisionByZero;
    U(x) = x^2/(1 - 1)
}

// an exponent that varies
potential! {
    pub struct Odd;
    U(x, y) = x^y
}

// the type of numbers is added to the struct
potential! {
    struct Generic<N> { k }
    U(x) = k*x^2/2
}

// a potential of another name
potential! {
    pub struct OtherName;
    V(x) = x^2
}

// N is taken
potential! {
    struct N { k }
    U(x) = k*x^2/2
}

// no coordinates
potential! {
    pub struct Nothing;
    U() = 1
}

// a function without a derivative
potential! {
    pub struct Cone;
    U(x) = abs(x)
}

// a term is missing
potential! {
    pub struct TermMissing;
    U(x) = x^2 +
}

// a constant is not a parameter
potential! {
    struct Circle { pi }
    U(x) = pi*x^2
}

// a coordinate that is there twice
potential! {
    pub struct Repeated;
    U(x, x) = x^2
}

// an operator is missing
potential! {
    pub struct OperatorMissing;
    U(x) = 3 x^2
}

// a parameter with a type
potential! {
    pub struct Typed { stiffness: f64 }
    U(x) = stiffness*x^2/2
}

// a name that is neither a coordinate nor a parameter
potential! {
    pub struct Well { depth }
    U(x, y) = -depht * exp(-(x^2 + y^2))
}

// a parameter that is not in the formula
potential! {
    pub struct Unused { stiffness, width }
    U(x) = stiffness*x^2/2
}

// properties of bodies are for pairs
potential! {
    struct Trap;
    U(x, y; m_i) = m_i*(x^2 + y^2)/2
}

// the formula of a pair is in r2 or in d
potential! {
    struct InR;
    pair U(r) = -1/r
}

// the formula must state whose mass it means
potential! {
    struct Bare;
    pair U(r2; m_i, m_j) = -m*m_j/sqrt(r2)
}

// a mass belongs to all bodies, or to each
potential! {
    struct Both { m }
    pair U(r2; m_i, m_j) = -m_i*m_j/sqrt(r2)
}

// properties end with the body
potential! {
    struct NoBody { g }
    pair U(r2; m, m_j) = -g*m*m_j/sqrt(r2)
}

// a kinetic energy of another name
kinetic! {
    pub struct OtherKineticName;
    V(p) = p^2
}

// no momenta
kinetic! {
    pub struct NoMomenta;
    T() = 1
}

// a momentum that does not exist
kinetic! {
    pub struct UnknownMomentum;
    T(px, py) = px^2 + pz^2
}

fn main() {}
