//! By how much logged states differ from the steps that are supposed to have made them.

/// The differences r = x_{n+1} − x_n − Δx of logged states x, q or p, from the increments Δx of the steps between them.
#[derive(Clone, Debug)]
pub(super) struct Misfit {
    /// The differences of the newest step.
    newest: Vec<f64>,
    /// Their sums over the steps that follow each other, and the number of these.
    sums: Vec<f64>,
    follow: u64,
    /// Σ of squares of the sums, and of the number of steps in each.
    wandered: f64,
    steps: u64,
    count: u64,
    squares: f64,
    products: f64,
    with_increments: f64,
    increments: f64,
    numbers: f64,
    largest: Option<Largest>,
}

/// The largest difference of a logged state from the step that is supposed to have made it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Largest {
    /// n of the state after the step.
    pub n: i64,
    /// The coordinate, counted from 0.
    pub coordinate: usize,
    /// The difference.
    pub difference: f64,
}

impl Misfit {
    pub(super) fn new(dimension: usize) -> Self {
        Misfit {
            newest: vec![0.0; dimension],
            sums: vec![0.0; dimension],
            follow: 0,
            wandered: 0.0,
            steps: 0,
            count: 0,
            squares: 0.0,
            products: 0.0,
            with_increments: 0.0,
            increments: 0.0,
            numbers: 0.0,
            largest: None,
        }
    }

    /// The next states do not follow those before.
    pub(super) fn begin(&mut self) {
        self.follow = 0;
        self.sums.fill(0.0);
    }

    /// Takes a step to the state n.
    pub(super) fn add_step(&mut self, n: i64, [before, after]: [&[f64]; 2], added: &[f64]) {
        for (i, ((before, after), added)) in before.iter().zip(after).zip(added).enumerate() {
            self.add((n, i), [*before, *after], *added, *after);
        }
        self.end();
    }

    /// Takes a coordinate of a step to the state n, with the logged number; gives the difference.
    #[inline]
    pub(super) fn add(
        &mut self,
        (n, coordinate): (i64, usize),
        [before, after]: [f64; 2],
        added: f64,
        logged: f64,
    ) -> f64 {
        let difference = (after - before) - added;
        self.squares += difference * difference;
        self.with_increments += difference * added;
        self.increments += added * added;
        self.numbers += logged * logged;
        if self.follow > 0 {
            self.products += difference * self.newest[coordinate];
        }
        self.newest[coordinate] = difference;
        self.sums[coordinate] += difference;
        self.wandered += self.sums[coordinate] * self.sums[coordinate];
        if self.largest.is_none_or(|largest| difference.abs() > largest.difference.abs()) {
            self.largest = Some(Largest { n, coordinate, difference });
        }
        difference
    }

    /// Ends a step.
    pub(super) fn end(&mut self) {
        let dimension = self.newest.len() as u64;
        self.count += dimension;
        self.follow += 1;
        self.steps += self.follow * dimension;
    }

    /// What is known of them, once there was a step.
    pub(super) fn found(&self) -> Option<Differences> {
        let count = self.count as f64;
        Some(Differences {
            rms: (self.squares / count).sqrt(),
            of_increments: (self.squares / self.increments).sqrt(),
            of_numbers: (self.squares / self.numbers).sqrt(),
            correlation: self.products / self.squares,
            wandering: self.wandered / self.steps as f64 / (self.squares / count),
            slope: self.with_increments / self.increments,
            largest: self.largest?,
        })
    }
}

/// The differences r = x_{n+1} − x_n − Δx of logged states from the increments of the steps between them, of q or of p.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Differences {
    /// Their root mean square.
    pub rms: f64,
    /// That as a part of the rms of the increments Δx.
    pub of_increments: f64,
    /// That as a part of the rms of x.
    pub of_numbers: f64,
    /// Σ r_n r_{n−1}/Σ r²: −½ if each x is rounded by itself, as where it was stored with few digits.
    pub correlation: f64,
    /// The mean square of the sums of r over steps that follow each other, divided by that of independent r: small if
    /// each x is rounded by itself, 1 if the r are independent, large if they are alike.
    pub wandering: f64,
    /// Σ r Δx/Σ Δx²: by what part the increments are too small, on the average.
    pub slope: f64,
    /// The largest.
    pub largest: Largest,
}
