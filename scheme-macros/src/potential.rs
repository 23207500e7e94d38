//! `potential! { pub struct Kepler; U(x, y) = -1/sqrt(x^2 + y^2) }` → a potential with its gradient, for every number.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};
use shadowstep_symbolic::decimal::to_text;
use shadowstep_symbolic::{Graph, Instruction, Place, PotentialPrograms, Program};
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Attribute, Token, Visibility, braced, parenthesized};

use crate::formula::Formula;

/// What the user writes.
pub(crate) struct Potential {
    attributes: Vec<Attribute>,
    visibility: Visibility,
    name: Ident,
    parameters: Vec<Ident>,
    coordinates: Vec<Ident>,
    formula: Formula,
}

impl Parse for Potential {
    fn parse(input: ParseStream<'_>) -> syn::Result<Potential> {
        let attributes = input.call(Attribute::parse_outer)?;
        let visibility = input.parse()?;
        input.parse::<Token![struct]>()?;
        let name = input.parse()?;
        let parameters = if input.peek(syn::token::Brace) {
            let fields;
            braced!(fields in input);
            Punctuated::<Ident, Token![,]>::parse_terminated(&fields)?.into_iter().collect()
        } else {
            input.parse::<Token![;]>()?;
            Vec::new()
        };
        let function: Ident = input.parse()?;
        if function != "U" {
            return Err(syn::Error::new(function.span(), "the potential is called U: `U(x, y) = …`"));
        }
        let names;
        parenthesized!(names in input);
        let coordinates: Vec<Ident> = Punctuated::<Ident, Token![,]>::parse_terminated(&names)?.into_iter().collect();
        if coordinates.is_empty() {
            return Err(syn::Error::new(function.span(), "a potential has at least one coordinate: `U(q) = …`"));
        }
        refuse_repeated(coordinates.iter().chain(&parameters))?;
        let equals = input.parse::<Token![=]>()?;
        let formula = Formula::new(input.parse()?, equals.span);
        Ok(Potential { attributes, visibility, name, parameters, coordinates, formula })
    }
}

fn refuse_repeated<'a>(names: impl Iterator<Item = &'a Ident>) -> syn::Result<()> {
    let mut seen = Vec::new();
    for name in names {
        if seen.contains(&name) {
            return Err(syn::Error::new(name.span(), format!("`{name}` is there twice; names must differ")));
        }
        seen.push(name);
    }
    Ok(())
}

fn programs(potential: &Potential) -> syn::Result<PotentialPrograms> {
    let expression = potential.formula.parse()?;
    let names = |idents: &[Ident]| idents.iter().map(Ident::to_string).collect::<Vec<_>>();
    let mut graph = Graph::new();
    let energy = graph
        .build(&expression, &names(&potential.coordinates), &names(&potential.parameters))
        .map_err(|e| potential.formula.error(&e.range, &e.fault))?;
    Ok(graph.potential(energy, potential.coordinates.len()))
}

