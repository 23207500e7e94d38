//! `kinetic! { pub struct Relativistic; T(p) = sqrt(1 + p^2) }` → a kinetic energy with its drifts, for every number.

use proc_macro2::TokenStream;
use quote::quote;
use shadowstep_schemes::symbolic::PotentialPrograms;

use crate::definition::Definition;
use crate::methods::Methods;
use crate::program::{numbered, own, size};

/// T with T_p and pᵀT_p − 2T.
struct Derived {
    programs: PotentialPrograms,
    /// T = ½pᵀM⁻¹p + bᵀp + c with constants M⁻¹, b and c.
    quadratic: bool,
    /// b and c are 0; then pᵀT_p − 2T = 0.
    form: bool,
}

/// The struct and its implementation.
///
/// # Errors
/// An invalid formula, at its tokens.
pub(crate) fn emit(definition: &Definition) -> syn::Result<TokenStream> {
    let derived = derive(definition)?;
    definition.check_parameters()?;
    let (structure, this) = definition.structure(&documentation(definition, &derived), &[]);
    let arguments = &definition.arguments;
    // hygienic names, different from those of the momenta
    let [weight, p, q, beta, energy, scratch] = ["weight", "p", "q", "beta", "energy", "scratch"].map(own);
    let methods = Methods {
        programs: &derived.programs,
        names: definition.names(),
        arguments: quote! { let [#(#arguments),*] = #p else { ::core::unreachable!("as many as momenta") }; },
    };
    let (drift, drift_augmented) = drifts(&methods, arguments.len(), derived.form);
    let prepare = methods.prepare("prepare");
    let energy_body = methods.energy(&energy);
    // behind what the programs use: T_p, and pᵀT_p − 2T where it is not 0
    let scratch_size = size(methods.scratch() + arguments.len() + usize::from(!derived.form));
    let class = if derived.quadratic {
        quote! { Quadratic }
    } else {
        quote! { General }
    };
    let linear_terms =
        (derived.quadratic && !derived.form).then(|| quote! { fn has_linear_terms(&self) -> bool { true } });
    let dimension = size(arguments.len());
    Ok(quote! {
        #structure

        #[allow(unused_variables, clippy::all)]
        impl<N: ::shadowstep::Number> ::shadowstep::Kinetic<N> for #this {
            type Class = ::shadowstep::systems::kinetic::#class;
            fn dimension(&self) -> ::core::option::Option<usize> { ::core::option::Option::Some(#dimension) }
            fn scratch(&self) -> usize { #scratch_size }
            #prepare
            #[inline]
            fn drift(&self, #weight: &N, #p: &[N], #q: &mut [N], #scratch: &mut [N]) {
                #drift
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
                #drift_augmented
            }
            fn energy(&self, #p: &[N], #energy: &mut N, #scratch: &mut [N]) {
                #energy_body
            }
            #linear_terms
        }
    })
}

/// The bodies of `drift`, q += w T_p, and of `drift_augmented`, which adds w (pᵀT_p − 2T) to β too.
fn drifts(methods: &Methods<'_>, dimension: usize, form: bool) -> (TokenStream, TokenStream) {
    let [weight, p, q, beta, rate, scratch, results] =
        ["weight", "p", "q", "beta", "rate", "scratch", "results"].map(own);
    let [velocities, positions] =
        ["velocity", "q"].map(|name| (0..dimension).map(|i| numbered(name, i)).collect::<Vec<_>>());
    let program_scratch = size(methods.scratch());
    let drift = |outputs: &[TokenStream], body: TokenStream| {
        quote! {
            let (#scratch, #results) = #scratch.split_at_mut(#program_scratch);
            let [#(#outputs,)* ..] = #results else { ::core::unreachable!("as much as asked for") };
            #body
            let [#(#positions),*] = #q else { ::core::unreachable!("as many as momenta") };
            #(#positions.add_product(#weight, #velocities);)*
        }
    };
    let plain = drift(&velocities, methods.gradient(&velocities));
    let augmented = if form {
        quote! { ::shadowstep::Kinetic::drift(self, #weight, #p, #q, #scratch); }
    } else {
        let outputs: Vec<_> = velocities.iter().cloned().chain([quote! { #rate }]).collect();
        let drift = drift(&outputs, methods.gradient_and_rate(&outputs));
        quote! { #drift #beta.add_product(#weight, #rate); }
    };
    (plain, augmented)
}

fn derive(definition: &Definition) -> syn::Result<Derived> {
    let Definition { pair, function, arguments, properties, .. } = definition;
    if let Some(word) = pair.as_ref().or(properties.first()) {
        return Err(syn::Error::new(word.span(), "pairs are for potentials; a kinetic energy is `T(px, py) = …`"));
    }
    if function != "T" {
        return Err(syn::Error::new(function.span(), "the kinetic energy is called T: `T(px, py) = …`"));
    }
    let (mut graph, energy) =
        definition.graph_of_arguments("a kinetic energy has at least one momentum: `T(p) = …`")?;
    let quadratic = graph.is_at_most_quadratic(energy, arguments.len());
    let form = quadratic && graph.is_quadratic(energy, arguments.len());
    Ok(Derived { programs: graph.potential(energy, arguments.len()), quadratic, form })
}

fn documentation(definition: &Definition, derived: &Derived) -> Vec<String> {
    let Derived { programs, quadratic, form } = derived;
    let mut lines = vec![
        String::new(),
        definition.equation(),
        String::new(),
        format!(" - T_p costs {}.", programs.gradient.cost()),
    ];
    if *form {
        lines.push(" - T is quadratic: a drift adds nothing to β, and every scheme moves it.".to_owned());
    } else {
        lines.push(format!(" - T_p with pᵀT_p − 2T costs {}.", programs.gradient_and_rate.cost()));
        lines.push(match quadratic {
            true => " - T is at most quadratic: every scheme moves it.".to_owned(),
            false => " - T is not quadratic: schemes whose order holds for every T(p) move it.".to_owned(),
        });
    }
    lines
}

#[cfg(test)]
mod tests {
    /// Each case: a name and what the user writes.
    const CASES: [(&str, &str); 5] = [
        ("relativistic", "pub struct Relativistic { c } T(p) = sqrt(c^4 + c^2*p^2)"),
        ("quartic", "pub struct Quartic; T(px, py) = (px^4 + py^4)/4 + px^2*py"),
        ("lotka-volterra", "pub struct LotkaVolterra; T(p) = p - exp(p)"),
        ("linear", "struct Linear; T(px, ps) = px^2/2 + ps"),
        ("coupled", "struct Coupled { m } T(px, py) = (px^2 + px*py + py^2)/(2*m)"),
    ];

    #[test]
    fn generated_code() {
        for (name, text) in CASES {
            insta::assert_snapshot!(name, crate::methods::tests::code(super::emit, text), text);
        }
    }
}
