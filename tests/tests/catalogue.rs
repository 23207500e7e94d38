//! Protects the catalogue: what the publications claim of each shipped scheme is what is proved, no less and no more.

use shadowstep_schemes::proof::Order;
use shadowstep_schemes::{First, MapKind, Proved, read, read_first, shipped, shipped_names};

/// From the publications, except for the order for every T(p) of schemes for quadratic T, which they do not state.
/// Columns: name; order for every T(p) and for quadratic T; evaluations per step, and Hessian–vector products of
/// gradient kicks, or of slow and fast forces; palindrome; first map; near-integrable orders; of a processed scheme,
/// whose other columns belong to its kernel, the effective orders for every T(p), for quadratic T and the
/// near-integrable ones.
const CATALOGUE: &str = "
aba104                    4  4   7  yes  drift  10,4
aba1064                   4  4   8  yes  drift  10,6,4
aba864                    4  4   7  yes  drift  8,6,4
abah1064                  4  4   9  yes  drift  10,6,4
abah844                   4  4   6  yes  drift  8,4
abah864                   4  4   8  yes  drift  8,6,4
auzinger5-7               5  5   7  no   kick   -
auzinger5-8               5  5   8  no   kick   -
bce-rkn8-17               4  8  17  yes  drift  -
bce-rkn8-19               4  8  19  yes  drift  -
bcm-rkn4-2                1  1   2  no   drift  -       3 4 6,4,3
bcm-rkn6-4                2  2   4  yes  kick   -       4 6 7,6,4
bcm10-23                  4  4  23  yes  kick   -       10 10 -
bcm6-11                   4  4  11  yes  kick   -       6 6 -
bcm6-13                   4  4  13  yes  kick   -       6 6 -
bcm8-13                   4  4  13  yes  kick   -       8 8 -
bcr764                    2  2   3  yes  drift  -       4 4 7,6,4
bcss2                     2  2   2  yes  kick   -
bcss3                     2  2   3  yes  kick   -
bcss4                     2  2   4  yes  kick   -
blanes-moan-s10           6  6  10  yes  kick   -
blanes-moan-s6            4  4   6  yes  kick   -
blanes-moan-srkn11b       4  6  11  yes  kick   -
blanes-moan-srkn14a       4  6  14  yes  drift  -
blanes-moan-srkn6b        4  4   6  yes  kick   -
blanes6-7                 4  4   7  yes  kick   -       6 6 -
calvo-sanzserna4          3  4   4  no   kick   -
casas-escorihuela4-4      4  4   4  yes  kick   -
casas-escorihuela4-4-a    4  4   4  yes  kick   -
casas-escorihuela4-5      4  4   5  yes  kick   -
casas-escorihuela4-5-b    4  4   5  yes  kick   -
casas-escorihuela4-6      4  4   6  yes  kick   -
casas-escorihuela4-6-a    4  4   6  yes  kick   -
chin-4a                   -  4   2+1  yes  kick   -
chin-4b                   -  4   2+2  yes  drift  -
chin-4c                   -  4   3+1  yes  drift  -
efrl                      4  4   4  yes  drift  -
escorihuela4-6            2  2   6  yes  kick   -       4 4 -
escorihuela6-8            2  2   8  yes  kick   -       6 6 -
hairer10-33              10 10  33  yes  kick   -
kahan-li6                 6  6   9  yes  kick   -
kahan-li6-gni             6  6   9  yes  kick   -
kahan-li8                 8  8  17  yes  kick   -
kahan-li8-b               8  8  17  yes  kick   -
mclachlan-aba84           4  4   5  yes  drift  8,4
mclachlan-atela2          2  2   2  no   kick   -
mclachlan-atela3          3  3   3  no   kick   -
mclachlan-atela4          3  4   4  no   kick   -
mclachlan-atela5          3  5   6  no   kick   -
mclachlan-s2              2  2   2  yes  kick   -
mclachlan-s4              4  4   4  yes  kick   -
mclachlan-s5              4  4   5  yes  kick   -
mclachlan-sb3a4           4  4   4  yes  drift  -
mclachlan-sb3a5           4  4   5  yes  drift  -
mclachlan-ss17            8  8  17  yes  kick   -
mclachlan-ss5             4  4   5  yes  kick   -
mclachlan-ss9             6  6   9  yes  kick   -
morales8-17               8  8  17  yes  kick   -
nested-s6                 4  4   6/36  yes  kick   -
okunbor-skeel6-13         4  6   7  yes  drift  -
omelyan-4mn2f2gv          -  4   2+2  yes  kick   -
omelyan-4mn3f1gp          -  4   3+1  yes  drift  -
omelyan-4mn3f3gp          -  4   3+3  yes  drift  -
omelyan-4mn3f3gv          -  4   3+3  yes  kick   -
omelyan-4mn5f2gv          -  4   5+2  yes  kick   -
omelyan-4mn5fp            4  4   5  yes  drift  -
omelyan-4mn5fv            4  4   5  yes  kick   -
omelyan-6mn5f3gp          -  6   5+3  yes  drift  -
omelyan-6mn5f4gv          -  6   5+4  yes  kick   -
omelyan-6mn5f5gp          -  6   5+5  yes  drift  -
omelyan-6mn5f5gv          -  6   5+5  yes  kick   -
omelyan-8s11f11gp         -  8 11+11  yes  drift  -
pefrl                     4  4   4  yes  drift  -
predescu3                 2  2   3  yes  kick   -
r-respa-4                 2  2   1/4  yes  kick   -
r-respa-8                 2  2   1/8  yes  kick   -
ruth3                     3  3   3  no   kick   -
saba2                     2  2   2  yes  drift  4,2
saba3                     2  2   3  yes  drift  6,2
saba4                     2  2   4  yes  drift  8,2
saba5                     2  2   5  yes  drift  10,2
sabac2                    -  4   3+1  yes  kick   4,4
sabac3                    -  4   4+1  yes  kick   6,4
sbab2                     2  2   2  yes  kick   4,2
sbab3                     2  2   3  yes  kick   6,2
sbab4                     2  2   4  yes  kick   8,2
shadowstep4-6             4  4   6  yes  kick   -
shadowstep6-7p            4  4   7  yes  kick   -       6 6 -
shadowstep6-9             6  6   9  yes  kick   -
sofroniou-spaletta10-33  10 10  33  yes  kick   -
sofroniou-spaletta10-35  10 10  35  yes  kick   -
sofroniou-spaletta6-11    6  6  11  yes  kick   -
sofroniou-spaletta6-13    6  6  13  yes  kick   -
sofroniou-spaletta8-21    8  8  21  yes  kick   -
stormer-verlet            2  2   1  yes  kick   -
suzuki-umeno8             8  8  15  yes  kick   -
suzuki4                   4  4   5  yes  kick   -
suzuki6                   6  6  25  yes  kick   -
symplectic-euler          1  1   1  no   kick   -
takahashi-imada           -  2   1+1  yes  drift  -
triplejump6               6  6   9  yes  kick   -
triplejump8               8  8  27  yes  kick   -
vefrl                     4  4   4  yes  kick   -
wisdom-corrector-3        2  2   1  yes  drift  -       2 2 4,2
wisdom-corrector-5        2  2   1  yes  drift  -       2 2 6,2
wisdom-corrector-7        2  2   1  yes  drift  -       2 2 8,2
wisdom-corrector-11       2  2   1  yes  drift  -       2 2 12,2
wisdom-corrector-17       2  2   1  yes  drift  -       2 2 18,2
wisdom-kernel-3           -  2   1+1  yes  drift  -     3 4 4,4,3
wisdom-kernel-5           -  2   1+1  yes  drift  -     3 4 6,4,3
wisdom-kernel-7           -  2   1+1  yes  drift  -     3 4 8,4,3
wisdom-kernel-11          -  2   1+1  yes  drift  -     3 4 12,4,3
wisdom-kernel-17          -  2   1+1  yes  drift  -     3 4 18,4,3
yoshida4                  4  4   3  yes  kick   -
yoshida6-a                6  6   7  yes  kick   -
yoshida6-b                6  6   7  yes  kick   -
yoshida6-c                6  6   7  yes  kick   -
yoshida8-a                8  8  15  yes  kick   -
yoshida8-b                8  8  15  yes  kick   -
yoshida8-c                8  8  15  yes  kick   -
yoshida8-d                8  8  15  yes  kick   -
yoshida8-e                8  8  15  yes  kick   -
";

fn proved(name: &str) -> Proved {
    read(&shipped(name).expect(name), &|base, _| shipped(base)).unwrap_or_else(|faults| panic!("{faults}"))
}

/// A line as in [`CATALOGUE`], from the proof.
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
    let expected: Vec<_> =
        CATALOGUE.trim().lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" ")).collect();
    for line in &lines {
        assert!(expected.contains(line), "proved, but not in CATALOGUE: {line}");
    }
    assert_eq!(lines.len(), expected.len(), "a table of CATALOGUE is missing");
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
