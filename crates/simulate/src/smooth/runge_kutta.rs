//! Steps of order five.
//!
//! Dormand and Prince 1980, *A family of embedded Runge-Kutta formulae*: the formula of order five, whose last stage is the first of the next
//! step. Steps are all of one length, so that halving them shows the order and the error (`trajectory`). What lies between their ends
//! is a polynomial through their derivatives.

use super::system::{Linearised, Lost, Scratch, System};

const STAGES: usize = 7;

/// Nodes and weights by stage; the last stage is the end of the step.
const NODES: [f64; STAGES] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
const WEIGHTS: [[f64; 6]; STAGES] = [
    [0.0; 6],
    [0.2, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [
        19372.0 / 6561.0,
        -25360.0 / 2187.0,
        64448.0 / 6561.0,
        -212.0 / 729.0,
        0.0,
        0.0,
    ],
    [
        9017.0 / 3168.0,
        -355.0 / 33.0,
        46732.0 / 5247.0,
        49.0 / 176.0,
        -5103.0 / 18656.0,
        0.0,
    ],
    [
        35.0 / 384.0,
        0.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
    ],
];

/// Weights of the derivatives in what a step is between its ends beyond a cubic (Hairer, Nørsett & Wanner 1993, section II.6): as far off as the
/// step itself, to the same order.
const BETWEEN: [f64; STAGES] = [
    -12_715_105_075.0 / 11_282_082_432.0,
    0.0,
    87_487_479_700.0 / 32_700_410_799.0,
    -10_690_763_975.0 / 1_880_347_072.0,
    701_980_252_875.0 / 199_316_789_632.0,
    -1_453_857_185.0 / 822_651_844.0,
    69_997_945.0 / 29_380_423.0,
];

/// Derivatives in a step.
pub(super) const EVALUATIONS: f64 = 6.0;

/// A step in which the constraints cannot be reached is made of two halves, and so on so often.
const MOST_HALVINGS: u32 = 8;

/// A motion, step by step.
#[derive(Debug)]
pub(super) struct Stepper {
    pub state: Vec<f64>,
    time: f64,
    /// Of the last step (s).
    length: f64,
    /// At the beginning of a step, or of one before it, and at the latest stage.
    begin: Linearised,
    latest: Linearised,
    derivatives: [Vec<f64>; STAGES],
    reached: Vec<f64>,
    scratch: Scratch,
    /// Independent constraints at the start.
    rank: usize,
}

impl Stepper {
    /// Starts from a state, which is brought onto the constraints.
    ///
    /// # Errors
    /// Where they cannot be reached from it.
    pub fn new(system: &mut System, state: Vec<f64>) -> Result<Self, Lost> {
        let none = || vec![0.0; state.len()];
        let mut stepper = Self {
            derivatives: std::array::from_fn(|_| none()),
            reached: none(),
            state,
            time: 0.0,
            length: 0.0,
            begin: Linearised::default(),
            latest: Linearised::default(),
            scratch: Scratch::default(),
            rank: 0,
        };
        let Self {
            state,
            begin,
            latest,
            derivatives,
            scratch,
            ..
        } = &mut stepper;
        let first = &mut derivatives[0];
        system.derivative((&mut *state, 0.0), None, latest, scratch, first)?;
        system.derivative((&mut *state, 0.0), Some(latest), begin, scratch, first)?;
        system.arrive(state, 0.0, scratch)?;
        stepper.rank = stepper.begin.rank();
        Ok(stepper)
    }

    /// A step of a length (s).
    ///
    /// # Errors
    /// Where the constraints cannot be reached however short it is.
    pub fn step(&mut self, system: &mut System, length: f64) -> Result<(), Lost> {
        self.steps(system, length, MOST_HALVINGS)?;
        self.goes_on()
    }

    /// A step of a length (s) in one piece; false where it cannot be taken so, and nothing has moved.
    ///
    /// # Errors
    /// As [`Self::step`].
    pub fn leap(&mut self, system: &mut System, length: f64) -> Result<bool, Lost> {
        if self.attempt(system, length).is_err() {
            return Ok(false);
        }
        self.goes_on().map(|()| true)
    }

    fn goes_on(&self) -> Result<(), Lost> {
        // A motion that is let go where two branches meet, or where a shaky mechanism is drawn, has no equation: it begins with fewer
        // independent constraints than it goes on with. Where it comes through such a pose, it goes straight on.
        if self.begin.rank() > self.rank {
            return Err(Lost::Independent);
        }
        Ok(())
    }

    /// The state at a share of the last step, brought onto the constraints where that is possible.
    pub fn between(&mut self, system: &System, share: f64, state: &mut Vec<f64>) {
        let (rest, length) = (1.0 - share, self.length);
        // A step swaps its two ends, and the derivatives there.
        let (from, to) = (&self.reached, &self.state);
        let [end, .., start] = &self.derivatives;
        state.clear();
        state.extend((0..from.len()).map(|i| {
            let whole = to[i] - from[i];
            let bend = length * start[i] - whole;
            let other = whole - length * end[i] - bend;
            let inner = self.derivatives[1..STAGES - 1].iter().zip(&BETWEEN[1..]);
            let inner: f64 = inner
                .map(|(derivative, weight)| derivative[i] * weight)
                .sum();
            let more = length * (inner + start[i] * BETWEEN[0] + end[i] * BETWEEN[STAGES - 1]);
            from[i] + share * (whole + rest * (bend + share * (other + rest * more)))
        }));
        let time = self.time - rest * length;
        system.settle(
            (state, time),
            &self.begin,
            &mut self.latest,
            &mut self.scratch,
        );
    }

    fn steps(&mut self, system: &mut System, length: f64, halvings: u32) -> Result<(), Lost> {
        match self.attempt(system, length) {
            Err(_) if halvings > 0 => {
                self.steps(system, 0.5 * length, halvings - 1)?;
                self.steps(system, 0.5 * length, halvings - 1)
            }
            done => done,
        }
    }

    fn attempt(&mut self, system: &mut System, length: f64) -> Result<(), Lost> {
        for stage in 1..STAGES {
            self.reached.copy_from_slice(&self.state);
            for (weight, derivative) in WEIGHTS[stage].iter().zip(&self.derivatives[..stage]) {
                if *weight != 0.0 {
                    let by = length * weight;
                    for (sum, rate) in self.reached.iter_mut().zip(derivative) {
                        *sum += by * rate;
                    }
                }
            }
            system.derivative(
                (&mut self.reached, self.time + NODES[stage] * length),
                Some(&self.begin),
                &mut self.latest,
                &mut self.scratch,
                &mut self.derivatives[stage],
            )?;
        }
        let time = self.time + length;
        system.arrive(&self.reached, time, &mut self.scratch)?;
        self.length = length;
        self.time = time;
        std::mem::swap(&mut self.state, &mut self.reached);
        // Within a hair of a singular pose a constraint counts for none. Directions that still have it bring the next step back better.
        if self.latest.rank() >= self.begin.rank() {
            std::mem::swap(&mut self.begin, &mut self.latest);
        }
        self.derivatives.swap(0, STAGES - 1);
        Ok(())
    }
}
