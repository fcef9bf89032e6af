//! A part of a graph with vertices of its own.

/// Edges of any kind between vertices with arbitrary numbers, renumbered `0..n` in ascending order.
pub(super) struct Local {
    /// The numbers outside, ascending.
    pub(super) vertices: Vec<usize>,
    /// For each vertex its neighbours and the indices of the edges that lead there.
    pub(super) near: Vec<Vec<(usize, usize)>>,
}

impl Local {
    /// The vertices, ascending, with the edges among them. `place` gives the number of a vertex in here and is overwritten for
    /// these vertices.
    pub(super) fn new(
        vertices: Vec<usize>,
        edges: impl Iterator<Item = [usize; 2]>,
        place: &mut [usize],
    ) -> Self {
        for (i, &v) in vertices.iter().enumerate() {
            place[v] = i;
        }
        let mut near = vec![Vec::new(); vertices.len()];
        for (e, ends) in edges.enumerate() {
            let [u, v] = ends.map(|w| place[w]);
            near[u].push((v, e));
            near[v].push((u, e));
        }
        Self { vertices, near }
    }

    pub(super) fn len(&self) -> usize {
        self.vertices.len()
    }

    /// For each vertex the number of its component without the two, in order of their first vertices; `usize::MAX` for the
    /// two.
    pub(super) fn components_without(&self, out: &[usize]) -> (Vec<usize>, usize) {
        let mut of = vec![usize::MAX; self.len()];
        let mut count = 0;
        let mut stack = Vec::new();
        for start in 0..self.len() {
            if of[start] != usize::MAX || out.contains(&start) {
                continue;
            }
            of[start] = count;
            stack.push(start);
            while let Some(v) = stack.pop() {
                for &(w, _) in &self.near[v] {
                    if of[w] == usize::MAX && !out.contains(&w) {
                        of[w] = count;
                        stack.push(w);
                    }
                }
            }
            count += 1;
        }
        (of, count)
    }
}
