//! Tokens of a formula → its text, and the way back from places in the text to tokens.

use std::ops::Range;

use proc_macro2::{Delimiter, Spacing, Span, TokenStream, TokenTree};
use shadowstep_schemes::symbolic::{Expression, parse};

/// A formula's text with the span of each token.
pub(crate) struct Formula {
    text: String,
    tokens: Vec<(Range<usize>, Span)>,
    /// Where messages go that are about no token: an empty formula.
    whole: Span,
}

impl Formula {
    /// The text of the tokens.
    pub(crate) fn new(tokens: TokenStream, whole: Span) -> Formula {
        let mut formula = Formula { text: String::new(), tokens: Vec::new(), whole };
        formula.append(tokens);
        formula
    }

    /// The syntax tree.
    ///
    /// # Errors
    /// A syntax error at its token.
    pub(crate) fn parse(&self) -> syn::Result<Expression> {
        parse(&self.text).map_err(|e| self.error(&e.range, &e.message))
    }

    /// The text as documentation shows it.
    pub(crate) fn text(&self) -> &str {
        self.text.trim_end()
    }

    /// An error at the tokens of a range of the text.
    pub(crate) fn error(&self, range: &Range<usize>, message: impl std::fmt::Display) -> syn::Error {
        // an empty range, such as the end, is at the last token before it
        let meant = |place: &Range<usize>| place.start < range.end.max(range.start + 1) && range.start < place.end;
        let spans: Vec<Span> = self.tokens.iter().filter(|(place, _)| meant(place)).map(|(_, span)| *span).collect();
        let end = || self.tokens.last().map_or(self.whole, |(_, span)| *span);
        let first = spans.first().copied().unwrap_or_else(end);
        let span = spans.last().and_then(|last| first.join(*last)).unwrap_or(first);
        syn::Error::new(span, message)
    }

    fn append(&mut self, tokens: TokenStream) {
        for token in tokens {
            match token {
                TokenTree::Group(group) => {
                    let (open, close) = match group.delimiter() {
                        Delimiter::Parenthesis => ("(", ") "),
                        Delimiter::Bracket => ("[", "] "),
                        Delimiter::Brace => ("{", "} "),
                        Delimiter::None => ("", ""),
                    };
                    self.push(open, group.span_open());
                    self.append(group.stream());
                    self.text.truncate(self.text.trim_end().len());
                    self.push(close, group.span_close());
                }
                TokenTree::Punct(punct) if punct.spacing() == Spacing::Joint => {
                    self.push(&punct.to_string(), punct.span());
                }
                TokenTree::Punct(punct) if "+-".contains(punct.as_char()) && self.expects_a_term() => {
                    self.push(&punct.to_string(), punct.span());
                }
                // names stay at the parenthesis of their arguments, powers close together: as people write
                TokenTree::Punct(punct) if punct.as_char() == '^' => {
                    self.text.truncate(self.text.trim_end().len());
                    self.push("^", punct.span());
                }
                token => self.push(&format!("{token} "), token.span()),
            }
        }
    }

    fn push(&mut self, text: &str, span: Span) {
        if text.starts_with(',') || text.starts_with('(') && self.follows_a_name() {
            self.text.truncate(self.text.trim_end().len());
        }
        let start = self.text.len();
        self.text.push_str(text);
        self.tokens.push((start..start + text.trim_end().len(), span));
    }

    /// Whether a sign is that of a term, and no operation.
    fn expects_a_term(&self) -> bool {
        let before = self.text.trim_end().chars().next_back();
        before.is_none_or(|c| !(c.is_alphanumeric() || c == '_' || c == ')' || c == '.'))
    }

    fn follows_a_name(&self) -> bool {
        self.text.trim_end().ends_with(|c: char| c.is_alphanumeric() || c == '_')
    }
}
