//! Polynomial equations of a mechanism, exact.
//!
//! # The problem
//! A pose is valid if and only if its loops close. With a point (c, s) of the circle for every angle and a unit quaternion
//! for every ball the closure is polynomial, and if the mechanism's numbers are algebraic so are its coefficients. Then
//! algebra can speak of the whole configuration space.
//!
//! # What the result must satisfy
//! - Its solutions are the mechanism's poses: complex solutions included, nothing real lost. Where this cannot be had
//!   (screws that are not on one line, gears between angles and lengths) the system is *relaxed*: it says less than the
//!   mechanism, its solutions contain the mechanism's, and [`PolynomialSystem::relaxations`] names what was left out.
//! - Coefficients are exact. A number that is not rational becomes a variable with its minimal polynomial among the
//!   equations ([`Meaning::Algebraic`] says which root is meant). A number that is not algebraic is an error that says what
//!   to write instead. Decimals are taken as the fractions they are ([`PolynomialSystem::rounded_numbers`]).
//! - No pose of a joint is special: balls are quaternions (each pose twice), not three turns with a gimbal lock.
//!
//! # Three formulations
//! [`Formulation::Canonical`]: the joints' freedoms; every basic cycle of the low-depth tree gives the entries of (left
//! half) − (right half) of its closure (Ruiz 1994, chapter 4). [`Formulation::Tree`]: only joints of a spanning tree have
//! variables; every other joint gives its own few conditions on the two link poses. [`Formulation::Positional`]: the
//! twelve entries of every link's matrix with eight equations of orthonormality (there, (3.5)), and the conditions of all
//! joints.
//!
//! # Cost
//! Equations of a cycle of n hinges have up to 3^(n/2) terms, so that long cycles are refused ([`SystemError::TooLarge`]).
//! Otherwise milliseconds.

mod angles;
mod build;
mod circle;
mod coaxial;
mod couplings;
mod displacement;
mod element;
mod error;
mod field;
mod file_pose;
mod flatten;
mod fraction;
mod home;
mod home_screws;
mod implicit;
mod joint_form;
mod joint_pose;
mod model;
mod modular;
mod number_field;
mod numbers;
mod poly;
mod positional;
mod reach;
mod relative_displacement;
mod roots;
mod space;
mod spanning;
mod variables;
mod walks;

pub use build::polynomial_system;
pub use error::SystemError;
pub use home::HomePose;
pub use modular::ModularSystem;
pub use number_field::{FieldElement, FieldGenerator, NumberField};
pub use reach::Reach;
pub(super) use relative_displacement::{ExactVector, Reduce, RelativeDisplacement, Unavailable};
pub use variables::{Meaning, Variable};

use super::polynomial::Polynomial;
use kutzbach_model::mechanism::{JointId, LinkId};

/// Which unknowns the equations are written in; see the page on what can be proven.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Formulation {
    /// The joints' freedoms, cycle by cycle.
    #[default]
    Canonical,
    /// The freedoms of the joints of a tree, and what the other joints ask for.
    Tree,
    /// The entries of every link's matrix.
    Positional,
}

/// What [`polynomial_system`] is to build.
#[derive(Clone, Debug, Default)]
pub struct SystemOptions {
    /// The unknowns.
    pub formulation: Formulation,
    /// The configuration to take as the drawn pose; `None` is the home pose.
    pub configuration: Option<String>,
    /// Lines on lines and planes on planes without regard to sense, as in Ruiz 1994: in the positional and the tree form.
    pub unoriented: bool,
    /// Take the shortest cycles instead of those of the low-depth tree (canonical form only).
    pub shortest_cycles: bool,
    /// Write only the cycles and couplings all of whose joints are among these; `None` for all. In the positional form it
    /// means nothing.
    pub joints: Option<Vec<JointId>>,
    /// Most products of terms that one equation between two poses may take; more is
    /// [`SystemError::TooManyProducts`]. `None` is four million: some
    /// ten seconds and a gigabyte.
    pub most_products: Option<u64>,
}

impl SystemOptions {
    /// Whether a joint belongs to what is asked for.
    fn includes(&self, joint: usize) -> bool {
        let among = |joints: &Vec<JointId>| joints.contains(&JointId(joint));
        self.joints.as_ref().is_none_or(among)
    }
}

