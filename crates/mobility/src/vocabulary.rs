//! The closed sets of words that an answer is given in, in the library as in reports. Definitions: `docs/src/definitions.md`.

use serde::{Deserialize, Serialize};
use std::fmt;

macro_rules! words {
    ($(#[$meta:meta])* $name:ident { $($(#[$variant_meta:meta])* $variant:ident => $word:literal,)+ }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
        pub enum $name {
            $($(#[$variant_meta])* #[serde(rename = $word)] $variant,)+
        }

        impl $name {
            /// Every value, in the order of the definitions.
            pub const ALL: &[Self] = &[$(Self::$variant,)+];

            /// The word in reports and files.
            #[must_use]
            pub fn word(self) -> &'static str {
                match self { $(Self::$variant => $word,)+ }
            }

            /// The value that a word names.
            #[must_use]
            pub fn from_word(word: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|value| value.word() == word)
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(self.word())
            }
        }
    };
}

words! {
    /// The answer in one word (D4).
    Verdict {
        /// The mechanism moves: at least one finite freedom.
        Mobile => "mobile",
        /// No finite freedom.
        Rigid => "rigid",
        /// The bounds on the finite mobility do not meet.
        Undecided => "undecided",
        /// No closed pose was found, so there is none to analyse.
        Unassembled => "unassembled",
    }
}

words! {
    /// Whether the configuration space is a manifold at the pose, of the dimension that the rank promises (D6).
    PoseKind {
        /// It is.
        Regular => "regular",
        /// It is not.
        Singular => "singular",
    }
}

words! {
    /// What is exact between axes and points of links.
    RelationKind {
        /// Axes of one link are parallel.
        Parallel => "parallel",
        /// Axes of one link make an angle that is a whole multiple of 15°.
        Angle => "angle",
        /// Axes of one link coincide, or a point lies on an axis, or points coincide.
        Coincide => "coincide",
        /// Axes of one link meet.
        Meet => "meet",
        /// Angles between axes are alike, or supplementary.
        EqualAngles => "equal_angles",
        /// Distances between axes or points are alike.
        EqualDistances => "equal_distances",
        /// The common normals of a hinge with its neighbours meet on its axis.
        NormalsMeet => "normals_meet",
    }
}

words! {
    /// In which way a pose is singular (D7).
    SingularKind {
        /// Branches with different tangents meet.
        Bifurcation => "bifurcation",
        /// Branches with a common tangent meet.
        Tangential => "tangential",
        /// One branch comes to a stop and turns back.
        Cusp => "cusp",
        /// Branches of different dimension meet.
        Kinematotropic => "kinematotropic",
        /// Instantaneous freedom without any finite one.
        Shaky => "shaky",
        /// More instantaneous than finite freedom all along the branch.
        PermanentlyShaky => "permanently_shaky",
    }
}

words! {
    /// Why a mechanism is mobile, after Hervé (D11).
    MobilityClass {
        /// All displacements of each loop lie in one subgroup.
        Trivial => "trivial",
        /// The subgroups of the chains explain the motion.
        Exceptional => "exceptional",
        /// Neither.
        Paradoxical => "paradoxical",
    }
}

words! {
    /// How far an answer can be trusted (D12), weakest first.
    CertificateLevel {
        /// Floating point with a margin.
        Numeric => "numeric",
        /// Group theory: exact, and true at every pose.
        Subgroup => "subgroup",
        /// Algebra over the rationals or an algebraic extension.
        Exact => "exact",
    }
}

words! {
    /// What claims something about the mobility of a part.
    EngineName {
        /// The rank of the closure equations at the pose.
        Rank => "rank",
        /// Closed forms of planar and spherical loops of hinges.
        ClosedForm => "closed form",
        /// Displacement subgroups.
        Subgroup => "subgroup",
        /// The chart test.
        Chart => "chart",
        /// The equations' terms of second order.
        SecondOrder => "second order",
        /// Real zeros of the equations' power series.
        Germ => "germ",
        /// Newton's polygon of one equation in two variables.
        NewtonPolygon => "Newton polygon",
        /// The splitting lemma on one equation.
        SplittingLemma => "splitting lemma",
        /// Loops that stand still by themselves.
        LoopsAtRest => "loops at rest",
        /// Exact algebra.
        Exact => "exact",
        /// The mechanisms that rounded numbers may stand for.
        Digits => "digits",
    }
}

words! {
    /// Where a claim holds.
    Scope {
        /// At the pose.
        Pose => "this pose",
        /// At the pose, of complex solutions, of which the real ones are some.
        PoseComplex => "this pose, complex",
        /// Near the pose.
        Neighbourhood => "a neighbourhood",
        /// Near the pose, of real solutions only.
        RealNeighbourhood => "a neighbourhood, real",
        /// At every pose of the same ranks.
        EveryPose => "every pose",
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn words_in_json_are_the_words_in_text() {
        for kind in SingularKind::ALL {
            let json = serde_json::to_string(kind).unwrap();
            assert_eq!(json, format!("\"{kind}\""));
            assert_eq!(SingularKind::from_word(kind.word()), Some(*kind));
        }
        assert_eq!(Verdict::from_word("fixed"), None);
    }
}
