//! A straight-line program → the statements that carry it out, on numbers of every type.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};
use shadowstep_symbolic::decimal::to_text;
use shadowstep_symbolic::{Instruction, Place, Program};

/// What the code calls the numbers of a formula.
pub(crate) struct Names {
    pub(crate) coordinates: Vec<TokenStream>,
    pub(crate) parameters: Vec<TokenStream>,
    pub(crate) properties: Vec<TokenStream>,
}

/// The method `prepare`, which computes what each program keeps, one after the other from the beginning of the scratch
/// space; nothing, where nothing is kept.
pub(crate) fn prepare(programs: &[&Program], names: &Names) -> Option<TokenStream> {
    let mut before = 0;
    let mut parts = Vec::new();
    for program in programs.iter().filter(|program| program.kept > 0) {
        let constants: Vec<_> = (0..program.constants).map(|i| numbered("constant", i)).collect();
        let (count, kept) = (size(program.constants), size(program.kept));
        let (from, to) = (size(before), size(before + program.kept));
        let instructions = program.prepare.iter().map(|instruction| statement(instruction, names, &[]));
        parts.push(quote! {
            let mut constants: [N; #count] = ::core::array::from_fn(|_| N::zero(context));
            let [#(#constants),*] = &mut constants;
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

/// Names the numbers in the scratch space: `kept` constants, of which this program's begin at `kept_before`, then its
/// intermediate results; nothing, where it needs none.
pub(crate) fn scratch_names(program: &Program, kept_before: usize, kept: usize) -> Option<TokenStream> {
    let before = (0..kept_before).map(|_| quote! { _ });
    let constants = (0..program.kept).map(|i| numbered("constant", i));
    let after = (kept_before + program.kept..kept).map(|_| quote! { _ });
    let intermediate = (0..program.scratch).map(|i| numbered("scratch", i));
    let places = before.chain(constants).chain(after).chain(intermediate);
    let scratch = own("scratch");
    let registers: Vec<_> = (0..program.scratch).map(|i| numbered("scratch", i)).collect();
    // of small numbers copies, so that no intermediate result is stored
    let registers = (!registers.is_empty()).then(|| {
        quote! { let [#(mut #registers),*] = [#(#registers),*].map(N::register); }
    });
    (program.kept + program.scratch > 0).then(|| {
        quote! {
            let [#(#places,)* ..] = #scratch else { ::core::unreachable!("as much as asked for") };
            #registers
        }
    })
}

/// The program, a statement an instruction.
pub(crate) fn statements(program: &Program, names: &Names, outputs: &[TokenStream]) -> Vec<TokenStream> {
    program.instructions.iter().map(|instruction| statement(instruction, names, outputs)).collect()
}

fn place_name(place: Place, names: &Names, outputs: &[TokenStream]) -> TokenStream {
    match place {
        Place::Coordinate(i) => names.coordinates[i].clone(),
        Place::Parameter(i) => names.parameters[i].clone(),
        Place::Property(i) => names.properties[i].clone(),
        Place::Constant(i) => numbered("constant", i),
        Place::Scratch(i) => numbered("scratch", i),
        Place::Output(i) => outputs[i].clone(),
    }
}

fn statement(instruction: &Instruction, names: &Names, outputs: &[TokenStream]) -> TokenStream {
    let place = |place| place_name(place, names, outputs);
    let method = Ident::new(&instruction.method(), Span::mixed_site());
    let operand = |at: Place| match at {
        Place::Scratch(_) => {
            let name = place(at);
            quote! { &#name }
        }
        _ => place(at),
    };
    let operands: Vec<_> = instruction.operands().into_iter().map(operand).collect();
    let target = place(instruction.target());
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
        Instruction::AssignSinCos(sin, cos, _) => {
            let [sin, cos] = [*sin, *cos].map(|at| match at {
                Place::Scratch(_) => {
                    let name = place(at);
                    quote! { &mut #name }
                }
                _ => place(at),
            });
            quote! { N::#method(#sin, #cos, #(#operands),*); }
        }
        _ => quote! { #target.#method(#(#operands),*); },
    }
}

/// A name that no user's name can be taken for.
pub(crate) fn own(name: &str) -> Ident {
    Ident::new(name, Span::mixed_site())
}

/// Such a name with a number, from 1.
pub(crate) fn numbered(name: &str, index: usize) -> TokenStream {
    let ident = format_ident!("{name}_{}", index + 1, span = Span::mixed_site());
    quote! { #ident }
}

pub(crate) fn size(count: usize) -> Literal {
    Literal::usize_unsuffixed(count)
}
