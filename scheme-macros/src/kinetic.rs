//! `kinetic! { pub struct Relativistic; T(p) = sqrt(1 + p^2) }` → a kinetic energy with its drifts, for every number.

use proc_macro2::TokenStream;
use quote::quote;
use shadowstep_symbolic::{Graph, PotentialPrograms, Program};

use crate::definition::{Definition, texts};
use crate::program::{numbered, own, prepare, scratch_names, size, statements};

/// T with T_p and pᵀT_p − 2T.
struct Derived {
    programs: PotentialPrograms,
    /// T = ½pᵀM⁻¹p with a constant M⁻¹; then pᵀT_p − 2T = 0.
    quadratic: bool,
}

/// The struct and its implementation.
///
/// # Errors
/// A formula that is none, at its tokens.
pub(crate) fn emit(definition: &Definition) -> syn::Result<TokenStream> {
    let derived = derive(definition)?;
    let Derived { programs, quadratic } = &derived;
    let (structure, this) = definition.structure(&documentation(definition, &derived), &[]);
    let names = definition.names();
    let prepare = prepare(&[&programs.energy, &programs.gradient_and_rate], &names);
    let arguments = &definition.arguments;
    // names of our own, whatever the momenta are called
    let [weight, p, q, beta, energy, rate, scratch, results] =
        ["weight", "p", "q", "beta", "energy", "rate", "scratch", "results"].map(own);
    let body = |program: &Program, kept_before, outputs: &[TokenStream]| {
        let scratch_names = scratch_names(program, kept_before, programs.kept());
        let statements = statements(program, &names, outputs);
        quote! {
            let [#(#arguments),*] = #p else { ::core::unreachable!("as many as momenta") };
            #scratch_names
            #(#statements)*
        }
    };
    let velocities: Vec<_> = (0..arguments.len()).map(|i| numbered("velocity", i)).collect();
    let positions: Vec<_> = (0..arguments.len()).map(|i| numbered("q", i)).collect();
    // behind what the programs use: T_p, and pᵀT_p − 2T where it is not nothing
    let program_scratch = programs.kept() + programs.scratch();
    let scratch_size = size(program_scratch + arguments.len() + usize::from(!quadratic));
    let program_scratch = size(program_scratch);
    let drift = |program: &Program, outputs: &[TokenStream]| {
        let body = body(program, programs.energy.kept, outputs);
        quote! {
            let (#scratch, #results) = #scratch.split_at_mut(#program_scratch);
            let [#(#outputs,)* ..] = #results else { ::core::unreachable!("as much as asked for") };
            #body
            let [#(#positions),*] = #q else { ::core::unreachable!("as many as momenta") };
            #(#positions.add_product(#weight, #velocities);)*
        }
    };
    let plain = drift(&programs.gradient, &velocities);
    let augmented = if *quadratic {
        quote! { ::shadowstep::Kinetic::drift(self, #weight, #p, #q, #scratch); }
    } else {
        let outputs: Vec<_> = velocities.iter().cloned().chain([quote! { #rate }]).collect();
        let drift = drift(&programs.gradient_and_rate, &outputs);
        quote! { #drift #beta.add_product(#weight, #rate); }
    };
    let energy_body = body(&programs.energy, 0, &[quote! { #energy }]);
    let class = if *quadratic {
        quote! { Quadratic }
    } else {
        quote! { General }
    };
    let dimension = size(arguments.len());
    Ok(quote! {
        #structure

        #[allow(unused_variables, clippy::all)]
        impl<N: ::shadowstep::Number> ::shadowstep::Kinetic<N> for #this {
            type Class = ::shadowstep::kinetic::#class;
            fn dimension(&self) -> ::core::option::Option<usize> { ::core::option::Option::Some(#dimension) }
            fn scratch(&self) -> usize { #scratch_size }
            #prepare
            #[inline]
            fn drift(&self, #weight: &N, #p: &[N], #q: &mut [N], #scratch: &mut [N]) {
                #plain
            }
            #[inline]
            fn drift_augmented(
                &self,
                #weight: &N,
                #p: &[N],
                #q: &mut [N],
                #beta: &mut N,
                #scratch: &mut [N],
            ) {
                #augmented
            }
            fn energy(&self, #p: &[N], #energy: &mut N, #scratch: &mut [N]) {
                #energy_body
            }
        }
    })
}

fn derive(definition: &Definition) -> syn::Result<Derived> {
    let Definition { pair, function, arguments, properties, formula, .. } = definition;
    if let Some(word) = pair.as_ref().or(properties.first()) {
        return Err(syn::Error::new(word.span(), "pairs are for potentials; a kinetic energy is `T(px, py) = …`"));
    }
    if function != "T" {
        return Err(syn::Error::new(function.span(), "the kinetic energy is called T: `T(px, py) = …`"));
    }
    if arguments.is_empty() {
        return Err(syn::Error::new(function.span(), "a kinetic energy has at least one momentum: `T(p) = …`"));
    }
    let mut graph = Graph::new();
    let energy = graph
        .build(&formula.parse()?, &texts(arguments), &definition.parameters())
        .map_err(|e| formula.error(&e.range, &e.fault))?;
    let quadratic = graph.is_quadratic(energy, arguments.len());
    Ok(Derived { programs: graph.potential(energy, arguments.len()), quadratic })
}

fn documentation(definition: &Definition, derived: &Derived) -> Vec<String> {
    let Derived { programs, quadratic } = derived;
    let mut lines = vec![
        String::new(),
        definition.equation(),
        String::new(),
        format!(" - T_p costs {}.", programs.gradient.cost()),
    ];
    if *quadratic {
        lines.push(" - T is quadratic: a drift adds nothing to β, and every scheme moves it.".to_owned());
    } else {
        lines.push(format!(" - T_p with pᵀT_p − 2T costs {}.", programs.gradient_and_rate.cost()));
        lines.push(" - T is not quadratic: schemes whose order holds for every T(p) move it.".to_owned());
    }
    lines
}

#[cfg(test)]
mod tests {
    /// Each case: a name and what the user writes.
    const CASES: [(&str, &str); 4] = [
        ("relativistic", "pub struct Relativistic { c } T(p) = sqrt(c^4 + c^2*p^2)"),
        ("quartic", "pub struct Quartic; T(px, py) = (px^4 + py^4)/4 + px^2*py"),
        ("lotka-volterra", "pub struct LotkaVolterra; T(p) = p - exp(p)"),
        ("coupled", "struct Coupled { m } T(px, py) = (px^2 + px*py + py^2)/(2*m)"),
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
