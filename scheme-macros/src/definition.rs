//! `/// … pub struct Well { depth, width } U(x, y) = …`: a struct with parameters, and a function by its formula.

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::{format_ident, quote};
use syn::parse::{Parse, ParseStream};
use syn::punctuated::Punctuated;
use syn::{Attribute, Token, Visibility, braced, parenthesized};

use shadowstep_schemes::symbolic::{Expression, Graph, Node, SemanticError};

use crate::formula::Formula;
use crate::program::Names;

/// What the user writes.
pub(crate) struct Definition {
    attributes: Vec<Attribute>,
    visibility: Visibility,
    name: Ident,
    parameters: Vec<Parameter>,
    /// `pair`, if it stands before the function.
    pub(crate) pair: Option<Ident>,
    /// U or T.
    pub(crate) function: Ident,
    pub(crate) arguments: Vec<Ident>,
    /// What stands behind a semicolon: `m_i`, `m_j`.
    pub(crate) properties: Vec<Ident>,
    pub(crate) formula: Formula,
    /// A parameter that is not in the formula.
    unused: Option<Ident>,
}

/// A parameter, with the documentation that the user gives it.
struct Parameter {
    documentation: Vec<Attribute>,
    name: Ident,
}

impl Parse for Parameter {
    fn parse(input: ParseStream<'_>) -> syn::Result<Parameter> {
        let parameter = Parameter { documentation: input.call(Attribute::parse_outer)?, name: input.parse()? };
        if input.peek(Token![:]) {
            return Err(
                input.error(format!("parameters have no types, which are added: write `{}` alone", parameter.name))
            );
        }
        Ok(parameter)
    }
}

impl Parse for Definition {
    fn parse(input: ParseStream<'_>) -> syn::Result<Definition> {
        let attributes = input.call(Attribute::parse_outer)?;
        let visibility = input.parse()?;
        input.parse::<Token![struct]>()?;
        let name: Ident = input.parse()?;
        if name == "N" {
            return Err(syn::Error::new(name.span(), "N is the type of numbers here; give the struct another name"));
        }
        let parameters = if input.peek(syn::token::Brace) {
            let fields;
            braced!(fields in input);
            Punctuated::<Parameter, Token![,]>::parse_terminated(&fields)?.into_iter().collect()
        } else if input.peek(Token![;]) {
            input.parse::<Token![;]>()?;
            Vec::new()
        } else {
            return Err(input.error("expected `;`, or parameters as in `{ depth, width }`: their type is added"));
        };
        let first: Ident = input.parse()?;
        let (pair, function) = if first == "pair" { (Some(first), input.parse()?) } else { (None, first) };
        let names;
        parenthesized!(names in input);
        let arguments = comma_separated(&names)?;
        let properties = if names.parse::<Option<Token![;]>>()?.is_some() { comma_separated(&names)? } else { vec![] };
        if !names.is_empty() {
            return Err(names.error("expected `,` or `)`"));
        }
        refuse_repeated(arguments.iter().chain(&properties).chain(parameters.iter().map(|p: &Parameter| &p.name)))?;
        let equals = input.parse::<Token![=]>()?;
        let tokens: TokenStream = input.parse()?;
        let unused = parameters.iter().map(|parameter| &parameter.name).find(|name| !has(&tokens, name)).cloned();
        let formula = Formula::new(tokens, equals.span);
        Ok(Definition {
            unused,
            attributes,
            visibility,
            name,
            parameters,
            pair,
            function,
            arguments,
            properties,
            formula,
        })
    }
}

/// Whether an attribute derives the trait of this name.
fn derives(attribute: &Attribute, name: &str) -> bool {
    let mut found = false;
    let _ = attribute.path().is_ident("derive")
        && attribute
            .parse_nested_meta(|meta| {
                found |= meta.path.segments.last().is_some_and(|last| last.ident == name);
                Ok(())
            })
            .is_ok();
    found
}

/// Names with commas between them, up to something else.
fn comma_separated(input: ParseStream<'_>) -> syn::Result<Vec<Ident>> {
    let mut names = Vec::new();
    while input.peek(syn::Ident) {
        names.push(input.parse()?);
        if input.parse::<Option<Token![,]>>()?.is_none() {
            break;
        }
    }
    Ok(names)
}

/// Whether a name is among these tokens.
fn has(tokens: &TokenStream, name: &Ident) -> bool {
    tokens.clone().into_iter().any(|token| match token {
        TokenTree::Ident(ident) => ident == *name,
        TokenTree::Group(group) => has(&group.stream(), name),
        TokenTree::Punct(_) | TokenTree::Literal(_) => false,
    })
}

