//! Plan of a step → Rust code.

use std::path::{Path, PathBuf};

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};
use shadowstep_schemes::document::Fault;
use shadowstep_schemes::symbolic::Rational;
use shadowstep_schemes::{Kinetic, Map, MapKind, Proved, StepPlan, counted, to_text};
use syn::{DeriveInput, Ident, LitStr};

/// The struct with its documentation and its steps.
pub(crate) fn scheme(item: &DeriveInput, proved: &Proved, files: &[PathBuf]) -> TokenStream {
    let DeriveInput { attrs, vis, ident, .. } = item;
    let plan = &proved.plan;
    let docs = documentation(proved);
    let watched = watch(files);
    let weights = Weights::of(plan);
    let (in_arrays, exact) = (weights.in_arrays(), weights.exact());
    let summary = summary(proved);
    let sequence = sequence(plan);
    let maps = Maps { maps: plan.maps.clone(), middle: plan.middle.clone() };
    // the default is false
    let is_inlined = maps.are_few().then(|| quote! { const IS_INLINED: bool = true; });
    let (forward, back) = (maps.function("forward", &weights), maps.inverse(&weights));
    let processor = processor(proved);
    let classes = match &proved.proof.many_parts {
        Some(_) => vec![quote!(systems::many_parts::ManyParts)],
        None if proved.holds_for_every_kinetic() => {
            vec![quote!(systems::kinetic::Quadratic), quote!(systems::kinetic::General)]
        }
        None => vec![quote!(systems::kinetic::Quadratic)],
    };
    quote! {
        #(#attrs)*
        #(#[doc = #docs])*
        #vis struct #ident;

        #watched

        impl ::shadowstep::Scheme for #ident {
            #is_inlined
            type Weights<N: ::shadowstep::Number> = #in_arrays;

            fn summary(&self) -> ::shadowstep::SchemeProperties<'_> {
                #summary
            }

            fn exact_weights(&self) -> ::shadowstep::steps::scheme::Weights<::std::vec::Vec<::shadowstep::Rational>> {
                #exact
            }

            fn sequence(&self) -> ::shadowstep::steps::scheme::Sequence<'_> {
                #sequence
            }

            #processor

            #forward
            #back
        }

        #(impl ::shadowstep::ValidFor<::shadowstep::#classes> for #ident {})*
    }
}

