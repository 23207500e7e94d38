"""Checks certificates of `shadowstep schemes prove NAME`: python3 check.py FILE ...

A step is a product of exponentials of kicks K and drifts D, with weights that the certificate has. It has order n for every T(p) if, for every
Lyndon word in K and D of m <= n letters, the coefficient of the word in the product is 1/m!. This program makes the words and computes the coefficients
with fractions only, or, where that is the same, with whole multiples of one. Weights are polynomials in roots x1, x2, ..., x_i^k = r_i, and a condition
has to hold modulo these equations: then it holds for the roots themselves. Decimals solve no condition: the order is that of the one scheme within a radius of
them, which the enclosure proves to exist, and without it nothing is proved. Conditions of smaller classes are not enclosed: they hold to within the bound only.
"""

import json
import sys
from fractions import Fraction
from math import factorial, lcm

from classes import lyndon_words, trees, word_conditions, words_of


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

    def reduced(self, a):
        """The same number with powers of x_i below k_i."""
        for place in reversed(range(self.count)):
            power, of = self.roots[place]
            while high := [e for e in a if e[place] >= power]:
                value, lower = a[high[0]], tuple(n - power * (i == place) for i, n in enumerate(high[0]))
                a = add(a, {high[0]: -value})
                a = add(a, {tuple(map(sum, zip(lower, f))): value * factor for f, factor in of.items()})
        return a


