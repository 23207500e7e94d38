//! The imports between the files of a crate: `use` declarations and paths, each resolved to the file that defines the
//! name, through any re-export.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use super::source::Crate;

/// For a pair of files, the names that the first imports from the second.
pub(crate) type Imports = BTreeMap<(PathBuf, PathBuf), BTreeSet<String>>;

/// What a path leads to.
#[derive(Clone, Debug)]
enum Target {
    Module(usize),
    Item {
        file: PathBuf,
        name: String,
    },
    /// Another crate, or a name local to a function or generic item.
    Elsewhere,
}

/// All imports of a crate. `mod child;` is not an import, nor is a re-export of a name that the file does not use
/// itself.
pub(crate) fn imports(source: &Crate) -> Imports {
    let mut found = Imports::new();
    let mut take = |from: &Path, targets: Vec<Target>| {
        for target in targets {
            if let Target::Item { file, name } = target
                && file != from
            {
                found.entry((from.to_path_buf(), file)).or_default().insert(name);
            }
        }
    };
    for (index, module) in source.modules.iter().enumerate() {
        for import in module.uses.iter().filter(|import| !import.public && import.name.is_some()) {
            take(&module.file, source.resolve(index, &import.path, &mut Vec::new()));
        }
        for path in &module.paths {
            take(&module.file, source.resolve(index, path, &mut Vec::new()));
        }
        for (name, arguments) in &module.calls {
            take(&module.file, source.resolve_macro(index, name));
            if source.macros.contains_key(name) {
                arguments.iter().for_each(|path| take(&module.file, source.resolve_module(index, path)));
            }
        }
    }
    found
}

/// The imports between the modules of one folder, each with the files below it: `b` and `b/c.rs` are the module `b`.
///
/// The root file of a crate re-exports what is below it, and is left out.
pub(crate) fn between_modules(imports: &Imports, folder: &Path) -> Imports {
    let module = |file: &Path| {
        let below = file.strip_prefix(folder).ok()?;
        let name = PathBuf::from(below.components().next()?.as_os_str()).with_extension("");
        (!["lib", "main"].contains(&name.to_str()?)).then(|| folder.join(name))
    };
    let mut found = Imports::new();
    for ((from, to), names) in imports {
        if let (Some(from), Some(to)) = (module(from), module(to))
            && from != to
        {
            found.entry((from, to)).or_default().extend(names.iter().cloned());
        }
    }
    found
}

/// The modules and names that are being looked up, so that imports in a circle come to an end.
type Seen = Vec<(usize, String)>;

impl Crate {
    fn resolve(&self, module: usize, path: &[String], seen: &mut Seen) -> Vec<Target> {
        let Some((first, rest)) = path.split_first() else { return vec![Target::Module(module)] };
        let start = match first.as_str() {
            "crate" => vec![Target::Module(0)],
            "self" => vec![Target::Module(module)],
            "super" => vec![self.parent(module)],
            name if self.own_name.as_deref() == Some(name) => vec![Target::Module(0)],
            name => self.lookup(module, name, seen),
        };
        rest.iter().fold(start, |targets, name| self.step(targets, name, seen))
    }

    /// From what a path has led to, one name further. A name behind an item is its variant, method or the like.
    fn step(&self, targets: Vec<Target>, name: &str, seen: &mut Seen) -> Vec<Target> {
        let module =
            targets.iter().find_map(|target| if let Target::Module(module) = target { Some(*module) } else { None });
        match (module, name) {
            (None, _) => targets,
            (Some(module), "self") => vec![Target::Module(module)],
            (Some(module), "super") => vec![self.parent(module)],
            (Some(module), name) => match self.lookup(module, name, seen) {
                // an item that a macro defines there
                none if none.is_empty() => {
                    vec![Target::Item { file: self.modules[module].file.clone(), name: name.into() }]
                }
                found => found,
            },
        }
    }

    fn parent(&self, module: usize) -> Target {
        self.modules[module].parent.map_or(Target::Elsewhere, Target::Module)
    }

    /// What a name means within a module: a child module, an item, an import, or what a glob import brings.
    fn lookup(&self, module: usize, name: &str, seen: &mut Seen) -> Vec<Target> {
        if seen.iter().any(|(m, n)| *m == module && n == name) {
            return Vec::new();
        }
        seen.push((module, name.to_string()));
        let here = &self.modules[module];
        let mut found: Vec<_> = here.children.get(name).map(|child| Target::Module(*child)).into_iter().collect();
        found.extend(here.definitions.get(name).map(|file| Target::Item { file: file.clone(), name: name.into() }));
        for import in here.uses.iter().filter(|import| import.name.as_deref() == Some(name)) {
            match self.resolve(module, &import.path, seen) {
                none if none.is_empty() => found.push(Target::Elsewhere),
                targets => found.extend(targets),
            }
        }
        if found.is_empty() {
            for glob in here.uses.iter().filter(|import| import.name.is_none()) {
                for target in self.resolve(module, &glob.path, seen) {
                    if let Target::Module(other) = target {
                        found.extend(self.lookup(other, name, seen));
                    }
                }
            }
        }
        seen.pop();
        found
    }

    /// A module given to a macro of the crate, which may use any name in it.
    fn resolve_module(&self, module: usize, path: &[String]) -> Vec<Target> {
        let targets = self.resolve(module, path, &mut Vec::new()).into_iter();
        let modules = targets.filter_map(|target| if let Target::Module(index) = target { Some(index) } else { None });
        let name = path.join("::");
        modules.map(|index| Target::Item { file: self.modules[index].file.clone(), name: name.clone() }).collect()
    }

    /// `name!` is what is in scope by that name, or the crate's `macro_rules!` above it.
    fn resolve_macro(&self, module: usize, name: &str) -> Vec<Target> {
        let in_scope = self.lookup(module, name, &mut Vec::new());
        let above = || self.macros.get(name).map(|file| Target::Item { file: file.clone(), name: name.into() });
        if in_scope.is_empty() { above().into_iter().collect() } else { in_scope }
    }
}
