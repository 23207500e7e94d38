"""Checks certificates of `shadowstep schemes prove NAME --to json`: python3 check.py FILE ...

A step is a product of exponentials of kicks K and drifts D, with weights that the certificate has. It has order n for every T(p) if, for every
Lyndon word in K and D of m <= n letters, the coefficient of the word in the product is 1/m!. This program makes the words and computes the coefficients
with fractions only, or, where that is the same, with whole multiples of one. Weights are polynomials in roots x1, x2, ..., x_i^k = r_i, and a condition has to hold modulo these equations: then it holds for
the roots themselves. For decimals it has to hold to within the bound that is stated; with an enclosure, there is one solution within a radius of them.
"""

import json
import sys
from fractions import Fraction
from math import factorial, lcm


def add(a, b):
    """The sum of two polynomials: dictionaries of exponents and coefficients that are not 0."""
    total = {exponents: a.get(exponents, 0) + b.get(exponents, 0) for exponents in {**a, **b}}
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
        self.one = {(0,) * self.count: 1}

    def reduced(self, a):
        """The same number with powers of x_i below k_i."""
        for place in reversed(range(self.count)):
            power, of = self.roots[place]
            while high := [e for e in a if e[place] >= power]:
                value, lower = a[high[0]], tuple(n - power * (i == place) for i, n in enumerate(high[0]))
                a = add(a, {high[0]: -value})
                a = add(a, {tuple(map(sum, zip(lower, f))): value * factor for f, factor in of.items()})
        return a

    def product(self, a, b):
        total = {}
        for e, x in a.items():
            total = add(total, {tuple(map(sum, zip(e, f))): x * y for f, y in b.items()})
        return self.reduced(total)


def lyndon_words(longest):
    """The words that are less than all their proper ends (Duval)."""
    words, word = [], "K"
    while word:
        words.append(word)
        word = "".join(word[i % len(word)] for i in range(longest)).rstrip("D")
        word = word and word[:-1] + "D"
    return words


