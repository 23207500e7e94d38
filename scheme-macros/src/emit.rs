//! Plan of a step → Rust code.

use std::path::PathBuf;

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};
use shadowstep_schemes::claims::HIGHEST_ORDER;
use shadowstep_schemes::proof::Order;
use shadowstep_schemes::{Kinetic, Map, MapKind, Plan, Proved, to_text};
use syn::{Ident, ItemStruct, LitStr};

/// The most kicks and drifts of a step that is inlined wherever it is called: 7 are those of Yoshida's scheme of order 4.
const MOST_INLINED: usize = 8;

/// The struct with its documentation and its steps.
pub(crate) fn scheme(item: &ItemStruct, proved: &Proved, files: &[PathBuf]) -> TokenStream {
    let ItemStruct { attrs, vis, ident, .. } = item;
    let plan = &proved.plan;
    let docs = documentation(proved);
    let watched = watch(files);
    let count = Literal::usize_unsuffixed(plan.weights().count());
    let names = weight_names(plan);
    let weights: Vec<_> = plan.weights().map(to_text).collect();
    let summary = summary(proved);
    let forth = Sequence { maps: plan.maps.clone(), middle: plan.middle.clone() };
    let back = forth.reversed();
    let step = step("step", "forward", &names, &forth, false);
    let step_augmented = self::step("step_augmented", "forward", &names, &forth, true);
    let step_back = self::step("step_back", "back", &names, &back, false);
    let step_back_augmented = self::step("step_back_augmented", "back", &names, &back, true);
    let kicks = Literal::usize_unsuffixed(plan.kicks.len());
    let kinds = plan.maps.iter().map(|(kind, _)| format_ident!("{kind:?}"));
    let places = plan.maps.iter().map(|(_, place)| Literal::usize_unsuffixed(*place));
    let middle = (!plan.middle.is_empty()).then(|| {
        let count = Literal::usize_unsuffixed(plan.middle_weights.len());
        let places = plan.middle.iter().map(|place| Literal::usize_unsuffixed(*place));
        quote! {
            fn middle(&self) -> (usize, &[usize]) {
                (#count, &[#(#places),*])
            }
        }
    });
    let gradient_kicks = (!plan.gradient_kicks.is_empty()).then(|| {
        let count = Literal::usize_unsuffixed(plan.gradient_kicks.len());
        quote! {
            fn gradient_kicks(&self) -> usize {
                #count
            }
        }
    });
    let processor = processor(proved);
    let valid_for_other = match &proved.proof.many_parts {
        Some(_) => Some(quote! { impl ::shadowstep::ValidFor<::shadowstep::many_parts::ManyParts> for #ident {} }),
        None => proved.holds_for_every_kinetic().then(|| {
            quote! { impl ::shadowstep::ValidFor<::shadowstep::kinetic::General> for #ident {} }
        }),
    };
    quote! {
        #(#attrs)*
        #(#[doc = #docs])*
        #vis struct #ident;

        #watched

        impl ::shadowstep::Scheme for #ident {
            type Array<N: ::shadowstep::Number> = [N; #count];

            fn summary(&self) -> ::shadowstep::Summary<'_> {
                #summary
            }

            fn weights<N: ::shadowstep::Number>(
                &self,
                scaled: impl ::core::ops::FnMut(&::shadowstep::Rational) -> N,
            ) -> [N; #count] {
                ::shadowstep::scheme::exact_weights([#(#weights),*]).each_ref().map(scaled)
            }

            fn maps(&self) -> (usize, &[(::shadowstep::scheme::MapKind, usize)]) {
                (#kicks, &[#((::shadowstep::scheme::MapKind::#kinds, #places)),*])
            }

            #middle
            #gradient_kicks
            #processor

            #step
            #step_augmented
            #step_back
            #step_back_augmented
        }

        #valid_for_other
    }
}

/// The struct with a body that compiles, and the faults as one compile error.
pub(crate) fn refused(item: &ItemStruct, table: &LitStr, message: &str, files: &[PathBuf]) -> TokenStream {
    let ItemStruct { attrs, vis, ident, .. } = item;
    let error = syn::Error::new(table.span(), message).into_compile_error();
    let watched = watch(files);
    let steps = ["step", "step_augmented", "step_back", "step_back_augmented"].map(|name| {
        let name = format_ident!("{name}");
        quote! {
            fn #name<M: ::shadowstep::System>(
                &self,
                _: &::shadowstep::StepWeights<[M::Number; 0]>,
                _: &mut M,
            )
            where
                Self: ::shadowstep::ValidFor<M::Class>,
            {
            }
        }
    });
    quote! {
        #(#attrs)*
        #vis struct #ident;

        #error
        #watched

        impl ::shadowstep::Scheme for #ident {
            type Array<N: ::shadowstep::Number> = [N; 0];
            fn summary(&self) -> ::shadowstep::Summary<'_> {
                ::core::unreachable!()
            }
            fn weights<N: ::shadowstep::Number>(
                &self,
                _: impl ::core::ops::FnMut(&::shadowstep::Rational) -> N,
            ) -> [N; 0] {
                ::core::unreachable!()
            }
            fn maps(&self) -> (usize, &[(::shadowstep::scheme::MapKind, usize)]) {
                ::core::unreachable!()
            }
            #(#steps)*
        }

        impl ::shadowstep::ValidFor<::shadowstep::kinetic::General> for #ident {}
        impl ::shadowstep::ValidFor<::shadowstep::many_parts::ManyParts> for #ident {}
    }
}

/// Makes the compiler rebuild when a table on disk changes.
fn watch(files: &[PathBuf]) -> TokenStream {
    let files = files.iter().map(|file| file.display().to_string());
    quote! { #(const _: &[u8] = ::core::include_bytes!(#files);)* }
}

fn summary(proved: &Proved) -> TokenStream {
    let name = &proved.scheme.table.name.value;
    let of_two = proved.order_for_every_kinetic().map_or(0, |order| order.order);
    let order = Literal::u32_unsuffixed(of_two);
    let of_quadratic = if proved.proof.many_parts.is_some() { of_two } else { proved.proof.quadratic.order };
    let order_quadratic = Literal::u32_unsuffixed(of_quadratic);
    let symmetric = proved.proof.symmetric;
    let evaluations = Literal::usize_unsuffixed(proved.plan.evaluations);
    quote! {
        ::shadowstep::Summary {
            name: #name,
            order: #order,
            order_quadratic: #order_quadratic,
            symmetric: #symmetric,
            evaluations: #evaluations,
        }
    }
}

/// The post-map of a processed scheme.
fn processor(proved: &Proved) -> Option<TokenStream> {
    let processor = proved.scheme.processor.as_ref()?;
    let kinds = processor.post.iter().map(|Map { kind, .. }| format_ident!("{kind:?}"));
    let weights = processor.post.iter().map(|map| to_text(&map.weight));
    Some(quote! {
        fn processor(&self) -> ::std::vec::Vec<(::shadowstep::scheme::MapKind, ::shadowstep::Rational)> {
            ::shadowstep::scheme::exact_maps([#((::shadowstep::scheme::MapKind::#kinds, #weights)),*])
        }
    })
}

/// `kick_1, kick_2, …, drift_1, …, middle_1, …, gradient_kick_1, …`
fn weight_names(plan: &Plan) -> Vec<Ident> {
    let of_kind = |kind, count| (0..count).map(move |i| weight_name((kind, i)));
    of_kind(MapKind::Kick, plan.kicks.len())
        .chain(of_kind(MapKind::Drift, plan.drifts.len()))
        .chain((0..plan.middle_weights.len()).map(middle_name))
        .chain(of_kind(MapKind::GradientKick, plan.gradient_kicks.len()))
        .collect()
}

fn weight_name((kind, index): (MapKind, usize)) -> Ident {
    format_ident!("{kind}_{}", index + 1, kind = kind.to_string().replace(' ', "_"))
}

fn middle_name(index: usize) -> Ident {
    format_ident!("middle_{}", index + 1)
}

/// The maps of a step, and the places of the weights of the middle parts between them.
struct Sequence {
    maps: Vec<(MapKind, usize)>,
    middle: Vec<usize>,
}

impl Sequence {
    fn reversed(&self) -> Sequence {
        Sequence {
            maps: self.maps.iter().rev().copied().collect(),
            middle: self.middle.iter().rev().copied().collect(),
        }
    }
}

/// The middle parts after a map.
fn middle_parts((kind, place): (MapKind, usize), augmented: bool) -> TokenStream {
    let weight = middle_name(place);
    let order = if kind == MapKind::Drift { quote!(Descending) } else { quote!(Ascending) };
    let order = quote! { ::shadowstep::scheme::PartOrder::#order };
    match augmented {
        false => quote! { system.middle_parts(#weight, #order); },
        true => quote! { system.middle_parts_augmented(#weight, #order); },
    }
}

fn step(name: &str, direction: &str, names: &[Ident], sequence: &Sequence, augmented: bool) -> TokenStream {
    let Sequence { maps, middle } = sequence;
    let (name, direction) = (format_ident!("{name}"), format_ident!("{direction}"));
    let count = Literal::usize_unsuffixed(names.len());
    let statements = maps.iter().enumerate().map(|(index, &map)| {
        let weight = weight_name(map);
        let own = match (map.0, augmented) {
            (MapKind::Kick, false) => quote! { system.kick(#weight); },
            (MapKind::Kick, true) => quote! { system.kick_augmented(#weight); },
            (MapKind::Drift, false) => quote! { system.drift(#weight); },
            (MapKind::Drift, true) => quote! { system.drift_augmented(#weight); },
            (MapKind::GradientKick, false) => quote! { system.gradient_kick(#weight); },
            (MapKind::GradientKick, true) => quote! { system.gradient_kick_augmented(#weight); },
        };
        let next = middle.get(index).map(|&place| middle_parts((map.0, place), augmented));
        quote! { #own #next }
    });
    let begin = augmented.then(|| quote! { system.clear_increments(); });
    // inlined into a loop, a short step can hold its state in registers
    let inline = if maps.len() + middle.len() <= MOST_INLINED {
        quote! { #[inline(always)] }
    } else {
        quote! { #[inline] }
    };
    quote! {
        #inline
        fn #name<M: ::shadowstep::System>(
            &self,
            weights: &::shadowstep::StepWeights<[M::Number; #count]>,
            system: &mut M,
        )
        where
            Self: ::shadowstep::ValidFor<M::Class>,
        {
            let [#(#names),*] = weights.#direction();
            #begin
            #(#statements)*
        }
    }
}

fn documentation(proved: &Proved) -> Vec<String> {
    let (table, plan) = (&proved.scheme.table, &proved.plan);
    let title = table.title.as_deref().unwrap_or("A splitting scheme");
    let cost = plan.cost();
    let kept = if plan.keeps_gradient() { " (the gradient of the last kick serves the next step)" } else { "" };
    let [gradient_kicks, products_of_hessian] = match plan.count(MapKind::GradientKick) {
        0 => [String::new(), String::new()],
        count => [
            format!(", {}", counted(count, "gradient kick")),
            format!(" and {}", counted(plan.hessian_products, "Hessian–vector product")),
        ],
    };
    let meant_for = match (&proved.proof.many_parts, table.kinetic) {
        (Some(_), _) => "H of three parts and more",
        (None, Kinetic::Any) => "every kinetic energy T(p)",
        (None, Kinetic::Quadratic) => "quadratic kinetic energy",
    };
    let doi = table.doi.as_ref().map_or(String::new(), |doi| format!(", <https://doi.org/{doi}>"));
    let costs = match plan.middle.len() {
        0 => format!(
            " - A step costs {}{kept}{products_of_hessian}, and {products} multiplications and {products} additions per dimension with unit masses; β adds {beta} of both.",
            counted(plan.evaluations, "gradient"),
            products = cost.products_per_dimension,
            beta = cost.products_for_beta
        ),
        between => format!(
            " - H_1 flows where a scheme for two parts has kicks, H_n where it has drifts, and {} H_2 … H_(n−1), in both orders by turns.",
            if between == 1 { "once".to_owned() } else { format!("{between} times") }
        ),
    };
    let mut lines = vec![
        String::new(),
        format!(" {title}: `{}`, meant for {meant_for}.", table.name.value),
        String::new(),
        proved_orders(proved),
        format!(
            " - {}: {}{gradient_kicks} and {}, {}.",
            counted(proved.scheme.stages.kick.len(), "stage"),
            counted(plan.count(MapKind::Kick), "kick"),
            counted(plan.count(MapKind::Drift), "drift"),
            if proved.proof.symmetric { "symmetric" } else { "not symmetric" }
        ),
        costs,
        format!(" - Reference: {}{doi}.", table.reference.as_deref().unwrap_or("none")),
    ];
    if let (Some(processor), Some(effective)) = (&proved.scheme.processor, &proved.proof.effective) {
        let processed = format!(
            " - Processed: these are the orders of its kernel. With its processor the effective order is {} for every T(p), {} for \
             quadratic T{}: proved. An output costs {}.",
            order(&effective.general),
            order(&effective.quadratic),
            near_integrable(&effective.near_integrable),
            counted(processor.evaluations(), "gradient")
        );
        lines.insert(lines.len() - 1, processed);
    }
    lines
}

fn near_integrable(orders: &[Order]) -> String {
    let orders: Vec<_> = orders.iter().map(|order| order.order.to_string()).collect();
    if orders.is_empty() { String::new() } else { format!(", ({}) for A + εB", orders.join(",")) }
}

fn proved_orders(proved: &Proved) -> String {
    if let Some(many_parts) = &proved.proof.many_parts {
        return format!(" - Order {} for H of three parts and more: proved.", order(many_parts));
    }
    let quadratic = order(&proved.proof.quadratic);
    match proved.order_for_every_kinetic() {
        Some(every) => {
            let refused =
                if proved.holds_for_every_kinetic() { "" } else { " A T(p) that is not quadratic is refused." };
            format!(" - Order {} for every T(p), order {quadratic} for quadratic T: proved.{refused}", order(every))
        }
        None => format!(" - Order {quadratic} for quadratic T: proved. A T(p) that is not quadratic is refused."),
    }
}

fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

fn order(order: &Order) -> String {
    let least = if order.failed.is_none() && order.order == HIGHEST_ORDER { " or more" } else { "" };
    match order.digits {
        None => format!("{}{least} (exactly)", order.order),
        Some(digits) => format!("{}{least} (to {digits} digits)", order.order),
    }
}

#[cfg(test)]
mod tests {
    use shadowstep_schemes::{read, shipped};

    #[test]
    fn generated_code_for_many_parts() {
        let proved = read(&shipped("yoshida4").unwrap(), &|base, _| shipped(base)).unwrap().for_many_parts().unwrap();
        let code = super::scheme(&syn::parse_quote! { pub struct Yoshida4; }, &proved, &[]);
        insta::assert_snapshot!(prettyplease::unparse(&syn::parse2(code).expect("generated code is Rust")));
    }

    #[test]
    fn generated_code_of_every_kind_of_table() {
        // kick first and drift first, compositions and stages, exact and rounded, palindromes and others, gradient kicks, processed
        let kinds = "{blanes-moan-srkn6b,chin-4a,mclachlan-atela5,pefrl,ruth3,saba2,stormer-verlet,suzuki4,symplectic-euler,wisdom-corrector-5,yoshida4}";
        insta::glob!("../../schemes/tables", &format!("{kinds}.toml"), |path| {
            let name = path.file_stem().unwrap().to_str().unwrap();
            let proved = read(&shipped(name).unwrap(), &|base, _| shipped(base)).unwrap();
            let ident = quote::format_ident!("{}", name.split('-').map(capitalised).collect::<String>());
            let item = syn::parse_quote! { pub struct #ident; };
            let code = super::scheme(&item, &proved, &[]);
            let file = syn::parse2(code).expect("generated code is Rust");
            insta::assert_snapshot!(prettyplease::unparse(&file));
        });
    }

    fn capitalised(word: &str) -> String {
        word[..1].to_uppercase() + &word[1..]
    }
}
