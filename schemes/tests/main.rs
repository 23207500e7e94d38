//! The tests of formulas and exact numbers, as one program.

mod decimal;
mod elementary;
mod exact;
mod formulas;
mod syntax;