/// The struct with a body that compiles, and the faults as one compile error.
pub(crate) fn refused(item: &DeriveInput, table: &LitStr, message: &str, files: &[PathBuf]) -> TokenStream {
    let DeriveInput { attrs, vis, ident, .. } = item;
    let error = syn::Error::new(table.span(), message).into_compile_error();
    let watched = watch(files);
    quote! {
        #(#attrs)*
        #vis struct #ident;

        #error
        #watched

        impl ::shadowstep::Scheme for #ident {
            type Weights<N: ::shadowstep::Number> = ::shadowstep::steps::scheme::Weights<[N; 0]>;
            fn summary(&self) -> ::shadowstep::SchemeProperties<'_> {
                ::core::unreachable!()
            }
            fn exact_weights(&self) -> ::shadowstep::steps::scheme::Weights<::std::vec::Vec<::shadowstep::Rational>> {
                ::core::unreachable!()
            }
            fn sequence(&self) -> ::shadowstep::steps::scheme::Sequence<'_> {
                ::core::unreachable!()
            }
            fn forward<F: ::shadowstep::steps::scheme::Flows>(&self, _: &Self::Weights<F::Number>, _: &mut F) {}
            fn back<F: ::shadowstep::steps::scheme::Flows>(&self, _: &Self::Weights<F::Number>, _: &mut F) {}
        }

        impl ::shadowstep::ValidFor<::shadowstep::systems::kinetic::Quadratic> for #ident {}
        impl ::shadowstep::ValidFor<::shadowstep::systems::kinetic::General> for #ident {}
        impl ::shadowstep::ValidFor<::shadowstep::systems::many_parts::ManyParts> for #ident {}
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
        ::shadowstep::SchemeProperties {
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
    let mut weights: Vec<&Rational> = Vec::new();
    let maps = processor.post.iter().map(|Map { kind, weight }| {
        let place = weights.iter().position(|known| *known == weight).unwrap_or_else(|| {
            weights.push(weight);
            weights.len() - 1
        });
        let (kind, place) = (format_ident!("{kind:?}"), Literal::usize_unsuffixed(place));
        quote! { (MapKind::#kind, #place) }
    });
    let maps: Vec<_> = maps.collect();
    let weights = weights.into_iter().map(to_text);
    Some(quote! {
        fn processor(&self) -> ::std::vec::Vec<(::shadowstep::steps::scheme::MapKind, ::shadowstep::Rational)> {
            use ::shadowstep::steps::scheme::MapKind;
            ::shadowstep::steps::scheme::exact_maps(&[#(#maps),*], &[#(#weights),*])
        }
    })
}

/// The distinct weights of each kind, and the names they have in a step.
struct Weights<'a> {
    kinds: [(Ident, &'a [Rational]); 4],
}

impl<'a> Weights<'a> {
    fn of(plan: &'a StepPlan) -> Self {
        let StepPlan { kicks, drifts, middle_weights, gradient_kicks, .. } = plan;
        let fields = ["kicks", "drifts", "middle_parts", "gradient_kicks"].map(|name| format_ident!("{name}"));
        let [a, b, c, d] = fields;
        Weights { kinds: [(a, kicks), (b, drifts), (c, middle_weights), (d, gradient_kicks)] }
    }

    /// The type of the weights of a step.
    fn in_arrays(&self) -> TokenStream {
        let counts = self.kinds.iter().map(|(_, weights)| Literal::usize_unsuffixed(weights.len()));
        quote! { ::shadowstep::steps::scheme::Weights<#([N; #counts]),*> }
    }

    /// The exact weights.
    fn exact(&self) -> TokenStream {
        let fields = self.kinds.iter().map(|(field, weights)| {
            let texts = weights.iter().map(to_text);
            quote! { #field: &[#(#texts),*] }
        });
        quote! { ::shadowstep::steps::scheme::exact_weights(::shadowstep::steps::scheme::Weights { #(#fields),* }) }
    }

    /// Gives each weight its name.
    fn destructured(&self) -> TokenStream {
        let named = self.kinds.iter().filter(|(_, weights)| !weights.is_empty());
        let fields = named.map(|(field, weights)| {
            let name = field.to_string();
            let name = name.trim_end_matches('s');
            let names = (1..=weights.len()).map(|number| format_ident!("{name}_{number}"));
            quote! { #field: [#(#names),*] }
        });
        quote! {
            use ::shadowstep::steps::scheme::Weights;
            let Weights { #(#fields,)* .. } = weights;
        }
    }
}

fn sequence(plan: &StepPlan) -> TokenStream {
    let kinds = plan.maps.iter().map(|(kind, _)| format_ident!("{kind:?}"));
    let places = plan.maps.iter().map(|(_, place)| Literal::usize_unsuffixed(*place));
    let middle = plan.middle.iter().map(|place| Literal::usize_unsuffixed(*place));
    quote! {
        use ::shadowstep::steps::scheme::MapKind;
        ::shadowstep::steps::scheme::Sequence { maps: &[#((MapKind::#kinds, #places)),*], middle_parts: &[#(#middle),*] }
    }
}

/// The maps of a step, and the places of the weights of the middle parts between them.
#[derive(PartialEq)]
struct Maps {
    maps: Vec<(MapKind, usize)>,
    middle: Vec<usize>,
}

impl Maps {
    fn are_few(&self) -> bool {
        self.maps.len() + self.middle.len() <= StepPlan::MOST_INLINED
    }

    /// The maps in the opposite order; for a symmetric scheme these are the same, and are not written twice.
    fn inverse(&self, weights: &Weights<'_>) -> TokenStream {
        let reversed = Maps {
            maps: self.maps.iter().rev().copied().collect(),
            middle: self.middle.iter().rev().copied().collect(),
        };
        if reversed != *self {
            return reversed.function("back", weights);
        }
        quote! {
            #[inline(always)]
            fn back<F: ::shadowstep::steps::scheme::Flows>(&self, weights: &Self::Weights<F::Number>, flows: &mut F) {
                self.forward(weights, flows);
            }
        }
    }

    /// A function that applies the maps one after the other.
    fn function(&self, name: &str, weights: &Weights<'_>) -> TokenStream {
        let name = format_ident!("{name}");
        let weights = weights.destructured();
        let statements = self.maps.iter().enumerate().map(|(index, &(kind, place))| {
            let map = format_ident!("{}", kind.to_string().replace(' ', "_"));
            let weight = format_ident!("{map}_{}", place + 1);
            let middle = self.middle.get(index).map(|place| {
                let weight = format_ident!("middle_part_{}", place + 1);
                let order = if kind == MapKind::Drift { quote!(Descending) } else { quote!(Ascending) };
                quote! { flows.middle_parts(#weight, PartOrder::#order); }
            });
            quote! { flows.#map(#weight); #middle }
        });
        let import = (!self.middle.is_empty()).then(|| quote! { use ::shadowstep::steps::scheme::PartOrder; });
        // inlined into a loop, a short step can hold its state in registers
        let inline = match self.are_few() {
            true => quote! { #[inline(always)] },
            false => quote! { #[inline] },
        };
        quote! {
            #inline
            fn #name<F: ::shadowstep::steps::scheme::Flows>(&self, weights: &Self::Weights<F::Number>, flows: &mut F) {
                #import
                #weights
                #(#statements)*
            }
        }
    }
}

fn documentation(proved: &Proved) -> Vec<String> {
    let (table, plan) = (&proved.scheme.table, &proved.plan);
    let title = table.title.as_deref().unwrap_or("A splitting scheme");
    let gradient_kicks = match plan.count(MapKind::GradientKick) {
        0 => String::new(),
        count => format!(", {}", counted(count, "gradient kick")),
    };
    let meant_for = match (&proved.proof.many_parts, table.kinetic) {
        (Some(_), _) if proved.scheme.inner.is_some() => "H of slow forces, fast forces and T",
        (Some(_), _) => "H of three parts and more",
        (None, Kinetic::Any) => "every kinetic energy T(p)",
        (None, Kinetic::Quadratic) => "quadratic kinetic energy",
    };
    let maps = format!(
        " - {}: {}{gradient_kicks} and {}, {}.",
        counted(proved.scheme.stages.kick.len(), "stage"),
        counted(plan.count(MapKind::Kick), "kick"),
        counted(plan.count(MapKind::Drift), "drift"),
        if proved.proof.symmetric { "symmetric" } else { "not symmetric" }
    );
    let doi = table.doi.as_ref().map_or(String::new(), |doi| format!(", <https://doi.org/{doi}>"));
    let meant = format!(" {title}: `{}`, meant for {meant_for}.", table.name.value);
    let mut lines = vec![String::new(), meant, String::new(), proved_orders(proved), maps, costs(proved)];
    lines.extend(processed(proved));
    lines.push(format!(" - Reference: {}{doi}.", table.reference.as_deref().unwrap_or("none")));
    lines.extend(proved.notes.iter().map(note));
    lines
}

/// What a step costs.
fn costs(proved: &Proved) -> String {
    let (plan, cost) = (&proved.plan, proved.plan.cost());
    let kept = if plan.keeps_gradient() { " (the gradient of the last kick serves the next step)" } else { "" };
    let products_of_hessian = match plan.hessian_products {
        0 => String::new(),
        count => format!(" and {}", counted(count, "Hessian–vector product")),
    };
    match (plan.middle.len(), &proved.scheme.inner) {
        (1.., Some(inner)) => format!(
            " - Multiple time steps: a step evaluates the slow forces H_1 {} and the fast ones H_2 {}, in {} of `{}` \
                for each drift of the outer scheme.",
            times(plan.evaluations),
            times(plan.count(MapKind::Drift)),
            counted(inner.substeps, "step"),
            inner.scheme.table.name.value
        ),
        (0, _) => format!(
            " - A step costs {}{kept}{products_of_hessian}, and {products} multiplications and {products} additions \
                per dimension with unit masses; β adds {beta} of both.",
            counted(plan.evaluations, "gradient"),
            products = cost.products_per_dimension,
            beta = cost.products_for_beta
        ),
        (between, None) => format!(
            " - H_1 flows where a scheme for two parts has kicks, H_n where it has drifts, and {} H_2 … H_(n−1), in \
                both orders by turns.",
            times(between)
        ),
    }
}

/// What is proved of a processed scheme.
fn processed(proved: &Proved) -> Option<String> {
    let (processor, effective) = (proved.scheme.processor.as_ref()?, proved.proof.effective.as_ref()?);
    Some(format!(
        " - Processed: these are the orders of its kernel. With its processor the effective order is {} for every \
         T(p), {} for quadratic T{}: proved. An output costs {}.",
        effective.general,
        effective.quadratic,
        proved.orders().and_in_epsilon(),
        counted(processor.evaluations(), "gradient")
    ))
}

/// A note on the table, as text of Markdown: a macro cannot warn.
fn note(note: &Fault) -> String {
    let file = Path::new(&note.path).file_name().unwrap_or_default().to_string_lossy();
    let values = note.values.iter().map(|(found, needed)| format!("; found {found}, needed {needed}"));
    let hint = note.hint.iter().map(|hint| format!(" ({hint})"));
    let sentence: String = [note.message.clone()].into_iter().chain(values).chain(hint).collect();
    let mut escaped = String::new();
    for c in sentence.chars() {
        if "\\[]*_<>#`".contains(c) {
            escaped.push('\\');
        }
        escaped.push(if c == '\n' { ' ' } else { c });
    }
    format!(" - Note: `{file}`, line {}: {escaped}.", note.line)
}

fn proved_orders(proved: &Proved) -> String {
    if let Some(many_parts) = &proved.proof.many_parts {
        let more = if proved.scheme.inner.is_some() { "" } else { " and more" };
        return format!(" - Order {many_parts} for H of three parts{more}: proved.");
    }
    let quadratic = &proved.proof.quadratic;
    match proved.order_for_every_kinetic() {
        Some(every) => {
            let refused =
                if proved.holds_for_every_kinetic() { "" } else { " A T(p) that is not quadratic is refused." };
            format!(" - Order {every} for every T(p), order {quadratic} for quadratic T: proved.{refused}")
        }
        None => format!(" - Order {quadratic} for quadratic T: proved. A T(p) that is not quadratic is refused."),
    }
}

fn times(count: usize) -> String {
    if count == 1 { "once".to_owned() } else { format!("{count} times") }
}

#[cfg(test)]
mod tests {
    use shadowstep_schemes::{Source, read, shipped};

    #[test]
    fn generated_code_for_many_parts() {
        let proved = read(&shipped("yoshida4").unwrap(), &|base, _| shipped(base)).unwrap().for_many_parts().unwrap();
        let code = super::scheme(&syn::parse_quote! { pub struct Yoshida4; }, &proved, &[]);
        insta::assert_snapshot!(prettyplease::unparse(&syn::parse2(code).expect("generated code is Rust")));
    }

    #[test]
    fn generated_code_with_an_inner_scheme() {
        let proved = read(&shipped("r-respa-4").unwrap(), &|base, _| shipped(base)).unwrap().for_many_parts().unwrap();
        let code = super::scheme(&syn::parse_quote! { pub struct Respa4; }, &proved, &[]);
        insta::assert_snapshot!(prettyplease::unparse(&syn::parse2(code).expect("generated code is Rust")));
    }

    #[test]
    fn generated_code_of_every_kind_of_table() {
        // kick first and drift first, compositions and stages, exact and rounded, palindromes and others, gradient
        // kicks, processed
        let kinds = "{blanes-moan-srkn6b,chin-4a,mclachlan-atela5,pefrl,ruth3,saba2,\
                     stormer-verlet,suzuki4,symplectic-euler,wisdom-corrector-5,yoshida4}";
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

    #[test]
    fn notes_on_a_table_are_in_the_documentation() {
        let path = "/home/me/mine.toml".to_owned();
        let text = shipped("yoshida4").unwrap().text.replace("order = 4", "order = 2");
        let proved = read(&Source { path, text }, &|base, _| shipped(base)).unwrap();
        assert_eq!(proved.notes.len(), 1);
        let notes: Vec<_> = super::documentation(&proved).into_iter().filter(|line| line.contains("Note")).collect();
        let note =
            " - Note: `mine.toml`, line 4: order 2 is claimed, order 4 holds for every T(p) (write \\`order = 4\\`).";
        assert_eq!(notes, [note]);
    }

    fn capitalised(word: &str) -> String {
        word[..1].to_uppercase() + &word[1..]
    }
}
