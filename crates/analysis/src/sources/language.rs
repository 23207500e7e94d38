//! The languages of sources that are read, by the endings of their files.

/// A language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// C, C++ and what looks like them.
    C,
    /// Fortran of any form.
    Fortran,
    /// Fortran with comments by the first column.
    FixedFortran,
    /// Python.
    Python,
    /// Julia.
    Julia,
    /// Rust.
    Rust,
    /// JSON.
    Json,
}

/// Endings with their languages.
const ENDINGS: [(Language, &[&str]); 7] = [
    (Language::C, &["c", "h", "cc", "cpp", "cxx", "hh", "hpp", "hxx", "inl", "cu", "cuh", "cl"]),
    (Language::Fortran, &["f90", "f95", "f03", "f08"]),
    (Language::FixedFortran, &["f", "for", "f77"]),
    (Language::Python, &["py", "pyx", "pyi"]),
    (Language::Julia, &["jl"]),
    (Language::Rust, &["rs"]),
    (Language::Json, &["json"]),
];

impl Language {
    /// All languages.
    pub const ALL: [Language; 7] = [
        Language::C,
        Language::Fortran,
        Language::FixedFortran,
        Language::Python,
        Language::Julia,
        Language::Rust,
        Language::Json,
    ];

    /// The language of a file by the ending of its name, capital letters or not.
    pub fn of(path: &str) -> Option<Language> {
        let ending = path.rsplit_once('.')?.1.to_ascii_lowercase();
        ENDINGS.iter().find(|(_, endings)| endings.contains(&&*ending)).map(|(language, _)| *language)
    }

    /// All endings that are known, for messages.
    pub fn endings() -> String {
        let endings = ENDINGS.iter().flat_map(|(_, endings)| *endings).map(|ending| format!(".{ending}"));
        endings.collect::<Vec<_>>().join(", ")
    }

    pub(super) fn is_fortran(self) -> bool {
        matches!(self, Language::Fortran | Language::FixedFortran)
    }

    /// Whether a statement ends with its line.
    pub(super) fn ends_with_line(self) -> bool {
        self.is_fortran() || matches!(self, Language::Python | Language::Julia)
    }

    /// The index of the first element of an array.
    pub(super) fn first_index(self) -> i64 {
        i64::from(self.is_fortran() || self == Language::Julia)
    }

    /// Whether 1/3 is 0, as a quotient of whole numbers.
    pub(super) fn truncates(self) -> bool {
        self.is_fortran() || matches!(self, Language::C | Language::Rust)
    }
}
