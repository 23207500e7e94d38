//! Random runs of a system: the sections \[run\] and \[ensemble\], and commands.

use shadowstep_schemes::shipped_names;

use crate::document::{File, NAME};
use crate::maker::{Maker, System};

impl Maker {
    /// A number type.
    fn digits(&mut self) {
        let digits = self.one(&[
            "\"double\"",
            "\"double\"",
            "\"double\"",
            "\"compensated\"",
            "\"double-double\"",
            "20",
            "30",
            "50",
            "320",
        ]);
        let is_number = digits.parse::<u32>().is_ok();
        self.is_double = ["\"double\"", "\"compensated\""].contains(&digits);
        match self.once_in(30) {
            true => self.is_double = true,
            false => self.key("digits", digits),
        }
        if is_number && self.once_in(3) || self.once_in(60) {
            self.maybe(1, "mpfr", &["true", "false"]);
        }
    }

    /// The section \[run\]; `scheme` and `step` may stand for those of an axis.
    pub(crate) fn run(&mut self, system: &System, scheme: Option<&str>, step: Option<&str>) {
        self.heading("[run]");
        let drawn = if self.once_in(6) { self.one(&shipped_names()) } else { self.one(system.schemes) };
        let scheme = scheme.unwrap_or(drawn);
        self.text("scheme", scheme);
        if scheme == "own-scheme.toml" {
            self.document.files.push(own_scheme());
        }
        let has_gradient_kicks =
            ["chin-4a", "takahashi-imada", "wisdom-kernel-3", "omelyan-4mn3f1gp"].contains(&scheme);
        self.maybe(if has_gradient_kicks { 3 } else { 60 }, "gradient_kicks", &["\"exact\"", "\"displaced\""]);
        self.maybe(if has_gradient_kicks { 30 } else { 6 }, "first", &["\"kick\"", "\"drift\""]);
        let own = system.step;
        let step = step.map_or_else(
            || self.one(&["H", "H", "H", "H/4", "-(H)", "3*(H)", "sqrt(2)*(H)"]).replace('H', own),
            str::to_owned,
        );
        self.text("step", &step);
        let count = self.one(&[1, 2, 5, 10, 16, 24, 40]);
        // from near a singularity, or by a power of U, a physical end may be millions of steps away
        let is_far = self.has_time
            && ["1e-3", "1e-17", "1e-300", "exponent = "].iter().any(|x| self.document.to_string().contains(x));
        match self.below(5) {
            _ if is_far => self.key("steps", count),
            0 => self.text("until", &format!("{count}*({step})")),
            1 => self.text("until", &format!("({count} + 1/3)*({step})")),
            _ => self.key("steps", count),
        }
        if self.once_in(if self.names.contains(&"x0") { 100 } else { 10 }) {
            let condition =
                self.one(&["X > 1", "E < -100", "t > 5*(H)", "X*P > 0", "X^2 + Y^2 > A"]).replace('H', &step);
            let condition = self.filled(&condition, system);
            self.text("end", &condition);
        }
        self.digits();
    }

    /// The section \[ensemble\].
    fn ensemble(&mut self) {
        self.heading("[ensemble]");
        if self.once_in(2) {
            self.text("file", "starts.csv");
            self.document.files.push(File::new("starts.csv", "x0\n0.3\n1/2\n1\n"));
        } else {
            self.key("columns.x0", "[\"1/3\", 0.5, 1]");
        }
    }

    /// A scene that is run, or another command on it.
    pub(crate) fn scene(&mut self) {
        let is_ensemble = self.once_in(8);
        if is_ensemble {
            self.names = vec!["x0"];
        }
        let system = self.system();
        self.run(&system, None, None);
        if is_ensemble && !self.is_double && !self.once_in(12) {
            self.document.files[0].lines.retain(|line| !line.starts_with("digits = ") && !line.starts_with("mpfr = "));
            self.text("digits", "double");
            self.is_double = true;
        }
        self.output(&system, is_ensemble);
        if is_ensemble {
            self.ensemble();
        }
        let has_summary = !self.document.to_string().contains("summary = false") || self.once_in(20);
        let flags = if has_summary { self.one(&["", "", "", " --strict", " --no-summary"]) } else { "" };
        let command = format!("run {NAME}{flags}");
        let (scheme, step) = (self.one(system.schemes), system.step);
        if scheme == "own-scheme.toml" {
            self.document.files.push(own_scheme());
        }
        let of_flags = format!("{NAME} --scheme={scheme} --step={step} --until=8*({step}) --double");
        let commands = match self.below(16) {
            2..7 if is_ensemble && !self.once_in(12) => vec![command],
            0 => vec![command.clone(), command],
            1 => vec![command, format!("run {NAME} --restart")],
            2 => vec![format!("trace {of_flags} --csv --states")],
            3 => vec![format!("drift {of_flags} --json")],
            4 => vec![format!("chaos {NAME} --json")],
            5 => vec![format!("chaos {NAME} --exponents 2 --one")],
            6 => {
                let notation = self.one(&["text", "latex", "rust", "numpy"]);
                vec![format!("modified {scheme} {NAME} --to {notation}")]
            }
            _ => vec![command],
        };
        self.document.commands = commands;
    }
}

/// A table of one's own.
fn own_scheme() -> File {
    File::new("own-scheme.toml", include_str!("../crosses/own-scheme.toml"))
}
