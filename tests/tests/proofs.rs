//! Protects the proofs of orders: schemes of the literature, with the digits that were published, have the orders that
//! were published, for every T(p) and for quadratic T, and no higher ones.

use shadowstep_schemes::{First, Proved, Source, read_first, shipped};
use shadowstep_tests::refusals::{judge, printed_with_digits};

/// The proved orders for every T(p) and for quadratic T.
fn orders(proved: &Proved) -> (u32, u32) {
    (proved.proof.general.order, proved.proof.quadratic.order)
}

fn proved(text: &str) -> Proved {
    judge(text).unwrap_or_else(|faults| panic!("{faults}"))
}

/// Compositions, which have one order for every T, with the digits of their weights, and stages; the rows are in the
/// words of `crates/analysis/tests/published`.
#[test]
fn printed_schemes_have_the_orders_that_were_published() {
    for (name, digits, expected, is_composition) in [
        ("yoshida6-a", 20, (6, 6), true),
        ("suzuki-umeno8", 40, (8, 8), true),
        ("sofroniou-spaletta10-35", 32, (10, 10), true),
        ("mclachlan-atela4", 17, (3, 4), false),
        ("okunbor-skeel6-13", 17, (4, 6), false),
        ("bce-rkn8-17", 19, (4, 8), false),
    ] {
        let found = proved(&printed_with_digits(name, digits));
        assert_eq!(orders(&found), expected, "{name}");
        if !is_composition {
            continue;
        }
        assert!(found.proof.symmetric && found.notes.is_empty(), "{name}: {:?}", found.notes);
        // the conditions hold to nearly as many digits as were printed: products of weights up to 1.3 lose one or two
        for proof in [&found.proof.general, &found.proof.quadratic] {
            let held = proof.digits.expect("rounded weights meet no condition exactly");
            assert!((digits - 3..=digits + 1).contains(&held), "{name}: {held} of {digits}");
        }
        // the stages written out are Störmer–Verlet's two, merged
        assert_eq!(found.plan.evaluations + 1, found.scheme.stages.kick.len(), "{name}");
    }
}

/// Where T is quadratic, kick and drift are not interchangeable: exchanging them loses orders, which is proved again.
#[test]
fn exchanging_kick_and_drift_loses_orders() {
    for (name, first, claimed, left) in
        [("mclachlan-atela4", First::Drift, 4, 3), ("okunbor-skeel6-13", First::Kick, 6, 4)]
    {
        let text = printed_with_digits(name, 17);
        let read = |text: &str| {
            let source = Source { path: format!("{name}.toml"), text: text.to_owned() };
            read_first(&source, &|base, _| shipped(base), Some(first))
        };
        let faults = read(&text).expect_err(name).to_string();
        assert!(faults.contains(&format!("order {claimed} is claimed, order {left} holds")), "{name}: {faults}");
        let kept = read(&text.replace(&format!("order = {claimed}"), &format!("order = {left}")));
        assert_eq!(orders(&kept.expect("the lower order holds")), (left, left), "{name}");
    }
}

/// A claim below the truth is not a fault, but is noted.
#[test]
fn a_modest_claim_is_remarked() {
    let found = proved(&printed_with_digits("yoshida6-a", 20).replace("order = 6", "order = 4"));
    assert_eq!(orders(&found), (6, 6));
    let remarks: Vec<_> = found.notes.iter().map(ToString::to_string).collect();
    assert_eq!(
        remarks,
        ["mine.toml:2:9: order 4 is claimed, order 6 holds for every T(p)\n  \
          2 | order = 4\n    |         ^\n  hint: write `order = 6`"]
    );
}
