//! Random formulas, the same in every run.

use shadowstep_schemes::symbolic::Rational;

/// A linear congruential generator (Knuth, MMIX), of which the upper bits are used.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// One of 0, …, n − 1.
    pub(crate) fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) % n
    }

    fn choose(&mut self, list: &[&str]) -> String {
        list[self.below(list.len() as u64) as usize].to_string()
    }

    /// A number of either sign, never 0, seldom an integer.
    pub(crate) fn number(&mut self) -> Rational {
        let numerator = self.below(1900) as i64 + 100;
        let sign = if self.below(4) == 0 { -1 } else { 1 };
        Rational::new((sign * numerator).into(), 997.into())
    }

    fn leaf(&mut self) -> String {
        match self.below(4) {
            0 => self
                .choose(&["1", "2", "3", "1/2", "2/3", "4", "0.25", "1.5"])
                .replace("1/2", "(1/2)")
                .replace("2/3", "(2/3)"),
            _ => self.choose(&["x", "y", "a", "b", "x", "y"]),
        }
    }

    /// A formula in x, y, a, b of + − * /, powers, roots and functions.
    pub(crate) fn formula(&mut self, depth: u32) -> String {
        if depth == 0 || self.below(8) == 0 {
            return self.leaf();
        }
        let kind = self.below(14);
        let a = self.formula(depth - 1);
        match kind {
            0..=5 => {
                let operation = self.choose(&["+", "+", "-", "-", "*", "*", "/"]);
                let b = self.formula(depth - 1);
                format!("({a} {operation} {b})")
            }
            6 => format!("(-{a})"),
            7 | 8 => {
                let exponent = self.choose(&["2", "3", "(-1)", "(-2)", "4"]);
                format!("({a})^{exponent}")
            }
            9 | 10 => {
                let exponent = self.choose(&["(1/2)", "(-1/2)", "1.5", "(-3/2)", "(1/3)", "(-2/3)", "(5/3)", "(-1/4)"]);
                format!("({a})^{exponent}")
            }
            _ => {
                let names =
                    ["sqrt", "cbrt", "exp", "log", "sin", "cos", "tan", "sinh", "cosh", "tanh", "atan", "asin", "acos"];
                let name = self.choose(&names);
                format!("{name}({a})")
            }
        }
    }
}
