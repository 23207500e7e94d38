//! The modules of a crate, parsed from its files: what each defines, what it imports, which paths its code contains.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{TokenStream, TokenTree};
use syn::ext::IdentExt;
use syn::visit::{self, Visit};
use syn::{Attribute, Expr, ExprLit, ImplItem, Item, ItemMod, ItemUse, Lit, Meta, UseTree, Visibility};

/// All modules of a crate but those compiled for tests only; the first is the root.
#[derive(Default)]
pub(crate) struct Crate {
    pub(crate) modules: Vec<Module>,
    /// Macros of `macro_rules!`, which the modules that follow may call without an import.
    pub(crate) macros: BTreeMap<String, PathBuf>,
    /// The name in `extern crate self as name`.
    pub(crate) own_name: Option<String>,
}

/// A module, in a file of its own or within its parent's.
pub(crate) struct Module {
    pub(crate) file: PathBuf,
    pub(crate) parent: Option<usize>,
    pub(crate) children: BTreeMap<String, usize>,
    /// Items by name, with the file that defines them.
    pub(crate) definitions: BTreeMap<String, PathBuf>,
    pub(crate) uses: Vec<Use>,
    /// Every path in the code, single names among them.
    pub(crate) paths: BTreeSet<Vec<String>>,
    /// Macros called by a single name, with the paths among their arguments.
    pub(crate) calls: BTreeMap<String, BTreeSet<Vec<String>>>,
}

/// One name of a `use` declaration.
pub(crate) struct Use {
    pub(crate) path: Vec<String>,
    /// The name it has here; `None` for a glob.
    pub(crate) name: Option<String>,
    /// `pub use` and the like: passed on to other modules.
    pub(crate) public: bool,
}

impl Crate {
    /// Reads the crate whose root is the file `root`.
    ///
    /// # Panics
    /// If a file cannot be read or parsed.
    pub(crate) fn read(root: &Path) -> Self {
        let mut found = Crate::default();
        let folder = root.parent().expect("a file is in a folder");
        found.add_file(root, folder, None);
        found
    }

    /// Adds the module that is a whole file; the files of its children are in `folder`.
    fn add_file(&mut self, path: &Path, folder: &Path, parent: Option<usize>) -> Option<usize> {
        let text = fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let file = syn::parse_file(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        (!for_tests(&file.attrs)).then(|| self.add(path, &file.items, folder, parent))
    }

    fn add(&mut self, path: &Path, items: &[Item], folder: &Path, parent: Option<usize>) -> usize {
        let index = self.modules.len();
        let mut code = Code::default();
        items.iter().for_each(|item| code.visit_item(item));
        self.modules.push(Module {
            file: path.to_path_buf(),
            parent,
            children: BTreeMap::new(),
            definitions: BTreeMap::new(),
            uses: code.uses,
            paths: code.paths,
            calls: code.calls,
        });
        for item in items.iter().filter(|item| !for_tests(attributes(item))) {
            match item {
                Item::Mod(module) => self.add_child(index, module, folder),
                other => self.define(index, other),
            }
        }
        index
    }

    fn add_child(&mut self, parent: usize, module: &ItemMod, folder: &Path) {
        let (name, file) = (text(&module.ident), self.modules[parent].file.clone());
        let inner = folder.join(&name);
        let child = match (&module.content, path_attribute(module)) {
            (Some((_, items)), _) => Some(self.add(&file, items, &inner, Some(parent))),
            (None, Some(path)) => {
                let path = file.with_file_name(path);
                let folder = path.parent().expect("a file is in a folder");
                self.add_file(&path, folder, Some(parent))
            }
            (None, None) => {
                let beside = folder.join(format!("{name}.rs"));
                let path = if beside.exists() { beside } else { inner.join("mod.rs") };
                self.add_file(&path, &inner, Some(parent))
            }
        };
        if let Some(child) = child {
            self.modules[parent].children.insert(name, child);
        }
    }

    fn define(&mut self, module: usize, item: &Item) {
        let file = self.modules[module].file.clone();
        let name = match item {
            Item::Const(item) => &item.ident,
            Item::Enum(item) => &item.ident,
            Item::Fn(item) => &item.sig.ident,
            Item::Static(item) => &item.ident,
            Item::Struct(item) => &item.ident,
            Item::Trait(item) => &item.ident,
            Item::TraitAlias(item) => &item.ident,
            Item::Type(item) => &item.ident,
            Item::Union(item) => &item.ident,
            Item::ExternCrate(item) if item.ident == "self" => {
                self.own_name = item.rename.as_ref().map(|(_, name)| text(name));
                return;
            }
            Item::Macro(item) => {
                let Some(name) = &item.ident else { return };
                let exported = item.attrs.iter().any(|attribute| attribute.path().is_ident("macro_export"));
                if exported {
                    self.modules[0].definitions.insert(text(name), file.clone());
                }
                self.macros.insert(text(name), file.clone());
                name
            }
            _ => return,
        };
        self.modules[module].definitions.insert(text(name), file);
    }
}

/// The imports and paths of one module, without its child modules and without code compiled for tests only.
#[derive(Default)]
struct Code {
    uses: Vec<Use>,
    paths: BTreeSet<Vec<String>>,
    calls: BTreeMap<String, BTreeSet<Vec<String>>>,
}

impl Visit<'_> for Code {
    fn visit_item(&mut self, item: &Item) {
        if !for_tests(attributes(item)) {
            visit::visit_item(self, item);
        }
    }

