//! The programs of an energy → the code that computes it and its derivatives, inside the methods of a trait.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};
use shadowstep_schemes::symbolic::{Place, PotentialPrograms, Program};

use crate::program::{Names, numbered, own, size, statement};

/// The bodies of the methods that compute U, U_q and qᵀU_q − 2U (or T, T_p and pᵀT_p − 2T; of pairs a summand in place
/// of the last).
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

    /// The method `prepare`, or another name for it, which computes what each program keeps, one after the other from
    /// the beginning of the scratch space; nothing, where nothing is kept.
    pub(crate) fn prepare(&self, name: &str) -> Option<TokenStream> {
        let name = format_ident!("{name}");
        let PotentialPrograms { energy, gradient_and_rate, .. } = self.programs;
        let mut before = 0;
        let mut parts = Vec::new();
        for program in [energy, gradient_and_rate].into_iter().filter(|program| program.kept > 0) {
            parts.push(self.constants(program, before));
            before += program.kept;
        }
        (!parts.is_empty()).then(|| {
            quote! {
                fn #name(&self, scratch: &mut [N], context: &N::Context) {
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

    /// U_q into `outputs`, qᵀU_q − 2U, or a pair's summand, into the last of them.
    pub(crate) fn gradient_and_rate(&self, outputs: &[TokenStream]) -> TokenStream {
        self.body(&self.programs.gradient_and_rate, self.programs.energy.kept, outputs)
    }

    /// U of a block at once into `outputs`, one block for each: every instruction for all places of the block before
    /// the next one, so that each is an operation on vectors.
    pub(crate) fn energy_of_block(&self, lane: &Ident, outputs: &[(Ident, Ident)]) -> TokenStream {
        self.block_body(&self.programs.energy, 0, lane, outputs)
    }

    /// U_q, in the same form.
    pub(crate) fn gradient_of_block(&self, lane: &Ident, outputs: &[(Ident, Ident)]) -> TokenStream {
        self.block_body(&self.programs.gradient, self.programs.energy.kept, lane, outputs)
    }

    /// The same with qᵀU_q − 2U, or a pair's summand, into the last of them.
    pub(crate) fn gradient_and_rate_of_block(&self, lane: &Ident, outputs: &[(Ident, Ident)]) -> TokenStream {
        self.block_body(&self.programs.gradient_and_rate, self.programs.energy.kept, lane, outputs)
    }

    /// U_q at each place of a block in one loop: `argument` gives the argument and something more, which `take` gets
    /// with U_q.
    pub(crate) fn each_gradient(&self, [lane, argument, take, output]: [&Ident; 4], x: &Ident) -> TokenStream {
        let program = &self.programs.gradient;
        let constants = scratch_names(program, self.programs.energy.kept, self.programs.kept(), false);
        // to which nothing else refers
        let copies = (0..program.kept).map(|i| {
            let name = numbered("constant", i);
            quote! { let #name = &N::clone(#name); }
        });
        let scratch = (0..program.scratch).map(|i| {
            let name = numbered("scratch", i);
            quote! { let mut #name = N::clone(#x); }
        });
        let statements = program.instructions.iter().map(|i| statement(i, &self.names, &[quote! { #output }]));
        let (arguments, [of_lane, more, result]) = (&self.arguments, ["of_lane", "more", "result"].map(own));
        quote! {
            #constants
            #(#copies)*
            for #lane in 0..::shadowstep::number::BLOCK {
                let (#of_lane, #more) = #argument(#lane);
                let #x = &#of_lane;
                #arguments
                let mut #result = N::clone(#x);
                let #output = &mut #result;
                #(#scratch)*
                #(#statements)*
                #take(#lane, #result, #more);
            }
        }
    }

    /// A program, whose constants begin at `kept_before` in the scratch space.
    fn block_body(
        &self,
        program: &Program,
        kept_before: usize,
        lane: &Ident,
        outputs: &[(Ident, Ident)],
    ) -> TokenStream {
        let constants = scratch_names(program, kept_before, self.programs.kept(), false);
        let block = own("W");
        let own_xs = own("xs");
        let blocks = (0..program.scratch).map(|i| {
            let block_of = numbered("scratch_of_block", i);
            quote! { let mut #block_of: [N; #block] = ::core::clone::Clone::clone(#own_xs); }
        });
        let arguments = &self.arguments;
        let names: Vec<_> = outputs.iter().map(|(_, name)| quote! { #name }).collect();
        let statements = program.instructions.iter().map(|instruction| {
            let targets = instruction.targets();
            let places =
                targets.iter().map(|at| (*at, true)).chain(instruction.operands().into_iter().map(|at| (at, false)));
            let mut bound: Vec<Place> = Vec::new();
            let mut bindings = Vec::new();
            for (at, is_target) in places {
                if bound.contains(&at) {
                    continue;
                }
                bound.push(at);
                let mutable = is_target.then(|| quote! { mut });
                match at {
                    Place::Scratch(i) => {
                        let (name, of_block) = (numbered("scratch", i), numbered("scratch_of_block", i));
                        // a statement of two targets takes a reference to its name
                        let borrowed = (targets.len() > 1 && is_target).then(|| quote! { mut });
                        bindings.push(quote! { let #borrowed #name = & #mutable #of_block[#lane]; });
                    }
                    Place::Output(i) => {
                        let (of_block, name) = &outputs[i];
                        bindings.push(quote! { let #name = & #mutable #of_block[#lane]; });
                    }
                    _ => {}
                }
            }
            let statement = statement(instruction, &self.names, &names);
            quote! { for #lane in 0..#block { #arguments #(#bindings)* #statement } }
        });
        quote! {
            #constants
            #(#blocks)*
            #(#statements)*
        }
    }

    /// The same of one.
    fn body(&self, program: &Program, kept_before: usize, outputs: &[TokenStream]) -> TokenStream {
        let arguments = &self.arguments;
        let scratch = scratch_names(program, kept_before, self.programs.kept(), true);
        let statements = program.instructions.iter().map(|i| statement(i, &self.names, outputs));
        quote! { #arguments #scratch #(#statements)* }
    }
}

/// Names the numbers in the scratch space: `kept` constants, of which this program's begin at `kept_before`, then,
/// where they are wanted, its intermediate results; nothing, where it needs none.
fn scratch_names(program: &Program, kept_before: usize, kept: usize, intermediate: bool) -> Option<TokenStream> {
    let before = (0..kept_before).map(|_| quote! { _ });
    let constants = (0..program.kept).map(|i| numbered("constant", i));
    let after = (kept_before + program.kept..kept).map(|_| quote! { _ });
    let count = if intermediate { program.scratch } else { 0 };
    let intermediate: Vec<_> = (0..count).map(|i| numbered("scratch", i)).collect();
    let places = before.chain(constants).chain(after).chain(intermediate.iter().cloned());
    let scratch = own("scratch");
    // small numbers are copied, so that no intermediate result is stored
    let registers = (!intermediate.is_empty()).then(|| {
        quote! { #(let mut #intermediate = N::register(#intermediate);)* }
    });
    (program.kept + count > 0).then(|| {
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
