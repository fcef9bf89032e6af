//! What accuracy costs, as a page and as a figure.
//!
//! # The problem
//! Twenty ways to an answer with a time and an error each are a heap of numbers. A person who has a mechanism wants to know
//! which of them to use; so the ways that no other one beats have to stand out, and the units have to be those of the
//! person's question: seconds for an answer, seconds for a second of motion, errors in lengths of the mechanism.
//!
//! # What holds
//! * Text, HTML and figure are made of one [`Accuracy`](kutzbach_simulate::accuracy::Accuracy) and say nothing that it does not.
//! * What was not measured is said to be left out.
//!
//! | file | says |
//! |---|---|
//! | `tables` | the page: a table for each stage, and the choice |
//! | `figure` | the picture: errors over time, and below it the ways to the answer |

mod figure;
mod tables;

pub use figure::{Figure, figure};
pub use tables::{choice_text, page, setting_text};