    fn visit_impl_item(&mut self, item: &ImplItem) {
        let for_tests = match item {
            ImplItem::Const(item) => for_tests(&item.attrs),
            ImplItem::Fn(item) => for_tests(&item.attrs),
            ImplItem::Type(item) => for_tests(&item.attrs),
            _ => false,
        };
        if !for_tests {
            visit::visit_impl_item(self, item);
        }
    }

    fn visit_item_mod(&mut self, _: &ItemMod) {} // a module of its own

    fn visit_visibility(&mut self, _: &Visibility) {} // the path in `pub(in path)` imports nothing

    fn visit_item_use(&mut self, item: &ItemUse) {
        let public = !matches!(item.vis, Visibility::Inherited);
        flatten(&item.tree, &mut Vec::new(), &mut |path, name| self.uses.push(Use { path, name, public }));
    }

    fn visit_path(&mut self, path: &syn::Path) {
        self.paths.insert(path.segments.iter().map(|segment| text(&segment.ident)).collect());
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, call: &syn::Macro) {
        let path: Vec<_> = call.path.segments.iter().map(|segment| text(&segment.ident)).collect();
        let mut arguments = BTreeSet::new();
        if path.last().is_some_and(|name| !GENERATING.contains(&name.as_str())) {
            add_paths(call.tokens.clone(), &mut arguments);
        }
        self.paths.extend(arguments.iter().cloned());
        match &path[..] {
            [name] => self.calls.entry(name.clone()).or_default().append(&mut arguments),
            _ => drop(self.paths.insert(path)),
        }
    }

    fn visit_attribute(&mut self, attribute: &Attribute) {
        if let Meta::List(list) = &attribute.meta {
            add_paths(list.tokens.clone(), &mut self.paths);
        }
    }
}

/// Macros whose arguments become the code of another crate.
const GENERATING: [&str; 4] = ["quote", "quote_spanned", "parse_quote", "parse_quote_spanned"];

/// Adds the paths among the arguments of a macro, which only the macro can parse. A name behind a dot is a field.
fn add_paths(tokens: TokenStream, paths: &mut BTreeSet<Vec<String>>) {
    let mut path = Vec::new();
    let mut signs = String::new(); // between the last name and this token
    for token in tokens {
        match token {
            TokenTree::Punct(sign) => {
                signs.push(sign.as_char());
                continue;
            }
            TokenTree::Ident(name) if signs == "::" && !path.is_empty() => path.push(text(&name)),
            TokenTree::Ident(name) => {
                paths.insert(std::mem::take(&mut path));
                if signs != "." {
                    path.push(text(&name));
                }
            }
            TokenTree::Group(group) => {
                paths.insert(std::mem::take(&mut path));
                add_paths(group.stream(), paths);
            }
            TokenTree::Literal(_) => drop(paths.insert(std::mem::take(&mut path))),
        }
        signs.clear();
    }
    paths.insert(path);
    paths.remove(&Vec::new());
}

/// `use a::{b, c::*};` as a::b and c::*, each with its name.
fn flatten(tree: &UseTree, path: &mut Vec<String>, found: &mut impl FnMut(Vec<String>, Option<String>)) {
    let mut leaf = |last: &syn::Ident, name: &syn::Ident| {
        let mut whole = path.clone();
        if last != "self" {
            whole.push(text(last));
        }
        let name = if name == "self" { whole.last().cloned() } else { Some(text(name)) };
        found(whole, name);
    };
    match tree {
        UseTree::Name(name) => leaf(&name.ident, &name.ident),
        UseTree::Rename(renamed) => leaf(&renamed.ident, &renamed.rename),
        UseTree::Glob(_) => found(path.clone(), None),
        UseTree::Group(group) => group.items.iter().for_each(|tree| flatten(tree, path, found)),
        UseTree::Path(step) => {
            path.push(text(&step.ident));
            flatten(&step.tree, path, found);
            path.pop();
        }
    }
}

/// Whether one of the attributes is a `cfg` that only tests meet.
fn for_tests(attributes: &[Attribute]) -> bool {
    fn needs_test(meta: &Meta) -> bool {
        let all_of = |list: &syn::MetaList| {
            list.parse_args_with(syn::punctuated::Punctuated::<Meta, syn::Token![,]>::parse_terminated)
                .is_ok_and(|conditions| conditions.iter().any(needs_test))
        };
        match meta {
            Meta::Path(path) => path.is_ident("test"),
            Meta::List(list) => list.path.is_ident("all") && all_of(list),
            Meta::NameValue(_) => false,
        }
    }
    let conditions = attributes.iter().filter(|attribute| attribute.path().is_ident("cfg"));
    conditions.filter_map(|attribute| attribute.parse_args().ok()).any(|meta: Meta| needs_test(&meta))
}

/// The file in `#[path = "file"]`.
fn path_attribute(module: &ItemMod) -> Option<String> {
    module.attrs.iter().find_map(|attribute| match &attribute.meta {
        Meta::NameValue(pair) if pair.path.is_ident("path") => match &pair.value {
            Expr::Lit(ExprLit { lit: Lit::Str(file), .. }) => Some(file.value()),
            _ => None,
        },
        _ => None,
    })
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Mod(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::TraitAlias(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Union(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}

fn text(name: &syn::Ident) -> String {
    name.unraw().to_string()
}
