//! Constants and tables of the functions, each number the nearest double-double. Coefficients of series are part of the
//! code, which they make faster; tables are computed at first use, with numbers of 320 bits.

use std::sync::LazyLock;

use shadowstep_limbs::Limbs;

/// High and low part.
type Pair = (f64, f64);

/// log 2/32 = a + b, a of 37 bits
pub(super) const LOG_2_32: (f64, Pair) = (0.021660849392446835, (5.145609244655338e-14, -3.1493591049703574e-30));

/// log 2 = a + b, a of 42 bits
pub(super) const LOG_2: (f64, Pair) = (0.6931471805598903, (5.497923018708371e-14, 1.94704509238075e-31));

/// π/256 = a + b + c, a and b of 30 bits
pub(super) const PI_256: ([f64; 2], Pair) =
    ([0.012271846295334399, 7.750731087215017e-12], (4.039205454526645e-21, 3.387425832079602e-37));

/// π/2
#[expect(clippy::approx_constant, reason = "the high part of a constant is an `f64`")]
pub(super) const HALF_PI: Pair = (1.5707963267948966, 6.123233995736766e-17);

/// 1/n! for n from 0 to 29
pub(super) const INVERSE_FACTORIALS: [Pair; 30] = [
    (1.0, 0.0),
    (1.0, 0.0),
    (0.5, 0.0),
    (0.16666666666666666, 9.25185853854297e-18),
    (0.041666666666666664, 2.3129646346357427e-18),
    (0.008333333333333333, 1.1564823173178714e-19),
    (0.001388888888888889, -5.300543954373577e-20),
    (0.0001984126984126984, 1.7209558293420705e-22),
    (2.48015873015873e-5, 2.1511947866775882e-23),
    (2.7557319223985893e-6, -1.858393274046472e-22),
    (2.755731922398589e-7, 2.3767714622250297e-23),
    (2.505210838544172e-8, -1.448814070935912e-24),
    (2.08767569878681e-9, -1.20734505911326e-25),
    (1.6059043836821613e-10, 1.2585294588752098e-26),
    (1.1470745597729725e-11, 2.0655512752830745e-28),
    (7.647163731819816e-13, 7.03872877733453e-30),
    (4.779477332387385e-14, 4.399205485834081e-31),
    (2.8114572543455206e-15, 1.6508842730861433e-31),
    (1.5619206968586225e-16, 1.1910679660273754e-32),
    (8.22063524662433e-18, 2.2141894119604265e-34),
    (4.110317623312165e-19, 1.4412973378659527e-36),
    (1.9572941063391263e-20, -1.3643503830087908e-36),
    (8.896791392450574e-22, -7.911402614872376e-38),
    (3.868170170630684e-23, -8.843177655482344e-40),
    (1.6117375710961184e-24, -3.6846573564509766e-41),
    (6.446950284384474e-26, -1.9330404233703465e-42),
    (2.4795962632247976e-27, -1.2953730964765229e-43),
    (9.183689863795546e-29, 1.4303150396787322e-45),
    (3.279889237069838e-30, 1.5117542744029879e-46),
    (1.1309962886447716e-31, 1.0498015412959506e-47),
];

/// 1/n for n from 1 to 19
pub(super) const INVERSES: [Pair; 19] = [
    (1.0, 0.0),
    (0.5, 0.0),
    (0.3333333333333333, 1.850371707708594e-17),
    (0.25, 0.0),
    (0.2, -1.1102230246251566e-17),
    (0.16666666666666666, 9.25185853854297e-18),
    (0.14285714285714285, 7.93016446160826e-18),
    (0.125, 0.0),
    (0.1111111111111111, 6.1679056923619804e-18),
    (0.1, -5.551115123125783e-18),
    (0.09090909090909091, -2.523234146875356e-18),
    (0.08333333333333333, 4.625929269271485e-18),
    (0.07692307692307693, -4.270088556250602e-18),
    (0.07142857142857142, 3.96508223080413e-18),
    (0.06666666666666667, 9.251858538542971e-19),
    (0.0625, 0.0),
    (0.058823529411764705, 8.163404592832033e-19),
    (0.05555555555555555, 3.0839528461809902e-18),
    (0.05263157894736842, 2.921639538487254e-18),
];

/// Tables whose entries are chosen by the argument.
pub(super) struct Tables {
    /// 2^(j/32)
    pub(super) powers: [Pair; 32],
    /// sin(jπ/256), j up to 128
    pub(super) sines: [Pair; 129],
    /// For i from 45 to 91, a number r of 9 bits near 64/i, and −log r
    pub(super) logarithms: [(f64, Pair); 47],
}

pub(super) static TABLES: LazyLock<Tables> = LazyLock::new(|| {
    let (log_2, pi) = (Exact::from(2).log(), Exact::pi());
    Tables {
        powers: table(|j| nearest(&log_2.times_integer(j).over_integer(32).exp())),
        sines: table(|j| nearest(&pi.times_integer(j).over_integer(256).sin())),
        logarithms: table(|i| {
            let r = (16384.0 / f64::from(i + 45)).round() / 256.0;
            (r, nearest(&-Exact::from(r).log()))
        }),
    }
});

/// With enough digits for the nearest low part, also where that is far below the high one.
type Exact = Limbs<5>;

fn table<T, const N: usize>(entry: impl Fn(i32) -> T) -> [T; N] {
    std::array::from_fn(|i| entry(i as i32))
}

fn nearest(x: &Exact) -> Pair {
    let high = x.to_f64();
    (high, (x - &Exact::from(high)).to_f64())
}

/// ⌊2¹⁴⁰⁰ π⌋
pub(super) const PI_TIMES_2_1400: &str = "\
3243f6a8885a308d313198a2e03707344a4093822299f31d0082efa98ec4e6c89452821e638d01377be5466cf34e90c6cc0ac29b7c97c50dd3f84d5b\
5b54709179216d5d98979fb1bd1310ba698dfb5ac2ffd72dbd01adfb7b8e1afed6a267e96ba7c9045f12c7f9924a19947b3916cf70801f2e2858efc1\
6636920d871574e69a458fea3f4933d7e0d95748f728eb658718bcd5882154aee7b54a41dc25a59b59c30d5392af26013c5d1b023286085\
";
