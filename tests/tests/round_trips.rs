//! Protects what is written and read back: settings of estimators, weights of tables, values of scenes. Round trips of
//! exact numbers are in `schemes/tests/decimal.rs`.

use proptest::prelude::*;
use shadowstep::Rational;
use shadowstep::shadow::{EstimatorOptions, EstimatorSettings, SelectionRule, StoppingRule};
use shadowstep::tables::Source;
use shadowstep_scenes::Scene;
use shadowstep_schemes::exact;
use shadowstep_schemes::symbolic::decimal::to_text;

/// A number of few digits or many, also beyond the numbers that become decimals.
fn number() -> impl Strategy<Value = Rational> {
    let denominator =
        prop_oneof![1..100_i128, 1..i128::MAX, (0..40_u32).prop_map(|n| 2_i128.pow(n) * 5_i128.pow(n / 2))];
    (any::<i64>(), denominator).prop_map(|(n, d)| Rational::new(n.into(), d.into()))
}

fn options() -> impl Strategy<Value = EstimatorOptions> {
    let stop =
        prop::option::of(prop::sample::select(vec![StoppingRule::Full, StoppingRule::Early, StoppingRule::Printed]));
    let rule = prop::option::of(prop::sample::select(vec![SelectionRule::Least, SelectionRule::Robust]));
    let orders = (prop::option::of(1..300_u32), prop::option::of(2..300_u32));
    (orders, stop, rule, prop::option::of(number())).prop_map(|((order, max_order), stop, rule, accuracy)| {
        EstimatorOptions { order, max_order, stop, rule, accuracy }
    })
}

fn list(numbers: &[Rational]) -> String {
    numbers.iter().map(|number| format!("\"{}\"", to_text(number))).collect::<Vec<_>>().join(", ")
}

proptest! {
    #[test]
    fn settings_have_the_options_that_give_them(
        name in prop::sample::select(EstimatorSettings::NAMES),
        options in options(),
    ) {
        // options that conflict give no settings
        if let Ok(settings) = EstimatorSettings::from_options(name, options) {
            let settings = settings.expect("a known name");
            prop_assert_eq!(settings.name(), name);
            let again = EstimatorSettings::from_options(name, settings.options());
            prop_assert_eq!(again.unwrap().unwrap(), settings);
        }
    }

    #[test]
    fn weights_of_a_table_are_read_exactly(weights in prop::collection::vec((number(), number()), 1..8)) {
        let small = |weight: Rational| weight / Rational::from_integer(i64::MAX.into());
        let (kick, drift): (Vec<_>, Vec<_>) = weights.into_iter().map(|(a, b)| (small(a), small(b))).unzip();
        let text = format!(
            "name = \"mine\"\norder = 1\nkinetic = \"any\"\n[stages]\nkick = [{}]\ndrift = [{}]\n",
            list(&kick),
            list(&drift)
        );
        let (scheme, faults) = exact::scheme(&Source { path: "mine.toml".to_owned(), text }, &|_, _| None);
        prop_assert!(faults.is_empty(), "{:?}", faults);
        let scheme = scheme.unwrap();
        prop_assert_eq!((scheme.stages.kick, scheme.stages.drift), (kick, drift));
    }

    #[test]
    fn values_of_a_scene_are_read_exactly(
        (q, p) in (prop::collection::vec(number(), 3), prop::collection::vec(number(), 3)),
        k in number(),
        (h, steps, digits) in (1..1000_i64, 1..10_000_u64, 20..500_u32),
    ) {
        let text = format!(
            "[problem]\npotential = \"k*(x^2 + y^2 + z^2)\"\ncoordinates = [\"x\", \"y\", \"z\"]\nparameters = {{ k \
                = \"{}\" }}\n\
             [initial]\nq = [{}]\np = [{}]\n[run]\nscheme = \"ruth3\"\nstep = \"{h}/1001\"\nsteps = {steps}\n\
             digits = {digits}\n[output]\nenergy = true\n",
            to_text(&k), list(&q), list(&p)
        );
        let scene = Scene::read(Source { path: "scene.toml".to_owned(), text }).unwrap();
        let values = |exact: &[shadowstep_schemes::symbolic::Exact]| exact.iter().map(|exact| exact.value.clone()).collect::<Vec<_>>();
        prop_assert_eq!((values(&scene.system.q), values(&scene.system.p)), (q, p));
        prop_assert_eq!(&scene.system.parameters[0].1.value, &k);
        prop_assert_eq!((scene.h.exact(), scene.steps()), (&Rational::new(h.into(), 1001.into()), Some(steps)));
        prop_assert_eq!(scene.arithmetic.digits(), digits);
    }
}