class Element:
    """A number of a ring."""

    def __init__(self, ring, terms):
        self.ring, self.terms = ring, ring.reduced(terms)

    def __mul__(self, other):
        total = {}
        for e, x in self.terms.items():
            total = add(total, {tuple(map(sum, zip(e, f))): x * y for f, y in other.terms.items()})
        return Element(self.ring, total)

    def __add__(self, other):
        return Element(self.ring, add(self.terms, other.terms))

    def __truediv__(self, n):  # whole numbers are multiples of n
        return Element(self.ring, {e: x / n if isinstance(x, Fraction) else x // n for e, x in self.terms.items()})


def scaled(maps, ring, order):
    """The maps with whole numbers in place of fractions, and their scale: a word of m letters has its coefficient times scale^m."""
    if any(value.denominator != 1 for _, of in ring.roots for value in of.values()):
        return maps, 1
    ring.roots = [(power, {e: int(value) for e, value in of.items()}) for power, of in ring.roots]
    scale = lcm(*(value.denominator for _, weight in maps for value in weight.values())) * factorial(order)
    return [(letter, {e: int(value * scale) for e, value in weight.items()}) for letter, weight in maps], scale


def exponential(weight, degrees, highest, one):
    """The coefficient of a word in exp(sum of weight^d Y_d), with the degrees d of the letters; none of a word with other letters."""
    powers = [one]
    while len(powers) <= highest:
        powers.append(powers[-1] * weight)
    known = lambda word: all(letter in degrees for letter in word)
    return lambda word: powers[sum(degrees[letter] for letter in word)] / factorial(len(word)) if known(word) else None


def in_product(words, factors, one, zero):
    """The coefficients of words in a product, from those of words in its factors."""
    values = {word[:length]: zero for word in words for length in range(1, len(word) + 1)}
    values[words[0][:0]] = one
    for factor in factors:
        for word in sorted(values, key=len, reverse=True):
            for taken in range(1, len(word) + 1):
                if (share := factor(word[-taken:])) is None:
                    break
                values[word] = values[word] + share * values[word[: len(word) - taken]]
    return [values[word] for word in words]


WIDEST = Fraction(1, 10**6)  # of a box: decimals are nearer to the scheme that they stand for
SLACK = 1000  # a radius is at most this many times what the decimals need, and a bound this many times the radius
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
    words = [()]
    for word in words:
        words += [word + (letter,) for letter in range(1, highest - sum(word) + 1, 2)]
    odd = [word for word in words if sum(word) % 2 == 1 and word != (1,)]
    return sorted([word for word in odd if all(word < word[i:] for i in range(1, len(word)))], key=lambda word: (sum(word), word))


def check_enclosure(enclosure, maps, order):
    """One solution is in the box (Krawczyk): |Y F(u)| + |1 - Y F'(X)| r < r in every row."""
    u, solved, of = [Fraction(weight) for weight in enclosure["weights"]], enclosure["solved"], enclosure["of"]
    radius, inverse = Fraction(enclosure["radius"]), [[*map(Fraction, row)] for row in enclosure["inverse"]]
    letters, middle, count = [letter for letter, _ in maps], 1 - 2 * sum(u), len(solved)
    if of == "composition":  # steps of a kick of half a step, a drift, a kick: even degrees hold by symmetry
        words, every = odd_words(order - 1), lambda half, middle: half + [middle] + half[::-1]
        gamma = every(u, middle)
        ends = zip([0] + gamma, gamma + [0])
        weights = [(a + b) / 2 if is_kick else b for a, b in ends for is_kick in (True, False)][:-1]
        of_letters, letters = [{d: d for d in range(1, order, 2)}] * len(gamma), ["KD"[i % 2] for i in range(len(weights))]
    else:  # of a palindrome of maps even degrees hold by symmetry
        is_half = {"palindrome": True, "maps": False}[of]
        words = sorted([word for word in lyndon_words(order) if len(word) % 2 or not is_half], key=len)
        every = lambda some, _: some + some[-2::-1] * is_half
        weights, of_letters = every(u, None), [{letter: 1} for letter in letters]
        assert not is_half or letters == letters[::-1], "a palindrome"
    assert [(letter, weight.get((), 0)) for letter, weight in maps] == [*zip(letters, weights)], "the weights are not those of the maps"
    assert radius > 0 and sorted({*solved} & {*range(len(u))}) == solved and (of == "maps" or order % 2 == 0), "the box"
    assert len(words) == count == len(inverse) and all(len(row) == count for row in inverse), "a square matrix"

    def number(value, moves, by):
        """A weight in the box, whose derivative by each solved weight is 0 or `by`."""
        radius_of = 2 * count * radius if moves else 0
        ends = ((value - radius_of) * UNIT // 1, -(-(value + radius_of) * UNIT // 1))
        return Number(ends, [(factor * UNIT, factor * UNIT) for factor in by])

    def values(all_weights, one, zero):
        return in_product(words, [exponential(w, d, order, one) for w, d in zip(all_weights, of_letters)], one, zero)

    box = [number(weight, i in solved, [int(i == j) for j in solved]) for i, weight in enumerate(u)]
    one, zero = (number(value, False, [0] * count) for value in (1, 0))
    in_box = [value.slopes for value in values(every(box, number(middle, True, [-2] * count)), one, zero)]
    needed = [Fraction(of != "composition", factorial(len(word))) for word in words]
    at_u = [value - need for value, need in zip(values(every(u, middle), Fraction(1), Fraction(0)), needed)]
    shifts = [[y * value for y, value in zip(row, at_u)] for row in inverse]
    needed = max(sum(map(abs, row)) for row in shifts) or 1
    assert radius <= min(WIDEST, SLACK * needed), "the box is wider than the decimals need"
    for i, (row, shift) in enumerate(zip(inverse, shifts)):
        residual, spread = abs(sum(shift)), 0
        for j in range(count):
            ends = [sorted(y * Fraction(end, UNIT) for end in slopes[j]) for y, slopes in zip(row, in_box)]
            spread += max(abs((i == j) - sum(column)) for column in zip(*ends))
        assert residual + spread * radius < radius, "the box need not have a solution"


def check_claim(claim, maps, ring, is_exact):
    """The number of conditions of a claim, all of which hold."""
    order, bound, unit = max(claim.get("orders", [claim.get("order")])), Fraction(claim["bound"]), (0,) * ring.count
    assert bound == 0 or not is_exact, "only decimals may be off"
    assert order >= 1 and 0 <= bound < Fraction(1, 1000 * factorial(order)), "a bound that decides"
    in_scale, scale = scaled(maps, ring, order)
    weights = [(letter, Element(ring, weight)) for letter, weight in in_scale]
    one, zero, words = Element(ring, {unit: 1}), Element(ring, {}), words_of(claim)
    factors = [exponential(weight, {letter: 1}, order, one) for letter, weight in weights]
    conditions = word_conditions(words, words and in_product(words, factors, one, zero)) or trees(weights, order, zero)
    for name, degree, needed, value in conditions:
        off = add(value.terms, {unit: -needed * scale**degree})
        assert bound or not off, f"{name} is off"
        assert not bound or abs(off.get((), 0)) <= bound * scale**degree, f"{name} is off by more than the bound"
    return len(conditions)


def check(certificate):
    """The number of conditions that hold, all of them; anything else is an error."""
    ring, letters, kind = Ring(certificate["roots"]), {"kick": "K", "drift": "D"}, certificate["kind"]
    maps = [(letters[m["map"]], ring.reduced(polynomial(m["weight"], ring.count))) for m in certificate["maps"]]
    assert (ring.count == 0) == (kind != "algebraic"), "roots are for algebraic numbers"
    assert certificate["for"] == "every T(p)", "the order for every T(p) first"
    count = sum(check_claim(claim, maps, ring, kind != "decimal") for claim in [certificate, *certificate["also"]])
    if kind == "decimal":
        assert certificate.get("enclosure"), "decimals without an enclosure of the scheme that they stand for"
        check_enclosure(certificate["enclosure"], maps, certificate["order"])
        bounds, radius = [Fraction(claim["bound"]) for claim in [certificate, *certificate["also"]]], Fraction(certificate["enclosure"]["radius"])
        assert max(bounds) <= SLACK * radius, "a bound is larger than the decimals need"
    return count


if __name__ == "__main__":
    if not __debug__:
        sys.exit("not proved: without assertions nothing is checked: run python3 without -O")
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as file:
            certificate = json.load(file)
        try:
            count = check(certificate)
        except (AssertionError, KeyError, TypeError, ValueError) as error:
            sys.exit(f"{path}: not proved: {error}")
        also = "".join(f", {c.get('orders', c.get('order'))} for {c['for']}" for c in certificate["also"])
        facts = f"order {certificate['order']}{also}, {certificate['kind']}, {count} conditions"
        if certificate["kind"] == "decimal":
            only = "".join(f"; of {c['for']} to within {c['bound']} only" for c in certificate["also"])
            radius = float(Fraction(certificate["enclosure"]["radius"]))
            facts += f" to within {certificate['bound']}, one solution enclosed within {radius:.0e}{only}"
        print(f"{certificate['scheme']}: {facts}")
