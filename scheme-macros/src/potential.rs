//! `potential! { pub struct Kepler; U(x, y) = -1/sqrt(x^2 + y^2) }` → a potential with its gradient, for every number.

use proc_macro2::TokenStream;
use quote::quote;
use shadowstep_schemes::symbolic::PotentialPrograms;

use crate::definition::Definition;
use crate::methods::Methods;
use crate::pair;
use crate::program::{Names, numbered, own, size};

/// The struct and its implementation.
///
/// # Errors
/// An invalid formula, at its tokens.
pub(crate) fn emit(definition: &Definition) -> syn::Result<TokenStream> {
    if definition.function != "U" {
        return Err(syn::Error::new(definition.function.span(), "the potential is called U: `U(x, y) = …`"));
    }
    if definition.pair.is_some() {
        return pair::emit(definition);
    }
    let (programs, second) = programs(definition)?;
    definition.check_parameters()?;
    let (structure, this) = definition.structure(&documentation(definition, &programs, &second), &[]);
    let arguments = &definition.arguments;
    // hygienic names, different from those of the coordinates
    let [q, energy, gradient, rate, scratch] = ["q", "energy", "gradient", "rate", "scratch"].map(own);
    let methods = Methods {
        programs: &programs,
        names: definition.names(),
        arguments: quote! { let [#(#arguments),*] = #q else { ::core::unreachable!("as many as coordinates") }; },
    };
    let parts: Vec<_> = (0..arguments.len()).map(|i| numbered("gradient", i)).collect();
    let with_rate: Vec<_> = parts.iter().cloned().chain([quote! { #rate }]).collect();
    let prepare = methods.prepare("prepare");
    let energy_body = methods.energy(&energy);
    let gradient_body = methods.gradient(&parts);
    let rate_body = methods.gradient_and_rate(&with_rate);
    let components = quote! { let [#(#parts),*] = #gradient else { ::core::unreachable!("as many as coordinates") }; };
    let (dimension, scratch_size) = (size(arguments.len()), size(methods.scratch()));
    let hessian_product = hessian_product(definition, &this, &second);
    Ok(quote! {
        #structure

        #[allow(unused_variables, clippy::all)]
        impl<N: ::shadowstep::Number> ::shadowstep::Potential<N> for #this {
            fn dimension(&self) -> usize { #dimension }
            fn scratch(&self) -> usize { #scratch_size }
            #prepare
            fn energy(&self, #q: &[N], #energy: &mut N, #scratch: &mut [N]) {
                #energy_body
            }
            #[inline(always)]
            fn gradient(&self, #q: &[N], #gradient: &mut [N], #scratch: &mut [N]) {
                #components
                #gradient_body
            }
            #[inline(always)]
            fn gradient_and_rate(
                &self,
                #q: &[N],
                #gradient: &mut [N],
                #rate: &mut N,
                #scratch: &mut [N],
            ) {
                #components
                #rate_body
            }
            fn hessian(&self) -> ::core::option::Option<&dyn ::shadowstep::systems::potential::HessianProduct<N>> {
                ::core::option::Option::Some(self)
            }
        }

        #hessian_product
    })
}

/// The implementation of the Hessian–vector product.
fn hessian_product(definition: &Definition, this: &TokenStream, programs: &PotentialPrograms) -> TokenStream {
    let arguments = &definition.arguments;
    let [q, v, product, rate, scratch] = ["q", "v", "product", "rate", "scratch"].map(own);
    let direction: Vec<_> = (0..arguments.len()).map(|i| numbered("direction", i)).collect();
    let methods = Methods {
        programs,
        names: Names { properties: direction.clone(), ..definition.names() },
        arguments: quote! {
            let [#(#arguments),*] = #q else { ::core::unreachable!("as many as coordinates") };
            let [#(#direction),*] = #v else { ::core::unreachable!("as many as coordinates") };
        },
    };
    let parts: Vec<_> = (0..arguments.len()).map(|i| numbered("product", i)).collect();
    let with_rate: Vec<_> = parts.iter().cloned().chain([quote! { #rate }]).collect();
    let components = quote! { let [#(#parts),*] = #product else { ::core::unreachable!("as many as coordinates") }; };
    let prepare = methods.prepare("prepare_hessian");
    let (product_body, rate_body) = (methods.gradient(&parts), methods.gradient_and_rate(&with_rate));
    let scratch_size = size(methods.scratch());
    quote! {
        #[allow(unused_variables, clippy::all)]
        impl<N: ::shadowstep::Number> ::shadowstep::systems::potential::HessianProduct<N> for #this {
            fn hessian_scratch(&self) -> usize { #scratch_size }
            #prepare
            fn hessian_product(&self, #q: &[N], #v: &[N], #product: &mut [N], #scratch: &mut [N]) {
                N::in_widest_instructions(
                    #[inline(always)]
                    || {
                        #components
                        #product_body
                    },
                );
            }
            fn hessian_product_and_rate(
                &self,
                #q: &[N],
                #v: &[N],
                #product: &mut [N],
                #rate: &mut N,
                #scratch: &mut [N],
            ) {
                N::in_widest_instructions(
                    #[inline(always)]
                    || {
                        #components
                        #rate_body
                    },
                );
            }
        }
    }
}

/// The programs of U and those of its second derivatives.
fn programs(definition: &Definition) -> syn::Result<(PotentialPrograms, PotentialPrograms)> {
    if let Some(property) = definition.properties.first() {
        return Err(syn::Error::new(property.span(), "properties of bodies are for pairs: `pair U(r2; m_i, m_j) = …`"));
    }
    let (mut graph, energy) = definition.graph_of_arguments("a potential has at least one coordinate: `U(q) = …`")?;
    let coordinates = definition.arguments.len();
    Ok((graph.potential(energy, coordinates), graph.hessian_product(energy, coordinates)))
}

fn documentation(definition: &Definition, programs: &PotentialPrograms, second: &PotentialPrograms) -> Vec<String> {
    vec![
        String::new(),
        definition.equation(),
        String::new(),
        format!(" - The gradient costs {}.", programs.gradient.cost()),
        format!(" - The gradient with qᵀU_q − 2U costs {}.", programs.gradient_and_rate.cost()),
        format!(" - The Hessian–vector product U_qq v costs {}.", second.gradient.cost()),
    ]
}

#[cfg(test)]
mod tests {
    /// Each case: a name and what the user writes.
    const CASES: [(&str, &str); 10] = [
        ("kepler", "pub struct Kepler; U(x, y) = -1/sqrt(x^2 + y^2)"),
        ("pendulum", "pub struct Pendulum; U(q) = -cos(q)"),
        ("henon-heiles", "pub struct HenonHeiles; U(x, y) = (x^2 + y^2)/2 + x^2*y - y^3/3"),
        ("hill", "pub struct Hill; U(x, y) = exp(-(x^2 + y^2))"),
        ("well", "pub struct Well { depth, width } U(x, y) = -depth * exp(-(x^2 + y^2) / width^2)"),
        ("gravity", "pub struct Gravity { g } pair U(r2; m_i, m_j) = -g*m_i*m_j / sqrt(r2)"),
        ("softened", "pub struct Softened { s } pair U(r2; m_i, m_j) = -m_i*m_j/sqrt(r2 + s^2)"),
        ("lennard-jones", "pub struct LennardJones { e, s } pair U(r2) = 4*e*(s^12/r2^6 - s^6/r2^3)"),
        ("toda", "struct Toda; pair U(d) = exp(-d) + d - 1"),
        ("morse", "struct Morse { d, a } U(r) = d * (1 - exp(-a*(r - 1.4)))^2"),
    ];

    #[test]
    fn generated_code() {
        for (name, text) in CASES {
            insta::assert_snapshot!(name, crate::methods::tests::code(super::emit, text), text);
        }
    }
}