def scaled(maps, ring, order):
    """The maps with whole numbers in place of fractions, and their scale: a word of m letters has its coefficient times scale^m."""
    if any(value.denominator != 1 for _, of in ring.roots for value in of.values()):
        return maps, 1
    ring.roots = [(power, {e: int(value) for e, value in of.items()}) for power, of in ring.roots]
    scale = lcm(*(value.denominator for _, weight in maps for value in weight.values())) * factorial(order)
    return [(letter, {e: int(value * scale) for e, value in weight.items()}) for letter, weight in maps], scale


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
                n = factorial(taken)  # whole numbers are multiples of it
                share = {e: value / n if isinstance(value, Fraction) else value // n for e, value in powers[taken].items()}
                total = add(total, ring.product(share, values[word[: len(word) - taken]]))
            values[word] = total
    return values


UNIT = 1 << 200  # intervals are pairs of whole multiples of 1/UNIT


def times(a, b):
    ends = [x * y for x in a for y in b]
    return (min(ends) // UNIT, -(-max(ends) // UNIT))


class Number:
    """An interval with intervals of its derivatives."""
    def __init__(self, value, slopes):
        self.value, self.slopes = value, slopes

    def __mul__(self, other):
        left, right = [[times(x, by.value) for x in a.slopes] for a, by in ((self, other), (other, self))]
        return Number(times(self.value, other.value), [tuple(map(sum, zip(x, y))) for x, y in zip(left, right)])

    def __add__(self, other):
        both = zip([self.value] + self.slopes, [other.value] + other.slopes)
        value, *slopes = [tuple(map(sum, zip(x, y))) for x, y in both]
        return Number(value, slopes)

    def __truediv__(self, n):
        value, *slopes = [(low // n, -(-high // n)) for low, high in [self.value] + self.slopes]
        return Number(value, slopes)


def odd_words(highest):
    """Lyndon words in the letters 1, 3, 5, ... whose sum is odd, 3 at least, by their sums."""

    def grow(word, left):
        yield word
        for letter in range(1, left + 1, 2):
            yield from grow(word + (letter,), left - letter)

    odd = [word for word in grow((), highest) if sum(word) % 2 == 1 and word != (1,)]
    return sorted([word for word in odd if all(word < word[i:] for i in range(1, len(word)))], key=sum)


def error_terms(words, steps, one, zero):
    """The coefficients of words in the product of exp(g Y1 + g^3 Y3 + ...) over the steps g."""
    values = {word[:length]: zero for word in words for length in range(1, len(word) + 1)}
    values[()] = one
    for step in steps:
        powers = [one]
        while len(powers) <= max(map(sum, words)):
            powers.append(powers[-1] * step)
        for word in sorted(values, key=len, reverse=True):
            for taken in range(1, len(word) + 1):
                power = powers[sum(word[-taken:])] / factorial(taken)
                values[word] = values[word] + power * values[word[: len(word) - taken]]
    return [values[word] for word in words]


def check_enclosure(enclosure, maps, order):
    """One solution is in the box (Krawczyk): |Y F(u)| + |1 - Y F'(X)| r < r in every row."""
    half, solved = [Fraction(g) for g in enclosure["half"]], enclosure["solved"]
    radius, inverse = Fraction(enclosure["radius"]), [[*map(Fraction, row)] for row in enclosure["inverse"]]
    gamma = half + [1 - 2 * sum(half)] + half[::-1]
    steps = [(a + b) / 2 if half_way else b for a, b in zip([0] + gamma, gamma + [0]) for half_way in (True, False)][:-1]
    assert [weight.get((), 0) for _, weight in maps] == steps, "the half is not that of the maps"
    words, count = odd_words(order - 1), len(solved)
    assert radius > 0 and order % 2 == 0 and sorted({*solved} & {*range(len(half))}) == solved, "the box"
    assert len(words) == count == len(inverse) and all(len(row) == count for row in inverse), "a square matrix"

    def number(value, moves, by):
        """A weight in the box, whose derivative by each solved weight is 0 or `by`."""
        radius_of = 2 * count * radius if moves else 0
        ends = ((value - radius_of) * UNIT // 1, -(-(value + radius_of) * UNIT // 1))
        return Number(ends, [(factor * UNIT, factor * UNIT) for factor in by])

    weights = [number(g, i in solved, [int(i == j) for j in solved]) for i, g in enumerate(half)]
    middle = number(1 - 2 * sum(half), True, [-2] * count)
    one, zero = number(1, False, [0] * count), number(0, False, [0] * count)
    at_u = error_terms(words, gamma, Fraction(1), Fraction(0))
    in_box = [value.slopes for value in error_terms(words, weights + [middle] + weights[::-1], one, zero)]
    for i, row in enumerate(inverse):
        residual = abs(sum(y * value for y, value in zip(row, at_u)))
        spread = 0
        for j in range(count):
            ends = [sorted(y * Fraction(end, UNIT) for end in slopes[j]) for y, slopes in zip(row, in_box)]
            spread += max(abs((i == j) - sum(column)) for column in zip(*ends))
        assert residual + spread * radius < radius, "the box need not have a solution"


def check(certificate):
    """The number of conditions that hold, all of them; anything else is an error."""
    ring, letters = Ring(certificate["roots"]), {"kick": "K", "drift": "D"}
    maps = [(letters[m["map"]], ring.reduced(polynomial(m["weight"], ring.count))) for m in certificate["maps"]]
    order, bound = certificate["order"], Fraction(certificate["bound"])
    assert bound == 0 or certificate["kind"] == "decimal", "only decimals may be off"
    assert 0 <= bound < Fraction(1, 1000 * factorial(order)), "a bound that decides"
    assert order >= 1 and (ring.count == 0) == (certificate["kind"] != "algebraic"), "roots are for algebraic numbers"
    words = lyndon_words(order)
    in_scale, scale = scaled(maps, ring, order)
    values = coefficients(words, in_scale, ring)
    for word in words:
        exact = Fraction(scale ** len(word), factorial(len(word)))
        off = add(values[word], {e: -exact for e in ring.one})
        if bound == 0:
            assert off == {}, f"the word {word} is off"
        else:
            assert abs(off.get((), 0)) <= bound * scale ** len(word), f"the word {word} is off by more than the bound"
    if certificate.get("enclosure"):
        check_enclosure(certificate["enclosure"], maps, order)
    return len(words)


if __name__ == "__main__":
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as file:
            certificate = json.load(file)
        try:
            count = check(certificate)
        except (AssertionError, KeyError, TypeError, ValueError) as error:
            sys.exit(f"{path}: not proved: {error}")
        facts = f"order {certificate['order']}, {certificate['kind']}, {count} conditions"
        print(f"{certificate['scheme']}: {facts}{', one solution enclosed' * bool(certificate.get('enclosure'))}")
