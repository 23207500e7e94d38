//! The figures of a paper: computed, drawn, and told.
//!
//! | file | what it is |
//! | --- | --- |
//! | [`work`] | tasks over all cores; what is done stays in a file |
//! | [`fit`] | a line through points, and how well it is known |
//! | [`chart`] | curves → SVG |
//! | [`report`] | figures → one page of HTML |

#![cfg_attr(not(test), expect(dead_code, reason = "no command uses them yet"))]

mod chart;
mod fit;
mod report;
mod work;
