//! Protects the catalogue: what the publications claim of each shipped scheme is what is proved, no less and no more.

use shadowstep_schemes::proof::Order;
use shadowstep_schemes::{First, MapKind, Proved, read, read_first, shipped, shipped_names};

/// A row for each shipped scheme.
const CATALOGUE: &str = include_str!("catalogue.txt");

fn proved(name: &str) -> Proved {
    read(&shipped(name).expect(name), &|base, _| shipped(base)).unwrap_or_else(|faults| panic!("{faults}"))
}

/// A row as in the catalogue, from the proof.
fn line(name: &str, scheme: &Proved) -> String {
    let proof = &scheme.proof;
    let near = |orders: &[Order]| match orders {
        [] => "-".to_owned(),
        orders => orders.iter().map(|order| order.order.to_string()).collect::<Vec<_>>().join(","),
    };
    let mut cells = vec![
        name.to_owned(),
        scheme.order_for_every_kinetic().map_or_else(|| "-".to_owned(), |order| order.order.to_string()),
        proof.quadratic.order.to_string(),
        match scheme.plan.hessian_products {
            0 if scheme.scheme.inner.is_some() => {
                let plan = scheme.for_many_parts().unwrap().plan;
                format!("{}/{}", plan.evaluations, plan.count(MapKind::Drift))
            }
            0 => scheme.plan.evaluations.to_string(),
            products => format!("{}+{products}", scheme.plan.evaluations),
        },
        if proof.symmetric { "yes" } else { "no" }.to_owned(),
        if scheme.scheme.first() == First::Kick { "kick" } else { "drift" }.to_owned(),
        near(&proof.near_integrable),
    ];
    if let Some(effective) = &proof.effective {
        let [general, quadratic] = [&effective.general, &effective.quadratic].map(|order| order.order.to_string());
        cells.extend([general, quadratic, near(&effective.near_integrable)]);
    }
    cells.join(" ")
}

#[test]
fn what_is_claimed_is_what_is_proved() {
    let mut lines = Vec::new();
    for name in shipped_names() {
        let scheme = proved(name);
        assert!(scheme.notes.is_empty(), "a claim below the truth: {}", scheme.notes[0]);
        lines.push(line(name, &scheme));
    }
    let rows = CATALOGUE.lines().filter(|line| !line.starts_with('#'));
    let expected: Vec<_> = rows.map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
    for line in &lines {
        assert!(expected.contains(line), "proved, but not in catalogue.txt: {line}");
    }
    assert_eq!(lines.len(), expected.len(), "a table of catalogue.txt is missing");
}

/// A scheme for every T(p) keeps all its orders; of those for quadratic T, the table's order is left only where it
/// holds in general.
#[test]
fn exchanging_kick_and_drift() {
    let mut refused = Vec::new();
    for name in shipped_names() {
        let scheme = proved(name);
        let other = if scheme.scheme.first() == First::Kick { First::Drift } else { First::Kick };
        match read_first(&shipped(name).unwrap(), &|base, _| shipped(base), Some(other)) {
            Ok(exchanged) => {
                assert_eq!(exchanged.proof.general.order, scheme.proof.general.order, "{name}");
                let near = |scheme: &Proved| scheme.proof.near_integrable.iter().map(|o| o.order).collect::<Vec<_>>();
                assert_eq!(near(&exchanged), near(&scheme), "{name}: the dominant part is exchanged too");
            }
            Err(faults) if scheme.scheme.has_gradient_kicks() => {
                let message = faults.to_string();
                assert!(message.contains("cannot be exchanged in a scheme with gradient kicks"), "{name}: {message}");
            }
            Err(faults) if scheme.scheme.inner.is_some() => {
                let message = faults.to_string();
                assert!(message.contains("cannot be exchanged in a scheme with an inner scheme"), "{name}: {message}");
            }
            Err(faults) => refused.push((name, faults.to_string())),
        }
    }
    let orders = refused.iter().map(|(name, fault)| {
        let left = fault.split(" is claimed, ").nth(1).and_then(|rest| rest.split("order ").nth(1)?.split(' ').next());
        (*name, left.unwrap_or_else(|| panic!("{name}: {fault}")))
    });
    assert_eq!(
        orders.collect::<Vec<_>>(),
        [
            ("bce-rkn8-17", "4"),
            ("bce-rkn8-19", "4"),
            ("bcm-rkn4-2", "3"),
            ("bcm-rkn6-4", "4"),
            ("blanes-moan-srkn11b", "4"),
            ("blanes-moan-srkn14a", "4"),
            ("calvo-sanzserna4", "3"),
            ("mclachlan-atela4", "3"),
            ("mclachlan-atela5", "3"),
            ("okunbor-skeel6-13", "4"),
        ]
    );
}

#[test]
fn schemes_are_found_by_the_names_that_people_use() {
    for (word, name) in [
        ("PEFRL", "pefrl"),
        ("BM4", "blanes-moan-s6"),
        ("McAte2", "mclachlan-atela2"),
        ("SofSpa10", "sofroniou-spaletta10-35"),
        ("LF4_2", "saba2"),
        ("Forest-Ruth", "yoshida4"),
        ("yoshida6a", "yoshida6-a"),
        ("velocity Verlet", "stormer-verlet"),
        ("SABA(10,6,4)", "aba1064"),
        ("KahanLi8", "kahan-li8"),
    ] {
        assert_eq!(shipped(word).map(|source| source.path), shipped(name).map(|source| source.path), "{word}");
    }
}
