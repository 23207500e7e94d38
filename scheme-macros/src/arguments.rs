//! What the user writes: `("table.toml", first = "drift", parts = 3)` above a unit struct.

use shadowstep_schemes::First;
use syn::parse::{Parse, ParseStream};
use syn::{Data, DataStruct, DeriveInput, Fields, Ident, LitInt, LitStr, Token};

/// The arguments that may follow the table.
const KNOWN: &str = "`first = \"kick\"`, `first = \"drift\"` and `parts = 3`";

/// The table, the optional choice of the first map, and the number of parts of H.
pub(crate) struct Arguments {
    pub(crate) table: LitStr,
    pub(crate) first: Option<First>,
    pub(crate) parts: u32,
}

impl Parse for Arguments {
    fn parse(input: ParseStream<'_>) -> syn::Result<Arguments> {
        if !input.peek(LitStr) {
            return Err(input.error("name a table in quotes: #[splitting_scheme(\"yoshida4.toml\")]"));
        }
        let mut arguments = Arguments { table: input.parse()?, first: None, parts: 2 };
        let mut seen: Vec<Ident> = Vec::new();
        while input.parse::<Option<Token![,]>>()?.is_some() && !input.is_empty() {
            let key: Ident = input.parse()?;
            if seen.contains(&key) {
                return Err(syn::Error::new(key.span(), format!("`{key}` is there twice")));
            }
            input.parse::<Token![=]>()?;
            match key.to_string().as_str() {
                "first" => arguments.first = Some(first(&input.parse()?)?),
                "parts" => arguments.parts = parts(&input.parse()?)?,
                _ => {
                    let message = format!("unknown argument `{key}`: {KNOWN} are known");
                    return Err(syn::Error::new(key.span(), message));
                }
            }
            seen.push(key);
        }
        if !input.is_empty() {
            return Err(input.error(format!("only {KNOWN} may follow the table")));
        }
        Ok(arguments)
    }
}

fn first(value: &LitStr) -> syn::Result<First> {
    match value.value().as_str() {
        "kick" => Ok(First::Kick),
        "drift" => Ok(First::Drift),
        other => {
            Err(syn::Error::new(value.span(), format!("a step begins with \"kick\" or \"drift\", not \"{other}\"")))
        }
    }
}

/// A number of parts.
fn parts(value: &LitInt) -> syn::Result<u32> {
    match value.base10_parse::<u32>() {
        Ok(count @ 2..) => Ok(count),
        _ => Err(syn::Error::new(value.span(), "H has two parts at least")),
    }
}

/// A struct without fields and parameters.
pub(crate) struct UnitStruct(pub(crate) DeriveInput);

impl Parse for UnitStruct {
    fn parse(input: ParseStream<'_>) -> syn::Result<UnitStruct> {
        let wrong = "splitting_scheme stands above a unit struct: `pub struct Yoshida4;`";
        let item: DeriveInput = input.fork().parse().map_err(|_| input.error(wrong))?;
        let is_unit = matches!(item.data, Data::Struct(DataStruct { fields: Fields::Unit, .. }));
        if !is_unit || !item.generics.params.is_empty() {
            return Err(syn::Error::new_spanned(&item, wrong));
        }
        input.parse::<DeriveInput>()?;
        Ok(UnitStruct(item))
    }
}
