//! Where a table is: beside the source file, in the crate's root, among the shipped ones.

use std::cell::RefCell;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use shadowstep_schemes::document::{LARGEST_TABLE, read_text};
use shadowstep_schemes::library::beside_or_shipped;
use shadowstep_schemes::{Source, nearest, shipped, shipped_hint, shipped_names};

/// Finds tables and remembers which files were read.
pub(crate) struct Locator {
    folders: Vec<PathBuf>,
    files: RefCell<Vec<PathBuf>>,
}

impl Locator {
    /// Looks in the folder of the source file and in the crate's root, where they are known.
    pub(crate) fn new(source_file: Option<&Path>, crate_root: Option<&OsStr>) -> Locator {
        let beside = source_file.and_then(Path::parent).map(Path::to_path_buf);
        let root = crate_root.map(PathBuf::from);
        let mut folders: Vec<_> = beside.into_iter().chain(root).map(|f| f.canonicalize().unwrap_or(f)).collect();
        folders.dedup();
        Locator { folders, files: RefCell::default() }
    }

    /// The table that the attribute names.
    ///
    /// # Errors
    /// One sentence with all places looked at and the nearest names.
    pub(crate) fn find(&self, name: &str) -> Result<Source, String> {
        self.in_folders(name)?.or_else(|| shipped(name)).ok_or_else(|| self.not_found(name))
    }

    fn in_folders(&self, name: &str) -> Result<Option<Source>, String> {
        for folder in &self.folders {
            if let Some(source) = self.read(&folder.join(name), name)? {
                return Ok(Some(source));
            }
        }
        Ok(None)
    }

    /// The base table of a composition: beside the table that names it, then as [`Locator::find`]; for a shipped one a
    /// shipped one.
    pub(crate) fn base(&self, name: &str, from: &Source) -> Option<Source> {
        beside_or_shipped(name, from, |shown| {
            let file = shown.file_name()?;
            let table = self.files.borrow().iter().find(|known| known.ends_with(&from.path)).cloned();
            let beside = self.read(&table?.with_file_name(file), &shown.display().to_string());
            let elsewhere = || self.in_folders(file.to_str()?).ok().flatten();
            beside.ok().flatten().or_else(elsewhere)
        })
    }

    /// The files read, for the compiler to watch.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        self.files.borrow().clone()
    }

    fn read(&self, path: &Path, name: &str) -> Result<Option<Source>, String> {
        if !path.is_file() {
            return Ok(None);
        }
        let text = read_text(path, LARGEST_TABLE).map_err(|e| format!("{} cannot be read: {e}", path.display()))?;
        self.files.borrow_mut().push(path.to_path_buf());
        Ok(Some(Source { path: name.to_owned(), text }))
    }

    fn not_found(&self, name: &str) -> String {
        let names = shipped_names();
        let stem = name.strip_suffix(".toml").unwrap_or(name);
        let hint =
            match self.nearest_file(name).or_else(|| nearest(stem, names.iter().copied()).map(|n| format!("{n}.toml")))
            {
                Some(near) => format!("did you mean \"{near}\"?"),
                None => shipped_hint(stem),
            };
        let mut message = format!("there is no table \"{name}\"; looked\n");
        for folder in &self.folders {
            message += &format!("  in {}\n", folder.display());
        }
        message + &format!("  among the {} shipped tables\n  hint: {hint}", names.len())
    }

    fn nearest_file(&self, name: &str) -> Option<String> {
        let files: Vec<String> = self
            .folders
            .iter()
            .filter_map(|folder| fs::read_dir(folder).ok())
            .flatten()
            .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
            .filter(|file| file.ends_with(".toml") && file != "Cargo.toml")
            .collect();
        nearest(name, files.iter().map(String::as_str)).map(str::to_owned)
    }
}
