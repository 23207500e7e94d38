//! The elementary functions of double precision: their last bits depend on the processor and on the C library.

use std::sync::OnceLock;

use sha2::{Digest, Sha256};
use shadowstep::Number;

use crate::results::metadata::hexadecimal;

/// A function of double precision, and the interval in which its values are compared.
type Function = (fn(&mut f64, &f64), f64, f64);

/// The functions that formulas may have, as runs compute them.
const FUNCTIONS: [Function; 16] = [
    (Number::assign_exp, -30.0, 30.0),
    (Number::assign_log, 1e-6, 100.0),
    (Number::assign_sin, -100.0, 100.0),
    (Number::assign_cos, -100.0, 100.0),
    (Number::assign_tan, -100.0, 100.0),
    (Number::assign_sinh, -10.0, 10.0),
    (Number::assign_cosh, -10.0, 10.0),
    (Number::assign_tanh, -3.0, 3.0),
    (Number::assign_atan, -10.0, 10.0),
    (Number::assign_asin, -1.0, 1.0),
    (Number::assign_acos, -1.0, 1.0),
    (|y, x| y.assign_root(x, 3), 0.0, 100.0),
    (|y, x| y.assign_root(x, 5), 0.0, 100.0),
    (|y, x| y.assign_root(x, 7), 0.0, 100.0),
    (Number::assign_reciprocal_sqrt, 1e-6, 100.0),
    (Number::assign_sqrt, 0.0, 100.0),
];

/// Of each function. Of 100 000 values in double precision, two versions of a C library differ in 10 or more.
const ARGUMENTS: u32 = 20_000;

/// The hash of many values of the elementary functions of double precision: equal where these have the same bits, as
/// far as the values show. Their last bits depend on the processor and on the C library.
pub fn elementary_functions() -> &'static str {
    static HASH: OnceLock<String> = OnceLock::new();
    HASH.get_or_init(|| {
        let mut hash = Sha256::new();
        let (mut value, mut values) = (0.0, Vec::new());
        for (function, least, largest) in FUNCTIONS {
            values.clear();
            for i in 1..=ARGUMENTS {
                // the fractional parts of multiples of the golden ratio are spread evenly
                let part = (f64::from(i) * 0.618_033_988_749_894_9).fract();
                function(&mut value, &(least + (largest - least) * part));
                values.extend(value.to_bits().to_le_bytes());
            }
            hash.update(&values); // at once: a development build spends most of its time on each call
        }
        hexadecimal(&hash.finalize())
    })
}
