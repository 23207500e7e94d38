//! Double roots that the structure of a step explains: a step P_1^g P_2^g … whose s parts have one trace t.
//!
//! Where t = 2 cos(πj/g) with 0 < j < g, each P_i^g is the matrix (−1)^j, and so the step is (−1)^{js}. There both
//! terms of tr² − 4 = (α − δ)² + 4βγ have a double root, for a step with the entries α, β, γ, δ and determinant 1. So
//! tr − 2 or tr + 2 is divisible by the square of a polynomial in t, which is one of Chebyshev's or a sum of two: no
//! greatest common divisor is needed, which would take minutes for hundreds of digits.
//!
//! A step repeated, followed by its adjoint or a rotation of it as often repeated, is of this form: A A A* A*.

use shadowstep_schemes::arithmetic::Arithmetic;
use shadowstep_schemes::map::Map;
use shadowstep_schemes::symbolic::Rational;

/// Whether the second half of a ring is the first one with kicks and drifts exchanged, weights as they are.
///
/// The exchange is a similarity: with J = (0, 1; −x, 0) and J² = −x the step is P·J⁻¹PJ = −x (PJ⁻¹)². So its trace is
/// 2 − s² for s = √x·tr(PJ⁻¹), and never passes 2.
pub(crate) fn repeats_exchanged(ring: &[Map]) -> bool {
    let (first, second) = ring.split_at(ring.len() / 2);
    let is_exchanged = |(a, b): (&Map, &Map)| a.kind != b.kind && a.weight == b.weight;
    first.len() == second.len() && first.iter().zip(second).all(is_exchanged)
}

/// P_1^g P_2^g …: all parts have the trace of the first.
#[derive(Debug)]
pub(crate) struct Powers {
    pub(crate) part: Vec<Map>,
    exponent: usize,
    count: usize,
}

impl Powers {
    /// All ways to write a ring of maps, in which kicks and drifts alternate, as powers.
    pub(crate) fn all_of(ring: &[Map]) -> Vec<Powers> {
        let ring = Ring::of(ring);
        let length = ring.maps.len();
        // two powers at least; a map that two of them share counts for both
        let sizes = (2..=(length + 2) / 4).step_by(2);
        sizes.flat_map(|size| ring.powers_of(size)).collect()
    }

    /// The square of the polynomial in t that divides tr − level, and its value at t = 2, where x = 0; `None` if it
    /// is 1.
    pub(crate) fn square<A: Arithmetic>(
        &self,
        arithmetic: &A,
        t: &[A::Value],
        level: i32,
    ) -> Option<(Vec<A::Value>, u32)> {
        let g = self.exponent;
        // U_n + sign·U_{n − lag} in t = 2 cos θ, where U_n = sin((n + 1)θ)/sin θ
        let (n, sign, lag, constant) = match (self.count.is_multiple_of(2), g.is_multiple_of(2), level > 0) {
            (true, _, true) => (g - 1, 0, 1, g),
            (true, _, false) => return None,
            (false, true, true) => (g / 2 - 1, 0, 1, g / 2),
            (false, true, false) => (g / 2, -1, 2, 2),
            (false, false, true) => (g / 2, 1, 1, g),
            (false, false, false) => (g / 2, -1, 1, 1),
        };
        if n == 0 {
            return None;
        }
        let factor = chebyshev(arithmetic, t, n, sign, lag);
        Some((product(arithmetic, &factor, &factor), (constant * constant) as u32))
    }
}

/// U_n(t) + sign·U_{n − lag}(t)
fn chebyshev<A: Arithmetic>(arithmetic: &A, t: &[A::Value], n: usize, sign: i64, lag: usize) -> Vec<A::Value> {
    let number = |n: i64| arithmetic.weight(&Rational::from_integer(n.into()));
    // U_{−1} = 0, U_0 = 1
    let mut all = vec![Vec::new(), vec![arithmetic.one()]];
    for k in 1..=n {
        let mut next = product(arithmetic, t, &all[k]);
        add(arithmetic, &mut next, &number(-1), &all[k - 1]);
        all.push(next);
    }
    let mut sum = all[n + 1].clone();
    if sign != 0 {
        add(arithmetic, &mut sum, &number(sign), &all[n + 1 - lag]);
    }
    sum
}

fn add<A: Arithmetic>(arithmetic: &A, sum: &mut [A::Value], factor: &A::Value, other: &[A::Value]) {
    sum.iter_mut().zip(other).for_each(|(sum, other)| arithmetic.add_product(sum, factor, other));
}

fn product<A: Arithmetic>(arithmetic: &A, a: &[A::Value], b: &[A::Value]) -> Vec<A::Value> {
    if b.is_empty() {
        return Vec::new();
    }
    let mut product = vec![arithmetic.zero(); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        add(arithmetic, &mut product[i..], x, b);
    }
    product
}

