//! `/// … pub struct Well { depth, width } U(x, y) = …`: a struct with parameters, and a function by its formula.

use proc_macro2::{Ident, TokenStream};
use quote::quote;
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Attribute, Token, Visibility, braced, parenthesized};

use crate::formula::Formula;
use crate::program::Names;

/// What the user writes.
pub(crate) struct Definition {
    attributes: Vec<Attribute>,
    visibility: Visibility,
    name: Ident,
    parameters: Vec<Ident>,
    /// U or T.
    pub(crate) function: Ident,
    pub(crate) arguments: Vec<Ident>,
    pub(crate) formula: Formula,
}

impl Parse for Definition {
    fn parse(input: ParseStream<'_>) -> syn::Result<Definition> {
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
        let names;
        parenthesized!(names in input);
        let arguments: Vec<Ident> = Punctuated::<Ident, Token![,]>::parse_terminated(&names)?.into_iter().collect();
        refuse_repeated(arguments.iter().chain(&parameters))?;
        let equals = input.parse::<Token![=]>()?;
        let formula = Formula::new(input.parse()?, equals.span);
        Ok(Definition { attributes, visibility, name, parameters, function, arguments, formula })
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

pub(crate) fn texts(names: &[Ident]) -> Vec<String> {
    names.iter().map(Ident::to_string).collect()
}

impl Definition {
    /// The struct with this documentation behind the user's, and its type.
    pub(crate) fn structure(&self, documentation: &[String]) -> (TokenStream, TokenStream) {
        let Definition { attributes, visibility, name, parameters, .. } = self;
        let head = quote! { #(#attributes)* #(#[doc = #documentation])* };
        if parameters.is_empty() {
            let structure = quote! { #head #[derive(Clone, Copy, Debug, Default)] #visibility struct #name; };
            return (structure, quote! { #name });
        }
        let fields = parameters.iter().map(|p| {
            let doc = format!(" The parameter {p} of the formula.");
            quote! { #[doc = #doc] pub #p: N }
        });
        let structure = quote! { #head #[derive(Clone, Debug)] #visibility struct #name<N> { #(#fields),* } };
        (structure, quote! { #name<N> })
    }

    /// The names of the parameters, as formulas have them.
    pub(crate) fn parameters(&self) -> Vec<String> {
        texts(&self.parameters)
    }

    /// The arguments are called as the user calls them.
    pub(crate) fn names(&self) -> Names {
        Names {
            coordinates: self.arguments.iter().map(|name| quote! { #name }).collect(),
            parameters: self.parameters.iter().map(|name| quote! { &self.#name }).collect(),
        }
    }

    /// ` U(x, y) = -1/sqrt(x^2 + y^2)`, for the documentation.
    pub(crate) fn equation(&self) -> String {
        format!(" {}({}) = {}", self.function, texts(&self.arguments).join(", "), self.formula.text())
    }
}
