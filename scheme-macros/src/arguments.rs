//! What the user writes: `("table.toml", first = "drift")` above a unit struct.

use shadowstep_schemes::First;
use syn::parse::{Parse, ParseStream};
use syn::{Fields, Ident, ItemStruct, LitStr, Token};

/// The table and the optional choice of the first map.
pub(crate) struct Arguments {
    pub(crate) table: LitStr,
    pub(crate) first: Option<First>,
}

impl Parse for Arguments {
    fn parse(input: ParseStream<'_>) -> syn::Result<Arguments> {
        if !input.peek(LitStr) {
            return Err(input.error("name a table in quotes: #[splitting_scheme(\"yoshida4.toml\")]"));
        }
        let table = input.parse()?;
        let mut first = None;
        if input.parse::<Option<Token![,]>>()?.is_some() && !input.is_empty() {
            first = Some(parse_first(input)?);
            input.parse::<Option<Token![,]>>()?;
        }
        if !input.is_empty() {
            return Err(input.error("only `first = \"kick\"` or `first = \"drift\"` may follow the table"));
        }
        Ok(Arguments { table, first })
    }
}

fn parse_first(input: ParseStream<'_>) -> syn::Result<First> {
    let key: Ident = input.parse()?;
    if key != "first" {
        let message = format!("unknown argument `{key}`: only `first = \"kick\"` or `first = \"drift\"` is known");
        return Err(syn::Error::new(key.span(), message));
    }
    input.parse::<Token![=]>()?;
    let value: LitStr = input.parse()?;
    match value.value().as_str() {
        "kick" => Ok(First::Kick),
        "drift" => Ok(First::Drift),
        other => {
            Err(syn::Error::new(value.span(), format!("a step begins with \"kick\" or \"drift\", not \"{other}\"")))
        }
    }
}

/// A struct without fields and parameters.
pub(crate) struct UnitStruct(pub(crate) ItemStruct);

impl Parse for UnitStruct {
    fn parse(input: ParseStream<'_>) -> syn::Result<UnitStruct> {
        let wrong = "splitting_scheme stands above a unit struct: `pub struct Yoshida4;`";
        let item: ItemStruct = input.fork().parse().map_err(|_| input.error(wrong))?;
        if !matches!(item.fields, Fields::Unit) || !item.generics.params.is_empty() {
            return Err(syn::Error::new_spanned(&item, wrong));
        }
        input.parse::<ItemStruct>()?;
        Ok(UnitStruct(item))
    }
}