/// Where an equation comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Origin {
    /// An entry of a cycle's closure.
    Cycle {
        /// Index in [`PolynomialSystem::cycles`].
        cycle: usize,
        /// 0 to 2.
        row: usize,
        /// 0 to 2 for the rotation, 3 for the translation.
        column: usize,
    },
    /// A condition of a joint on the poses of its two links.
    Joint {
        /// The joint.
        joint: JointId,
    },
    /// A joint's own: the circle of a turn, the unit length of a quaternion, the length of a rod.
    Freedom {
        /// The joint.
        joint: JointId,
    },
    /// A link's matrix is a rotation.
    Orthonormality {
        /// The link.
        link: LinkId,
    },
    /// A coupling.
    Coupling {
        /// Index in [`Mechanism::couplings`](kutzbach_model::mechanism::Mechanism::couplings).
        coupling: usize,
    },
    /// What an algebraic number is a root of.
    MinimalPolynomial {
        /// Index of its variable.
        variable: usize,
    },
    /// The circle of an angle that is a parameter.
    Parameter {
        /// Index of the variable of its sine.
        variable: usize,
    },
}

/// An equation `polynomial = 0`.
#[derive(Clone, Debug)]
pub struct Equation {
    /// With coprime integer coefficients.
    pub polynomial: Polynomial,
    /// Where it comes from; of equal equations the first.
    pub origin: Origin,
}

/// One basic cycle and what belongs to it.
#[derive(Clone, Debug)]
pub struct CycleEquations {
    /// The joints in the order of the walk, with whether each is passed from predecessor to successor.
    pub joints: Vec<(JointId, bool)>,
    /// Indices of its equations: its closure, its joints' own (in the positional form those of its links as well), and the
    /// minimal polynomials they need.
    pub equations: Vec<usize>,
    /// Indices of the variables that occur in them.
    pub variables: Vec<usize>,
}

/// What a system leaves out of a mechanism: its solutions contain the mechanism's, so that dimensions are upper bounds.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Relaxation {
    /// A screw turns and travels independently.
    Screw {
        /// The joint.
        joint: JointId,
        /// Its name.
        name: String,
    },
    /// A coupling is left out.
    Coupling {
        /// Index of the coupling.
        coupling: usize,
        /// Its name.
        name: String,
        /// Why.
        reason: String,
    },
}

impl std::fmt::Display for Relaxation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Screw { name, .. } => write!(
                f,
                "screw `{name}` is taken as a sleeve: how far a screw goes by an angle is no algebraic relation"
            ),
            Self::Coupling { name, reason, .. } => {
                write!(f, "coupling `{name}` is left out: {reason}")
            }
        }
    }
}

/// The equations of a mechanism.
#[derive(Clone, Debug)]
pub struct PolynomialSystem {
    /// The variables: unknowns first, then parameters and algebraic numbers.
    pub variables: Vec<Variable>,
    /// The equations, no two equal, none zero.
    pub equations: Vec<Equation>,
    /// Polynomials that must not vanish: denominators that hold parameters.
    pub nonzero: Vec<Polynomial>,
    /// The basic cycles.
    pub cycles: Vec<CycleEquations>,
    /// Indices of the variables of every joint, by joint.
    pub joint_variables: Vec<Vec<usize>>,
    /// Which variables need a word: quaternions that count every pose twice, scaled sines.
    pub charts: Vec<String>,
    /// What was left out.
    pub relaxations: Vec<Relaxation>,
    /// Whether the file's numbers are rounded ([`Precision`](kutzbach_model::mechanism::Precision)). They are taken literally here:
    /// the equations are those of a mechanism that differs from the one meant in the last digits, and where that one
    /// moves by special dimensions, this one as a rule does not.
    pub rounded_numbers: bool,
    /// The drawn pose as a solution.
    pub home: HomePose,
    construction: build::Construction,
}

impl PolynomialSystem {
    /// The variables' names, in order.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        self.variables.iter().map(|v| v.name.clone()).collect()
    }

    /// The equations' left sides, in order.
    #[must_use]
    pub fn polynomials(&self) -> Vec<Polynomial> {
        self.equations
            .iter()
            .map(|e| e.polynomial.clone())
            .collect()
    }

    /// Whether the solutions are the mechanism's poses, nothing left out.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.relaxations.is_empty()
    }
}
