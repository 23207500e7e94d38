//! An instruction of a straight-line program → the statement that executes it, on numbers of every type.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};
use shadowstep_schemes::symbolic::decimal::to_text;
use shadowstep_schemes::symbolic::{Instruction, Place};

/// What the code calls the numbers of a formula.
pub(crate) struct Names {
    pub(crate) coordinates: Vec<TokenStream>,
    pub(crate) parameters: Vec<TokenStream>,
    pub(crate) properties: Vec<TokenStream>,
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

/// The statement of an instruction.
pub(crate) fn statement(instruction: &Instruction, names: &Names, outputs: &[TokenStream]) -> TokenStream {
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

/// A hygienic name: no name of the user is the same.
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
