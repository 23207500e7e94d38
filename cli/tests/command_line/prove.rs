//! Protects certificates: a program that shares no code with this one verifies those of all shipped schemes, and
//! refuses wrong ones.

use std::fs;
use std::process::Command;

use serde_json::Value;
use shadowstep_schemes::{shipped_names, shipped_proved};

use crate::program::{objects, quietly, shadowstep};

const CHECKER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../evidence/certificates/check.py");

/// Whether a program accepts files, and what it writes.
fn accepted(program: &str, paths: &[String]) -> (bool, String) {
    let output = Command::new("python3").arg("-B").arg(program).args(paths).output().expect("python3 runs");
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
        let near: Vec<_> = proved.proof.near_integrable.iter().map(|order| order.order).collect();
        let quadratic = Some(proved.proof.quadratic.order).filter(|quadratic| *quadratic > order.order);
        let also: String = [
            quadratic.map(|quadratic| format!(", {quadratic} for quadratic T")),
            (!near.is_empty()).then(|| format!(", {near:?} for A + εB")),
        ]
        .into_iter()
        .flatten()
        .collect();
        lines.push(format!("{name}: order {}{also}, {}", order.order, certificate["kind"].as_str().unwrap()));
        paths.push(path);
    }
    let (is_accepted, out) = accepted(CHECKER, &paths);
    assert!(is_accepted, "{out}");
    assert!(
        out.lines().zip(&lines).all(|(line, expected)| line.starts_with(&format!("{expected}, "))),
        "{out}\n{lines:?}"
    );
    let beside = |class: &str| lines.iter().filter(|line| line.contains(class)).count();
    assert!(beside(" for quadratic T") >= 6 && beside(" for A + εB") >= 12, "{lines:#?}");
    let kinds = |kind: &str| lines.iter().filter(|line| line.ends_with(kind)).count();
    let is_enclosed =
        |line: &&str| ["2", "3"].iter().any(|n| line.contains(&format!("one solution enclosed within 1e-{n}")));
    let enclosed = out.lines().filter(is_enclosed).count();
    assert_eq!(enclosed, kinds("decimal"), "{out}");
    assert!(kinds("exact") >= 10 && kinds("algebraic") >= 10 && kinds("decimal") >= 40, "{lines:#?}");
}

/// The box is as wide as the digits need, not only of those with 250 digits.
#[test]
fn a_table_of_sixteen_digits_is_enclosed() {
    let folder = tempfile::tempdir().unwrap();
    let [table, certificate] =
        ["pefrl16.toml", "pefrl16.json"].map(|name| folder.path().join(name).display().to_string());
    let text = r#"
name = "pefrl16"
order = 4
kinetic = "any"
digits = 16
[constants]
xi = "0.1786178958448091"
lambda = "-0.2123418310626054"
chi = "-0.06626458266981849"
[stages]
kick = [0, "1/2 - lambda", "lambda", "lambda", "1/2 - lambda"]
drift = ["xi", "chi", "1 - 2*(chi + xi)", "chi", "xi"]
"#;
    fs::write(&table, text).unwrap();
    let shown = quietly(&format!("schemes show {table}"));
    assert!(
        shown.contains("certified enclosure") && shown.contains("within 1e-14 of the weights, 1 of 5 held"),
        "{shown}"
    );
    fs::write(&certificate, quietly(&format!("schemes prove {table}"))).unwrap();
    let (is_accepted, out) = accepted(CHECKER, &[certificate]);
    assert!(is_accepted && out.contains("one solution enclosed within 1e-14"), "{out}");
}