/// The struct and its implementation.
///
/// # Errors
/// A formula that is none, at its tokens.
pub(crate) fn emit(potential: &Potential) -> syn::Result<TokenStream> {
    let programs = programs(potential)?;
    let Potential { attributes, visibility, name, parameters, .. } = potential;
    let docs = documentation(potential, &programs);
    let (structure, this) = if parameters.is_empty() {
        (quote! { #[derive(Clone, Copy, Debug, Default)] #visibility struct #name; }, quote! { #name })
    } else {
        let fields = parameters.iter().map(|p| {
            let doc = format!(" The parameter {p} of the formula.");
            quote! { #[doc = #doc] pub #p: N }
        });
        (quote! { #[derive(Clone, Debug)] #visibility struct #name<N> { #(#fields),* } }, quote! { #name<N> })
    };
    let (dimension, scratch) = (size(potential.coordinates.len()), size(programs.kept() + programs.scratch()));
    let prepare = prepare(potential, &programs);
    let kept_by_energy = programs.energy.kept;
    let body = |program, kept_before, outputs: &[TokenStream]| {
        function_body(potential, program, kept_before, programs.kept(), outputs)
    };
    // names of our own, whatever the coordinates are called
    let [q, energy, gradient, rate, scratch_space] = ["q", "energy", "gradient", "rate", "scratch"].map(own);
    let parts: Vec<_> = (0..potential.coordinates.len()).map(|i| quote_ident("gradient", i)).collect();
    let with_rate: Vec<_> = parts.iter().cloned().chain([quote! { #rate }]).collect();
    let energy_body = body(&programs.energy, 0, &[quote! { #energy }]);
    let gradient_body = body(&programs.gradient, kept_by_energy, &parts);
    let rate_body = body(&programs.gradient_and_rate, kept_by_energy, &with_rate);
    let components = quote! { let [#(#parts),*] = #gradient else { ::core::unreachable!("as many as coordinates") }; };
    Ok(quote! {
        #(#attributes)*
        #(#[doc = #docs])*
        #structure

        #[allow(unused_variables, clippy::all)]
        impl<N: ::shadowstep::Number> ::shadowstep::Potential<N> for #this {
            fn dimension(&self) -> usize { #dimension }
            fn scratch(&self) -> usize { #scratch }
            #prepare
            fn energy(&self, #q: &[N], #energy: &mut N, #scratch_space: &mut [N]) {
                #energy_body
            }
            #[inline]
            fn gradient(&self, #q: &[N], #gradient: &mut [N], #scratch_space: &mut [N]) {
                #components
                #gradient_body
            }
            #[inline]
            fn gradient_and_rate(
                &self,
                #q: &[N],
                #gradient: &mut [N],
                #rate: &mut N,
                #scratch_space: &mut [N],
            ) {
                #components
                #rate_body
            }
        }
    })
}

/// Computes what each program keeps.
fn prepare(potential: &Potential, programs: &PotentialPrograms) -> Option<TokenStream> {
    let mut before = 0;
    let mut parts = Vec::new();
    for program in [&programs.energy, &programs.gradient_and_rate].into_iter().filter(|program| program.kept > 0) {
        let names: Vec<_> = (0..program.constants).map(|i| quote_ident("constant", i)).collect();
        let (count, kept) = (size(program.constants), size(program.kept));
        let (from, to) = (size(before), size(before + program.kept));
        let place = |place: Place| place_name(potential, place, &[]);
        let instructions = program.prepare.iter().map(|instruction| statement(instruction, &place));
        parts.push(quote! {
            let mut constants: [N; #count] = ::core::array::from_fn(|_| N::zero(context));
            let [#(#names),*] = &mut constants;
            #(#instructions)*
            for (kept, constant) in scratch[#from..#to].iter_mut().zip(&constants[..#kept]) {
                kept.assign(constant);
            }
        });
        before += program.kept;
    }
    (!parts.is_empty()).then(|| {
        quote! {
            fn prepare(&self, scratch: &mut [N], context: &N::Context) {
                #({ #parts })*
            }
        }
    })
}

fn function_body(
    potential: &Potential,
    program: &Program,
    kept_before: usize,
    kept: usize,
    outputs: &[TokenStream],
) -> TokenStream {
    let coordinates = &potential.coordinates;
    let before = (0..kept_before).map(|_| quote! { _ });
    let constants = (0..program.kept).map(|i| quote_ident("constant", i));
    let after = (kept_before + program.kept..kept).map(|_| quote! { _ });
    let intermediate = (0..program.scratch).map(|i| quote_ident("scratch", i));
    let places = before.chain(constants).chain(after).chain(intermediate);
    let place = |place: Place| place_name(potential, place, outputs);
    let instructions = program.instructions.iter().map(|instruction| statement(instruction, &place));
    let [q, scratch] = ["q", "scratch"].map(own);
    let bind_scratch = (program.kept + program.scratch > 0).then(|| {
        quote! { let [#(#places,)* ..] = #scratch else { ::core::unreachable!("as much as asked for") }; }
    });
    quote! {
        let [#(#coordinates),*] = #q else { ::core::unreachable!("as many as coordinates") };
        #bind_scratch
        #(#instructions)*
    }
}

fn place_name(potential: &Potential, place: Place, outputs: &[TokenStream]) -> TokenStream {
    match place {
        Place::Coordinate(i) => {
            let name = &potential.coordinates[i];
            quote! { #name }
        }
        Place::Parameter(i) => {
            let name = &potential.parameters[i];
            quote! { &self.#name }
        }
        Place::Constant(i) => quote_ident("constant", i),
        Place::Scratch(i) => quote_ident("scratch", i),
        Place::Output(i) => outputs[i].clone(),
    }
}

fn statement(instruction: &Instruction, place: &dyn Fn(Place) -> TokenStream) -> TokenStream {
    let method = Ident::new(&instruction.method(), Span::mixed_site());
    let operands: Vec<_> = instruction.operands().into_iter().map(place).collect();
    let targets: Vec<_> = instruction.targets().into_iter().map(place).collect();
    let target = &targets[0];
    match instruction {
        Instruction::AssignRational(_, value) => {
            let text = to_text(value);
            quote! { *#target = N::from_rational(&::shadowstep::exact(#text).expect("an exact number"), context); }
        }
        Instruction::AssignRoot(_, _, order) => {
            let order = Literal::u32_unsuffixed(*order);
            quote! { #target.#method(#(#operands),*, #order); }
        }
        Instruction::MultiplyInteger(_, n) | Instruction::DivideInteger(_, n) => {
            let n = Literal::i32_unsuffixed(*n);
            quote! { #target.#method(#n); }
        }
        Instruction::AssignSinCos(..) => quote! { N::#method(#(#targets),*, #(#operands),*); },
        _ => quote! { #target.#method(#(#operands),*); },
    }
}

fn documentation(potential: &Potential, programs: &PotentialPrograms) -> Vec<String> {
    let names = potential.coordinates.iter().map(Ident::to_string).collect::<Vec<_>>().join(", ");
    vec![
        String::new(),
        format!(" U({names}) = {}", potential.formula.text()),
        String::new(),
        format!(" - The gradient costs {}.", programs.gradient.cost()),
        format!(" - The gradient with qᵀU_q − 2U costs {}.", programs.gradient_and_rate.cost()),
    ]
}

/// A name that no user's name can be taken for.
fn own(name: &str) -> Ident {
    Ident::new(name, Span::mixed_site())
}

fn quote_ident(name: &str, index: usize) -> TokenStream {
    let ident = format_ident!("{name}_{}", index + 1, span = Span::mixed_site());
    quote! { #ident }
}

fn size(count: usize) -> Literal {
    Literal::usize_unsuffixed(count)
}

#[cfg(test)]
mod tests {
    /// Each case: a name and what the user writes.
    const CASES: [(&str, &str); 6] = [
        ("kepler", "pub struct Kepler; U(x, y) = -1/sqrt(x^2 + y^2)"),
        ("pendulum", "pub struct Pendulum; U(q) = -cos(q)"),
        ("henon-heiles", "pub struct HenonHeiles; U(x, y) = (x^2 + y^2)/2 + x^2*y - y^3/3"),
        ("hill", "pub struct Hill; U(x, y) = exp(-(x^2 + y^2))"),
        ("well", "pub struct Well { depth, width } U(x, y) = -depth * exp(-(x^2 + y^2) / width^2)"),
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
