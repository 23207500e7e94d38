//! Protects certificates: a program that shares no code with this one verifies those of all shipped schemes, and refuses wrong ones.

use std::fs;
use std::process::Command;

use serde_json::Value;
use shadowstep_schemes::{shipped_names, shipped_proved};

use crate::program::{objects, quietly, shadowstep};

const CHECKER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/certificates/check.py");

/// Whether the checker accepts certificates in files, and what it writes.
fn checked(paths: &[String]) -> (bool, String) {
    let output = Command::new("python3").arg(CHECKER).args(paths).output().expect("python3 runs");
    (output.status.success(), String::from_utf8(output.stdout).unwrap() + &String::from_utf8(output.stderr).unwrap())
}

#[test]
fn every_certificate_is_verified() {
    let folder = tempfile::tempdir().unwrap();
    let (mut paths, mut lines) = (Vec::new(), Vec::new());
    for name in shipped_names() {
        let proved = shipped_proved(name).unwrap();
        let result = shadowstep(&format!("schemes prove {name}"));
        let (Some(order), None) = (proved.order_for_every_kinetic(), &proved.scheme.inner) else {
            assert!(
                result.code == 2 && result.err.contains("has gradient kicks or an inner scheme"),
                "{name}: {}",
                result.err
            );
            continue;
        };
        assert_eq!(result.code, 0, "{name}: {}", result.err);
        let path = folder.path().join(format!("{name}.json")).display().to_string();
        fs::write(&path, &result.out).unwrap();
        let certificate: Value = serde_json::from_str(&result.out).unwrap();
        lines.push(format!("{name}: order {}, {}", order.order, certificate["kind"].as_str().unwrap()));
        paths.push(path);
    }
    let (accepted, out) = checked(&paths);
    assert!(accepted, "{out}");
    assert!(
        out.lines().zip(&lines).all(|(line, expected)| line.starts_with(&format!("{expected}, "))),
        "{out}\n{lines:?}"
    );
    let kinds = |kind: &str| lines.iter().filter(|line| line.ends_with(kind)).count();
    let enclosed: Vec<_> = out.lines().filter(|line| line.ends_with("one solution enclosed")).collect();
    assert!(enclosed.len() >= 20, "{enclosed:#?}");
    assert!(kinds("exact") >= 10 && kinds("algebraic") >= 10 && kinds("decimal") >= 40, "{lines:#?}");
}

/// The kind of proof that `schemes show` names.
#[test]
fn show_names_the_kind_of_proof() {
    for (name, kind) in [
        ("ruth3", "exact: rational weights"),
        ("yoshida4", "algebraic: exact in the weights as polynomials in a root"),
        ("pefrl", "decimal: the conditions hold to the digits of the weights"),
        ("yoshida8-d", "certified enclosure: one solution of the order conditions within 1e-2"),
    ] {
        let shown = quietly(&format!("schemes show {name}"));
        let words = shown.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(&format!("proof: {kind}")), "{shown}");
    }
}

#[test]
fn wrong_certificates_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |name: &str, change: &dyn Fn(&mut Value)| {
        let mut certificate = objects(&quietly(&format!("schemes prove {name} --to json"))).remove(0);
        change(&mut certificate);
        let path = folder.path().join("wrong.json").display().to_string();
        fs::write(&path, certificate.to_string()).unwrap();
        let (accepted, out) = checked(&[path]);
        assert!(!accepted && out.contains("not proved: "), "{out}");
        out
    };
    for name in ["ruth3", "yoshida4", "pefrl"] {
        let higher =
            refused(name, &|certificate| certificate["order"] = (certificate["order"].as_u64().unwrap() + 1).into());
        assert!(higher.contains("the word "), "{higher}");
        refused(name, &|certificate| certificate["maps"][1]["weight"][0][0] = "1/3".into());
        refused(name, &|certificate| drop(certificate["maps"].as_array_mut().unwrap().pop()));
    }
    refused("yoshida4", &|certificate| certificate["roots"][0]["of"][0][0] = "3".into());
    for radius in ["1e-290", "1/10"] {
        let small = refused("yoshida6-a", &|certificate| certificate["enclosure"]["radius"] = radius.into());
        assert!(small.contains("the box need not have a solution"), "{small}");
    }
    refused("yoshida6-a", &|certificate| certificate["enclosure"]["inverse"][0][0] = "1".into());
    refused("yoshida6-a", &|certificate| certificate["enclosure"]["half"][0] = "1/2".into());
    let loose = refused("pefrl", &|certificate| certificate["bound"] = "1/10".into());
    assert!(loose.contains("a bound that decides"), "{loose}");
    assert!(
        refused("ruth3", &|certificate| certificate["bound"] = "1/100000000".into())
            .contains("only decimals may be off")
    );
}
