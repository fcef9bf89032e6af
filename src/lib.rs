//! How can this mechanism move, and why?
//!
//! Data flows one way; each module uses only those above it in this list:
//!
//! 1. [`number`]: exact numbers beside their floating-point values, with the precision a file states.
//! 2. [`matrix`]: rank decisions with margins: dense, sparse, in many digits, over a prime field.
//! 3. [`mechanism`]: what a mechanism is; always valid.
//! 4. [`format`](mod@format): file text to [`mechanism::Mechanism`] and back.
//! 5. [`group`]: SE(3), twists, power series; the displacement subgroups.
//! 6. [`graph`]: the spatial constraint graph, its blocks, spanning tree and cycles.
//! 7. [`closure`]: the equations of the cycles: residual, Jacobian, assembly.
//! 8. [`algebra`]: the same equations as polynomials; Groebner bases.
//! 9. [`mobility`]: engines and the verdict.
//! 10. [`assembly`]: all configurations: collections of bodies, incidence trees.
//! 11. [`constructive`]: planar sketches: over- and under-constrained parts, constructions by ruler and compass.
//! 12. [`motion`]: a branch followed as a curve: predicted motion.
//! 13. [`simulate`]: a world of rigid bodies for a mechanism, and what it says about a prediction.
//! 14. [`accuracy`]: what every way to an answer costs, and how far off it is.
//! 15. [`record`]: logs of both for viewers.
//! 16. [`families`]: mechanisms of any size for examples, benches and tests.
//! 17. [`report`]: what a person or a program reads.
//! 18. [`sweep`]: the same question of many members of a family.
//!
//! Any of it can be asked to end before it is done: [`interruption`].

#[doc(inline)]
pub use kutzbach_algebra as algebra;
#[doc(inline)]
pub use kutzbach_assembly as assembly;
#[doc(inline)]
pub use kutzbach_closure as closure;
#[doc(inline)]
pub use kutzbach_constructive as constructive;
#[doc(inline)]
pub use kutzbach_format as format;
#[doc(inline)]
pub use kutzbach_math::{group, interruption, matrix, number};
#[doc(inline)]
pub use kutzbach_mobility::{self as mobility, families};
#[doc(inline)]
pub use kutzbach_model::{graph, mechanism};
#[doc(inline)]
pub use kutzbach_motion as motion;
#[doc(inline)]
pub use kutzbach_report::{self as report, sweep};
#[cfg(feature = "simulate")]
#[doc(inline)]
pub use kutzbach_simulate::{self as simulate, accuracy};

/// What a mechanism looks like at a pose, and with the feature `logs` motions as logs for viewers.
#[cfg(any(feature = "html", feature = "logs"))]
pub mod record {
    #[doc(inline)]
    pub use kutzbach_scene::*;
    #[cfg(all(feature = "logs", feature = "simulate"))]
    #[doc(inline)]
    pub use kutzbach_simulate::SimulationLog;
}

/// The README's example is compiled and run with the documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// So are those of the book's page about the library.
#[cfg(doctest)]
#[doc = include_str!("../docs/src/library.md")]
struct LibraryPage;
