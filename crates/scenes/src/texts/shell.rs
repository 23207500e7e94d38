//! Words of commands that users copy into a shell.

use std::ffi::OsStr;

/// A path or an argument as one word of a POSIX shell: in quotes, where it has characters that the shell reads
/// differently.
///
/// ```
/// use shadowstep_scenes::shell_word;
///
/// assert_eq!(shell_word("out/map-1"), "out/map-1");
/// assert_eq!(shell_word("my map"), "'my map'");
/// assert_eq!(shell_word("it's"), r"'it'\''s'");
/// ```
pub fn shell_word(word: impl AsRef<OsStr>) -> String {
    let text = word.as_ref().to_string_lossy();
    let is_plain = |c: char| c.is_alphanumeric() || "/._-+=:,@%".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        return text.into_owned();
    }
    format!("'{}'", text.replace('\'', r"'\''"))
}
