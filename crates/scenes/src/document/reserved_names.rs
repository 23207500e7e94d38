//! Names with a meaning of their own: in formulas of columns and conditions, as columns, and in the languages of
//! emitted code.

use crate::document::expression::{ENERGY, TIME};
use crate::document::quantity::QUANTITIES;

/// The lists in rows of JSON lines, beside which no column of values has such a name.
pub(crate) const LISTS: [&str; 2] = ["q", "p"];

/// What names mean in formulas of columns and conditions of every system.
pub fn quantities() -> impl Iterator<Item = (&'static str, &'static str)> {
    let own = QUANTITIES.iter().filter_map(|own| own.name);
    [(TIME, "the time"), (ENERGY, "the energy H")].into_iter().chain(own)
}

/// A language of emitted code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// Python, with NumPy as `np`.
    Python,
    /// Rust.
    Rust,
    /// Julia.
    Julia,
}

impl Language {
    /// The names that code cannot give to what is of a problem or a scheme: keywords, what the language predefines, and
    /// what the emitted function uses.
    pub fn reserved(self) -> &'static [&'static str] {
        match self {
            Language::Python => PYTHON,
            Language::Rust => RUST,
            Language::Julia => JULIA,
        }
    }

    /// Names for code, each different from all others: those that are reserved or taken have `_` appended.
    ///
    /// ```
    /// use shadowstep_scenes::reserved_names::Language;
    ///
    /// let names = ["h", "lambda", "x", "h_"].map(String::from);
    /// assert_eq!(Language::Python.free(&names), ["h__", "lambda_", "x", "h_"]);
    /// assert_eq!(Language::Rust.free(&names), ["h__", "lambda", "x", "h_"]);
    /// ```
    pub fn free(self, names: &[String]) -> Vec<String> {
        let mut found: Vec<String> = Vec::new();
        for (place, name) in names.iter().enumerate() {
            let is_taken = |own: &String| {
                self.reserved().contains(&own.as_str())
                    || found.contains(own)
                    || names.iter().enumerate().any(|(other, name)| other != place && name == own)
            };
            let mut own = name.clone();
            while is_taken(&own) {
                own.push('_');
            }
            found.push(own);
        }
        found
    }
}

/// Words as texts.
macro_rules! words {
    ($($word:tt)*) => { &[$(stringify!($word)),*] };
}

/// Keywords, and the names of the function that
/// [`function`](crate::motion::modified_hamiltonian::record::FormulaRecord::function) writes.
const PYTHON: &[&str] = words![
    False None True and as assert async await break class continue def del elif else except finally for from global
    if import in is lambda nonlocal not or pass raise return try while with yield
    // of the function
    h modified_hamiltonian np total
];

/// Keywords, also those that are kept for later; values of the prelude that are patterns; the names of the function.
const RUST: &[&str] = words![
    Self abstract as async await become box break const continue crate do dyn else enum extern false final fn for
    gen if impl in let loop macro match mod move mut override priv pub ref return self static struct super trait
    true try type typeof unsafe unsized use virtual where while yield
    // patterns
    Err None Ok Some
    // of the function
    h modified_hamiltonian total
];

/// Modules and types of `Base` that a module of one word could hide; keywords begin with a small letter, and modules do
/// not.
const JULIA: &[&str] = words![
    Any Array Base Bool Broadcast Channel Char Cint Cmd Colon Complex Core Dict Docs Enum Expr Float32 Float64
    Function Int Integer Iterators Libc Main Math Matrix Meta Method Missing Module Nothing Number Pair Pkg Ptr
    Rational Real Ref Regex Returns Set Signed Some String Symbol Task Threads Timer Tuple Type Vector
];

#[cfg(test)]
mod tests {
    use shadowstep::tables::{Faults, Source};

    use crate::Scene;

    fn read(problem: &str, run: &str, output: &str) -> Result<Scene, String> {
        let text = format!(
            "[problem]\n{problem}\n[initial]\nq = [1]\np = [0]\n[run]\nscheme = \"yoshida4\"\nstep = \
                0.1\n{run}\ndigits = \"double\"\n[output]\n{output}"
        );
        let source = Source { path: "test.toml".to_owned(), text };
        Scene::read(source).map_err(|Faults(faults)| {
            assert_eq!(faults.len(), 1, "{faults:?}");
            format!("{}:{}: {}", faults[0].line, faults[0].column, faults[0].message)
        })
    }

    const E: &str = "potential = \"x^2/2 - E*x\"\ncoordinates = [\"x\"]\nparameters = { E = 3 }";

    #[test]
    fn names_with_two_meanings_are_refused_where_a_formula_has_them() {
        let parameter = |name: &str| {
            format!("potential = \"x^2/2 - {name}*x\"\ncoordinates = [\"x\"]\nparameters = {{ {name} = 3 }}")
        };
        for (name, what) in
            [("E", "the energy H"), ("t", "the time"), ("kinetic", "the kinetic energy"), ("virial", "the virial")]
        {
            let message = format!("`{name}` could be the parameter or {what} here");
            let fault = |run: &str, output: &str| read(&parameter(name), run, output).map(drop).unwrap_err();
            let column = fault("steps = 3", &format!("values = {{ a = \"{name}*x\" }}"));
            assert_eq!(column, format!("14:16: {message}"));
            let end = fault(&format!("until = 1\nend = \"x*{name} > 4\""), "energy = true");
            assert_eq!(end, format!("12:7: {message}"));
            let extremes = fault("steps = 3", &format!("energy = true\nextremes = {{ a = \"x - {name}\" }}"));
            assert_eq!(extremes, format!("15:18: {message}"));
            let section = fault("steps = 3", &format!("trajectory = {{ section = \"x - {name}\" }}"));
            assert!(section.contains(&message) || name == "t", "{section}");
            // where no such formula has it, it is the parameter
            read(&parameter(name), "steps = 3", "values = { a = \"3*x\" }").unwrap();
        }
        let coordinate = "potential = \"E^2/2\"\ncoordinates = [\"E\"]";
        let fault = read(coordinate, "steps = 3", "values = { a = \"2*E\" }").map(drop).unwrap_err();
        assert_eq!(fault, "13:16: `E` could be the coordinate or the energy H here");
        // t of H is the time of the rows
        read("potential = \"x^2/2 - t*x\"\ncoordinates = [\"x\"]", "steps = 3", "values = { a = \"t*x\" }").unwrap();
    }

    #[test]
    fn names_that_stand_for_parts_of_formulas_are_none_of_problems() {
        let fault =
            read("potential = \"__0^2\"\ncoordinates = [\"__0\"]", "steps = 3", "energy = true").map(drop).unwrap_err();
        assert_eq!(fault, "3:16: `__0` is not a valid name");
    }

    #[test]
    fn a_column_beside_lists_has_another_name_than_these() {
        for (format, name) in [("jsonl", "q"), ("jsonl", "p"), ("npy", "q"), ("npy", "p")] {
            let output = |more: &str| format!("file = \"out.{format}\"\nvalues = {{ {name} = \"x^2\" }}\n{more}");
            let fault = read(E, "steps = 3", &output("trajectory = true")).map(drop).unwrap_err();
            let message = format!("15:12: `{name}` is the name of the list of positions or momenta in these rows");
            assert_eq!(fault, message);
            read(E, "steps = 3", &output("")).unwrap();
        }
        read(E, "steps = 3", "values = { q = \"x^2\" }\ntrajectory = true").unwrap();
    }
}
