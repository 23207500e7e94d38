//! Names of schemes in any spelling.

/// A name without what makes no difference: its letters and digits, in small letters.
pub(crate) fn spelling(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}
