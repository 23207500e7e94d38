//! `potential! { pub struct Kepler; U(x, y) = -1/sqrt(x^2 + y^2) }` → a potential with its gradient, for every number.

use proc_macro2::TokenStream;
use quote::quote;
use shadowstep_symbolic::{Graph, PotentialPrograms, Program};

use crate::definition::{Definition, texts};
use crate::pair;
use crate::program::{numbered, own, prepare, scratch_names, size, statements};

/// The struct and its implementation.
///
/// # Errors
/// A formula that is none, at its tokens.
pub(crate) fn emit(definition: &Definition) -> syn::Result<TokenStream> {
    if definition.function != "U" {
        return Err(syn::Error::new(definition.function.span(), "the potential is called U: `U(x, y) = …`"));
    }
    if definition.pair.is_some() {
        return pair::emit(definition);
    }
    let programs = programs(definition)?;
    let (structure, this) = definition.structure(&documentation(definition, &programs), &[]);
    let dimension = definition.arguments.len();
    let names = definition.names();
    let prepare = prepare(&[&programs.energy, &programs.gradient_and_rate], &names);
    let arguments = &definition.arguments;
    // names of our own, whatever the coordinates are called
    let [q, energy, gradient, rate, scratch] = ["q", "energy", "gradient", "rate", "scratch"].map(own);
    let body = |program: &Program, kept_before, outputs: &[TokenStream]| {
        let scratch_names = scratch_names(program, kept_before, programs.kept());
        let statements = statements(program, &names, outputs);
        quote! {
            let [#(#arguments),*] = #q else { ::core::unreachable!("as many as coordinates") };
            #scratch_names
            #(#statements)*
        }
    };
    let parts: Vec<_> = (0..dimension).map(|i| numbered("gradient", i)).collect();
    let with_rate: Vec<_> = parts.iter().cloned().chain([quote! { #rate }]).collect();
    let energy_body = body(&programs.energy, 0, &[quote! { #energy }]);
    let gradient_body = body(&programs.gradient, programs.energy.kept, &parts);
    let rate_body = body(&programs.gradient_and_rate, programs.energy.kept, &with_rate);
    let components = quote! { let [#(#parts),*] = #gradient else { ::core::unreachable!("as many as coordinates") }; };
    let (dimension, scratch_size) = (size(dimension), size(programs.kept() + programs.scratch()));
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
            #[inline]
            fn gradient(&self, #q: &[N], #gradient: &mut [N], #scratch: &mut [N]) {
                #components
                #gradient_body
            }
            #[inline]
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
        }
    })
}

fn programs(definition: &Definition) -> syn::Result<PotentialPrograms> {
    let Definition { function, arguments, properties, formula, .. } = definition;
    if let Some(property) = properties.first() {
        return Err(syn::Error::new(property.span(), "properties of bodies are for pairs: `pair U(r2; m_i, m_j) = …`"));
    }
    if arguments.is_empty() {
        return Err(syn::Error::new(function.span(), "a potential has at least one coordinate: `U(q) = …`"));
    }
    let mut graph = Graph::new();
    let energy = graph
        .build(&formula.parse()?, &texts(arguments), &definition.parameters())
        .map_err(|e| formula.error(&e.range, &e.fault))?;
    Ok(graph.potential(energy, arguments.len()))
}

fn documentation(definition: &Definition, programs: &PotentialPrograms) -> Vec<String> {
    vec![
        String::new(),
        definition.equation(),
        String::new(),
        format!(" - The gradient costs {}.", programs.gradient.cost()),
        format!(" - The gradient with qᵀU_q − 2U costs {}.", programs.gradient_and_rate.cost()),
    ]
}

#[cfg(test)]
mod tests {
    /// Each case: a name and what the user writes.
    const CASES: [(&str, &str); 9] = [
        ("kepler", "pub struct Kepler; U(x, y) = -1/sqrt(x^2 + y^2)"),
        ("pendulum", "pub struct Pendulum; U(q) = -cos(q)"),
        ("henon-heiles", "pub struct HenonHeiles; U(x, y) = (x^2 + y^2)/2 + x^2*y - y^3/3"),
        ("hill", "pub struct Hill; U(x, y) = exp(-(x^2 + y^2))"),
        ("well", "pub struct Well { depth, width } U(x, y) = -depth * exp(-(x^2 + y^2) / width^2)"),
        ("gravity", "pub struct Gravity { g } pair U(r2; m_i, m_j) = -g*m_i*m_j / sqrt(r2)"),
        ("lennard-jones", "pub struct LennardJones { e, s } pair U(r2) = 4*e*(s^12/r2^6 - s^6/r2^3)"),
        ("toda", "struct Toda; pair U(d) = exp(-d) + d - 1"),
        ("morse", "struct Morse { d, a } U(r) = d * (1 - exp(-a*(r - 1.4)))^2"),
    ];

    #[test]
    fn generated_code() {
        for (name, text) in CASES {
            let code = super::emit(&syn::parse_str(text).unwrap()).unwrap();
            let file = syn::parse2(code).expect("generated code is Rust");
            insta::assert_snapshot!(name, prettyplease::unparse(&file), text);
        }
    }
}
