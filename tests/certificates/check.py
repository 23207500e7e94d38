"""Checks certificates of `shadowstep schemes prove NAME --to json`: python3 check.py FILE ...

A step is a product of exponentials of kicks K and drifts D, with weights that the certificate has. It has order n for every T(p) if, for every
Lyndon word in K and D of m <= n letters, the coefficient of the word in the product is 1/m!. This program makes the words and computes the coefficients
with fractions only. Weights are polynomials in roots x1, x2, ..., x_i^k = r_i, and a condition has to hold modulo these equations: then it holds for
the roots themselves. For decimals it has to hold to within the bound that is stated.
"""

import json
import sys
from fractions import Fraction
from math import factorial


def add(a, b):
    """The sum of two polynomials: dictionaries of exponents and coefficients that are not 0."""
    total = dict(a)
    for exponents, value in b.items():
        total[exponents] = total.get(exponents, 0) + value
    return {exponents: value for exponents, value in total.items() if value}


def polynomial(terms, count):
    """Terms [coefficient, exponents] as a polynomial in this number of roots."""
    total = {}
    for coefficient, exponents in terms:
        assert len(exponents) <= count and all(isinstance(e, int) and e >= 0 for e in exponents), "exponents"
        total = add(total, {tuple(exponents) + (0,) * (count - len(exponents)): Fraction(coefficient)})
    return total


class Ring:
    """Polynomials modulo x_i^k_i = r_i, where r_i has the roots before x_i only."""

    def __init__(self, roots):
        self.count = len(roots)
        self.roots = [(root["power"], polynomial(root["of"], self.count)) for root in roots]
        for place, (power, of) in enumerate(self.roots):
            assert power >= 2 and all(not any(e[place:]) for e in of), "a root of what comes before it"
        self.one = {(0,) * self.count: Fraction(1)}

    def reduced(self, a):
        """The same number with powers of x_i below k_i."""
        for place in reversed(range(self.count)):
            power, of = self.roots[place]
            while any(e[place] >= power for e in a):
                rest = {}
                for e, value in a.items():
                    if e[place] < power:
                        rest = add(rest, {e: value})
                        continue
                    lower = tuple(n - power if i == place else n for i, n in enumerate(e))
                    rest = add(rest, {tuple(map(sum, zip(lower, f))): value * factor for f, factor in of.items()})
                a = rest
        return a

    def product(self, a, b):
        total = {}
        for e, x in a.items():
            total = add(total, {tuple(map(sum, zip(e, f))): x * y for f, y in b.items()})
        return self.reduced(total)


def lyndon_words(longest):
    """The words that are less than all their proper ends (Duval)."""
    words, word = [], [-1]
    while word:
        word[-1] += 1
        words.append("".join("KD"[letter] for letter in word))
        word = [word[i % len(word)] for i in range(longest)]
        while word and word[-1] == 1:
            word.pop()
    return [word for word in words if word]


def coefficients(words, maps, ring):
    """The coefficients of the words and of all their beginnings in the product of the exponentials of the maps."""
    values = {word[:length]: {} for word in words for length in range(1, len(word) + 1)}
    values[""] = ring.one
    for letter, weight in maps:
        powers = [ring.one]
        for word in sorted(values, key=len, reverse=True):
            total, taken = values[word], 0
            while word[: len(word) - taken].endswith(letter):
                taken += 1
                if taken == len(powers):
                    powers.append(ring.product(powers[-1], weight))
                share = {e: value / factorial(taken) for e, value in powers[taken].items()}
                total = add(total, ring.product(share, values[word[: len(word) - taken]]))
            values[word] = total
    return values


def check(certificate):
    """The number of conditions that hold, all of them; anything else is an error."""
    ring = Ring(certificate["roots"])
    letters = {"kick": "K", "drift": "D"}
    maps = [(letters[m["map"]], ring.reduced(polynomial(m["weight"], ring.count))) for m in certificate["maps"]]
    order, bound = certificate["order"], Fraction(certificate["bound"])
    assert certificate["kind"] in ("exact", "algebraic", "decimal"), "the kind"
    assert bound == 0 or certificate["kind"] == "decimal", "only decimals may be off"
    assert 0 <= bound < Fraction(1, 1000 * factorial(order)), "a bound that decides"
    assert order >= 1 and (ring.count == 0) == (certificate["kind"] != "algebraic"), "roots are for algebraic numbers"
    words = lyndon_words(order)
    values = coefficients(words, maps, ring)
    for word in words:
        off = add(values[word], {e: -value / factorial(len(word)) for e, value in ring.one.items()})
        if bound == 0:
            assert off == {}, f"the word {word} is off"
        else:
            assert abs(off.get((), Fraction(0))) <= bound, f"the word {word} is off by more than the bound"
    return len(words)


if __name__ == "__main__":
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as file:
            certificate = json.load(file)
        try:
            count = check(certificate)
        except AssertionError as error:
            sys.exit(f"{path}: not proved: {error}")
        print(f"{certificate['scheme']}: order {certificate['order']}, {certificate['kind']}, {count} conditions")
