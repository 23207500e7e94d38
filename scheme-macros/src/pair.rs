//! `potential! { pub struct Gravity { g } pair U(r2; m_i, m_j) = -g*m_i*m_j/sqrt(r2) }` → the energy of a pair of
//! bodies.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};
use shadowstep_schemes::symbolic::{PotentialPrograms, Separation, Summand, is_symmetric};

use crate::definition::{Definition, texts};
use crate::methods::Methods;
use crate::program::{numbered, own, size};

/// The struct and its implementation.
///
/// # Errors
/// An invalid formula, arguments that a pair does not have, at their tokens.
pub(crate) fn emit(definition: &Definition) -> syn::Result<TokenStream> {
    let separation = separation(definition)?;
    let properties = properties(definition)?;
    let (programs, second) = programs(definition, separation)?;
    definition.check_parameters()?;
    let (structure, this) = definition.structure(&documentation(definition, separation, &programs), &properties);
    let curvature = curvature(definition, &this, &second);
    let generics = if definition.parameters().is_empty() && properties.is_empty() {
        quote! {}
    } else {
        quote! { <N> }
    };
    let [one_by_one, in_blocks, each] = [one_by_one, in_blocks, each].map(|methods| methods(definition, &programs));
    let kind = format_ident!("{separation:?}");
    let given = programs.summand;
    let given = format_ident!("{given:?}");
    Ok(quote! {
        #structure

        impl #generics ::shadowstep::systems::pairs::Pair for #this {
            fn separation(&self) -> ::shadowstep::systems::pairs::Separation { ::shadowstep::systems::pairs::Separation::#kind }
            fn summand(&self) -> ::shadowstep::systems::pairs::Summand { ::shadowstep::systems::pairs::Summand::#given }
            fn properties(&self) -> ::std::vec::Vec<usize> { ::std::vec![#(self.#properties.len()),*] }
        }

        #[allow(unused_variables, clippy::all)]
        impl<N: ::shadowstep::Number> ::shadowstep::systems::pairs::PairPotential<N> for #this {
            #one_by_one
            #in_blocks
            #each
            fn curved(&self) -> ::core::option::Option<&dyn ::shadowstep::systems::pairs::PairCurvature<N>> {
                ::core::option::Option::Some(self)
            }
        }

        #curvature
    })
}

/// The scratch space, and the methods of one pair.
fn one_by_one(definition: &Definition, programs: &PotentialPrograms) -> TokenStream {
    let x = &definition.arguments[0];
    let [i, j, energy, slope, summand, scratch] = ["i", "j", "energy", "slope", "summand", "scratch"].map(own);
    let methods = Methods { programs, names: definition.names(), arguments: property_values(definition, [&i, &j]) };
    let prepare =
        methods.prepare("prepare").unwrap_or_else(|| quote! { fn prepare(&self, _: &mut [N], _: &N::Context) {} });
    let energy_body = methods.energy(&energy);
    let slope_body = methods.gradient(&[quote! { #slope }]);
    let summand_body = methods.gradient_and_rate(&[quote! { #slope }, quote! { #summand }]);
    let scratch_size = size(methods.scratch());
    quote! {
        fn scratch(&self) -> usize { #scratch_size }
        #prepare
        #[inline(always)]
        fn energy(&self, #i: usize, #j: usize, #x: &N, #energy: &mut N, #scratch: &mut [N]) {
            #energy_body
        }
        #[inline(always)]
        fn slope(&self, #i: usize, #j: usize, #x: &N, #slope: &mut N, #scratch: &mut [N]) {
            #slope_body
        }
        #[inline(always)]
        fn slope_and_summand(
            &self,
            #i: usize,
            #j: usize,
            #x: &N,
            #slope: &mut N,
            #summand: &mut N,
            #scratch: &mut [N],
        ) {
            #summand_body
        }
    }
}

/// The method of blocks of pairs: a loop over the places of each.
fn in_blocks(definition: &Definition, programs: &PotentialPrograms) -> TokenStream {
    let [i, j, xs, scratch, lane, block] = ["i", "j", "xs", "scratch", "lane", "block"].map(own);
    let [width, forces, sum] = ["W", "FORCES", "SUM"].map(own);
    let in_lane =
        Methods { programs, names: definition.names(), arguments: values_in_lane(definition, [&i, &xs, &lane]) };
    let property_blocks = property_blocks(definition, [&j, &block]);
    let [slopes, summands] = ["slopes", "summands"].map(own);
    let both = [(slopes.clone(), own("slope")), (summands.clone(), own("summand"))];
    let of_energies = in_lane.energy_of_block(&lane, &[(summands.clone(), own("energy"))]);
    let of_slopes = in_lane.gradient_of_block(&lane, &both[..1]);
    let of_both = in_lane.gradient_and_rate_of_block(&lane, &both);
    quote! {
        #[inline(always)]
        fn of_blocks<const #width: usize, const #forces: bool, const #sum: bool>(
            &self,
            [#i, #j]: [usize; 2],
            #xs: &[[N; #width]],
            #slopes: &mut [[N; #width]],
            #summands: &mut [[N; #width]],
            #scratch: &mut [N],
        ) {
            for #block in 0..#xs.len() {
                let (#xs, #slopes, #summands) = (&#xs[#block], &mut #slopes[#block], &mut #summands[#block]);
                #property_blocks
                if !#forces {
                    #of_energies
                } else if #sum {
                    #of_both
                } else {
                    #of_slopes
                }
            }
        }
    }
}

/// The slopes of a block in one loop, which takes them.
fn each(definition: &Definition, programs: &PotentialPrograms) -> TokenStream {
    let [i, j, xs, slopes, slope, scratch, lane] = ["i", "j", "xs", "slopes", "slope", "scratch", "lane"].map(own);
    let methods = Methods { programs, names: definition.names(), arguments: values_of_copies(definition, &lane) };
    let property_copies = property_copies(definition, [&i, &j]);
    let body = methods.each_gradient([&lane, &xs, &slopes, &slope], &definition.arguments[0]);
    quote! {
        #[inline(always)]
        fn each_slope<M>(
            &self,
            (#i, #j): (usize, usize),
            #xs: impl ::core::ops::Fn(usize) -> (N, M),
            mut #slopes: impl ::core::ops::FnMut(usize, N, M),
            #scratch: &mut [N],
        ) {
            #property_copies
            #body
        }
    }
}

/// The implementation of the second derivatives.
fn curvature(definition: &Definition, this: &TokenStream, programs: &PotentialPrograms) -> TokenStream {
    let x = &definition.arguments[0];
    let [i, j, slope, curvature, rate, scratch] = ["i", "j", "slope", "curvature", "rate", "scratch"].map(own);
    let methods = Methods { programs, names: definition.names(), arguments: property_values(definition, [&i, &j]) };
    let prepare = methods.prepare("prepare_curvature");
    let outputs = [quote! { #slope }, quote! { #curvature }, quote! { #rate }];
    let (body, rate_body) = (methods.gradient(&outputs[..2]), methods.gradient_and_rate(&outputs));
    let scratch_size = size(methods.scratch());
    quote! {
        #[allow(unused_variables, clippy::all)]
        impl<N: ::shadowstep::Number> ::shadowstep::systems::pairs::PairCurvature<N> for #this {
            fn curvature_scratch(&self) -> usize { #scratch_size }
            #prepare
            fn curvature(
                &self,
                #i: usize,
                #j: usize,
                #x: &N,
                #slope: &mut N,
                #curvature: &mut N,
                #scratch: &mut [N],
            ) {
                #body
            }
            fn curvature_and_rate(
                &self,
                #i: usize,
                #j: usize,
                #x: &N,
                [#slope, #curvature, #rate]: [&mut N; 3],
                #scratch: &mut [N],
            ) {
                #rate_body
            }
        }
    }
}

/// A property as the formula names it, `m_i` or `m_j`, with the list that it is from, and whether it is that of the
/// body i.
fn listed(definition: &Definition) -> impl Iterator<Item = (&Ident, Ident, bool)> {
    definition.properties.iter().map(|name| {
        let text = name.to_string();
        (name, format_ident!("{}", &text[..text.len() - 2], span = name.span()), text.ends_with("_i"))
    })
}

/// The properties of the bodies i and j.
fn property_values(definition: &Definition, [i, j]: [&Ident; 2]) -> TokenStream {
    let values = listed(definition).map(|(name, list, is_first)| {
        let index = if is_first { i } else { j };
        quote! { let #name = &self.#list[#index]; }
    });
    quote! { #(#values)* }
}

/// Those of a block of bodies, of which the first blocks begin at j.
fn property_blocks(definition: &Definition, [j, number]: [&Ident; 2]) -> TokenStream {
    let width = own("W");
    let blocks = listed(definition).enumerate().filter(|(_, (_, _, is_first))| !is_first).map(|(n, (_, list, _))| {
        let block = numbered("block", n);
        quote! {
            let #block: &[N; #width] =
                self.#list[#j + #number * #width..].first_chunk().expect("the block is within the bodies");
        }
    });
    quote! { #(#blocks)* }
}

/// Copies of the property of the body i and of those of a block from j on, to which nothing else refers.
fn property_copies(definition: &Definition, [i, j]: [&Ident; 2]) -> TokenStream {
    let copies = listed(definition).enumerate().map(|(n, (_, list, is_first))| {
        let copy = numbered("copy", n);
        if is_first {
            quote! { let #copy = N::clone(&self.#list[#i]); }
        } else {
            quote! {
                let #copy: [N; ::shadowstep::number::BLOCK] =
                    ::core::clone::Clone::clone(self.#list[#j..].first_chunk().expect("the block is within the bodies"));
            }
        }
    });
    quote! { #(#copies)* }
}

/// The property of the body i and of the one in a lane.
fn values_of_copies(definition: &Definition, lane: &Ident) -> TokenStream {
    let values = listed(definition).enumerate().map(|(n, (name, _, is_first))| {
        let copy = numbered("copy", n);
        let place = (!is_first).then(|| quote! { [#lane] });
        quote! { let #name = &#copy #place; }
    });
    quote! { #(#values)* }
}

/// The distance and the properties of the body i and of the one in a lane.
fn values_in_lane(definition: &Definition, [i, xs, lane]: [&Ident; 3]) -> TokenStream {
    let x = &definition.arguments[0];
    let values = listed(definition).enumerate().map(|(n, (name, list, is_first))| {
        if is_first {
            quote! { let #name = &self.#list[#i]; }
        } else {
            let block = numbered("block", n);
            quote! { let #name = &#block[#lane]; }
        }
    });
    quote! { let #x = &#xs[#lane]; #(#values)* }
}

/// What the formula is in, by the name of its only argument.
fn separation(definition: &Definition) -> syn::Result<Separation> {
    let Definition { function, arguments, .. } = definition;
    let named = |name: &Ident| Separation::named(&name.to_string());
    let message =
        "a pair's formula is in r2, the square of the distance, or on a line in d = q_j - q_i: `pair U(r2) = …`";
    match &arguments[..] {
        [argument] => named(argument).ok_or_else(|| syn::Error::new(argument.span(), message)),
        _ => Err(syn::Error::new(function.span(), message)),
    }
}

/// `m` for `m_i` and `m_j`.
fn properties(definition: &Definition) -> syn::Result<Vec<Ident>> {
    let mut found: Vec<Ident> = Vec::new();
    let parameters = definition.parameters();
    for name in &definition.properties {
        let text = name.to_string();
        let stem = text.strip_suffix("_i").or_else(|| text.strip_suffix("_j")).filter(|stem| !stem.is_empty());
        let Some(stem) = stem else {
            let message = "a property of the bodies i and j is called such as m_i, m_j";
            return Err(syn::Error::new(name.span(), message));
        };
        if parameters.iter().any(|parameter| parameter == stem) {
            let message =
                format!("`{stem}` is a parameter of all bodies in the braces, but `{text}` is that of one body");
            return Err(syn::Error::new(name.span(), message));
        }
        if !found.iter().any(|other| other == stem) {
            found.push(Ident::new(stem, name.span()));
        }
    }
    Ok(found)
}

/// The programs of the pair's energy and those of its second derivatives.
fn programs(definition: &Definition, separation: Separation) -> syn::Result<(PotentialPrograms, PotentialPrograms)> {
    let (mut graph, energy) = definition.graph(|graph, expression| {
        graph.build_pair(expression, separation.name(), &texts(&definition.properties), &definition.parameters())
    })?;
    Ok((graph.pair(energy, separation), graph.pair_curvature(energy, separation)))
}

fn documentation(definition: &Definition, separation: Separation, programs: &PotentialPrograms) -> Vec<String> {
    let (slope, rate) = match separation {
        Separation::Difference => ("U'(d)", "d U'(d) − 2U"),
        Separation::SquaredDistance => ("2U'(r²)", "2r²U'(r²) − 2U"),
    };
    let summand = match programs.summand {
        Summand::Rate => rate,
        Summand::Energy => "U, by which the sum over pairs has its rate,",
    };
    let parsed = definition.formula.parse();
    let parameters = definition.parameters();
    let symmetric = parsed.ok().and_then(|e| is_symmetric(&e, separation, &texts(&definition.properties), &parameters));
    let directed = " - It changes when the bodies are exchanged: i is the one with the smaller number.".to_owned();
    let mut lines = vec![
        String::new(),
        definition.equation(),
        String::new(),
        " The energy of a pair of bodies i < j; `shadowstep::systems::pairs::Pairs` sums it over all pairs, or over \
            neighbours."
            .to_owned(),
        String::new(),
        format!(" - A pair's {slope} costs {}.", programs.gradient.cost()),
        format!(" - {slope} and {summand} cost {}.", programs.gradient_and_rate.cost()),
    ];
    lines.extend((symmetric == Some(false)).then_some(directed));
    lines
}
