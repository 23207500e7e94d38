//! The programs of an energy → the code that computes it and its derivatives, inside the methods of a trait.

use proc_macro2::{Ident, TokenStream};
use quote::quote;
use shadowstep_symbolic::{PotentialPrograms, Program};

use crate::program::{Names, numbered, own, size, statement};

/// The bodies of the methods that compute U, U_q and qᵀU_q − 2U (or T, T_p and pᵀT_p − 2T).
pub(crate) struct Methods<'a> {
    pub(crate) programs: &'a PotentialPrograms,
    pub(crate) names: Names,
    /// The statements with which each body begins: they name the arguments of the formula.
    pub(crate) arguments: TokenStream,
}

impl Methods<'_> {
    /// How many scratch places the methods need: the constants that are kept, then the intermediate results.
    pub(crate) fn scratch(&self) -> usize {
        self.programs.kept() + self.programs.scratch()
    }

    /// The method `prepare`, which computes what each program keeps, one after the other from the beginning of the
    /// scratch space; nothing, where nothing is kept.
    pub(crate) fn prepare(&self) -> Option<TokenStream> {
        let PotentialPrograms { energy, gradient_and_rate, .. } = self.programs;
        let mut before = 0;
        let mut parts = Vec::new();
        for program in [energy, gradient_and_rate].into_iter().filter(|program| program.kept > 0) {
            parts.push(self.constants(program, before));
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

    /// Computes a program's constants and keeps them in the scratch space, behind those of the programs before it.
    fn constants(&self, program: &Program, before: usize) -> TokenStream {
        let constants: Vec<_> = (0..program.constants).map(|i| numbered("constant", i)).collect();
        let (count, kept) = (size(program.constants), size(program.kept));
        let (from, to) = (size(before), size(before + program.kept));
        let instructions = program.prepare.iter().map(|instruction| statement(instruction, &self.names, &[]));
        quote! {
            let mut constants: [N; #count] = ::core::array::from_fn(|_| N::zero(context));
            let [#(#constants),*] = &mut constants;
            #(#instructions)*
            for (kept, constant) in scratch[#from..#to].iter_mut().zip(&constants[..#kept]) {
                kept.assign(constant);
            }
        }
    }

    /// U into `output`.
    pub(crate) fn energy(&self, output: &Ident) -> TokenStream {
        self.body(&self.programs.energy, 0, &[quote! { #output }])
    }

    /// U_q into `outputs`.
    pub(crate) fn gradient(&self, outputs: &[TokenStream]) -> TokenStream {
        self.body(&self.programs.gradient, self.programs.energy.kept, outputs)
    }

    /// U_q into `outputs`, qᵀU_q − 2U into the last of them.
    pub(crate) fn gradient_and_rate(&self, outputs: &[TokenStream]) -> TokenStream {
        self.body(&self.programs.gradient_and_rate, self.programs.energy.kept, outputs)
    }

    /// A program, whose constants begin at `kept_before` in the scratch space.
    fn body(&self, program: &Program, kept_before: usize, outputs: &[TokenStream]) -> TokenStream {
        let arguments = &self.arguments;
        let scratch = scratch_names(program, kept_before, self.programs.kept());
        let statements = program.instructions.iter().map(|i| statement(i, &self.names, outputs));
        quote! { #arguments #scratch #(#statements)* }
    }
}

/// Names the numbers in the scratch space: `kept` constants, of which this program's begin at `kept_before`, then its
/// intermediate results; nothing, where it needs none.
fn scratch_names(program: &Program, kept_before: usize, kept: usize) -> Option<TokenStream> {
    let before = (0..kept_before).map(|_| quote! { _ });
    let constants = (0..program.kept).map(|i| numbered("constant", i));
    let after = (kept_before + program.kept..kept).map(|_| quote! { _ });
    let intermediate: Vec<_> = (0..program.scratch).map(|i| numbered("scratch", i)).collect();
    let places = before.chain(constants).chain(after).chain(intermediate.iter().cloned());
    let scratch = own("scratch");
    // small numbers are copied, so that no intermediate result is stored
    let registers = (!intermediate.is_empty()).then(|| {
        quote! { let [#(mut #intermediate),*] = [#(#intermediate),*].map(N::register); }
    });
    (program.kept + program.scratch > 0).then(|| {
        quote! {
            let [#(#places,)* ..] = #scratch else { ::core::unreachable!("as much as asked for") };
            #registers
        }
    })
}

#[cfg(test)]
pub(crate) mod tests {
    use proc_macro2::TokenStream;

    use crate::definition::Definition;

    /// The formatted code that `emit` writes for what the user writes.
    pub(crate) fn code(emit: fn(&Definition) -> syn::Result<TokenStream>, text: &str) -> String {
        let code = emit(&syn::parse_str(text).unwrap()).unwrap();
        prettyplease::unparse(&syn::parse2(code).expect("generated code is Rust"))
    }
}
