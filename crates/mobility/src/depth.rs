//! Analysis depth; the cost grows with it.

/// What an analysis is to find out. Each depth includes what the ones before it say, with the same answers.
///
/// | depth | says | of the cost of a regular loop, about |
/// |---|---|---|
/// | `Rank` | counts, closure, and the instantaneous freedom with its margin | a twentieth |
/// | `Verdict` | finite freedom, class, singularity, certificate and evidence | a tenth |
/// | `Motions` | the branches, with generic poses and roles on them | a third to a half |
/// | `Everything` | roles and redundancy at the pose, cycles, advice, and stronger certificates by exact algebra | all |
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Depth {
    /// The rank at the pose. It bounds the finite freedom from above; the verdict is left undecided and says so.
    Rank,
    /// The verdict. Exact algebra is asked only of what stays open without it.
    Verdict,
    /// The branches too, as tracing and simulation want them. Exact algebra as for the verdict.
    Motions,
    /// All of it, as a report shows it. Exact algebra is also asked whether it can prove what numbers decided.
    #[default]
    Everything,
}
