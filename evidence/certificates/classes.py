"""The conditions of orders for classes of H, for check.py: names, numbers of letters, what is needed, and values at the weights of the maps.

Every T(p): Lyndon words, whose coefficients in the product of the exponentials are 1/m!. A + eps B: those of them with one letter B up to the first order,
with two up to the second, ..., and with more up to the last. Quadratic T: trees in which kicks K and drifts D take turns and a drift has at most one kick
(Calvo & Sanz-Serna 1993). The value of a tree is the sum, over all ways to place its nodes at maps so that a child acts before its parent, of the products
of weights; needed is one over the product of the sizes of all subtrees.
"""

from fractions import Fraction
from math import factorial, prod


def lyndon_words(longest):
    """The words that are less than all their proper ends (Duval)."""
    words, word = [], "K"
    while word:
        words.append(word)
        word = "".join(word[i % len(word)] for i in range(longest)).rstrip("D")
        word = word and word[:-1] + "D"
    return words


def words_of_powers(letter, orders):
    """The words of A + eps B with this letter of B: those of eps alone are few also where they are long."""
    assert letter in ("K", "D") and orders and all(order >= 1 for order in orders), "the orders"
    one = ["K" + "D" * n if letter == "K" else "K" * n + "D" for n in range(orders[0])]
    longest = max(orders[1:] or orders)
    counted = [(word, word.count(letter)) for word in lyndon_words(longest) if len(word) > 1]
    more = [word for word, n in counted if n > 1 and len(word) <= orders[min(n, len(orders)) - 1]]
    return ["K", "D"] + [word for word in one if len(word) > 1] + more


def trees(maps, order, zero):
    """The conditions of the trees of at most this number of nodes."""

    def before(letter, values):
        """The sums of the products of weights and values: before each map, and over all."""
        total, sums = zero, []
        for (kind, weight), value in zip(maps, values):
            sums.append(total)
            if kind == letter:
                total = total + (weight * value if value else weight)
        return sums, total

    def forests(room, least):
        """Lists of drifts of this number of nodes."""
        if room == 0:
            yield []
        for i in range(least, len(drifts)):
            if drifts[i][1] <= room:
                yield from ([drifts[i]] + rest for rest in forests(room - drifts[i][1], i))

    sums, total = before("D", [None] * len(maps))
    drifts = [("D", 1, 1, sums)]  # with the product of the sizes of subtrees and the sums before each map
    found = [("the tree D", 1, Fraction(1), total)]
    for size in range(1, order + 1):
        for forest in list(forests(size - 1, 0)):
            name = f"K[{' '.join(drift[0] for drift in forest)}]"
            sizes = size * prod(drift[2] for drift in forest)
            at_maps = [product(values) for values in zip(*(drift[3] for drift in forest))] or [None] * len(maps)
            sums, total = before("K", at_maps)
            found.append((f"the tree {name}", size, Fraction(1, sizes), total))
            if size < order:
                sums, total = before("D", sums)
                found.append((f"the tree D[{name}]", size + 1, Fraction(1, sizes * (size + 1)), total))
                drifts.append((f"D[{name}]", size + 1, sizes * (size + 1), sums))
    return found


def product(values):
    first, *others = values
    for value in others:
        first = first * value
    return first


def words_of(claim):
    """The words of a claim; none of one for quadratic T."""
    letters = {"kick": "K", "drift": "D"}
    return {
        "every T(p)": lambda: lyndon_words(claim["order"]),
        "A + εB": lambda: words_of_powers(letters[claim["perturbation"]], claim["orders"]),
        "quadratic T": lambda: [],
    }[claim["for"]]()


def word_conditions(words, values):
    return [(f"the word {w}", len(w), Fraction(1, factorial(len(w))), value) for w, value in zip(words, values)]
