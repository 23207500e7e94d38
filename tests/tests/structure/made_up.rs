//! Tests of the check itself, on small crates written for it.

use std::fs;

use super::circles::{circles, show};
use super::imports::{between_modules, imports};
use super::source::Crate;

/// The circles of a crate with these files under src, as they are shown.
fn circles_of(files: &[(&str, &str)]) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let file = folder.path().join(name);
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, text).unwrap();
    }
    let imports = imports(&Crate::read(&folder.path().join("lib.rs")));
    circles(&imports).iter().map(|circle| show(circle, &imports, folder.path())).collect()
}

const NONE: Vec<String> = Vec::new();

#[test]
fn two_files_that_use_each_other_are_a_circle() {
    let found = circles_of(&[
        ("lib.rs", "mod a; mod b;"),
        ("a.rs", "use crate::b::{B, make}; pub struct A(B); fn f() { make(); }"),
        ("b.rs", "use crate::a::A; pub struct B; pub fn make() -> Option<A> { None }"),
    ]);
    let shown =
        "2 files import each other: a.rs, b.rs\n  a.rs imports from b.rs: B, make\n  b.rs imports from a.rs: A\n";
    assert_eq!(found, [shown]);
}

#[test]
fn a_circle_of_three_is_found_beside_files_outside_it() {
    let found = circles_of(&[
        ("lib.rs", "mod a; mod b; mod c; mod below; mod above;"),
        ("a.rs", "use crate::b::B; pub type A = B;"),
        ("b.rs", "use crate::c::C; pub enum B { One(C) }"),
        ("c.rs", "use crate::a::A; use crate::below::LEAST; pub trait C { fn a(&self) -> [A; LEAST]; }"),
        ("below.rs", "pub const LEAST: usize = 3;"),
        ("above.rs", "use crate::a::A; pub static ALL: Option<A> = None;"),
    ]);
    assert_eq!(found.len(), 1);
    assert!(found[0].starts_with("3 files import each other: a.rs, b.rs, c.rs\n"), "{}", found[0]);
}

#[test]
fn a_circle_through_a_re_export_is_one_of_the_files_that_define_the_names() {
    let found = circles_of(&[
        ("lib.rs", "mod a; mod b; pub use a::A; pub use b::B as Second;"),
        ("a.rs", "use crate::Second; pub struct A(Second);"),
        ("b.rs", "use crate::A; pub struct B(Option<Box<A>>);"),
    ]);
    assert_eq!(
        found,
        ["2 files import each other: a.rs, b.rs\n  a.rs imports from b.rs: B\n  b.rs imports from a.rs: A\n"]
    );
}

#[test]
fn a_child_that_imports_from_a_parent_that_uses_it_is_a_circle() {
    let shown = "2 files import each other: a/child.rs, a.rs\n  \
                 a/child.rs imports from a.rs: Parent\n  a.rs imports from a/child.rs: Child\n";
    let child = ("a/child.rs", "use super::Parent; pub struct Child(Option<Box<Parent>>);");
    let imported = ("a.rs", "mod child; use child::Child; pub struct Parent(Child);");
    assert_eq!(circles_of(&[("lib.rs", "mod a;"), imported, child]), [shown]);
    let re_exported_and_used = ("a.rs", "mod child; pub use child::Child; pub struct Parent(Child);");
    assert_eq!(circles_of(&[("lib.rs", "mod a;"), re_exported_and_used, child]), [shown]);
    let only_re_exported = ("a.rs", "mod child; pub use child::Child; pub struct Parent;");
    assert_eq!(circles_of(&[("lib.rs", "mod a;"), only_re_exported, child]), NONE);
}

#[test]
fn paths_in_code_and_in_calls_of_macros_count() {
    let b = ("b.rs", "use crate::a::A; pub struct B; pub fn make(_: A) {}");
    let with = |a: &str| circles_of(&[("lib.rs", "mod a; mod b;"), ("a.rs", &format!("pub struct A; {a}")), b]).len();
    assert_eq!(with(""), 0);
    assert_eq!(with("fn f() -> crate::b::B { loop {} }"), 1);
    assert_eq!(with("fn f() { super::b::make(A) }"), 1);
    assert_eq!(with("use crate::b as other; fn f() { other::make(A) }"), 1);
    assert_eq!(with("fn f() { use crate::b; b::make(A) }"), 1);
    assert_eq!(with("fn f() { println!(\"{:?}\", [crate::b::make(A)]); }"), 1);
    assert_eq!(with("fn f() { assert!(matches!(1, 0..crate::b::LAST)); }"), 1);
    assert_eq!(with("mod inner { fn f() { super::super::b::make(super::A) } }"), 1);
    assert_eq!(with("macro_rules! make { () => { $crate::b::make(A) } }"), 1);
    assert_eq!(with("fn f(b: &str) { b.len(); println!(\"{}\", b.make); }"), 0);
    assert_eq!(with("fn f() { quote!(crate::b::make()); }"), 0);
    assert_eq!(with("pub(in crate::b) fn f() {}"), 0);
}

