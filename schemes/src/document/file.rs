//! The text of a file, up to a stated size: a path may lead to an endless device.

use std::fs::{File, FileType};
use std::io::{Error, ErrorKind, Read, Result};
use std::path::Path;

/// The most bytes of a table.
pub const LARGEST_TABLE: u64 = 1 << 20;

/// Refuses named pipes and sockets: to open one waits for its other end. A program's own descriptors, such as
/// `/dev/stdin`, are opened already.
///
/// # Errors
/// `InvalidInput` for such a path.
pub fn refuse_pipe(path: &Path) -> Result<()> {
    let is_own = ["/dev/stdin", "/dev/fd", "/proc/self/fd"].iter().any(|own| path.starts_with(own));
    match path.metadata() {
        Ok(found) if !is_own && is_pipe(found.file_type()) => {
            Err(Error::new(ErrorKind::InvalidInput, "it is a pipe, not a file"))
        }
        _ => Ok(()),
    }
}

#[cfg(unix)]
fn is_pipe(file: FileType) -> bool {
    use std::os::unix::fs::FileTypeExt;
    file.is_fifo() || file.is_socket()
}

#[cfg(not(unix))]
fn is_pipe(_: FileType) -> bool {
    false
}

/// Reads a text of at most `most` bytes in UTF-8.
///
/// # Errors
/// Errors of the file system; a path that [`refuse_pipe`] refuses; `FileTooLarge` for a longer file, of which no more
/// is read; `InvalidData` for a file that is not in UTF-8.
///
/// ```
/// use shadowstep_schemes::document::read_text;
///
/// let error = read_text(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml"), 10).unwrap_err();
/// assert_eq!(error.to_string(), "it is longer than 10 bytes");
/// ```
pub fn read_text(path: impl AsRef<Path>, most: u64) -> Result<String> {
    let (path, mut bytes) = (path.as_ref(), Vec::new());
    refuse_pipe(path)?;
    File::open(path)?.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(Error::new(ErrorKind::FileTooLarge, format!("it is longer than {}", size(most))));
    }
    String::from_utf8(bytes).map_err(|error| Error::new(ErrorKind::InvalidData, error))
}

fn size(bytes: u64) -> String {
    match bytes {
        bytes if bytes.is_multiple_of(1 << 20) => format!("{} MiB", bytes >> 20),
        bytes => format!("{bytes} bytes"),
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn an_endless_device_is_read_to_the_limit_only() {
        let error = read_text("/dev/zero", LARGEST_TABLE).unwrap_err();
        assert_eq!((error.kind(), error.to_string().as_str()), (ErrorKind::FileTooLarge, "it is longer than 1 MiB"));
    }
}
