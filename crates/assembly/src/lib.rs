//! Every way in which bodies fit together.
//!
//! The other crates start where a file draws its mechanism. Here the question is in how many ways it closes at all, and
//! which they are. Two ideas of Sitharam, Peters and Zhou make that tractable: of bodies that share points a *tree* can be
//! resolved by hand, so that only the freedoms left along it remain unknown; and the tree can be chosen so that these are
//! as few as possible, by combinatorics alone.
//!
//! | module | what it knows |
//! |---|---|
//! | [`collection`] | bodies that share points, which of them are implied, when a collection is standard |
//! | [`modes`] | all configurations of a mechanism, with some joints held |
//! | [`placed`] | the collection of a mechanism, with exact points |
//! | [`real`] | all real solutions, with proof |
//! | [`reduced`] | the equations that a tree leaves, exact |
//! | [`seams`] | which of the incidences to ask for where all of them contradict one another |
//! | [`tree`] | covering sets and the incidence tree with the fewest unknowns |
//! | [`words`] | the answers as text and data |

pub mod collection;
pub mod modes;
mod paths;
pub mod placed;
pub mod real;
pub mod reduced;
pub mod seams;
pub mod tree;
pub mod words;

#[cfg(test)]
mod samples;