/// The quotient of a division that leaves nothing, from the lowest term on; `constant` is the constant term of the
/// divisor, exactly.
pub(crate) fn quotient<A: Arithmetic>(
    arithmetic: &A,
    dividend: &[A::Value],
    divisor: &[A::Value],
    constant: u32,
) -> Vec<A::Value> {
    let minus_one = arithmetic.weight(&Rational::from_integer((-1).into()));
    let opposite: Vec<_> = divisor.iter().map(|value| arithmetic.product(&minus_one, value)).collect();
    let mut quotient: Vec<A::Value> = Vec::new();
    for k in 0..=dividend.len() - divisor.len() {
        let mut sum = dividend[k].clone();
        for j in 1..=k.min(divisor.len() - 1) {
            arithmetic.add_product(&mut sum, &opposite[j], &quotient[k - j]);
        }
        quotient.push(arithmetic.divide(&sum, constant));
    }
    quotient
}

/// A ring of maps, with equal weights numbered alike.
struct Ring<'a> {
    maps: &'a [Map],
    numbers: Vec<usize>,
}

/// Where a power begins: in this map, of which this weight is left.
#[derive(Clone, PartialEq)]
struct Cut {
    map: usize,
    left: Rational,
}

impl<'a> Ring<'a> {
    fn of(maps: &'a [Map]) -> Ring<'a> {
        let number = |map: &Map| maps.iter().position(|other| other == map).expect("it is among them");
        Ring { maps, numbers: maps.iter().map(number).collect() }
    }

    fn weight(&self, map: usize) -> &Rational {
        &self.maps[map % self.maps.len()].weight
    }

    fn number(&self, map: usize) -> usize {
        self.numbers[map % self.numbers.len()]
    }

    /// The ring as powers of parts of this number of maps.
    fn powers_of(&self, size: usize) -> Vec<Powers> {
        let length = self.maps.len();
        let repeats: Vec<usize> = (0..length).map(|map| self.repeats(map, size)).collect();
        let longest = repeats.iter().max().copied().unwrap_or(0);
        let exponents = 2..=((length + 2) / (2 * size)).min(longest / size + 2);
        let of = |exponent: usize| {
            let cuts = |map: usize| [map, map + size].map(|of| Cut { map, left: self.weight(of).clone() });
            (0..length).flat_map(cuts).find_map(|start| self.walk(&start, size, exponent, &repeats))
        };
        exponents.filter_map(of).collect()
    }

    /// How many maps from this one on are each equal to the one `size` later.
    fn repeats(&self, from: usize, size: usize) -> usize {
        (from..from + self.maps.len()).take_while(|&map| self.number(map) == self.number(map + size)).count()
    }

    /// The ring as powers with this exponent, the first of which begins at the cut.
    fn walk(&self, start: &Cut, size: usize, exponent: usize, repeats: &[usize]) -> Option<Powers> {
        let length = self.maps.len();
        let end = Cut { map: start.map + length, left: start.left.clone() };
        let (mut cut, mut count) = (start.clone(), 0);
        let window = |cut: &Cut| (cut.map + 1..=cut.map + size).map(|map| self.number(map)).collect::<Vec<_>>();
        let first = window(start);
        while cut != end {
            if cut.map >= end.map || count > 0 && !is_same_ring(&first, &window(&cut)) {
                return None;
            }
            cut = self.after_power(&cut, size, exponent, repeats)?;
            count += 1;
        }
        let part = (start.map + 1..=start.map + size).map(|map| self.maps[map % length].clone()).collect();
        Some(Powers { part, exponent, count })
    }

    /// Where the power ends that begins at the cut. It begins and ends with a map of one kind, which together are one
    /// map of the part, or with maps of different kinds, which are whole maps of the part.
    fn after_power(&self, cut: &Cut, size: usize, exponent: usize, repeats: &[usize]) -> Option<Cut> {
        let equal = repeats[(cut.map + 1) % repeats.len()];
        let maps = size * exponent;
        if equal > maps - size - 2 {
            let last = cut.map + maps;
            let used = self.weight(cut.map + size) - &cut.left;
            return Some(self.cut(last, self.weight(last) - used));
        }
        let last = cut.map + maps - 1;
        let is_whole = equal == maps - size - 2 && cut.left == *self.weight(cut.map + size);
        is_whole.then(|| self.cut(last, self.weight(last) - self.weight(last - size)))
    }

    fn cut(&self, map: usize, left: Rational) -> Cut {
        if left == Rational::from_integer(0.into()) {
            Cut { map: map + 1, left: self.weight(map + 1).clone() }
        } else {
            Cut { map, left }
        }
    }
}

/// Whether two rings differ by a rotation, or by one and the direction: then their maps have one trace.
fn is_same_ring(a: &[usize], b: &[usize]) -> bool {
    let twice = [a, a].concat();
    let backward: Vec<usize> = b.iter().rev().copied().collect();
    twice.windows(b.len()).any(|window| window == b || window == backward)
}
