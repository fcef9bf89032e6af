//! What a long run is held to, and why by so much.
//!
//! *Closure error.* A substep leaves a gap that is quadratic in its motion, and the springs that hold the joints are so stiff
//! that the next substep corrects nearly all of it: how far a loop is open depends on where it is and how fast it goes, and on
//! nothing before. A window holds whole turns or periods, or many swings, and so sees the same largest gap as any other,
//! but for two things. Where a crank lags, steps fall on other angles: of a peak that is w rad wide, steps of δ rad apart miss at
//! most (δ/2w)²/2, with δ = 2π/1000 and w = 0.1 rad 5e-4. And the first window has the start in it. [`EVEN`] has room for
//! twenty of the former. Where the energy changes by a share e, squares of rates do too, and gaps with them.
//!
//! *Distance from the traced motion.* The same; but the crank's is looked at after every 37th step only. A hundred turns see
//! every angle, so that tenths of a long run can be compared. A window of ten turns leaves gaps of 27 steps, δ = 0.17 rad, and
//! misses (δ/2w)²/2, 7 %, of a peak that is w = 0.23 rad wide, as this one is. Which angles a window misses comes round within a
//! few windows, so that a third of it at most is taken for a drift by a straight line: [`SAMPLED`]. Windows of one turn say less,
//! and of them no claim is made.
//!
//! *Energy.* Compared with that of the traced motion it goes up and down within a turn; its mean over a window must stay: a
//! drift over all of the run of less than [`EVEN`] of that going up and down. What swings freely has nothing that calls its
//! energy back. It may change by [`SWING`] of its height: beyond, it swings through other poses than it was meant to, and of
//! gaps and distances nothing is claimed any more.
//!
//! *Drives.* A drive that is told a rate adds rounding to rounding: a million times 1e-12 at most, [`ROUNDING`] (rad). One
//! held by impulses gives way with each step; what that comes to is measured, not bounded.

use super::record::{Run, drift, drift_share, growth};
use super::runs::Subject;

/// The share by which windows of the same motion may differ.
pub const EVEN: f64 = 0.01;

/// The share by which windows may differ in what is not looked at after every step.
pub const SAMPLED: f64 = 0.025;

/// The share of its height by which a swing's energy may change.
pub const SWING: f64 = 0.1;

/// How far a stiff drive in reduced coordinates may be behind (rad).
pub const ROUNDING: f64 = 1e-6;

/// Something that is held against a bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// What.
    pub what: &'static str,
    /// What was found.
    pub found: f64,
    /// What it may be at most.
    pub allowed: f64,
}

impl Claim {
    /// Whether it is true; of what is not a number nothing is.
    pub fn holds(&self) -> bool {
        self.found <= self.allowed
    }
}

/// Everything a run is held to.
pub fn claims(run: &Run) -> Vec<Claim> {
    let seen = &run.seen;
    let faster = match run.subject {
        Subject::Scissor => {
            let extremes = seen.energy_least.iter().chain(&seen.energy_most);
            extremes.fold(0.0f64, |most, e| most.max(e.abs()))
        }
        _ => 0.0,
    };
    let calm = run.calm();
    let (closure, distance) = (&seen.closure[..calm], &seen.distance[..calm]);
    let changed = faster.min(SWING);
    let mut claims = vec![
        Claim {
            what: "closure error, last tenth over first tenth",
            found: growth(closure),
            allowed: 1.0 + EVEN + changed,
        },
        Claim {
            what: "closure error, drift as a share of its mean",
            found: drift_share(closure).abs(),
            allowed: EVEN + changed,
        },
    ];
    // See above: windows of one turn.
    let whole = run.steps / run.windows() >= 10_000 || run.subject != Subject::Bennett;
    if whole {
        claims.push(Claim {
            what: "distance from the trace, last tenth over first tenth",
            found: growth(distance),
            allowed: 1.0 + SAMPLED + changed,
        });
        claims.push(Claim {
            what: "distance from the trace, drift as a share of its mean",
            found: drift_share(distance).abs(),
            allowed: SAMPLED + changed,
        });
    }
    let energy = drift(&seen.energy_mean).abs();
    match run.subject {
        Subject::Scissor => claims.push(Claim {
            what: "energy, change as a share of the swing's height",
            found: faster,
            allowed: SWING,
        }),
        Subject::Bennett | Subject::Stewart if whole => claims.push(Claim {
            what: "energy, drift of its mean as a share of its going up and down",
            found: energy / (seen.energy_most[0] - seen.energy_least[0]),
            allowed: EVEN,
        }),
        _ => {}
    }
    let behind = seen.behind.iter().fold(0.0f64, |most, b| most.max(b.abs()));
    match run.subject {
        Subject::Bennett if run.solver == "multibody" => claims.push(Claim {
            what: "crank, behind where it should be (rad)",
            found: behind,
            allowed: ROUNDING,
        }),
        Subject::Stewart => claims.push(Claim {
            what: "legs, farthest from their lengths, last tenth over first tenth",
            found: growth(&seen.behind.iter().map(|b| b.abs()).collect::<Vec<_>>()),
            allowed: 1.0 + EVEN,
        }),
        _ => {}
    }
    claims
}
