//! The schemes that take part, compiled from their tables.

use shadowstep::systems::kinetic::{General, Quadratic};
use shadowstep::{Scheme, ValidFor};

/// What is done with a scheme once its type is known.
pub trait WithScheme {
    type Result;

    fn with<S: Scheme + ValidFor<Quadratic>>(self, scheme: S) -> Self::Result;
}

/// Störmer–Verlet that begins with a drift.
#[shadowstep::splitting_scheme("stormer-verlet.toml", first = "drift")]
struct DriftKickDrift;

macro_rules! schemes {
    ($($Name:ident: $name:literal = $table:literal,)+) => {
        $(
            #[shadowstep::splitting_scheme($table)]
            struct $Name;
        )+

        /// Calls with the scheme of this name.
        pub fn with_scheme<W: WithScheme>(name: &str, work: W) -> W::Result {
            match name {
                "drift-kick-drift" => work.with(DriftKickDrift),
                $($name => work.with($Name),)+
                _ => panic!("no scheme {name} takes part"),
            }
        }
    };
}

schemes! {
    StormerVerlet: "stormer-verlet" = "stormer-verlet.toml",
    Yoshida4: "yoshida4" = "yoshida4.toml",
    MclachlanSb3a4: "mclachlan-sb3a4" = "mclachlan-sb3a4.toml",
    MclachlanSb3a5: "mclachlan-sb3a5" = "mclachlan-sb3a5.toml",
    Omelyan: "omelyan-4mn5fv" = "omelyan-4mn5fv.toml",
    BlanesMoan6: "blanes-moan-srkn6b" = "blanes-moan-srkn6b.toml",
    BlanesMoan11: "blanes-moan-srkn11b" = "blanes-moan-srkn11b.toml",
    BlanesMoan14: "blanes-moan-srkn14a" = "blanes-moan-srkn14a.toml",
    Nystrom8: "bce-rkn8-17" = "bce-rkn8-17.toml",
    Saba2: "saba2" = "saba2.toml",
    Saba4: "saba4" = "saba4.toml",
    Abah864: "abah864" = "abah864.toml",
    Abah1064: "abah1064" = "abah1064.toml",
    Aba1064: "aba1064" = "aba1064.toml",
    SofroniouSpaletta10: "sofroniou-spaletta10-35" = "sofroniou-spaletta10-35.toml",
}

/// What is done with a scheme for every T(p).
pub trait WithGeneralScheme {
    type Result;

    fn with<S: Scheme + ValidFor<General> + Clone>(self, scheme: S) -> Self::Result;
}

macro_rules! drift_first {
    ($($Name:ident: $name:literal = $table:literal,)+) => {
        $(
            #[shadowstep::splitting_scheme($table, first = "drift")]
            #[derive(Clone)]
            struct $Name;
        )+

        /// Calls with the scheme of this name, which begins with a drift.
        pub fn with_drift_first<W: WithGeneralScheme>(name: &str, work: W) -> W::Result {
            match name {
                $($name => work.with($Name),)+
                _ => panic!("no scheme {name} takes part in transformed time"),
            }
        }
    };
}

drift_first! {
    Suzuki4First: "suzuki4" = "suzuki4.toml",
    SofroniouSpaletta6First: "sofroniou-spaletta6-13" = "sofroniou-spaletta6-13.toml",
    SofroniouSpaletta8First: "sofroniou-spaletta8-21" = "sofroniou-spaletta8-21.toml",
    SofroniouSpaletta10First: "sofroniou-spaletta10-35" = "sofroniou-spaletta10-35.toml",
}
