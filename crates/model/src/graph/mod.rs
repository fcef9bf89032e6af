//! The spatial constraint graph of a mechanism: which links hang together, and through which loops.
//!
//! # The problem
//! Links are nodes, joints are edges. Two links may share several joints (parallel edges); a joint never ties a link
//! to itself. A mechanism moves by the equations of its closed loops, and *which* loops are written down decides how
//! large and how entangled those equations become. This module finds the loops worth writing.
//!
//! # What a result must satisfy
//! * **Complete and free of repetition.** A connected graph with V nodes and E edges has exactly E − V + 1 independent
//!   cycles; with C components E − V + C. Every set of cycles handed out has that many members and is independent
//!   ([`invariants`] checks it).
//! * **Valid for solving at a distance, not only at a pose.** Closing all cycles of a basis must close every loop of the
//!   graph. Independence alone does not promise that; a basis that *peels* ([`peels`]) does. A basis that does not peel
//!   is replaced by the fundamental cycles of the spanning tree, and the result says so ([`BasisKind`]).
//! * **Short.** The number of edges in all cycles together is the size of the equations. [`CycleBasis::minimum`] makes it
//!   as small as it can be, exactly.
//! * **The same whatever the order of the file.** Results speak in node and edge indices, but every choice on the way
//!   goes by degree and then by name, names being compared as plain strings. Names are expected to be unique; should
//!   two be equal, the smaller index goes first.
//!
//! # What it costs
//! Components, blocks and the spanning tree take O((V + E) log V). A minimum cycle basis costs what the balls around the
//! nodes hold, up to half the length of the cycles needed: linear for long chains and lattices of small cells. Nothing
//! here recurses, so a chain of a hundred thousand links does not exhaust the stack.
//!
//! # Where to look
//! | file | what it answers |
//! |---|---|
//! | `constraint_graph` | what the graph is |
//! | `components` | what is connected, what is a bridge, what can be analysed apart |
//! | `spanning_tree` | along which joints each link is reached from the root |
//! | `cycles` | oriented closed walks, fundamental cycles, shared edges |
//! | `cycle_basis` | the shortest basis; `block_graph`, `short_cycles`, `signed_cover`, `gf2` are its parts |
//! | `invariants` | whether a tree or a set of cycles is what it claims to be |
//! | `folded` | the graph without what is only fixed to something |
//! | `summary`, `draw`, `svg` | the same facts for a reader: text and JSON, Graphviz, picture |

mod block_graph;
mod components;
mod constraint_graph;
mod cycle_basis;
mod cycles;
mod draw;
mod folded;
mod gf2;
pub mod invariants;
mod of_mechanism;
mod short_cycles;
mod signed_cover;
mod spanning_tree;
mod summary;
mod svg;

#[cfg(test)]
mod samples;

pub use components::{Block, CoupledBlock};
pub use constraint_graph::{
    ConstraintGraph, EdgeSpec, ExtraRelation, GraphError, Incidence, NodeSpec,
};
pub use cycle_basis::{BasisKind, CycleBasis, peels};
pub use cycles::{Cycle, Overlap, fundamental_cycle, fundamental_cycles, overlaps};
pub use draw::to_dot;
pub use folded::FoldedGraph;
pub use spanning_tree::SpanningTree;
pub use summary::{BlockSummary, CycleSummary, CyclesSummary, GraphSummary, LowDepth, TreeNode};
pub use svg::{Captions, SVG_STYLE, folded_svg_fragment, svg_fragment, to_svg, to_svg_with};
