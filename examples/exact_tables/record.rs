//! What was measured, as it is kept.

use serde::{Deserialize, Serialize};

/// All tables of a day.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    pub date: String,
    /// When the tables of the source were measured, where that was later.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tables_date: Option<String>,
    pub machine: String,
    pub tables: Vec<Table>,
    pub scenes: Vec<Scene>,
    pub loops: Vec<Loop>,
}

/// A table of the source with our rows beside its own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    pub number: String,
    pub title: String,
    pub rows: Vec<Row>,
}

/// A row: what the source states, what we find. Either may be missing where the other has a cycle that this one has not.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    pub example: String,
    pub variables: String,
    pub way: String,
    pub what: String,
    pub published: Option<Figures>,
    pub ours: Option<Figures>,
}

/// The size of a computation. A missing basis is one that was not reached.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    pub variables: usize,
    pub equations: usize,
    pub basis: Option<usize>,
    /// The same in lexicographic order, of ours, where it was asked for.
    pub lexicographic: Option<usize>,
    pub seconds: Option<f64>,
    /// How many cases the step was done in.
    pub cases: usize,
}

/// A family of larger and larger mechanisms.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Scene {
    pub name: String,
    pub about: String,
    pub sizes: Vec<Size>,
}

/// One member of a family.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Size {
    pub n: usize,
    pub variables: usize,
    pub equations: usize,
    pub dimension: Option<usize>,
    /// Seconds and work by each way, in the order brute force, divide and conquer, instancing; missing where the limit of
    /// time was reached.
    pub ways: [Option<Cost>; 3],
    /// Cases of instancing.
    pub cases: Option<usize>,
}

/// What a computation cost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    pub seconds: f64,
    pub work: u64,
}

/// One closed loop of hinges.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Loop {
    pub name: String,
    pub dimension: Option<usize>,
    pub degree: Option<u64>,
    pub basis: usize,
    pub seconds: f64,
}