#[test]
fn glob_imports_hide_no_circle_and_make_none() {
    let b = ("b.rs", "use crate::a::A; pub struct B(A); pub fn make() {}");
    let with = |a: &str| circles_of(&[("lib.rs", "mod a; mod b;"), ("a.rs", &format!("pub struct A; {a}")), b]).len();
    assert_eq!(with("use crate::b::*;"), 0);
    assert_eq!(with("use crate::b::*; fn f() { make() }"), 1);
    assert_eq!(with("pub use crate::b::*;"), 0);
}

#[test]
fn macros_and_items_behind_attributes_have_the_file_that_defines_them() {
    let found = circles_of(&[
        ("lib.rs", "#[macro_use] mod a; mod b;"),
        ("a.rs", "use crate::b::B; macro_rules! twice { ($a:expr) => { ($a, $a) } } pub fn f(_: B) {}"),
        ("b.rs", "pub struct B; pub fn g() { twice!(B); }"),
    ]);
    assert_eq!(found.len(), 1);
    let found = circles_of(&[
        ("lib.rs", "mod a; mod b; macro_rules! list { ($m:ident) => { pub fn f() { $m::f() } } } list!(a);"),
        ("a.rs", "use crate::Item; pub fn f() {}"),
        ("b.rs", "pub fn g(a: u8) { println!(\"{}\", a); }"),
    ]);
    assert_eq!(
        found,
        ["2 files import each other: a.rs, lib.rs\n  a.rs imports from lib.rs: Item\n  lib.rs imports from a.rs: a\n"]
    );
    let found = circles_of(&[
        ("lib.rs", "extern crate self as own; mod a; mod b; #[path = \"c/other.rs\"] mod c;"),
        ("a.rs", "use own::c::C; #[macro_export] macro_rules! twice { () => {} }"),
        ("b.rs", "made_by_macro!(Item);"),
        ("c/other.rs", "pub struct C; mod deeper; own::twice!();"),
        ("c/deeper.rs", "use crate::b::Item;"),
    ]);
    assert_eq!(found.len(), 1);
    assert!(found[0].starts_with("2 files import each other: a.rs, c/other.rs"), "{}", found[0]);
}

#[test]
fn a_face_parents_and_tests_make_no_circle() {
    let found = circles_of(&[
        ("lib.rs", "mod a; mod b; mod c; pub use a::A; pub use b::{self, B}; pub use num::Rational; pub fn f() {}"),
        ("a.rs", "use crate::{B, Rational}; pub struct A(B, Rational);"),
        ("b.rs", "use crate::Rational; pub struct B(Rational); #[cfg(test)] mod tests { use super::*; use crate::A; }"),
        (
            "c/mod.rs",
            "mod inner; pub(crate) use inner::f; #[cfg(test)] use crate::c::inner::G; #[cfg(test)] mod tests;",
        ),
        ("c/inner.rs", "pub fn f() {} pub struct G; #[cfg(all(test, unix))] fn g() { crate::f() }"),
        ("c/tests.rs", "use crate::c::inner::f;"),
    ]);
    assert_eq!(found, NONE);
}

#[test]
fn modules_are_compared_with_all_their_files() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let file = folder.path().join(name);
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, text).unwrap();
    };
    write("lib.rs", "mod a; mod b; pub use a::A;");
    write("a.rs", "mod inner; pub struct A;");
    write("a/inner.rs", "use crate::b::B; struct Inner(B);");
    write("b.rs", "use crate::a::A; pub struct B; fn f(_: A) {}");
    let imports = imports(&Crate::read(&folder.path().join("lib.rs")));
    assert!(circles(&imports).is_empty());
    let between = between_modules(&imports, folder.path());
    let shown: Vec<_> = circles(&between).iter().map(|circle| show(circle, &between, folder.path())).collect();
    assert_eq!(shown, ["2 files import each other: a, b\n  a imports from b: B\n  b imports from a: A\n"]);
}