fn refuse_repeated<'a>(names: impl Iterator<Item = &'a Ident>) -> syn::Result<()> {
    let mut seen = Vec::new();
    for name in names {
        let message = match name.to_string().as_str() {
            "pi" => Some("`pi` is a constant; give this another name"),
            raw if raw.starts_with("r#") => Some("formulas have no raw names; give this another name"),
            _ => None,
        };
        if let Some(message) = message {
            return Err(syn::Error::new(name.span(), message));
        }
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
    /// Refuses a parameter that is not in the formula. After other faults: a name that is unknown there may be meant
    /// for it.
    pub(crate) fn check_parameters(&self) -> syn::Result<()> {
        let Some(name) = &self.unused else { return Ok(()) };
        Err(syn::Error::new(name.span(), format!("`{name}` is not in the formula; remove the parameter, or use it")))
    }

    /// The struct with this documentation behind the user's, and its type. Beside the parameters it has for each of
    /// these properties the values of all bodies.
    pub(crate) fn structure(&self, documentation: &[String], properties: &[Ident]) -> (TokenStream, TokenStream) {
        let Definition { attributes, visibility, name, parameters, .. } = self;
        // what the user derives, too, is derived once
        let derived = |name: &str| attributes.iter().any(|attribute| derives(attribute, name));
        let own = |names: &[&str]| {
            let names = names.iter().filter(|name| !derived(name)).map(|name| format_ident!("{name}"));
            quote! { #[derive(#(#names),*)] }
        };
        let head = quote! { #(#attributes)* #(#[doc = #documentation])* };
        if parameters.is_empty() && properties.is_empty() {
            let own = own(&["Clone", "Copy", "Debug", "Default"]);
            let structure = quote! { #head #own #visibility struct #name; };
            return (structure, quote! { #name });
        }
        let fields = parameters.iter().map(|Parameter { documentation, name }| {
            let doc = format!(" The parameter {name} of the formula.");
            let doc = documentation.is_empty().then(|| quote! { #[doc = #doc] });
            quote! { #(#documentation)* #doc pub #name: N }
        });
        let lists = properties.iter().map(|p| {
            let doc = format!(" The {p} of each body.");
            quote! { #[doc = #doc] pub #p: ::std::vec::Vec<N> }
        });
        let own = own(&["Clone", "Debug"]);
        let structure = quote! { #head #own #visibility struct #name<N> { #(#fields,)* #(#lists),* } };
        (structure, quote! { #name<N> })
    }

    /// The graph of the formula, which `build` makes of its syntax tree.
    ///
    /// # Errors
    /// An invalid formula, at its tokens.
    pub(crate) fn graph(
        &self,
        build: impl FnOnce(&mut Graph, &Expression) -> Result<Node, SemanticError>,
    ) -> syn::Result<(Graph, Node)> {
        let mut graph = Graph::new();
        let expression = self.formula.parse()?;
        let energy = build(&mut graph, &expression).map_err(|e| self.formula.error(&e.range, &e.fault))?;
        Ok((graph, energy))
    }

    /// The graph of a formula in coordinates or momenta, of which there is at least one.
    ///
    /// # Errors
    /// No arguments, with the message `empty`; an invalid formula, at its tokens.
    pub(crate) fn graph_of_arguments(&self, empty: &str) -> syn::Result<(Graph, Node)> {
        if self.arguments.is_empty() {
            return Err(syn::Error::new(self.function.span(), empty));
        }
        self.graph(|graph, expression| graph.build(expression, &texts(&self.arguments), &self.parameters()))
    }

    /// The names of the parameters, as they are in formulas.
    pub(crate) fn parameters(&self) -> Vec<String> {
        self.parameters.iter().map(|parameter| parameter.name.to_string()).collect()
    }

    /// The arguments and properties are called as the user calls them.
    pub(crate) fn names(&self) -> Names {
        let as_written = |names: &[Ident]| names.iter().map(|name| quote! { #name }).collect();
        Names {
            coordinates: as_written(&self.arguments),
            parameters: self.parameters.iter().map(|Parameter { name, .. }| quote! { &self.#name }).collect(),
            properties: as_written(&self.properties),
        }
    }

    /// ` U(x, y) = -1/sqrt(x^2 + y^2)`, for the documentation.
    pub(crate) fn equation(&self) -> String {
        let pair = if self.pair.is_some() { "pair " } else { "" };
        let arguments = texts(&self.arguments).join(", ");
        let behind = if self.properties.is_empty() { "" } else { "; " };
        let properties = texts(&self.properties).join(", ");
        format!(" {pair}{}({arguments}{behind}{properties}) = {}", self.function, self.formula.text())
    }
}
