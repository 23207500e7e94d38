"""Reads the Lean of `shadowstep schemes prove NAME --to lean` without Lean: python3 read_lean.py NAME.lean NAME.json ...

The definitions and theorems are parsed and evaluated with fractions. A rational condition has to hold. Of one in roots, value - needed has to be the sum
of the factors in `linear_combination` times their hypotheses: two polynomials that are compared at random points of 40 digits. Formulas are compared, at
random weights, with the coefficients that check.py computes, and the weights with those of the JSON certificate. Lean itself is not replaced: its
syntax is not checked.
"""

import json
import random
import re
import sys
from fractions import Fraction
from math import factorial, prod

from check import exponential, in_product, polynomial
from classes import lyndon_words

LETTERS = {"kick": "K", "drift": "D"}


def value(term, known):
    """A term of numbers, names and + - * / ^, where `a1 x` is the weight a1."""
    term = re.sub(r"\b([ab]\d+)((?: x\d*)*)", r"\1", " ".join(term.split()))
    assert re.fullmatch(r"[\w +*/^()-]+", term), term
    term = re.sub(r"\b(\d+)\b", r"Fraction(\1)", term).replace("^", "**")
    return eval(term, {"Fraction": Fraction}, known)  # the characters are those of arithmetic


def read(path, certificate):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    definitions = dict(re.findall(r"^def (\w+)[^:]*(?:: ℝ\) )?: [ℚℝ] :=\s(.*?)\n\n", text, re.M | re.S))
    order = certificate["order"]
    head = text[: text.index("-/")]
    maps = re.findall(r"exp\(h (\w+) ([KD])\)", " ".join(head.split()))
    assert [LETTERS[m["map"]] for m in certificate["maps"]] == [letter for _, letter in maps], "the maps"
    words = lyndon_words(order)

    names = [name for name, _ in maps]
    some = {name: Fraction(random.randrange(1, 10**6), 10**3) for name in names}
    factors = [exponential(some[name], {letter: 1}, order, Fraction(1)) for name, letter in maps]
    for word, expected in zip(words, in_product(words, factors, Fraction(1), Fraction(0))):
        assert value(definitions[f"coefficient_{word}"], some) == expected, f"the formula of {word}"

    count = len(certificate["roots"])
    roots = ["x"] if count == 1 else [f"x{i + 1}" for i in range(count)]
    proofs = {
        word: (hypotheses, needed, " ".join(proof.split()))
        for word, hypotheses, needed, proof in re.findall(
            r"^theorem condition_(\w+)((?: *\n? *\([^:]+:[^)]+\))*) : coefficient_\1[ x\d]* = (\S+) := by\n(.*?)\n\n", text, re.M | re.S
        )
    }
    assert sorted(proofs) == sorted(words), "a theorem for each word"
    last = text[text.index("theorem order_") :]
    for _ in range(3):
        at = {root: Fraction(random.randrange(10**40)) for root in roots}
        weights = {name: value(definitions[name], at) for name in names}
        for name, m in zip(names, certificate["maps"]):
            terms = polynomial(m["weight"], count).items()
            total = sum(number * prod(at[root] ** e for root, e in zip(roots, exponents)) for exponents, number in terms)
            assert weights[name] == total, f"the weight {name}"
        for word, (hypotheses, needed, proof) in proofs.items():
            assert Fraction(needed) == Fraction(1, factorial(len(word))), f"what is needed of {word}"
            assert re.search(rf"coefficient_{word}[ x\d]* = {needed}\b", last) and f"condition_{word}" in last, f"{word} in the order"
            off = value(definitions[f"coefficient_{word}"], weights) - Fraction(needed)
            equations = re.findall(r"\(h(x\d*) : ([^=]+) = ([^)]+)\)", hypotheses)
            factors = dict((root, factor) for factor, root in re.findall(r"\(([^()]*)\) \* h(x\d*)", proof))
            assert set(factors) == {root for root, _, _ in equations}, f"the hypotheses of {word}"
            total = sum(value(factors[root], at) * (value(left, at) - value(right, at)) for root, left, right in equations)
            assert off == total, f"the condition of {word}"
    print(f"{certificate['scheme']}: {len(words)} theorems")


if __name__ == "__main__":
    if not __debug__:
        sys.exit("not proved: without assertions nothing is checked: run python3 without -O")
    for lean, certificate in zip(sys.argv[1::2], sys.argv[2::2]):
        with open(certificate, encoding="utf-8") as file:
            try:
                read(lean, json.load(file))
            except (AssertionError, KeyError, SyntaxError, NameError, TypeError) as error:
                sys.exit(f"{lean}: not what it says: {error}")
