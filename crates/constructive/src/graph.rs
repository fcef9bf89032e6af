//! Constraint graphs: vertices with two freedoms each, edges that take one.

use std::collections::HashMap;
use thiserror::Error;

/// Why something is no constraint graph. Indices are those of the input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum GraphError {
    /// Fewer than two vertices leave nothing to constrain.
    #[error("a constraint graph has two vertices at least, this one has {0}")]
    TooSmall(usize),
    /// An edge ends at a vertex that does not exist.
    #[error("edge {edge} ends at vertex {vertex}, which does not exist")]
    NoVertex {
        /// The edge.
        edge: usize,
        /// Its end.
        vertex: usize,
    },
    /// An edge from a vertex to itself.
    #[error("edge {edge} ties vertex {vertex} to itself")]
    Loop {
        /// The edge.
        edge: usize,
        /// Both of its ends.
        vertex: usize,
    },
    /// Two edges between the same vertices.
    #[error("edges {first} and {second} constrain the same two vertices")]
    Doubled {
        /// The edge that stands first.
        first: usize,
        /// The other one.
        second: usize,
    },
}

/// A simple graph with two vertices at least; each vertex has two freedoms in the plane, each edge takes one.
///
/// ```
/// use kutzbach_constructive::graph::Graph;
/// let square = Graph::new(4, [[0, 1], [1, 2], [2, 3], [3, 0]])?;
/// assert_eq!(square.deficit(), 1);
/// # Ok::<(), kutzbach_constructive::graph::GraphError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Graph {
    vertices: usize,
    edges: Vec<[usize; 2]>,
}

impl Graph {
    /// The graph with vertices `0..vertices` and these edges, which keep their order.
    ///
    /// # Errors
    /// With fewer than two vertices, and at the first edge that names an unknown vertex, one vertex twice, or the same two
    /// vertices as an edge before it.
    pub fn new(
        vertices: usize,
        edges: impl IntoIterator<Item = [usize; 2]>,
    ) -> Result<Self, GraphError> {
        if vertices < 2 {
            return Err(GraphError::TooSmall(vertices));
        }
        let edges: Vec<[usize; 2]> = edges.into_iter().collect();
        let mut seen = HashMap::with_capacity(edges.len());
        for (edge, &[u, v]) in edges.iter().enumerate() {
            if let Some(vertex) = [u, v].into_iter().find(|&w| w >= vertices) {
                return Err(GraphError::NoVertex { edge, vertex });
            }
            if u == v {
                return Err(GraphError::Loop { edge, vertex: u });
            }
            if let Some(first) = seen.insert([u.min(v), u.max(v)], edge) {
                let second = edge;
                return Err(GraphError::Doubled { first, second });
            }
        }
        Ok(Self { vertices, edges })
    }

    /// The number of vertices, at least two.
    #[must_use]
    pub const fn vertices(&self) -> usize {
        self.vertices
    }

    /// The edges in the order given, each with its ends as given.
    #[must_use]
    pub fn edges(&self) -> &[[usize; 2]] {
        &self.edges
    }

    /// Constraints that are missing to fix all vertices against each other: (2V − 3) − E. Zero of a well-constrained graph,
    /// and of others too.
    #[must_use]
    pub fn deficit(&self) -> i64 {
        deficit(self.vertices, self.edges.len())
    }
}

/// (2V − 3) − E.
pub(crate) fn deficit(vertices: usize, edges: usize) -> i64 {
    2 * vertices as i64 - 3 - edges as i64
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_graph_is_told_with_its_edge() {
        let told = |n, edges: &[[usize; 2]]| Graph::new(n, edges.iter().copied()).err();
        assert_eq!(told(2, &[[0, 1]]), None);
        assert_eq!(told(1, &[]), Some(GraphError::TooSmall(1)));
        let (edge, vertex) = (1, 3);
        assert_eq!(
            told(3, &[[0, 1], [1, 3]]),
            Some(GraphError::NoVertex { edge, vertex })
        );
        let vertex = 2;
        assert_eq!(
            told(3, &[[0, 1], [2, 2]]),
            Some(GraphError::Loop { edge, vertex })
        );
        let (first, second) = (0, 2);
        assert_eq!(
            told(3, &[[0, 1], [1, 2], [1, 0]]),
            Some(GraphError::Doubled { first, second })
        );
    }
}