#[test]
fn wrong_certificates_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |name: &str, change: &dyn Fn(&mut Value)| {
        let mut certificate = objects(&quietly(&format!("schemes prove {name}"))).remove(0);
        change(&mut certificate);
        let path = folder.path().join("wrong.json").display().to_string();
        fs::write(&path, certificate.to_string()).unwrap();
        let (is_accepted, out) = accepted(CHECKER, &[path]);
        assert!(!is_accepted && out.contains("not proved: "), "{out}");
        out
    };
    for name in ["ruth3", "yoshida4", "pefrl"] {
        let higher =
            refused(name, &|certificate| certificate["order"] = (certificate["order"].as_u64().unwrap() + 1).into());
        assert!(higher.contains("the word "), "{higher}");
        refused(name, &|certificate| certificate["maps"][1]["weight"][0][0] = "1/3".into());
        refused(name, &|certificate| drop(certificate["maps"].as_array_mut().unwrap().pop()));
    }
    for (name, class, changed) in [
        ("calvo-sanzserna4", "the tree ", 5.into()),
        ("aba864", "the word ", vec![9, 6, 4].into()),
        ("saba3", "the word ", vec![6, 3].into()),
        ("saba4", "the word ", vec![9, 2].into()),
    ] {
        let key = if class == "the tree " { "order" } else { "orders" };
        let higher = refused(name, &|certificate: &mut Value| certificate["also"][0][key] = Value::clone(&changed));
        assert!(higher.contains(class), "{higher}");
    }
    refused("aba864", &|certificate| certificate["also"][0]["perturbation"] = "drift".into());
    refused("yoshida4", &|certificate| certificate["roots"][0]["of"][0][0] = "3".into());
    // a composition, a palindrome of maps, maps
    for name in ["yoshida6-a", "blanes-moan-s10", "mclachlan-atela4"] {
        for (radius, says) in [("1e-290", "the box need not have a solution"), ("1/10", "the box is wider than")] {
            let wrong = refused(name, &|certificate| certificate["enclosure"]["radius"] = radius.into());
            assert!(wrong.contains(says), "{wrong}");
        }
        refused(name, &|certificate| certificate["enclosure"]["inverse"][0][0] = "1".into());
        refused(name, &|certificate| certificate["enclosure"]["weights"][0] = "1/2".into());
        refused(name, &|certificate| drop(certificate["enclosure"]["solved"].as_array_mut().unwrap().pop()));
    }
    refused("mclachlan-atela4", &|certificate| certificate["enclosure"]["of"] = "palindrome".into());
    let loose = refused("pefrl", &|certificate| certificate["bound"] = "1/10".into());
    assert!(loose.contains("a bound that decides"), "{loose}");
    assert!(
        refused("ruth3", &|certificate| certificate["bound"] = "1/100000000".into())
            .contains("only decimals may be off")
    );
}

/// The decimals of a scheme stand for one that is enclosed: a bound alone is met by weights of any order.
#[test]
fn decimals_that_stand_for_no_scheme_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("falsified.json").display().to_string();
    let moved = |certificate: &mut Value, by: bool| {
        let (palindrome, last) = (certificate["maps"].clone(), certificate["maps"].as_array().unwrap().len() - 1);
        let weight = palindrome[0]["weight"][0][0].as_str().unwrap();
        // 18 digits of it, moved by less than 1e-17 or by 1e-5
        let digits = if by { format!("{}9{}", &weight[..7], &weight[8..20]) } else { weight[..20].to_owned() };
        let weight: Value = digits.into();
        for place in [0, last] {
            certificate["maps"][place]["weight"][0][0] = weight.clone();
        }
        if certificate["enclosure"].is_object() {
            certificate["enclosure"]["weights"][0] = weight;
        }
    };
    let unmoved = |certificate: &mut Value| drop(certificate["enclosure"]["radius"].take());
    type Change<'a> = (&'a str, &'a dyn Fn(&mut Value));
    let changes: [Change<'_>; 9] = [
        ("decimals without an enclosure", &|c| drop(c["enclosure"].take())),
        ("decimals without an enclosure", &|c| {
            drop(c["enclosure"].take());
            moved(c, true);
            c["bound"] = "1/25000".into();
        }),
        ("the box need not have a solution", &|c| {
            moved(c, false);
            c["bound"] = "1e-12".into();
        }),
        ("the weights are not those of the maps", &|c| {
            let kept = c["enclosure"].clone();
            moved(c, false);
            (c["enclosure"], c["bound"]) = (kept, "1e-12".into());
        }),
        ("the box is wider than the decimals need", &|c| c["enclosure"]["radius"] = "1e-100".into()),
        ("a bound is larger than the decimals need", &|c| c["bound"] = "1e-100".into()),
        ("the word ", &|c| c["order"] = 5.into()),
        ("a square matrix", &|c| {
            drop(c["enclosure"]["solved"].as_array_mut().unwrap().pop());
            drop(c["enclosure"]["inverse"].as_array_mut().unwrap().pop());
        }),
        ("not proved", &unmoved),
    ];
    let certificate = objects(&quietly("schemes prove blanes-moan-s6")).remove(0);
    for (says, change) in changes {
        let mut falsified = certificate.clone();
        change(&mut falsified);
        fs::write(&path, falsified.to_string()).unwrap();
        let (is_accepted, out) = accepted(CHECKER, std::slice::from_ref(&path));
        assert!(!is_accepted && out.contains(says), "{says}: {out}");
    }
    // without assertions it checks nothing, and accepts nothing
    fs::write(&path, certificate.to_string()).unwrap();
    let output = Command::new("python3").args(["-B", "-O", CHECKER, &path]).output().expect("python3 runs");
    assert!(!output.status.success());
}
